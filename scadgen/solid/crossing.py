"""Which faces of a mesh cross or touch where they should not.

Pairs whose boxes overlap are put to the separating axis test: two convex sets are
apart exactly when some axis out of a short list separates them.  Any axis that does
is a proof by itself, however it was rounded, so the test never calls crossing faces
apart by more than the tolerance.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats, Ints

__all__ = ["TOUCH", "box_pairs", "crossing_faces", "own_box_pairs"]

#: Faces closer than this share of the mesh's diagonal count as touching.  Rounding
#: moves a vertex by about 1e-16 of it, the smallest feature kept is about 1e-5.
TOUCH = 1e-9

#: Candidate pairs looked at together: bounds the memory at some tens of megabytes.
_CHUNK = 1 << 18

#: Corners of a segment.
_SEGMENT = 2

_Mask = NDArray[np.bool_]


def _ranges(first: Ints, start: Ints, stop: Ints) -> Iterator[tuple[Ints, Ints]]:
    """Yield ``(first[i], j)`` for every i and every j in ``start[i]:stop[i]``, in chunks."""
    counts = np.maximum(stop - start, 0)
    ends = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        done = ends[begin - 1] if begin else 0
        end = max(int(np.searchsorted(ends, done + _CHUNK, side="right")), begin + 1)
        piece = counts[begin:end]
        left = np.repeat(first[begin:end], piece)
        offset = np.repeat(start[begin:end] - (np.cumsum(piece) - piece), piece)
        yield left, np.arange(len(left)) + offset
        begin = end


def _overlapping(
    left: Ints, right: Ints, boxes_a: tuple[Floats, Floats], boxes_b: tuple[Floats, Floats]
) -> Ints:
    """Those pairs that no direction separates in the same sense at all times, ``(k, 2)``."""
    (low_a, high_a), (low_b, high_b) = boxes_a, boxes_b
    for k in range(low_a.shape[2]):
        above = np.ones(len(left), dtype=bool)
        below = above.copy()
        for e in range(low_a.shape[1]):
            above &= low_a[:, e, k][left] > high_b[:, e, k][right]
            below &= low_b[:, e, k][right] > high_a[:, e, k][left]
        keep = ~(above | below)
        left, right = left[keep], right[keep]
    return np.column_stack([left, right])


def _swept(low: Floats, high: Floats) -> tuple[Floats, Floats]:
    return low.min(axis=1), high.max(axis=1)


def own_box_pairs(low: Floats, high: Floats) -> Iterator[Ints]:
    """Pairs out of one set of boxes that overlap.

    Parameters
    ----------
    low, high
        ``(n, e, d) float``: extent of each box along d directions at e times.  A pair
        is left out if one direction has the same box above at *every* time.

    Yields
    ------
    pairs
        ``(k, 2) int``, each unordered pair once, in chunks.
    """
    low_all, high_all = _swept(low, high)
    best = None
    for k in range(low.shape[2]):
        order = np.argsort(low_all[:, k], kind="stable")
        stop = np.searchsorted(low_all[order, k], high_all[order, k], side="right")
        if best is None or stop.sum() < best[1].sum():
            best = order, stop
    if best is None:
        return
    order, stop = best
    position = np.arange(len(order))
    for left, right in _ranges(order, position + 1, stop):
        yield _overlapping(left, order[right], (low, high), (low, high))


def box_pairs(low_a: Floats, high_a: Floats, low_b: Floats, high_b: Floats) -> Iterator[Ints]:
    """Pairs of boxes, one from each of two sets, that overlap.

    Parameters
    ----------
    low_a, high_a, low_b, high_b
        ``(n, e, d) float`` and ``(m, e, d) float``; see `own_box_pairs`.

    Yields
    ------
    pairs
        ``(k, 2) int``, index in the first set and in the second, in chunks.
    """
    all_a, all_b = _swept(low_a, high_a), _swept(low_b, high_b)
    best, fewest = None, np.inf
    for k in range(low_a.shape[2]):
        (la, ha), (lb, hb) = (x[:, k] for x in all_a), (x[:, k] for x in all_b)
        order_a, order_b = np.argsort(la, kind="stable"), np.argsort(lb, kind="stable")
        # Two intervals overlap iff one of them starts inside the other.
        sorted_a, sorted_b = la[order_a], lb[order_b]
        in_a = np.searchsorted(sorted_b, la, "left"), np.searchsorted(sorted_b, ha, "right")
        in_b = np.searchsorted(sorted_a, lb, "right"), np.searchsorted(sorted_a, hb, "right")
        count = (in_a[1] - in_a[0]).sum() + (in_b[1] - in_b[0]).sum()
        if count < fewest:
            best, fewest = (order_a, order_b, in_a, in_b), count
    if best is None:
        return
    order_a, order_b, in_a, in_b = best
    boxes_a, boxes_b = (low_a, high_a), (low_b, high_b)
    for left, right in _ranges(np.arange(len(low_a)), in_a[0], in_a[1]):
        yield _overlapping(left, order_b[right], boxes_a, boxes_b)
    for right, left in _ranges(np.arange(len(low_b)), in_b[0], in_b[1]):
        yield _overlapping(order_a[left], right, boxes_a, boxes_b)


def _cross(a: Floats, b: Floats) -> Floats:
    """Cross product of the last axis; three times as fast as `numpy.cross` here."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def _edge(corners: Floats, k: int) -> Floats:
    return corners[:, (k + 1) % corners.shape[1]] - corners[:, k]


