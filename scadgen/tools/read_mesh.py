"""Reads the parts of a puzzle from mesh files: every body in them, checked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from scadgen.errors import InputError, ToolError
from scadgen.interlock.bodies import bodies, open_edges, unpinched
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.crossing import crossing_faces
from scadgen.solid.mesh import FLAT, heights, volume
from scadgen.tools.stl import nothing_inside, read_stl, read_text_stl

__all__ = ["FORMATS", "MeshPart", "read_parts"]

#: The endings of files that can be read.
FORMATS = ("stl", "3mf", "obj", "ply", "off")

#: Those of them whose objects have names.
_NAMED = ("3mf", "obj")

#: How many times smaller than the largest a part may be: a metre is 1000 mm.
_UNITS = 500.0

#: How deep faces must cross to count, as a share of the part's diagonal: float32 rounds
#: coordinates by 1e-7 of their size.
_DEEP = 1e-5

_Mesh = tuple[Floats, Ints]


class MeshPart(NamedTuple):
    """A part, and where it is from.

    Parameters
    ----------
    name
        What it is called; no other part has that name.
    path
        The file that it is in.
    mesh
        Its points ``(v, 3) float`` and triangles ``(m, 3) int``.
    """

    name: str
    path: Path
    mesh: _Mesh


def read_parts(paths: Sequence[Path]) -> list[MeshPart]:
    """Read the parts in some files.

    Parameters
    ----------
    paths
        STL, 3MF, OBJ, PLY or OFF files.

    Returns
    -------
    parts
        They are called as their file without its ending; if it has several bodies, as its
        objects or groups in 3MF or OBJ, or its solids in STL as text, where each name is one
        of a kind, else .1, .2 and so on after the file's.  3MF is turned into mm; the others
        have no unit and are left as they are.  A part that touches itself is split there.

    Raises
    ------
    InputError
        A file that cannot be read or has no faces, a part that is not closed, is flat, is
        inside out or crosses itself, parts of one name, or of sizes that cannot be in one unit.
    """
    files = [(path, _named_bodies(path)) for path in paths]
    names = Counter(name for _, found in files for name, _ in found)
    parts: dict[str, MeshPart] = {}
    for path, found in files:
        named = all(name and names[name] == 1 for name, _ in found)
        for number, (own, mesh) in enumerate(found, 1):
            name = own if named else f"{path.stem}.{number}"
            name = name if len(found) > 1 else path.stem
            if name in parts:
                msg = f"{path}: there is a part {name} already: files must have different names"
                raise InputError(msg)
            parts[name] = MeshPart(name, path, mesh)
    _check_sizes([*parts.values()])
    return [*parts.values()]


def _named_bodies(path: Path) -> list[tuple[str, _Mesh]]:
    """Read the bodies in one file, and names after the objects that they are in."""
    found = []
    for name, given in _objects(path):
        points, triangles = _welded(path, *given)
        if len(faulty := open_edges(triangles)):
            place = _place(points[faulty[0]].mean(axis=0))
            msg = f"{path}: not closed: {len(faulty)} open edges, one at {place}; repair it first"
            raise InputError(msg)
        several = bodies(points, triangles)
        for number, faces in enumerate(several, 1):
            used, numbers = np.unique(triangles[faces], return_inverse=True)
            body = points[used], numbers.reshape(-1, 3)
            _check_body(path, *body)
            called = f"{name}.{number}" if name and len(several) > 1 else name
            found.append((called, unpinched(*body)))
    if not found:
        msg = f"{path}: has no faces"
        raise InputError(msg)
    return found


def _objects(path: Path) -> Iterator[tuple[str, _Mesh]]:
    """Meshes in a file, in its order, with their names or none."""
    kind = path.suffix.lower().lstrip(".")
    if kind not in FORMATS:
        msg = f"{path}: must be one of {', '.join(FORMATS)}"
        raise InputError(msg)
    try:
        with path.open("rb") as file:
            head = file.read(84)
    except OSError as error:
        msg = f"{path}: cannot be read: {error.strerror}"
        raise InputError(msg) from error
    if kind != "stl":
        yield from _by_trimesh(path, kind)
        return
    size = 84 + 50 * int.from_bytes(head[80:84], "little")
    try:
        if len(head) == 84 and path.stat().st_size == size:
            yield "", read_stl(path)
        else:
            yield from _solids(path)
    except ToolError as error:
        raise InputError(str(error)) from error


def _solids(path: Path) -> Iterator[tuple[str, _Mesh]]:
    """The solids of an STL as text; all as one where they are patches of one surface."""
    found = [
        (name, _welded(path, corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3)))
        for name, corners in read_text_stl(path)
        if len(corners)
    ]
    if len(found) > 1 and all(not len(open_edges(mesh[1])) for _, mesh in found):
        yield from found
    elif found:
        start = np.cumsum([0, *(len(points) for _, (points, _) in found)])
        points = np.concatenate([points for _, (points, _) in found])
        numbered = [t + n for (_, (_, t)), n in zip(found, start, strict=False)]
        yield "", (points, np.concatenate(numbered))


def _by_trimesh(path: Path, kind: str) -> Iterator[tuple[str, _Mesh]]:
    """What trimesh finds in a file, in mm if the file has a unit."""
    found = _loaded(path, kind)
    for split in ("split_groups", "split_objects") if kind == "obj" else ():
        # Objects and groups may also be patches of one surface: then only the whole is closed.
        apart = _loaded(path, kind, {split: True, "group_material": False})
        closed = (len(open_edges(_welded(path, *mesh)[1])) == 0 for _, mesh in apart)
        if len(apart) > 1 and all(closed):
            found = apart
    yield from found


def _loaded(path: Path, kind: str, how: dict[str, bool] | None = None) -> list[tuple[str, _Mesh]]:
    """Names, points and triangles as trimesh reads them."""
    import trimesh  # slow to import

    try:
        scene = trimesh.load_scene(path, file_type=kind, process=False, **(how or {}))  # type: ignore[arg-type]
        unit = scene.units if kind == "3mf" else None
        scale = float(trimesh.units.unit_conversion(unit, "mm")) if unit else 1.0
        meshes = scene.dump()
    except Exception as error:  # whatever its readers raise on a broken file
        reason = " ".join(str(error).split()) or type(error).__name__
        msg = f"{path}: not a whole {kind.upper()} file ({reason})"
        raise InputError(msg) from error
    order = list(scene.geometry)
    found = []
    for mesh in meshes:
        if isinstance(mesh, trimesh.Trimesh):
            points = np.asarray(mesh.vertices, dtype=np.float64) * scale
            own, node = (str(mesh.metadata.get(key) or "") for key in ("name", "node"))
            place = order.index(own) if own in order else len(order)
            found.append((place, node, own, (points, np.asarray(mesh.faces, dtype=np.int64))))
    found.sort(key=lambda one: one[:2])
    # What has no name gets its number or the file's name for one.
    none = {path.name, *map(str, range(len(meshes) + 1))} if kind in _NAMED else set(order)
    return [("" if own in none else own.strip(), mesh) for _, _, own, mesh in found]


def _welded(path: Path, points: Floats, triangles: Ints) -> _Mesh:
    """Equal points as one, without the faces that collapse."""
    if not len(triangles):
        msg = f"{path}: has no faces"
        raise InputError(msg)
    if not np.isfinite(points).all():
        msg = f"{path}: a coordinate is not finite"
        raise InputError(msg)
    merged, where = np.unique(points + 0.0, axis=0, return_inverse=True)
    triangles = where.reshape(-1)[triangles]
    whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return merged, triangles[whole]


def _check_body(path: Path, points: Floats, triangles: Ints) -> None:
    """Refuse a body that is flat, is inside out or crosses itself."""
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    sound = triangles[heights(points, triangles) > FLAT * size]
    crossing = crossing_faces(points, sound, touch=-_DEEP * size)
    if len(crossing):
        place = _place(points[sound[crossing[0]]].mean(axis=(0, 1)))
        msg = f"{path}: crosses itself: {len(crossing)} pairs of faces, one near {place}"
        raise InputError(msg)
    if not (enclosed := volume(points, triangles)) > 0:
        why = nothing_inside(points, enclosed)
        msg = f"{path}: volume {enclosed:.6g}: must be above 0; {why}"
        raise InputError(msg)


def _check_sizes(parts: Sequence[MeshPart]) -> None:
    """Refuse parts that cannot be in one unit."""
    size = {part.name: float(np.linalg.norm(np.ptp(part.mesh[0], axis=0))) for part in parts}
    small, large = min(size, key=lambda n: size[n]), max(size, key=lambda n: size[n])
    if size[large] > _UNITS * size[small]:
        msg = (
            f"{large} is {size[large]:.6g} long and {small} {size[small]:.6g}: "
            f"must be in one unit, within {_UNITS:g} times of each other"
        )
        raise InputError(msg)


def _place(point: Floats) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in point.tolist()) + ")"
