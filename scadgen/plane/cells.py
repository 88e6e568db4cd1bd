"""Fundamental cells of tilings, in whole numbers.

All edges of the uniform tilings point along 24th roots of unity, so their vertices are
whole-number sums of eight of these roots: 1, w, ..., w^7 with w = exp(i pi / 12).  Equal
vertices are equal rows of whole numbers, and nothing is ever compared with a tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from scadgen.errors import InvariantError
from scadgen.solid.affine import Floats, Ints

__all__ = ["LAVES", "LEFT_OUT", "UNIFORM", "Cell", "dual", "rhombic_cell", "uniform_cell"]


@dataclass(frozen=True, slots=True, eq=False)
class Cell:
    """One cell of a periodic tiling.

    Parameters
    ----------
    basis
        ``(b, 2) float``: what the whole numbers count; the shortest edge is 1 long.
    moves
        ``(2, b) int``: the two translations.
    tiles
        For each tile, its corners, ``(k, b) int``, counter-clockwise.  Each tile but the
        first shares an edge with one before it.
    """

    basis: Floats
    moves: Ints
    tiles: tuple[Ints, ...]


@dataclass(frozen=True, slots=True)
class _Plan:
    """A cell as it is put together; directions are in 24ths of a turn.

    Parameters
    ----------
    moves
        The two translations, each a walk of unit steps in these directions.
    first
        Number of sides of the first tile.
    direction
        Direction of its first side, from the origin.
    others
        For each further tile: its sides, the tile it is put on, and on which of its sides.
        Its own side 0 is the shared one.
    """

    moves: tuple[tuple[int, ...], tuple[int, ...]]
    first: int
    direction: int = 0
    others: tuple[tuple[int, int, int], ...] = ()


#: The eleven uniform tilings by the faces around a vertex.
UNIFORM: Mapping[str, _Plan] = MappingProxyType(
    {
        "6.6.6": _Plan(((2, 22), (2, 6)), 6, 2),
        "4.4.4.4": _Plan(((0,), (6,)), 4),
        "3.3.3.3.3.3": _Plan(((0,), (4,)), 3, 0, ((3, 0, 1),)),
        "3.6.3.6": _Plan(((0, 0), (4, 4)), 6, 0, ((3, 0, 1), (3, 0, 2))),
        "3.4.6.4": _Plan(
            ((0, 2, 22), (4, 6, 2)),
            6,
            2,
            ((4, 0, 1), (4, 0, 2), (4, 0, 3), (3, 1, 3), (3, 2, 3)),
        ),
        "4.8.8": _Plan(((0, 3, 21), (6, 9, 3)), 8, 0, ((4, 0, 3),)),
        "3.3.4.3.4": _Plan(
            ((1, 23), (7, 5)), 4, 1, ((3, 0, 0), (3, 0, 1), (3, 0, 2), (3, 0, 3), (4, 1, 2))
        ),
        "3.3.3.4.4": _Plan(((0,), (6, 4)), 4, 0, ((3, 0, 2), (3, 1, 1))),
        "3.3.3.3.6": _Plan(
            ((0, 0, 4), (4, 4, 8)),
            6,
            0,
            (*((3, 0, side) for side in range(6)), (3, 1, 2), (3, 2, 2)),
        ),
        "3.12.12": _Plan(((0, 0, 2, 22), (4, 4, 6, 2)), 12, 0, ((3, 0, 2), (3, 0, 4))),
        "4.6.12": _Plan(
            ((0, 0, 0, 2, 22), (4, 4, 4, 6, 2)),
            12,
            0,
            ((4, 0, 3), (4, 0, 5), (4, 0, 7), (6, 0, 4), (6, 0, 6)),
        ),
    }
)

#: Uniform tilings with a dual of other vertices than theirs, whose longest edge is at most
#: `_LONGEST` times its shortest, by the faces around a vertex of the uniform tiling.
LAVES = ("3.6.3.6", "3.4.6.4", "4.8.8", "3.3.4.3.4", "3.3.3.4.4", "3.12.12")

#: Duals that are left out, and why.  All joints of a kit have the same side, so the shortest
#: edge of a frame sets the size of all.
LEFT_OUT: Mapping[str, str] = MappingProxyType(
    {
        "3.3.3.3.6": "its longest edge is twice its shortest",
        "4.6.12": "its longest edge is twice its shortest",
    }
)

#: Longest edge over shortest of a dual that is offered; the offered ones need sqrt(3).
_LONGEST = 1.75


def _step(power: int) -> list[int]:
    """A 24th root of unity in terms of the first eight; w^8 = w^4 - 1 and w^12 = -1."""
    sign, power = (-1 if power % 24 >= 12 else 1), power % 12
    row = [0] * 8
    for place, factor in ((power, 1),) if power < 8 else ((power - 4, 1), (power - 8, -1)):
        row[place] = sign * factor
    return row


_STEPS: Ints = np.array([_step(power) for power in range(24)])
_ROOTS: Floats = np.stack([np.cos(np.arange(8) * np.pi / 12), np.sin(np.arange(8) * np.pi / 12)], 1)


def uniform_cell(configuration: str) -> Cell:
    """Cell of a uniform tiling, one of `UNIFORM`."""
    plan = UNIFORM[configuration]
    tiles = [_polygon(plan.first, np.zeros(8, dtype=np.int64), plan.direction)]
    directions = [plan.direction]
    for sides, on, side in plan.others:
        count = len(tiles[on])
        directions.append((directions[on] + side * (24 // count) + 12) % 24)
        tiles.append(_polygon(sides, tiles[on][(side + 1) % count], directions[-1]))
    moves = np.stack([_STEPS[list(walk)].sum(axis=0) for walk in plan.moves])
    return Cell(_ROOTS, moves, tuple(tiles))


def _polygon(sides: int, start: Ints, direction: int) -> Ints:
    """Corners of a regular polygon with a side that leaves `start` in this direction."""
    steps = _STEPS[(direction + np.arange(sides) * (24 // sides)) % 24]
    return np.asarray(start + np.cumsum(steps, axis=0) - steps)


def rhombic_cell(width: float, height: float, angle: float) -> Cell:
    """Cell of one parallelogram.

    Parameters
    ----------
    width, height
        Its sides.
    angle
        The angle between them, in radians.
    """
    basis = np.array([[width, 0.0], [height * math.cos(angle), height * math.sin(angle)]])
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    return Cell(basis / min(width, height), np.eye(2, dtype=np.int64), (corners,))


def dual(cell: Cell) -> Cell:
    """The tiling that has a vertex in the middle of each tile, and an edge across each edge.

    Raises
    ------
    InvariantError
        Its longest edge is more than `_LONGEST` times its shortest.
    """
    tiles = _patch(cell)
    around: dict[tuple[int, ...], list[Ints]] = {}
    for tile in tiles:
        for corner in tile.tolist():
            around.setdefault(tuple(corner), []).append(tile)
    stars = [_star(np.array(v), around[tuple(v)], cell.basis) for v in _vertices(cell, around)]
    sides = np.concatenate([np.diff(star, axis=0) for star in stars]) @ (cell.basis / 24)
    lengths = np.linalg.norm(sides, axis=1)
    if lengths.max() > _LONGEST * lengths.min():
        msg = f"dual tiling: edges from {lengths.min():.4g} to {lengths.max():.4g} are too uneven"
        raise InvariantError(msg)
    return Cell(cell.basis / (24 * lengths.min()), cell.moves * 24, tuple(stars))


def _patch(cell: Cell) -> list[Ints]:
    """The cell's tiles and those of the cells around it, three each way."""
    places = [(i, j) for i in range(-3, 4) for j in range(-3, 4)]
    moved: Ints = np.array(places) @ cell.moves
    return [tile + move for move in moved for tile in cell.tiles]


