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
import time
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from scadgen.errors import InputError, InvariantError
from scadgen.interlock.cone import Walls, nearest
from scadgen.interlock.contacts import Mesh
from scadgen.interlock.path import Path, replay
from scadgen.interlock.scene import Pose, Scene
from scadgen.solid.affine import Floats

__all__ = ["Attempts", "escape"]

#: Length of a step in sizes of the body, and how many make a try, and are between two poses
#: that are kept.
_STEP, _SHORTEST, _LONGEST, _KEEP = 0.03, 20, 100, 4

#: A step this much shorter than asked is jammed; after so many a try ends.
_JAMMED, _JAMS = 0.08, 4

#: Times that a step is halved before a try ends.
_HALVED = 4

#: Share of the gap at the start that is kept, and the most that is, in sizes.
_KEPT, _MOST_KEPT = 0.35, 0.01

#: Tries in a row that get no farther, by this much, after which none is expected to.
_PATIENCE, _FARTHER = 80, 0.02

#: What a turn counts beside a shift by one size, per radian.
_TURN = 0.4


@dataclass(frozen=True, slots=True)
class Attempts:
    """No way out was found; that proves nothing.

    Parameters
    ----------
    tries
        Ways tried.
    steps
        Steps taken on them.
    in_time
        Whether the search ended by itself, so that the same seed ends the same.
    """

    tries: int
    steps: int
    in_time: bool


def escape(
    moving: Sequence[Mesh],
    fixed: Sequence[Mesh],
    *,
    seed: int,
    seconds: float,
    far: float | None = None,
) -> Path | Attempts:
    """Look for a way of a rigid body out of others.

    Parameters
    ----------
    moving
        The meshes of the body, closed and oriented; apart from the others at the start.
    fixed
        The meshes of all that stays.
    seed
        The same seed finds the same, unless time runs out.
    seconds
        Time after which no other try begins.
    far
        How far apart the convex hulls are to get, in mm; None: apart at all.

    Returns
    -------
    way
        A path on which `replay` finds no overlap, or what was tried in vain.

    Raises
    ------
    InputError
        The seconds are not above 0, `far` is below 0, or the body overlaps the others.
    InvariantError
        If one of the meshes is not a solid.
    """
    end = time.monotonic() + seconds
    if not seconds > 0:
        msg = f"seconds = {seconds}: must be above 0"
        raise InputError(msg)
    if far is not None and not 0 <= far < math.inf:
        msg = f"far = {far} mm: must be at least 0 and finite"
        raise InputError(msg)
    scene = Scene(moving, fixed)
    start = Pose(np.eye(3), scene.middle)
    if not scene.clear(start, start):
        msg = "the body overlaps the others at the start: give both their clearance"
        raise InputError(msg)
    gap = max(far or 0.0, scene.step)
    straight = _straight(scene, start, gap)
    if straight is not None:
        return _checked(scene.path([start, straight]), moving, fixed, scene)
    tree = _Tree(scene, Walls(scene), np.random.default_rng(seed), [_Node(start, 0, 0.0)])
    while tree.patience and time.monotonic() < end:
        way = tree.grow()
        if way is not None:
            way = _shortened(scene, way)
            last = way[-1]
            out = scene.apart(last)
            best = int(out.argmax())
            further = max(gap - float(out[best]), 0.0) * scene.directions[best]
            path = scene.path([*way, Pose(last.turn, last.centre + further)])
            return _checked(path, moving, fixed, scene)
    return Attempts(len(scene.directions) + tree.tries, tree.steps, not tree.patience)


def _straight(scene: Scene, start: Pose, gap: float) -> Pose | None:
    """The end of the shortest straight way."""
    ways = gap - scene.apart(start)
    for which in np.argsort(ways, kind="stable"):
        shift = max(float(ways[which]), 0.0) * scene.directions[which]
        pose = Pose(start.turn, start.centre + shift)
        if scene.clear(start, pose):
            return pose
    return None


def _shortened(scene: Scene, way: Sequence[Pose]) -> list[Pose]:
    """As few of the poses as give a clear way: what can be skipped is."""
    if len(way) <= 2 or scene.clear(way[0], way[-1]):
        return [way[0], way[-1]]
    half = len(way) // 2
    found = _shortened(scene, way[: half + 1])[:-1] + _shortened(scene, way[half:])
    place = found.index(way[half])
    if scene.clear(found[place - 1], found[place + 1]):
        del found[place]
    return found


def _checked(path: Path, moving: Sequence[Mesh], fixed: Sequence[Mesh], scene: Scene) -> Path:
    """The path, once the replay agrees."""
    worst = replay(path, moving, fixed, scene.step)
    if worst > scene.rounding:
        msg = f"a way out is clear: its replay finds {worst:.3g} mm3 in common"
        raise InvariantError(msg)
    return path


@dataclass(slots=True, eq=False)
class _Node:
    """A pose that was reached, from another one, and how promising it is."""

    pose: Pose
    parent: int
    score: float
    clear: bool = False


