"""From a block of a tiling to the table of what stands in one cell."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np

from scadgen.errors import InvariantError
from scadgen.frame.placement import Placement
from scadgen.kit.arrangement import Arrangement
from scadgen.kit.cells import Cell, CellEnd, CellPiece, Cells, CellVertex
from scadgen.plane.periodic import Block
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Pose

__all__ = ["cells_of"]

#: Decimals of a position in edge lengths, and to which axes are the same.
_DECIMALS, _AXES = 9, 6


def cells_of(places: Arrangement, block: Block, unit: float) -> Cells | None:
    """What stands in each cell of a tiling.

    A vertex at the rim of the block gets what a vertex inside has.

    Parameters
    ----------
    places
        What stands in a block of it.
    block
        The block.
    unit
        The edge length, in mm.

    Returns
    -------
    cells
        None if not all cells are alike, because other keys were chosen in some.
    """
    found = _Repeat(places, block, unit)
    return found.cells() if found.is_alike else None


class _Repeat:
    """The vertices and edges of a block that stand for all that are alike."""

    def __init__(self, places: Arrangement, block: Block, unit: float) -> None:
        self._places, self._block, self._motif = places, block, block.tiling.motif
        self._unit = unit
        self._cell_of: list[Cell] = [(i, j) for _, i, j in block.vertex_of.tolist()]
        self._edges = block.edges
        count = len(self._motif.vertices)
        degree = np.bincount([end for a, b, _ in self._motif.edges for end in (a[0], b[0])])
        inside = block.frame.degree == degree[block.vertex_of[:, 0]]
        #: The vertices of the block that have all their edges, by their number in the motif.
        self._inside = [
            np.flatnonzero(inside & (block.vertex_of[:, 0] == n)).tolist() for n in range(count)
        ]

    @property
    def is_alike(self) -> bool:
        """Whether the same stands wherever a vertex of the motif has all its edges."""
        return all(
            some and len({self._stands(v) for v in some}) == 1 for some in self._inside
        ) and all(edge is not None for edge in self._examples)

    def _stands(self, vertex: int) -> tuple[str, Pose]:
        """What stands at a vertex, wherever that is."""
        found = self._places.vertices[vertex]
        return found.joint, Pose(x=found.pose.x, z=found.pose.z).rounded(_AXES)

    @cached_property
    def _examples(self) -> list[int | None]:
        """An edge of the block for each of the motif, whose ends stand as all such ends inside."""
        usual = {
            v
            for v, kind in enumerate(self._block.vertex_of[:, 0].tolist())
            if self._stands(v) == self._stands(self._inside[kind][0])
        }
        found: list[int | None] = [None] * len(self._motif.edges)
        for edge, (number, _) in enumerate(self._edges):
            if found[number] is None and {*self._block.frame.edges[edge].tolist()} <= usual:
                found[number] = edge
        return found

    def cells(self) -> Cells:
        """The table."""
        across, up = self._moves.round(_DECIMALS).tolist()
        drift = round(self._block.tiling.drift, _DECIMALS) + 0.0
        elements = [self._element(n) for n in range(len(self._motif.edges))]
        count = range(len(self._motif.vertices))
        return Cells(
            (across[0], across[1]),
            (up[0], up[1]),
            drift,
            tuple(map(self._vertex, count)),
            (*elements, *(piece for n in count for piece in self._pieces(n))),
        )

    def _vertex(self, number: int) -> CellVertex:
        """What stands at a vertex of the motif."""
        vertex = self._inside[number][0]
        place = self._places.vertices[vertex]
        pose = self._moved(place.pose, self._cell_of[vertex])
        return CellVertex(place.joint, pose, self._motif.vertices[number])

    @property
    def _moves(self) -> Floats:
        """``(2, 2) float``: from a cell to the next, across and up, in edge lengths."""
        return np.asarray(self._block.tiling.moves / self._unit)

    def _moved(self, pose: Pose, cell: Cell) -> Pose:
        """A pose in the frame as one in the first cell, if it is in this cell."""
        x, y = np.array(pose.at[:2]) - np.array(cell) @ self._moves
        return Pose((round(x, _DECIMALS) + 0.0, round(y, _DECIMALS) + 0.0, 0.0), pose.x, pose.z)

    def _element(self, number: int) -> CellPiece:
        """The element on an edge of the motif."""
        edge = self._examples[number]
        if edge is None:
            msg = f"edge {number} of the motif has an example, where all are alike"
            raise InvariantError(msg)
        _, (i, j) = self._edges[edge]
        placement = self._places.element(edge)
        ends = [self._end(end.vertex, end.slot, (i, j)) for end in placement.ends]
        return self._piece(placement, (i, j), ends, self._motif.edges[number][2])

    def _end(self, vertex: int, slot: int, cell: Cell) -> CellEnd:
        kind, i, j = self._block.vertex_of[vertex].tolist()
        return CellEnd(kind, (i - cell[0], j - cell[1]), slot)

    def _piece(
        self,
        placement: Placement,
        cell: Cell,
        ends: Sequence[CellEnd],
        any_of: tuple[Cell, ...],
        none_of: tuple[Cell, ...] = (),
    ) -> CellPiece:
        pose = self._moved(placement.pose, cell)
        return CellPiece(placement.part, placement.role, pose, tuple(ends), any_of, none_of)

    def _pieces(self, number: int) -> Iterator[CellPiece]:
        """The pieces of the joint at a vertex of the motif, wherever that is."""
        vertex = self._inside[number][0]
        cell = self._cell_of[vertex]
        edges = self._edges_at(vertex)
        place = self._places.vertices[vertex]
        every = range(len(self._places.solids.kinds.directions(vertex)))
        kind = self._places.number(vertex)
        fixed = self._places.solids.pieces[kind].key.style == "fixed"
        for piece in self._places.pieces(kind, vertex, place.pose, every):
            instead = piece.role == "cap" or (piece.role == "peg" and fixed)
            none_of = edges.get(piece.slot, ()) if instead else ()
            ends = [self._end(vertex, piece.slot, cell)]
            yield self._piece(piece, cell, ends, self._motif.vertices[number], none_of)

    def _edges_at(self, vertex: int) -> dict[int, tuple[Cell, ...]]:
        """Of each slot that has an edge, the cells that have it, as seen from the vertex's."""
        i, j = self._cell_of[vertex]
        found = {}
        for edge in np.flatnonzero((self._block.frame.edges == vertex).any(axis=1)).tolist():
            number, (k, m) = self._edges[edge]
            slot = next(end.slot for end in self._places.ends(edge) if end.vertex == vertex)
            cells = self._motif.edges[number][2]
            found[slot] = tuple((a + k - i, b + m - j) for a, b in cells)
        return found