def _normal(triangle: Floats) -> Floats:
    return _cross(_edge(triangle, 0), _edge(triangle, 1))


def _edge_axis(p: Floats, q: Floats, i: int, j: int) -> Floats:
    return _cross(_edge(p, i), _edge(q, j))


def _in_plane_axis(p: Floats, q: Floats, i: int) -> Floats:
    return _cross(_normal(q), _edge(p, i))


def _axes(edges: int) -> list[Callable[[Floats, Floats], Floats]]:
    """Axes that can separate p, of so many edges, from the triangle q; likely ones first."""
    normals = [lambda _, q: _normal(q), lambda p, _: _normal(p)]
    return [
        *normals[: 1 if edges == 1 else 2],
        *(partial(_edge_axis, i=i, j=j) for i in range(edges) for j in range(3)),
        # In one plane only the normals of the edges within that plane separate.
        *(partial(_in_plane_axis, i=i) for i in range(edges)),
        *(lambda _, q, j=j: _in_plane_axis(q, q, j) for j in range(3)),
    ]


def _apart(p: Floats, q: Floats, axis: Floats, touch: float) -> _Mask:
    """Whether the axis separates the points p from q by more than `touch`."""
    along_p = np.einsum("kij,kj->ki", p, axis)
    along_q = np.einsum("kij,kj->ki", q, axis)
    gap = np.maximum(
        along_p.min(axis=1) - along_q.max(axis=1), along_q.min(axis=1) - along_p.max(axis=1)
    )
    apart: _Mask = gap > touch * np.linalg.norm(axis, axis=1)
    return apart


def _meet(p: Floats, q: Floats, touch: float) -> _Mask:
    """Whether each segment or triangle p ``(k, 2 or 3, 3)`` meets the triangle q ``(k, 3, 3)``."""
    meet = np.ones(len(p), dtype=bool)
    left = np.arange(len(p))
    for axis in _axes(1 if p.shape[1] == _SEGMENT else 3):
        apart = _apart(p, q, axis(p, q), touch)
        meet[left[apart]] = False
        left, p, q = left[~apart], p[~apart], q[~apart]
    return meet


def _shared_first(one: Ints, other: Ints) -> tuple[Ints, Ints, Ints]:
    """Turn each triangle so that the shared vertices come first; and how many they are.

    Both triangles of a pair keep their shared vertices in *some* order, which is all
    that the tests need.
    """
    same = one[:, :, None] == other[:, None, :]
    in_one, in_other = same.any(axis=2), same.any(axis=1)
    first = np.argsort(~in_one, axis=1, kind="stable")
    second = np.argsort(~in_other, axis=1, kind="stable")
    count: Ints = in_one.sum(axis=1)
    return (
        np.take_along_axis(one, first, axis=1),
        np.take_along_axis(other, second, axis=1),
        count,
    )


def _folded(p: Floats, q: Floats, touch: float) -> _Mask:
    """Whether two triangles that share their first two corners lie on each other."""
    edge = p[:, 1] - p[:, 0]
    up = _cross(_normal(p), edge)
    height = q[:, 2] - p[:, 0]
    normal = _normal(p)
    off = np.abs((normal * height).sum(axis=1)) <= touch * np.linalg.norm(normal, axis=1)
    # `up` points away from p's third corner or towards it; only agreement matters.
    same = (up * (p[:, 2] - p[:, 0])).sum(axis=1) * (up * height).sum(axis=1) > 0
    folded: _Mask = off & same
    return folded


def crossing_faces(points: Floats, triangles: Ints, *, touch: float | None = None) -> Ints:
    """Pairs of faces that cross, touch or overlap other than in what they share.

    Faces without a common vertex must be apart; faces with one may meet only there,
    so the far edge of each must be apart from the other; faces with two must not be
    folded onto each other; faces with three are the same face twice.

    Parameters
    ----------
    points
        ``(v, 3) float``, mm.
    triangles
        ``(m, 3) int``.
    touch
        Distance in mm up to which faces count as touching; by default `TOUCH` times
        the diagonal of the mesh's box.

    Returns
    -------
    pairs
        ``(k, 2) int``, the lower face number first, sorted.
    """
    if not len(triangles):
        return np.empty((0, 2), dtype=np.int64)
    if touch is None:
        touch = TOUCH * float(np.linalg.norm(np.ptp(points[np.unique(triangles)], axis=0)))
    corners = points[triangles]
    low, high = corners.min(axis=1)[:, None], corners.max(axis=1)[:, None]
    found = []
    for pairs in own_box_pairs(low - touch, high + touch):
        one, other, shared = _shared_first(triangles[pairs[:, 0]], triangles[pairs[:, 1]])
        bad = shared == 3
        for count in range(3):
            at = np.flatnonzero(shared == count)
            p, q = points[one[at]], points[other[at]]
            if count == 0:
                bad[at] = _meet(p, q, touch)
            elif count == 1:
                bad[at] = _meet(p[:, 1:], q, touch) | _meet(q[:, 1:], p, touch)
            else:
                bad[at] = _folded(p, q, touch)
        found.append(pairs[bad])
    pairs = np.sort(np.concatenate(found), axis=1)
    return np.unique(pairs, axis=0)
