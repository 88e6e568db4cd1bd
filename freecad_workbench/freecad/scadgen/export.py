"""Writes what is selected, or all that a kit needs, as STEP, STL or 3MF."""

from __future__ import annotations

import csv
import io
import re
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, List, Tuple

import FreeCAD as App
import Part

from freecad.scadgen.document import kind_of
from freecad.scadgen.figures import mass, volume
from freecad.scadgen.kit_data import KitError
from freecad.scadgen.kit_object import bill_of, data_of
from freecad.scadgen.mesh_files import Body, Matrix, stl, threemf
from freecad.scadgen.plates import plates
from freecad.scadgen.properties import refuse, values_of
from freecad.scadgen.shape import make_shape

__all__ = ["FORMATS", "selection_files", "whole_files", "write"]

#: The formats, by the ending of their files.
FORMATS = ("step", "stl", "3mf")

#: Parts, and where they stand.
Placed = List[Tuple[Any, Any]]

#: What makes each STEP file another: the time of writing, and a running number for a name.
_STEP_TIME = re.compile(rb"(FILE_NAME\('[^']*',')[^']*'")
_STEP_NAME = re.compile(rb"'Open CASCADE STEP translator [^']*'")


def selection_files(objects: Iterable[Any], kind: str) -> dict[str, bytes]:
    """Files of parts and assemblies, as they stand in the document.

    Parameters
    ----------
    objects
        Parts, joints, frames, or links to parts.
    kind
        One of `FORMATS`; a 3MF holds all of them, other formats are a file each.

    Returns
    -------
    files
        Content by file name.

    Raises
    ------
    KitError
        There is nothing, something else, or a part that is not sound.
    """
    chosen = {obj.Label: _pieces(obj) for obj in objects}
    if not chosen:
        msg = "nothing is selected: select parts, joints or frames, or export the whole kit"
        raise KitError(msg)
    if kind == "3mf":
        pieces = [piece for found in chosen.values() for piece in found]
        name = _file_name(next(iter(chosen)) if len(chosen) == 1 else "selection")
        return {f"{name}.3mf": threemf(_bodies(pieces))}
    files: dict[str, bytes] = {}
    for label, found in chosen.items():
        name = f"{_file_name(label)}.{kind}"
        if name in files:
            msg = f"{name}: two of what is selected would be this file; give one another label"
            raise KitError(msg)
        shapes = [part.Shape.Solids[0] for part, _ in found]
        files[name] = stl(_bodies(found)) if kind == "stl" else _step(label, shapes, found)
    return files


def whole_files(kit: Any, kind: str, bed: tuple[float, float]) -> dict[str, bytes]:
    """Files of all that a kit's frame needs, and ``bill.csv``.

    Parameters
    ----------
    kit
        The kit object.
    kind
        One of `FORMATS`.  STEP and STL are a file a part with the count in its name; 3MF is a
        file a printer bed with all pieces laid out.
    bed
        Width and depth of the bed, in mm.

    Returns
    -------
    files
        Content by file name.

    Raises
    ------
    KitError
        A live parameter is out of its range, or a part is larger than the bed.
    """
    data = data_of(kit)
    values = values_of(kit, data)
    refuse(data, values)
    still = _matrix(App.Placement())
    bodies = [
        Body(part, data.parts[part].points(values), data.parts[part].triangles, [still] * count)
        for part, count in bill_of(kit).items()
    ]
    files = {"bill.csv": _bill(bodies, kit)}
    if kind == "3mf":
        for n, plate in enumerate(plates(bodies, bed), 1):
            files[f"{data.name}_plate_{n}.3mf"] = threemf(plate)
        return files
    for body in bodies:
        name = f"{data.name}_{body.name}_x{len(body.places)}.{kind}"
        if kind == "stl":
            files[name] = stl([body._replace(places=[still])])
        else:
            files[name] = _step(body.name, [make_shape(data.parts[body.name], values)])
    return files


