"""Which joints can be turned onto each other: in the plane, or turned over.

A joint that is turned over has its edges the other way around, and its weave with them: no
mirror makes it, for the mirror image of a connector is another part.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from scadgen.frame.graph import Frame
from scadgen.joint.symmetry import Symmetry
from scadgen.solid.affine import Floats, Ints

__all__ = ["JointClass", "congruent_joints"]


@dataclass(frozen=True, slots=True, eq=False)
class JointClass:
    """Joints that are the same.

    Parameters
    ----------
    directions
        ``(k,) float``: directions of its edges, ascending from 0; exactly as symmetric as
        `symmetry` says.
    symmetry
        Which of its edges are alike.
    vertices
        ``(n,) int``: where it stands, ascending.
    """

    directions: Floats
    symmetry: Symmetry
    vertices: Ints


def congruent_joints(frame: Frame, tolerance: float) -> tuple[tuple[JointClass, ...], Ints, Floats]:
    """Group vertices whose directions can be turned onto each other, or turned over onto them.

    Parameters
    ----------
    frame
        The frame.
    tolerance
        How far each direction may be off from the first joint of its class after the best
        turn, in radians.

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
        itself; and the largest difference of a direction then, in radians.
    """
    size = len(frame.vertices)
    places, turns = np.zeros((3, size), dtype=np.int64), np.zeros((2, size))
    joints: list[JointClass] = []
    for degree in np.unique(frame.degree):
        vertices = np.flatnonzero(frame.degree == degree)
        angles = frame.ends.angle[frame.ends.first[vertices, None] + np.arange(degree)]
        gaps = _both_ways(frame.ends.gap[frame.ends.first[vertices, None] + np.arange(degree)])
        first = _first_ways(gaps, tolerance)
        for leader, members in _led(gaps, first, tolerance):
            directions, symmetry = _symmetric(gaps[leader, first[leader]], tolerance)
            which = vertices[members]
            places[0, which] = len(joints)
            places[1:, which], turns[:, which] = _fit(
                directions, symmetry, angles[members], tolerance
            )
            joints.append(JointClass(directions, symmetry, which))
    return tuple(joints), places, turns


def _both_ways(gaps: Floats) -> Floats:
    """Gaps of each vertex from each slot on: counter-clockwise, then from each clockwise.

    ``(n, k) float`` becomes ``(n, 2 k, k)``.
    """
    slots = np.arange(gaps.shape[1])
    onwards = (slots[:, None] + slots) % len(slots)
    back = (slots[:, None] - slots - 1) % len(slots)
    return gaps[:, np.concatenate([onwards, back])]


def _first_ways(gaps: Floats, tolerance: float) -> Ints:
    """For each vertex the way around whose gaps, rounded, come first in the dictionary."""
    coarse = np.rint(gaps / (4 * tolerance)).astype(np.int64)
    best = np.zeros(len(gaps), dtype=np.int64)
    lowest = coarse[:, 0].copy()
    for way in range(1, gaps.shape[1]):
        turned = coarse[:, way]
        differ = turned != lowest
        at = differ.argmax(axis=1)[:, None]
        less = np.take_along_axis(turned, at, 1) < np.take_along_axis(lowest, at, 1)
        less = less[:, 0]
        best[less], lowest[less] = way, turned[less]
    return best


def _led(gaps: Floats, first: Ints, tolerance: float) -> list[tuple[int, Ints]]:
    """Groups around leaders: every joint within the tolerance of the first one left."""
    count, ways, degree = gaps.shape
    begun = gaps[np.arange(count), first]
    order = np.lexsort(np.rint(begun / (4 * tolerance)).T[::-1])
    if degree == 1:
        return [(int(order[0]), np.arange(count))]
    directions = np.cumsum(gaps[:, :, :-1], axis=2)
    tree = cKDTree(directions.reshape(count * ways, degree - 1))
    free = np.ones(count, dtype=bool)
    groups = []
    for leader in order:
        if not free[leader]:
            continue
        own = directions[leader, first[leader]]
        near = np.array(tree.query_ball_point(own, 2 * tolerance, p=np.inf), dtype=np.int64)
        off = directions.reshape(-1, degree - 1)[near] - own
        spread = np.maximum(off.max(axis=1), 0) - np.minimum(off.min(axis=1), 0)
        members = np.unique(near[spread <= 2 * tolerance] // ways)
        members = members[free[members]]
        free[members] = False
        groups.append((int(leader), members))
    return groups


def _symmetric(gaps: Floats, tolerance: float) -> tuple[Floats, Symmetry]:
    """Directions from 0 with these gaps, made exactly symmetric, and which of them are alike."""
    degree = len(gaps)
    slots = np.arange(degree)

    def alike(others: Ints) -> bool:
        return bool((np.ptp(np.cumsum(gaps[others] - gaps, axis=1), axis=1) <= 2 * tolerance).all())

    periods = (p for p in range(1, degree + 1) if degree % p == 0)
    period = next(p for p in periods if alike((slots[::p, None] + slots) % degree))
    # Slot s turned over is c - s, so that gap s, between s and s + 1, becomes gap c - 1 - s.
    mirrors = (c for c in range(period) if alike((c - 1 + slots[::period, None] - slots) % degree))
    mirror = next(mirrors, None)
    symmetry = degree // period
    mean = gaps.reshape(symmetry, period).mean(axis=0)
    if mirror is not None:
        mean = (mean + mean[(mirror - 1 - np.arange(period)) % period]) / 2
    within = np.concatenate([[0.0], np.cumsum(mean)[:-1]])
    starts = 2 * np.pi * np.arange(symmetry) / symmetry
    return (starts[:, None] + within).ravel(), Symmetry(degree, period, mirror)


def _fit(
    directions: Floats, symmetry: Symmetry, angles: Floats, tolerance: float
) -> tuple[Ints, Floats]:
    """Places and turns, as above, that put a class's directions best on those of vertices."""
    degree = len(directions)
    slots = np.arange(degree)
    onwards = angles[:, (slots[:, None] + slots) % degree]
    off = (onwards - onwards[:, :, :1]) % (2 * np.pi) - directions
    if symmetry.mirror is None:
        back = angles[:, (slots[:, None] - slots) % degree]
        off = np.concatenate([off, (back[:, :, :1] - back) % (2 * np.pi) - directions], axis=1)
    low, high = off.min(axis=2), off.max(axis=2)
    way = (high - low).argmin(axis=1)
    row = np.arange(len(angles))
    over, shift = way // degree, way % degree
    turn = (angles[row, shift] + (1 - 2 * over) * (low + high)[row, way] / 2) % (2 * np.pi)
    turn, steps = symmetry.least_turn(turn, tolerance)
    shift = (shift - steps * symmetry.period) % degree
    return np.stack([over, shift]), np.stack([turn, (high - low)[row, way] / 2])
