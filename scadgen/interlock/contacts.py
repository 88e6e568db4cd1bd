"""Where the parts of an assembly touch.

A contact is a point, and the unit normal there from one part to the other.  Faces of two
parts touch where they lie back to back within a tolerance: their normals are opposite within
an angle, and one, projected onto the other's plane, overlaps it.  The corners of that overlap
are the contacts: for flat faces, and for rigid parts to first order, they stand for all points
between them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.errors import InputError
from scadgen.interlock.nearby import near_pairs
from scadgen.solid.affine import Floats, Ints

__all__ = ["Contacts", "Mesh", "default_tolerance", "find_contacts"]

#: A part's mesh: points ``(v, 3) float`` and triangles ``(m, 3) int``.
Mesh = tuple[Floats, Ints]

#: Cosine of the angle up to which faces of curved walls count as back to back.
_OPPOSITE = -np.cos(np.radians(10.0))

#: Overlaps narrower than this share of the tolerance are sides, not faces.
_NARROW = 1e-6

#: The default tolerance as a share of the median part's diagonal: printed parts leave gaps
#: of some tenths of a millimetre on some tens of millimetres.
_TOLERANCE = 0.01


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """Contacts between parts.

    Parameters
    ----------
    points
        ``(k, 3) float``.
    normals
        ``(k, 3) float``: unit vectors from part `first` to part `second`.
    first, second
        ``(k,) int``: numbers of the parts.
    """

    points: Floats
    normals: Floats
    first: Ints
    second: Ints

    def __len__(self) -> int:
        """Number of contacts."""
        return len(self.points)

    def some(self, which: Ints) -> Contacts:
        """Those of some numbers."""
        return Contacts(
            self.points[which], self.normals[which], self.first[which], self.second[which]
        )


def default_tolerance(meshes: Sequence[Mesh]) -> float:
    """One hundredth of the median diagonal of the parts' boxes, in their unit."""
    diagonals = [np.linalg.norm(np.ptp(points, axis=0)) for points, _ in meshes]
    return float(_TOLERANCE * np.median(diagonals))


def find_contacts(
    meshes: Sequence[Mesh], tolerance: float, smooth: Sequence[Floats] | None = None
) -> Contacts:
    """Contacts between all parts.

    Parameters
    ----------
    meshes
        The parts, watertight, counter-clockwise from outside.
    tolerance
        Distance up to which faces touch, in the meshes' unit, above 0.  Parts thinner than
        it let the faces on both their sides touch each other.
    smooth
        ``(m, 3, 3) float`` for each part: normals at the corners of its triangles, from
        which those of contacts are interpolated; None for the triangles' own.

    Returns
    -------
    contacts
        In the middle between the faces.  Edges and corners that rest on something make none.

    Raises
    ------
    InputError
        `tolerance` is not a finite number above 0.
    """
    if not 0 < tolerance < np.inf:
        msg = f"tolerance = {tolerance:g}: must be a finite number above 0"
        raise InputError(msg)
    corners = np.concatenate([points[triangles] for points, triangles in meshes])
    owner = np.repeat(np.arange(len(meshes)), [len(triangles) for _, triangles in meshes])
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(across, axis=1)
    sound = size > 0
    corners, owner, across, size = corners[sound], owner[sound], across[sound], size[sound]
    normals = across / size[:, None]
    bent = None if smooth is None else np.concatenate(smooth)[sound]
    found = []
    low, high = corners.min(axis=1) - tolerance / 2, corners.max(axis=1) + tolerance / 2
    for one, other in near_pairs(low, high, owner):
        facing = np.einsum("ij,ij->i", normals[one], normals[other]) < _OPPOSITE
        lower = np.where(owner[one] < owner[other], one, other)
        a, b = lower[facing], (one + other - lower)[facing]
        normal = across[a] - across[b]
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        place, pair = _overlaps(corners[a], corners[b], normal, tolerance)
        a, b, normal = a[pair], b[pair], normal[pair]
        if bent is not None:
            normal = _between(corners[a], bent[a], place) - _between(corners[b], bent[b], place)
            normal /= np.linalg.norm(normal, axis=1)[:, None]
        found.append((place, normal, owner[a], owner[b]))
    if not found:
        nothing, none = np.empty((0, 3)), np.empty(0, dtype=np.int64)
        return Contacts(nothing, nothing, none, none)
    return Contacts(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _overlaps(a: Floats, b: Floats, normal: Floats, tolerance: float) -> tuple[Floats, Ints]:
    """Corners of the overlap of each two faces, seen along a normal, and their pairs' numbers."""
    origin = a.mean(axis=1)
    across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal), axis=1)])
    across /= np.linalg.norm(across, axis=1)[:, None]
    frame = np.stack([across, np.cross(normal, across), normal], axis=1)
    first = np.einsum("pcx,pdx->pcd", a - origin[:, None], frame)
    second = np.einsum("pcx,pdx->pcd", b - origin[:, None], frame)
    polygon, count = _clipped(second[:, ::-1, :2], first[..., :2])
    below, above = _height(first, polygon), _height(second, polygon)
    good = (np.arange(polygon.shape[1]) < count[:, None]) & (np.abs(above - below) <= tolerance)
    good &= (_area(polygon, count) > _NARROW * tolerance**2)[:, None]
    pair, corner = np.nonzero(good)
    level = (below[pair, corner] + above[pair, corner]) / 2
    local = np.column_stack([polygon[pair, corner], level])
    return origin[pair] + np.einsum("kd,kdx->kx", local, frame[pair]), pair