def write(files: dict[str, bytes], folder: Path) -> None:
    """Put files into a folder, each whole or not at all.

    Raises
    ------
    KitError
        The folder cannot be written to.
    """
    try:
        with tempfile.TemporaryDirectory(dir=folder, prefix=".scadgen-") as place:
            for name, content in files.items():
                (Path(place) / name).write_bytes(content)
            for name in files:
                (Path(place) / name).replace(folder / name)
    except OSError as error:
        msg = f"{folder}: cannot be written to ({error.strerror}); choose another folder"
        raise KitError(msg) from error


def _pieces(obj: Any) -> Placed:
    """The parts that an object consists of, and where they stand.

    Raises
    ------
    KitError
        It has none, or one of them is not sound.
    """
    if kind_of(obj) == "part":
        found = [(obj, _global(obj))]
    elif kind_of(obj) == "assembly":
        found = [piece for link in obj.Group for piece in _pieces(link)]
    elif obj.isDerivedFrom("App::Link") and kind_of(obj.LinkedObject) == "part":
        places = _shown(obj) if obj.ElementCount else [App.Placement()]
        found = [(obj.LinkedObject, _global(obj).multiply(place)) for place in places]
    else:
        msg = f"{obj.Label}: not a part, joint or frame of a kit; select one, or the whole kit"
        raise KitError(msg)
    for part, _ in found:
        if not part.isValid() or part.Shape.isNull():
            msg = f"{part.Label}: not sound ({part.getStatusString()}); put it right first"
            raise KitError(msg)
    return found


def _shown(link: Any) -> list[Any]:
    """Where a link shows what it links to."""
    return [p for n, p in enumerate(link.PlacementList) if link.isElementVisible(str(n))]


def _global(obj: Any) -> Any:
    """Where an object stands, through all groups that it is in."""
    place, group = obj.Placement, obj.getParentGeoFeatureGroup()
    while group is not None:
        place, group = group.Placement.multiply(place), group.getParentGeoFeatureGroup()
    return place


def _bodies(pieces: Placed) -> list[Body]:
    """One body a part, with all places where it stands."""
    places: dict[str, list[Matrix]] = {}
    parts = {part.Name: part for part, _ in pieces}
    for part, place in pieces:
        places.setdefault(part.Name, []).append(_matrix(place))
    bodies = []
    for name, part in parts.items():
        data = data_of(part.Kit)
        solid = data.parts[part.Kind]
        points = solid.points(values_of(part, data))
        bodies.append(Body(part.Label, points, solid.triangles, places[name]))
    return bodies


def _matrix(place: Any) -> Matrix:
    """A placement, as rows that a point is multiplied with."""
    turn = [place.Rotation.multVec(axis) for axis in (App.Vector(*row) for row in _AXES)]
    return (*(c for axis in turn for c in axis), *place.Base)


_AXES = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def _step(name: str, shapes: Sequence[Any], pieces: Iterable[tuple[Any, Any]] = ()) -> bytes:
    """Shapes as STEP, in place if places are given; the same bytes for the same shapes."""
    for shape, (_, place) in zip(shapes, pieces):
        shape.Placement = place
    whole = shapes[0] if len(shapes) == 1 else Part.makeCompound([*shapes])
    with tempfile.TemporaryDirectory(prefix="scadgen-") as place:
        path = Path(place) / "part.step"
        whole.exportStep(str(path))
        text = _STEP_TIME.sub(rb"\g<1>1970-01-01T00:00:00'", path.read_bytes(), count=1)
        return _STEP_NAME.sub(f"'{_file_name(name)}'".encode("ascii", "replace"), text)


def _bill(bodies: Iterable[Body], kit: Any) -> bytes:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("name", "part", "count", "volume_mm3", "mass_g"))
    for body in bodies:
        each = volume(body.points, body.triangles)
        grams = mass(each, kit.Density)
        name = f"{kit.Frame} {body.name}"
        row = (name, body.name, len(body.places), f"{each:.3f}", f"{grams:.3f}")
        writer.writerow(row)
    return text.getvalue().encode()


def _file_name(label: str) -> str:
    return re.sub(r"[^\w.-]+", "_", label).strip("_.") or "part"
