"""Where the walls' vertices are: on the exact walls.

A vertex stands for a lattice edge, face or cell whose nodes carry two or more labels.  It is
the point in that edge's line, face's plane, or in space where those labels' curves are
equally far: found by Newton's method from the middle of the places where walls cross the
feature's edges.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scadgen.joint.lattice import Lattice
from scadgen.joint.site import Site, nearest_site, slopes
from scadgen.joint.walls import Feature
from scadgen.solid.affine import Floats, Ints

__all__ = ["beside_walls", "place"]

#: Newton steps; they converge quadratically from within a cell.
_STEPS = 5

#: A step smaller than this, in sides, is the last: the next would be its square.
_STILL = 1e-8

#: How far a vertex may move from where it starts, in diameters of its feature.
_STRAY = 0.5


def beside_walls(lattice: Lattice, curves: Sequence[Site]) -> Floats:
    """Distances of the lattice's nodes from the curves, for labels and for `place`.

    Where a wall crosses an edge of the lattice, both curves' distances at both of its ends are
    exact.  All others are infinite, but for the nearest's, which is some number.

    Returns
    -------
    distances
        ``(curves, planes, radii, heights) float``.
    """
    labels = nearest_site(curves, lattice.nodes)
    far = np.full((len(curves), labels.size), np.inf)
    number = np.arange(labels.size).reshape(labels.shape)
    far[labels.ravel(), number.ravel()] = 0.0
    wanted = np.zeros(far.shape, dtype=np.bool_)
    for axis in range(3):
        # Only the angle closes on itself.
        some = slice(None) if axis == 0 else slice(-1)
        ends = [
            np.moveaxis(np.roll(number, -shift, axis), axis, 0)[some].ravel() for shift in (0, 1)
        ]
        first, second = (labels.ravel()[end] for end in ends)
        crossed = first != second
        for end in ends:
            for label in (first, second):
                wanted[label[crossed], end[crossed]] = True
    which, node = np.nonzero(wanted)
    far[which, node], _ = slopes(curves, lattice.nodes.reshape(-1, 3).take(node, axis=0), which)
    return far.reshape(len(curves), *labels.shape)


def place(lattice: Lattice, curves: Sequence[Site], far: Floats, keys: Sequence[Feature]) -> Floats:
    """Positions of vertices.

    Parameters
    ----------
    lattice, curves
        The joint's lattice and site curves.
    far
        ``(curves, planes, radii, heights) float``: as `beside_walls` gives them.
    keys
        The vertices.

    Returns
    -------
    points
        ``(len(keys), 3) float``, in sides.
    """
    # Vertices that are nodes see no curves and have no directions to move in.
    start, basis = np.empty((len(keys), 3)), np.zeros((len(keys), 3, 3))
    seen, size = np.zeros((len(keys), len(curves)), dtype=np.bool_), np.zeros(len(keys))
    kinds = [(key[0], key[1]) for key in keys]
    for kind in set(kinds):
        rows = [n for n, other in enumerate(kinds) if other == kind]
        index = np.array([keys[n][2:5] for n in rows])
        axes = _axes(kind)
        shifts = np.zeros((2 ** len(axes), 3), dtype=int)
        shifts[:, list(axes)] = list(itertools.product((0, 1), repeat=len(axes)))
        i, j, k = np.moveaxis(index[:, None] + shifts, -1, 0)
        i %= len(lattice.planes)
        corners, away = lattice.nodes[i, j, k], np.moveaxis(far[:, i, j, k], 0, -1)
        if not axes:
            start[rows] = corners[:, 0]
            continue
        start[rows] = _middle_of_crossings(shifts, corners, away)
        seen[np.array(rows)[:, None], away.argmin(-1)] = True
        size[rows] = np.linalg.norm(corners[:, -1] - corners[:, 0], axis=1)
        basis[rows, : len(axes)] = _basis(corners, len(axes))
    found = _meet(curves, seen, start, basis)
    stray = np.linalg.norm(found - start, axis=1) > _STRAY * size
    return np.where(stray[:, None], start, found)


def _axes(kind: tuple[str, int]) -> tuple[int, ...]:
    """The axes along which a feature extends."""
    name, axis = kind
    across = tuple({0, 1, 2} - {axis})
    return {"node": (), "edge": (axis,), "face": across, "cell": (0, 1, 2)}[name]


def _middle_of_crossings(shifts: Ints, corners: Floats, far: Floats) -> Floats:
    """Mean of where walls cross each feature's edges, by linear interpolation."""
    total = np.zeros_like(corners[:, 0])
    count = np.zeros(len(corners))
    label = far.argmin(-1)
    row = np.arange(len(corners))
    for a, b in itertools.combinations(range(len(shifts)), 2):
        if np.abs(shifts[a] - shifts[b]).sum() != 1:
            continue
        la, lb = label[:, a], label[:, b]
        at_a = far[row, a, lb] - far[row, a, la]
        at_b = far[row, b, la] - far[row, b, lb]
        crossed = la != lb
        share = np.where(crossed, at_a / np.where(crossed, at_a + at_b, 1.0), 0.0)
        total += crossed[:, None] * (
            corners[:, a] + share[:, None] * (corners[:, b] - corners[:, a])
        )
        count += crossed
    return np.asarray(total / count[:, None])


