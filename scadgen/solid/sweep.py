"""Proof that a mesh stays embedded while its vertices move on straight lines.

The mesh is X(t) = A + t B, t from 0 to 1, and X(0) is a solid without faults.  Faces of
a mesh cannot begin to cross without one of these happening first:

(a) a face loses its area and turns over;
(b) a vertex comes to lie in a face that it does not belong to;
(c) two edges without a common vertex come to meet.

(a) is a condition on a quadratic.  (b) and (c) happen only where four points come into
one plane, at a root of a cubic; the roots are found for all pairs of features at once.

Four points that are in one plane for *all* t make a cubic that vanishes, and are left
out.  Nothing is lost.  If both features belong to one flat area of the surface, they
can touch only after one of its faces turned over, which (a) finds, or after its outline
touched itself.  An edge of an outline, be it of this area or of another one in the same
plane, bears a second face outside of the plane, and with *that* face the touching
vertex makes a cubic that does not vanish.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats, Ints
from scadgen.solid.crossing import box_pairs, own_box_pairs
from scadgen.solid.cubic import may_vanish, roots
from scadgen.solid.vectors import cross, dot

__all__ = ["INSIDE", "PLANE", "SAFE_MARGIN", "TURN", "Fault", "first_fault", "safe_share"]

#: A face turns over where its normal, along the one it had, falls to this share.  A tube
#: may be shortened to a hundredth; a millionth of a face's area is no face any more.
TURN = 1e-6

#: Four points within this share of the diagonal of one plane, at all t, count as staying
#: in it.  Rounding makes up about 1e-15 of it.
PLANE = 1e-11

#: A vertex this share of the diagonal outside of a face's outline counts as inside, as
#: the root of a grazing contact is exact to about 1e-8 only.  Errs towards a fault.
INSIDE = 1e-8

#: Share of the whole way that `safe_share` stays ahead of the first fault.
SAFE_MARGIN = 1e-3

#: Edges at a smaller angle, in radians, count as parallel; where such edges meet, a
#: vertex of one lies on the other and so in its faces.
_PARALLEL = 1e-9


@dataclass(frozen=True, slots=True)
class Fault:
    """Where a moving mesh first stops being embedded.

    Parameters
    ----------
    t
        The share of the way, 0 to 1.
    kind
        ``face turns over`` or ``faces touch``.
    features
        The vertex numbers of the face that turns; or of the vertex and the face, or of
        the two edges, that touch.
    """

    t: float
    kind: str
    features: tuple[tuple[int, ...], ...]

    def __str__(self) -> str:
        """One line for a person."""
        named = " and ".join("-".join(map(str, feature)) for feature in self.features)
        return f"{self.kind} at t = {self.t:.6f}: {named}"


@dataclass(frozen=True, slots=True)
class _Motion:
    """Start and way of every vertex, and the lengths that stand for nothing."""

    start: Floats
    way: Floats
    plane: float
    inside: float

    def at(self, vertices: Ints, t: Floats) -> Floats:
        """Where the vertices ``(k, j)`` are at the times ``(k,)``, as ``(k, j, 3)``."""
        return self.start.take(vertices, 0) + t[:, None, None] * self.way.take(vertices, 0)

    def boxes(self, features: Ints) -> tuple[Floats, Floats]:
        """Boxes ``(k, 2, 3)`` of features ``(k, j)`` at t = 0 and 1, padded.

        The lowest corner moves on a concave curve and the highest on a convex one, so
        boxes that one direction separates in the same sense at both ends stay apart.
        """
        ends = np.stack([self.start, self.start + self.way], axis=1).take(features, axis=0)
        return ends.min(axis=1) - self.inside, ends.max(axis=1) + self.inside


def _moving_cross(a: tuple[Floats, Floats], b: tuple[Floats, Floats]) -> list[Floats]:
    """Coefficients in t of ``(a0 + a1 t) x (b0 + b1 t)``."""
    return [
        cross(a[0], b[0]),
        cross(a[0], b[1]) + cross(a[1], b[0]),
        cross(a[1], b[1]),
    ]


def _moving_dot(d: tuple[Floats, Floats], n: list[Floats]) -> Floats:
    """Coefficients ``(k, 4)`` in t of ``(d0 + d1 t) . (n0 + n1 t + n2 t^2)``."""
    low = [dot(d[0], x) for x in n]
    high = [dot(d[1], x) for x in n]
    return np.column_stack([low[0], low[1] + high[0], low[2] + high[1], high[2]])


def _between(motion: _Motion, tail: Ints, head: Ints) -> tuple[Floats, Floats]:
    start, way = motion.start, motion.way
    return (
        start.take(head, axis=0) - start.take(tail, axis=0),
        way.take(head, axis=0) - way.take(tail, axis=0),
    )


def _moving_normals(motion: _Motion, triangles: Ints) -> list[Floats]:
    a, b, c = triangles.T
    return _moving_cross(_between(motion, a, b), _between(motion, a, c))


def _first_turn(motion: _Motion, triangles: Ints) -> Fault | None:
    """Find the first face whose normal falls below `TURN` of what it was."""
    n0, n1, n2 = _moving_normals(motion, triangles)
    square = dot(n0, n0)
    c0, c1, c2 = (1 - TURN) * square, dot(n0, n1), dot(n0, n2)
    # The smallest positive root, in the form that keeps its digits where c2 is small.
    disc = c1 * c1 - 4 * c0 * c2
    below = np.sqrt(np.maximum(disc, 0)) - c1
    falls = (disc >= 0) & (below > 0)
    t = np.divide(2 * c0, below, out=np.full(len(c0), np.inf), where=falls)
    t[square == 0] = 0.0
    face = int(np.argmin(t))
    if t[face] > 1:
        return None
    return Fault(float(t[face]), "face turns over", (tuple(map(int, triangles[face])),))


def _in_face(motion: _Motion, quads: Ints, t: Floats) -> NDArray[np.bool_]:
    """Whether the vertex ``quads[:, 0]``, in the face's plane, lies in the face."""
    spot = motion.at(quads, t)
    vertex, corners = spot[:, 0], spot[:, 1:]
    edges = np.roll(corners, -1, axis=1) - corners
    normal = cross(edges[:, 0], edges[:, 1])
    within = np.ones(len(t), dtype=bool)
    for k in range(3):
        inwards = cross(normal, edges[:, k])
        reach = motion.inside * np.linalg.norm(inwards, axis=1)
        within &= dot(inwards, vertex - corners[:, k]) >= -reach
    return within


