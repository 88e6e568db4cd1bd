"""Which faces of a mesh bound one body, even where bodies touch.

Round an edge, faces alternate between those where material begins and those where it ends.
Two faces with material between them belong to one body; so two bodies that share an edge, or
a whole face, are told apart, which counting shared edges alone cannot do.  By the same pairs a
body that touches itself is split there: it gets a point for each fan of faces.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.solid.affine import Floats, Ints
from scadgen.solid.mesh import volume

__all__ = ["bodies", "open_edges", "unpinched"]

#: Angle, in radians, up to which faces round an edge lie on each other.
_SAME = 1e-5


def open_edges(triangles: Ints) -> Ints:
    """Edges whose faces do not come in opposite pairs, ``(k, 2) int``, lower vertex first.

    None is left in a closed surface, also where several sheets of it meet in an edge.
    """
    tail, head = triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)
    ends = np.sort(np.column_stack([tail, head]), axis=1)
    edges, which = np.unique(ends, axis=0, return_inverse=True)
    balance = np.bincount(
        which.reshape(-1), weights=np.where(tail < head, 1, -1), minlength=len(edges)
    )
    faulty: Ints = edges[balance != 0]
    return faulty


def bodies(points: Floats, triangles: Ints) -> list[Ints]:
    """Split a closed mesh into its bodies.

    Parameters
    ----------
    points
        ``(v, 3) float``; equal points have one number.
    triangles
        ``(m, 3) int``, counter-clockwise from outside.

    Returns
    -------
    bodies
        Face numbers of each, ordered by their first.  The wall of a cavity goes with the
        smallest body around it.
    """
    one, other = (half // 3 for half in _across_material(points, triangles))
    count = len(triangles)
    graph = coo_array((np.ones(len(one)), (one, other)), shape=(count, count))
    found, label = connected_components(graph, directed=False)
    shells = [np.flatnonzero(label == n) for n in range(found)]
    shells.sort(key=lambda faces: int(faces[0]))
    size = [volume(points, triangles[faces]) for faces in shells]
    low = np.array([points[triangles[faces]].min(axis=(0, 1)) for faces in shells])
    high = np.array([points[triangles[faces]].max(axis=(0, 1)) for faces in shells])
    owner = list(range(found))
    for hole in range(found):
        around = [
            n
            for n in range(found)
            if size[n] > -size[hole] > 0
            and (low[n] <= low[hole]).all()
            and (high[n] >= high[hole]).all()
        ]
        if around:
            owner[hole] = min(around, key=lambda n: size[n])
    merged = (
        np.concatenate([shells[n] for n in range(found) if owner[n] == body])
        for body in range(found)
        if body in owner
    )
    return [np.sort(faces) for faces in merged]


def unpinched(points: Floats, triangles: Ints) -> tuple[Floats, Ints]:
    """Split the points where a body touches itself, along an edge or at a corner.

    Parameters
    ----------
    points
        ``(v, 3) float``; equal points have one number.
    triangles
        ``(m, 3) int``: a closed surface, counter-clockwise from outside.

    Returns
    -------
    points, triangles
        The same surface as a manifold: every edge has two faces, every point one fan of them.
    """
    while True:
        points, triangles, one, other = _fanned(points, triangles)
        ends = np.sort(np.column_stack([triangles.reshape(-1), _after(triangles)])[one], axis=1)
        _, edge, uses = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
        pinched = np.flatnonzero(uses[edge.reshape(-1)] > 1)
        if not len(pinched):
            return points, triangles
        # Where the fans at both its ends hang together, an edge is parted in its middle.
        chosen = _apart(one[pinched] // 3, other[pinched] // 3)
        points, triangles = _parted(points, triangles, one[pinched[chosen]], other[pinched[chosen]])


def _after(triangles: Ints) -> Ints:
    """Where each half edge ends."""
    return np.roll(triangles, -1, axis=1).reshape(-1)


def _fanned(points: Floats, triangles: Ints) -> tuple[Floats, Ints, Ints, Ints]:
    """The same with a point for each fan of faces, and the pairs of half edges."""
    one, other = _across_material(points, triangles)
    # The tail of a half edge is the head of the one that it meets.
    after = np.arange(triangles.size).reshape(-1, 3)[:, [1, 2, 0]].reshape(-1)
    corner = np.concatenate([one, after[one]]), np.concatenate([after[other], other])
    count = triangles.size
    graph = coo_array((np.ones(len(corner[0])), corner), shape=(count, count))
    _, fan = connected_components(graph, directed=False)
    _, first = np.unique(fan, return_index=True)
    return points[triangles.reshape(-1)[first]], fan.astype(np.int64).reshape(-1, 3), one, other


def _apart(one: Ints, other: Ints) -> list[int]:
    """Numbers of pairs of faces, as many as have no face in common with an earlier one."""
    taken: set[int] = set()
    chosen = []
    for number, pair in enumerate(zip(one.tolist(), other.tolist(), strict=True)):
        if taken.isdisjoint(pair):
            taken.update(pair)
            chosen.append(number)
    return chosen


def _parted(points: Floats, triangles: Ints, one: Ints, other: Ints) -> tuple[Floats, Ints]:
    """Faces on both sides of some edges cut in two, each pair at a point of its own."""
    middles = points[triangles.reshape(-1)[one]] + points[_after(triangles)[one]]
    half = np.concatenate([one, other])
    number = len(points) + np.tile(np.arange(len(one)), 2)
    face, corner = np.divmod(half, 3)
    a, b, c = (triangles[face, (corner + k) % 3] for k in range(3))
    kept = np.delete(triangles, face, axis=0)
    cut = [np.column_stack([a, number, c]), np.column_stack([number, b, c])]
    return np.concatenate([points, middles / 2]), np.concatenate([kept, *cut])


def _across_material(points: Floats, triangles: Ints) -> tuple[Ints, Ints]:
    """Pairs of half edges whose faces have nothing but material between them.

    Number ``3 * face + corner`` starts at that corner.
    """
    tail, head = triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)
    third = np.roll(triangles, -2, axis=1).reshape(-1)
    ends = np.sort(np.column_stack([tail, head]), axis=1)
    edges, edge = np.unique(ends, axis=0, return_inverse=True)
    edge = edge.reshape(-1)
    along = points[edges[:, 1]] - points[edges[:, 0]]
    out = points[third] - points[ends[:, 0]]
    # The first face at each edge is where its angles begin.
    zero = out[np.unique(edge, return_index=True)[1]][edge]
    along = (along / np.linalg.norm(along, axis=1)[:, None])[edge]
    up = np.cross(along, zero)
    sine, cosine = (out * up).sum(axis=1), (out * np.cross(up, along)).sum(axis=1)
    angle = np.mod(np.arctan2(sine, cosine) + _SAME, 2 * np.pi)
    order = np.lexsort((angle, edge))
    step = (np.diff(edge[order], prepend=-1) != 0) | (np.diff(angle[order], prepend=0) > _SAME)
    level = np.empty(len(edge), dtype=np.int64)
    level[order] = np.cumsum(step)
    # Where faces lie on each other one body ends before the next begins.
    begins = tail > head
    order = np.lexsort((begins, level, edge))
    start = np.flatnonzero(np.diff(edge[order], prepend=-1))
    following = np.arange(1, len(order) + 1)
    following[np.append(start[1:], len(order)) - 1] = start
    first = np.flatnonzero(begins[order])
    return order[first], order[following[first]]
