"""What a program has instead of a file: a frame, arrays, a graph, lines."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from scadgen.api.options import GRAPH, LINES
from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.readers.reading import Read, Reading, from_graph, from_segments
from scadgen.solid.affine import Floats

__all__ = ["Drawing", "drawing", "shown"]

#: Letters of a value that a message shows.
_SHOWN = 60


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """A frame as a program has it.

    Parameters
    ----------
    name
        What to call it.
    kind
        `GRAPH` if it lists vertices and edges, `LINES` if it is drawn.
    read
        Makes a frame of it.
    """

    name: str
    kind: str
    read: Callable[[Reading], Read]


def drawing(given: object, name: str | None = None) -> Drawing:
    """What a program gives, as something that can be read.

    Parameters
    ----------
    given
        A `Frame`; vertices ``(n, 2) float`` and edges ``(m, 2) int``; a graph of networkx whose
        nodes have ``pos``; a line of shapely, or several.  All lengths are in mm.
    name
        What to call it; by default as it calls itself.

    Raises
    ------
    InputError
        It is something else.
    """
    if isinstance(given, Frame):
        return Drawing(name or given.name, GRAPH, lambda how: _of_frame(given, how))
    if _is_graph(given):
        called = name or str(getattr(given, "name", "")) or "graph"
        return Drawing(called, GRAPH, lambda how: _of_graph(called, given, how))
    if _is_geometry(given):
        called = name or "lines"
        return Drawing(called, LINES, lambda how: _of_lines(called, [given], how))
    if isinstance(given, list | tuple) and given and all(map(_is_geometry, given)):
        called = name or "lines"
        return Drawing(called, LINES, lambda how: _of_lines(called, given, how))
    if isinstance(given, list | tuple) and len(given) == 2:
        called = name or "frame"
        vertices, edges = given
        return Drawing(called, GRAPH, lambda how: _of_arrays(called, vertices, edges, how))
    msg = (
        f"frame {shown(given)}: must be a name or a file; a frame; vertices and edges; a graph of "
        "networkx; lines of shapely"
    )
    raise InputError(msg)


def _is_graph(given: object) -> bool:
    """Whether it is a graph of networkx, which is there already if it is."""
    module = sys.modules.get("networkx")
    return module is not None and isinstance(given, module.Graph)


def _is_geometry(given: object) -> bool:
    """Whether it is of shapely, likewise."""
    module = sys.modules.get("shapely")
    return module is not None and isinstance(given, module.Geometry)


def _of_frame(frame: Frame, how: Reading) -> Read:
    """A frame, which may have several parts if it has them."""
    points = frame.plan * (how.scale or 1.0)
    how = replace(how, components=True)
    return from_graph(frame.name, points, frame.edges, how, frame.numbering)


def _of_arrays(name: str, vertices: object, edges: object, how: Reading) -> Read:
    points = _numbers("vertices", vertices) * (how.scale or 1.0)
    if points.ndim != 2 or points.shape[1] != 2:
        msg = f"vertices of shape {points.shape}: must be (n, 2), an x and a y each"
        raise InputError(msg)
    try:
        pairs = np.asarray(edges)
    except ValueError:
        msg = f"edges {shown(edges)}: must be (m, 2), two vertices each"
        raise InputError(msg) from None
    return from_graph(name, points, pairs, how)


def _of_graph(name: str, graph: Any, how: Reading) -> Read:  # noqa: ANN401  imported late
    """The nodes as vertices, in their order there."""
    number = {node: n for n, node in enumerate(graph)}
    points = np.zeros((len(number), 2))
    for node, at in graph.nodes(data="pos"):
        point = None if at is None else _numbers(f"node {shown(node)}: pos", at)
        if point is None or point.shape != (2,):
            msg = f"node {shown(node)}: pos = {shown(at)}: must be an x and a y, in mm"
            raise InputError(msg)
        points[number[node]] = point
    pairs = np.array([(number[a], number[b]) for a, b in graph.edges()]).reshape(-1, 2)
    return from_graph(name, points * (how.scale or 1.0), pairs.astype(np.int64), how)


def _of_lines(name: str, lines: Iterable[Any], how: Reading) -> Read:
    segments = [np.stack([line[:-1], line[1:]], axis=1) for line in _polylines(lines)]
    return from_segments(name, [one * (how.scale or 1.0) for one in segments], how)


def _polylines(lines: Iterable[Any]) -> Iterator[Floats]:
    """The corners of each line, ``(k, 2) float``."""
    import shapely

    for part in shapely.get_parts([*lines]):
        if isinstance(part, shapely.GeometryCollection | shapely.MultiLineString):
            yield from _polylines(part.geoms)
        elif not isinstance(part, shapely.LineString):
            msg = f"{part.geom_type}: must be lines; of an area take its boundary"
            raise InputError(msg)
        elif part.has_z and np.ptp(shapely.get_coordinates(part, include_z=True)[:, 2]):
            msg = f"{shown(part)}: must be plane, at one height"
            raise InputError(msg)
        else:
            yield np.asarray(shapely.get_coordinates(part))


def _numbers(what: str, given: object) -> Floats:
    try:
        return np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        msg = f"{what} = {shown(given)}: must be numbers, an x and a y each, in mm"
        raise InputError(msg) from None


def shown(given: object) -> str:
    """A value as a message shows it, on one line."""
    line = " ".join(repr(given).split())
    return line if len(line) <= _SHOWN else f"{line[: _SHOWN - 3]}..."
