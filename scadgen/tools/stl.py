"""Reads STL, binary and as text; tells whether what was written is one closed surface."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from scadgen.errors import ToolError
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.mesh import FLAT, edge_faults, volume, weld_float32

__all__ = ["check_stl", "nothing_inside", "read_stl", "read_text_stl"]

#: Length of the header, and of the count behind it, in bytes.
_HEADER = 80
_START = 84

#: What begins a solid in an STL as text, with its name; and what begins a face, and a corner.
_SOLID = re.compile(r"^\s*solid\b[ \t]*(.*?)[ \t]*$", re.MULTILINE | re.IGNORECASE)
_FACET = re.compile(r"\bfacet\b", re.IGNORECASE)
_VERTEX = re.compile(r"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)

_FACE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_stl(path: Path) -> tuple[Floats, Ints]:
    """Read a binary STL; corners with exactly the same coordinates become one point.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    points
        ``(v, 3) float``, mm, sorted.
    triangles
        ``(m, 3) int``, counter-clockwise seen from outside.

    Raises
    ------
    ToolError
        If it is not a whole binary STL, or has a coordinate that is not finite.
    """
    data = path.read_bytes()
    count = int.from_bytes(data[_HEADER:_START], "little")
    if len(data) < _START or len(data) != _START + count * _FACE.itemsize:
        msg = f"{path}: {len(data)} bytes: not a whole binary STL"
        raise ToolError(msg)
    corners = np.frombuffer(data, _FACE, count, _START)["corners"].reshape(-1, 3)
    if not np.isfinite(corners).all():
        msg = f"{path}: a coordinate is not finite"
        raise ToolError(msg)
    points, triangles = weld_float32(
        corners.astype(np.float64), np.arange(3 * count, dtype=np.int64).reshape(-1, 3)
    )
    return points.astype(np.float64), triangles


def read_text_stl(path: Path) -> list[tuple[str, Floats]]:
    """Read an STL that is text.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    solids
        The name of each, and its faces' corners ``(m, 3, 3) float``.

    Raises
    ------
    ToolError
        If it is not a whole STL.
    """
    text = path.read_bytes().decode("utf-8", "replace")
    before, *rest = _SOLID.split(text)
    found = []
    for name, body in zip(rest[::2], rest[1::2], strict=True):
        try:
            corners = np.array(_VERTEX.findall(body), dtype=np.float64).reshape(-1, 3, 3)
        except ValueError:
            corners = np.empty((0, 3, 3))
        if len(corners) != len(_FACET.findall(body)):
            break
        found.append((name, corners))
    else:
        if found and not before.strip():
            return found
    msg = f"{path}: not a whole STL file"
    raise ToolError(msg)


def check_stl(path: Path) -> float:
    """Check that a binary STL is watertight and give its volume.

    Watertight: every directed edge occurs exactly once, and so does its opposite.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    volume
        In mm3, more than zero.

    Raises
    ------
    ToolError
        If the file is broken, empty, not watertight, flat, or inside out.
    """
    points, triangles = read_stl(path)
    if not len(triangles):
        msg = f"{path}: has no triangles"
        raise ToolError(msg)
    if len(faults := edge_faults(triangles)):
        place = points[faults[0, 0]].tolist()
        msg = f"{path}: not watertight: {len(faults)} faulty edges, the first at {place} mm"
        raise ToolError(msg)
    if not (enclosed := volume(points, triangles)) > 0:
        why = nothing_inside(points, enclosed)
        msg = f"{path}: volume = {enclosed:.6g} mm3: must be above 0; {why}"
        raise ToolError(msg)
    return enclosed


def nothing_inside(points: Floats, enclosed: float) -> str:
    """Say why a closed mesh encloses no volume above 0.

    Parameters
    ----------
    points
        ``(v, 3) float``, mm.
    enclosed
        Its volume, in mm3.
    """
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    return "it is flat" if enclosed >= -FLAT * size**3 else "its faces look inwards"
