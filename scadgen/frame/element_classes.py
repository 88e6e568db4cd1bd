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
from scadgen.solid.affine import Floats, Ints

__all__ = ["ElementClasses", "ElementEnds", "Slots"]


@dataclass(frozen=True, slots=True, eq=False)
class Slots:
    """Which slots of all kinds of joints are alike.

    Parameters
    ----------
    what
        ``(kinds, most) int``: the kind times `most`, and more than that by the slot, of the first
        that is like each; unused slots are zero.
    over
        ``(kinds, most) bool``: whether that is turned over for it.
    either
        ``(kinds, most) bool``: whether it is like itself turned over.
    """

    what: Ints
    over: NDArray[np.bool_]
    either: NDArray[np.bool_]

    @property
    def most(self) -> int:
        """Slots of the joint that has the most."""
        return int(self.what.shape[1])

    @classmethod
    def of(cls, symmetries: Sequence[Symmetry]) -> Slots:
        """Those of the same kind that are alike by its symmetry."""
        most = max(one.count for one in symmetries)
        table = np.zeros((3, len(symmetries), most), dtype=np.int64)
        for number, one in enumerate(symmetries):
            for slot in range(one.count):
                first, over = one.alike(slot)
                table[:, number, slot] = number * most + first, over, one.either(slot)
        return cls(table[0], *table[1:].astype(bool))


@dataclass(frozen=True, slots=True, eq=False)
class ElementClasses:
    """Edge elements that are the same part.

    Parameters
    ----------
    what
        ``(k, 2) int``: what is at the ends of each part.
    over
        ``(k, 2) bool``: whether it is turned over there; not if it is alike turned over.
    length, twist
        ``(k,) float``: how long it is, and how far it turns about itself.
    which
        ``(m,) int``: the part that each element is.
    swapped, flipped
        ``(m,) bool``: whether that has to be turned about, and turned over, to be the element.
    """

    what: Ints
    over: NDArray[np.bool_]
    length: Floats
    twist: Floats
    which: Ints
    swapped: NDArray[np.bool_]
    flipped: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class ElementEnds:
    """What edge elements end in.

    Parameters
    ----------
    what
        ``(m, 2) int``: a number for what is at each end, not turned over.
    over
        ``(m, 2) bool``: whether it is turned over there.
    either
        ``(m, 2) bool``: whether it is alike turned over.
    length
        ``(m,) float``: how long they are; the same for those that may be the same part.
    twist
        ``(m,) float``, or one for all: how far they turn about themselves from end to end; the
        same for those that may be the same part.
    """

    what: Ints
    over: NDArray[np.bool_]
    either: NDArray[np.bool_]
    length: Floats
    twist: Floats | float = 0.0

    def alike(self) -> ElementClasses:
        """Which are the same part: they may be swapped and turned over.

        A part is as most of its elements lie.
        """
        options = [(swapped, flipped) for flipped in (False, True) for swapped in (False, True)]
        seen = np.stack([self._seen(*option) for option in options])
        size = int(self.what.max(initial=0)) + 1
        codes = ((seen[:, :, 0] * size + seen[:, :, 1]) * 2 + seen[:, :, 2]) * 2 + seen[:, :, 3]
        best, row = codes.argmin(axis=0), np.arange(len(self.what))
        swapped, flipped = np.array(options)[best].T
        twist = np.broadcast_to(self.twist, len(row))
        rows = np.column_stack([seen[best, row], self.length, twist])
        found, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        which = which.ravel()
        # Those of which most are turned over become what these are.
        turned = 2 * np.bincount(which, flipped) > np.bincount(which)
        either = np.where(swapped[:, None], self.either[:, ::-1], self.either)[first]
        over = (found[:, 2:4].astype(bool) ^ turned[:, None]) & ~either
        return ElementClasses(
            *(found[:, :2].astype(np.int64), over, found[:, 4], found[:, 5]),
            *(which, swapped, flipped ^ turned[which]),
        )

    def _seen(self, swapped: bool, flipped: bool) -> Ints:  # noqa: FBT001
        """Elements that are turned about, or over, or both: what is at each end, and if over."""
        order = [1, 0] if swapped else [0, 1]
        over = (self.over ^ flipped) & ~self.either
        return np.column_stack([self.what[:, order], over[:, order]])
