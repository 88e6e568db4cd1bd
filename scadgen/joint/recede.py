"""How a surface draws back to leave a gap.

Every vertex gets the shortest displacement, per unit of the part's share of the gap, that
takes it off the plane of every wall triangle around it by at least one, keeps it in every
facet it lies on that stays, and takes it off those that draw back by exactly one.  A triangle
whose three corners are behind a plane is behind it too, so the whole wall recedes.

That is a least-distance program a vertex (`scadgen.joint.nearest`).  Then neighbours are evened
out: time and again each vertex gets what it may have that is nearest to their mean.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array

from scadgen.errors import GeometryError
from scadgen.joint.nearest import nearest_points
from scadgen.joint.surface import Surface
from scadgen.joint.walls import Facet
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.vectors import cross, dot

__all__ = ["recede"]

#: Times that the displacements of neighbours are evened out.
_SWEEPS = 20

#: Directions whose sine to the facets' span is smaller count as within it.
_FLAT = 1e-6

#: How exactly walls' planes are met where what limits a vertex is known, in displacements.
_EXACT = 1e-12


def recede(pieces: Sequence[tuple[Surface, Collection[Facet]]]) -> list[Floats]:
    """Displacement of each vertex per unit of gap.

    Parameters
    ----------
    pieces
        Surfaces, and those of their facets that draw back by one unit; all others stay.

    Returns
    -------
    displacements
        ``(v, 3) float`` of each; zero where nothing asks for any.

    Raises
    ------
    GeometryError
        Somewhere a wall runs along a facet's edge, so that nothing can draw it back.
    """
    sizes = [len(surface.points) for surface, _ in pieces]
    starts = np.cumsum([0, *sizes[:-1]])
    points = np.concatenate([surface.points for surface, _ in pieces])
    walls = np.concatenate(
        [surface.walls + start for (surface, _), start in zip(pieces, starts, strict=True)]
    )
    planes = _joined([_facets(*piece, start) for piece, start in zip(pieces, starts, strict=True)])
    limits = _Limits(points, walls, *planes)
    near, moving = _neighbours(walls, len(points)), np.unique(walls)
    wish = np.zeros_like(points)
    displacement = limits.nearest(wish)
    for _ in range(_SWEEPS):
        wish[moving] = (near @ displacement)[moving]
        displacement[moving] = limits.nearest(wish)[moving]
    return np.split(displacement, starts[1:])


def _facets(surface: Surface, moving: Collection[Facet], start: int) -> tuple[Ints, Floats, Floats]:
    """Of each side of a facet: its first vertex, the facet's normal, and how far it draws back."""
    sides = np.concatenate(list(surface.outlines.values()))
    sizes = np.array([len(pairs) for pairs in surface.outlines.values()])
    first = np.cumsum(sizes) - sizes
    origin = np.repeat(surface.points[sides[first, 0]], sizes, axis=0)
    # Newell's formula asks for no order of the sides.
    spans = cross(*(surface.points[ends] - origin for ends in sides.T))
    normals = _unit(np.add.reduceat(spans, first))
    values = np.array([-1.0 if facet in moving else 0.0 for facet in surface.outlines])
    return sides[:, 0] + start, np.repeat(normals, sizes, axis=0), np.repeat(values, sizes)


def _joined(parts: Sequence[tuple[NDArray[Any], ...]]) -> Iterator[NDArray[Any]]:
    return (np.concatenate(part) for part in zip(*parts, strict=True))


def _neighbours(walls: Ints, count: int) -> csr_array:
    """What takes the mean over the vertices joined to each by a wall's triangle."""
    ends = np.concatenate([walls[:, [a, b]] for a, b in np.ndindex(3, 3) if a != b])
    near = coo_array((np.ones(len(ends)), ends.T), shape=(count, count)).tocsr()
    near.data[:] = 1 / np.repeat(np.diff(near.indptr), np.diff(near.indptr))
    return near