def _between(triangle: Floats, values: Floats, points: Floats) -> Floats:
    """What triangles have at points over them, by what they have at their corners."""
    sides = triangle[:, 1:] - triangle[:, :1]
    normal = np.cross(sides[:, 0], sides[:, 1])
    off = points - triangle[:, 0]
    share = np.stack([np.cross(off, sides[:, 1]), np.cross(sides[:, 0], off)], axis=1)
    share = np.einsum("pkx,px->pk", share, normal) / (normal**2).sum(axis=1)[:, None]
    steps = values[:, 1:] - values[:, :1]
    return np.asarray(values[:, 0] + np.einsum("pk,pkx->px", share, steps))


def _height(triangle: Floats, points: Floats) -> Floats:
    """Height of each triangle's plane over points of its frame's plane."""
    normal = np.cross(triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 0])
    off = points - triangle[:, :1, :2]
    return np.asarray(
        triangle[:, :1, 2] - np.einsum("pcx,px->pc", off, normal[:, :2]) / normal[:, 2:]
    )


def _area(polygon: Floats, count: Ints) -> Floats:
    """Area of padded polygons."""
    index = np.arange(polygon.shape[1])
    after = np.where(index + 1 < count[:, None], index + 1, 0)
    ends = np.take_along_axis(polygon, after[..., None], axis=1)
    cross = polygon[..., 0] * ends[..., 1] - polygon[..., 1] * ends[..., 0]
    return np.asarray(np.abs(np.where(index < count[:, None], cross, 0.0).sum(axis=1)) / 2)


def _clipped(polygon: Floats, window: Floats) -> tuple[Floats, Ints]:
    """Convex polygons clipped by triangles, both ``(p, corners, 2)``; padded, and their counts.

    Sutherland and Hodgman's algorithm, one side of all windows at a time.
    """
    count = np.full(len(polygon), polygon.shape[1])
    for side in range(3):
        start, stop = window[:, side], window[:, (side + 1) % 3]
        inward = np.stack([start[:, 1] - stop[:, 1], stop[:, 0] - start[:, 0]], axis=1)
        depth = np.einsum("pcx,px->pc", polygon - start[:, None], inward)
        polygon, count = _cut(polygon, count, depth)
    return polygon, count


def _cut(polygon: Floats, count: Ints, depth: Floats) -> tuple[Floats, Ints]:
    """Padded polygons less what has a negative depth."""
    width = polygon.shape[1]
    index = np.arange(width)
    present = index < count[:, None]
    after = np.where(index + 1 < count[:, None], index + 1, 0)
    ends, end_depth = (
        np.take_along_axis(polygon, after[..., None], axis=1),
        np.take_along_axis(depth, after, axis=1),
    )
    crossed = present & ((depth >= 0) != (end_depth >= 0))
    share = np.where(crossed, depth / np.where(crossed, depth - end_depth, 1.0), 0.0)
    middle = polygon + share[..., None] * (ends - polygon)
    kept = present & (depth >= 0)
    points = np.stack([polygon, middle], axis=2).reshape(len(polygon), 2 * width, 2)
    keep = np.stack([kept, crossed], axis=2).reshape(len(polygon), 2 * width)
    order = np.argsort(~keep, axis=1, kind="stable")[:, : width + 1]
    return np.take_along_axis(points, order[..., None], axis=1), np.minimum(
        keep.sum(axis=1), width + 1
    )
