"""Affine solids in OpenCASCADE's text format, which FreeCAD reads faster than it builds.

Edges are straight and faces plane; neighbours share vertices and edges.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import List

from freecad.scadgen.affine import Solid
from freecad.scadgen.faces import Face, Point, newell

__all__ = ["brep"]

#: How far a vertex may be off the plane of its face, in mm; OpenCASCADE allows 1e-7.
_FLAT = 5e-8

Loops = List[List[int]]


def brep(solid: Solid, values: Mapping[str, float]) -> str:
    """The solid's boundary at the given live parameters, all in mm.

    Returns
    -------
    text
        One solid whose faces look outwards; faces that are not flat to 1e-7 mm here are
        taken apart into triangles.
    """
    points = solid.points(values)
    faces = [outlined for face in solid.faces for outlined in _flat(face, points)]
    edges, wires = _numbered(faces)
    return "\n".join(
        (
            "",
            "CASCADE Topology V1, (c) Matra-Datavision",
            "Locations 0",
            "Curve2ds 0",
            f"Curves {len(edges)}",
            *(_straight(points[a], points[b]) for a, b in edges),
            "Polygon3D 0",
            "PolygonOnTriangulations 0",
            f"Surfaces {len(faces)}",
            *(_plane(loops[0], points) for loops in faces),
            "Triangulations 0",
            "",
            *_topology(points, edges, wires),
        )
    )


def _flat(face: Face, points: Sequence[Point]) -> Iterator[Loops]:
    """A face by its outlines, or its triangles where it is not flat."""
    outer = face.loops[0]
    if len(face.triangles) > 1:
        nx, ny, nz = _unit(newell(outer, points))
        ax, ay, az = points[outer[0]]
        for loop in face.loops:
            for x, y, z in (points[v] for v in loop):
                if abs(nx * (x - ax) + ny * (y - ay) + nz * (z - az)) > _FLAT:
                    yield from ([[*triangle]] for triangle in face.triangles)
                    return
    yield face.loops


def _numbered(faces: Iterable[Loops]) -> tuple[list[tuple[int, int]], list[Loops]]:
    """The edges, and each face's outlines by edge: numbers from 1, negative if passed back."""
    number: dict[tuple[int, int], int] = {}
    edges: list[tuple[int, int]] = []
    wires: list[Loops] = []
    for loops in faces:
        wires.append([])
        for loop in loops:
            wire = []
            a = loop[-1]
            for b in loop:
                edge = number.get((a, b))
                if edge is None:
                    edges.append((a, b))
                    edge = len(edges)
                    number[b, a] = -edge
                wire.append(edge)
                a = b
            wires[-1].append(wire)
    return edges, wires


def _topology(
    points: Sequence[Point], edges: Sequence[tuple[int, int]], wires: Sequence[Loops]
) -> Iterator[str]:
    """Vertices, edges, wires, faces, shell and solid; a reference counts back from the end."""
    total = len(points) + len(edges) + sum(map(len, wires)) + len(wires) + 2
    yield f"TShapes {total}"
    for x, y, z in points:
        yield f"Ve\n1e-07\n{x!r} {y!r} {z!r}\n0 0\n\n0101101\n*"
    for number, (a, b) in enumerate(edges, 1):
        length = math.dist(points[a], points[b])
        ends = f"+{total - a} 0 -{total - b} 0 *"
        yield f"Ed\n 1e-07 1 1 0\n1 {number} 0 0 {length!r}\n0\n\n0101000\n{ends}"
    base = total - len(points) + 1
    left = base - 1 - len(edges)
    shell = []
    for number, outlines in enumerate(wires, 1):
        for wire in outlines:
            passed = " ".join(f"+{base - e} 0" if e > 0 else f"-{base + e} 0" for e in wire)
            yield f"Wi\n\n0101100\n{passed} *"
        own = " ".join(f"+{left - n} 0" for n in range(len(outlines)))
        left -= len(outlines)
        yield f"Fa\n0 1e-07 {number} 0\n\n0111000\n{own} *"
        shell.append(f"+{left} 0")
        left -= 1
    yield f"Sh\n\n0101100\n{' '.join(shell)} *"
    yield "So\n\n1100000\n+2 0 *\n\n+1 0 "


def _straight(start: Point, end: Point) -> str:
    """The line that an edge is on."""
    x, y, z = start
    dx, dy, dz = _unit((end[0] - x, end[1] - y, end[2] - z))
    return f"1 {x!r} {y!r} {z!r} {dx!r} {dy!r} {dz!r}"


def _plane(loop: Sequence[int], points: Sequence[Point]) -> str:
    """The plane that a face is in: a point, the outward normal, two axes."""
    x, y, z = points[loop[0]]
    ex, ey, ez = points[loop[1]]
    nx, ny, nz = _unit(newell(loop, points))
    ux, uy, uz = _unit((ex - x, ey - y, ez - z))
    vx, vy, vz = ny * uz - nz * uy, nz * ux - nx * uz, nx * uy - ny * ux
    return f"1 {x!r} {y!r} {z!r} {nx!r} {ny!r} {nz!r} {ux!r} {uy!r} {uz!r} {vx!r} {vy!r} {vz!r}"


def _unit(vector: Point) -> Point:
    x, y, z = vector
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length
