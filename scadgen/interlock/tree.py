"""A tree of poses that grows by walks along the walls.

Each walk starts from one of the poses in a random direction of the six.  Every step takes of
it what the walls nearby allow: the nearest motion in their cone.  So the body slides along
walls, and turns where they turn it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from scadgen.interlock.cone import Walls, nearest
from scadgen.interlock.scene import Scene, Stance
from scadgen.solid.affine import Floats

__all__ = ["Tree"]

#: Length of a step in sizes of the body, and how many make a try, and are between two poses
#: that are kept.
_STEP, _SHORTEST, _LONGEST, _KEEP = 0.03, 20, 100, 4

#: A step this much shorter than asked is jammed; after so many a try ends.
_JAMMED, _JAMS = 0.08, 4

#: Times that a step is halved before a try ends.
_HALVED = 4

#: Shares of the gap at the start, at random for each try, that are kept, and the most that
#: is, in sizes: what is kept makes up for the field's rounded edges, and narrows the way.
_KEPT, _MOST_KEPT = (0.3, 0.8), 0.02

#: Share of that to which a step may come too near, before the next ones recede again.
_SLACK = 0.7

#: Tries in a row that get no farther, by this much, after which none is expected to.
_PATIENCE, _FARTHER = 80, 0.02

#: Share of the tries that head for a random pose.
_SPREAD = 0.15

#: Of the others those that go or turn along a face's normal, and those up to which no more turn.
_ALONG, _STRAIGHT = 0.2, 0.4

#: What a turn counts beside a shift by one size, per radian.
_TURN = 0.4


@dataclass(slots=True, eq=False)
class _Node:
    """A pose that was reached, from another one, and how promising it is."""

    pose: Stance
    parent: int
    score: float
    clear: bool = False


class Tree:
    """The poses reached so far, from the start on.

    Parameters
    ----------
    scene
        The body among the others.
    walls
        What is near it.
    random
        Where chance comes from.

    Attributes
    ----------
    tries, steps
        How often it was made to grow, and the steps of all that.
    """

    def __init__(self, scene: Scene, walls: Walls, random: np.random.Generator) -> None:
        self.scene, self.walls, self.random = scene, walls, random
        self.nodes = [_Node(Stance(np.eye(3), scene.middle), 0, 0.0)]
        self.tries = self.steps = 0
        self.patience, self.kept = _PATIENCE, 0.0
        start = self.nodes[0].pose
        self.gap = min(max(self.walls.gap(start), 0.0), _MOST_KEPT * self.scene.size / _KEPT[1])
        self.near = float(self.scene.apart(start).max())
        self._reached: tuple[float, float] = (0.0, 0.0)

    @property
    def hopeful(self) -> bool:
        """Whether another try may get farther."""
        return self.patience > 0

    @property
    def farthest(self) -> tuple[float, float]:
        """How far poses are from the start at most: in mm, and in radians."""
        return self._reached

    def grow(self) -> list[Stance] | None:
        """Try once more: the poses of a clear way out, if that was one."""
        self.tries += 1
        self.patience -= 1
        self.kept = self.gap * float(self.random.uniform(*_KEPT))
        before = max(n.score for n in self.nodes)
        if self.random.random() < _SPREAD:
            start = self._towards_anywhere()
        else:
            node = self._chosen()
            start = node, self._wanted(self.nodes[node])
        if self._walk(*start):
            way = self._clear_way()
            if way is not None:
                return way
        if max(n.score for n in self.nodes) > before + _FARTHER:
            self.patience = _PATIENCE
        return None

    def give_up_last(self) -> None:
        """Forget the pose reached last: the way to it is none."""
        self._cut(len(self.nodes) - 1)

    def _towards_anywhere(self) -> tuple[int, Floats]:
        """The pose nearest to a random one, and the direction from there: into the unknown."""
        centres = np.array([n.pose.centre for n in self.nodes])
        turns = Rotation.from_matrix(np.array([n.pose.turn for n in self.nodes]))
        gone = float(np.linalg.norm(centres - centres[0], axis=1).max())
        centre = centres[0] + self.random.normal(size=3) * (gone + self.scene.size) / 2
        turn = Rotation.from_quat(self.random.normal(size=4))
        shift = (centre - centres) / self.scene.size
        way = np.concatenate([shift, (turn * turns.inv()).as_rotvec()], axis=1)
        length = np.linalg.norm(way, axis=1)
        nearest_one = int(length.argmin())
        return nearest_one, way[nearest_one] / length[nearest_one]

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
        if kind < _ALONG:
            along = self.scene.normals[self.random.integers(len(self.scene.normals))]
            still = np.zeros(3)
            return np.concatenate([along, still] if kind < _ALONG / 2 else [still, along])
        shift, turn = (v / np.linalg.norm(v) for v in self.random.normal(size=(2, 3)))
        if self.random.random() < 0.3 and node.score > 0.3:
            # On and outwards, where walls have bent the way so far.
            gone = node.pose.centre - self.scene.middle
            shift = shift + 3 * gone / max(float(np.linalg.norm(gone)), 1e-9 * self.scene.size)
        elif self.random.random() < 0.3:
            shift = shift + 3 * self.scene.directions[self.scene.apart(node.pose).argmax()]
        shift = shift / np.linalg.norm(shift)
        turn = turn * self.random.random() * (kind > _STRAIGHT)
        wanted = np.concatenate([shift, turn])
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
                self._reach(pose)
                node = len(self.nodes) - 1
            if out > 0:
                return True
        return False

    def _step(self, pose: Stance, wanted: Floats) -> tuple[Stance, float] | None:
        """The pose after a step, and its share of the length wanted; None where all is shut."""
        size, gap = self.scene.size, self.walls.gap(pose)
        length = max(_STEP * size, 0.8 * gap)
        step = length * wanted
        if gap < 2 * length:
            step = nearest(step, *self.walls.rows(pose, self.kept - self.scene.allowed), size)
        share = float(np.linalg.norm(step)) / length
        step, least = (
            step / max(share / 1.5, 1.0),
            min(_SLACK * self.kept, gap) - self.scene.allowed,
        )
        for _ in range(_HALVED):
            after = pose.moved(step, size)
            if self.walls.gap(after) >= least:
                return after, float(np.linalg.norm(step)) / length
            step = step / 2
        return None

    def _reach(self, pose: Stance) -> None:
        """Note how far a pose is from the start."""
        shift = float(np.linalg.norm(pose.centre - self.scene.middle))
        turn = float(Rotation.from_matrix(pose.turn).magnitude())
        self._reached = max(self._reached[0], shift), max(self._reached[1], turn)

    def _score(self, pose: Stance, out: float) -> float:
        """How far a pose is from the start, and how much nearer to free."""
        gone = float(np.linalg.norm(pose.centre - self.scene.middle)) + out - self.near
        turned = float(Rotation.from_matrix(pose.turn).magnitude())
        return gone / self.scene.size + _TURN * turned

    def _clear_way(self) -> list[Stance] | None:
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
