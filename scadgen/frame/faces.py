"""The faces that edges go around, and which vertices are at the rim."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.frame.graph import Frame
from scadgen.solid.affine import Ints

__all__ = ["at_rim", "faces"]


def faces(frame: Frame) -> Ints:
    """``(2 m,) int``: the face on the left of each end's edge, seen from its vertex."""
    ends = frame.ends
    count = len(ends.edge)
    pairs = np.argsort(ends.edge, kind="stable").reshape(-1, 2)
    twin = np.empty(count, dtype=np.int64)
    twin[pairs] = pairs[:, ::-1]
    # The way around a face on the left: from where an edge arrives to the end before it there.
    start = ends.first[ends.neighbour]
    after = start + (twin - start - 1) % frame.degree[ends.neighbour]
    around = coo_array((np.ones(count), (np.arange(count), after)), shape=(count, count))
    return np.asarray(connected_components(around, directed=False)[1], dtype=np.int64)


def at_rim(frame: Frame) -> NDArray[np.bool_]:
    """``(n,) bool``: which vertices are on the outline of the frame, or of a component of it.

    Edges go around the outer face of a component the other way, as normals see it, so that its
    area is negative; in a tree it is the only one.  A closed surface has none.
    """
    face = faces(frame)
    count = int(face.max()) + 1
    vertex = np.repeat(np.arange(len(frame.vertices)), frame.degree)
    # From a corner of its own, for far from the origin small areas would drown in rounding.
    corner = np.zeros(count, dtype=np.int64)
    corner[face] = vertex
    origin = frame.vertices[corner][face]
    first, second = (frame.vertices[v] - origin for v in (vertex, frame.ends.neighbour))
    sides = np.cross(first, second)
    area = np.stack([np.bincount(face, side, count) for side in sides.T], axis=1)
    up = np.stack([np.bincount(face, n, count) for n in frame.normals[vertex].T], axis=1)
    component = np.zeros(count, dtype=np.int64)
    component[face] = frame.components[vertex]
    lone = np.bincount(component)[component] == 1
    outer = lone | ((area * up).sum(axis=1) < 0)
    found = np.zeros(len(frame.vertices), dtype=bool)
    found[vertex[outer[face]]] = True
    return found
