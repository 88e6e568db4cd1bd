"""Connectors and halves out of the walls.

A connector's surface is the walls between its label and others, and the parts of the
domain's facets that carry its label.  It is cut open along the vertical plane through its
edge, which gives the two halves.
"""

from __future__ import annotations

import itertools
import math
from collections import defaultdict
from collections.abc import Iterator, Sequence

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from scadgen.errors import GeometryError
from scadgen.joint.footing import LEDGE, SPLIT, TUBE, with_footing
from scadgen.joint.lattice import Lattice
from scadgen.joint.surface import Surface, simplify
from scadgen.joint.walls import Facet, Feature, Wedge, facet_of_face
from scadgen.solid.affine import Floats, Ints

__all__ = ["LEDGE", "PAD", "SPLIT", "TUBE", "halves"]

#: The facet opposite the tube.
PAD: Facet = ("inner", 0)

_Index = tuple[int, int, int]

#: A vertex of the cut-open surface: its key, and the side of the cut for those on it.
_Sided = tuple[Feature, int]


def halves(
    lattice: Lattice,
    labels: Ints,
    walls: Sequence[Wedge],
    position: dict[Feature, Floats],
    edge: int,
) -> tuple[Surface, Surface]:
    """Half A (counter-clockwise of its edge) and half B of one connector.

    Parameters
    ----------
    lattice, labels
        The lattice and its nodes' labels.
    walls
        All polygons of all walls.
    position
        Where each vertex of a wall is, in sides.
    edge
        Number of the connector's edge.

    Raises
    ------
    GeometryError
        The connector falls apart, or its halves hang together.
    """
    cut = _Cut(lattice, labels, edge)
    polygons: list[tuple[_Sided, ...]] = []
    sides: dict[Facet, list[tuple[_Sided, _Sided]]] = defaultdict(list)
    for wedge in walls:
        if edge in (wedge.low, wedge.high):
            polygons.append(cut.wall(wedge))
            for facet, start, stop in cut.wall_borders(wedge):
                sides[facet].append((start, stop))
    for facet, start, stop in cut.domain_sides():
        sides[facet].append((start, stop))
    names = sorted(
        {v for corners in polygons for v in corners}.union(*itertools.chain(*sides.values()))
    )
    number = {name: n for n, name in enumerate(names)}
    points = [lattice.nodes[k[2:]] if k[0] == "node" else position[k] for k, _ in names]
    spokes = lattice.domain.spokes
    parts = _parted(polygons, sides, number, np.array(points), float(spokes.azimuths[edge]))
    if spokes.level(edge):
        return parts
    slope, (x, y, z) = float(spokes.slopes[edge]), lattice.domain.tube_face(edge).at
    middle = np.array([math.hypot(x, y), 0.0, z])
    first, second = (
        with_footing(part, slope, middle, sign)
        for part, sign in zip(parts, (1.0, -1.0), strict=True)
    )
    return first, second


