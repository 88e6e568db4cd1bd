"""Mesh files with the standard library: binary STL, and 3MF with a number of each part.

The same meshes give the same bytes.
"""

from __future__ import annotations

import io
import math
import struct
import zipfile
from collections.abc import Iterable, Sequence
from typing import NamedTuple, Tuple

__all__ = ["Body", "Matrix", "stl", "threemf"]

Point = Tuple[float, float, float]
Triangle = Tuple[int, int, int]

#: A placement as 3MF writes it: rows of the turn, each applied to a row of points, then the move.
Matrix = Tuple[float, ...]

_CONTENT_TYPES = """\
<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" \
ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" \
ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"""

_RELATIONS = """\
<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="rel0" \
Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""

_MODEL = """\
<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" \
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources>
{objects}
</resources>
<build>
{items}
</build>
</model>
"""

#: The earliest time that a zip file can state.
_NO_TIME = (1980, 1, 1, 0, 0, 0)


class Body(NamedTuple):
    """A mesh, and where it stands, once or several times.

    Parameters
    ----------
    name
        What to call it.
    points
        Vertices, in mm.
    triangles
        Counter-clockwise from outside.
    places
        A matrix for each piece.
    """

    name: str
    points: Sequence[Point]
    triangles: Sequence[Triangle]
    places: Sequence[Matrix]


def stl(bodies: Iterable[Body]) -> bytes:
    """All pieces in one binary STL."""
    chunks = []
    for body in bodies:
        for place in body.places:
            points = [_moved(point, place) for point in body.points]
            chunks += [_facet(*(points[v] for v in t)) for t in body.triangles]
    # A header that began with "solid" would be taken for a text file.
    return b"binary STL, mm".ljust(80) + struct.pack("<I", len(chunks)) + b"".join(chunks)


def threemf(bodies: Sequence[Body]) -> bytes:
    """A 3MF with one mesh a body, and an item for each of its pieces."""
    objects = "\n".join(_object(n, body) for n, body in enumerate(bodies, 1))
    items = "\n".join(
        f'<item objectid="{n}" transform="{" ".join(f"{x:.6f}" for x in _clean(place, 6))}"/>'
        for n, body in enumerate(bodies, 1)
        for place in body.places
    )
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as package:
        for name, text in (
            ("[Content_Types].xml", _CONTENT_TYPES),
            ("_rels/.rels", _RELATIONS),
            ("3D/3dmodel.model", _MODEL.format(objects=objects, items=items)),
        ):
            entry = zipfile.ZipInfo(name, _NO_TIME)
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 0
            package.writestr(entry, text)
    return buffer.getvalue()


def _object(number: int, body: Body) -> str:
    vertices = "".join(
        f'<vertex x="{x:.5f}" y="{y:.5f}" z="{z:.5f}"/>\n'
        for x, y, z in (_clean(point, 5) for point in body.points)
    )
    faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>\n' for a, b, c in body.triangles)
    name = body.name.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    return (
        f'<object id="{number}" type="model" name="{name}"><mesh>\n'
        f"<vertices>\n{vertices}</vertices>\n<triangles>\n{faces}</triangles>\n</mesh></object>"
    )


def _clean(numbers: Iterable[float], decimals: int) -> list[float]:
    """Numbers rounded, without a minus zero."""
    return [round(x, decimals) + 0.0 for x in numbers]


def _moved(point: Point, m: Matrix) -> Point:
    x, y, z = point
    return (
        x * m[0] + y * m[3] + z * m[6] + m[9],
        x * m[1] + y * m[4] + z * m[7] + m[10],
        x * m[2] + y * m[5] + z * m[8] + m[11],
    )


def _facet(a: Point, b: Point, c: Point) -> bytes:
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    normal = (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)
    length = math.sqrt(sum(x * x for x in normal)) or 1.0
    numbers = [x / length + 0.0 for x in normal]
    return struct.pack("<12fH", *numbers, *(x + 0.0 for p in (a, b, c) for x in p), 0)
