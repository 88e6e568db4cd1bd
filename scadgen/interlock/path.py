"""The way of a rigid body out of others, and its check.

The check shares no code with the search: it places the solids at poses so close to each other
that no point moves farther than a step between them, and measures what they have in common.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from scadgen.errors import InputError, InvariantError
from scadgen.interlock.contacts import Mesh
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from manifold3d import Manifold

__all__ = ["Path", "common_volumes", "replay", "united"]

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
        turns = Rotation.from_matrix(self.poses[:, :3, :3])
        centres = self.poses[:, :3, :3] @ self.middle + self.poses[:, :3, 3]
        start = np.clip(np.floor(times).astype(np.int64), 0, max(len(self.poses) - 2, 0))
        end = np.minimum(start + 1, len(self.poses) - 1)
        share = np.asarray(times - start)
        way = (turns[start].inv() * turns[end]).as_rotvec()
        turn = (turns[start] * Rotation.from_rotvec(share[:, None] * way)).as_matrix()
        centre = centres[start] + share[:, None] * (centres[end] - centres[start])
        found = np.tile(np.eye(4), (len(share), 1, 1))
        found[:, :3, :3] = turn
        found[:, :3, 3] = centre - turn @ self.middle
        # The poses themselves come back unrounded.
        exact = share == 0
        found[exact] = self.poses[start[exact]]
        return found

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
        centres = self.poses[:, :3, :3] @ self.middle + self.poses[:, :3, 3]
        turns = Rotation.from_matrix(self.poses[:, :3, :3])
        moved = np.linalg.norm(np.diff(centres, axis=0), axis=1)
        moved += reach * (turns[:-1].inv() * turns[1:]).magnitude() if len(turns) > 1 else 0
        counts = np.maximum(np.ceil(moved / step).astype(np.int64), 1)
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
    poses = np.asarray(path.poses)
    if len(poses) < 2 or not np.isfinite(poses).all() or (poses[0] != np.eye(4)).any():
        return math.inf
    turns = poses[:, :3, :3]
    if (
        np.abs(turns @ turns.transpose(0, 2, 1) - np.eye(3)).max() > _RIGID
        or np.linalg.det(turns).min() < 0
        or (poses[:, 3] != [0, 0, 0, 1]).any()
    ):
        return math.inf
    body, rest = united(moving), united(fixed)
    if not (body.hull().transform(poses[-1, :3]) ^ rest.hull()).volume() <= 0:
        return math.inf
    points = np.concatenate([p for p, _ in moving])
    reach = float(np.linalg.norm(points - path.middle, axis=1).max())
    return max(common_volumes(path.dense(reach, step), body, rest))


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
    from manifold3d import Error, Manifold, Mesh64, OpType  # slow to import

    if not meshes:
        msg = "0 meshes: a body needs at least 1"
        raise InputError(msg)
    solids = []
    for number, (points, triangles) in enumerate(meshes):
        mesh = Mesh64(
            vert_properties=np.ascontiguousarray(points, dtype=np.float64),
            tri_verts=np.ascontiguousarray(triangles, dtype=np.uint64),
        )
        solid = Manifold(mesh)
        if solid.status() != Error.NoError or not solid.volume() > 0:
            msg = f"closed solid: mesh {number} is none, {solid.status().name}"
            raise InvariantError(msg)
        solids.append(solid)
    return Manifold.batch_boolean(solids, OpType.Add)
