"""Signed distance to a solid, on a grid: below zero inside, quick to ask at many points.

Near the surface the nodes find their exact distance when first asked; farther out they know a
bound below it.  Between nodes the distance is linear in each coordinate: exact beside flat
faces, while edges are rounded off by a third of a cell.  So it guides a search, and proves
nothing.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import distance_transform_edt
from scipy.spatial import cKDTree

from scadgen.solid.affine import Floats, Ints

__all__ = ["Field", "refined"]

#: Cells around the box of the solid, and cells within which distances are exact.
_MARGIN, _EXACT = 3, 2.5

#: Distance, in cells, of the farthest node that the surface marks; a margin for the rest.
_MARKED = 1.5

#: Pieces of the surface among which the nearest is looked for, by their middles.
_PIECES = 4

#: The same for an exact distance, and how much nearer the nearest of them is, in cells.
_NEAR_PIECES, _TIED = 8, 1e-9

#: Slope below which a point is between two walls, away from neither.
_STEEP = 0.2

#: Where the grid begins, in cells: at no round number, as the coordinates of vertices are.
_OFF = (0.3819660, 0.4142136, 0.2679492)

#: The corners of a cell.
_CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])


def refined(points: Floats, triangles: Ints, spacing: float) -> tuple[Floats, Ints]:
    """Halve triangles along their longest sides until none is longer than `spacing`.

    Parameters
    ----------
    points, triangles
        ``(v, 3) float`` and ``(m, 3) int``.
    spacing
        Above 0, in mm.

    Returns
    -------
    corners, origin
        ``(k, 3, 3) float``: the corners of the small triangles, and ``(k,) int``: the numbers
        of those that they are pieces of.
    """
    corners, origin = points[triangles], np.arange(len(triangles))
    done = []
    while len(corners):
        lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        short = lengths.max(axis=1) <= spacing
        done.append((corners[short], origin[short]))
        corners, origin, longest = corners[~short], origin[~short], lengths[~short].argmax(axis=1)
        turned = (longest[:, None] + np.arange(3)) % 3
        a, b, c = np.moveaxis(np.take_along_axis(corners, turned[:, :, None], axis=1), 1, 0)
        middle = (a + b) / 2
        corners = np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
        origin = np.tile(origin, 2)
    return np.concatenate([c for c, _ in done]), np.concatenate([o for _, o in done])


class Field:
    """Signed distance to a closed, oriented mesh.

    Parameters
    ----------
    points, triangles
        ``(v, 3) float``, mm, and ``(m, 3) int``, counter-clockwise from outside.
    cell
        Distance of the grid's nodes, in mm.
    """

    def __init__(self, points: Floats, triangles: Ints, cell: float) -> None:
        self.cell = cell
        self.low = points.min(axis=0) - (_MARGIN + np.array(_OFF)) * cell
        self.shape = np.ceil((points.max(axis=0) - self.low) / cell).astype(np.int64) + _MARGIN + 1
        _, ny, nz = self.shape
        self._corner = (_CORNERS * [ny * nz, nz, 1]).sum(axis=1)
        corners, origin = refined(points, triangles, cell)
        middles = corners.mean(axis=1)
        self._faces, self._middles = points[triangles[origin]], cKDTree(middles)
        unmarked = np.ones(self.shape, dtype=bool)
        unmarked[tuple(np.rint((middles - self.low) / cell).astype(np.int64).T)] = False
        away = distance_transform_edt(unmarked)
        self._known = (away > _EXACT).ravel()
        sign = np.where(self._inside(points[triangles]), -1, 1)
        self._nodes: Floats = (sign * np.maximum(away - _MARKED, 0.1) * cell).ravel()

    def _learn(self, nodes: Ints) -> None:
        """Find the distances of some nodes that are not known yet."""
        at = self.low + np.column_stack(np.unravel_index(nodes, self.shape)) * self.cell
        _, near = self._middles.query(at, k=min(_PIECES, self._middles.n))
        near = near.reshape(len(at), -1)
        faces = self._faces[near].reshape(-1, 3, 3)
        found = _from_triangles(np.repeat(at, near.shape[1], axis=0), faces)
        self._nodes[nodes] = np.sign(self._nodes[nodes]) * found.reshape(near.shape).min(axis=1)
        self._known[nodes] = True

    def _inside(self, corners: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """Which nodes are inside: faces above that look up, less those that look down."""
        flat = (corners - self.low) / self.cell
        first = np.ceil(flat[:, :, :2].min(axis=1)).astype(np.int64)
        count = np.floor(flat[:, :, :2].max(axis=1)).astype(np.int64) - first + 1
        total = count.prod(axis=1)
        face = np.repeat(np.arange(len(flat)), total)
        number = np.arange(len(face)) - np.repeat(np.cumsum(total) - total, total)
        column = first[face] + np.column_stack(np.divmod(number, count[face, 1]))
        weights = [_area(flat[face, k - 2], flat[face, k - 1], column) for k in range(3)]
        up = np.all([w > 0 for w in weights], axis=0)
        hit = up | np.all([w < 0 for w in weights], axis=0)
        face, column, weight = face[hit], column[hit], np.column_stack(weights)[hit]
        height = (weight * flat[face, :, 2]).sum(axis=1) / weight.sum(axis=1)
        crossed = np.zeros(self.shape, dtype=np.int64)
        np.add.at(crossed, (*column.T, np.floor(height).astype(np.int64)), np.where(up[hit], 1, -1))
        return crossed[:, :, ::-1].cumsum(axis=2)[:, :, ::-1] > 0

    def _around(self, points: Floats) -> tuple[Floats, Floats, Floats]:
        """Distances at the corners of each point's cell, and where in it the point is.

        Both that and how far outside the grid it is are in cells.
        """
        local = (points - self.low) / self.cell
        inner = np.clip(local, 0, self.shape - 1.001)
        index = inner.astype(np.int64)
        _, ny, nz = self.shape
        number = (index[:, 0] * ny + index[:, 1]) * nz + index[:, 2]
        corner = number[:, None] + self._corner
        unknown = corner[~self._known[corner]]
        if len(unknown):
            self._learn(np.unique(unknown))
        return self._nodes[corner], inner - index, local - inner

    def value(self, points: Floats) -> Floats:
        """Signed distance at points ``(k, 3)``; outside the grid a bound below it."""
        node, at, outside = self._around(points)
        across = node[:, :4] + (node[:, 4:] - node[:, :4]) * at[:, :1]
        across = across[:, :2] + (across[:, 2:] - across[:, :2]) * at[:, 1:2]
        inner = across[:, 0] + (across[:, 1] - across[:, 0]) * at[:, 2]
        return np.asarray(inner + self.cell * np.abs(outside).max(axis=1))

    def exact(self, points: Floats) -> tuple[Floats, Floats]:
        """Signed distance at points ``(k, 3)`` near the surface, and the unit vectors away.

        The nearest point of the surface is looked for among the pieces whose middles are near.
        """
        if not len(points):
            return np.empty(0), np.empty((0, 3))
        _, near = self._middles.query(points, k=min(_NEAR_PIECES, self._middles.n))
        corners = self._faces[near.reshape(len(points), -1)]
        count = corners.shape[1]
        arms, normals = _arms(np.repeat(points, count, axis=0), corners.reshape(-1, 3, 3))
        arms, normals = arms.reshape(-1, count, 3), normals.reshape(-1, count, 3)
        far = np.linalg.norm(arms, axis=2)
        height = (arms * normals).sum(axis=2)
        # Beside an edge, which face's side the point is on: that of the one it is highest over.
        tied = far <= far.min(axis=1)[:, None] + _TIED * self.cell
        best = np.where(tied, np.abs(height), -1.0).argmax(axis=1)
        row = np.arange(len(points))
        sign = np.where(height[row, best] < 0, -1.0, 1.0)
        far, arm, normal = far[row, best], arms[row, best], normals[row, best]
        steep = far[:, None] > _TIED * self.cell
        away = np.where(steep, sign[:, None] * arm / np.maximum(far, 1e-300)[:, None], normal)
        return sign * far, away

    def normal(self, points: Floats) -> Floats:
        """Unit vectors ``(k, 3)`` away from the solid; zero where there is none."""
        node, at, _ = self._around(points)
        node = node.reshape(-1, 2, 2, 2)
        x, y, z = (np.stack([1 - a, a], axis=1) for a in at.T)
        slope = np.column_stack(
            [
                np.einsum("nyz,ny,nz->n", node[:, 1] - node[:, 0], y, z),
                np.einsum("nxz,nx,nz->n", node[:, :, 1] - node[:, :, 0], x, z),
                np.einsum("nxy,nx,ny->n", node[..., 1] - node[..., 0], x, y),
            ]
        )
        length = np.linalg.norm(slope, axis=1)[:, None]
        far = length > _STEEP * self.cell
        return np.asarray(np.divide(slope, length, out=np.zeros_like(slope), where=far))


def _area(a: Floats, b: Floats, c: Ints) -> Floats:
    """Twice the signed area of triangles in plan."""
    area: Floats = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (
        c[:, 0] - a[:, 0]
    )
    return area


def _from_triangles(points: Floats, corners: Floats) -> Floats:
    """Distance of each point from its triangle."""
    return np.asarray(np.linalg.norm(_arms(points, corners)[0], axis=1))


def _arms(points: Floats, corners: Floats) -> tuple[Floats, Floats]:
    """Way to each point from the nearest one of its triangle, and the triangles' normals."""
    sides = np.roll(corners, -1, axis=1) - corners
    normal = np.cross(sides[:, 0], sides[:, 1])
    length = np.linalg.norm(normal, axis=1)[:, None]
    normal = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    arm = points[:, None] - corners
    share = (arm * sides).sum(axis=2) / np.maximum((sides**2).sum(axis=2), 1e-300)
    beside = arm - np.clip(share, 0, 1)[:, :, None] * sides
    nearest = np.linalg.norm(beside, axis=2).argmin(axis=1)
    over = (np.cross(sides, arm) * normal[:, None]).sum(axis=2).min(axis=1) >= 0
    above = (arm[:, 0] * normal).sum(axis=1)[:, None] * normal
    over &= length[:, 0] > 0
    return np.where(over[:, None], above, beside[np.arange(len(points)), nearest]), normal
