"""Which faces of different parts come near each other: a grid of columns.

Faces are put into the columns of a square grid that their boxes stand in, and swept along
the columns' axis within each.  A pair that shares several columns is kept in one of them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from scadgen.solid.affine import Floats, Ints
from scadgen.solid.crossing import own_box_pairs

__all__ = ["near_pairs"]

#: Entries in columns for each face, on average, that a finer grid may cost.
_COPIES = 3

#: Most columns each way.
_MOST = 256


def near_pairs(low: Floats, high: Floats, owner: Ints) -> Iterator[tuple[Ints, Ints]]:
    """Pairs of boxes of different owners that overlap.

    Parameters
    ----------
    low, high
        ``(m, 3) float``: corners of the boxes.
    owner
        ``(m,) int``.

    Yields
    ------
    one, other
        ``(k,) int`` each: box numbers, each pair once, in chunks.
    """
    if not len(low):
        return
    first, last = _columns(low, high)
    counts = last - first + 1
    box = np.repeat(np.arange(len(low)), counts.prod(axis=1))
    step = np.arange(len(box)) - np.repeat(
        np.cumsum(counts.prod(axis=1)) - counts.prod(axis=1), counts.prod(axis=1)
    )
    cell = first[box] + np.stack(np.divmod(step, counts[box, 1]), axis=1)
    column = cell[:, 0] * _MOST + cell[:, 1]
    # Along this direction boxes of different columns are apart, so one sweep does them all.
    start, extent = low[:, 2].min(), np.ptp(np.concatenate([low[:, 2], high[:, 2]]))
    base = column * (2 * extent or 1.0) - start
    lows = np.column_stack([base + low[box, 2], low[box, :2]])[:, None]
    highs = np.column_stack([base + high[box, 2], high[box, :2]])[:, None]
    for pairs in own_box_pairs(lows, highs):
        one, other = box[pairs[:, 0]], box[pairs[:, 1]]
        shared = np.maximum(first[one], first[other])
        kept = (cell[pairs[:, 0]] == shared).all(axis=1) & (owner[one] != owner[other])
        yield one[kept], other[kept]


def _columns(low: Floats, high: Floats) -> tuple[Ints, Ints]:
    """First and last column of each box, ``(m, 2) int``, in the finest grid that pays."""
    corner = low[:, :2].min(axis=0)
    whole = float(np.ptp(np.concatenate([low[:, :2], high[:, :2]]), axis=0).max())
    count = _MOST
    while True:
        width = whole / count or 1.0
        first = np.minimum((low[:, :2] - corner) // width, count - 1).astype(np.int64)
        last = np.minimum((high[:, :2] - corner) // width, count - 1).astype(np.int64)
        if count == 1 or (last - first + 1).prod(axis=1).sum() <= _COPIES * len(low):
            return first, last
        count //= 2
