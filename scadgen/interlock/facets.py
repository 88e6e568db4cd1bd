"""The flat facets of a mesh, and the edges in which they meet."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.solid.affine import Floats, Ints
from scadgen.solid.mesh import normals as face_normals

Bools = NDArray[np.bool_]

__all__ = ["Bools", "Edge", "bent_faces", "facets_of"]

#: Sine of the angle up to which triangles are one facet.
_PLANE = 1e-3

#: Cosines of the angles, in degrees, at which facets of a round face meet: at most, and at
#: least to have an edge.
_MOST, _LEAST = np.cos(np.radians([45.5, 6.0]))

#: Edges beyond which facets are so fine that what lies beside one is enough.
_MANY = 8_000

#: Length of an edge, as a share of a facet's size, above which the one beside it is its like.
_LONG = 0.2


class Edge(NamedTuple):
    """The line in which two facets meet.

    Parameters
    ----------
    facets
        Their numbers.
    middle, along
        ``(3,) float``: the middle of the longest piece of it, and a unit vector.
    length
        Of that piece.
    """

    facets: tuple[int, int]
    middle: Floats
    along: Floats
    length: float


def facets_of(points: Floats, triangles: Ints) -> tuple[Ints, Floats, list[Edge]]:
    """The facets of a mesh.

    Parameters
    ----------
    points
        ``(v, 3) float``; equal points have one number.
    triangles
        ``(m, 3) int``, counter-clockwise from outside.

    Returns
    -------
    facet, normals, edges
        ``(m,) int``: the facet of each triangle; ``(k, 3) float``: the facets' normals; and the
        edges at which they meet at 6 to 45 degrees, none if there are very many.
    """
    normal = face_normals(points, triangles)
    tail, head = triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    order = np.lexsort((high, low))
    same = (low[order][1:] == low[order][:-1]) & (high[order][1:] == high[order][:-1])
    half = order[:-1][same]
    one, other = half // 3, order[1:][same] // 3
    cosine = (normal[one] * normal[other]).sum(axis=1)
    flat = (np.linalg.norm(np.cross(normal[one], normal[other]), axis=1) < _PLANE) & (cosine > 0)
    graph = coo_array((np.ones(flat.sum()), (one[flat], other[flat])), shape=(len(triangles),) * 2)
    facet = connected_components(graph, directed=False)[1].astype(np.int64)
    _, first = np.unique(facet, return_index=True)
    edge = (cosine > _MOST) & (cosine < _LEAST) & (facet[one] != facet[other])
    if not 0 < edge.sum() <= _MANY:
        return facet, normal[first], []
    starts, ends = points[tail[half[edge]]], points[head[half[edge]]]
    both = np.sort(np.column_stack([facet[one], facet[other]])[edge], axis=1)
    # Two planes meet in one line, however it is cut up: the longest piece stands for it.
    length = np.linalg.norm(ends - starts, axis=1)
    by_length = np.argsort(-length, kind="stable")
    _, where = np.unique(both[by_length], axis=0, return_index=True)
    chosen = by_length[where]
    return (
        facet,
        normal[first],
        [
            Edge((int(a), int(b)), (start + end) / 2, (end - start) / far, float(far))
            for (a, b), start, end, far in zip(
                both[chosen], starts[chosen], ends[chosen], length[chosen], strict=True
            )
        ],
    )


def bent_faces(points: Floats, triangles: Ints) -> Bools:
    """Tell which triangles may be of a round face, as far as can be seen beside them.

    They meet another one at no more than 45 degrees, but not in one plane, along an edge that is
    not short for them.

    Parameters
    ----------
    points, triangles
        As `facets_of` takes them.

    Returns
    -------
    bent
        ``(m,) bool``.
    """
    facet, normals, edges = facets_of(points, triangles)
    corners = points[triangles]
    low, high = np.full((len(normals), 3), np.inf), np.full((len(normals), 3), -np.inf)
    np.minimum.at(low, facet, corners.min(axis=1))
    np.maximum.at(high, facet, corners.max(axis=1))
    size = np.linalg.norm(high - low, axis=1)
    beside = np.zeros(len(normals), dtype=np.bool_)
    long = [n for edge in edges for n in edge.facets if edge.length > _LONG * size[n]]
    beside[long] = True
    return np.asarray(beside[facet])
