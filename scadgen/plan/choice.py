"""Something that may come out, and the ways on which to try it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from scadgen.interlock.path import Path

__all__ = ["Choice", "cut_ways", "inverse"]

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
    at, turn
        Where that is, in edge lengths, and how it is turned, in degrees.
    """

    parts: frozenset[int]
    joint: int
    path: Path
    at: tuple[float, float]
    turn: float


def cut_ways(path: Path) -> Iterator[tuple[Path, float]]:
    """A way, whole and cut short, and whether to go up or down after it: 1 or -1."""
    poses = path.poses
    for end in dict.fromkeys(max(1, round(share * len(poses))) for share in _SHARES):
        last = poses[end - 1]
        high = float((last[:3, :3] @ path.middle + last[:3, 3])[2])
        for up in (1.0, -1.0) if high >= 0 else (-1.0, 1.0):
            yield Path(poses[:end], path.middle), up


def inverse(path: Path) -> Path:
    """How the others move, as seen from what moves."""
    return Path(np.asarray(np.linalg.inv(path.poses), dtype=np.float64), path.middle)
