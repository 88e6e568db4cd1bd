"""The closed surface of a connector or of a half: curved walls and flat facets.

Facets are kept as directed outlines, not as triangles, so that later stages can cut
windows into them, glue surfaces together, and triangulate once at the end.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from scadgen.errors import GeometryError, InvariantError
from scadgen.joint.walls import Facet
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.vectors import cross

__all__ = ["Surface", "chain", "half_turn", "join", "simplify"]

#: Two vertices on a cut closer than this, in sides, are one.
_SAME = 1e-9


#: Shapes are the same within this, in sides: far below what is printed.
_ALIKE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A closed surface, in sides, with the connector's edge along +x.

    Parameters
    ----------
    points
        ``(v, 3) float``.
    walls
        ``(m, 3) int``: triangles of the curved walls, counter-clockwise from outside.
    outlines
        For each facet, ``(k, 2) int``: directed sides around it, counter-clockwise seen
        from outside (clockwise around its holes).
    """

    points: Floats
    walls: Ints
    outlines: Mapping[Facet, Ints]

    def loops(self, facet: Facet) -> list[list[int]]:
        """Closed outlines of a facet."""
        return chain(self.outlines[facet])

    def match(self, other: Surface) -> Ints | None:
        """The number of each vertex in another surface, if that is the same shape.

        Parameters
        ----------
        other
            The other surface, which may be numbered in any way.

        Returns
        -------
        match
            ``(v,) int``; None if it is another shape.
        """
        sizes = [(len(one.points), len(one.walls), set(one.outlines)) for one in (self, other)]
        if sizes[0] != sizes[1]:
            return None
        far, found = cKDTree(other.points).query(self.points)
        match = np.asarray(found)
        if np.max(far) > _ALIKE or len(np.unique(match)) < len(match):
            return None
        same = _same_rows(_cycles(match[self.walls]), _cycles(other.walls)) and all(
            _same_rows(match[sides], other.outlines[facet])
            for facet, sides in self.outlines.items()
        )
        return match if same else None


def _cycles(triangles: Ints) -> Ints:
    """Triangles, each with its lowest corner first."""
    corners = (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3
    return np.take_along_axis(triangles, corners, axis=1)


def _same_rows(ours: Ints, theirs: Ints) -> bool:
    """Whether two tables have the same rows in some order."""
    return sorted(ours.tolist()) == sorted(theirs.tolist())


def chain(sides: Ints) -> list[list[int]]:
    """Closed loops that directed sides make up.

    Raises
    ------
    GeometryError
        They do not close, or a vertex is passed twice: the wall touches itself there.
    """
    after = dict(sides.tolist())
    if len(after) != len(sides) or set(after) != set(after.values()):
        msg = "a wall touches itself on the ring's face: its weave is too fine for this detail"
        raise GeometryError(msg)
    loops = []
    while after:
        start, vertex = after.popitem()
        loop = [start]
        while vertex != start:
            loop.append(vertex)
            vertex = after.pop(vertex)
        loops.append(loop)
    return loops


def _compact(points: Floats, walls: Ints, outlines: Mapping[Facet, Ints]) -> Surface:
    """A surface without the points that nothing uses."""
    arrays = [walls.ravel(), *(sides.ravel() for sides in outlines.values())]
    used, inverse = np.unique(np.concatenate(arrays), return_inverse=True)
    parts = np.split(inverse, np.cumsum([a.size for a in arrays])[:-1])
    sides = {f: part.reshape(-1, 2) for f, part in zip(outlines, parts[1:], strict=True)}
    return Surface(points[used], parts[0].reshape(-1, 3), sides)


def simplify(surface: Surface) -> Surface:
    """Drop the vertices inside straight edges between two facets."""
    facets_at = np.zeros(len(surface.points), dtype=np.intp)
    for sides in surface.outlines.values():
        facets_at[sides[:, 0]] += 1
    facets_at[surface.walls] = 0
    for sides in surface.outlines.values():
        facets_at[_turns(surface.points, sides)] = 0
    spare = set(np.flatnonzero(facets_at == 2).tolist())
    outlines = {}
    for facet in surface.outlines:
        loops = [[v for v in loop if v not in spare] for loop in surface.loops(facet)]
        outlines[facet] = _sides(loops)
    return _compact(surface.points, surface.walls, outlines)


def _turns(points: Floats, sides: Ints) -> Ints:
    """The vertices at which an outline turns."""
    after = dict(sides.tolist())
    middle = sides[:, 1]
    ahead = points[[after[vertex] for vertex in middle.tolist()]] - points[middle]
    behind = points[middle] - points[sides[:, 0]]
    return np.asarray(middle[np.linalg.norm(cross(behind, ahead), axis=1) > _SAME])


def _sides(loops: Iterable[list[int]]) -> Ints:
    pairs = [pair for loop in loops for pair in zip(loop, loop[1:] + loop[:1], strict=True)]
    return np.array(pairs, dtype=int).reshape(-1, 2)


def half_turn(surface: Surface) -> Surface:
    """The surface after a half turn about its edge, which makes half B of half A."""
    swap = {"top": "bottom", "bottom": "top"}
    outlines = {
        (swap.get(kind, kind), -number): sides for (kind, number), sides in surface.outlines.items()
    }
    return Surface(surface.points * [1.0, -1.0, -1.0], surface.walls, outlines)


def join(first: Surface, second: Surface, cut: Facet) -> Surface:
    """Glue two surfaces along a facet that both have, and take it away.

    Raises
    ------
    InvariantError
        The two outlines of the facet differ.
    """
    ours, theirs = (np.unique(s.outlines[cut]) for s in (first, second))
    offset = len(first.points)
    gap, match = cKDTree(first.points[ours]).query(second.points[theirs])
    if len(ours) != len(theirs) or len(np.unique(match)) != len(ours) or np.max(gap) > _SAME:
        msg = "halves do not meet: the two outlines of the split differ"
        raise InvariantError(msg)
    renumber = np.arange(len(second.points)) + offset
    renumber[theirs] = ours[match]
    outlines: dict[Facet, Ints] = {}
    for facet in sorted({*first.outlines, *second.outlines} - {cut}):
        sides = [
            first.outlines.get(facet, np.empty((0, 2), dtype=int)),
            renumber[second.outlines.get(facet, np.empty((0, 2), dtype=int))],
        ]
        outlines[facet] = _without_opposites(np.concatenate(sides))
    return _compact(
        np.concatenate([first.points, second.points]),
        np.concatenate([first.walls, renumber[second.walls]]),
        outlines,
    )


def _without_opposites(sides: Ints) -> Ints:
    """Sides less those that occur in both directions."""
    both = {tuple(s) for s in sides.tolist()}
    kept = [s for s in sides.tolist() if (s[1], s[0]) not in both]
    return np.array(kept, dtype=int).reshape(-1, 2)