@dataclass(slots=True, eq=False)
class _Tree:
    """The poses reached so far; the first is the start."""

    scene: Scene
    walls: Walls
    random: np.random.Generator
    nodes: list[_Node]
    tries: int = 0
    steps: int = 0
    patience: int = _PATIENCE
    kept: float = field(init=False)
    near: float = field(init=False)

    def __post_init__(self) -> None:
        """Measure where the body begins."""
        start = self.nodes[0].pose
        gap = self.walls.gap(start)
        self.kept = float(np.clip(_KEPT * gap, 0, _MOST_KEPT * self.scene.size))
        self.near = float(self.scene.apart(start).max())

    def grow(self) -> list[Pose] | None:
        """Try once more: the poses of a clear way out, if that was one."""
        self.tries += 1
        self.patience -= 1
        node = self._chosen()
        before = max(n.score for n in self.nodes)
        if self._walk(node, self._wanted(self.nodes[node])):
            way = self._clear_way()
            if way is not None:
                return way
        if max(n.score for n in self.nodes) > before + _FARTHER:
            self.patience = _PATIENCE
        return None

    def _chosen(self) -> int:
        """A pose to walk from: mostly a promising one."""
        scores, kind = np.array([n.score for n in self.nodes]), self.random.random()
        if kind < 0.35:
            some = self.random.integers(len(scores), size=6)
            return int(some[scores[some].argmax()])
        if kind < 0.6:
            return int((scores * self.random.uniform(0.6, 1, len(scores))).argmax())
        return 0 if kind < 0.7 else int(self.random.integers(len(scores)))

    def _wanted(self, node: _Node) -> Floats:
        """A direction to walk in, of length 1."""
        kind = self.random.random()
        shift, turn = (v / np.linalg.norm(v) for v in self.random.normal(size=(2, 3)))
        if self.random.random() < 0.3 and node.score > 0.3:
            # On and outwards, where walls have bent the way so far.
            gone = node.pose.centre - self.scene.middle
            shift = shift + 3 * gone / max(float(np.linalg.norm(gone)), 1e-9 * self.scene.size)
            shift = shift / np.linalg.norm(shift)
        elif self.random.random() < 0.3:
            shift = shift + 3 * self.scene.directions[self.scene.apart(node.pose).argmax()]
            shift = shift / np.linalg.norm(shift)
        weight = 0.8 if kind > 0.45 else 1.0 if kind < 0.3 else 0.15
        turn = turn * (0.0 if kind < 0.3 else self.random.random())
        wanted = np.concatenate([weight * shift, turn])
        return np.asarray(wanted / np.linalg.norm(wanted))

    def _walk(self, start: int, wanted: Floats) -> bool:
        """Walk from a pose as far as walls let; whether that leads out."""
        node, pose, jams = start, self.nodes[start].pose, 0
        for count in range(1, int(self.random.integers(_SHORTEST, _LONGEST)) + 1):
            self.steps += 1
            found = self._step(pose, wanted)
            if found is None:
                break
            jams = jams + 1 if found[1] < _JAMMED else 0
            if jams > _JAMS:
                break
            pose = found[0]
            out = float(self.scene.apart(pose).max())
            if count % _KEEP == 0 or out > 0:
                if not self.scene.free(pose):
                    break
                self.nodes.append(_Node(pose, node, self._score(pose, out)))
                node = len(self.nodes) - 1
            if out > 0:
                return True
        return False

    def _step(self, pose: Pose, wanted: Floats) -> tuple[Pose, float] | None:
        """The pose after a step, and its share of the length wanted; None where all is shut."""
        size, gap = self.scene.size, self.walls.gap(pose)
        length = max(_STEP * size, 0.8 * gap)
        step = length * wanted
        if gap < 2 * length:
            step = nearest(step, *self.walls.rows(pose, self.kept), size)
        share = float(np.linalg.norm(step)) / length
        step, least = step / max(share / 1.5, 1.0), min(self.kept, gap)
        for _ in range(_HALVED):
            after = pose.moved(step, size)
            if self.walls.gap(after) >= least:
                return after, float(np.linalg.norm(step)) / length
            step = step / 2
        return None

    def _score(self, pose: Pose, out: float) -> float:
        """How far a pose is from the start, and how much nearer to free."""
        gone = float(np.linalg.norm(pose.centre - self.scene.middle)) + out - self.near
        return gone / self.scene.size + _TURN * Rotation.from_matrix(pose.turn).magnitude()

    def _clear_way(self) -> list[Pose] | None:
        """The way to the last pose, if it is clear; else what lies behind an overlap goes."""
        chain = [len(self.nodes) - 1]
        while chain[-1]:
            chain.append(self.nodes[chain[-1]].parent)
        for before, after in zip(chain[:0:-1], chain[-2::-1], strict=True):
            node = self.nodes[after]
            node.clear = node.clear or self.scene.clear(self.nodes[before].pose, node.pose)
            if not node.clear:
                self._cut(after)
                return None
        return [self.nodes[n].pose for n in reversed(chain)]

    def _cut(self, root: int) -> None:
        """Remove a pose and all that were reached from it."""
        place, kept = {0: 0}, [self.nodes[0]]
        for number, node in enumerate(self.nodes[1:], start=1):
            if number != root and node.parent in place:
                place[number] = len(kept)
                node.parent = place[node.parent]
                kept.append(node)
        self.nodes = kept