class _Limits:
    """What the vertices' displacements d must obey.

    Parameters
    ----------
    points
        ``(v, 3) float``.
    walls
        ``(m, 3) int``: at each corner of one with the normal n, n . d <= -1.
    vertices, normals, values
        ``(k,) int``, ``(k, 3) float``, ``(k,) float``: on facets, n . d = b.
    """

    def __init__(
        self, points: Floats, walls: Ints, vertices: Ints, normals: Floats, values: Floats
    ) -> None:
        self._points = points
        held, which = _listed(vertices, np.arange(len(vertices)), len(points))
        on = np.where(held[..., None], normals[which], 0.0)
        inverse = np.linalg.pinv(on, rcond=_FLAT)
        self._start = np.einsum("vij,vj->vi", inverse, np.where(held, values[which], 0.0))
        self._free = np.eye(3) - inverse @ on
        corners = points[walls]
        faces = _unit(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        # The rows of walls, those of one vertex after the other, and where each vertex's are.
        order = np.argsort(walls.ravel(), kind="stable")
        self._vertex = walls.ravel()[order]
        self._rows = -faces[order // 3]
        self._within = np.einsum("kj,kji->ki", self._rows, self._free[self._vertex])
        self._has, self._which = _listed(self._vertex, np.arange(len(order)), len(points))
        self._walled, self._first = np.unique(self._vertex, return_index=True)
        # What limits each vertex, and the inverse of these rows: times what they need, it is the
        # shortest displacement; turned round, times that, how much each of them pushes.
        self._limiting = np.full((len(points), 3), -1)
        self._inverse = np.zeros((len(points), 3, 3))

    def nearest(self, wish: Floats) -> Floats:
        """The displacements nearest to what is wished for.

        What limits a vertex mostly is what did the last time, and that it gives the nearest
        displacement is easily seen then; only where it does not is it sought anew.
        """
        start = self._start + np.einsum("vij,vj->vi", self._free, wish - self._start)
        need = 1 - dot(self._rows, start.take(self._vertex, axis=0))
        found, weights = self._limited(need, slice(None))
        good = np.asarray((weights >= -_EXACT).all(axis=1))
        left = need - dot(self._within, found.take(self._vertex, axis=0))
        good[self._walled] &= np.maximum.reduceat(left, self._first) < _EXACT
        if (wrong := np.flatnonzero(~good)).size:
            has, which = self._has[wrong], self._which[wrong]
            rows = np.where(has[..., None], self._within.take(which, axis=0), 0.0)
            places, exists = nearest_points(rows, np.where(has, need.take(which), 0.0))
            if not exists.all():
                x, y, z = self._points[wrong[~exists][0]]
                msg = (
                    f"a wall runs along an edge of the ring near ({x:.3f}, {y:.3f}, {z:.3f}) "
                    "sides: no clearance is possible there; another amplitude or bend helps"
                )
                raise GeometryError(msg)
            there = places >= 0
            limiting = np.take_along_axis(which, places, axis=1)
            self._limiting[wrong] = np.where(there, limiting, -1)
            self._inverse[wrong] = _inverse(
                np.where(there[..., None], self._within.take(limiting, axis=0), 0.0)
            )
            found[wrong], _ = self._limited(need, wrong)
        return np.asarray(start + found)

    def _limited(self, need: Floats, some: Ints | slice) -> tuple[Floats, Floats]:
        """By how much some vertices move if they are limited as they were, and what pushes them."""
        limiting = self._limiting[some]
        wanted = np.where(limiting < 0, 0.0, need.take(limiting))
        inverse = self._inverse[some]
        found = np.einsum("vij,vj->vi", inverse, wanted)
        return found, np.einsum("vij,vi->vj", inverse, found)


def _inverse(rows: Floats) -> Floats:
    """Pseudo-inverses of three rows each, ``(k, 3, 3)``, that are independent but for zeros.

    A column is what is left of a row across the other two, over its square.
    """
    ahead, behind = rows[:, [1, 2, 0]], rows[:, [2, 0, 1]]
    both = np.asarray(ahead.any(axis=2) & behind.any(axis=2))
    # Along what is across two others, or else without what is along the only one.
    left = np.where(
        both[..., None],
        _along(rows, cross(ahead, behind)),
        rows - _along(rows, ahead + behind),
    )
    return np.asarray((left / _square(left)[..., None]).swapaxes(1, 2))


def _along(rows: Floats, axes: Floats) -> Floats:
    """The parts of rows along axes; none along zero."""
    share = np.einsum("...d,...d->...", rows, axes) / _square(axes)
    return np.asarray(share[..., None] * axes)


def _square(rows: Floats) -> Floats:
    square = np.einsum("...d,...d->...", rows, rows)
    return np.asarray(np.maximum(square, np.finfo(float).tiny))


def _unit(normals: Floats) -> Floats:
    return np.asarray(normals / np.linalg.norm(normals, axis=1)[:, None])


def _listed(vertices: Ints, what: Ints, count: int) -> tuple[NDArray[np.bool_], Ints]:
    """What each vertex has, ``(count, most)``: whether there is one, and which."""
    order = np.argsort(vertices, kind="stable")
    size = np.bincount(vertices, minlength=count)
    has = np.arange(size.max(initial=0)) < size[:, None]
    which = np.zeros(has.shape, dtype=np.int64)
    which[has] = what[order]
    return has, which
