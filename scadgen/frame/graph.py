"""A frame as a value: vertices in mm, the normals of their rings, straight edges between them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.errors import InputError, InvariantError
from scadgen.frame.numbering import Numbering, counted, where
from scadgen.frame.tangent import STRAIGHT_UP, UP, angle_about, seen_along
from scadgen.solid.affine import Floats, Ints

__all__ = ["DECIMALS", "Ends", "Frame"]

#: Decimals of a vertex, in mm; the same as in a part's tables.
DECIMALS = 9


@dataclass(frozen=True, slots=True, eq=False)
class Ends:
    """The ends of all edges, by vertex and counter-clockwise there.

    Parameters
    ----------
    first
        ``(n + 1,) int``: the ends at vertex v are those from ``first[v]`` to before
        ``first[v + 1]``; their numbers there, from 0, are its *slots*.
    edge, neighbour
        ``(2 m,) int``: whose end it is, and the vertex at the other one.
    angle
        ``(2 m,) float``: azimuth of the edge seen along the vertex's normal, in [0, 2 pi).
    slope
        ``(2 m,) float``: how far below the vertex's tangent plane the edge points, in radians.
    gap
        ``(2 m,) float``: angle to the next end at the vertex, counter-clockwise; a full
        turn where there is no other.
    """

    first: Ints
    edge: Ints
    neighbour: Ints
    angle: Floats
    slope: Floats
    gap: Floats


@dataclass(frozen=True, eq=False)
class Frame:
    """A graph in space, drawn with straight edges.

    `Frame.planar` and `Frame.spatial` put vertices and edges in order;
    `scadgen.plane.drawn.make_frame` also checks what somebody may have drawn.

    Parameters
    ----------
    name
        What to call it.
    vertices
        ``(n, 3) float``, in mm, ascending by z, then y, then x, to 9 decimals.
    normals
        ``(n, 3) float``: the axis of each vertex's ring, of length 1.
    edges
        ``(m, 2) int``, each with its lower vertex first, ascending.
    order
        ``(2 m,) int``: the ends of the edges, by vertex and counter-clockwise about its normal
        there; end ``m s + k`` is that of edge k at its first (s = 0) or second (s = 1) vertex.
    numbering
        What vertices and edges are called; None: by their numbers here.  Frames that differ in
        nothing else are equal.
    """

    name: str
    vertices: Floats
    normals: Floats
    edges: Ints
    order: Ints
    numbering: Numbering | None = None

    def __post_init__(self) -> None:
        """Check the order and freeze the arrays."""
        size = len(self.vertices)
        i, j = self.edges.T
        ordered = (np.diff(np.lexsort(self.vertices.T)) == 1).all()
        ascending = (i < j).all() and (np.diff(i * size + j) > 0).all()
        all_ends = np.array_equal(np.sort(self.order), np.arange(2 * len(self.edges)))
        if not (ordered and ascending and all_ends) or (np.diff(self._vertex_of_ends) < 0).any():
            msg = f"frame {self.name}: not in canonical order"
            raise InvariantError(msg)
        for array in (self.vertices, self.normals, self.edges, self.order):
            array.setflags(write=False)

    @classmethod
    def planar(
        cls, name: str, vertices: ArrayLike, edges: ArrayLike, numbering: Numbering | None = None
    ) -> Self:
        """A frame in the plane z = 0, with normals up.

        Parameters
        ----------
        name
            What to call it.
        vertices
            ``(n, 2) float``, in mm.
        edges
            ``(m, 2) int``: the two vertices of each edge; vertices are put in order.
        numbering
            What these vertices and edges are called.
        """
        points = np.pad(np.asarray(vertices, dtype=float), ((0, 0), (0, 1)))
        return cls.spatial(name, points, np.tile(UP, (len(points), 1)), edges, numbering)

    @classmethod
    def spatial(
        cls,
        name: str,
        vertices: ArrayLike,
        normals: ArrayLike,
        edges: ArrayLike,
        numbering: Numbering | None = None,
    ) -> Self:
        """A frame in space; its vertices and edges are put in order.

        Parameters
        ----------
        name
            What to call it.
        vertices
            ``(n, 3) float``, in mm.
        normals
            ``(n, 3) float``: the axis of each vertex's ring, of any length but 0.
        edges
            ``(m, 2) int``: the two vertices of each edge.
        numbering
            What these vertices and edges are called.

        Raises
        ------
        InputError
            Normals of another shape or without a direction, or an edge along one.
        """
        points = np.asarray(vertices, dtype=float).round(DECIMALS) + 0.0
        axes = _unit_normals(np.asarray(normals, dtype=float), points)
        rank = np.lexsort(points.T)
        pairs = np.sort(np.argsort(rank)[np.asarray(edges, dtype=np.int64)], axis=1)
        of_edges = np.lexsort(pairs.T[::-1])
        pairs, numbers = pairs[of_edges], numbering and numbering.sorted(rank, of_edges)
        points, axes = points[rank], axes[rank]
        vertex, neighbour = pairs.T.ravel(), pairs[:, ::-1].T.ravel()
        azimuth, _ = seen_along(axes[vertex], points[neighbour] - points[vertex])
        _check_azimuths(azimuth, vertex, points)
        return cls(name, points, axes, pairs, np.lexsort((azimuth, vertex)), numbers)

    def __eq__(self, other: object) -> bool:
        """Whether name, vertices, normals, edges and their order are the same."""
        return isinstance(other, Frame) and self._key == other._key

    def __hash__(self) -> int:
        """Equal frames have equal hashes."""
        return hash(self._key)

    @property
    def _key(self) -> tuple[str, bytes, bytes, bytes, bytes]:
        arrays = (self.vertices, self.normals, self.edges, self.order)
        first, second, third, fourth = (array.tobytes() for array in arrays)
        return self.name, first, second, third, fourth

    @property
    def _vertex_of_ends(self) -> Ints:
        """``(2 m,) int``: the vertex of each end, in their order."""
        return np.asarray(self.edges.T.ravel()[self.order])

    @cached_property
    def is_plane(self) -> bool:
        """Whether all vertices lie at z = 0 with their normals up."""
        return not self.vertices[:, 2].any() and bool((self.normals == UP).all())

    @property
    def plan(self) -> Floats:
        """``(n, 2) float``: the vertices of a plane frame, in mm.

        Raises
        ------
        InputError
            The frame is not plane.
        """
        if not self.is_plane:
            high = np.abs(self.vertices[:, 2]).max()
            why = f"vertices reach {high:.4g} mm from z = 0" if high else "normals lean"
            msg = f"frame {self.name} is not plane: its {why}; must lie in z = 0, with normals +z"
            raise InputError(msg)
        return self.vertices[:, :2]

    @property
    def places(self) -> Floats:
        """``(n, 2) float`` in the plane, else ``(n, 3)``: the vertices as messages give them."""
        return self.plan if self.is_plane else self.vertices

    @cached_property
    def called(self) -> Numbering:
        """What vertices and edges are called."""
        return self.numbering or counted(len(self.vertices), len(self.edges))

    def called_vertex(self, vertex: int) -> str:
        """What a vertex is called, and where it is: ``vertex 3 at (0, 80)``."""
        return self.called.vertex(vertex, self.places[vertex])

    def called_edge(self, edge: int) -> str:
        """What an edge is called, and where it goes from and to."""
        ends = self.edges[edge]
        return self.called.edge(edge, ends, self.places[ends])

    @cached_property
    def degree(self) -> Ints:
        """``(n,) int``: number of edges at each vertex."""
        return np.bincount(self.edges.ravel(), minlength=len(self.vertices)).astype(np.int64)

    @cached_property
    def lengths(self) -> Floats:
        """``(m,) float``: length of each edge, in mm."""
        return np.asarray(np.linalg.norm(np.diff(self.vertices[self.edges], axis=1)[:, 0], axis=1))

    @cached_property
    def twists(self) -> Floats:
        """``(m,) float``: angle about each edge from one end's normal to the other's, in radians.

        Right-handed, and the same from either end; -pi to pi.
        """
        first, second = self.edges.T
        along = (self.vertices[second] - self.vertices[first]) / self.lengths[:, None]
        return angle_about(along, self.normals[first], self.normals[second])

    @cached_property
    def ends(self) -> Ends:
        """The ends of the edges, by vertex and direction."""
        count = len(self.edges)
        edge, vertex = self.order % count, self._vertex_of_ends
        neighbour = self.edges[:, ::-1].T.ravel()[self.order]
        azimuth, slope = seen_along(
            self.normals[vertex], self.vertices[neighbour] - self.vertices[vertex]
        )
        first = np.concatenate([[0], np.cumsum(self.degree)])
        gap = np.empty_like(azimuth)
        gap[:-1] = np.diff(azimuth)
        last = first[1:] - 1
        gap[last] = azimuth[first[:-1]] - azimuth[last] + 2 * np.pi
        return Ends(first, edge, neighbour, azimuth, slope, gap)

    @cached_property
    def slots(self) -> Ints:
        """``(m, 2) int``: the slot of each edge at its two vertices."""
        side, edge = np.divmod(self.order, len(self.edges))
        slots = np.empty_like(self.edges)
        slots[edge, side] = np.arange(len(self.order)) - self.ends.first[self._vertex_of_ends]
        return slots

    def directions(self, vertex: int) -> Floats:
        """Azimuths of the edges at a vertex, counter-clockwise, in [0, 2 pi)."""
        return self.ends.angle[self.ends.first[vertex] : self.ends.first[vertex + 1]]

    def slopes(self, vertex: int) -> Floats:
        """How far below the tangent plane each edge at a vertex points, in radians, by slot."""
        return self.ends.slope[self.ends.first[vertex] : self.ends.first[vertex + 1]]

    def gaps(self, vertex: int) -> Floats:
        """Angle from each edge at a vertex to the next, counter-clockwise."""
        return self.ends.gap[self.ends.first[vertex] : self.ends.first[vertex + 1]]

    @cached_property
    def components(self) -> Ints:
        """``(n,) int``: which connected part each vertex is in, the first vertex in part 0."""
        size = len(self.vertices)
        graph = coo_array((np.ones(len(self.edges)), self.edges.T), shape=(size, size))
        labels = connected_components(graph, directed=False)[1]
        _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
        return np.asarray(np.argsort(np.argsort(first))[inverse], dtype=np.int64)

    @property
    def bounds(self) -> Floats:
        """``(2, 2) float`` in the plane, else ``(2, 3)``: corners of its bounding box, in mm."""
        return np.stack([self.places.min(axis=0), self.places.max(axis=0)])


def _unit_normals(normals: Floats, points: Floats) -> Floats:
    """Normals of length 1.

    Raises
    ------
    InputError
        There is not one for each vertex, or it has no direction.
    """
    if points.ndim != 2 or points.shape[1] != 3 or normals.shape != points.shape:
        msg = (
            f"vertices of shape {points.shape} with normals of shape {normals.shape}: "
            "must both be (n, 3), an x, a y and a z each"
        )
        raise InputError(msg)
    lengths = np.linalg.norm(normals, axis=1)
    bad = np.flatnonzero(~(np.isfinite(lengths) & (lengths > 0)))
    if len(bad):
        msg = f"normal at {where(points[bad[0]])}, {where(normals[bad[0]])}: must have a direction"
        raise InputError(msg)
    return np.asarray(normals / lengths[:, None])


def _check_azimuths(azimuth: Floats, vertex: Ints, points: Floats) -> None:
    bad = np.flatnonzero(np.isnan(azimuth))
    if len(bad):
        msg = (
            f"an edge at {where(points[vertex[bad[0]]])} runs along the normal there: must be more "
            f"than {np.degrees(STRAIGHT_UP):.2g} degrees off it"
        )
        raise InputError(msg)
