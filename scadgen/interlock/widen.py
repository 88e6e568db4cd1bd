"""A way out with more room: the same way, drawn away from the walls.

A search leaves a way as near to walls as it may.  Here each pose goes to where it has as much
room as it can have, up to the gap at the start, and there as near to the middle of its neighbours
as that leaves it; over and over, until nothing gives any more.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from scadgen.interlock.cone import Walls, nearest, widest
from scadgen.interlock.contacts import Mesh
from scadgen.interlock.path import Path, narrowest
from scadgen.interlock.scene import Scene, Stance
from scadgen.solid.affine import Floats

__all__ = ["widened"]

#: Length of the way between two poses that yield, and how far one goes at most for more room
#: and in all, in sizes.
_BETWEEN, _MORE, _STEP = 0.02, 0.01, 0.02

#: Rounds between two looks, looks, and looks in vain after which it ends.
_ROUNDS, _LOOKS, _IN_VAIN = 3, 8, 2

#: Share of the room it can have that a pose keeps, and of the gap at the start that is enough.
_KEPT, _ENOUGH = 0.97, 0.95


def widened(path: Path, moving: Sequence[Mesh], fixed: Sequence[Mesh], least: float) -> Path:
    """Draw a way away from the walls.

    Parameters
    ----------
    path
        A way that keeps a gap of `least`.
    moving, fixed
        The meshes of the body and of all that stays, closed and oriented.
    least
        In mm, above 0.

    Returns
    -------
    path
        One of many poses with the largest smallest gap found, or the same.
    """
    scene = Scene(moving, fixed)
    walls = Walls(scene, close=True)
    poses = _poses(path, scene)
    wished = max(scene.gap, least)
    best, most = path, narrowest(path, moving, fixed, least=least, look=2 * wished)
    vain = 0
    for _ in range(_LOOKS):
        for _ in range(_ROUNDS):
            poses = _yielded(poses, scene, walls, wished)
        found = scene.path(poses)
        gap = narrowest(found, moving, fixed, least=least, look=2 * wished)
        vain = 0 if gap > most else vain + 1
        if gap > most:
            best, most = found, gap
        if most > _ENOUGH * wished or vain > _IN_VAIN:
            break
    return best


def _poses(path: Path, scene: Scene) -> list[Stance]:
    """Poses all along a path."""
    dense = path.dense(scene.size, _BETWEEN * scene.size)
    return [Stance(p[:3, :3], p[:3, :3] @ scene.middle + p[:3, 3]) for p in dense]


def _yielded(poses: Sequence[Stance], scene: Scene, walls: Walls, gap: float) -> list[Stance]:
    """All poses but the ends a little nearer to where they should be."""
    found = list(poses)
    for n in range(1, len(found) - 1):
        step = _between(found[n], found[n - 1], found[n + 1], scene.size)
        rows, gaps = walls.near(found[n])
        if len(gaps):
            room = widest(rows, gaps, _MORE * scene.size)
            step = nearest(step, rows, min(_KEPT * room, room, gap) - gaps, scene.size)
        length = float(np.linalg.norm(step)) / (_STEP * scene.size)
        found[n] = found[n].moved(step / max(length, 1.0), scene.size)
    return found


def _between(pose: Stance, before: Stance, after: Stance, size: float) -> Floats:
    """The step from a pose to half way between its neighbours."""
    shift = (before.centre + after.centre) / 2 - pose.centre
    here = Rotation.from_matrix(pose.turn).inv()
    turns = [(Rotation.from_matrix(p.turn) * here).as_rotvec() for p in (before, after)]
    return np.concatenate([shift, size * (turns[0] + turns[1]) / 2])
