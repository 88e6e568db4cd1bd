"""A planar frame as a value: vertices in mm and the straight edges between them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.errors import InputError, InvariantError
from scadgen.frame.numbering import Numbering, counted, where
from scadgen.frame.planarity import check_planar
from scadgen.solid.affine import Floats, Ints

__all__ = ["LARGEST", "Ends", "Frame", "canonical_order", "make_frame", "vertex_pairs"]

#: Coordinates go up to this, in mm: a kilometre, where 9 decimals are still kept.
LARGEST = 1e6

#: Decimals of a vertex, in mm; the same as in a part's tables.
_DECIMALS = 9

#: A direction this little short of a full turn is 0, in radians: what the last decimal does
#: to an edge of a tenth of a millimetre.
_NEARLY_ROUND = 1e-8


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
        ``(2 m,) float``: direction of the edge seen from the vertex, in [0, 2 pi).
    gap
        ``(2 m,) float``: angle to the next end at the vertex, counter-clockwise; a full
        turn where there is no other.
    """

    first: Ints
    edge: Ints
    neighbour: Ints
    angle: Floats
    gap: Floats


@dataclass(frozen=True, eq=False)
class Frame:
    """A planar graph drawn with straight edges; `make_frame` makes one of any input.

    Parameters
    ----------
    name
        What to call it.
    vertices
        ``(n, 2) float``, in mm, ascending by y, then x, to 9 decimals.
    edges
        ``(m, 2) int``, each with its lower vertex first, ascending.
    numbering
        What vertices and edges are called; None: by their numbers here.  Frames that differ in
        nothing else are equal.
    """

    name: str
    vertices: Floats
    edges: Ints
    numbering: Numbering | None = None

    def __post_init__(self) -> None:
        """Check the order and freeze the arrays."""
        order = np.lexsort((self.vertices[:, 0], self.vertices[:, 1]))
        i, j = self.edges.T
        steps = np.diff(i * len(self.vertices) + j)
        if (np.diff(order) != 1).any() or not (i < j).all() or (steps <= 0).any():
            msg = f"frame {self.name}: not in canonical order"
            raise InvariantError(msg)
        for array in (self.vertices, self.edges):
            array.setflags(write=False)

    def __eq__(self, other: object) -> bool:
        """Whether name, vertices and edges are the same."""
        return (
            isinstance(other, Frame)
            and self.name == other.name
            and np.array_equal(self.vertices, other.vertices)
            and np.array_equal(self.edges, other.edges)
        )

    def __hash__(self) -> int:
        """Equal frames have equal hashes."""
        return hash((self.name, self.vertices.tobytes(), self.edges.tobytes()))

    @cached_property
    def called(self) -> Numbering:
        """What vertices and edges are called."""
        return self.numbering or counted(len(self.vertices), len(self.edges))

    def called_vertex(self, vertex: int) -> str:
        """What a vertex is called, and where it is: ``vertex 3 at (0, 80)``."""
        return self.called.vertex(vertex, self.vertices[vertex])

    def called_edge(self, edge: int) -> str:
        """What an edge is called, and where it goes from and to."""
        ends = self.edges[edge]
        return self.called.edge(edge, ends, self.vertices[ends])

    @cached_property
    def degree(self) -> Ints:
        """``(n,) int``: number of edges at each vertex."""
        return np.bincount(self.edges.ravel(), minlength=len(self.vertices)).astype(np.int64)

    @cached_property
    def lengths(self) -> Floats:
        """``(m,) float``: length of each edge, in mm."""
        return np.asarray(np.linalg.norm(np.diff(self.vertices[self.edges], axis=1)[:, 0], axis=1))

    @cached_property
    def ends(self) -> Ends:
        """The ends of the edges, by vertex and direction."""
        count = len(self.edges)
        vertex, neighbour = self.edges.T.ravel(), self.edges[:, ::-1].T.ravel()
        dx, dy = (self.vertices[neighbour] - self.vertices[vertex]).T
        angle = np.arctan2(dy, dx) % (2 * np.pi)
        angle[angle > 2 * np.pi - _NEARLY_ROUND] = 0.0
        order = np.lexsort((angle, vertex))
        angle = angle[order]
        first = np.concatenate([[0], np.cumsum(self.degree)])
        after = np.arange(1, 2 * count + 1)
        after[first[1:] - 1] = first[:-1]
        gap = angle[after] - angle
        gap[first[1:] - 1] += 2 * np.pi
        edge = np.tile(np.arange(count), 2)[order]
        return Ends(first, edge, neighbour[order], angle, gap)

    @cached_property
    def slots(self) -> Ints:
        """``(m, 2) int``: the slot of each edge at its two vertices."""
        ends = self.ends
        vertex = np.repeat(np.arange(len(self.vertices)), self.degree)
        side = (vertex == self.edges[ends.edge, 1]).astype(np.int64)
        slots = np.empty_like(self.edges)
        slots[ends.edge, side] = np.arange(len(vertex)) - ends.first[vertex]
        return slots

    def directions(self, vertex: int) -> Floats:
        """Directions of the edges at a vertex, ascending, in [0, 2 pi)."""
        return self.ends.angle[self.ends.first[vertex] : self.ends.first[vertex + 1]]

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
        """``(2, 2) float``: lower left and upper right corner of its bounding box, in mm."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])


def make_frame(
    name: str, vertices: ArrayLike, edges: ArrayLike, numbering: Numbering | None = None
) -> Frame:
    """Check a planar graph and put it in order; the order of the input does not matter.

    Parameters
    ----------
    name
        What to call it.
    vertices
        ``(n, 2) float``, in mm; they are rounded to 9 decimals.
    edges
        ``(m, 2) int``: the two vertices of each edge.
    numbering
        What these vertices and edges are called.

    Raises
    ------
    InputError
        Another shape, coordinates that are not finite or beyond `LARGEST`, an edge to a
        vertex that is not there or to itself, an edge given twice, a vertex without an edge,
        vertices that are one, edges that meet elsewhere than at a vertex.  They are called as
        `numbering` says, else by their numbers in the input.
    """
    points = _points(vertices)
    pairs = vertex_pairs(edges, len(points))
    called = numbering or counted(len(points), len(pairs))
    _check_pairs(pairs, points, called)
    check_planar(points, pairs, called)
    order = canonical_order(points)
    pairs = np.sort(np.argsort(order)[pairs], axis=1)
    of_edges = np.lexsort(pairs.T[::-1])
    numbers = numbering and numbering.sorted(order, of_edges)
    return Frame(name, points[order], pairs[of_edges], numbers)


def canonical_order(points: Floats) -> Ints:
    """The order of a frame's vertices: ascending by y, then x, as they are rounded.

    Parameters
    ----------
    points
        ``(n, 2) float``, in mm.
    """
    rounded = points.round(_DECIMALS)
    return np.asarray(np.lexsort((rounded[:, 0], rounded[:, 1])), dtype=np.int64)


def _points(vertices: ArrayLike) -> Floats:
    points = np.asarray(vertices, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        msg = f"vertices of shape {points.shape}: must be (n, 2), an x and a y each"
        raise InputError(msg)
    bad = np.flatnonzero(~(np.abs(points) <= LARGEST).all(axis=1))
    if len(bad):
        msg = f"vertex {bad[0]} at {where(points[bad[0]])}: must be within {LARGEST:g} mm of 0"
        raise InputError(msg)
    return np.asarray(points.round(_DECIMALS) + 0.0)


def vertex_pairs(edges: ArrayLike, count: int) -> Ints:
    """Edges between so many vertices, ``(m, 2) int``.

    Raises
    ------
    InputError
        Another shape, none, or a vertex that is not there.
    """
    given = np.asarray(edges)
    if given.ndim != 2 or given.shape[1] != 2 or not len(given):
        msg = f"edges of shape {given.shape}: must be (m, 2), two vertices each, at least one edge"
        raise InputError(msg)
    if given.dtype.kind not in "iu":
        msg = f"edges of type {given.dtype}: must be whole numbers"
        raise InputError(msg)
    if not count:
        msg = "there are no vertices: must be two or more"
        raise InputError(msg)
    pairs = given.astype(np.int64)
    bad = np.flatnonzero(((pairs < 0) | (pairs >= count)).any(axis=1))
    if len(bad):
        msg = f"edge {bad[0]} = {pairs[bad[0]].tolist()}: vertices go from 0 to {count - 1}"
        raise InputError(msg)
    return pairs


def _check_pairs(pairs: Ints, points: Floats, called: Numbering) -> None:
    loops = np.flatnonzero(pairs[:, 0] == pairs[:, 1])
    if len(loops):
        at = pairs[loops[0], 0]
        edge = called.short(loops[0], pairs[loops[0]], points[pairs[loops[0]]])
        msg = f"{edge} goes from {called.vertex(at, points[at])} to itself"
        raise InputError(msg)
    low = np.sort(pairs, axis=1)
    _, first, inverse = np.unique(low, axis=0, return_index=True, return_inverse=True)
    again = np.flatnonzero(first[inverse.ravel()] != np.arange(len(pairs)))
    if len(again):
        of = first[inverse.ravel()[again[0]]]
        msg = f"edge {again[0]} = {pairs[again[0]].tolist()}: the same as edge {of}"
        raise InputError(msg)
    alone = np.setdiff1d(np.arange(len(points)), pairs)
    if len(alone):
        msg = f"{called.vertex(alone[0], points[alone[0]])} has no edge"
        raise InputError(msg)
