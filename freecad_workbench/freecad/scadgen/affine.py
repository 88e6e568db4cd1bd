"""A part's affine solid, evaluated with the standard library alone.

A vertex is the sum of each live parameter times its factors; the faces never change.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from freecad.scadgen.faces import Face, Point, Triangle, edges_of, faces

__all__ = ["Solid", "read_solid"]


class Solid:
    """A part: a closed polyhedron whose vertices are linear in the live parameters.

    Parameters
    ----------
    name
        The part's name.
    entry
        What ``kit.json`` says of it: for each live parameter that moves a vertex the factors in
        x, y, z of all vertices (``points``), the vertices of each ``triangle``, counter-clockwise
        from outside, and one number a triangle (``facets``), the same for those that stay in one
        plane; its ``role``, and what it ``ends`` in.
    values
        Live parameters at which the solid is sound, in mm.
    """

    def __init__(self, name: str, entry: Mapping[str, Any], values: Mapping[str, float]) -> None:
        self.name = name
        self.role: str = entry["role"]
        self.ends: list[dict[str, Any]] = entry["ends"]
        self.triangles: list[Triangle] = [(a, b, c) for a, b, c in entry["triangles"]]
        self.facets: list[int] = [*entry["facets"]]
        self._factors = {p: [f for row in rows for f in row] for p, rows in entry["points"].items()}
        self._values = dict(values)

    @property
    def keys(self) -> int:
        """How many of its ends are those of a key."""
        return sum(end["slot"] is None for end in self.ends)

    @property
    def is_second(self) -> bool:
        """Whether it is half B of a connector whose halves differ."""
        return self.role == "half" and bool(self.ends[0]["over"])

    @property
    def parameters(self) -> tuple[str, ...]:
        """The live parameters that move its vertices."""
        return (*self._factors,)

    def points(self, values: Mapping[str, float]) -> list[Point]:
        """Vertices at the given live parameters, all in mm."""
        (first, factors), *others = self._factors.items()
        value = values[first]
        flat = [value * f for f in factors]
        for name, factors in others:
            value = values[name]
            flat = [x + value * f for x, f in zip(flat, factors)]
        return list(zip(flat[::3], flat[1::3], flat[2::3]))

    def polygons(self) -> list[list[list[int]]]:
        """Outlines of all faces: a list of loops each, the outer one first."""
        return [face.loops for face in self.faces]

    @cached_property
    def faces(self) -> list[Face]:
        """The largest flat faces; they cover the surface."""
        return faces(self.triangles, self.facets, self.points(self._values))


def read_solid(name: str, entry: Mapping[str, Any], values: Mapping[str, float]) -> Solid:
    """A solid from what ``kit.json`` says of it; all as for `Solid`.

    Raises
    ------
    ValueError
        They are not finite numbers of the right shape, or not a closed surface.
    """
    solid = Solid(name, entry, values)
    if not {*solid.parameters} <= {*values}:
        msg = f"part {name}: moved by a parameter that the kit lacks"
        raise ValueError(msg)
    lengths = {len(rows) for rows in entry["points"].values()}
    wide = {len(row) for rows in entry["points"].values() for row in rows}
    if len(lengths) != 1 or wide != {3} or len(solid.facets) != len(solid.triangles):
        msg = f"part {name}: tables of the wrong shape"
        raise ValueError(msg)
    if not _is_closed(solid, lengths.pop()):
        msg = f"part {name}: its triangles are not a closed surface"
        raise ValueError(msg)
    if not all(math.isfinite(x) for point in solid.points(values) for x in point):
        msg = f"part {name}: a coordinate is not a finite number"
        raise ValueError(msg)
    return solid


def _is_closed(solid: Solid, count: int) -> bool:
    """Whether each edge has one triangle on each side, and each corner is a vertex."""
    if not all(type(v) is int and 0 <= v < count for t in solid.triangles for v in t):
        return False
    edges = {edge for t in solid.triangles for edge in edges_of(t)}
    return len(edges) == 3 * len(solid.triangles) and all((b, a) in edges for a, b in edges)
