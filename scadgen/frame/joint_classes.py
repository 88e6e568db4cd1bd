"""Which joints can be turned onto each other: about their axis, or turned over.

A joint that is turned over has its edges the other way around, what sloped down slopes up, and its
weave goes with them: no mirror makes it, for the mirror image of a connector is another part.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.spatial import cKDTree

from scadgen.frame.graph import Frame
from scadgen.joint.symmetry import Symmetry
from scadgen.solid.affine import Floats, Ints

__all__ = ["JointClass", "classify_joints"]


@dataclass(frozen=True, slots=True, eq=False)
class JointClass:
    """Joints that are the same.

    Parameters
    ----------
    directions
        ``(k,) float``: directions of its edges, ascending from 0; exactly as symmetric as
        `symmetry` says.
    slopes
        ``(k,) float``: how far each points below the plane of its ring, in radians; as symmetric.
    symmetry
        Which of its edges are alike.
    vertices
        ``(n,) int``: where it stands, ascending.
    """

    directions: Floats
    slopes: Floats
    symmetry: Symmetry
    vertices: Ints


def classify_joints(frame: Frame, tolerance: float) -> tuple[tuple[JointClass, ...], Ints, Floats]:
    """Group vertices whose edges can be turned onto each other, or turned over onto them.

    Parameters
    ----------
    frame
        The frame.
    tolerance
        How far each direction and slope may be off from the first joint of its class after the
        best turn, in radians.

    Returns
    -------
    joints
        The classes, by number of edges, then by gaps.
    places
        ``(3, n) int``: class of each vertex; whether the class is turned over to be there, 0 or
        1, never if it can be turned over onto itself; and its shift: edge k of the class becomes
        slot ``(shift + k) % degree`` of the vertex, turned over ``(shift - k) % degree``.
    turns
        ``(2, n) float``: direction of the class's first edge at the vertex, which the others
        follow counter-clockwise, or clockwise where it is turned over; from 0 (less by the
        tolerance at most) to before a full turn by the number of ways it can be turned onto
        itself; and the largest difference of a direction or slope then, in radians.
    """
    size = len(frame.vertices)
    places, turns = np.zeros((3, size), dtype=np.int64), np.zeros((2, size))
    joints: list[JointClass] = []
    for degree in np.unique(frame.degree):
        vertices = np.flatnonzero(frame.degree == degree)
        ends = frame.ends.first[vertices, None] + np.arange(degree)
        angles = frame.ends.angle[ends]
        ways = _Ways.of(frame.ends.gap[ends], frame.ends.slope[ends])
        first = _first_ways(ways, tolerance)
        for leader, members in _led(ways, first, tolerance):
            own = leader, first[leader]
            directions, slopes, symmetry = _symmetric(ways.gaps[own], ways.slopes[own], tolerance)
            which = vertices[members]
            places[0, which] = len(joints)
            one = JointClass(directions, slopes, symmetry, which)
            places[1:, which], turns[:, which] = _fit(
                one, angles[members], ways.slopes[members], tolerance
            )
            joints.append(one)
    return tuple(joints), places, turns


@dataclass(frozen=True, slots=True, eq=False)
class _Ways:
    """All ways to look at joints of k edges: from each slot on, then turned over from each.

    Parameters
    ----------
    gaps, slopes
        ``(n, 2 k, k) float``: of each joint, each way; a slope is turned over with its edge.
    """

    gaps: Floats
    slopes: Floats

    @classmethod
    def of(cls, gaps: Floats, slopes: Floats) -> Self:
        """Those of joints with these gaps and slopes, both ``(n, k)``."""
        onwards, back = _slots(gaps.shape[1])
        turned = np.concatenate([slopes[:, onwards], -slopes[:, back]], axis=1) + 0.0
        return cls(gaps[:, np.concatenate([onwards, back - 1])], turned)


def _slots(degree: int) -> tuple[Ints, Ints]:
    """The slots from each on, ``(k, k)``; and those that follow each when it is turned over."""
    slots = np.arange(degree)
    return (slots[:, None] + slots) % degree, (slots[:, None] - slots) % degree


def _first_ways(ways: _Ways, tolerance: float) -> Ints:
    """For each vertex the way whose gaps and slopes, rounded, come first in the dictionary."""
    coarse = _coarse(ways.gaps, ways.slopes, tolerance)
    best = np.zeros(len(coarse), dtype=np.int64)
    lowest = coarse[:, 0].copy()
    for way in range(1, coarse.shape[1]):
        turned = coarse[:, way]
        differ = turned != lowest
        at = differ.argmax(axis=1)[:, None]
        less = np.take_along_axis(turned, at, 1) < np.take_along_axis(lowest, at, 1)
        less = less[:, 0]
        best[less], lowest[less] = way, turned[less]
    return best


def _coarse(gaps: Floats, slopes: Floats, tolerance: float) -> Ints:
    """Gaps, then slopes, in whole numbers that are the same for most that are alike.

    Slopes that descend come first, as at a vertex of a dome.
    """
    both = np.concatenate([gaps, -slopes], axis=-1)
    return np.asarray(np.rint(both / (4 * tolerance)), dtype=np.int64)


def _led(ways: _Ways, first: Ints, tolerance: float) -> list[tuple[int, Ints]]:
    """Groups around leaders: every joint within the tolerance of the first one left."""
    count, number, degree = ways.gaps.shape
    row = np.arange(count)
    begun = _coarse(ways.gaps[row, first], ways.slopes[row, first], tolerance)
    directions = np.cumsum(ways.gaps[:, :, :-1], axis=2)
    looks = np.concatenate([directions, ways.slopes], axis=2)
    every = looks.reshape(count * number, -1)
    tree = cKDTree(every)
    free = np.ones(count, dtype=bool)
    groups = []
    for leader in np.lexsort(begun.T[::-1]):
        if not free[leader]:
            continue
        own = looks[leader, first[leader]]
        near = np.array(tree.query_ball_point(own, 2 * tolerance, p=np.inf), dtype=np.int64)
        off = every[near] - own
        aside, down = off[:, : degree - 1], np.abs(off[:, degree - 1 :]).max(axis=1)
        spread = aside.max(axis=1, initial=0) - aside.min(axis=1, initial=0)
        members = np.unique(near[(spread <= 2 * tolerance) & (down <= tolerance)] // number)
        members = members[free[members]]
        free[members] = False
        groups.append((int(leader), members))
    return groups


def _symmetric(gaps: Floats, slopes: Floats, tolerance: float) -> tuple[Floats, Floats, Symmetry]:
    """Directions from 0 with these gaps, and slopes, made exactly symmetric; which are alike."""
    degree = len(gaps)
    ways = _Ways.of(gaps[None], slopes[None])
    turns = np.ptp(np.cumsum(ways.gaps[0] - gaps, axis=1), axis=1)
    leans = np.abs(ways.slopes[0] - slopes).max(axis=1)
    same = (turns <= 2 * tolerance) & (leans <= 2 * tolerance)
    onwards, back = same[:degree], same[degree:]
    period = next(p for p in range(1, degree + 1) if degree % p == 0 and onwards[::p].all())
    # Slot s turned over is c - s, so that gap s, between s and s + 1, becomes gap c - 1 - s.
    mirror = next((c for c in range(period) if back[c::period].all()), None)
    symmetry = degree // period
    mean, lean = (values.reshape(symmetry, period).mean(axis=0) for values in (gaps, slopes))
    if mirror is not None:
        mean = (mean + mean[(mirror - 1 - np.arange(period)) % period]) / 2
        lean = (lean - lean[(mirror - np.arange(period)) % period]) / 2
    within = np.concatenate([[0.0], np.cumsum(mean)[:-1]])
    starts = 2 * np.pi * np.arange(symmetry) / symmetry
    directions = (starts[:, None] + within).ravel()
    return directions, np.tile(lean + 0.0, symmetry), Symmetry(degree, period, mirror)


def _fit(one: JointClass, angles: Floats, slopes: Floats, tolerance: float) -> tuple[Ints, Floats]:
    """Places and turns, as above, that put a class's edges best on those of vertices.

    Parameters
    ----------
    one
        The class.
    angles
        ``(n, k) float``: directions of the vertices' edges.
    slopes
        ``(n, 2 k, k) float``: their slopes, each way.
    tolerance
        As above.
    """
    degree = len(one.directions)
    onwards, back = (angles[:, slots] for slots in _slots(degree))
    off = (onwards - onwards[:, :, :1]) % (2 * np.pi) - one.directions
    if one.symmetry.mirror is None:
        off = np.concatenate([off, (back[:, :, :1] - back) % (2 * np.pi) - one.directions], axis=1)
    low, high = off.min(axis=2), off.max(axis=2)
    lean = np.abs(slopes[:, : off.shape[1]] - one.slopes).max(axis=2)
    error = np.maximum((high - low) / 2, lean)
    way = error.argmin(axis=1)
    row = np.arange(len(angles))
    over, shift = way // degree, way % degree
    turn = (angles[row, shift] + (1 - 2 * over) * (low + high)[row, way] / 2) % (2 * np.pi)
    turn, steps = one.symmetry.least_turn(turn, tolerance)
    shift = (shift - steps * one.symmetry.period) % degree
    return np.stack([over, shift]), np.stack([turn, error[row, way]])
