"""Where every part of a frame stands: rows and columns laid out from what stands in one cell.

A piece of a cell is there if any of some cells is there, as seen from its own, and none of some
others.  Everything is in edge lengths.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, Tuple

__all__ = ["MOST_CELLS", "laid"]

#: Most rows or columns of a frame.
MOST_CELLS = 100

#: Decimals of a position, in edge lengths.
_DECIMALS = 9

#: What rounding takes off a row's drift, in cells.
_ROUNDING = 1e-9

#: A cell, counted from another: across and up.
Cell = Tuple[int, int]


def laid(cells: Mapping[str, Any], rows: int, columns: int) -> Iterator[dict[str, Any]]:
    """Lay out rows and columns of cells.

    Parameters
    ----------
    cells
        What ``kit.json`` says of a cell: ``across`` and ``up`` to the next ones, by how many
        cells each row is moved back (``drift``), and its ``pieces``.
    rows, columns
        How many.

    Yields
    ------
    placement
        Part, role, position and axes of a piece.
    """
    there = _present(rows, columns, cells["drift"])
    for piece in cells["pieces"]:
        for i, j in sorted({(i - a, j - b) for i, j in there for a, b in piece["any_of"]}):
            if not any((i + a, j + b) in there for a, b in piece["none_of"]):
                x, y, z = piece["at"]
                moves = zip((x, y), cells["across"], cells["up"])
                at = [round(v + i * across + j * up, _DECIMALS) + 0.0 for v, across, up in moves]
                same = {name: piece[name] for name in ("part", "role", "x", "z")}
                yield {**same, "at": [*at, z]}


def _present(rows: int, columns: int, drift: float) -> set[Cell]:
    """Which cells rows and columns are."""
    return {
        (column - math.floor(row * drift + _ROUNDING), row)
        for row in range(rows)
        for column in range(columns)
    }
