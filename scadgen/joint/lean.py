"""How the lattice's outermost nodes lean between flats of different slopes."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats

__all__ = ["LEANING", "lean"]

#: Cells that are woven at least where the outside leans: it does so on either side of one.
LEANING = 5


def lean(ends: Floats, corner: NDArray[np.bool_], middle: int) -> tuple[int, int]:
    """Let the outside lean between two flats.

    Parameters
    ----------
    ends
        ``(n, 2) float``: as of a `Lattice`, from the end of a flat to the start of the next, none
        of which lean; changed.
    corner
        ``(n,) bool``: which corners may be left; changed to where faces meet.
    middle
        The cell in the middle.

    Returns
    -------
    level
        The upright corners on either side of the middle; between them there is one face.
    """
    last = len(ends) - 1
    before = _upright(corner, middle)
    after = [last - n for n in _upright(corner[::-1], last - middle - 1)][::-1]
    corner[:] = False
    corner[[*before, *after]] = True
    for upright, late in ((before, 1), (after, 0)):
        for start, stop in itertools.pairwise(upright):
            first, final = float(ends[start, 0]), float(ends[stop, 0])
            turn = start + (stop - start + late) // 2
            ends[start : turn + 1, 1] = np.linspace(first, final, turn - start + 1)
            ends[turn:stop, 1], ends[start:turn, 0] = final, first
            ends[turn : stop + 1, 0] = np.linspace(first, final, stop - turn + 1)
            corner[turn] = True
    return before[-1], after[0]


def _upright(corner: NDArray[np.bool_], middle: int) -> list[int]:
    """Which corners are upright from the end of a flat on to the middle: two cells apart or more.

    The last one is as near to the middle as may be left.
    """
    found = [n for n in (*range(0, middle - 1, 2), middle) if n == 0 or corner[n]]
    return found if len(found) > 1 else [0, middle]
