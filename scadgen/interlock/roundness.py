"""Which facets stand for one round face, however few they are.

Where facets meet at less than 20 degrees they are taken for round by that alone.  Coarser ones
may as well be drawn flat: a chamfer, a hexagon.  They count as round where they lie on a
common cylinder or cone, side by side and about equally wide, at least eight to a whole turn; or
on a common sphere.

The edges of a facet on a cylinder are parallel, of one on a cone they meet in its tip.  So
facets are followed from edge to edge while that stays the same point, be it far away.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.interlock.facets import Edge, facets_of
from scadgen.solid.affine import Floats, Ints

__all__ = ["round_normals"]

#: Facets in a row at least, and round the tip of a cone.
_ROW, _ROUND_TIP = 3, 7

#: How far edges may be off a common cylinder, cone or sphere, in radii.
_OFF = 2e-3

#: How far the points in which edges meet may differ, in inverse lengths of an edge, and how
#: much wider than the narrowest a facet may be.
_MEET, _WIDER = 0.02, 1.25

#: Sine of the angle up to which edges are parallel; most that is seen where they cross.
_PARALLEL, _AT_ONCE = 1e-4, 1e6

#: How nearly a facet at the end of a row lies on its cylinder or cone, in radii.
_LIKE = 0.01

#: Edges of a facet at most: the flat end of a pin has more.
_EDGES = 12

#: Facets of a sphere at least, and how far their normals spread from a plane.
_ON_SPHERE, _SPREAD = 12, 0.1


class _Strip(NamedTuple):
    """A facet between two of its edges, and where these meet, seen from each of them.

    `seen` is how many of its own lengths fit in the way from an edge's middle to there: 0 where
    they are parallel, 2 where they meet at its end.
    """

    facet: int
    edges: tuple[int, int]
    seen: tuple[float, float]


class _Round(NamedTuple):
    """A round face: its facets, and a point and a unit vector of its axis; none of a sphere."""

    facets: list[int]
    origin: Floats
    axis: Floats | None


def round_normals(points: Floats, triangles: Ints) -> Floats:
    """Normals of the round faces that facets stand for, at the facets' corners.

    Parameters
    ----------
    points
        ``(v, 3) float``; equal points have one number.
    triangles
        ``(m, 3) int``, counter-clockwise from outside.

    Returns
    -------
    normals
        ``(m, 3, 3) float``: unit vectors; NaN where a triangle is of no such face.
    """
    found = np.full((len(triangles), 3, 3), np.nan)
    facet, normals, edges = facets_of(points, triangles)
    if not edges:
        return found
    corners = points[triangles]
    free = np.ones(len(normals), dtype=bool)
    rounds = [*_spheres(corners, facet, normals, edges)]
    rounds += _rings(corners, facet, normals, edges)
    for face in rounds:
        own = [n for n in face.facets if free[n]]
        free[own] = False
        mine = np.flatnonzero(np.isin(facet, own))
        found[mine] = _true_normals(corners[mine], normals[facet[mine]], face)
    return found


def _true_normals(corners: Floats, normals: Floats, face: _Round) -> Floats:
    """A round face's normals at triangles' corners, looking the way that the triangles do."""
    rays = corners - face.origin
    if face.axis is None:
        out, slope = rays, np.zeros(len(rays))
    else:
        out, slope = rays - (rays @ face.axis)[..., None] * face.axis, normals @ face.axis
    out /= np.maximum(np.linalg.norm(out, axis=2), 1e-300)[..., None]
    sign = np.sign((out.mean(axis=1) * normals).sum(axis=1))
    out *= (sign * np.sqrt(np.maximum(1 - slope**2, 0)))[:, None, None]
    return out if face.axis is None else out + (slope[:, None] * face.axis)[:, None]


def _rings(corners: Floats, facet: Ints, normals: Floats, edges: Sequence[Edge]) -> list[_Round]:
    """Cylinders and cones, those of most facets first."""
    strips, at = _strips(edges), defaultdict[int, list[tuple[int, float]]](list)
    for number, strip in enumerate(strips):
        for edge, seen in zip(strip.edges, strip.seen, strict=True):
            at[edge].append((number, seen))
    links = [
        (one, other)
        for here in at.values()
        for (one, seen), (other, too) in combinations(here, 2)
        if strips[one].facet != strips[other].facet and abs(seen - too) < _MEET
    ]
    graph = coo_array(
        (np.ones(len(links)), tuple(np.array(links, dtype=np.int64).reshape(-1, 2).T)),
        shape=(len(strips),) * 2,
    )
    label = connected_components(graph, directed=False)[1]
    groups: dict[int, list[_Strip]] = defaultdict(list)
    for strip, group in zip(strips, label.tolist(), strict=True):
        groups[group].append(strip)
    one_of = corners[np.unique(facet, return_index=True)[1], 0]
    found = [
        _with_ends(ring, one_of, normals, edges)
        for group in groups.values()
        if (ring := _ring(group, edges)) is not None
    ]
    return sorted(found, key=lambda ring: (-len(ring.facets), ring.facets))


def _with_ends(ring: _Round, points: Floats, normals: Floats, edges: Sequence[Edge]) -> _Round:
    """A ring with the facets at its ends, of which something is cut off."""
    axis = np.zeros(3) if ring.axis is None else ring.axis
    height = ((points - ring.origin) * normals).sum(axis=1)
    rim = points - ring.origin - np.outer((points - ring.origin) @ axis, axis)
    own = ring.facets
    size = float(np.linalg.norm(rim[own], axis=1).mean())
    fits = np.abs(normals @ axis - (normals[own] @ axis).mean()) < _LIKE
    fits &= np.abs(height - height[own].mean()) < _LIKE * size
    inside = set(own)
    beside = {
        other
        for edge in edges
        for one, other in (edge.facets, edge.facets[::-1])
        if one in inside and other not in inside and fits[other]
    }
    return ring._replace(facets=sorted(inside | beside))


def _strips(edges: Sequence[Edge]) -> list[_Strip]:
    """Facets between each two of their edges."""
    of_facet: dict[int, list[int]] = defaultdict(list)
    for number, edge in enumerate(edges):
        for facet in edge.facets:
            of_facet[facet].append(number)
    found = []
    for facet, own in sorted(of_facet.items()):
        for one, other in combinations(own, 2) if len(own) <= _EDGES else ():
            if _in_line(edges[one], edges[other]):
                continue
            seen = _seen(edges[one], edges[other]), _seen(edges[other], edges[one])
            found.append(_Strip(facet, (one, other), seen))
    return found


def _in_line(edge: Edge, other: Edge) -> bool:
    """Whether two edges of a facet are pieces of one line."""
    gap = other.middle - edge.middle
    beside = max(float(gap @ gap) - float(gap @ edge.along) ** 2, 0.0)
    turned = 1 - float(other.along @ edge.along) ** 2
    return max(beside / edge.length**2, turned) < _PARALLEL**2


def _seen(edge: Edge, other: Edge) -> float:
    """An edge's length over the way along it from its middle to where another one meets it."""
    across = other.along - (other.along @ edge.along) * edge.along
    gap = other.middle - edge.middle
    beside = gap - (gap @ edge.along) * edge.along
    # Along the edge by gap . along, and on as far as the other line takes to come here.
    slope = float(across @ across)
    far = float(beside @ across)
    on = float(gap @ edge.along) * slope - float(other.along @ edge.along) * far
    if slope < _PARALLEL**2:
        return 0.0
    return edge.length / max(on / slope, edge.length / _AT_ONCE, key=abs)


