"""How a surface draws back to leave a gap.

Every vertex gets the shortest displacement, per unit of the part's share of the gap, that
takes it off the plane of every wall triangle around it by at least one, keeps it in every
facet it lies on that stays, and takes it off those that draw back by exactly one.  A triangle
whose three corners are behind a plane is behind it too, so the whole wall recedes.

That is a least-distance program a vertex; its dual is a non-negative least squares problem
(C. L. Lawson and R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection

import numpy as np
from scipy.optimize import nnls

from scadgen.errors import GeometryError
from scadgen.joint.surface import Surface
from scadgen.joint.walls import Facet
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.planar import normal_of_loops

__all__ = ["recede"]

#: Sweeps that even out the displacements of neighbours.
_SWEEPS = 10

#: Directions whose sine to the facets' span is smaller count as within it.
_FLAT = 1e-6

#: Least squared residual of the dual program for which the displacement exists.
_FEASIBLE = 1e-10

#: How exactly walls' planes are met where what limits a vertex is known, in displacements.
_EXACT = 1e-12


def recede(surface: Surface, moving: Collection[Facet]) -> Floats:
    """Displacement of each vertex per unit of gap.

    Parameters
    ----------
    surface
        The surface.
    moving
        Facets that draw back by one unit; all others stay.

    Returns
    -------
    displacement
        ``(v, 3) float``; zero where nothing asks for any.

    Raises
    ------
    GeometryError
        Somewhere a wall runs along a facet's edge, so that nothing can draw it back.
    """
    corners = surface.points[surface.walls]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    around: dict[int, list[Floats]] = defaultdict(list)
    for triangle, normal in zip(surface.walls.tolist(), normals, strict=True):
        for vertex in triangle:
            around[vertex].append(normal)
    held: dict[int, list[tuple[Floats, float]]] = defaultdict(list)
    for facet, sides in surface.outlines.items():
        normal = normal_of_loops(surface.points, surface.loops(facet))
        for vertex in sides[:, 0].tolist():
            held[vertex].append((normal, -1.0 if facet in moving else 0.0))
    vertices = {
        vertex: _Vertex(held.get(vertex, []), around.get(vertex, []))
        for vertex in sorted({*around, *held})
    }
    displacement = np.zeros_like(surface.points)
    for vertex, limits in vertices.items():
        displacement[vertex] = limits.nearest(np.zeros(3), surface.points[vertex])
    near = _neighbours(surface)
    return _Sweeps({v: vertices[v] for v in near}, near, displacement, surface.points).done()


def _neighbours(surface: Surface) -> dict[int, list[int]]:
    """Vertices joined to each by a wall's triangle."""
    near: dict[int, set[int]] = defaultdict(set)
    for triangle in surface.walls.tolist():
        for vertex in triangle:
            near[vertex].update(triangle)
    return {vertex: sorted(near[vertex] - {vertex}) for vertex in sorted(near)}


class _Vertex:
    """What one vertex's displacement d must obey.

    Parameters
    ----------
    held
        Normals n and values b with n . d = b.
    walls
        Normals n with n . d <= -1.
    """

    def __init__(self, held: list[tuple[Floats, float]], walls: list[Floats]) -> None:
        self._start, self._free = np.zeros(3), np.eye(3)
        if held:
            planes = np.array([normal for normal, _ in held])
            _, size, rows = np.linalg.svd(planes)
            values = np.array([value for _, value in held])
            self._start = np.linalg.lstsq(planes, values, rcond=_FLAT)[0]
            self._free = rows[int((size > _FLAT).sum()) :]
        self._rows = -np.array(walls).reshape(-1, 3)
        self._within = self._free @ self._rows.T
        self.start, self.rows, self.projector = self._start, self._rows, self._free.T @ self._free
        self.active = np.zeros(0, dtype=int)

    def nearest(self, wish: Floats, place: Floats) -> Floats:
        """The displacement nearest to a wish; `place` is for the message if there is none."""
        start = self._start + (wish - self._start) @ self._free.T @ self._free
        slack = 1.0 - self._rows @ start
        self.active = np.zeros(0, dtype=int)
        if (slack <= 0).all():
            return np.asarray(start)
        system = np.vstack([self._within, slack])
        target = np.zeros(len(system))
        target[-1] = 1.0
        weights, _ = nnls(system, target)
        rest = system @ weights - target
        if rest @ rest < _FEASIBLE:
            x, y, z = place
            msg = (
                f"a wall runs along an edge of the ring near ({x:.3f}, {y:.3f}, {z:.3f}) sides: "
                "no clearance is possible there; another amplitude or bend helps"
            )
            raise GeometryError(msg)
        self.active = np.flatnonzero(weights)
        return np.asarray(start - (rest[:-1] / rest[-1]) @ self._free)


