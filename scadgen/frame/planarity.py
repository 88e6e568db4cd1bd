"""Where straight edges meet that do not share a vertex."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from scadgen.errors import InputError
from scadgen.solid.affine import Floats, Ints

__all__ = ["TOUCH", "check_planar", "corner", "crossings", "more", "touches", "where"]

#: A vertex nearer than this to an edge that is not its own lies on it, in mm: a thousand
#: times the last decimal kept, a thousandth of what any printer resolves.
TOUCH = 1e-6


def where(point: Floats) -> str:
    """A point as text: ``(12.5, 40)``, in mm."""
    return f"({point[0] + 0.0:.6g}, {point[1] + 0.0:.6g})"


def corner(vertex: int, point: Floats, gaps: Sequence[float]) -> str:
    """A vertex and the angles between its edges, in degrees, as text."""
    return f"vertex {vertex} at {where(point)}, angles {', '.join(f'{gap:.4g}' for gap in gaps)}"


def more(count: int) -> str:
    """What is said after the first of several: `` (and 3 more)``; nothing after a lone one."""
    return f" (and {count - 1} more)" if count > 1 else ""


def touches(vertices: Floats, edges: Ints, within: float) -> Ints:
    """Vertices that lie on an edge that is not theirs.

    Parameters
    ----------
    vertices
        ``(n, 2) float``, in mm.
    edges
        ``(m, 2) int``.
    within
        How near is on it, in mm.

    Returns
    -------
    touches
        ``(k, 2) int``: vertex and edge, ascending.
    """
    found = (
        shapely.STRtree(_lines(vertices, edges))
        .query(shapely.points(vertices), predicate="dwithin", distance=within)
        .T
    )
    return _ascending(found[(edges[found[:, 1]] != found[:, :1]).all(axis=1)])


def crossings(vertices: Floats, edges: Ints) -> Ints:
    """Pairs of edges that meet and share no vertex: ``(k, 2) int``, ascending."""
    lines = _lines(vertices, edges)
    found = shapely.STRtree(lines).query(lines, predicate="intersects").T
    found = found[found[:, 0] < found[:, 1]]
    first, second = edges[found[:, 0]], edges[found[:, 1]]
    shared = (first[:, :, None] == second[:, None, :]).any(axis=(1, 2))
    return _ascending(found[~shared])


def check_planar(vertices: Floats, edges: Ints) -> None:
    """Refuse edges that meet anywhere but at a common vertex.

    Raises
    ------
    InputError
        An edge has no length, two vertices are one, a vertex lies on an edge, or two edges
        cross: which, and where.
    """
    lengths = np.linalg.norm(np.diff(vertices[edges], axis=1)[:, 0], axis=1)
    short = np.flatnonzero(lengths <= TOUCH)
    if len(short):
        first, second = edges[short[0]]
        msg = (
            f"edge {short[0]} from vertex {first} to {second} has no length, at "
            f"{where(vertices[first])}{more(len(short))}"
        )
        raise InputError(msg)
    on = touches(vertices, edges, TOUCH)
    if len(on):
        vertex, edge = on[0]
        apart = np.linalg.norm(vertices[edges[edge]] - vertices[vertex], axis=1)
        what = f"vertex {edges[edge][apart.argmin()]}" if apart.min() <= TOUCH else f"edge {edge}"
        msg = f"vertex {vertex} at {where(vertices[vertex])} lies on {what}{more(len(on))}"
        raise InputError(msg)
    pairs = crossings(vertices, edges)
    if len(pairs):
        first, second = _lines(vertices, edges[pairs[0]])
        point = shapely.get_coordinates(shapely.intersection(first, second))[0]
        msg = (
            f"edges {pairs[0, 0]} and {pairs[0, 1]} cross at "
            f"{where(point)}{more(len(pairs))}: a frame has a vertex there"
        )
        raise InputError(msg)


def _lines(vertices: Floats, edges: Ints) -> NDArray[np.object_]:
    return np.asarray(shapely.linestrings(vertices[edges]), dtype=object)


def _ascending(pairs: Ints) -> Ints:
    return np.asarray(pairs[np.lexsort(pairs.T[::-1])], dtype=np.int64)
