"""Check an STL or 3MF that OpenSCAD wrote: python3 check_stl.py MESH [LOG].

The mesh must be watertight: every directed edge occurs exactly once, and so does its
opposite.  With the log of its render, no line of that may begin with ERROR, WARNING or
EXPORT-, and the mesh must have the volume that the log states.  Needs Python 3 alone.
"""
# ruff: noqa: INP001

from __future__ import annotations

import struct
import sys
import zipfile
from collections import Counter
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

if TYPE_CHECKING:
    from collections.abc import Iterator

    Point = tuple[float, ...]
    Triangle = tuple[Point, Point, Point]

BAD = ("ERROR", "WARNING", "EXPORT-")

# The log has 6 significant digits, and a file's coordinates about 7.
TOLERANCE = 2e-5


class FaultError(Exception):
    """What is wrong with a mesh or its log, in one line."""


def read_stl(path: Path) -> Iterator[Triangle]:
    """Give the triangles of a binary STL as triples of points."""
    data = path.read_bytes()
    if len(data) < 84 or len(data) != 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        fault = "not a whole binary STL"
        raise FaultError(fault)
    for face in struct.iter_unpack("<12fH", data[84:]):
        yield face[3:6], face[6:9], face[9:12]


def read_3mf(path: Path) -> Iterator[Triangle]:
    """Give the triangles of a 3MF as triples of points."""
    with zipfile.ZipFile(path) as archive:
        # OpenSCAD has just written it here, so nobody else can have.
        model = ET.fromstring(archive.read("3D/3dmodel.model"))  # noqa: S314
    for mesh in model.iterfind(".//{*}mesh"):
        points = [
            tuple(float(p.attrib[axis]) for axis in "xyz") for p in mesh.iterfind(".//{*}vertex")
        ]
        for face in mesh.iterfind(".//{*}triangle"):
            a, b, c = (points[int(face.attrib[corner])] for corner in ("v1", "v2", "v3"))
            yield a, b, c


def check_edges(triangles: list[Triangle]) -> None:
    """Raise unless every directed edge occurs once, and so does its opposite."""
    edges = Counter(edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a)))
    for (a, b), uses in edges.items():
        if uses != 1 or edges.get((b, a)) != 1:
            fault = f"not watertight: see the edge from {a} to {b}"
            raise FaultError(fault)


def volume(triangles: list[Triangle]) -> float:
    """Enclosed volume, in mm3."""
    o = triangles[0][0]
    total = 0.0
    for face in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (
            (p[0] - o[0], p[1] - o[1], p[2] - o[2]) for p in face
        )
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


def read_log(path: Path) -> float:
    """Give the volume that a log states; raise for any bad line in it."""
    stated = None
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith(BAD):
            raise FaultError(line)
        if line.startswith('ECHO: "volume = '):
            stated = float(line.split()[3])
    if stated is None:
        fault = "the log states no volume"
        raise FaultError(fault)
    return stated


def check(mesh: Path, log: Path | None) -> str:
    """Check one mesh and say what it is; raise if it is not good."""
    stated = read_log(log) if log else None
    triangles = list((read_3mf if mesh.suffix == ".3mf" else read_stl)(mesh))
    if not triangles:
        fault = "has no triangles"
        raise FaultError(fault)
    if not all(abs(x) < 1e9 for x in chain.from_iterable(chain.from_iterable(triangles))):
        fault = "a coordinate is not finite"
        raise FaultError(fault)
    check_edges(triangles)
    enclosed = volume(triangles)
    if not enclosed > 0:
        fault = "inside out: its faces look inwards" if enclosed < 0 else "flat: encloses nothing"
        raise FaultError(fault)
    if stated is not None and not abs(enclosed - stated) <= TOLERANCE * stated:
        fault = f"volume = {enclosed:.6g} mm3: must be {stated:.6g}"
        raise FaultError(fault)
    return f"{mesh.name}: watertight, {len(triangles)} triangles, {enclosed:.6g} mm3"


def main(mesh: str, log: str | None = None) -> None:
    """Check one mesh; leave with status 1 and one line if it is not good."""
    try:
        said = check(Path(mesh), Path(log) if log else None)
    except (FaultError, OSError, ValueError, LookupError, SyntaxError, zipfile.BadZipFile) as error:
        sys.exit(f"{mesh}: {error}")
    sys.stdout.write(said + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