def _ring(strips: Sequence[_Strip], edges: Sequence[Edge]) -> _Round | None:
    """The cylinder or cone of facets in a row that are about equally wide."""
    used = sorted({edge for strip in strips for edge in strip.edges})
    facets = sorted({strip.facet for strip in strips})
    seen = np.abs([strip.seen for strip in strips]).max()
    if len(facets) < (_ROUND_TIP if seen > 2 - _MEET else _ROW) or len(used) <= _ROW:
        return None
    middles = np.array([edges[n].middle for n in used])
    along = np.array([edges[n].along for n in used])
    along *= np.sign(along @ along[0])[:, None]
    if seen < _MEET:
        axis = along.mean(axis=0) / np.linalg.norm(along.mean(axis=0))
        origin = _circle(middles - np.outer(middles @ axis, axis), axis)
        rays = middles - origin
        rays -= np.outer(rays @ axis, axis)
        off = float(np.ptp(np.linalg.norm(rays, axis=1)))
    else:
        # The point nearest to all lines.
        planes = np.eye(3) - along[:, :, None] * along[:, None]
        origin = np.linalg.lstsq(planes.sum(0), (planes @ middles[:, :, None])[..., 0].sum(0))[0]
        rays = middles - origin
        rays /= np.maximum(np.linalg.norm(rays, axis=1), 1e-300)[:, None]
        axis = np.linalg.svd(rays - rays.mean(axis=0))[2][2]
        off = float(np.ptp(rays @ axis))
    place = {edge: n for n, edge in enumerate(used)}
    widths = [np.linalg.norm(rays[place[a]] - rays[place[b]]) for a, b in (s.edges for s in strips)]
    round_ = off < _OFF * np.linalg.norm(rays, axis=1).mean()
    return _Round(facets, origin, axis) if round_ and max(widths) < _WIDER * min(widths) else None


