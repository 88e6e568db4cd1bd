"""Triangles of planar facets."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from scadgen.errors import InvariantError
from scadgen.solid.affine import Floats, Ints

__all__ = ["normal_of_loops", "triangulate"]


def normal_of_loops(points: Floats, loops: Sequence[Sequence[int]]) -> Floats:
    """Unit normal of a planar facet, by Newell's formula.

    Parameters
    ----------
    points
        ``(v, 3) float``.
    loops
        Outlines, counter-clockwise seen from outside, holes clockwise.

    Returns
    -------
    normal
        ``(3,) float``.
    """
    total = np.zeros(3)
    for loop in loops:
        corners = points[list(loop)] - points[loop[0]]
        total += np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    length = float(np.linalg.norm(total))
    if length == 0.0:
        msg = "facet with an area: an outline encloses none"
        raise InvariantError(msg)
    return np.asarray(total / length)


def triangulate(points: Floats, loops: Sequence[Sequence[int]]) -> Ints:
    """Constrained Delaunay triangles of a planar facet; no vertex is added.

    Delaunay triangles, for they leave out the slivers between nearly aligned vertices
    wherever that can be done, and slivers are what turns over when the vertices move.

    Parameters
    ----------
    points
        ``(v, 3) float``.
    loops
        Outlines of the facet by vertex, counter-clockwise seen from outside, holes
        clockwise.

    Returns
    -------
    triangles
        ``(m, 3) int``, counter-clockwise seen from outside.

    Raises
    ------
    InvariantError
        The outlines cross.
    """
    normal = normal_of_loops(points, loops)
    across = np.cross(np.eye(3)[np.argmin(np.abs(normal))], normal)
    across /= np.linalg.norm(across)
    plane = np.stack([across, np.cross(normal, across)], axis=1)
    flat = {
        v: (x, y)
        for loop in loops
        for v, (x, y) in zip(loop, (points[list(loop)] @ plane).tolist(), strict=True)
    }
    vertex = {place: v for v, place in flat.items()}
    rings = [shapely.Polygon([flat[v] for v in loop]) for loop in loops]
    holes = [ring for ring in rings if not shapely.is_ccw(ring.exterior)]
    found: list[list[int]] = []
    for shell in rings:
        if not shapely.is_ccw(shell.exterior):
            continue
        inside = [h.exterior for h in holes if shell.contains(h.representative_point())]
        facet = shapely.Polygon(shell.exterior, inside)
        if not facet.is_valid or len(vertex) != len(flat):
            msg = f"facet outlines do not cross: {shapely.is_valid_reason(facet)}"
            raise InvariantError(msg)
        pieces = shapely.get_parts(shapely.constrained_delaunay_triangles(facet))
        corners = shapely.get_coordinates(shapely.orient_polygons(pieces)).reshape(-1, 4, 2)
        found += [[vertex[x, y] for x, y in three] for three in corners[:, :3].tolist()]
    return np.array(found, dtype=int).reshape(-1, 3)
