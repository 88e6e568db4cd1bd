"""Plane frames from vertices and edges as somebody gives them, checked and put in order."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from scadgen.errors import InputError
from scadgen.frame.graph import DECIMALS, Frame
from scadgen.frame.numbering import Numbering, counted, where
from scadgen.plane.planarity import check_planar
from scadgen.solid.affine import Floats, Ints

__all__ = ["LARGEST", "canonical_order", "make_frame", "vertex_pairs"]

#: Coordinates go up to this, in mm: a kilometre, where 9 decimals are still kept.
LARGEST = 1e6


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
    return Frame.planar(name, points, pairs, numbering)


def canonical_order(points: Floats) -> Ints:
    """The order of a frame's vertices: ascending by y, then x, as they are rounded.

    Parameters
    ----------
    points
        ``(n, 2) float``, in mm.
    """
    rounded = points.round(DECIMALS)
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
    return np.asarray(points.round(DECIMALS) + 0.0)


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
