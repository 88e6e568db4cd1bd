"""Arms of site curves: how one weaves away from its edge, and where it follows the ring.

See ``docs/geometry.md``, step 2.  Lengths are in units of the side, angles in radians.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from scadgen.joint.weave import Weave
from scadgen.solid.affine import Floats, Ints

__all__ = ["Arms", "Vectors", "derivatives", "way_of"]

#: How gently an arm that followed the ring begins to weave, in sides.
_GENTLE = 0.25


class Vectors(NamedTuple):
    """Vectors in space: their part in plan as x + iy, so that turning is a product, and z."""

    plan: NDArray[np.complex128]
    height: Floats

    def dot(self, other: Vectors) -> Floats:
        """Scalar products."""
        return np.asarray((self.plan.conj() * other.plan).real + self.height * other.height)

    def less(self, other: Vectors) -> Vectors:
        """Differences."""
        return Vectors(self.plan - other.plan, self.height - other.height)

    def stacked(self) -> Floats:
        """Shape ``(..., 3)``."""
        return np.stack([self.plan.real, self.plan.imag, self.height], axis=-1)

    def rows(self, some: Ints) -> Vectors:
        """Some of them."""
        return Vectors(self.plan.take(some), self.height.take(some))


class Arms(NamedTuple):
    """Of one curve, or of each of several points: which way it leaves, and its arms.

    Their last axis is of what comes before the edge and what comes after it.
    """

    angle: Floats
    plain: Floats
    reach: Floats
    rate: Floats

    def of(self, curve: Ints, after: Ints) -> Arms:
        """One arm a point, of these of several curves."""
        return Arms(self.angle[curve], *(each[curve, after] for each in self[1:]))


def derivatives(weave: Weave, arms: Arms, u: Floats) -> tuple[Vectors, Vectors, Vectors]:
    """Position, first and second derivative by ``u`` of points on arms.

    The woven arm at its own length, carried along the ring by what it starts late.

    Parameters
    ----------
    weave
        Their weave.
    arms
        One a point.
    u
        ``(...) float``: parameters in [-1, 1], below 0 before the edge.
    """
    angle, plain, reach, rate = arms
    way = u * rate
    length, slope, curve = _delayed(way, plain)
    place, first, second = _woven(weave, length, reach)
    radius = weave.ring_ratio
    carried = np.exp(1j * (angle + (way - length) / radius))
    spin = 1j * (1 - slope) / radius
    along, across = slope * rate * carried, spin * rate * carried
    return (
        Vectors(carried * place.plan, place.height),
        Vectors(across * place.plan + along * first.plan, slope * rate * first.height),
        Vectors(
            carried
            * rate**2
            * (
                (spin**2 - 1j * curve / radius) * place.plan
                + (2 * spin * slope + curve) * first.plan
                + slope**2 * second.plan
            ),
            rate**2 * (curve * first.height + slope**2 * second.height),
        ),
    )


def _woven(weave: Weave, length: Floats, reach: Floats) -> tuple[Vectors, Vectors, Vectors]:
    """An arm that weaves from its edge on: place and derivatives by its length in plan."""
    bend = weave.bend / weave.ring_ratio
    half = length * bend / 2
    # (sin t)/b by way of sinc, so that a straight curve (b = 0) is no special case.
    turned = np.exp(1j * half)
    wave = math.pi * weave.periods / reach
    phase = wave * length
    rise, fall = weave.amplitude * np.sin(phase), weave.amplitude * np.cos(phase)
    return (
        Vectors(weave.ring_ratio + 1j * length * np.sinc(half / np.pi) * turned, rise),
        Vectors(1j * turned**2, wave * fall),
        Vectors(-bend * turned**2, -(wave**2) * rise),
    )


def _delayed(way: Floats, plain: Floats) -> tuple[Floats, Floats, Floats]:
    """A length that starts to grow after a plain one, smoothly and oddly, and its derivatives.

    It is ``way`` less ``plain`` further out, and nearly 0 within.
    """
    if not np.any(plain):
        return way, np.ones_like(way), np.zeros_like(way)
    (after, rise), (before, fall) = (
        _soft_size((way + sign * plain) / _GENTLE) for sign in (1.0, -1.0)
    )
    return (
        way - _GENTLE / 2 * (after - before),
        1 - (rise - fall) / 2,
        (rise**2 - fall**2) / (2 * _GENTLE),
    )


def _soft_size(x: Floats) -> tuple[Floats, Floats]:
    """Log 2 cosh x, which is nearly its size, and its derivative tanh x."""
    size = np.abs(x)
    small = np.exp(-2 * size)
    return size + np.log1p(small), np.sign(x) * (1 - small) / (1 + small)


def way_of(length: float, plain: float) -> float:
    """The way at which a delayed length is this."""
    if not plain:
        return length

    def short(way: float) -> float:
        return float(_delayed(np.asarray(way), np.asarray(plain))[0]) - length

    return float(brentq(short, 0.0, length + plain + _GENTLE))
