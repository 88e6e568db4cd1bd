"""Periodic tilings: cells in rows and columns, or as many tiles as lie inside an outline.

Frames have whole tiles, so that no edge dangles at the rim.  With rows and columns a frame has
that many whole cells.  Within an outline it has every tile that lies inside, and of these the
largest group that hangs together by edges: tiles that touch the others in a corner only would
swing there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Unpack

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.plane.area import (
    MOST_TILES,
    STICK_OUT,
    Area,
    check_count,
    cover,
    lies_inside,
    outline_of,
    positive,
)
from scadgen.plane.cells import Cell
from scadgen.plane.drawn import canonical_order, make_frame
from scadgen.solid.affine import Floats, Ints

__all__ = ["Block", "Motif", "Tiling"]

#: Rounding of what is counted in whole cells.
_ROUNDING = 1e-6

#: A cell, counted from the first one: across and up.
Place = tuple[int, int]

#: An end of an edge: a vertex of the motif, and the cell that it is in.
_End = tuple[int, Place]


@dataclass(frozen=True, slots=True)
class Motif:
    """What of a tiling repeats: its vertices and edges, each once.

    Parameters
    ----------
    vertices
        Of each vertex the cells that have it, as seen from its own: it is there if any of them
        is.
    edges
        Of each edge its two ends, as a number of a vertex and the cell that is in, the first in
        the edge's own cell; and the cells that have it.
    """

    vertices: tuple[tuple[Place, ...], ...]
    edges: tuple[tuple[_End, _End, tuple[Place, ...]], ...]


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """Cells in rows and columns.

    Parameters
    ----------
    tiling
        Whose cells they are.
    frame
        The frame of their tiles' sides.
    vertex_of
        ``(n, 3) int``: of each of its vertices the number in the tiling's motif, and the cell
        it is in, across and up.
    """

    tiling: Tiling
    frame: Frame
    vertex_of: Ints

    def scaled(self, factor: float) -> Block:
        """The same cells, some times as large."""
        tiling = replace(self.tiling, edge_length=self.tiling.edge_length * factor)
        points = self.frame.plan * factor
        frame = make_frame(self.frame.name, points, self.frame.edges)
        return Block(tiling, frame, self.vertex_of[canonical_order(points)])

    @property
    def edges(self) -> list[tuple[int, Place]]:
        """Of each edge its number in the tiling's motif, and its cell."""
        number = {(one, other): n for n, (one, other, _) in enumerate(self.tiling.motif.edges)}
        at = [(kind, (i, j)) for kind, i, j in self.vertex_of.tolist()]
        found = []
        for first, second in self.frame.edges.tolist():
            edge, cell = _in_motif(at[first], at[second])
            found.append((number[edge], cell))
        return found


