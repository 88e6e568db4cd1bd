"""OpenSCAD drawing each part as we write it, and as one would write it with booleans."""

from __future__ import annotations

import resource
import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from report import heading, line, progress
from scipy.spatial import Voronoi

from scadgen.emit.scad import scad
from scadgen.joint.joint import site_curves
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import Weave
from scadgen.kit.build import Request, build
from scadgen.kit.model import Kit
from scadgen.plane.catalogue import NamedTiling
from scadgen.solid.affine import AffineSolid
from scadgen.tools.openscad import render

__all__ = ["measure"]

#: Aims: how many times faster than booleans, and the triangles of a connector at `standard`.
_TIMES, _TRIANGLES = 10.0, 2000

_TIMEOUT = 300.0

#: Voronoi cells that a connector is united from: the samples of `draft`.
_CELLS = 60


def measure(frame: str) -> None:
    """Report the CPU time of OpenSCAD for each part, one after the other in the same run."""
    kit = build(Request.tiled(NamedTiling(frame)))
    heading(f"Parts of the {frame} kit in OpenSCAD, CPU time: one polyhedron, and with booleans")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours = folder / "kit.scad"
        ours.write_text(scad(kit), encoding="ascii")
        for part, text in _with_booleans(kit).items():
            progress(f"drawing {part} both ways")
            theirs = folder / f"{part}.scad"
            theirs.write_text(text, encoding="ascii")
            fast = min(_seconds(ours, folder / "a.stl", {"part": part}) for _ in range(3))
            slow = _seconds(theirs, folder / "b.stl", {})
            line(
                part,
                f"{fast:.2f} s, {slow:.2f} s: {slow / fast:.1f} times",
                f"at least {_TIMES:g} times",
                met=slow / fast >= _TIMES,
            )
    count = len(kit.parts["connector"].triangles)
    line(
        "triangles of a connector",
        str(count),
        f"at most {_TRIANGLES}",
        met=count <= _TRIANGLES,
    )


def _seconds(file: Path, output: Path, settings: Mapping[str, str]) -> float:
    """CPU time of OpenSCAD for one part."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    render(file, output, settings, timeout=_TIMEOUT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _with_booleans(kit: Kit) -> dict[str, str]:
    """Each part with booleans, at the kit's own values.

    The connector is the part of the ring in the cells of its curve's samples; all others are
    made from its finished polyhedron, and so flattered.
    """
    v = kit.values
    start = kit.joints[0].key.tube_start * v["side"]
    end, gap, width = v["edge_length"] - start, v["peg_clearance"], v["peg_width"]
    near, far = "connector();", f"translate([{v['edge_length']}, 0, 0]) rotate(180) connector();"
    tube = _box(start, end, v["side"])
    peg = _box(end, end + v["peg_length"], width)
    other = _box(start - v["peg_length"], start, width)
    socket = _box(start - v["peg_length"] - gap, start + 1, width + 2 * gap)
    beside = (
        f"translate([0, {v['clearance'] / 2 - 500}, 0]) cube([1000, 1000, 1000], center = true);"
    )
    joint = [
        f"rotate({p.turn}) "
        + (f"rotate([{180 * p.flip}, 0, 0]) half();" if p.part == "half" else near)
        for p in kit.joints[0].pieces
        if p.part != "peg"
    ]
    half = f"difference() {{ connector(); {beside} {socket} }}"
    modules = f"{_polyhedron(kit.parts['connector'], v)}\nmodule half() {half}\n"
    return {
        "connector": _cells(kit),
        "half": modules + "half();",
        "basic": f"{modules}union() {{ {near} {tube} {far} }}",
        "one_sided": f"{modules}union() {{ {near} {tube} {peg} }}",
        "two_sided": f"union() {{ {other} {tube} {peg} }}",
        "joint": modules + "\n".join(joint),
    }


def _cells(kit: Kit) -> str:
    """The connector as the ring's part in a union of convex Voronoi cells, with no clearance."""
    weave = Weave(**{k: v for k, v in kit.joints[0].weave.items() if k != "name"})
    count, side = len(kit.joints[0].turns), kit.values["side"]
    edges = np.arange(count) * 2 * np.pi / count
    curves = site_curves(Spokes.flat(edges), weave, _CELLS)
    sites = [side * curve.points(np.linspace(-1, 1, _CELLS)) for curve in curves]
    # Sites far away close all cells.
    guards = 100 * side * np.vstack([np.eye(3), -np.eye(3)])
    cells = Voronoi(np.vstack([*sites, guards]))
    hulls = []
    for region in cells.point_region[:_CELLS]:
        points = cells.vertices[cells.regions[region]].round(9).tolist()
        hulls.append(f"hull() polyhedron(points = {points}, faces = [{list(range(len(points)))}]);")
    outer, inner = (
        f"cylinder(h = {height}, r = {ratio * side}, $fn = 36, center = true);"
        for height, ratio in ((side, weave.ring_ratio + 0.5), (2 * side, weave.ring_ratio - 0.5))
    )
    ring = f"difference() {{ {outer} {inner} }}"
    return f"intersection() {{ {ring} union() {{ {' '.join(hulls)} }} }}"


def _box(first: float, last: float, width: float) -> str:
    """A square prism along x."""
    size = [last - first, width, width]
    return f"translate([{first}, {-width / 2}, {-width / 2}]) cube({size});"


def _polyhedron(solid: AffineSolid, values: Mapping[str, float]) -> str:
    points = solid.points(values).round(9).tolist()
    faces = solid.triangles[:, ::-1].tolist()
    return f"module {solid.name}() polyhedron(points = {points}, faces = {faces}, convexity = 12);"
