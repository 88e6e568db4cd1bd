"""What one vertex looks like: the azimuths at which its edges leave it, and their slopes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from scadgen.errors import InputError
from scadgen.joint.symmetry import Symmetry
from scadgen.solid.affine import Floats

__all__ = ["STEEPEST", "Spokes"]

#: Steepest slope of an edge, in radians: rings have been proved up to 55 degrees.
STEEPEST = math.radians(60)

#: Angles as near to each other as this are the same, in radians.
_SAME = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Spokes:
    """The edges of a joint, seen along its ring's axis.

    Parameters
    ----------
    azimuths
        ``(k,) float``: directions of the edges in the ring's plane, ascending, in [0, 2 pi).
    slopes
        ``(k,) float``: how far each edge points below the ring's plane, in radians.

    Raises
    ------
    InputError
        Fewer than two edges, directions that do not ascend, or a slope that is too steep.
    """

    azimuths: Floats
    slopes: Floats

    def __post_init__(self) -> None:
        """Refuse what no ring can be made of."""
        azimuths, slopes = self.azimuths, self.slopes
        if len(azimuths) < 2 or not (self.gaps > 0).all() or azimuths[0] < 0:
            msg = f"edges {azimuths.tolist()}: must be two or more ascending angles in [0, 2 pi)"
            raise InputError(msg)
        if slopes.shape != azimuths.shape or not (np.abs(slopes) <= STEEPEST).all():
            most = math.degrees(STEEPEST)
            given = ", ".join(f"{slope:.4g}" for slope in np.degrees(slopes))
            msg = f"slopes {given}: must be one an edge, from -{most:g} to {most:g} degrees"
            raise InputError(msg)

    @classmethod
    def of(cls, azimuths: Sequence[float] | Floats, slopes: Sequence[float] | Floats) -> Self:
        """Spokes from sequences of numbers."""
        return cls(np.asarray(azimuths, dtype=float), np.asarray(slopes, dtype=float))

    @classmethod
    def flat(cls, directions: Sequence[float] | Floats) -> Self:
        """Those of a vertex whose edges lie in one plane, by their directions in it."""
        azimuths = np.asarray(directions, dtype=float)
        return cls(azimuths, np.zeros_like(azimuths))

    def __len__(self) -> int:
        """How many edges there are."""
        return len(self.azimuths)

    @property
    def gaps(self) -> Floats:
        """Angle from each edge to the next, ``(k,)``."""
        return np.diff(np.append(self.azimuths, self.azimuths[:1] + 2 * np.pi))

    def level(self, edge: int) -> bool:
        """Whether an edge lies in the ring's plane."""
        return bool(abs(self.slopes[edge]) <= _SAME)

    def seen_from(self, edge: int) -> Spokes:
        """The same joint turned so that this edge is the first, at azimuth 0."""
        turned = np.roll(self.gaps, -edge)
        return Spokes(np.cumsum(turned) - turned, np.roll(self.slopes, -edge))

    def turned_over(self) -> Spokes:
        """The joint turned over about its first edge's azimuth: edge s is where ``-s`` was.

        Gaps follow the other way around, and what sloped down slopes up.
        """
        gaps = self.gaps[::-1]
        return Spokes(np.cumsum(gaps) - gaps, -np.roll(self.slopes[::-1], 1))

    def is_like(self, other: Spokes, tolerance: float = _SAME) -> bool:
        """Whether the joint is another one after a turn about the axis alone.

        Parameters
        ----------
        other
            One with as many edges; its first is this one's first.
        tolerance
            How far each direction and each slope may be off after the best turn, in radians.
        """
        turns = np.cumsum(self.gaps - other.gaps)
        off = np.abs(self.slopes - other.slopes).max()
        return bool(np.ptp(turns) <= 2 * tolerance and off <= 2 * tolerance)

    def symmetry(self, walls: Floats | None = None, tolerance: float = _SAME) -> Symmetry:
        """Which of its edges are alike: after a turn about the axis, or after it is turned over.

        Parameters
        ----------
        walls
            ``(k,) float``: angle from each edge to the wall after it, where walls count as well; by
            default they are in the middle of their gaps.
        tolerance
            As for `is_like`.
        """
        count = len(self)
        own = self if walls is None else self._with_walls(walls)
        step = len(own) // count
        over = own.turned_over()
        periods = (n for n in range(1, count + 1) if count % n == 0)
        period = next(n for n in periods if own.is_like(own.seen_from(n * step), tolerance))
        mirrors = (c for c in range(period) if own.is_like(over.seen_from(-c * step), tolerance))
        return Symmetry(count, period, next(mirrors, None))

    def _with_walls(self, walls: Floats) -> Spokes:
        """Each wall as if it were an edge in the plane, after the edge that it follows."""
        first = self.azimuths - self.azimuths[0]
        azimuths = np.column_stack([first, first + walls]).ravel()
        return Spokes(azimuths, np.column_stack([self.slopes, 0 * self.slopes]).ravel())
