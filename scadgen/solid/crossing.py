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


def _folded(p: Floats, far: Floats, touch: float) -> _Mask:
    """Whether triangles lie on others, which have the first two corners and a far one."""
    normal, height = _normal(p), far - p[:, 0]
    up = cross(normal, p[:, 1] - p[:, 0])
    off = np.abs(dot(normal, height)) <= touch * np.linalg.norm(normal, axis=1)
    # `up` points away from p's third corner or towards it; only agreement matters.
    same = dot(up, p[:, 2] - p[:, 0]) * dot(up, height) > 0
    folded: _Mask = off & same
    return folded


def _common(triangles: Ints, pairs: Ints) -> tuple[_Mask, _Mask]:
    """Which corners of each of two triangles are corners of the other, ``(3, k)`` each."""
    one, other = (np.ascontiguousarray(triangles.take(side, axis=0).T) for side in pairs.T)
    same = one[:, None] == other
    return same.any(axis=1), same.any(axis=0)


def _clear(planes: Floats, corners: Sequence[Floats], common: _Mask, touch: float) -> _Mask:
    """Whether a triangle is on one side of a plane and clear of it, but for common corners.

    Planes are ``(k, 4)``, unit normals and what they give in the plane; corners are three of
    ``(k, 3)``, and of them those in `common`, ``(3, k)``, are left out.
    """
    above, below = np.ones(len(planes), dtype=bool), np.ones(len(planes), dtype=bool)
    for corner, is_common in zip(corners, common, strict=True):
        height = dot(corner, planes[:, :3]) - planes[:, 3]
        above &= is_common | (height > touch)
        below &= is_common | (height < -touch)
    return above | below


def _odd_last(corners: Floats, faces: Ints, odd: Ints) -> Floats:
    """Triangles turned so that one corner of each comes last, ``(k, 3, 3)``."""
    order = 3 * faces[:, None] + (odd[:, None] + np.array([1, 2, 0])) % 3
    return np.asarray(corners.reshape(-1, 3).take(order, axis=0))


def _crossing(corners: Floats, triangles: Ints, pairs: Ints, touch: float) -> _Mask:
    """Which pairs of faces are what `crossing_faces` looks for.

    Planes go first: what is clear of the other's needs no other test.
    """
    centred = corners - corners.mean(axis=(0, 1))
    normal = _normal(centred)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), np.finfo(float).tiny)[:, None]
    planes = np.column_stack([normal, dot(normal, centred[:, 0])])
    by_corner = [np.ascontiguousarray(centred[:, n]) for n in range(3)]
    common = _common(triangles, pairs)
    one, other = pairs.T
    views = (one, other, common[0]), (other, one, common[1])
    clear = [
        _clear(planes.take(facing, 0), [c.take(own, 0) for c in by_corner], mine, touch)
        for own, facing, mine in views
    ]
    count = common[0].sum(axis=0)
    crossing: _Mask = count == 3
    at = np.flatnonzero((count == 0) & ~clear[0] & ~clear[1])
    first, second = (corners.take(side.take(at), axis=0) for side in (one, other))
    crossing[at] = _meet(first, second, touch)
    for (own, facing, mine), is_clear in zip(views, clear, strict=True):
        at = np.flatnonzero((count == 1) & ~is_clear)
        far = _odd_last(corners, own.take(at), mine[:, at].argmax(axis=0))[:, :2]
        crossing[at] |= _meet(far, corners.take(facing.take(at), axis=0), touch)
    at = np.flatnonzero(count == 2)
    first, second = (
        _odd_last(corners, own.take(at), mine[:, at].argmin(axis=0)) for own, _, mine in views
    )
    crossing[at] = _folded(first, second[:, 2], touch)
    return crossing


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
        ``(m, 3) int``, three different ones each.
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
    found = [
        pairs[_crossing(corners, triangles, pairs, touch)]
        for pairs in own_box_pairs(low - touch, high + touch)
    ]
    pairs = np.sort(np.concatenate(found), axis=1)
    return np.unique(pairs, axis=0)
