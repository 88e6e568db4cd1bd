"""Mesh files: binary STL, 3MF, OBJ and GLB, the same bytes for the same mesh.

The mesh's own vertex numbers are kept wherever a format has them.  Our own writers, as
each is a page and a general one puts times and its version into the file.

=======  ==========  ============  ==================================================
format   unit        number        direction
=======  ==========  ============  ==================================================
stl      mm          float32       z up; no vertex numbers in this format
3mf      mm, stated  10 nm         z up
obj      mm          10 nm         z up
glb      metres      float32       y up: x stays, the part's z becomes y, y becomes -z
=======  ==========  ============  ==================================================

STL and OBJ have no unit; slicers take mm.  Metres and y up is what glTF prescribes.
"""

from __future__ import annotations

import io
import json
import os
import secrets
import struct
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from scadgen.errors import InputError
from scadgen.solid.affine import Floats, Ints
from scadgen.work.deferred import interrupts_held

__all__ = ["FORMATS", "check_writable", "mesh_bytes", "write_atomic"]

#: The earliest time that a zip file can state.
_NO_TIME = (1980, 1, 1, 0, 0, 0)

_STL_FACE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])

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
<resources><object id="1" type="model"{name}><mesh>
<vertices>
{vertices}
</vertices>
<triangles>
{triangles}
</triangles>
</mesh></object></resources>
<build><item objectid="1"/></build>
</model>
"""

# glTF's own numbers.
_GLB_MAGIC, _GLB_VERSION = b"glTF", 2
_GLB_JSON, _GLB_BINARY = b"JSON", b"BIN\x00"
_GL_FLOAT, _GL_UNSIGNED_INT = 5126, 5125
_GL_VERTICES, _GL_INDICES = 34962, 34963


def _stl(points: Floats, triangles: Ints, _: str) -> bytes:
    faces = np.zeros(len(triangles), dtype=_STL_FACE)
    # Adding zero turns -0.0 into 0.0: readers that merge by bytes would keep them apart.
    corners = points.astype("<f4")[triangles] + np.float32(0)
    faces["corners"] = corners
    a, b, c = (corners[:, k].astype(np.float64) for k in range(3))
    doubled = np.cross(b - a, c - a)
    length = np.linalg.norm(doubled, axis=1, keepdims=True)
    normal = np.divide(doubled, length, out=np.zeros_like(doubled), where=length > 0)
    faces["normal"] = normal + 0.0
    # A header that began with "solid" would be taken for a text file.
    header = b"binary STL, mm".ljust(80)
    return header + struct.pack("<I", len(faces)) + faces.tobytes()


def _decimals(points: Floats) -> list[tuple[str, str, str]]:
    """Coordinates with 5 decimals, 10 nm; no minus zero."""
    rounded = np.round(points, 5) + 0.0
    return [(f"{x:.5f}", f"{y:.5f}", f"{z:.5f}") for x, y, z in rounded.tolist()]


def _3mf(points: Floats, triangles: Ints, name: str) -> bytes:
    vertices = [f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in _decimals(points)]
    faces = [f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles.tolist()]
    called = f" name={quoteattr(name)}" if name else ""
    model = _MODEL.format(name=called, vertices="\n".join(vertices), triangles="\n".join(faces))
    buffer = io.BytesIO()
    zipped = zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=6)
    with interrupts_held(), zipped as package:
        for file, text in (
            ("[Content_Types].xml", _CONTENT_TYPES),
            ("_rels/.rels", _RELATIONS),
            ("3D/3dmodel.model", model),
        ):
            entry = zipfile.ZipInfo(file, _NO_TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 0
            package.writestr(entry, text)
    return buffer.getvalue()


def _obj(points: Floats, triangles: Ints, name: str) -> bytes:
    vertices = [f"v {x} {y} {z}\n" for x, y, z in _decimals(points)]
    faces = [f"f {a} {b} {c}\n" for a, b, c in (triangles + 1).tolist()]
    called = [f"o {name}\n"] if name else []
    return "".join(["# mm, z up\n", *called, *vertices, *faces]).encode()


def _glb_chunk(kind: bytes, data: bytes, padding: bytes) -> bytes:
    data += padding * (-len(data) % 4)
    return struct.pack("<I", len(data)) + kind + data


def _glb(points: Floats, triangles: Ints, name: str) -> bytes:
    metres = np.column_stack([points[:, 0], points[:, 2], -points[:, 1]]) / 1000
    vertices = metres.astype("<f4") + np.float32(0)
    indices = triangles.astype("<u4").reshape(-1)
    split, end = vertices.nbytes, vertices.nbytes + indices.nbytes
    called = {"name": name} if name else {}
    scene = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, **called}],
        "meshes": [{**called, "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": end}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": split, "target": _GL_VERTICES},
            {"buffer": 0, "byteOffset": split, "byteLength": end - split, "target": _GL_INDICES},
        ],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": _GL_FLOAT,
                "count": len(vertices),
                "type": "VEC3",
                "min": vertices.min(axis=0).tolist(),
                "max": vertices.max(axis=0).tolist(),
            },
            {
                "bufferView": 1,
                "componentType": _GL_UNSIGNED_INT,
                "count": len(indices),
                "type": "SCALAR",
            },
        ],
    }
    text = json.dumps(scene, separators=(",", ":")).encode("ascii")
    body = _glb_chunk(_GLB_JSON, text, b" ")
    body += _glb_chunk(_GLB_BINARY, vertices.tobytes() + indices.tobytes(), b"\0")
    return _GLB_MAGIC + struct.pack("<II", _GLB_VERSION, 12 + len(body)) + body


_WRITERS: dict[str, Callable[[Floats, Ints, str], bytes]] = {
    "stl": _stl,
    "3mf": _3mf,
    "obj": _obj,
    "glb": _glb,
}

#: The formats that `mesh_bytes` writes.
FORMATS = tuple(_WRITERS)


def mesh_bytes(points: Floats, triangles: Ints, format: str, name: str = "") -> bytes:  # noqa: A002
    """Write a mesh in one of the `FORMATS`.

    Parameters
    ----------
    points
        ``(v, 3) float``, mm.
    triangles
        ``(m, 3) int``, counter-clockwise seen from outside; at least one.
    format
        ``stl`` (binary, float32, mm), ``3mf`` (mm), ``obj`` (mm) or ``glb`` (metres,
        y up).
    name
        What the part is called, on one line; STL has no names.

    Returns
    -------
    data
        The file; the same bytes for the same mesh.

    Raises
    ------
    InputError
        If the format is unknown, or the mesh is empty or not finite.
    """
    writer = _WRITERS.get(format)
    if writer is None:
        msg = f"unknown mesh format {format!r}; {', '.join(FORMATS)} work"
        raise InputError(msg)
    if not len(triangles) or not np.isfinite(points).all():
        msg = (
            f"a mesh of {len(triangles)} faces cannot be written; it needs faces and finite points"
        )
        raise InputError(msg)
    return writer(points, triangles, name)


def write_atomic(path: Path, data: bytes) -> None:
    """Put a file in place whole, or not at all; an existing one is replaced.

    Parameters
    ----------
    path
        Where to; through a symbolic link, what it leads to.
    data
        The content.

    Raises
    ------
    InputError
        If the file cannot be written.  Nothing is left behind, and a file that was
        there is as it was.
    """
    with _writing(path) as (target, beside):
        beside.write_bytes(data)
        beside.replace(target)


def check_writable(path: Path) -> None:
    """Refuse, before long work, where `write_atomic` could put no file.

    Raises
    ------
    InputError
        The file could not be written.  Nothing is changed.
    """
    with _writing(path) as (_, beside):
        beside.touch()


@contextmanager
def _writing(path: Path) -> Iterator[tuple[Path, Path]]:
    """Where a file goes, and a name beside it for the time until it is whole."""
    target = Path(os.path.realpath(path))
    beside = target.parent / f".{secrets.token_hex(8)}.part"
    try:
        if target.exists() and not target.is_file():
            msg = f"cannot write {str(path)!r}: it is not a file; name one that is, or a new one"
            raise InputError(msg)
        try:
            yield target, beside
        finally:
            beside.unlink(missing_ok=True)
    except OSError as error:
        works = "name one in a writable folder with space left"
        msg = f"cannot write {str(path)!r}: {error.strerror}; {works}"
        raise InputError(msg) from error