class _Cut:
    """One label's surface, cut open along the plane through its edge.

    Each vertex on that plane exists twice; which of the two a polygon or a side takes is
    told by the angular cell it lies in.
    """

    def __init__(self, lattice: Lattice, labels: Ints, edge: int) -> None:
        self._lattice = lattice
        self._label = edge
        self._plane = int(lattice.edge_planes[edge])
        # The planes on which the label is, and those before them.
        mine = labels == edge
        here = mine.any(axis=(1, 2))
        self._planes = np.flatnonzero(here | np.roll(here, -1)).tolist()
        self._mine: list[list[list[bool]]] = mine.tolist()
        self._firsts: list[list[int]] = lattice.firsts.tolist()
        # Of the inner side's flat faces and the outer's: how many there are, and the connector's.
        self._faces = [(int(lattice.strips[n].max()) + 1, lattice.flat(n, edge)) for n in (0, 1)]

    def _sided(self, key: Feature, cell: int) -> _Sided:
        kind, axis, i, _, _ = key
        on_plane = i == self._plane and (
            kind == "node" or (kind == "edge" and axis != 0) or (kind == "face" and axis == 0)
        )
        return key, (1 if cell == self._plane else -1) if on_plane else 0

    def _facet(self, facet: Facet, cell: int) -> Facet | None:
        """The facet under the connector's own numbering; none for another edge's plane."""
        kind, number = facet
        if kind == "split":
            own = number == self._label
            return ("split", 1 if cell == self._plane else -1) if own else None
        if kind in ("top", "bottom"):
            return facet
        count, ahead = self._faces[kind == "outer"]
        return kind, (number - ahead + count // 2) % count - count // 2

    def wall(self, wedge: Wedge) -> tuple[_Sided, ...]:
        """A wall's polygon, counter-clockwise from outside, with the same first corner."""
        corners = tuple(self._sided(key, wedge.sector) for key in wedge.corners)
        return corners if wedge.low == self._label else (corners[0], *corners[:0:-1])

    def wall_borders(self, wedge: Wedge) -> Iterator[tuple[Facet, _Sided, _Sided]]:
        """Those sides of the connector's facets that are a wall's borders."""
        for found, start, stop in wedge.borders:
            facet = self._facet(found, wedge.sector)
            if facet:
                ends = self._sided(stop, wedge.sector), self._sided(start, wedge.sector)
                yield facet, *(ends if wedge.low == self._label else ends[::-1])

    def domain_sides(self) -> Iterator[tuple[Facet, _Sided, _Sided]]:
        """Those sides of the connector's facets that are edges of the domain or the cut."""
        for axis, index, faces in self._domain_edges():
            ends = self._part_of_edge(axis, index)
            if ends is None:
                continue
            for normal, face, cell in faces:
                facet = self._facet(facet_of_face(self._lattice, normal, face) or SPLIT, cell)
                if facet:
                    ahead = self._runs_ahead(axis, index, normal, face, cell)
                    start, stop = ends if ahead else ends[::-1]
                    yield facet, self._sided(start, cell), self._sided(stop, cell)

    def _runs_ahead(self, axis: int, index: _Index, normal: int, face: _Index, cell: int) -> bool:
        """Whether a facet's outline runs along a lattice edge as its axis does.

        It does if the way out of the connector, the edge's axis and the way from the edge into
        the face are a right-handed frame; the lattice's axes are a left-handed one.
        """
        out = cell != self._plane if normal == 0 else face[normal] > 0
        into = 3 - axis - normal
        inside = cell == index[0] if into == 0 else face[into] == index[into]
        even = (axis - normal) % 3 == 1
        return (out == inside) != even

    def _part_of_edge(self, axis: int, index: _Index) -> tuple[Feature, Feature] | None:
        """The ends of that part of a lattice edge that carries the label."""
        i, j, k = index
        if axis == 0:
            i = (i + 1) % len(self._mine)
        elif axis == 1:
            j += 1
        else:
            k += 1
        mine, mine_after = self._mine[index[0]][index[1]][index[2]], self._mine[i][j][k]
        if not (mine or mine_after):
            return None
        start, stop = self._node(*index), self._node(i, j, k)
        if start == stop:
            return None
        middle: Feature = ("edge", axis, *index)
        return start if mine else middle, stop if mine_after else middle

    def _node(self, i: int, j: int, k: int) -> Feature:
        """A node by its first index: where the outside leans several may be in one place."""
        if j == len(self._mine[0]) - 1 and k in (0, len(self._mine[0][0]) - 1):
            i = self._firsts[i][k > 0]
        return "node", 0, i, j, k

    def _domain_edges(self) -> Iterator[tuple[int, _Index, list[tuple[int, _Index, int]]]]:
        """Lattice edges between two facets, near the label: axis, index, faces.

        A face is told by its normal, its index, and the cell that it is of.
        """
        planes, radii, heights = (n - 1 for n in self._lattice.nodes.shape[:3])
        planes += 1
        for i, j, k in itertools.product(self._planes, (0, radii), (0, heights)):
            across, down = min(j, radii - 1), min(k, heights - 1)
            yield 0, (i, j, k), [(1, (i, j, down), i), (2, (i, across, k), i)]
        strips = self._lattice.strips
        for i, j, k in itertools.product(self._planes, (0, radii), range(heights)):
            if strips[min(j, 1), i] != strips[min(j, 1), i - 1]:
                before = (i - 1) % planes
                yield 2, (i, j, k), [(1, (before, j, k), before), (1, (i, j, k), i)]
        own = self._plane
        for cell in (own, (own - 1) % planes):
            for j, k in itertools.product((0, radii), range(heights)):
                beside = (0, (own, min(j, radii - 1), k), cell)
                yield 2, (own, j, k), [beside, (1, (cell, j, k), cell)]
            for j, k in itertools.product(range(radii), (0, heights)):
                beside = (0, (own, j, min(k, heights - 1)), cell)
                yield 1, (own, j, k), [beside, (2, (cell, j, k), cell)]


def _parted(
    polygons: Sequence[tuple[_Sided, ...]],
    sides: dict[Facet, list[tuple[_Sided, _Sided]]],
    number: dict[_Sided, int],
    points: Floats,
    angle: float,
) -> tuple[Surface, Surface]:
    """Tell the two halves apart."""
    c, s = np.cos(angle), np.sin(angle)
    points = points @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    walls = ([number[v] for v in corners] for corners in polygons)
    triangles = np.array([t for corners in walls for t in _fan(corners)], dtype=int).reshape(-1, 3)
    outlines = {
        facet: np.array([(number[a], number[b]) for a, b in pairs], dtype=int)
        for facet, pairs in sorted(sides.items())
    }
    links = np.concatenate([triangles[:, :2], triangles[:, 1:], *outlines.values()])
    graph = coo_matrix((np.ones(len(links)), links.T), shape=(len(points), len(points)))
    count, part = connected_components(graph, directed=False)
    of_side = [
        {int(part[number[v]]) for v in itertools.chain(*sides.get(("split", side), ()))}
        for side in (1, -1)
    ]
    if of_side[0] & of_side[1]:
        msg = "the halves of a connector hang together behind the ring's hole; a smaller span helps"
        raise GeometryError(msg)
    if count != 2 or len(of_side[0]) != 1 or len(of_side[1]) != 1:
        msg = (
            f"a connector falls apart into {count - 1} pieces; "
            "a smaller amplitude or fewer periods help"
        )
        raise GeometryError(msg)
    first, second = (
        _component(points, triangles, outlines, part == found.pop()) for found in of_side
    )
    return simplify(first), simplify(second)


def _component(points: Floats, walls: Ints, outlines: dict[Facet, Ints], mine: Ints) -> Surface:
    """The part of a surface on the chosen vertices, its split facet under one name."""
    kept = {
        SPLIT if facet[0] == "split" else facet: sides[mine[sides[:, 0]]]
        for facet, sides in outlines.items()
        if mine[sides[:, 0]].any()
    }
    return Surface(points, walls[mine[walls[:, 0]]], kept)


def _fan(corners: Sequence[int]) -> list[tuple[int, int, int]]:
    """Triangles of a polygon, all from its first corner."""
    return [(corners[0], a, b) for a, b in itertools.pairwise(corners[1:])]
