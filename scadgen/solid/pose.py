"""A pose: where something is in space, and which way its axes point there.

One value for all that is placed: parts, joints, ways, pictures.  Its axes are right-handed.  Turns
by whole quarters, and half turns, are exact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from scadgen.solid.affine import Floats

__all__ = ["HERE", "OVER", "Pose", "Vector"]

Vector = tuple[float, float, float]

#: Sine and cosine of whole quarters of a turn.
_QUARTERS = ((0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0))


@dataclass(frozen=True, eq=True)
class Pose:
    """Position and axes.

    A point p of what is placed is at ``at + p[0] * x + p[1] * y + p[2] * z``, with y = z cross x.

    Parameters
    ----------
    at
        Position of its origin, in whatever unit it is used with.
    x, z
        Directions of its x and z axes: unit vectors square to each other.
    """

    at: Vector = (0.0, 0.0, 0.0)
    x: Vector = (1.0, 0.0, 0.0)
    z: Vector = (0.0, 0.0, 1.0)

    @classmethod
    def flat(cls, at: Sequence[float], degrees: float = 0.0, *, over: bool = False) -> Pose:
        """One in the plane z = 0: a half turn about x if it is turned over, then a turn about z.

        Parameters
        ----------
        at
            Position, ``(2,)`` or ``(3,)``.
        degrees
            Direction of its x axis, in degrees counter-clockwise from x.
        over
            Whether it is turned over, so that its z axis points down.
        """
        s, c = _sine_and_cosine(degrees)
        px, py, pz = (float(v) for v in (*at, 0.0)[:3])
        return cls((px, py, pz), (c, s, 0.0), (0.0, 0.0, -1.0 if over else 1.0))

    @classmethod
    def of(cls, at: ArrayLike, axes: ArrayLike) -> Pose:
        """One with these axes: rows x, y, z, ``(3, 3) float``."""
        rows = np.asarray(axes, dtype=np.float64) + 0.0
        return cls(_vector(np.asarray(at, dtype=np.float64)), _vector(rows[0]), _vector(rows[2]))

    @cached_property
    def axes(self) -> Floats:
        """``(3, 3) float``: its axes as rows."""
        (a, b, c), (u, v, w) = self.x, self.z
        y = (v * c - w * b, w * a - u * c, u * b - v * a)
        axes = np.array([self.x, y, self.z]) + 0.0
        axes.setflags(write=False)
        return axes

    @property
    def matrix(self) -> Floats:
        """``(4, 4) float``: what takes points of what is placed to where they are."""
        found = np.eye(4)
        found[:3, :3] = self.axes.T
        found[:3, 3] = self.at
        return found

    @property
    def over(self) -> bool:
        """Whether its z axis points down."""
        return self.z[2] < 0

    @property
    def degrees(self) -> float:
        """Direction of its x axis as seen from above, in degrees, from 0 to before 360."""
        found = math.degrees(math.atan2(self.x[1], self.x[0])) % 360
        return 0.0 if found == 360 else found  # what is hardly below 0

    def apply(self, points: ArrayLike) -> Floats:
        """Where points, ``(..., 3)``, of what is placed are."""
        return np.asarray(self.turn(points) + np.array(self.at))

    def turn(self, vectors: ArrayLike) -> Floats:
        """Where vectors, ``(..., 3)``, of what is placed point."""
        return np.asarray(np.asarray(vectors, dtype=np.float64) @ self.axes)

    def __matmul__(self, other: Pose) -> Pose:
        """The pose of `other`, given in this one's axes, in the axes that this one is in."""
        return Pose.of(self.apply(other.at), other.axes @ self.axes)

    def inverse(self) -> Pose:
        """The motion back: ``pose.inverse() @ pose`` is `HERE`."""
        return Pose.of(-(np.array(self.at) @ self.axes.T), self.axes.T)

    def scaled(self, factor: float) -> Pose:
        """The same axes, some times as far from the origin: for another unit."""
        x, y, z = (factor * v for v in self.at)
        return Pose((x, y, z), self.x, self.z)

    def moved(self, by: Sequence[float]) -> Pose:
        """The same axes elsewhere."""
        x, y, z = (a + float(b) for a, b in zip(self.at, by, strict=True))
        return Pose((x, y, z), self.x, self.z)

    def rounded(self, decimals: int) -> Pose:
        """The same with all its numbers rounded, so that what is alike is the same."""
        at, x, z = (np.round(v, decimals) + 0.0 for v in (self.at, self.x, self.z))
        return Pose(_vector(at), _vector(x), _vector(z))


def _sine_and_cosine(degrees: float) -> tuple[float, float]:
    quarters, rest = divmod(degrees, 90.0)
    if rest == 0:
        return _QUARTERS[int(quarters) % 4]
    angle = math.radians(degrees)
    return math.sin(angle), math.cos(angle)


def _vector(values: Any) -> Vector:  # noqa: ANN401  rows of an array are typed so
    x, y, z = values.tolist()
    return x, y, z


#: Where things are that are not placed.
HERE = Pose()

#: A half turn about x.
OVER = Pose(z=(0.0, 0.0, -1.0))
