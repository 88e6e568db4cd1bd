"""A joint or a frame: links to the parts of a kit, each where it stands."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from freecad.scadgen.kit_data import KitError
from freecad.scadgen.kit_object import data_of
from freecad.scadgen.names import CELLS
from freecad.scadgen.properties import (
    DERIVED,
    FIXED,
    HIDDEN,
    Scripted,
    add,
    cell_properties,
    frame_of,
)
from freecad.scadgen.shape import placed, put
from freecad.scadgen.tables import COLOURS

__all__ = ["AssemblyObject", "parts_of", "placements_of"]

QT_TRANSLATE_NOOP = App.Qt.QT_TRANSLATE_NOOP

#: How far an assembly is pulled apart, in sides: value, lowest, highest, step.
_APART = (0.0, 0.0, 100.0, 0.5)


class AssemblyObject(Scripted):
    """A joint or a frame, with one array of links for each part and role in it."""

    kind = "assembly"

    def __init__(self, obj: Any, kit: Any, joint: str | None) -> None:
        super().__init__(obj)
        obj.Kit = kit
        if joint is not None:
            obj.Layout, obj.Joint = "joint", joint
        else:
            obj.Layout = "frame"
            obj.setEditorMode("Joint", 2)
            if data_of(kit).has_cells:
                cell_properties(obj, "Assembly", kit.Rows, kit.Columns)
                for name in CELLS:
                    obj.setExpression(name, f"{kit.Name}.{name}")

    def set_up(self, obj: Any) -> None:
        """Add the properties that are missing, with their defaults."""
        super().set_up(obj)
        if not obj.hasExtension("App::GeoFeatureGroupExtensionPython"):
            obj.addExtension("App::GeoFeatureGroupExtensionPython")
        text = QT_TRANSLATE_NOOP("App::Property", "The kit whose parts stand here")
        add(obj, "App::PropertyLink", "Kit", "Assembly", text, 0)
        text = QT_TRANSLATE_NOOP("App::Property", "A joint, or a frame")
        add(obj, "App::PropertyString", "Layout", "Assembly", text, HIDDEN, "joint")
        text = QT_TRANSLATE_NOOP("App::Property", "Which kind of joint")
        add(obj, "App::PropertyString", "Joint", "Assembly", text, FIXED)
        text = QT_TRANSLATE_NOOP("App::Property", "How far it is pulled apart, in sides")
        add(obj, "App::PropertyFloatConstraint", "Explode", "Assembly", text, 0, _APART)
        text = QT_TRANSLATE_NOOP("App::Property", "Number of pieces")
        add(obj, "App::PropertyInteger", "Pieces", "Assembly", text, DERIVED)

    def compute(self, obj: Any) -> None:
        """Put each piece where it stands.

        Raises
        ------
        KitError
            The kit is gone, or broken.
        """
        if obj.Kit is None:
            msg = f"{obj.Label}: its kit is gone; undo, or set the property Kit"
            raise KitError(msg)
        found = placements_of(obj)
        for link in obj.Group:
            if role := getattr(link, "Role", ""):
                put(link, found.get((role, link.Piece), []))
                link.purgeTouched()
        obj.Pieces = sum(len(places) for places in found.values())


def _layout(obj: Any) -> list[dict[str, Any]]:
    """All placements of an assembly."""
    data = data_of(obj.Kit)
    return data.pieces(obj.Joint) if obj.Layout == "joint" else frame_of(obj, data)


def parts_of(obj: Any) -> list[tuple[str, str]]:
    """Role and part of whatever there is in an assembly."""
    if obj.Layout == "frame":
        return data_of(obj.Kit).frame_pieces
    return list(dict.fromkeys((p["role"], p["part"]) for p in _layout(obj)))


def placements_of(obj: Any) -> dict[tuple[str, str], list[Any]]:
    """Where the pieces of each role and part stand, in the assembly's own coordinates.

    Pulled apart, vertices draw away from each other by two explosions an edge, and each
    piece moves along its edge; halves by half of it, and to their own sides.
    """
    side, edge = obj.Kit.Side.Value, obj.Kit.EdgeLength.Value
    apart = obj.Explode * side
    pitch = edge + 2 * apart
    ways = _ways(obj)
    found: dict[tuple[str, str], list[Any]] = {}
    for p in _layout(obj):
        place = placed(p, pitch)
        place.Base += place.Rotation.multVec(ways[p["role"]] * apart)
        found.setdefault((p["role"], p["part"]), []).append(place)
    return found


def _ways(obj: Any) -> dict[str, Any]:
    """How far a piece of each role moves along its edge and to its side, in explosions."""
    data = data_of(obj.Kit)
    half = data.joints[0]["pieces"][0]["part"]
    points = data.parts[half].points(data.values)
    left = 0.5 if sum(y for _, y, _ in points) > 0 else -0.5
    ways = dict.fromkeys(COLOURS, App.Vector(1, 0, 0))
    ways["half_a"] = ways["half_b"] = App.Vector(0.5, left, 0)
    if data.key == "loose":
        ways["peg"] = App.Vector(0.75, 0, 0)
    return ways
