"""What `in_freecad.py` measures, inside FreeCAD."""

from __future__ import annotations

import runpy
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD
import Part

__all__ = ["main"]

_REPEATS = 3


def main(macro: str) -> dict[str, float]:
    """CPU seconds of each thing, and how large it is."""
    start = time.process_time()
    made = runpy.run_path(macro, run_name="__main__")
    found = {"made": time.process_time() - start}
    document = FreeCAD.ActiveDocument
    found["recompute"] = min(_recompute(document, 0.3 + 0.01 * n) for n in range(_REPEATS))
    path = str(Path(macro).with_suffix(".FCStd"))
    document.saveAs(path)
    FreeCAD.closeDocument(document.Name)
    start = time.process_time()
    document = FreeCAD.openDocument(path)
    found["opened"] = time.process_time() - start
    found["pieces"] = sum(link.ElementCount for link in document.Frame.Group)
    return found | _part(made)


def _recompute(document: FreeCAD.Document, clearance: float) -> float:
    document.Parameters.set("clearance", f"={clearance} mm")
    start = time.process_time()
    document.recompute()
    return time.process_time() - start


def _part(made: dict[str, Any]) -> dict[str, float]:
    """A basic element: first, at another clearance, and by FreeCAD's own calls."""
    first, again, calls = [], [], []
    for _ in range(_REPEATS):
        kit = made["parse_kit"](made["KIT"])
        basic = kit.parts["basic"]
        start = time.process_time()
        shape = made["make_shape"](basic, kit.values)
        then = time.process_time()
        made["make_shape"](basic, {**kit.values, "clearance": 0.3})
        second = time.process_time()
        _by_calls(basic.points(kit.values), basic.polygons(), made["newell"])
        first.append(then - start)
        again.append(second - then)
        calls.append(time.process_time() - second)
    times = {"first": min(first), "again": min(again), "calls": min(calls)}
    return {**times, "faces": len(shape.Faces)}


def _by_calls(
    points: list[tuple[float, ...]], polygons: list[list[list[int]]], newell: Callable[..., Any]
) -> Part.Solid:
    """Vertices and edges shared, a plane and a wire for each face."""
    vertices = [Part.Vertex(*point) for point in points]
    edges: dict[tuple[int, int], Part.Edge] = {}
    faces = []
    for loops in polygons:
        wires = []
        for loop in loops:
            wire = []
            for a, b in zip(loop, [*loop[1:], loop[0]], strict=True):
                ends = (min(a, b), max(a, b))
                if ends not in edges:
                    edges[ends] = Part.Edge(vertices[ends[0]], vertices[ends[1]])
                wire.append(edges[ends])
            wires.append(Part.Wire(wire))
        start, normal = points[loops[0][0]], newell(loops[0], points)
        plane = Part.Plane(FreeCAD.Vector(*start), FreeCAD.Vector(*normal))
        faces.append(Part.Face(plane, wires[0]))
    return Part.Solid(Part.Shell(faces))