def _basis(corners: Floats, dimensions: int) -> Floats:
    """Orthonormal directions in which vertices may move, ``(m, dimensions, 3)``."""
    if dimensions == 3:
        return np.broadcast_to(np.eye(3), (len(corners), 3, 3))
    first = corners[:, -1] - corners[:, 0]
    first = first / np.linalg.norm(first, axis=1)[:, None]
    if dimensions == 1:
        return np.asarray(first[:, None])
    second = corners[:, 2] - corners[:, 1]
    second = second - np.einsum("ij,ij->i", second, first)[:, None] * first
    return np.stack([first, second / np.linalg.norm(second, axis=1)[:, None]], axis=1)


def _meet(curves: Sequence[Site], seen: NDArray[np.bool_], start: Floats, basis: Floats) -> Floats:
    """Points nearest the start, within the basis, equally far from all curves seen, if any."""
    points = start.copy()
    reference = seen.argmax(axis=1)
    moving = np.flatnonzero(seen.any(axis=1))
    for _ in range(_STEPS):
        far, slope = _seen_distances(curves, points[moving], seen[moving])
        row, first = np.arange(len(moving)), reference[moving]
        excess = np.where(seen[moving], far - far[row, first][:, None], 0.0)
        slope = np.where(seen[moving, :, None], slope - slope[row, first][:, None], 0.0)
        within = np.einsum("mlx,mdx->mld", slope, basis[moving])
        step = _shortest_steps(within, excess)
        points[moving] -= np.einsum("md,mdx->mx", step, basis[moving])
        moving = moving[np.abs(step).max(axis=1) > _STILL]
    return points


def _shortest_steps(rows: Floats, excess: Floats) -> Floats:
    """The shortest steps ``(m, d)`` that undo ``(m, l)`` by rows ``(m, l, d)``."""
    # Nearly all vertices are on one wall, with one row that is not zero.
    step = np.einsum("mld,ml->md", rows, excess)
    step /= np.maximum(np.einsum("mld,mld->m", rows, rows), np.finfo(float).tiny)[:, None]
    several = np.flatnonzero(rows.any(axis=2).sum(axis=1) > 1)
    inverse = np.linalg.pinv(rows[several], rcond=1e-6)
    step[several] = np.einsum("mdl,ml->md", inverse, excess[several])
    return np.asarray(step)


def _seen_distances(
    curves: Sequence[Site], points: Floats, seen: NDArray[np.bool_]
) -> tuple[Floats, Floats]:
    """Distances from the curves seen, and their gradients; zero from others."""
    far, slope = np.zeros(seen.shape), np.zeros((*seen.shape, 3))
    row, which = np.nonzero(seen)
    far[row, which], slope[row, which] = slopes(curves, points.take(row, axis=0), which)
    return far, slope
