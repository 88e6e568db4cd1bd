"""Where every part of a frame stands: pure functions from rows and columns to placements.

Lengths are in edge lengths, angles in degrees.  Every vertex has exactly one key end,
so that one connector of each joint is the split one; an end whose edge is missing at
the frame's rim is closed by a loose connector or a loose peg.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from scadgen.errors import InputError
from scadgen.frame.placement import KEYS, PARTS, Placement

__all__ = ["LAYOUTS", "MOST_CELLS", "bill", "hexagonal", "joint", "square"]

#: Rows and columns go from 1 to this; more makes files nobody can print or draw.
MOST_CELLS = 100

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class _Vertex:
    """One joint: where it is, its key's direction, and the ends that have no edge."""

    at: Point
    key: float
    has_key_edge: bool
    open_ends: tuple[float, ...]


def hexagonal(rows: int, columns: int, key: str = "fixed") -> tuple[Placement, ...]:
    """Brick of regular hexagons, odd rows half a hexagon to the right.

    Zigzag lines are basic elements; the vertical edges between two lines are
    two-sided, so all of them can be pushed in together.

    Parameters
    ----------
    rows, columns
        Hexagons up and across, 1 to `MOST_CELLS`.
    key
        One of `KEYS`.

    Returns
    -------
    placements
        Row elements, cross elements, then the pieces of each joint.

    Raises
    ------
    InputError
        If a count or the key style is not one of those above.

    Examples
    --------
    >>> bill(hexagonal(1, 1))
    {'basic': 4, 'two_sided': 2, 'connector': 4, 'half': 12, 'peg': 2}
    """
    _check(rows, columns, key)
    lines = [(r, _line(r, rows, columns)) for r in range(rows + 1)]
    row = [
        Placement("basic", _zigzag(r, m), -30.0 if _is_high(r, m) else 30.0, flip=False, role="row")
        for r, line in lines
        for m in line[:-1]
    ]
    cross = [
        Placement("two_sided", _zigzag(r, m), 90.0, flip=False, role="cross")
        for r, line in lines[:-1]
        for m in line
        if _is_high(r, m)
    ]
    joints = [
        piece
        for r, line in lines
        for m in line
        for piece in _pieces(_zigzag_vertex(r, m, line, rows), key)
    ]
    return (*row, *cross, *joints)


def square(rows: int, columns: int, key: str = "fixed") -> tuple[Placement, ...]:
    """Grid of squares.

    Horizontal edges are basic elements; vertical ones are one-sided with the connector
    below and the key above, so that all pegs point the same way.

    Parameters
    ----------
    rows, columns
        Squares up and across, 1 to `MOST_CELLS`.
    key
        One of `KEYS`.

    Returns
    -------
    placements
        Row elements, cross elements, then the pieces of each joint.

    Raises
    ------
    InputError
        If a count or the key style is not one of those above.

    Examples
    --------
    >>> bill(square(1, 1))
    {'basic': 2, 'one_sided': 2, 'connector': 6, 'half': 8, 'peg': 2}
    """
    _check(rows, columns, key)
    row = [
        Placement("basic", (float(j), float(i)), 0.0, flip=False, role="row")
        for i in range(rows + 1)
        for j in range(columns)
    ]
    cross = [
        Placement("one_sided", (float(j), float(i)), 90.0, flip=False, role="cross")
        for i in range(rows)
        for j in range(columns + 1)
    ]
    joints = [
        piece
        for i in range(rows + 1)
        for j in range(columns + 1)
        for piece in _pieces(_square_vertex(i, j, rows, columns), key)
    ]
    return (*row, *cross, *joints)


#: The layout of each frame, by the frame's name.
LAYOUTS = {"hexagonal": hexagonal, "square": square}


def joint(valence: int, key: str) -> tuple[Placement, ...]:
    """Pieces that meet at one vertex, the key's edge along +x.

    Parameters
    ----------
    valence
        Number of edges at the vertex, at least 2.
    key
        One of `KEYS`; both styles show the peg as a piece of its own.

    Returns
    -------
    placements
        Half A, half B, the other connectors counter-clockwise, the peg.

    Raises
    ------
    InputError
        If the valence or the key style is not one of those above.
    """
    if valence < 2:
        msg = f"valence = {valence}: must be at least 2"
        raise InputError(msg)
    _check_key(key)
    ends = tuple(360.0 * k / valence for k in range(1, valence))
    return tuple(_pieces(_Vertex((0.0, 0.0), 0.0, has_key_edge=False, open_ends=ends), key))


def bill(placements: Iterable[Placement], parts: Iterable[str] = PARTS) -> dict[str, int]:
    """Count the pieces of each part, in the order of `parts`."""
    counts = Counter(p.part for p in placements)
    return {part: counts[part] for part in parts if part in counts}


def _pieces(vertex: _Vertex, key: str) -> Iterator[Placement]:
    """Halves, rim connectors and loose peg of one joint."""
    yield Placement("half", vertex.at, vertex.key, flip=False, role="half_a")
    yield Placement("half", vertex.at, vertex.key, flip=True, role="half_b")
    for turn in vertex.open_ends:
        yield Placement("connector", vertex.at, turn, flip=False, role="cap")
    if key == "loose" or not vertex.has_key_edge:
        yield Placement("peg", vertex.at, vertex.key, flip=False, role="peg")


def _line(r: int, rows: int, columns: int) -> range:
    """Vertices of zigzag line `r`: those of the hexagons above and below it."""
    touching = [row % 2 for row in (r - 1, r) if 0 <= row < rows]
    return range(min(touching), 2 * columns + max(touching) + 1)


def _is_high(r: int, m: int) -> bool:
    """Whether vertex `m` of line `r` is an upper one; its vertical edge goes up."""
    return (m + r) % 2 == 0


def _zigzag(r: int, m: int) -> Point:
    return m * math.sqrt(3) / 2, 1.5 * r + (0.5 if _is_high(r, m) else 0.0)


def _zigzag_vertex(r: int, m: int, line: range, rows: int) -> _Vertex:
    high = _is_high(r, m)
    left, right = (210.0, 330.0) if high else (150.0, 30.0)
    missing = [left] * (m == line[0]) + [right] * (m == line[-1])
    has_key_edge = r < rows if high else r > 0
    return _Vertex(_zigzag(r, m), 90.0 if high else 270.0, has_key_edge, tuple(missing))


def _square_vertex(i: int, j: int, rows: int, columns: int) -> _Vertex:
    missing = [180.0] * (j == 0) + [0.0] * (j == columns) + [90.0] * (i == rows)
    return _Vertex((float(j), float(i)), 270.0, i > 0, tuple(missing))


def _check(rows: int, columns: int, key: str) -> None:
    for name, value in (("rows", rows), ("columns", columns)):
        if not 1 <= value <= MOST_CELLS:
            msg = f"{name} = {value!r}: must be a whole number from 1 to {MOST_CELLS}"
            raise InputError(msg)
    _check_key(key)


def _check_key(key: str) -> None:
    if key not in KEYS:
        msg = f"key = {key!r}: must be one of {', '.join(KEYS)}"
        raise InputError(msg)
