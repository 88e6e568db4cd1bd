"""Which edges of a joint are alike: after a turn in its plane, or after it is turned over."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats, Ints

__all__ = ["Symmetry", "lopsided"]


#: A gap is more than half a turn from this on, in radians: far above how directions are rounded.
_STRAIGHT = 1e-6


def lopsided(gaps: Floats, keys: Collection[int]) -> NDArray[np.bool_]:
    """The gaps whose wall is nearer one edge, the first, though neither has a better claim.

    They are those between two keys, and those of more than half a turn beside none: connectors
    that part at a wall far across the ring would swing into each other.  A joint that has one is
    another one turned over.

    Parameters
    ----------
    gaps
        ``(k,) float``: angle from each edge to the next.
    keys
        Slots of the connectors that are split.
    """
    here = np.isin(np.arange(len(gaps)), list(keys))
    after = np.roll(here, -1)
    return np.asarray(np.where(here, after, ~after & (gaps > np.pi + _STRAIGHT)))


@dataclass(frozen=True, slots=True)
class Symmetry:
    """Which edges of a joint are alike, by their slots.

    Parameters
    ----------
    count
        How many edges it has.
    period
        Slots that differ by this are alike.
    mirror
        The joint turned over is itself, slot s where ``mirror - s`` was; None if it is not.
    """

    count: int
    period: int
    mirror: int | None

    @property
    def turns(self) -> int:
        """In how many ways it can be turned onto itself in the plane."""
        return self.count // self.period

    def mirrored(self, slot: int) -> int:
        """The first slot that is like this one, turned over; that itself if there is none."""
        return slot % self.period if self.mirror is None else (self.mirror - slot) % self.period

    def alike(self, slot: int) -> tuple[int, bool]:
        """The first slot that is like this one, and whether it is turned over for it."""
        own, other = slot % self.period, self.mirrored(slot)
        return min(own, other), other < own

    @property
    def firsts(self) -> list[int]:
        """The first of each set of slots that are alike."""
        return sorted({self.alike(slot)[0] for slot in range(self.period)})

    def either(self, slot: int) -> bool:
        """Whether the edge is like itself turned over."""
        return self.mirror is not None and self.mirrored(slot) == slot % self.period

    def turned_over(self) -> Symmetry:
        """That of the joint turned over, slot s where ``-s`` was."""
        mirror = None if self.mirror is None else -self.mirror % self.period
        return Symmetry(self.count, self.period, mirror)

    def least_turn(self, turn: Floats, tolerance: float) -> tuple[Floats, Ints]:
        """Turns as small as can be, less than 0 by the tolerance at most, for the same joint.

        Parameters
        ----------
        turn
            ``(n,) float``: in radians.
        tolerance
            In radians.

        Returns
        -------
        turn
            ``(n,) float``.
        steps
            ``(n,) int``: by how many periods slots become less.
        """
        step = 2 * math.pi / self.turns
        steps = np.floor((turn + tolerance) / step).astype(np.int64)
        return turn - steps * step, steps

    def with_keys(self, keys: Collection[int], gaps: Floats) -> Symmetry:
        """Which edges are alike once some are keys.

        Parameters
        ----------
        keys
            Their slots.
        gaps
            ``(count,) float``: angle from each edge to the next.
        """
        own = {slot % self.count for slot in keys}

        def kept(moved: Collection[int]) -> bool:
            return {slot % self.count for slot in moved} == own

        shifts = range(self.period, self.count + 1, self.period)
        period = next(n for n in shifts if kept([slot + n for slot in own]))
        if self.mirror is None or lopsided(gaps, keys).any():
            return Symmetry(self.count, period, None)
        mirrors = range(self.mirror % self.period, self.count, self.period)
        mirror = next((c for c in mirrors if kept([c - slot for slot in own])), None)
        return Symmetry(self.count, period, None if mirror is None else mirror % period)
