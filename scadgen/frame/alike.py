"""Which edge elements are alike, by what they end in.

Their ends may be swapped, which turns them about in the plane, and they may be turned over about
their axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scadgen.joint.symmetry import Symmetry
from scadgen.solid.affine import Ints

__all__ = ["Ends", "alike_slots"]


def alike_slots(
    symmetries: Sequence[Symmetry], kind: Ints, slot: Ints
) -> tuple[Ints, NDArray[np.bool_], NDArray[np.bool_]]:
    """The first slot that is like each of some, of joints of some kinds.

    Parameters
    ----------
    symmetries
        Of each kind.
    kind, slot
        ``(...) int``: which kind, and which of its slots.

    Returns
    -------
    first
        ``(...) int``.
    over
        ``(...) bool``: whether it is turned over for it.
    either
        ``(...) bool``: whether it is like itself turned over.
    """
    table = np.zeros((len(symmetries), max(one.count for one in symmetries), 3), dtype=np.int64)
    for number, one in enumerate(symmetries):
        for n in range(one.count):
            table[number, n] = *one.alike(n), one.either(n)
    found = table[kind, slot]
    return found[..., 0], found[..., 1].astype(bool), found[..., 2].astype(bool)


@dataclass(frozen=True, slots=True, eq=False)
class Ends:
    """What edge elements end in.

    Parameters
    ----------
    what
        ``(m, 2) int``: a number for what is at each end, not turned over.
    over
        ``(m, 2) bool``: whether it is turned over there.
    either
        ``(m, 2) bool``: whether it is alike turned over.
    """

    what: Ints
    over: NDArray[np.bool_]
    either: NDArray[np.bool_]

    def alike(self) -> tuple[Ints, NDArray[np.bool_], NDArray[np.bool_]]:
        """The same for elements that are the same part: they may be swapped and turned over.

        Returns
        -------
        ends
            ``(m, 4) int``: what is at the first end, at the second, and whether it is turned
            over there.
        swapped, flipped
            ``(m,) bool``: whether such an element has to be turned about, and turned over, to
            be this one.
        """
        ways = [
            (what, over & ~either, swapped, flipped)
            for flipped in (False, True)
            for swapped in (False, True)
            for what, over, either in [self._seen(swapped=swapped, flipped=flipped)]
        ]
        size = int(self.what.max(initial=0)) + 1
        codes = [
            ((what[:, 0] * size + what[:, 1]) * 2 + over[:, 0]) * 2 + over[:, 1]
            for what, over, *_ in ways
        ]
        best, row = np.argmin(codes, axis=0), np.arange(len(self.what))
        every = np.stack([np.column_stack([what, over]) for what, over, *_ in ways])
        chosen = np.array([way[2:] for way in ways])[best]
        return every[best, row].astype(np.int64), chosen[:, 0], chosen[:, 1]

    def _seen(
        self, *, swapped: bool, flipped: bool
    ) -> tuple[Ints, NDArray[np.bool_], NDArray[np.bool_]]:
        """The ends of elements that are turned about, or over, or both."""
        order = [1, 0] if swapped else [0, 1]
        return self.what[:, order], (self.over ^ flipped)[:, order], self.either[:, order]