def _vertices(cell: Cell, around: dict[tuple[int, ...], list[Ints]]) -> list[tuple[int, ...]]:
    """One vertex of each kind that translations make, each an edge away from one before it."""
    to_cells = np.linalg.inv(cell.moves @ cell.basis)

    def kind(vertex: tuple[int, ...]) -> tuple[int, ...]:
        place = np.floor(np.array(vertex) @ cell.basis @ to_cells + 1e-6).astype(np.int64)
        return tuple((np.array(vertex) - place @ cell.moves).tolist())

    queue = [tuple(cell.tiles[0][0].tolist())]
    seen = {kind(queue[0])}
    for vertex in queue:
        for tile in around[vertex]:
            corners = [tuple(corner) for corner in tile.tolist()]
            at = corners.index(vertex)
            for other in (corners[at - 1], corners[(at + 1) % len(corners)]):
                if kind(other) not in seen:
                    seen.add(kind(other))
                    queue.append(other)
    return queue


def _star(vertex: Ints, tiles: list[Ints], basis: Floats) -> Ints:
    """Middles of the tiles around a vertex, counter-clockwise, in 24ths of the basis."""
    middles = np.stack([tile.sum(axis=0) * (24 // len(tile)) for tile in tiles])
    x, y = ((middles / 24 - vertex) @ basis).T
    return np.asarray(middles[np.argsort(np.arctan2(y, x))])
