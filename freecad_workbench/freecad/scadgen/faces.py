"""The largest flat faces of a polyhedron, out of its triangles and facet numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple, Tuple

__all__ = ["Face", "Point", "Triangle", "edges_of", "faces", "newell"]

Point = Tuple[float, float, float]
Triangle = Tuple[int, int, int]


class Face(NamedTuple):
    """Part of a surface that stays flat whatever the parameters are.

    Parameters
    ----------
    loops
        Its outlines by vertex, the outer one first and counter-clockwise seen from
        outside, holes clockwise.
    triangles
        The triangles it is made of.
    """

    loops: list[list[int]]
    triangles: list[Triangle]


def faces(
    triangles: Iterable[Triangle], facets: Iterable[int], points: Sequence[Point]
) -> list[Face]:
    """The largest flat faces; they cover the surface.

    Parameters
    ----------
    triangles
        Vertices of each triangle, counter-clockwise from outside.
    facets
        One number a triangle; those with the same number stay in one plane.
    points
        The vertices somewhere where the polyhedron is sound: they tell outlines from holes.
    """
    groups: dict[int, list[Triangle]] = {}
    for triangle, facet in zip(triangles, facets):
        groups.setdefault(facet, []).append(triangle)
    return [
        face
        for group in groups.values()
        for piece in _connected(group)
        for face in _outlined(piece, points)
    ]


def edges_of(triangle: Triangle) -> tuple[tuple[int, int], ...]:
    """The three directed edges of a triangle."""
    a, b, c = triangle
    return (a, b), (b, c), (c, a)


def newell(loop: Sequence[int], points: Sequence[Point]) -> Point:
    """Twice the area vector of a closed outline, pointing to where it is counter-clockwise."""
    ax, ay, az = points[loop[0]]
    bx, by, bz = points[loop[1]]
    px, py, pz = bx - ax, by - ay, bz - az
    x = y = z = 0.0
    for vertex in loop[2:]:
        cx, cy, cz = points[vertex]
        qx, qy, qz = cx - ax, cy - ay, cz - az
        x += py * qz - pz * qy
        y += pz * qx - px * qz
        z += px * qy - py * qx
        px, py, pz = qx, qy, qz
    return x, y, z


def _connected(triangles: list[Triangle]) -> Iterator[list[Triangle]]:
    """Triangles of one facet, in pieces that hang together by edges."""
    if len(triangles) == 1:
        yield triangles
        return
    owner = {edge: t for t in triangles for edge in edges_of(t)}
    left = dict.fromkeys(triangles)
    while left:
        start = next(iter(left))
        del left[start]
        piece = [start]
        for triangle in piece:  # it grows meanwhile
            for a, b in edges_of(triangle):
                beside = owner.get((b, a))
                if beside in left:
                    del left[beside]
                    piece.append(beside)
        yield piece


def _outlined(triangles: list[Triangle], points: Sequence[Point]) -> Iterator[Face]:
    """A flat piece by its outlines; as triangles where its outlines touch themselves."""
    edges = {edge: None for t in triangles for edge in edges_of(t)}
    rim = [(a, b) for a, b in edges if (b, a) not in edges]
    after = dict(rim)
    if len(after) < len(rim):
        for triangle in triangles:
            yield Face([[*triangle]], [triangle])
        return
    loops = []
    while after:
        vertex = next(iter(after))
        loop = []
        while vertex in after:
            loop.append(vertex)
            vertex = after.pop(vertex)
        loops.append(loop)
    loops.sort(key=lambda loop: -sum(x * x for x in newell(loop, points)))
    yield Face(loops, triangles)