def _edges_meet(motion: _Motion, quads: Ints, t: Floats) -> NDArray[np.bool_]:
    """Whether the edges ``quads[:, :2]`` and ``quads[:, 2:]``, in one plane, meet."""
    spot = motion.at(quads, t)
    one, other = spot[:, 1] - spot[:, 0], spot[:, 3] - spot[:, 2]
    normal = cross(one, other)
    square = dot(normal, normal)
    long_one, long_other = np.linalg.norm(one, axis=1), np.linalg.norm(other, axis=1)
    meet: NDArray[np.bool_] = square > (_PARALLEL * long_one * long_other) ** 2
    offset = spot[:, 2] - spot[:, 0]
    for edge, length in ((other, long_one), (one, long_other)):
        along = dot(cross(offset, edge), normal)
        slack = motion.inside * square / np.maximum(length, np.finfo(float).tiny)
        meet &= (along >= -slack) & (along <= square + slack)
    return meet


def _edges(triangles: Ints, facets: Ints) -> tuple[Ints, Ints]:
    """Edges ``(e, 2)`` of a closed mesh, and the facets ``(e, 2)`` on their two sides."""
    ends = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    count = int(triangles.max()) + 1
    numbers, where = np.unique(ends @ [count, 1], return_inverse=True)
    edges = np.column_stack(np.divmod(numbers, count))
    order = np.argsort(where, kind="stable")
    ordered = where[order]
    first = np.searchsorted(ordered, np.arange(len(edges)))
    last = np.searchsorted(ordered, np.arange(len(edges)), side="right") - 1
    sides = np.tile(facets, 3)[order]
    return edges, np.column_stack([sides[first], sides[last]])


#: The four vertices of a pair of features, the coefficients of its cubic, and the value
#: below which that counts as zero.
_Cubics = tuple[Ints, Floats, Floats]


def _vertex_face(motion: _Motion, triangles: Ints, facets: Ints) -> Iterator[_Cubics]:
    vertices = np.unique(triangles)
    normals = _moving_normals(motion, triangles)
    scale = motion.plane * sum(np.linalg.norm(n, axis=1) for n in normals)
    flat_areas = int(facets.max()) + 1
    at_facet = np.unique(triangles * flat_areas + facets[:, None])
    boxes = motion.boxes(vertices[:, None]), motion.boxes(triangles)
    for pairs in box_pairs(*boxes[0], *boxes[1]):
        vertex, face = vertices[pairs[:, 0]], pairs[:, 1]
        foreign = (triangles.take(face, axis=0) != vertex[:, None]).all(axis=1)
        place = np.searchsorted(at_facet, own := vertex * flat_areas + facets[face])
        foreign &= at_facet[np.minimum(place, len(at_facet) - 1)] != own
        vertex, face = vertex[foreign], face[foreign]
        way = _between(motion, triangles[face, 0], vertex)
        cubic = _moving_dot(way, [n.take(face, axis=0) for n in normals])
        yield np.column_stack([vertex, triangles[face]]), cubic, scale[face]


