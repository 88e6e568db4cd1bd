"""Roots in [0, 1] of very many cubics at once.

A cubic is a row ``(4,)`` of coefficients, the constant first.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats, Ints

__all__ = ["may_vanish", "roots"]

#: Halvings after which an interval within [0, 1] is as short as roots that nearly coincide are
#: exact, and steps of Newton's from there to the rounding.
_HALVINGS, _STEPS = 27, 2


def _value(cubic: Floats, t: Floats) -> Floats:
    c0, c1, c2, c3 = cubic.T
    value: Floats = c0 + t * (c1 + t * (c2 + t * c3))
    return value


def may_vanish(cubic: Floats, tolerance: Floats) -> NDArray[np.bool_]:
    """Whether a cubic may have a root in [0, 1] without vanishing on all of it.

    A polynomial stays between the least and the greatest of its Bernstein coefficients.
    """
    c0, c1, c2, c3 = cubic.T
    bernstein = np.column_stack([c0, c0 + c1 / 3, c0 + (2 * c1 + c2) / 3, c0 + c1 + c2 + c3])
    low, high = bernstein.min(axis=1), bernstein.max(axis=1)
    touches_zero = (low <= tolerance) & (high >= -tolerance)
    vanishes = (low >= -tolerance) & (high <= tolerance)
    may: NDArray[np.bool_] = touches_zero & ~vanishes
    return may


def _turning_points(cubic: Floats) -> Floats:
    """``(k, 4)``: 0, two points that split [0, 1] where the cubic turns, and 1."""
    _, c, half_b, third_a = cubic.T
    a, b = 3 * third_a, 2 * half_b
    root = np.sqrt(np.maximum(b * b - 4 * a * c, 0))
    q = -(b + np.copysign(root, b)) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = np.column_stack([q / a, c / q])
    # A split too many is harmless, so what is no number may become one.
    inner = np.clip(np.nan_to_num(inner, nan=0.0), 0, 1)
    inner.sort(axis=1)
    return np.column_stack([np.zeros(len(a)), inner, np.ones(len(a))])


def roots(cubic: Floats, tolerance: Floats) -> tuple[Ints, Floats]:
    """All roots in [0, 1], as the cubic's number and t; turning points near zero count."""
    split = _turning_points(cubic)
    value = np.column_stack([_value(cubic, t) for t in split.T])
    grazing, column = np.nonzero(np.abs(value) <= tolerance[:, None])
    which, piece = np.nonzero(np.sign(value[:, :-1]) * np.sign(value[:, 1:]) < 0)
    low, high = split[which, piece], split[which, piece + 1]
    rising, own = value[which, piece] < 0, cubic[which]
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        before = (_value(own, middle) < 0) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    t = (low + high) / 2
    for _ in range(_STEPS):
        _, c1, c2, c3 = own.T
        slope = c1 + t * (2 * c2 + 3 * t * c3)
        step = np.divide(_value(own, t), slope, out=np.zeros_like(t), where=slope != 0)
        t = np.clip(t - step, low, high)
    number = np.concatenate([which, grazing])
    return number, np.concatenate([t, split[grazing, column]])
