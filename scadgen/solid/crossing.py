"""Which faces of a mesh cross or touch where they should not.

Pairs whose boxes overlap are put to the separating axis test: two convex sets are
apart exactly when some axis out of a short list separates them.  Any axis that does
is a proof by itself, however it was rounded, so the test never calls crossing faces
apart by more than the tolerance.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats, Ints
from scadgen.solid.vectors import cross, dot

__all__ = ["TOUCH", "box_pairs", "crossing_faces", "own_box_pairs"]

#: Faces closer than this share of the mesh's diagonal count as touching.  Rounding
#: moves a vertex by about 1e-16 of it, the smallest feature kept is about 1e-5.
TOUCH = 1e-9

#: Candidate pairs looked at together: bounds the memory at some tens of megabytes.
_CHUNK = 1 << 18

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
    left: Ints,
    right: Ints,
    boxes_a: tuple[Floats, Floats],
    boxes_b: tuple[Floats, Floats],
    last: int,
) -> Ints:
    """Those pairs that no direction separates in the same sense at all times, ``(k, 2)``.

    The direction that they were found along is looked at last: it separates few of them.
    """
    order = [*(k for k in range(boxes_a[0].shape[2]) if k != last), last]
    # Of each direction and time a row of its own, which is read in the order it is kept.
    (low_a, high_a), (low_b, high_b) = (
        [np.ascontiguousarray(ends.transpose(2, 1, 0)[order]) for ends in boxes]
        for boxes in (boxes_a, boxes_b)
    )
    for ends in zip(low_a, high_a, low_b, high_b, strict=True):
        above, below = np.True_, np.True_
        for own_low, own_high, other_low, other_high in zip(*ends, strict=True):
            above = above & (own_low.take(left) > other_high.take(right))
            below = below & (other_low.take(right) > own_high.take(left))
        keep = np.flatnonzero(~(above | below))
        left, right = left.take(keep), right.take(keep)
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
            best = order, stop, k
    if best is None:
        return
    order, stop, axis = best
    position = np.arange(len(order))
    for left, right in _ranges(order, position + 1, stop):
        yield _overlapping(left, order[right], (low, high), (low, high), axis)


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
            best, fewest = (order_a, order_b, in_a, in_b, k), count
    if best is None:
        return
    order_a, order_b, in_a, in_b, axis = best
    boxes_a, boxes_b = (low_a, high_a), (low_b, high_b)
    for left, right in _ranges(np.arange(len(low_a)), in_a[0], in_a[1]):
        yield _overlapping(left, order_b[right], boxes_a, boxes_b, axis)
    for right, left in _ranges(np.arange(len(low_b)), in_b[0], in_b[1]):
        yield _overlapping(order_a[left], right, boxes_a, boxes_b, axis)


def _edges(corners: Floats) -> Floats:
    """Edges of triangles, ``(k, 3, 3)``, or the one of each segment, ``(k, 1, 3)``."""
    count = corners.shape[1]
    return np.stack(
        [corners[:, (n + 1) % count] - corners[:, n] for n in range(1 if count == 2 else count)],
        axis=1,
    )


def _normal(triangle: Floats) -> Floats:
    return cross(triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 1])


def _across_edges(p: Floats, q: Floats) -> Floats:
    """Axes across an edge of each of p and q, ``(k, axes, 3)``."""
    edges_p, edges_q = _edges(p), _edges(q)
    return cross(edges_p[:, :, None], edges_q[:, None]).reshape(len(p), 3 * edges_p.shape[1], 3)


def _other_axes(p: Floats, q: Floats) -> Floats:
    """All others that may separate p from the triangle q, ``(k, axes, 3)``."""
    normal = _normal(q)[:, None]
    # In one plane only the normals of the edges within that plane separate.
    axes = [normal, cross(normal, _edges(p)), cross(normal, _edges(q))]
    if p.shape[1] > 2:
        axes.append(_normal(p)[:, None])
    return np.concatenate(axes, axis=1)


def _extent(axes: Floats, corners: Floats) -> tuple[Floats, Floats]:
    """From where to where shapes reach along axes, ``(k, axes)`` each."""
    along = [np.einsum("kai,ki->ka", axes, corner) for corner in corners.swapaxes(0, 1)]
    return np.asarray(reduce(np.minimum, along)), np.asarray(reduce(np.maximum, along))


def _meet(p: Floats, q: Floats, touch: float) -> _Mask:
    """Whether each segment or triangle p ``(k, 2 or 3, 3)`` meets the triangle q ``(k, 3, 3)``."""
    meet = np.ones(len(p), dtype=bool)
    for axes_of in (_across_edges, _other_axes):
        left = np.flatnonzero(meet)
        own, facing = p.take(left, axis=0), q.take(left, axis=0)
        axes = axes_of(own, facing)
        (low_p, high_p), (low_q, high_q) = _extent(axes, own), _extent(axes, facing)
        gap = np.maximum(low_p - high_q, low_q - high_p)
        meet[left] = (gap <= touch * np.linalg.norm(axes, axis=2)).all(axis=1)
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
    up = cross(_normal(p), edge)
    height = q[:, 2] - p[:, 0]
    normal = _normal(p)
    off = np.abs((normal * height).sum(axis=1)) <= touch * np.linalg.norm(normal, axis=1)
    # `up` points away from p's third corner or towards it; only agreement matters.
    same = (up * (p[:, 2] - p[:, 0])).sum(axis=1) * (up * height).sum(axis=1) > 0
    folded: _Mask = off & same
    return folded


def _beside(planes: Floats, corners: Sequence[Floats], own: Sequence[_Mask], touch: float) -> _Mask:
    """Whether all own corners of each triangle are on one side of a plane, clear of it.

    Planes are ``(k, 4)``, unit normals and what they give in the plane; corners are three of
    ``(k, 3)``, and those that are not a triangle's own are left out.
    """
    above, below = np.ones(len(planes), dtype=bool), np.ones(len(planes), dtype=bool)
    for corner, is_own in zip(corners, own, strict=True):
        height = dot(corner, planes[:, :3]) - planes[:, 3]
        above &= ~is_own | (height > touch)
        below &= ~is_own | (height < -touch)
    return above | below


def _close(corners: Floats, triangles: Ints, pairs: Ints, touch: float) -> Ints:
    """Those pairs that planes alone do not tell apart.

    They do so where there is no common vertex and one triangle is clear of the other's plane, or
    where there is one and both are but for that.
    """
    corners = corners - corners.mean(axis=(0, 1))
    normal = _normal(corners)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), np.finfo(float).tiny)[:, None]
    planes = np.column_stack([normal, dot(normal, corners[:, 0])])
    one, other = pairs.T
    names = [np.ascontiguousarray(triangles.take(side, axis=0).T) for side in (one, other)]
    same = [[a == b for b in names[1]] for a in names[0]]
    own_of_one = [~(row[0] | row[1] | row[2]) for row in same]
    own_of_other = [~(a | b | c) for a, b, c in zip(*same, strict=True)]
    by_corner = [np.ascontiguousarray(corners[:, n]) for n in range(3)]
    clear = []
    for own, facing, is_own in ((one, other, own_of_one), (other, one, own_of_other)):
        shown = [corner.take(own, axis=0) for corner in by_corner]
        clear.append(_beside(planes.take(facing, axis=0), shown, is_own, touch))
    shared = 3 - np.sum(own_of_one, axis=0)
    apart = np.where(shared == 0, clear[0] | clear[1], (shared == 1) & clear[0] & clear[1])
    return np.asarray(pairs[~apart])


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
    corners = points.take(triangles, axis=0)
    if touch is None:
        touch = TOUCH * float(np.linalg.norm(np.ptp(corners, axis=(0, 1))))
    low, high = corners.min(axis=1)[:, None], corners.max(axis=1)[:, None]
    found = []
    for boxed in own_box_pairs(low - touch, high + touch):
        pairs = _close(corners, triangles, boxed, touch)
        one, other, shared = _shared_first(*(triangles.take(side, axis=0) for side in pairs.T))
        bad = shared == 3
        for count in range(3):
            at = np.flatnonzero(shared == count)
            p, q = (points.take(side.take(at, axis=0), axis=0) for side in (one, other))
            if count == 0:
                bad[at] = _meet(p, q, touch)
            elif count == 1:
                far, facing = np.concatenate([p, q])[:, 1:], np.concatenate([q, p])
                bad[at] = _meet(far, facing, touch).reshape(2, -1).any(axis=0)
            else:
                bad[at] = _folded(p, q, touch)
        found.append(pairs[bad])
    pairs = np.sort(np.concatenate(found), axis=1)
    return np.unique(pairs, axis=0)
