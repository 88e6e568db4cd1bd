"""Checks of a kit through OpenSCAD."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from scadgen.check.result import Result
from scadgen.emit.scad_parameters import views
from scadgen.kit.model import Kit
from scadgen.solid.mesh import volume
from scadgen.tools.openscad import render
from scadgen.tools.stl import check_stl, read_stl

__all__ = ["part_renders", "view_renders"]

#: A bed that the largest part of the largest kit fits on, in mm.
_BED = (5000, 5000)

#: How far OpenSCAD's vertices may be from ours, in mm, and its volumes, as a share.
_VERTEX, _VOLUME = 1e-4, 1e-6


def part_renders(kit: Kit, scad: Path, folder: Path, timeout: float) -> Iterator[Result]:
    """Whether OpenSCAD draws each part as we evaluate it."""
    for name, solid in kit.parts.items():
        output = folder / f"{name}.stl"
        check = f"OpenSCAD draws {name}"
        log = render(scad, output, {"part": name}, timeout=timeout).log
        drawn, _ = read_stl(output)
        points = solid.points(kit.values)
        far = max(
            float(np.max(cKDTree(a).query(b)[0])) for a, b in ((drawn, points), (points, drawn))
        )
        off = abs(check_stl(output) / volume(points, solid.triangles) - 1)
        good = far < _VERTEX and off < _VOLUME and not _constructive(log)
        figure = f"vertices {far:.1e} mm off, volume {off:.1e}"
        yield Result(check, bool(good), figure, f"{_VERTEX:g} mm, {_VOLUME:g}")


def view_renders(kit: Kit, scad: Path, folder: Path, timeout: float) -> Iterator[Result]:
    """Whether OpenSCAD draws plates and assemblies without any CSG."""
    for name in views(kit):
        output = folder / f"{name}.stl"
        check = f"OpenSCAD draws {name}"
        done = render(scad, output, {"part": name, "bed": _BED}, timeout=timeout)
        content = check_stl(output)
        good = np.isfinite(content) and not _constructive(done.log)
        yield Result(check, bool(good), f"{done.seconds:.1f} s, watertight", "no CSG")


def _constructive(log: tuple[str, ...]) -> bool:
    """Whether OpenSCAD went through CSG, by its log."""
    return any("Simple:" in line for line in log)
