"""The way of a rigid body out of others, and its checks.

`replay`, which the search makes of what it finds, places the solids at poses so close to each
other that no point moves farther than a step between them, and measures what they have in
common.  `narrowest` proves that they touch nowhere, also between the poses: a body that is d
away from all others may move each of its points by d, and meets none of them (conservative
advancement: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, section 2.3).
The search has no part in that proof; they share the solids and manifold3d.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from scadgen.errors import InputError
from scadgen.interlock.contacts import Mesh
from scadgen.solid.affine import Floats
from scadgen.solid.gap import solid

if TYPE_CHECKING:
    from manifold3d import Manifold

__all__ = ["Path", "common_volumes", "narrowest", "replay", "united"]

#: How far a pose may be from a rigid motion; rounding of products of some thousand matrices.
_RIGID = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A motion of one rigid body.

    From pose to pose its middle goes straight, while it turns about one axis at a steady rate.

    Parameters
    ----------
    poses
        ``(k, 4, 4) float``, mm: where the body goes from its place, the identity first.
    middle
        ``(3,) float``: the point of the body, at its place, that goes straight.
    """

    poses: Floats
    middle: Floats

    @classmethod
    def through(cls, steps: Floats, middle: Floats) -> Path:
        """The path through poses told by their steps from the body's place.

        Parameters
        ----------
        steps
            ``(k, 6) float``: how far the middle is from its place, and the rotation vector;
            zeros first.
        middle
            ``(3,) float``.
        """
        poses = np.tile(np.eye(4), (len(steps), 1, 1))
        poses[:, :3, :3] = Rotation.from_rotvec(steps[:, 3:]).as_matrix()
        poses[:, :3, 3] = middle + steps[:, :3] - poses[:, :3, :3] @ middle
        poses[0] = np.eye(4)
        return cls(poses, middle)

    def steps(self) -> Floats:
        """The poses as `through` takes them."""
        return np.hstack([self._centres() - self.middle, self._turns().as_rotvec()])

    def scaled(self, factor: float) -> Path:
        """The same path for a body `factor` times the size."""
        poses = self.poses.copy()
        poses[:, :3, 3] *= factor
        return Path(poses, self.middle * factor)

    def lengths(self, reach: float) -> Floats:
        """How far points move at most between a pose and the next.

        Parameters
        ----------
        reach
            Distance of the body's farthest point from its middle, in mm.

        Returns
        -------
        lengths
            ``(k - 1,) float``, mm.
        """
        turns = self._turns()
        moved: Floats = np.linalg.norm(np.diff(self._centres(), axis=0), axis=1)
        if len(self.poses) > 1:
            moved += reach * (turns[:-1].inv() * turns[1:]).magnitude()
        return moved

    def _turns(self) -> Rotation:
        """How the body is turned at each pose."""
        return Rotation.from_matrix(self.poses[:, :3, :3])

    def _centres(self) -> Floats:
        """Where the middle is at each pose."""
        centres: Floats = self.poses[:, :3, :3] @ self.middle + self.poses[:, :3, 3]
        return centres

    def at(self, times: Floats) -> Floats:
        """Poses between the poses.

        Parameters
        ----------
        times
            ``(m,) float``: 0 at the first pose, 1 at the second; from 0 to k - 1.

        Returns
        -------
        poses
            ``(m, 4, 4) float``.
        """
        return self.between()(times)

    def between(self) -> Callable[[Floats], Floats]:
        """The poses at some times, as `at` gives them, quick to ask for again and again."""
        centres, turns = self._centres(), self._turns()
        ways = (turns[:-1].inv() * turns[1:]).as_rotvec() if len(turns) > 1 else np.zeros((1, 3))

        def at(times: Floats) -> Floats:
            start = np.clip(np.floor(times).astype(np.int64), 0, max(len(self.poses) - 2, 0))
            end = np.minimum(start + 1, len(self.poses) - 1)
            share = (times - start)[:, None]
            turn = self.poses[start, :3, :3] @ Rotation.from_rotvec(share * ways[start]).as_matrix()
            centre = centres[start] + share * (centres[end] - centres[start])
            found = np.tile(np.eye(4), (len(share), 1, 1))
            found[:, :3, :3] = turn
            found[:, :3, 3] = centre - turn @ self.middle
            # The poses themselves come back unrounded.
            exact = share[:, 0] == 0
            found[exact] = self.poses[start[exact]]
            return found

        return at

    def dense(self, reach: float, step: float) -> Floats:
        """All poses and so many between that no point moves farther than a step.

        Parameters
        ----------
        reach
            Distance of the body's farthest point from its middle, in mm.
        step
            In mm, above 0.

        Returns
        -------
        poses
            ``(m, 4, 4) float``.
        """
        counts = np.maximum(np.ceil(self.lengths(reach) / step).astype(np.int64), 1)
        times = [n + np.arange(count) / count for n, count in enumerate(counts)]
        return self.at(np.concatenate([*times, [len(self.poses) - 1.0]]))


