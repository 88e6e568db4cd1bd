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
from scadgen.solid.affine import Floats
from scadgen.solid.planar import normal_of_loops

__all__ = ["recede"]

#: Sweeps that even out the displacements of neighbours.
_SWEEPS = 10

#: Directions whose sine to the facets' span is smaller count as within it.
_FLAT = 1e-6

#: Least squared residual of the dual program for which the displacement exists.
_FEASIBLE = 1e-10


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
    neighbours = _neighbours(surface)
    displacement = np.zeros_like(surface.points)
    for sweep in range(_SWEEPS + 1):
        for vertex, limits in vertices.items():
            near = neighbours.get(vertex)
            wish = displacement[near].mean(axis=0) if sweep and near else displacement[vertex]
            displacement[vertex] = limits.nearest(wish, surface.points[vertex])
    return displacement


def _neighbours(surface: Surface) -> dict[int, list[int]]:
    """Vertices joined to each by a wall's triangle."""
    near: dict[int, set[int]] = defaultdict(set)
    for triangle in surface.walls.tolist():
        for vertex in triangle:
            near[vertex].update(triangle)
    return {vertex: sorted(found - {vertex}) for vertex, found in near.items()}


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

    def nearest(self, wish: Floats, place: Floats) -> Floats:
        """The displacement nearest to a wish; `place` is for the message if there is none."""
        start = self._start + (wish - self._start) @ self._free.T @ self._free
        slack = 1.0 - self._rows @ start
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
        return np.asarray(start - (rest[:-1] / rest[-1]) @ self._free)