def _circle(points: Floats, axis: Floats) -> Floats:
    """Centre of the circle that points in a plane across an axis are nearest to."""
    middle = points.mean(axis=0)
    local = points - middle
    system = np.vstack([np.column_stack([2 * local, np.ones(len(local))]), [*axis, 0.0]])
    found = np.linalg.lstsq(system, np.append((local**2).sum(axis=1), 0.0))[0]
    return np.asarray(middle + found[:3])


def _spheres(
    corners: Floats, facet: Ints, normals: Floats, edges: Sequence[Edge]
) -> Iterator[_Round]:
    """Spheres."""
    beside: dict[int, list[int]] = defaultdict(list)
    for edge in edges:
        for one, other in (edge.facets, edge.facets[::-1]):
            beside[one].append(other)
    order = np.argsort(facet, kind="stable")
    starts = np.searchsorted(facet[order], np.arange(len(normals) + 1))
    of_facet = {n: corners[order[starts[n] : starts[n + 1]]].reshape(-1, 3) for n in sorted(beside)}
    tried: set[int] = set()
    for edge in edges:
        if tried.isdisjoint(edge.facets):
            group, centre = _grown(edge.facets, of_facet, beside)
            tried.update(group or edge.facets)
            spread = normals[group] - normals[group].mean(axis=0) if group else np.zeros((1, 3))
            least = np.linalg.svd(spread, compute_uv=False)[-1] / np.sqrt(len(spread))
            if len(group) >= _ON_SPHERE and least > _SPREAD:
                yield _Round(group, centre, None)


def _grown(
    start: Collection[int], corners: Mapping[int, Floats], beside: Mapping[int, Sequence[int]]
) -> tuple[list[int], Floats]:
    """Facets with all corners on the sphere through those of two, from these on; its centre."""
    some = np.concatenate([corners[n] for n in start])
    middle = some.mean(axis=0)
    system = np.column_stack([2 * (some - middle), np.ones(len(some))])
    found, _, rank, _ = np.linalg.lstsq(system, ((some - middle) ** 2).sum(axis=1))
    centre = middle + found[:3]
    radius = float(np.linalg.norm(some - centre, axis=1).mean())

    def is_on(facet: int) -> bool:
        away = np.linalg.norm(corners[facet] - centre, axis=1)
        return bool(np.abs(away - radius).max() < _OFF * radius)

    if rank < 4 or not all(is_on(n) for n in start):
        return [], centre
    group, edge = set(start), [*start]
    while edge:
        new = {n for n in beside[edge.pop()] if n not in group and is_on(n)}
        group |= new
        edge += sorted(new)
    return sorted(group), centre
