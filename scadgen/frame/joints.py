"""Whether a joint can stand at every vertex, and what its ring needs.

Lengths are in sides of the tubes where nothing else is said.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from scadgen.errors import GeometryError
from scadgen.frame.graph import Frame
from scadgen.frame.planarity import where
from scadgen.solid.affine import Floats

__all__ = [
    "check_ring_ratios",
    "least_gap",
    "least_ring_ratio",
    "least_scale",
    "ring_ratios",
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


def ring_ratios(frame: Frame, spacing: float = 0.0) -> Floats:
    """`least_ring_ratio` of each vertex: ``(n,) float``."""
    need = _least(frame.ends.gap / 2, spacing)
    return np.asarray(np.maximum.reduceat(need, frame.ends.first[:-1]))


def check_ring_ratios(frame: Frame, most: float, spacing: float = 0.0) -> None:
    """Refuse vertices that no joint can stand at.

    Parameters
    ----------
    frame
        The frame.
    most
        Largest ring ratio there is.
    spacing
        Least distance of two tubes where they start, in sides.

    Raises
    ------
    GeometryError
        A vertex has one edge only, or two edges so close that their tubes would overlap on
        the largest ring: which vertex, and what it needs.
    """
    loose = np.flatnonzero(frame.degree < 2)
    if len(loose):
        msg = (
            f"vertex {loose[0]} at {where(frame.vertices[loose[0]])} has one edge"
            f"{_more(len(loose))}: a joint needs two"
        )
        raise GeometryError(msg)
    need = ring_ratios(frame, spacing)
    count = np.count_nonzero(need >= most)
    if count:
        worst = int(need.argmax())
        gap = math.degrees(frame.gaps(worst).min())
        msg = (
            f"vertex {worst} at {where(frame.vertices[worst])}: edges {gap:.4g} degrees apart "
            f"need a ring ratio over {need[worst]:.4g}{_more(int(count))}; at most {most:g} works, "
            f"for {math.degrees(least_gap(most, spacing)):.4g} degrees and more"
        )
        raise GeometryError(msg)


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


def _more(count: int) -> str:
    return f" (and {count - 1} more)" if count > 1 else ""
