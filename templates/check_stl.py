"""Check an STL or 3MF that OpenSCAD wrote, and name what is in it: check_stl.py MESH [LOG].

The mesh must be watertight: every directed edge occurs exactly once, and so does its
opposite.  With the log of its render, no line of that may begin with ERROR, WARNING or
EXPORT-, and the mesh must have the volume that the log states.  A 3MF that is good is written
anew, with an object for each piece that the log lists, named as its part; without a list it is one
object, named as the file.  Needs Python 3 alone.
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
from xml.sax.saxutils import escape

if TYPE_CHECKING:
    from collections.abc import Iterator

    Point = tuple[float, ...]
    Triangle = tuple[Point, Point, Point]

MODEL = """\
<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" \
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources>
{}</resources>
<build>
{}</build>
</model>
"""

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


def read_pieces(path: Path) -> list[tuple[str, list[float]]]:
    """Give the pieces that a log lists: name of the part, and x and y from and to."""
    start = 'ECHO: "piece = '
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    words = [line[len(start) : -1].split() for line in lines if line.startswith(start)]
    return [(name, [float(number) for number in box]) for name, *box in words]


def shells(faces: list[tuple[int, int, int]], count: int) -> list[int]:
    """Give for each vertex the lowest one that it hangs together with."""
    least = list(range(count))

    def find(v: int) -> int:
        while least[v] != v:
            least[v] = least[least[v]]
            v = least[v]
        return v

    for a, b, c in faces:
        low, *others = sorted((find(a), find(b), find(c)))
        for other in others:
            least[other] = low
    return [find(v) for v in range(count)]


def name_objects(path: Path, pieces: list[tuple[str, list[float]]]) -> None:
    """Write a 3MF anew, with an object of its own for each piece, named as its part."""
    with zipfile.ZipFile(path) as archive:
        entries = {name: archive.read(name) for name in archive.namelist()}
    model = ET.fromstring(entries["3D/3dmodel.model"])  # noqa: S314
    points: list[list[str]] = []
    faces: list[tuple[int, int, int]] = []
    for mesh in model.iterfind(".//{*}mesh"):
        first = len(points)
        points += [[p.attrib[axis] for axis in "xyz"] for p in mesh.iterfind(".//{*}vertex")]
        for f in mesh.iterfind(".//{*}triangle"):
            a, b, c = (first + int(f.attrib[corner]) for corner in ("v1", "v2", "v3"))
            faces.append((a, b, c))
    names, groups = [path.stem], [faces]
    if pieces:
        names = [name for name, _ in pieces]
        groups = [[] for _ in pieces]
        shell = shells(faces, len(points))
        piece_of = {low: piece_at(points[low], pieces) for low in set(shell)}
        for face in faces:
            groups[piece_of[shell[face[0]]]].append(face)
    objects = [
        object_text(number, name, points, group)
        for number, (name, group) in enumerate(zip(names, groups), 1)  # noqa: B905  Python 3.8
    ]
    items = "".join(f'<item objectid="{n}"/>\n' for n in range(1, len(objects) + 1))
    entries["3D/3dmodel.model"] = MODEL.format("".join(objects), items).encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in entries.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)


def piece_at(point: list[str], pieces: list[tuple[str, list[float]]]) -> int:
    """Number of the piece whose place on the plate is nearest to a point."""
    x, y = float(point[0]), float(point[1])

    def far(number: int) -> float:
        left, low, right, high = pieces[number][1]
        return max(left - x, x - right, low - y, y - high)

    return min(range(len(pieces)), key=far)


def object_text(
    number: int, name: str, points: list[list[str]], faces: list[tuple[int, int, int]]
) -> str:
    """Give an object of a 3MF, with its own numbers of vertices."""
    used = sorted({v for face in faces for v in face})
    at = {v: n for n, v in enumerate(used)}
    vertices = [f'<vertex x="{points[v][0]}" y="{points[v][1]}" z="{points[v][2]}"/>' for v in used]
    triangles = [f'<triangle v1="{at[a]}" v2="{at[b]}" v3="{at[c]}"/>' for a, b, c in faces]
    return "\n".join(
        [
            f'<object id="{number}" type="model" name="{escape(name)}"><mesh><vertices>',
            *vertices,
            "</vertices><triangles>",
            *triangles,
            "</triangles></mesh></object>\n",
        ]
    )


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
        if mesh.endswith(".3mf") and log:
            name_objects(Path(mesh), read_pieces(Path(log)))
    except (FaultError, OSError, ValueError, LookupError, SyntaxError, zipfile.BadZipFile) as error:
        sys.exit(f"{mesh}: {error}")
    sys.stdout.write(said + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