class _Sweeps:
    """Sweeps over all vertices on walls, each as near to the middle of its neighbours as it may.

    In a sweep each vertex comes after the neighbours before it and before those after it.
    Vertices that do not wait for each other, in this sweep or in the next, are moved at once.
    What limits a vertex mostly is what did in the sweep before, and that it is the displacement
    nearest to the wish is easily seen then; only where it is not is it sought anew.

    Parameters
    ----------
    vertices
        The vertices, and what they obey.
    near
        The neighbours of each.
    displacement
        Of all points of the surface, to begin with.
    points
        The surface's points.
    """

    def __init__(
        self,
        vertices: dict[int, _Vertex],
        near: dict[int, list[int]],
        displacement: Floats,
        points: Floats,
    ) -> None:
        self._limits, self._points = list(vertices.values()), points
        self._number = np.array(list(vertices), dtype=int)
        self._waves = _waves(near)
        count = len(vertices)
        self._degree = np.array([len(near[v]) for v in vertices])
        most = max(self._degree, default=0)
        # What is short of others is filled up: neighbours by a last point that never moves,
        # walls by ones that ask for nothing.
        self._moved = np.vstack([displacement, np.zeros(3)])
        self._near = np.full((count, most), len(displacement))
        rows = max((len(limits.rows) for limits in self._limits), default=0) + 1
        self._walls, self._need = np.zeros((count, rows, 3)), np.zeros((count, rows))
        self._start, self._projector = np.zeros((count, 3)), np.zeros((count, 3, 3))
        self._active = np.full((count, 3), rows - 1)
        self._push, self._inverse = np.zeros((count, 3, 3)), np.zeros((count, 3, 3))
        for n, (vertex, limits) in enumerate(vertices.items()):
            self._near[n, : self._degree[n]] = near[vertex]
            self._walls[n, : len(limits.rows)], self._need[n, : len(limits.rows)] = limits.rows, 1.0
            self._start[n], self._projector[n] = limits.start, limits.projector
            self._active[n, : len(limits.active)] = limits.active
        self._remember(np.arange(count))

    def done(self) -> Floats:
        """The displacements after all sweeps."""
        for wave in self._waves:
            self._move(wave)
        return self._moved[:-1]

    def _remember(self, places: Ints) -> None:
        """Work out what follows from what limits some vertices."""
        active = self._active[places]
        push = self._walls[places[:, None], active] @ self._projector[places]
        fill = active == self._walls.shape[1] - 1
        self._push[places] = push
        self._inverse[places] = np.linalg.inv(
            push @ push.swapaxes(1, 2) + fill[:, None] * np.eye(3)
        )

    def _move(self, wave: Ints) -> None:
        """Move vertices that do not wait for each other."""
        wish = self._moved[self._near[wave]].sum(axis=1) / self._degree[wave, None]
        walls, need, active = self._walls[wave], self._need[wave], self._active[wave]
        start = self._start[wave]
        start = start + _product(self._projector[wave], wish - start)
        slack = need - _product(walls, start)
        weights = _product(self._inverse[wave], np.take_along_axis(slack, active, axis=1))
        found = start + np.einsum("kij,ki->kj", self._push[wave], weights)
        left = need - _product(walls, found)
        off = np.abs(np.take_along_axis(left, active, axis=1)).max(axis=1)
        good = (weights >= 0).all(axis=1) & (left.max(axis=1) < _EXACT) & (off < _EXACT)
        self._moved[self._number[wave]] = found
        if not good.all():
            self._seek(wave[~good], wish[~good])

    def _seek(self, places: Ints, wishes: Floats) -> None:
        """Move vertices that something else limits than in the sweep before."""
        for n, wish in zip(places.tolist(), wishes, strict=True):
            vertex, limits = self._number[n], self._limits[n]
            self._moved[vertex] = limits.nearest(wish, self._points[vertex])
            self._active[n] = self._walls.shape[1] - 1
            self._active[n, : len(limits.active)] = limits.active
        self._remember(places)


def _product(matrices: Floats, vectors: Floats) -> Floats:
    """The product of each matrix with its vector."""
    return np.asarray((matrices @ vectors[..., None])[..., 0])


def _waves(near: dict[int, list[int]]) -> list[Ints]:
    """What can be moved at once, for all sweeps: places of vertices among those given."""
    place = {vertex: n for n, vertex in enumerate(near)}
    before = [[place[u] for u in found if u < v] for v, found in near.items()]
    after = [[place[u] for u in found if u > v] for v, found in near.items()]
    waves: list[list[int]] = []
    wave = [-1] * len(near)
    for _ in range(_SWEEPS):
        for n in range(len(near)):
            # What comes after it has the number of the sweep before still.
            wave[n] = 1 + max(wave[n], *(wave[u] for u in before[n]), *(wave[u] for u in after[n]))
            if wave[n] == len(waves):
                waves.append([])
            waves[wave[n]].append(n)
    return [np.array(found) for found in waves]
