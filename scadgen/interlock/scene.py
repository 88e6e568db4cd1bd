"""A rigid body among fixed ones: where it overlaps them, and how far it is from free."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from scadgen.interlock.contacts import Mesh
from scadgen.interlock.path import Path, united
from scadgen.solid.affine import Floats
from scadgen.solid.gap import thickness

if TYPE_CHECKING:
    from manifold3d import Manifold

__all__ = ["Scene", "Stance", "all_round"]

#: Shared volume, as a share of the body's, that is rounding.
_ROUNDING = 1e-12

#: Farthest that a point moves between two poses that are looked at, in sizes, and that as a
#: share of the gap at the start where it is narrower, down to a least.
_STEP, _OF_GAP, _LEAST_STEP = 0.01, 0.5, 0.002

#: Directions all round, and the largest faces whose normals are added.
_ROUND, _FACES = 48, 12


#: Places beside a pose, in depths that are allowed.
_BESIDE = np.array([[0.0, 0.0, 0.0], [0.31, -0.17, 0.23], [-0.19, 0.29, -0.13]])


@dataclass(frozen=True, slots=True, eq=False)
class Stance:
    """Where the body is.

    Parameters
    ----------
    turn
        ``(3, 3) float``: its rotation.
    centre
        ``(3,) float``: where its middle is, in mm.
    """

    turn: Floats
    centre: Floats

    def moved(self, step: Floats, size: float) -> Stance:
        """After a translation and a rotation times `size`, ``(6,)``, about its middle."""
        turn = Rotation.from_rotvec(step[3:] / size) * Rotation.from_matrix(self.turn)
        return Stance(turn.as_matrix(), self.centre + step[:3])


class Scene:
    """A body, what it has to get away from, and exact answers about both.

    Where they start with a gap, every pose has to keep half a step from what is fixed, and no
    point moves farther than a step from pose to pose: so the whole way is clear.

    Parameters
    ----------
    moving, fixed
        Meshes, closed and oriented.
    allowed
        How deep they may be in each other, in mm: the mean thickness of the thickest piece that
        they share, as facets of round faces that turn in each other do.

    Attributes
    ----------
    body, rest
        The body, and all that is fixed, each as one mesh.
    middle
        ``(3,) float``: the middle of the body's surface, mm.
    size
        Root mean square distance of the body's surface from it, in mm: the unit of motions.
    gap
        Smallest gap at the start, in mm; at most `size`.
    step
        Farthest that a point moves between two poses that are looked at, in mm.
    rounding
        Shared volume that counts as none, in mm3.
    normals
        ``(j, 3) float``: unit vectors along the normals of the largest faces, both ways.
    directions
        ``(k, 3) float``: these, and others all round.

    Raises
    ------
    InputError
        If there is no mesh.
    InvariantError
        If one of the meshes is not a solid.
    """

    def __init__(self, moving: Sequence[Mesh], fixed: Sequence[Mesh], allowed: float = 0.0) -> None:
        self.allowed = allowed
        self._body, self._rest = united(moving), united(fixed)
        self.body, self.rest = _mesh(self._body), _mesh(self._rest)
        points, triangles = self.body
        corners = points[triangles]
        areas = np.linalg.norm(_normals(self.body), axis=1)
        self.middle: Floats = np.average(corners.mean(axis=1), axis=0, weights=areas)
        spread = ((corners - self.middle) ** 2).sum(axis=2).mean(axis=1)
        self.size = math.sqrt(float(np.average(spread, weights=areas)))
        self.rounding = _ROUNDING * float(self._body.volume())
        self.gap = float(self._body.min_gap(self._rest, self.size))
        self.step = float(np.clip(_OF_GAP * self.gap, _LEAST_STEP * self.size, _STEP * self.size))
        self._keep = self.step / 2 if self.gap >= self.step else 0.0
        normals = np.concatenate([_faces(self.body), _faces(self.rest)])
        self.normals = _distinct(np.concatenate([normals, -normals]))
        self.directions = _distinct(np.concatenate([self.normals, all_round()]))
        self._hull = points[ConvexHull(points).vertices] - self.middle
        self._reach = float(np.linalg.norm(self._hull, axis=1).max())
        self._support = (self.rest[0] @ self.directions.T).max(axis=0)

    def path(self, poses: Sequence[Stance]) -> Path:
        """The path through some poses."""
        matrices = np.tile(np.eye(4), (len(poses), 1, 1))
        for matrix, pose in zip(matrices, poses, strict=True):
            matrix[:3, :3] = pose.turn
            matrix[:3, 3] = pose.centre - pose.turn @ self.middle
        return Path(matrices, self.middle)

    def clear(self, a: Stance, b: Stance) -> bool:
        """Whether the body is free on all its way from one pose to another."""
        poses = self.path([a, b]).dense(self._reach, self.step)
        # What is far from poses known to be free is looked at first.
        order = np.concatenate([poses[4::8], poses[::8], poses[2::4], poses[1::2]])
        return all(self._free(pose) for pose in order)

    def leads_out(self, path: Path, step: float | None = None) -> bool:
        """Whether a path leads out.

        Parameters
        ----------
        path
            The path.
        step
            How far points move at most between two poses that are looked at, in mm; None for
            the scene's own.

        Returns
        -------
        out
            Whether the body is free all along it, and its hull apart from the others' at the end.
        """
        if (self._body.hull().transform(path.poses[-1, :3]) ^ self._rest.hull()).volume() > 0:
            return False
        reach = float(np.linalg.norm(self._hull + self.middle - path.middle, axis=1).max())
        return all(self._free(pose) for pose in path.dense(reach, step or self.step))

    def clear_at(self, pose: Floats) -> bool:
        """Whether the body is free where a matrix ``(3, 4) float`` takes it from its place."""
        return self._free(pose)

    def free(self, pose: Stance) -> bool:
        """Whether the body is free at a pose."""
        return self._free(self.path([pose]).poses[0])

    def apart(self, pose: Stance) -> Floats:
        """Width of the slab between both along each of `directions`, in mm.

        It is below 0 where they overlap along the direction.
        """
        hull = self._hull @ pose.turn.T + pose.centre
        width: Floats = (hull @ self.directions.T).min(axis=0) - self._support
        return width

    def ways(self, directions: Floats) -> Floats:
        """How far the body has to go along each of some directions until a plane separates it.

        Parameters
        ----------
        directions
            ``(k, 3) float``: unit vectors.

        Returns
        -------
        ways
            ``(k,) float``, mm.
        """
        near = ((self._hull + self.middle) @ directions.T).min(axis=0)
        far = (self.rest[0] @ directions.T).max(axis=0)
        return np.asarray(far - near)

    def _free(self, pose: Floats) -> bool:
        body = self._body.transform(pose[:3])
        if self._keep:
            return bool(body.min_gap(self._rest, self._keep) >= self._keep)
        if (body ^ self._rest).volume() <= self.rounding:
            return True
        # Where faces slide in one plane manifold3d now and then finds a piece that is none; a
        # little beside, by less than is allowed, it does not.
        beside = [shift * self.allowed for shift in _BESIDE] if self.allowed else []
        return any(
            thickness(body.translate(shift.tolist()) ^ self._rest) <= self.allowed
            for shift in beside
        )


def _mesh(solid: Manifold) -> Mesh:
    """The mesh of a solid."""
    mesh = solid.to_mesh64()
    points = np.array(mesh.vert_properties, dtype=np.float64)[:, :3]
    return points, np.array(mesh.tri_verts, dtype=np.int64)


def _normals(mesh: Mesh) -> Floats:
    """Normal of each face, as long as twice its area."""
    points, triangles = mesh
    corners = points[triangles]
    normals: Floats = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normals


def _faces(mesh: Mesh) -> Floats:
    """Unit normals of a mesh's largest faces."""
    normals = _normals(mesh)
    areas = np.linalg.norm(normals, axis=1)
    unit = np.round(normals / areas[:, None], 6) + 0.0
    unique, which = np.unique(unit, axis=0, return_inverse=True)
    total = np.bincount(which.reshape(-1), weights=areas)
    return np.asarray(unique[np.argsort(-total, kind="stable")[:_FACES]])


def all_round() -> Floats:
    """Directions all round, evenly."""
    n = np.arange(_ROUND) + 0.5
    height, turn = 1 - 2 * n / _ROUND, n * math.pi * (3 - math.sqrt(5))
    flat = np.sqrt(1 - height**2)
    return np.column_stack([flat * np.cos(turn), flat * np.sin(turn), height])


def _distinct(directions: Floats) -> Floats:
    """Those that no earlier one is much like, as unit vectors."""
    _, first = np.unique(np.round(directions, 3) + 0.0, axis=0, return_index=True)
    chosen = directions[np.sort(first)]
    return np.asarray(chosen / np.linalg.norm(chosen, axis=1)[:, None])
