"""A way out: a first-order motion is not one, so follow it to the end.

1. Straight ways, along the normals of the largest faces and others all round.
2. Else a tree of poses grows from the start.  Each try walks from one of them in a random
   direction of the six, of which each step keeps what the walls nearby allow: the nearest
   motion in their cone.  So the body slides along walls, and turns where they turn it.
3. A way found is checked by manifold3d between all its poses; what overlaps is cut off the
   tree, and the search goes on.  Then it is shortened and replayed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.errors import InputError
from scadgen.interlock.cone import Walls
from scadgen.interlock.contacts import Mesh
from scadgen.interlock.path import Path, replay
from scadgen.interlock.scene import Scene, Stance
from scadgen.interlock.tree import Tree

__all__ = ["STEPS", "Attempts", "escape"]

#: Steps after which a search begins no other try: four times what the hardest joint has taken.
STEPS = 10_000

#: Steps of a check after which a straight way is shut, mostly.
_FIRST = 4


@dataclass(frozen=True, slots=True)
class Attempts:
    """No way out was found; that proves nothing.

    Parameters
    ----------
    tries
        Ways tried.
    steps
        Steps taken on them.
    shift, turn
        How far the body got from its place on them at most: its middle in mm, and its turn in
        radians.
    finished
        Whether the search ended because no other try gets farther, not for want of steps.
    """

    tries: int
    steps: int
    shift: float
    turn: float
    finished: bool


def escape(
    moving: Sequence[Mesh],
    fixed: Sequence[Mesh],
    *,
    seed: int,
    steps: int = STEPS,
    far: float | None = None,
    allowed: float = 0.0,
) -> Path | Attempts:
    """Look for a way of a rigid body out of others.

    Parameters
    ----------
    moving
        The meshes of the body, closed and oriented; apart from the others at the start.
    fixed
        The meshes of all that stays.
    seed
        The same seed finds the same.
    steps
        Steps of all tries after which no other begins; straight ways are tried before.
    far
        How far apart the convex hulls are to get, in mm; None: apart at all.
    allowed
        How deep the meshes may be in each other and count as touching, in mm, as `Scene` has it.

    Returns
    -------
    way
        A path on which `replay` finds no more overlap than is allowed, or what was tried in
        vain.

    Raises
    ------
    InputError
        The steps are below 0, `far` is below 0, or the body overlaps the others.
    InvariantError
        If one of the meshes is not a solid.
    """
    if not steps >= 0:
        msg = f"steps = {steps}: must be at least 0"
        raise InputError(msg)
    if far is not None and not 0 <= far < math.inf:
        msg = f"far = {far} mm: must be at least 0 and finite"
        raise InputError(msg)
    scene = Scene(moving, fixed, allowed)
    start = Stance(np.eye(3), scene.middle)
    if not scene.clear(start, start):
        msg = "the body overlaps the others at the start: give both their clearance"
        raise InputError(msg)
    gap = max(far or 0.0, scene.step)
    straight = _straight(scene, start, gap)
    if straight is not None:
        path = scene.path([start, straight])
        if _holds(scene, path, moving, fixed):
            return path
    tree = Tree(scene, Walls(scene), np.random.default_rng(seed))
    while tree.hopeful and tree.steps < steps:
        way = tree.grow()
        if way is not None:
            path = scene.path([*_shortened(scene, way), _away(scene, way[-1], gap)])
            if _holds(scene, path, moving, fixed):
                return path
            tree.give_up_last()
    tries = len(scene.directions) + tree.tries
    return Attempts(tries, tree.steps, *tree.farthest, not tree.hopeful)


def _holds(scene: Scene, path: Path, moving: Sequence[Mesh], fixed: Sequence[Mesh]) -> bool:
    """Whether a way that was found is one."""
    if scene.allowed:
        return scene.leads_out(path)
    return replay(path, moving, fixed, scene.step) <= scene.rounding


def _straight(scene: Scene, start: Stance, gap: float) -> Stance | None:
    """The end of the shortest straight way."""
    ways = gap - scene.apart(start)
    for which in np.argsort(ways, kind="stable"):
        way = max(float(ways[which]), 0.0)
        near, pose = (
            Stance(start.turn, start.centre + length * scene.directions[which])
            for length in (min(way, _FIRST * scene.step), way)
        )
        if scene.free(near) and scene.clear(start, pose):
            return pose
    return None


def _shortened(scene: Scene, way: Sequence[Stance]) -> list[Stance]:
    """As few of the poses as give a clear way: what can be skipped is."""
    if len(way) <= 2 or scene.clear(way[0], way[-1]):
        return [way[0], way[-1]]
    half = len(way) // 2
    found = _shortened(scene, way[: half + 1])[:-1] + _shortened(scene, way[half:])
    place = found.index(way[half])
    if scene.clear(found[place - 1], found[place + 1]):
        del found[place]
    return found


def _away(scene: Scene, last: Stance, gap: float) -> Stance:
    """The pose a gap away from all, straight on from one where a plane already separates."""
    width = scene.apart(last)
    best = int(width.argmax())
    further = max(gap - float(width[best]), 0.0)
    return Stance(last.turn, last.centre + further * scene.directions[best])
