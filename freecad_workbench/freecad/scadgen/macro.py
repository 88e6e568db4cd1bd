"""What a kit's macro does: opens the kit as a document, or brings an open one back to life.

The document has a spreadsheet of the live parameters, every part as a solid that follows it,
and the joint and the frame out of links to the parts.  The classes below live in the macro,
which is gone when the document is opened again; so documents do not name them: shapes stay as
they are until the macro runs again.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

import FreeCAD

from freecad.scadgen.cells import MOST_CELLS
from freecad.scadgen.kit_data import KitData, parse_kit
from freecad.scadgen.names import CELLS, label_of, property_of, role_alone
from freecad.scadgen.refusal import refuse
from freecad.scadgen.shape import make_shape, placed, put
from freecad.scadgen.sheet import COUNTS, parameters_sheet
from freecad.scadgen.tables import COLOURS, LENGTHS

__all__ = ["open_kit"]

#: The property by which the macro finds its objects again.
_MARK = "ScadgenMacro"

#: Room between things that stand side by side, in mm.
_ROOM = 10.0

#: Frames of more pieces are not shown at once: drawing them takes a while.
_SHOWN = 1000


class PartOfKit:
    """A part, evaluated at its own live parameters."""

    def __init__(self, obj: Any, kit: KitData) -> None:
        self._kit = kit
        self.solid = kit.parts[getattr(obj, _MARK)]
        self._made: list[float] | None = None
        _attach(self, obj)

    def execute(self, obj: Any) -> None:
        """Make the shape again if what moves it has changed.

        Raises
        ------
        ValueError
            A live parameter is out of its range: says which, and what works.
        """
        values = {name: getattr(obj, property_of(name)).Value for name in self._kit.values}
        if wrong := self._kit.check(values):
            refuse("; ".join(wrong))
        moving = [values[name] for name in self.solid.parameters]
        if moving != self._made:
            obj.Shape = make_shape(self.solid, values)
            self._made = moving


class PiecesOfFrame:
    """All pieces of a frame of one part and role: one link with many places."""

    def __init__(self, obj: Any, kit: KitData) -> None:
        self._kit = kit
        _attach(self, obj)

    def execute(self, obj: Any) -> None:
        """Put the pieces where they stand at these rows and columns and this edge length.

        Raises
        ------
        ValueError
            There cannot be so many cells.
        """
        role, _, part = getattr(obj, _MARK).partition(" ")
        counts = [getattr(obj, name, 0) for name in COUNTS]
        for name, count in zip(COUNTS.values(), counts):
            if self._kit.has_cells and not 1 <= count <= MOST_CELLS:
                refuse(f"{name} = {count}: must be a whole number from 1 to {MOST_CELLS}")
        edge_length = obj.EdgeLength.Value
        places = self._kit.placements(*counts)
        own = [p for p in places if (p["role"], p["part"]) == (role, part)]
        put(obj, [placed(place, edge_length) for place in own])


def open_kit(text: str) -> Any:
    """Open a kit as a document, or take up the active one if it was made of the same kit.

    Parameters
    ----------
    text
        The text of ``kit.json``.

    Returns
    -------
    document
        FreeCAD's document, recomputed.

    Raises
    ------
    KitError
        The text is not a sound kit.
    """
    kit = parse_kit(text)
    mark = hashlib.sha256(text.encode()).hexdigest()
    document = FreeCAD.ActiveDocument
    if document is None or not _marked(document, mark):
        document = _new(kit, mark)
    else:
        _revive(document, kit)
    document.recompute()
    _show(document)
    return document


def _marked(document: Any, mark: str) -> bool:
    """Whether a document was made of the kit that has this mark."""
    sheets = document.findObjects("Spreadsheet::Sheet")
    return any(getattr(sheet, _MARK, "") == mark for sheet in sheets)


def _new(kit: KitData, mark: str) -> Any:
    """A document of a kit."""
    document = FreeCAD.newDocument(f"{kit.name}_{kit.key}")
    sheet = parameters_sheet(document, kit)
    _add(sheet, "App::PropertyString", _MARK, "What the macro knows it by", mark)
    document.recompute()
    parts = _parts(document, kit, sheet)
    document.recompute()
    boxes = [parts[name].Shape.BoundBox for joint in kit.joints for name in joint["connectors"]]
    reach = max(max(box.XMax, -box.XMin, box.YMax) for box in boxes)
    _in_a_row(parts.values(), -reach - _ROOM)
    for number, joint in enumerate(kit.joints):
        _joint(document, kit, joint, parts, number * (2 * reach + _ROOM))
    places = kit.placements(kit.rows, kit.columns)
    low = min(place["at"][1] for place in places) * kit.values["edge_length"]
    group = _frame(document, kit, parts, sheet)
    group.Placement.Base = FreeCAD.Vector(0, 2 * reach + _ROOM - low, 0)
    group.Visibility = len(places) <= _SHOWN
    return document


def _revive(document: Any, kit: KitData) -> None:
    """Give the objects of a document their behaviour back."""
    for obj in document.Objects:
        if _MARK in obj.PropertiesList and obj.TypeId == "Part::FeaturePython":
            PartOfKit(obj, kit)
            obj.touch()
        elif _MARK in obj.PropertiesList and obj.TypeId == "App::LinkPython":
            PiecesOfFrame(obj, kit)
            obj.touch()


def _parts(document: Any, kit: KitData, sheet: Any) -> dict[str, Any]:
    """Every part as a solid that follows the spreadsheet."""
    group = document.addObject("App::DocumentObjectGroup", "Parts")
    parts = {}
    for name in kit.parts:
        obj = document.addObject("Part::FeaturePython", name)
        obj.Label = label_of(kit.parts[name])
        _add(obj, "App::PropertyString", _MARK, "The part of the kit", name)
        for parameter in kit.values:
            own = property_of(parameter)
            # A PropertyLength would take a negative value for 0.
            _add(obj, "App::PropertyDistance", own, LENGTHS[parameter][1], kit.values[parameter])
            obj.setExpression(own, f"{sheet.Name}.{parameter}")
        _draw_as_usual(obj)
        PartOfKit(obj, kit)
        group.addObject(obj)
        parts[name] = obj
    return parts


def _in_a_row(parts: Iterable[Any], top: float) -> None:
    """Lay parts out one below the other."""
    for obj in parts:
        box = obj.Shape.BoundBox
        obj.Placement.Base = FreeCAD.Vector(0, top - box.YMax, 0)
        top -= box.YLength + _ROOM


def _joint(
    document: Any, kit: KitData, joint: Mapping[str, Any], parts: Mapping[str, Any], x: float
) -> None:
    """The pieces of a kind of joint, assembled."""
    group = document.addObject("App::Part", f"Joint{joint['name']}")
    group.Placement.Base = FreeCAD.Vector(x, 0, 0)
    seen: Counter[str] = Counter()
    for place in joint["pieces"]:
        role = place["role"]
        link = document.addObject("App::Link", role)
        link.LinkedObject = parts[place["part"]]
        link.Placement = placed(place, kit.values["edge_length"])
        group.addObject(link)
        _paint(link, role, lighter=0.25 * seen[role])
        seen[role] += 1


def _frame(document: Any, kit: KitData, parts: Mapping[str, Any], sheet: Any) -> Any:
    """The whole frame: one link for each part and role, with as many places as pieces."""
    group = document.addObject("App::Part", "Frame")
    for role, part in kit.frame_pieces:
        link = document.addObject("App::LinkPython", f"frame_{role}")
        link.LinkedObject = parts[part]
        link.ShowElement = False
        _add(
            link, "App::PropertyString", _MARK, "The role and part of its pieces", f"{role} {part}"
        )
        _add(link, "App::PropertyDistance", "EdgeLength", LENGTHS["edge_length"][1], 0.0)
        link.setExpression("EdgeLength", f"{sheet.Name}.edge_length")
        for own, alias in COUNTS.items() if kit.has_cells else ():
            _add(link, "App::PropertyInteger", own, CELLS[own], getattr(kit, alias))
            link.setExpression(own, f"{sheet.Name}.{alias}")
        _draw_as_usual(link)
        PiecesOfFrame(link, kit)
        group.addObject(link)
        _paint(link, role)
    return group


def _attach(proxy: Any, obj: Any) -> None:
    """Make an object behave; the document does not keep the proxy."""
    obj.Proxy = proxy
    obj.setPropertyStatus("Proxy", "Transient")


def _add(obj: Any, kind: str, name: str, text: str, value: object) -> None:
    obj.addProperty(kind, name, "Scadgen", text)
    setattr(obj, name, value)


def _paint(link: Any, role: str, lighter: float = 0.0) -> None:
    """Give a link the colour of its role, where there is something to see."""
    if FreeCAD.GuiUp:
        material = link.ViewObject.ShapeMaterial
        material.DiffuseColor = tuple(c + lighter * (1 - c) for c in _colour(role))
        link.ViewObject.OverrideMaterial = True
        link.ViewObject.ShapeMaterial = material


def _colour(role: str) -> tuple[float, ...]:
    return tuple(c / 255 for c in COLOURS[role])


def _draw_as_usual(obj: Any) -> None:
    """Leave drawing to FreeCAD, which draws no scripted object before it was told who does."""
    if FreeCAD.GuiUp:
        obj.ViewObject.Proxy = 0


def _show(document: Any) -> None:
    """Look at all of it."""
    if FreeCAD.GuiUp:
        import FreeCADGui

        for obj in document.findObjects("Part::FeaturePython"):
            obj.ViewObject.ShapeColor = _colour(role_alone(obj.Proxy.solid))
            obj.ViewObject.DisplayMode = "Shaded"  # walls have more edges than one can see
            obj.ViewObject.Visibility = True  # what is linked to was hidden
        FreeCADGui.activeDocument().activeView().viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")
