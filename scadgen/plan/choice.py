"""Something that may come out, and the ways on which to try it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from scadgen.interlock.path import Path
from scadgen.solid.pose import Pose

__all__ = ["Choice", "cut_ways", "inverse", "reflected"]

#: Shares of a way after which a part may be lifted out: ways of a joint may end far aside.
_SHARES = (1.0, 0.5, 0.75, 0.875, 0.625, 0.375, 0.25)


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """Something that may come out.

    Parameters
    ----------
    parts
        Numbers of what moves as one.
    joint
        Number of the joint.
    path
        A way, in mm, its origin at the joint.
    origin
        Where that is in the frame, in edge lengths.
    """

    parts: frozenset[int]
    joint: int
    path: Path
    origin: Pose


def cut_ways(path: Path, up: float) -> Iterator[tuple[Path, float]]:
    """A way, whole and cut short, and where to go after it along its z: 1 or -1.

    Where it has gone neither way, that is as `up` says first.
    """
    poses = path.poses
    for end in dict.fromkeys(max(1, round(share * len(poses))) for share in _SHARES):
        last = poses[end - 1]
        high = float((last[:3, :3] @ path.middle + last[:3, 3])[2])
        first = math.copysign(1.0, high) if high else up
        for way in (first, -first):
            yield Path(poses[:end], path.middle), way


def inverse(path: Path) -> Path:
    """How the others move, as seen from what moves."""
    return Path(np.asarray(np.linalg.inv(path.poses), dtype=np.float64), path.middle)


def reflected(path: Path) -> Path:
    """A way with up and down swapped: one for what is alike on both sides, as a peg is."""
    steps = path.steps() * [1.0, 1.0, -1.0, -1.0, -1.0, 1.0]
    return Path.through(steps, path.middle * [1.0, 1.0, -1.0])