@dataclass(frozen=True, eq=False)
class Tiling:
    """A tiling of the plane whose cells have a size.

    Parameters
    ----------
    name
        What to call its frames.
    cell
        The cell that repeats.
    edge_length
        Length of its shortest edges, in mm.
    lean
        Whether rows follow the cell's second move as it is; otherwise they are moved back by
        whole cells, so that they stand above one another.

    Raises
    ------
    InputError
        A length that is not positive.
    """

    name: str
    cell: Cell
    edge_length: float
    lean: bool = False

    def __post_init__(self) -> None:
        """Refuse a length that is none."""
        positive("edge_length", self.edge_length)

    @cached_property
    def basis(self) -> Floats:
        """``(b, 2) float``: what the cell's whole numbers count, in mm; a row goes along x."""
        across = self.cell.moves[0] @ self.cell.basis
        turn = np.array([[across[0], -across[1]], [across[1], across[0]]]) / np.hypot(*across)
        return np.asarray(self.edge_length * self.cell.basis @ turn)

    @property
    def moves(self) -> Floats:
        """``(2, 2) float``: the cell's two moves, in mm."""
        return np.asarray(self.cell.moves @ self.basis)

    @property
    def drift(self) -> float:
        """By how many cells each row is moved back, as far as these are whole."""
        across, up = self.cell.moves @ self.cell.basis
        return 0.0 if self.lean else float(up @ across / (across @ across))

    def block(self, rows: int, columns: int) -> Block:
        """Cells in rows and columns.

        Raises
        ------
        InputError
            Counts that are not whole numbers from 1 on, or too many tiles.
        """
        points, edges, _ = _outlines(self._tiles(self._in_rows(rows, columns)))
        frame = make_frame(self.name, points @ self.basis, _unique(edges))
        ordered = points[canonical_order(points @ self.basis)]
        kinds = {kind: number for number, kind in enumerate(self._kinds)}
        homes = [self._home(point) for point in ordered]
        found = [(kinds[kind], *place) for kind, place in homes]
        return Block(self, frame, np.array(found, dtype=np.int64))

    def fill(self, **area: Unpack[Area]) -> Frame:
        """The frame that fills an area with whole tiles.

        Raises
        ------
        InputError
            An area that is not one of those that `Area` says, or too small for one tile.
        """
        shape, middle = outline_of(area)
        if shape is None:
            return self.block(area.get("rows", 3), area.get("columns", 3)).frame
        basis = self.basis
        origin = middle - (self.cell.tiles[0] @ basis).mean(axis=0)
        tiles = self._tiles(cover(self.cell, basis, origin, shape))
        margin = STICK_OUT * self.edge_length
        kept = [lies_inside(t @ basis + origin, shape, margin) for t in tiles]
        tiles = [t[inside] for t, inside in zip(tiles, kept, strict=True)]
        if not any(map(len, tiles)):
            msg = (
                f"{self.name}: no tile with edges of {self.edge_length:g} mm fits inside the "
                "outline; a larger one or shorter edges work"
            )
            raise InputError(msg)
        points, edges, tile_of = _outlines(tiles)
        used, numbers = np.unique(_largest_group(edges, tile_of), return_inverse=True)
        return make_frame(self.name, points[used] @ basis + origin, _unique(numbers.reshape(-1, 2)))

    @cached_property
    def motif(self) -> Motif:
        """What of it repeats."""
        kinds = {kind: number for number, kind in enumerate(self._kinds)}
        vertices: list[set[Place]] = [set() for _ in kinds]
        edges: dict[tuple[_End, _End], set[Place]] = {}
        for tile in self.cell.tiles:
            ends = [(kinds[kind], place) for kind, place in map(self._home, tile)]
            for vertex, (i, j) in ends:
                vertices[vertex].add((-i, -j))
            for one, other in zip(ends, ends[1:] + ends[:1], strict=True):
                edge, (i, j) = _in_motif(one, other)
                edges.setdefault(edge, set()).add((-i, -j))
        return Motif(
            tuple(tuple(sorted(cells)) for cells in vertices),
            tuple((*edge, tuple(sorted(cells))) for edge, cells in sorted(edges.items())),
        )

    @cached_property
    def _kinds(self) -> list[tuple[int, ...]]:
        """The vertices of a cell, in whole numbers."""
        corners = np.concatenate(self.cell.tiles)
        return sorted({self._home(corner)[0] for corner in corners})

    def _home(self, point: Ints) -> tuple[tuple[int, ...], Place]:
        """A vertex as the one of the first cell that it repeats, in whole numbers; its cell."""
        to_cells = np.linalg.inv(self.cell.moves @ self.cell.basis)
        i, j = np.floor(point @ self.cell.basis @ to_cells + _ROUNDING).astype(np.int64).tolist()
        return tuple((point - np.array([i, j]) @ self.cell.moves).tolist()), (i, j)

    def _in_rows(self, rows: int, columns: int) -> Ints:
        """Which cells stand in rows and columns, as ``(n, 2)`` counts of the two moves."""
        for name, value in (("rows", rows), ("columns", columns)):
            if not 1 <= value <= MOST_TILES or value % 1:
                msg = f"{name} = {value!r}: must be a whole number from 1 to {MOST_TILES}"
                raise InputError(msg)
        check_count(rows * columns * len(self.cell.tiles))
        row, column = np.divmod(np.arange(rows * columns), columns)
        back = np.floor(row * self.drift + _ROUNDING).astype(np.int64)
        return np.stack([column - back, row], axis=1)

    def _tiles(self, places: Ints) -> list[Ints]:
        """The tiles of some cells, in whole numbers."""
        moved = places @ self.cell.moves
        return [tile + moved[:, None] for tile in self.cell.tiles]


def _in_motif(one: _End, other: _End) -> tuple[tuple[_End, _End], Place]:
    """An edge moved so that its first end is in the first cell, and the cell that this is in."""
    options = []
    for near, far in ((one, other), (other, one)):
        (first, (i, j)), (second, (k, m)) = near, far
        options.append((((first, (0, 0)), (second, (k - i, m - j))), (i, j)))
    return min(options)


def _unique(edges: Ints) -> Ints:
    """Edges, each once."""
    return np.unique(np.sort(edges, axis=1), axis=0)


def _outlines(tiles: list[Ints]) -> tuple[Ints, Ints, Ints]:
    """All corners, each once; the sides of all tiles as pairs of them; whose side it is."""
    corners = np.concatenate([t.reshape(-1, t.shape[-1]) for t in tiles])
    points, number = np.unique(corners, axis=0, return_inverse=True)
    number = number.ravel()
    sides, tile_of, at, count = [], [], 0, 0
    for tile in tiles:
        ring = number[at : at + tile.shape[0] * tile.shape[1]].reshape(tile.shape[:2])
        sides.append(np.stack([ring, np.roll(ring, -1, axis=1)], axis=-1).reshape(-1, 2))
        tile_of.append(np.repeat(np.arange(count, count + len(tile)), tile.shape[1]))
        at, count = at + ring.size, count + len(tile)
    return points, np.sort(np.concatenate(sides), axis=1), np.concatenate(tile_of)


def _largest_group(sides: Ints, tile_of: Ints) -> Ints:
    """Sides of the largest group of tiles that hang together by sides; the first of equals."""
    _, edge = np.unique(sides, axis=0, return_inverse=True)
    tiles = int(tile_of.max()) + 1
    size = tiles + int(edge.max()) + 1
    graph = coo_array((np.ones(len(sides)), (tile_of, tiles + edge.ravel())), shape=(size, size))
    label = connected_components(graph, directed=False)[1][:tiles]
    return np.asarray(sides[label[tile_of] == np.bincount(label).argmax()])
