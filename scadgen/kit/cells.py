"""What stands in one cell of a tiling, from which any rows and columns are laid out.

Every piece belongs to a cell.  It is there if any of some cells is there, counted from its own,
and none of some others: an edge if a cell with a tile beside it is; a cap if its vertex is there
and its edge is not.  OpenSCAD and FreeCAD lay out rows and columns by the same table.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from scadgen.errors import InputError
from scadgen.frame.placement import Place, Placement
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.pose import Pose

__all__ = [
    "MOST_CELLS",
    "Cell",
    "CellEnd",
    "CellPiece",
    "CellVertex",
    "Cells",
    "Layout",
    "check_cells",
    "present",
]

#: Rows and columns go from 1 to this; more makes files nobody can print or draw.
MOST_CELLS = 100

#: Decimals of a position, in edge lengths.
_DECIMALS = 9

#: What rounding takes off a row's drift, in cells.
_ROUNDING = 1e-9

#: A cell, counted from another: across and up.
Cell = tuple[int, int]


@dataclass(frozen=True, slots=True)
class CellEnd:
    """Where an end of a piece is.

    Parameters
    ----------
    vertex
        Number of the vertex in its cell.
    cell
        That cell, as seen from the piece's.
    slot
        Which connector of the joint there.
    """

    vertex: int
    cell: Cell
    slot: int


@dataclass(frozen=True, slots=True)
class CellPiece:
    """A piece of a cell.

    Parameters
    ----------
    part, role
        As of a `Placement`.
    pose
        Where it stands in the cell, its position in edge lengths.
    ends
        Where its ends are.
    any_of, none_of
        Cells, as seen from its own, of which one must be there and none may be.
    """

    part: str
    role: str
    pose: Pose
    ends: tuple[CellEnd, ...]
    any_of: tuple[Cell, ...]
    none_of: tuple[Cell, ...] = ()


@dataclass(frozen=True, slots=True)
class CellVertex:
    """What stands at a vertex of a cell.

    Parameters
    ----------
    joint
        Name of the kind of joint.
    pose
        Where it stands in the cell, its first key along x; its position in edge lengths.
    any_of
        Cells, as seen from its own, of which one must be there.
    """

    joint: str
    pose: Pose
    any_of: tuple[Cell, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """What stands in rows and columns.

    Parameters
    ----------
    at
        ``(n, 3) float``: where the vertices are, in edge lengths, ascending by y, then x.
    edges
        ``(m, 2) int``: the two vertices of each edge, ascending.
    vertices
        Of each vertex the kind of joint, and where it stands.
    placements
        The elements by edge, then the pieces by vertex.
    """

    at: Floats
    edges: Ints
    vertices: tuple[tuple[str, Pose], ...]
    placements: tuple[Placement, ...]


@dataclass(frozen=True, slots=True)
class Cells:
    """What repeats, and how.

    Parameters
    ----------
    across, up
        From a cell to the next in its row, and to the one above it, in edge lengths.
    drift
        By how many cells each row is moved back, as far as these are whole.
    vertices
        Those of a cell.
    pieces
        Those of a cell: edge elements, then the pieces of each joint.
    """

    across: tuple[float, float]
    up: tuple[float, float]
    drift: float
    vertices: tuple[CellVertex, ...]
    pieces: tuple[CellPiece, ...]

    def laid(self, rows: int, columns: int) -> Layout:
        """What stands in so many cells up and across.

        Raises
        ------
        InputError
            One of them is not from 1 to `MOST_CELLS`.
        """
        check_cells(rows, columns)
        there = present(rows, columns, self.drift)
        found = {
            (number, *cell): self._moved(vertex.pose, cell)
            for number, vertex in enumerate(self.vertices)
            for cell in _cells(vertex.any_of, there)
        }
        keys = sorted(found, key=lambda key: (found[key].at[1], found[key].at[0]))
        number = {key: n for n, key in enumerate(keys)}
        placed = list(self._placed(there, number))
        edges = sorted({_edge(p) for p in placed if len(p.ends) == 2})
        edge_number = {edge: n for n, edge in enumerate(edges)}
        elements = (replace(p, edge=edge_number[_edge(p)]) for p in placed if len(p.ends) == 2)
        return Layout(
            np.array([found[key].at for key in keys]).reshape(-1, 3),
            np.array(edges, dtype=np.int64).reshape(-1, 2),
            tuple((self.vertices[key[0]].joint, found[key]) for key in keys),
            (
                *sorted(elements, key=lambda p: p.edge or 0),
                *sorted((p for p in placed if len(p.ends) == 1), key=lambda p: p.vertex),
            ),
        )

    def _placed(
        self, there: frozenset[Cell], number: Mapping[tuple[int, int, int], int]
    ) -> Iterator[Placement]:
        """The pieces that are there, by the numbers of the vertices."""
        for piece in self.pieces:
            for i, j in _cells(piece.any_of, there):
                if not any((i + a, j + b) in there for a, b in piece.none_of):
                    ends = tuple(_place(end, (i, j), number) for end in piece.ends)
                    yield Placement(piece.part, piece.role, self._moved(piece.pose, (i, j)), ends)

    def _moved(self, pose: Pose, cell: Cell) -> Pose:
        """A pose in the first cell as it is in another."""
        x, y = (
            round(at + cell[0] * across + cell[1] * up, _DECIMALS) + 0.0
            for at, across, up in zip(pose.at, self.across, self.up, strict=False)
        )
        return Pose((x, y, pose.at[2]), pose.x, pose.z)


def _place(end: CellEnd, cell: Cell, number: Mapping[tuple[int, int, int], int]) -> Place:
    """Where an end of a piece in a cell is, by the numbers of the vertices.

    Raises
    ------
    InputError
        There is no vertex.
    """
    vertex = end.vertex, cell[0] + end.cell[0], cell[1] + end.cell[1]
    if vertex not in number:
        msg = f"cells: a piece ends at vertex {end.vertex}, which is not there"
        raise InputError(msg)
    return Place(number[vertex], end.slot)


def _cells(any_of: Collection[Cell], there: Collection[Cell]) -> list[Cell]:
    """The cells in which something is, as there is one of the cells that have it."""
    return sorted({(i - a, j - b) for i, j in there for a, b in any_of})


def _edge(element: Placement) -> tuple[int, int]:
    """The vertices of an element, the lower one first."""
    near, far = (end.vertex for end in element.ends)
    return min(near, far), max(near, far)


def present(rows: int, columns: int, drift: float) -> frozenset[Cell]:
    """Which cells rows and columns are."""
    return frozenset(
        (column - math.floor(row * drift + _ROUNDING), row)
        for row in range(rows)
        for column in range(columns)
    )


def check_cells(rows: int, columns: int) -> None:
    """Refuse counts of cells that nobody can draw or print.

    Raises
    ------
    InputError
        One is not from 1 to `MOST_CELLS`.
    """
    for name, value in (("rows", rows), ("columns", columns)):
        if type(value) is not int or not 1 <= value <= MOST_CELLS:
            msg = f"{name} = {value!r}: must be a whole number from 1 to {MOST_CELLS}"
            raise InputError(msg)