def _edge_edge(motion: _Motion, triangles: Ints, facets: Ints) -> Iterator[_Cubics]:
    edges, sides = _edges(triangles, facets)
    start, way = _between(motion, *edges.T)
    length = np.maximum(np.linalg.norm(start, axis=1), np.linalg.norm(start + way, axis=1))
    for pairs in own_box_pairs(*motion.boxes(edges)):
        foreign = np.ones(len(pairs), dtype=bool)
        for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
            one, other = pairs[:, 0], pairs[:, 1]
            foreign &= edges[one, i] != edges[other, j]
            foreign &= sides[one, i] != sides[other, j]
        one, other = pairs[foreign].T
        first, second = ((start.take(n, 0), way.take(n, 0)) for n in (one, other))
        normal = _moving_cross(first, second)
        cubic = _moving_dot(_between(motion, edges[one, 0], edges[other, 0]), normal)
        tolerance = motion.plane * length[one] * length[other]
        yield np.column_stack([edges[one], edges[other]]), cubic, tolerance


def _first_contact(
    motion: _Motion, cubics: Iterator[_Cubics], split: int, latest: float
) -> Fault | None:
    """Find the first time, up to `latest`, at which a pair of features meets."""
    meet = _in_face if split == 1 else _edges_meet
    best: Fault | None = None
    for quads, cubic, tolerance in cubics:
        may = np.flatnonzero(may_vanish(cubic, tolerance))
        if not len(may):
            continue
        which, t = roots(cubic[may], tolerance[may])
        early = t <= latest
        at, t = quads[may][which[early]], t[early]
        met = meet(motion, at, t)
        if not met.any():
            continue
        at, t = at[met], t[met]
        first = np.lexsort((*at.T[::-1], t))[0]
        names = tuple(int(v) for v in at[first])
        fault = Fault(float(t[first]), "faces touch", (names[:split], names[split:]))
        if best is None or (fault.t, fault.features) < (best.t, best.features):
            best, latest = fault, fault.t
    return best


def first_fault(
    start: Floats, way: Floats, triangles: Ints, facets: Ints | None = None
) -> Fault | None:
    """Where the mesh ``start + t * way`` first stops being embedded, t from 0 to 1.

    Parameters
    ----------
    start
        ``(v, 3) float``, mm: a solid without faults, as `solid_faults` tells.
    way
        ``(v, 3) float``, mm: how far each vertex moves.
    triangles
        ``(m, 3) int``.
    facets
        ``(m,) int``: triangles with the same number stay in one plane all the way.
        Without it every triangle is a facet of its own; the answer is the same up to
        rounding.

    Returns
    -------
    fault
        The earliest, or None if the mesh stays embedded.  A face whose normal turns by
        a right angle or more counts as turned over, though it might be turning with
        the whole part.
    """
    if not len(triangles):
        return None
    facets = (
        np.arange(len(triangles)) if facets is None else np.unique(facets, return_inverse=True)[1]
    )
    used = (x.take(triangles, axis=0) for x in (start, start + way))
    size = max(float(np.linalg.norm(np.ptp(corners, axis=(0, 1)))) for corners in used)
    motion = _Motion(start, way, PLANE * size, INSIDE * size)
    faults = [_first_turn(motion, triangles)]
    latest = faults[0].t if faults[0] else 1.0
    for split, cubics in ((1, _vertex_face), (2, _edge_edge)):
        fault = _first_contact(motion, cubics(motion, triangles, facets), split, latest)
        if fault is not None:
            faults.append(fault)
            latest = fault.t
    return min((f for f in faults if f), key=lambda f: f.t, default=None)


def safe_share(start: Floats, way: Floats, triangles: Ints, facets: Ints | None = None) -> float:
    """How far along its way the mesh surely stays embedded.

    Parameters
    ----------
    start, way, triangles, facets
        As for `first_fault`.

    Returns
    -------
    share
        1.0 without a fault, else the first fault's t less `SAFE_MARGIN`; at least 0.
    """
    fault = first_fault(start, way, triangles, facets)
    return 1.0 if fault is None else max(0.0, fault.t - SAFE_MARGIN)
