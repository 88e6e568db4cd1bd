"""Whether a joint can stand at every vertex, and what its ring needs.

Lengths are in sides of the tubes where nothing else is said.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from scadgen.frame.graph import Frame
from scadgen.solid.affine import Floats

__all__ = [
    "least_gap",
    "least_ring_ratio",
    "least_scale",
    "tube_start",
]


def tube_start(ring_ratio: ArrayLike) -> Floats:
    """Distance from the axis of a joint at which its tubes start, in sides."""
    return np.asarray(np.sqrt((np.asarray(ring_ratio, dtype=float) + 0.5) ** 2 - 0.25))


def least_ring_ratio(gaps: ArrayLike, spacing: float = 0.0) -> float:
    """The ring ratio from which on the tubes of a joint keep their distance.

    Where tubes start, at distance X from the axis, neighbours a gap g apart are
    2 X sin(g/2) - cos(g/2) from corner to corner.

    Parameters
    ----------
    gaps
        Angles between neighbouring edges, in radians.
    spacing
        Least distance of two tubes, in sides; at 0 they touch, and a joint needs a little
        more than the result.

    Examples
    --------
    >>> least_ring_ratio([2.0, 4.283]) < least_ring_ratio([1.0, 5.283])
    True
    """
    half = np.asarray(gaps, dtype=float) / 2
    return float(_least(half, spacing).max())


def least_gap(ring_ratio: float, spacing: float = 0.0) -> float:
    """The smallest angle between neighbouring edges that a ring can hold, in radians."""
    # 2 X sin h - cos h = hypot(2 X, 1) sin(h - atan(1 / (2 X))).
    start = float(tube_start(ring_ratio))
    share = spacing / math.hypot(2 * start, 1.0)
    return 2 * (math.asin(min(share, 1.0)) + math.atan2(1.0, 2 * start))


def least_scale(frame: Frame, side: float, ring_ratio: ArrayLike, rest: float = 0.0) -> float:
    """How many times as large a frame must be at least, so that no edge is too short.

    Parameters
    ----------
    frame
        The frame.
    side
        Side of the tubes, in mm.
    ring_ratio
        Of all joints, or of each vertex: ``(n,) float``.
    rest
        Least length of a tube between two joints, in sides.
    """
    start = np.broadcast_to(tube_start(ring_ratio), len(frame.vertices))
    return float((side * (start[frame.edges].sum(axis=1) + rest) / frame.lengths).max())


def _least(half: Floats, spacing: float) -> Floats:
    """Ring ratio that each half gap needs; one of a half turn, without another edge, none."""
    start = (spacing + np.cos(half)) / (2 * np.maximum(np.sin(half), 1e-12))
    start = np.where(half > np.pi - 1e-9, 0.0, np.maximum(start, 0.0))
    return np.asarray(np.sqrt(start**2 + 0.25) - 0.5)
