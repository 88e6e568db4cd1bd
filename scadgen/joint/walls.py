"""Walls between the Voronoi cells of the site curves, as polygons on shared vertices.

The nodes of the lattice are labelled with their nearest curve.  Every lattice edge between
two labels is crossed by a wall; the wall is the polygon through the cells around that edge,
one vertex a cell.  A cell's vertex is the point where the curves it sees are equally far
(a Newton step or two from the middle of its crossings), so the vertices lie on the exact
walls, and neighbouring polygons share them by index: the cells partition the domain, and
the same polygon bounds both of its connectors.

Where a lattice face lies on the domain's boundary, or on the vertical plane through an edge
along which its connector may be split, it has a vertex of its own, and the polygon ends
there; where two such planes meet, so has the lattice edge.  This is the dual of the labelled
lattice (S. F. Frisken Gibson's constrained elastic surface nets, 1998, made exact on the
boundary and for any number of labels).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from scadgen.joint.lattice import Lattice
from scadgen.solid.affine import Ints

__all__ = ["Border", "Facet", "Feature", "Wedge", "facet_of_face", "wedges"]

#: A vertex: what it stands for (``node``, ``edge``, ``face``, ``cell``), an axis, an index.
Feature = tuple[str, int, int, int, int]

#: A plane of the domain's boundary or of a split: its kind and number.
Facet = tuple[str, int]

#: A side of a polygon on a facet: the facet, the side's start and end.
Border = tuple[Facet, Feature, Feature]


class Wedge(NamedTuple):
    """One polygon of a wall.

    Parameters
    ----------
    low, high
        The labels on either side; the polygon is counter-clockwise seen from `high`.
    corners
        Its vertices.
    borders
        Those of its sides that lie on a facet: the facet, and the side's start and end.
    sector
        Index of an angular cell that it lies in.
    """

    low: int
    high: int
    corners: tuple[Feature, ...]
    borders: tuple[Border, ...]
    sector: int


def facet_of_face(lattice: Lattice, axis: int, index: tuple[int, int, int]) -> Facet | None:
    """The facet that a lattice face lies on, if any."""
    i, j, k = index
    if axis == 0:
        edge = lattice.edge_at.get(i)
        return None if edge is None else ("split", edge)
    side = (j, k)[axis - 1]
    if side == 0:
        return ("inner", int(lattice.strips[0, i])) if axis == 1 else ("bottom", 0)
    if side == lattice.nodes.shape[axis] - 1:
        return ("outer", int(lattice.strips[1, i])) if axis == 1 else ("top", 0)
    return None


def wedges(lattice: Lattice, labels: Ints) -> Iterator[Wedge]:
    """All polygons of all walls.

    Parameters
    ----------
    lattice
        The lattice.
    labels
        ``(planes, radii, heights) int``, each node's nearest curve.
    """
    for axis in range(3):
        after = np.roll(labels, -1, axis)
        crossed = labels != after
        if axis:  # only the angle closes on itself
            np.moveaxis(crossed, axis, 0)[-1] = False
        for i, j, k in np.argwhere(crossed).tolist():
            low, high = int(labels[i, j, k]), int(after[i, j, k])
            for corners, borders, sector in _around(lattice, axis, (i, j, k)):
                yield Wedge(low, high, corners, borders, sector)


def _around(
    lattice: Lattice, axis: int, index: tuple[int, int, int]
) -> Iterator[tuple[tuple[Feature, ...], tuple[Border, ...], int]]:
    """Polygons through the cells around one lattice edge, counter-clockwise from its end.

    The four cells around the edge, and the four faces between them, are walked in a circle;
    each run of cells between two faces that lie on facets is a polygon.
    """
    b, c = (axis + 1) % 3, (axis + 2) % 3
    if _is_inside(lattice, axis, index):
        cells = [_cell(lattice, _moved(lattice, index, move)) for move in ({b: -1}, {}, {c: -1})]
        cells.append(_cell(lattice, _moved(lattice, index, {b: -1, c: -1})))
        corners = tuple(cell for cell in cells if cell)
        yield corners, (), corners[0][2]
        return
    # In this order: clockwise from the edge's end, for the lattice's axes are left-handed.
    circle = [
        (_cell(lattice, _moved(lattice, index, {b: db, c: dc})), face, facet)
        for db, dc, normal, move in (
            (-1, -1, b, {c: -1}),
            (0, -1, c, {}),
            (0, 0, b, {}),
            (-1, 0, c, {b: -1}),
        )
        for face, facet in [_face(lattice, normal, _moved(lattice, index, move))]
    ]
    first = next(n for n, (_, _, facet) in enumerate(circle) if facet)
    flat = len({facet for _, _, facet in circle if facet}) == 1
    middle: tuple[Feature, ...] = () if flat else (("edge", axis, *index),)
    _, end, end_facet = circle[first]
    run: list[Feature] = []
    for cell, face, facet in circle[first + 1 :] + circle[: first + 1]:
        if cell:
            run.append(cell)
        if facet and end_facet:
            if run:
                corners = (face, *reversed(run), end, *middle)
                yield corners, _borders(corners, facet, end_facet), run[0][2]
            end, end_facet, run = face, facet, []


def _is_inside(lattice: Lattice, axis: int, index: tuple[int, int, int]) -> bool:
    """Whether no face at a lattice edge lies on a facet."""
    _, radii, heights, _ = lattice.nodes.shape
    i, j, k = index
    return (
        (axis == 0 or i not in lattice.edge_at)
        and (axis == 1 or 0 < j < radii - 1)
        and (axis == 2 or 0 < k < heights - 1)
    )


def _borders(corners: tuple[Feature, ...], first: Facet, last: Facet) -> tuple[Border, ...]:
    """Sides of a polygon on facets: it starts on `first`; its last face lies on `last`."""
    if corners[-1][0] == "face":
        return ((first, corners[-1], corners[0]),)
    return ((last, corners[-2], corners[-1]), (first, corners[-1], corners[0]))


def _moved(
    lattice: Lattice, index: tuple[int, int, int], move: dict[int, int]
) -> tuple[int, int, int]:
    """An index moved along some axes; the angle closes on itself."""
    i, j, k = (n + move.get(axis, 0) for axis, n in enumerate(index))
    return i % len(lattice.planes), j, k


def _cell(lattice: Lattice, index: tuple[int, int, int]) -> Feature | None:
    """The cell with this lowest node, if it is in the domain."""
    _, radii, heights, _ = lattice.nodes.shape
    inside = 0 <= index[1] < radii - 1 and 0 <= index[2] < heights - 1
    return ("cell", 0, *index) if inside else None


def _face(
    lattice: Lattice, normal: int, index: tuple[int, int, int]
) -> tuple[Feature, Facet | None]:
    """The face square to an axis with this lowest node, and the facet it lies on."""
    limits = lattice.nodes.shape
    inside = all(0 <= index[n] < limits[n] - (n != normal) for n in (1, 2))
    facet = facet_of_face(lattice, normal, index) if inside else None
    return ("face", normal, *index), facet
