"""Ways out of a joint that need no search: motions that open all contacts of a piece at once.

The walls of joints of any gaps are such (`any_joint`) that a piece that goes up or down, and
turns a little on its way, leaves all that it touches.  A linear program finds the turn.  It is a
proposal: that the piece then touches nothing on all its way is proved like that of any other.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator
from functools import cached_property

import numpy as np
from scipy.optimize import linprog

from scadgen.check.geometry import lattice_of
from scadgen.check.joint_contacts import whole_contacts
from scadgen.interlock.contacts import Contacts
from scadgen.interlock.path import Path
from scadgen.joint.joint import DETAILS
from scadgen.kit.model import Joint, Kit
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.pose import Pose

__all__ = ["Openings"]

#: Shares of the fastest opening for which the least motion is sought.
_SHARES = (0.5, 0.9, 0.2, 0.05)

#: Opening below which nothing opens, in sides a side.
_SHUT = 1e-6

#: How far a piece goes up or down, in sides, and how far of that it goes aside and turns.
_UP, _ASIDE = 1.6, 0.8

#: Poses of a way.
_POSES = 9

#: A contact: a point and the unit vector there by which the piece leaves.
_Touch = tuple[Floats, Floats]


class Openings:
    """What may take a joint's pieces out.

    Parameters
    ----------
    kit, joint
        The joint and its kit.
    """

    def __init__(self, kit: Kit, joint: Joint) -> None:
        self._joint, self._detail = joint, DETAILS[kit.detail]
        count = len(joint.turns)
        self._edge = [place.slot for place in joint.pieces]
        # The gaps in which each piece has a wall.
        self._walls_of: list[set[int]] = []
        for edge, place in zip(self._edge, joint.pieces, strict=True):
            after, before = edge, (edge - 1) % count
            walls = {"half_a": {after}, "half_b": {before}, "cap": {before, after}}
            self._walls_of.append(walls.get(place.role, set()))

    @cached_property
    def _walls(self) -> tuple[Contacts, Ints]:
        """Contacts of the whole connectors, and the gap that each is in."""
        _, contacts = whole_contacts(*lattice_of(self._joint, self._detail))
        angles = np.arctan2(contacts.points[:, 1], contacts.points[:, 0]) % (2 * np.pi)
        return contacts, np.searchsorted(self._joint.directions, angles, side="right") - 1

    def paths(self, piece: int, present: Collection[int]) -> Iterator[Path]:
        """Ways that may take a piece out of those present, in sides."""
        points, leaving = self._touches(piece, present)
        middle = points.mean(axis=0)
        for up, share in itertools.product((1.0, -1.0), _SHARES):
            twist = _least(points - middle, leaving, up, share)
            if twist is not None:
                gone = np.linspace(0, _UP, _POSES)[:, None]
                steps = np.minimum(gone, _ASIDE) * twist
                steps[:, 2:3] = gone * twist[2]
                yield Path.through(steps, middle)

    def _touches(self, piece: int, present: Collection[int]) -> _Touch:
        """Where a piece touches others, and along what it leaves them."""
        contacts, gap = self._walls
        others = set().union(*(self._walls_of[n] for n in present if n != piece))
        touches: list[_Touch] = []
        for wall in self._walls_of[piece]:
            if wall in others:
                mine = gap == wall
                first = contacts.first[mine] == self._edge[piece]
                leaving = np.where(first, -1.0, 1.0)[:, None] * contacts.normals[mine]
                touches.append((contacts.points[mine], leaving))
        if self._joint.pieces[piece].role in ("half_a", "half_b"):
            touches += self._of_half(piece, present)
        if not touches:
            return np.zeros((1, 3)), np.zeros((0, 3))
        return np.concatenate([p for p, _ in touches]), np.concatenate([n for _, n in touches])

    def _of_half(self, piece: int, present: Collection[int]) -> Iterator[_Touch]:
        """Where a half touches the other one, and the tube on their edge."""
        key, role = self._joint.key, self._joint.pieces[piece].role
        side = 1.0 if role == "half_a" else -1.0
        start, pad = key.tube_start, key.pad
        about = Pose.flat((0, 0), self._joint.turns[self._edge[piece]]).axes
        twins = {piece - 1, piece + 1} & set(present)
        if any(self._edge[n] == self._edge[piece] for n in twins):
            corners = np.array(list(itertools.product((pad, start), (0.0,), (-0.5, 0.5))))
            yield corners @ about, np.tile([0.0, side, 0.0], (4, 1)) @ about
        if self._edge[piece] not in self._joint.caps:
            corners = np.array(list(itertools.product((start,), (0.0, side / 2), (-0.5, 0.5))))
            yield corners @ about, np.tile([-1.0, 0.0, 0.0], (4, 1)) @ about


def _least(arms: Floats, leaving: Floats, up: float, share: float) -> Floats | None:
    """The least motion, up by one side, that opens all contacts at a share of the fastest.

    Parameters
    ----------
    arms, leaving
        ``(k, 3) float``: the contacts as seen from what the piece turns about.
    up
        1, or -1 for down.
    share
        Of the fastest opening.

    Returns
    -------
    twist
        A translation and a rotation vector, ``(6,)``; None where some contact stays shut.
    """
    rows = np.hstack([leaving, np.cross(arms, leaving)])
    motion = [(-1.0, 1.0)] * 2 + [(up, up)] + [(-1.0, 1.0)] * 3
    found = linprog(
        [0.0] * 6 + [-1.0],
        A_ub=np.column_stack([-rows, np.ones(len(rows))]),
        b_ub=np.zeros(len(rows)),
        bounds=[*motion, (None, 1.0)],
    )
    if found.x is None or found.x[6] < _SHUT:
        return None
    # The sizes of the six are bounded from above by six more unknowns, whose sum is least.
    size = np.eye(6)
    found = linprog(
        [0.0] * 6 + [1.0] * 6,
        A_ub=np.block([[-rows, np.zeros_like(rows)], [size, -size], [-size, -size]]),
        b_ub=np.concatenate([np.full(len(rows), -share * found.x[6]), np.zeros(12)]),
        bounds=[*motion, *[(0.0, None)] * 6],
    )
    return None if found.x is None else np.asarray(found.x[:6])
