"""Where straight edges meet that do not share a vertex."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

import numpy as np
import shapely
from numpy.typing import NDArray

from scadgen.errors import InputError
from scadgen.frame.numbering import Numbering, where
from scadgen.frame.words import more
from scadgen.solid.affine import Floats, Ints

__all__ = ["COUNTED", "TOUCH", "check_planar", "crossings", "touches"]

#: Of faults that are refused, this many are counted; what is beyond takes time and says no more.
COUNTED = 1000

#: Pairs looked at in one go, about: some 200 MB.
_AT_ONCE = 1_000_000

#: What a cross product may be off by rounding, as a share of its two terms: three halves of the
#: unit in the last place, and a little more.
_ROUNDING = 4e-16

_Bools = NDArray[np.bool_]

#: A vertex nearer than this to an edge that is not its own lies on it, in mm: a thousand
#: times the last decimal kept, a thousandth of what any printer resolves.
TOUCH = 1e-6


def touches(vertices: Floats, edges: Ints, within: float, most: int) -> Ints:
    """Vertices that lie on an edge that is not theirs.

    Parameters
    ----------
    vertices
        ``(n, 2) float``, in mm.
    edges
        ``(m, 2) int``.
    within
        How near is on it, in mm.
    most
        How many to look for.

    Returns
    -------
    touches
        ``(k, 2) int``: vertex and edge, ascending; the first ``most + 1`` if there are more.
    """
    ends = vertices[edges]

    def near(pairs: Ints) -> _Bools:
        vertex, edge = pairs.T
        start, end = ends[edge].transpose(1, 0, 2)
        along, to = end - start, vertices[vertex] - start
        square = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
        share = np.clip((to * along).sum(axis=1) / square, 0, 1)
        off = np.linalg.norm(to - share[:, None] * along, axis=1)
        return np.asarray((off <= within) & (edges[edge] != pairs[:, :1]).all(axis=1))

    around = np.stack([vertices - within, vertices + within], axis=1)
    return _first(around, ends, near, most)


def crossings(vertices: Floats, edges: Ints, most: int) -> Ints:
    """Pairs of edges that meet and share no vertex.

    Parameters
    ----------
    vertices
        ``(n, 2) float``, in mm.
    edges
        ``(m, 2) int``.
    most
        How many to look for.

    Returns
    -------
    crossings
        ``(k, 2) int``, ascending; the first ``most + 1`` if there are more.
    """
    ends = vertices[edges]

    def meet(pairs: Ints) -> _Bools:
        first, second = pairs.T
        kept = (first < second) & (edges[first][:, :, None] != edges[second][:, None]).all((1, 2))
        # Most pairs are apart beyond all doubt, which is found in a tenth of the time.
        one, other = ends[first[kept]], ends[second[kept]]
        kept[kept] = ~(_on_one_side(one, other) | _on_one_side(other, one))
        one, other = ends[first[kept]], ends[second[kept]]
        kept[kept] = shapely.intersects(_lines(one), _lines(other))
        return np.asarray(kept)

    return _first(ends, ends, meet, most)


def check_planar(vertices: Floats, edges: Ints, numbering: Numbering) -> None:
    """Refuse edges that meet anywhere but at a common vertex.

    Parameters
    ----------
    vertices
        ``(n, 2) float``.
    edges
        ``(m, 2) int``.
    numbering
        What they are called.

    Raises
    ------
    InputError
        An edge has no length, two vertices are one, a vertex lies on an edge, or two edges
        cross: which, and where.
    """
    lengths = np.linalg.norm(np.diff(vertices[edges], axis=1)[:, 0], axis=1)
    short = np.flatnonzero(lengths <= TOUCH)
    if len(short):
        ends = edges[short[0]]
        msg = f"{numbering.edge(short[0], ends, vertices[ends])} has no length{more(len(short))}"
        raise InputError(msg)
    on = touches(vertices, edges, TOUCH, COUNTED)
    if len(on):
        vertex, edge = on[0]
        apart = np.linalg.norm(vertices[edges[edge]] - vertices[vertex], axis=1)
        ends = edges[edge]
        nearest = ends[apart.argmin()]
        what = (
            numbering.vertex(nearest, vertices[nearest])
            if apart.min() <= TOUCH
            else numbering.short(edge, ends, vertices[ends])
        )
        called = numbering.vertex(vertex, vertices[vertex])
        msg = f"{called} lies on {what}{more(len(on), COUNTED)}"
        raise InputError(msg)
    pairs = crossings(vertices, edges, COUNTED)
    if len(pairs):
        first, second = _lines(vertices[edges[pairs[0]]])
        point = shapely.get_coordinates(shapely.intersection(first, second))[0]
        called = " and ".join(
            numbering.short(edge, edges[edge], vertices[edges[edge]]) for edge in pairs[0]
        )
        msg = (
            f"{called} cross at {where(point)}{more(len(pairs), COUNTED)}: a frame has a vertex "
            "there"
        )
        raise InputError(msg)


def _lines(ends: Floats) -> NDArray[np.object_]:
    return np.asarray(shapely.linestrings(ends), dtype=object)


def _on_one_side(segments: Floats, lines: Floats) -> _Bools:
    """Which segments have both ends on the same side of a line, whatever is rounded."""
    start, along = lines[:, :1], np.diff(lines, axis=1)
    to = segments - start
    plus, minus = along[..., 0] * to[..., 1], along[..., 1] * to[..., 0]
    sure = np.abs(plus - minus) > _ROUNDING * (np.abs(plus) + np.abs(minus))
    left = plus > minus
    return np.asarray(sure.all(axis=1) & (left[:, 0] == left[:, 1]))


def _first(boxes: Floats, others: Floats, keep: Callable[[Ints], _Bools], most: int) -> Ints:
    """Pairs of boxes that meet and are to be kept, ascending: the first ``most + 1`` at most.

    Boxes are ``(k, 2, 2) float``, two opposite corners of each.
    """
    tree, shapes = shapely.STRtree(_lines(others)), _lines(boxes)
    found, left = [np.zeros((0, 2), dtype=np.int64)], most + 1
    for start, stop in _ranges(boxes, others):
        pairs = tree.query(shapes[start:stop]).T + np.array([start, 0])
        pairs = pairs[keep(pairs)]
        found.append(pairs[np.lexsort(pairs.T[::-1])][:left])
        left -= len(found[-1])
        if not left:
            break
    return np.concatenate(found)


def _ranges(boxes: Floats, others: Floats) -> Iterator[tuple[int, int]]:
    """Ranges of boxes that together meet no more others than can be looked at in one go.

    A box meets at most those that it meets in x, or in y, which are easily counted.
    """
    low, high = boxes.min(axis=1), boxes.max(axis=1)
    starts, ends = np.sort(others.min(axis=1), axis=0), np.sort(others.max(axis=1), axis=0)
    count = [
        np.searchsorted(starts[:, k], high[:, k], "right") - np.searchsorted(ends[:, k], low[:, k])
        for k in (0, 1)
    ]
    share = np.cumsum(np.minimum(*count)) // _AT_ONCE
    edges = [0, *(np.flatnonzero(np.diff(share)) + 1).tolist(), len(boxes)]
    yield from itertools.pairwise(edges)