def replay(path: Path, moving: Sequence[Mesh], fixed: Sequence[Mesh], step: float) -> float:
    """Largest volume that a moving body shares with fixed ones on its way out, in mm3.

    Parameters
    ----------
    path
        The way.
    moving
        The meshes of the body, closed and oriented.
    fixed
        The meshes of all that stays.
    step
        How far a point of the body may move between two poses, in mm.

    Returns
    -------
    worst
        Infinite where it is no way out for another reason: it does not begin with the
        identity, a pose is not rigid, or the convex hulls still meet at its end.

    Raises
    ------
    InputError
        The step is not a finite number above 0.
    InvariantError
        If one of the meshes is not a solid.
    """
    if not 0 < step < math.inf:
        msg = f"step = {step} mm: must be a finite number above 0"
        raise InputError(msg)
    if not _leads_out(path, moving, fixed):
        return math.inf
    poses = path.dense(_reach(path, moving), step)
    return max(common_volumes(poses, united(moving), united(fixed)))


def narrowest(
    path: Path, moving: Sequence[Mesh], fixed: Sequence[Mesh], *, least: float, look: float
) -> float:
    """Smallest gap on a moving body's way out past fixed ones, at the poses of a proof.

    Parameters
    ----------
    path
        The way.
    moving
        The meshes of the body, closed and oriented.
    fixed
        The meshes of all that stays.
    least
        Gap below which the proof is given up, in mm, above 0.
    look
        Gap beyond which it need not be known, in mm, at least `least`; a tight one is fast.

    Returns
    -------
    gap
        In mm, at least `least`: then the body touches nothing on all its way.  0 where that
        is not proven: it comes nearer than `least`, or it is no way out.

    Raises
    ------
    InputError
        `least` and `look` are not as above.
    InvariantError
        If one of the meshes is not a solid.
    """
    if not 0 < least <= look < math.inf:
        msg = f"least = {least} mm, look = {look} mm: must be above 0, and look not below least"
        raise InputError(msg)
    if not _leads_out(path, moving, fixed):
        return 0.0
    body, rest = united(moving), united(fixed)
    lengths = path.lengths(_reach(path, moving))
    ends = np.concatenate([[0.0], np.cumsum(lengths)])
    gone, worst, far, at = 0.0, look, look, path.between()
    while True:
        time = np.interp(gone, ends, np.arange(len(ends)))
        gap = float(body.transform(at(np.array([time]))[0, :3]).min_gap(rest, far))
        worst = min(worst, gap)
        if gap < least:
            return 0.0
        if gone >= ends[-1]:
            return worst
        # Once the body is off it takes long steps, for which it has to look far.
        far = 2 * far if gap >= far else max(look, gap)
        gone = min(gone + gap, float(ends[-1]))


def _leads_out(path: Path, moving: Sequence[Mesh], fixed: Sequence[Mesh]) -> bool:
    """Whether it begins where the body is, is rigid, and its end is outside all hulls."""
    poses = np.asarray(path.poses)
    if len(poses) < 2 or not np.isfinite(poses).all() or (poses[0] != np.eye(4)).any():
        return False
    turns = poses[:, :3, :3]
    if (
        np.abs(turns @ turns.transpose(0, 2, 1) - np.eye(3)).max() > _RIGID
        or np.linalg.det(turns).min() < 0
        or (poses[:, 3] != [0, 0, 0, 1]).any()
    ):
        return False
    body, rest = united(moving), united(fixed)
    return bool((body.hull().transform(poses[-1, :3]) ^ rest.hull()).volume() <= 0)


def _reach(path: Path, moving: Sequence[Mesh]) -> float:
    """Distance of the body's farthest point from its middle."""
    points = np.concatenate([p for p, _ in moving])
    return float(np.linalg.norm(points - path.middle, axis=1).max())


def common_volumes(poses: Floats, body: Manifold, rest: Manifold) -> Iterator[float]:
    """Volume that a body shares with the rest at each pose, in mm3."""
    for pose in poses:
        yield float((body.transform(pose[:3]) ^ rest).volume())


def united(meshes: Sequence[Mesh]) -> Manifold:
    """All meshes as one solid.

    Parameters
    ----------
    meshes
        Closed and oriented, at least one.

    Raises
    ------
    InputError
        There is none.
    InvariantError
        If one of the meshes is not a solid.
    """
    from manifold3d import Manifold, OpType  # slow to import

    if not meshes:
        msg = "0 meshes: a body needs at least 1"
        raise InputError(msg)
    return Manifold.batch_boolean([solid(*mesh) for mesh in meshes], OpType.Add)
