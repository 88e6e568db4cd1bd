"""Triangles of planar facets."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from scadgen.errors import InvariantError
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.vectors import cross

__all__ = ["triangulate"]

#: Outlines of a facet by vertex: counter-clockwise seen from outside, holes clockwise.
Loops = Sequence[Sequence[int]]


def triangulate(points: Floats, facets: Sequence[Loops]) -> list[Ints]:
    """Constrained Delaunay triangles of planar facets; no vertex is added.

    Delaunay triangles, for they leave out the slivers between nearly aligned vertices
    wherever that can be done, and slivers are what turns over when the vertices move.

    Parameters
    ----------
    points
        ``(v, 3) float``.
    facets
        Of each facet its outlines by vertex, counter-clockwise seen from outside, holes
        clockwise.

    Returns
    -------
    triangles
        Of each ``(m, 3) int``, counter-clockwise seen from outside.

    Raises
    ------
    InvariantError
        Outlines cross, or a facet has no area.
    """
    if not facets:
        return []
    sizes = [len(loop) for loops in facets for loop in loops]
    owner = np.repeat(np.arange(len(facets)), [len(loops) for loops in facets])
    vertices = np.fromiter(itertools.chain(*itertools.chain(*facets)), dtype=np.int64)
    ring = np.repeat(np.arange(len(sizes)), sizes)
    flat = _in_plane(points[vertices], ring, owner)
    shells, of = _polygons(np.asarray(shapely.linearrings(flat, indices=ring)), owner)
    valid = shapely.is_valid(shells)
    if not valid.all():
        msg = f"facet outlines do not cross: {shapely.is_valid_reason(shells[~valid][0])}"
        raise InvariantError(msg)
    names = zip(owner[ring].tolist(), *flat.T.tolist(), strict=True)
    vertex = dict(zip(names, vertices.tolist(), strict=True))
    if len(vertex) != len({*zip(owner[ring].tolist(), vertices.tolist(), strict=True)}):
        msg = "facet outlines do not cross: two vertices of one are in one place"
        raise InvariantError(msg)
    pieces, shell = shapely.get_parts(
        shapely.constrained_delaunay_triangles(shells), return_index=True
    )
    corners = shapely.get_coordinates(pieces).reshape(-1, 4, 2)[:, :3]
    (a, b), c = corners[:, :2].swapaxes(0, 1), corners[:, 2]
    ahead = (b - a)[:, 0] * (c - a)[:, 1] > (b - a)[:, 1] * (c - a)[:, 0]
    corners = np.where(ahead[:, None, None], corners, corners[:, ::-1])
    facet = of[shell]
    spots = zip(np.repeat(facet, 3).tolist(), *corners.reshape(-1, 2).T.tolist(), strict=True)
    found = np.array([vertex[spot] for spot in spots], dtype=int).reshape(-1, 3)
    return [found[facet == n] for n in range(len(facets))]


def _in_plane(corners: Floats, ring: Ints, owner: Ints) -> Floats:
    """Corners of rings in their facets' planes, ``(k, 2)``; seen from outside."""
    first = np.searchsorted(ring, np.arange(len(owner)))
    after = np.arange(1, len(ring) + 1)
    after[np.append(first[1:], len(ring)) - 1] = first
    # Newell's formula, from a corner of the facet's own.
    origin = corners[first[np.searchsorted(owner, owner)]][ring]
    spans = cross(corners - origin, corners[after] - origin)
    of = owner[ring]
    total = np.add.reduceat(spans, np.searchsorted(of, np.arange(of[-1] + 1)))
    length = np.linalg.norm(total, axis=1)
    if not length.all():
        msg = "facet with an area: an outline encloses none"
        raise InvariantError(msg)
    normal = total / length[:, None]
    across = cross(np.eye(3)[np.abs(normal).argmin(axis=1)], normal)
    across /= np.linalg.norm(across, axis=1)[:, None]
    plane = np.stack([across, cross(normal, across)], axis=1)
    return np.asarray(np.einsum("kji,ki->kj", plane[of], corners))


def _polygons(rings: NDArray[Any], owner: Ints) -> tuple[NDArray[Any], Ints]:
    """Polygons of rings, with those as holes that are clockwise, and the facet of each."""
    shell = shapely.is_ccw(rings)
    polygons, of = np.asarray(shapely.polygons(rings[shell])), owner[shell]
    for hole, facet in zip(rings[~shell], owner[~shell].tolist(), strict=True):
        point = shapely.Polygon(hole).representative_point()
        around = np.flatnonzero((of == facet) & shapely.contains(polygons, point))
        if len(around) != 1:
            msg = f"facet outlines do not cross: one hole is in {len(around)} outlines"
            raise InvariantError(msg)
        outside = polygons[around[0]]
        polygons[around[0]] = shapely.Polygon(outside.exterior, [*outside.interiors, hole])
    return polygons, of
