"""Where every part of a frame stands, and what there is: the same rules as scadgen's own."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any, Dict, List

__all__ = ["KEYS", "LAYOUTS", "MOST_CELLS", "PARAMETERS", "PARTS", "ROLES", "hexagonal", "square"]

#: Key styles.
KEYS = ("fixed", "loose")

#: The parts of a frame with rows and columns.
PARTS = ("basic", "one_sided", "two_sided", "connector", "half", "peg", "tube")

#: What a placed piece is to the viewer.
ROLES = ("row", "cross", "half_a", "half_b", "cap", "peg")

#: The live parameters; a kit without a bore lacks the last.
PARAMETERS = (
    "side",
    "edge_length",
    "clearance",
    "peg_width",
    "peg_length",
    "peg_clearance",
    "peg_chamfer",
    "bore",
)

#: Most rows or columns of a frame.
MOST_CELLS = 100

Placements = List[Dict[str, Any]]


def hexagonal(rows: int, columns: int, key: str) -> Placements:
    """Brick of regular hexagons, odd rows half a hexagon to the right."""
    lines = [_line(r, rows, columns) for r in range(rows + 1)]
    row = [
        _placed("basic", _zigzag(r, m), -30.0 if _is_high(r, m) else 30.0, "row")
        for r, line in enumerate(lines)
        for m in line[:-1]
    ]
    cross = [
        _placed("two_sided", _zigzag(r, m), 90.0, "cross")
        for r, line in enumerate(lines[:-1])
        for m in line
        if _is_high(r, m)
    ]
    joints: Placements = []
    for r, line in enumerate(lines):
        for m in line:
            high = _is_high(r, m)
            left, right = (210.0, 330.0) if high else (150.0, 30.0)
            ends = [left] * (m == line[0]) + [right] * (m == line[-1])
            has_edge = r < rows if high else r > 0
            loose = key == "loose" or not has_edge
            joints += _pieces(_zigzag(r, m), 90.0 if high else 270.0, ends, loose=loose)
    return row + cross + joints


def square(rows: int, columns: int, key: str) -> Placements:
    """Grid of squares."""
    row = [_placed("basic", (j, i), 0.0, "row") for i in range(rows + 1) for j in range(columns)]
    cross = [
        _placed("one_sided", (j, i), 90.0, "cross") for i in range(rows) for j in range(columns + 1)
    ]
    joints: Placements = []
    for i in range(rows + 1):
        for j in range(columns + 1):
            ends = [180.0] * (j == 0) + [0.0] * (j == columns) + [90.0] * (i == rows)
            joints += _pieces((j, i), 270.0, ends, loose=key == "loose" or i == 0)
    return row + cross + joints


#: The layout of each frame, by the frame's name.
LAYOUTS = {"hexagonal": hexagonal, "square": square}


def _placed(
    part: str, at: tuple[float, float], turn: float, role: str, *, flip: bool = False
) -> dict[str, Any]:
    x, y = at
    return {"part": part, "at": [float(x), float(y)], "turn": turn, "flip": flip, "role": role}


def _pieces(
    at: tuple[float, float], key: float, ends: Iterable[float], *, loose: bool
) -> Iterator[dict[str, Any]]:
    """Halves, rim connectors and loose peg of one joint."""
    yield _placed("half", at, key, "half_a")
    yield _placed("half", at, key, "half_b", flip=True)
    for turn in ends:
        yield _placed("connector", at, turn, "cap")
    if loose:
        yield _placed("peg", at, key, "peg")


def _line(r: int, rows: int, columns: int) -> range:
    """Vertices of zigzag line `r`: those of the hexagons above and below it."""
    touching = [row % 2 for row in (r - 1, r) if 0 <= row < rows]
    return range(min(touching), 2 * columns + max(touching) + 1)


def _is_high(r: int, m: int) -> bool:
    """Whether vertex `m` of line `r` is an upper one; its vertical edge goes up."""
    return (m + r) % 2 == 0


def _zigzag(r: int, m: int) -> tuple[float, float]:
    return m * math.sqrt(3) / 2, 1.5 * r + (0.5 if _is_high(r, m) else 0.0)
