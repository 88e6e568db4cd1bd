"""Which joints others fit into, with caps where they have no edge."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.frame.classes import Classes
from scadgen.frame.joint_classes import JointClass
from scadgen.frame.slots import ANGLE
from scadgen.frame.template import Template

__all__ = ["Host", "find_hosts", "sign"]

#: Least gap of a joint that a lone end may stand in, in degrees.
_NARROW = 60.0


@dataclass(frozen=True, slots=True, eq=False)
class Host:
    """A joint whose directions a class of joints fits into.

    Parameters
    ----------
    joint
        Number of the class that it is; ``~number`` for a lone end with caps of its own.
    turn
        Where the class's first direction is among its own.
    over
        Whether the class is turned over there.
    slots
        Which of its directions each of the class's becomes.
    """

    joint: int
    turn: float
    over: bool
    slots: tuple[int, ...]


def find_hosts(same: Classes, kept: Collection[int]) -> list[list[Host]]:
    """The ways in which each class of joints may stand: as itself, if it is to be kept.

    It fits into classes with more edges; those that are most used come first.  A class whose
    hosts are all hosted themselves, by what it does not fit into, stands as itself.
    """
    joints = same.joints
    found: list[list[Host]] = []
    itself: list[Host] = []
    for number, one in enumerate(joints):
        own = one.directions
        larger = [n for n, other in enumerate(joints) if len(other.directions) > len(own)]
        larger = [] if number in kept else larger
        if len(own) == 1:
            larger = [n for n in larger if _holds_lone_ends(Template.of(joints[n]))]
        larger.sort(key=lambda n: (-len(joints[n].vertices), n))
        fits = [host for n in larger for host in _fits(one, n, joints[n])]
        joint = number if len(own) > 1 else ~number
        alone = Host(joint, 0.0, over=False, slots=tuple(range(len(own))))
        found.append(fits or [alone])
        itself.append(alone)
    return [list(_roots(found, hosts)) or [own] for hosts, own in zip(found, itself, strict=True)]


def _holds_lone_ends(template: Template) -> bool:
    """Whether a lone end may stand in such a joint.

    Narrow gaps take a wide ring; across a wide one connectors hold only what is held elsewhere too.
    """
    gaps = template.gaps
    return bool(gaps.min() > np.radians(_NARROW) - ANGLE and gaps.max() < np.pi + ANGLE)


def _fits(own: JointClass, number: int, host: JointClass) -> Iterator[Host]:
    """The ways that put the edges of a class among those of another one."""
    # Turned over they fit a host that is itself turned over just as they do otherwise.
    ways = (False, True) if host.symmetry.mirror is None else (False,)
    for over, start in itertools.product(ways, host.directions.tolist()):
        seen = start + sign(over) * own.directions
        off = (seen[:, None] - host.directions + np.pi) % (2 * np.pi) - np.pi
        slots = np.abs(off).argmin(axis=1)
        aside = off[np.arange(len(slots)), slots]
        down = sign(over) * own.slopes - host.slopes[slots]
        if (np.abs([aside, down]) < ANGLE).all():
            yield Host(number, start, over, tuple(slots.tolist()))


def sign(over: bool) -> int:  # noqa: FBT001
    """The sense in which directions follow each other."""
    return -1 if over else 1


def _roots(hosts: Sequence[Sequence[Host]], own: Sequence[Host]) -> Iterator[Host]:
    """Those of some hosts that have no host of their own."""
    return (host for host in own if host.joint < 0 or hosts[host.joint][0].joint == host.joint)
