"""Which joints can be turned onto each other.

Never by a mirror: the mirror image of a connector is another part.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from scadgen.frame.graph import Frame
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
        In how many ways it can be turned onto itself.
    vertices
        ``(n,) int``: where it stands, ascending.
    """

    directions: Floats
    symmetry: int
    vertices: Ints

    @property
    def period(self) -> int:
        """Slots that differ by this are alike."""
        return len(self.directions) // self.symmetry


def congruent_joints(frame: Frame, tolerance: float) -> tuple[tuple[JointClass, ...], Ints, Floats]:
    """Group vertices whose directions can be turned onto each other.

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
        ``(2, n) int``: class of each vertex, and its shift: edge k of the class becomes slot
        ``(k + shift) % degree`` of the vertex.
    turns
        ``(2, n) float``: the angle that maps the class's directions to the vertex's, from
        0 (less by the tolerance at most) to before 2 pi / symmetry; and the largest
        difference of a direction then, in radians.
    """
    size = len(frame.vertices)
    places, turns = np.zeros((2, size), dtype=np.int64), np.zeros((2, size))
    joints: list[JointClass] = []
    for degree in np.unique(frame.degree):
        vertices = np.flatnonzero(frame.degree == degree)
        angles = frame.ends.angle[frame.ends.first[vertices, None] + np.arange(degree)]
        gaps = frame.ends.gap[frame.ends.first[vertices, None] + np.arange(degree)]
        first = _first_slots(gaps, tolerance)
        for leader, members in _led(gaps, first, tolerance):
            directions, symmetry = _symmetric(np.roll(gaps[leader], -first[leader]), tolerance)
            which = vertices[members]
            places[0, which] = len(joints)
            places[1, which], *fits = _fit(directions, symmetry, angles[members], tolerance)
            turns[:, which] = fits
            joints.append(JointClass(directions, symmetry, which))
    return tuple(joints), places, turns


def _first_slots(gaps: Floats, tolerance: float) -> Ints:
    """For each vertex the slot from which its gaps, rounded, come first in the dictionary."""
    coarse = np.rint(gaps / (4 * tolerance)).astype(np.int64)
    best = np.zeros(len(gaps), dtype=np.int64)
    lowest = coarse.copy()
    for slot in range(1, gaps.shape[1]):
        turned = np.roll(coarse, -slot, axis=1)
        differ = turned != lowest
        at = differ.argmax(axis=1)[:, None]
        less = np.take_along_axis(turned, at, 1) < np.take_along_axis(lowest, at, 1)
        less = less[:, 0]
        best[less], lowest[less] = slot, turned[less]
    return best


def _led(gaps: Floats, first: Ints, tolerance: float) -> list[tuple[int, Ints]]:
    """Groups around leaders: every joint within the tolerance of the first one left."""
    count, degree = gaps.shape
    slots = np.arange(degree)
    begun = gaps[np.arange(count)[:, None], (first[:, None] + slots) % degree]
    order = np.lexsort(np.rint(begun / (4 * tolerance)).T[::-1])
    if degree == 1:
        return [(int(order[0]), np.arange(count))]
    turned = gaps[:, (slots[:, None] + slots) % degree]
    directions = np.cumsum(turned[:, :, :-1], axis=2)
    tree = cKDTree(directions.reshape(count * degree, degree - 1))
    free = np.ones(count, dtype=bool)
    groups = []
    for leader in order:
        if not free[leader]:
            continue
        own = directions[leader, first[leader]]
        near = np.array(tree.query_ball_point(own, 2 * tolerance, p=np.inf), dtype=np.int64)
        off = directions.reshape(-1, degree - 1)[near] - own
        spread = np.maximum(off.max(axis=1), 0) - np.minimum(off.min(axis=1), 0)
        members = np.unique(near[spread <= 2 * tolerance] // degree)
        members = members[free[members]]
        free[members] = False
        groups.append((int(leader), members))
    return groups


def _symmetric(gaps: Floats, tolerance: float) -> tuple[Floats, int]:
    """Directions from 0 with these gaps, made exactly symmetric; in how many turns they are."""
    degree = len(gaps)
    for period in (p for p in range(1, degree + 1) if degree % p == 0):
        turned = np.stack([np.roll(gaps, -start) for start in range(0, degree, period)])
        off = np.cumsum(turned - gaps, axis=1)
        if (np.ptp(off, axis=1) <= 2 * tolerance).all():
            break
    symmetry = degree // period
    mean = gaps.reshape(symmetry, period).mean(axis=0)
    within = np.concatenate([[0.0], np.cumsum(mean)[:-1]])
    starts = 2 * np.pi * np.arange(symmetry) / symmetry
    return (starts[:, None] + within).ravel(), symmetry


def _fit(
    directions: Floats, symmetry: int, angles: Floats, tolerance: float
) -> tuple[Ints, Floats, Floats]:
    """Shift, turn and error that put a class's directions best on those of vertices."""
    degree = len(directions)
    slots = np.arange(degree)
    seen = angles[:, (slots[:, None] + slots) % degree]
    off = (seen - seen[:, :, :1]) % (2 * np.pi) - directions
    low, high = off.min(axis=2), off.max(axis=2)
    shift = (high - low).argmin(axis=1)
    row = np.arange(len(angles))
    turn = (seen[row, shift, 0] + (low + high)[row, shift] / 2) % (2 * np.pi)
    alike = np.floor((turn + tolerance) * symmetry / (2 * np.pi)).astype(np.int64)
    turn = turn - alike * (2 * np.pi / symmetry)
    shift = (shift - alike * (degree // symmetry)) % degree
    return shift, turn, (high - low)[row, shift] / 2
