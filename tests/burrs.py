"""Six-piece burrs from the numbers of their pieces, put together and taken apart cell by cell.

A piece is a bar of 2 x 2 x 6 cells of which twelve may be cut away: of the side that looks
inwards four in a row, four beside them, and behind each row the middle two.  Its number is one
more than the sum of 2**(k - 1) for each cell k that is.
"""

from functools import cache
from itertools import product

import numpy as np
from puzzles import voxels

__all__ = ["assembled", "comes_apart_straight", "meshes_of", "shifts"]

#: Cells that may be cut away, along the bar, across it, and away from the middle; in the order
#: in which they are numbered.
_CUT = [(x, y, 0) for y in (0, -1) for x in range(-2, 2)]
_CUT += [(x, y, 1) for y in (0, -1) for x in (-1, 0)]

#: For each of the six places the way along the bar, across, and away from the middle.
_PLACES = [
    tuple(np.array(v) for v in place)
    for place in (
        ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
        ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
        ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
        ((0, 1, 0), (1, 0, 0), (0, 0, -1)),
        ((0, 0, 1), (0, 1, 0), (1, 0, 0)),
        ((0, 0, 1), (0, 1, 0), (-1, 0, 0)),
    )
]


def _cells(number, place, turned):
    """The cells of a piece in one of the six places, turned end for end or not."""
    cut = {c for k, c in enumerate(_CUT) if (number - 1) >> k & 1}
    bar = {c for c in product(range(-3, 3), (0, -1), (0, 1)) if c not in cut}
    along, across, away = _PLACES[place]
    # A cell is told by its middle, so that turning it over is a change of sign.
    middles = (np.array([*c]) + 0.5 for c in bar)
    sign = np.linalg.det([along, across, away]) * (-1 if turned else 1)
    first = -1 if turned else 1
    return frozenset(
        tuple(int(v) for v in np.floor(first * x * along + sign * y * across + z * away))
        for x, y, z in middles
    )


@cache
def assembled(numbers):
    """The first way in which six pieces fit together: the cells of each."""
    fits = {
        (number, place): [_cells(number, place, turned) for turned in (False, True)]
        for number in set(numbers)
        for place in range(6)
    }

    def fill(place, left, taken):
        if place == 6:
            return []
        for number in sorted(set(left)):
            rest = list(left)
            rest.remove(number)
            for cells in fits[number, place]:
                if (
                    taken.isdisjoint(cells)
                    and (found := fill(place + 1, rest, taken | cells)) is not None
                ):
                    return [cells, *found]
        return None

    return fill(0, list(numbers), frozenset())


def meshes_of(numbers):
    """The same as meshes."""
    return [voxels(cells) for cells in assembled(numbers)]


def shifts(parts, far):
    """Sets of parts, not all, that can go straight by so many cells, with the rest at rest."""
    owner = {cell: n for n, cells in parts.items() for cell in cells}
    found = []
    for axis, way in product(range(3), (1, -1)):
        step = way * np.eye(3, dtype=int)[axis]
        pushes = {n: set() for n in parts}
        for cell, n in owner.items():
            for gone in range(1, far + 1):
                other = owner.get(tuple((np.array(cell) + gone * step).tolist()), n)
                pushes[n].add(other)
        for start in parts:
            group, todo = {start}, [start]
            while todo:
                new = pushes[todo.pop()] - group
                group |= new
                todo += new
            if len(group) < len(parts):
                found.append((frozenset(group), tuple(step)))
    return found


def comes_apart_straight(parts):
    """Whether parts and groups that go straight out one after the other leave none together."""
    if len(parts) < 2:
        return True
    out = shifts(parts, 12)
    if not out:
        return False
    group, _ = min(out, key=lambda one: (len(one[0]), sorted(one[0])))
    sides = ({n: c for n, c in parts.items() if (n in group) == inside} for inside in (True, False))
    return all(comes_apart_straight(side) for side in sides)
