"""A joint or a frame: links to the parts of a kit, each where it stands."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from freecad.scadgen.affine import KitError
from freecad.scadgen.kit_object import data_of
from freecad.scadgen.layout import LAYOUTS, MOST_CELLS
from freecad.scadgen.names import COLOURS
from freecad.scadgen.properties import DERIVED, HIDDEN, Scripted, add
from freecad.scadgen.shape import placed

__all__ = ["AssemblyObject", "parts_of", "placements_of"]

QT_TRANSLATE_NOOP = App.Qt.QT_TRANSLATE_NOOP

#: How far an assembly is pulled apart, in sides: value, lowest, highest, step.
_APART = (0.0, 0.0, 100.0, 0.5)


class AssemblyObject(Scripted):
    """A joint or a frame, with one array of links for each role in it."""

    kind = "assembly"

    def __init__(self, obj: Any, kit: Any, layout: str) -> None:
        super().__init__(obj)
        obj.Kit, obj.Layout = kit, layout
        if layout == "frame":
            for name in ("Rows", "Columns"):
                obj.setExpression(name, f"{kit.Name}.{name}")
        else:
            for name in ("Rows", "Columns"):
                obj.setEditorMode(name, 2)

    def set_up(self, obj: Any) -> None:
        """Add the properties that are missing, with their defaults."""
        super().set_up(obj)
        if not obj.hasExtension("App::GeoFeatureGroupExtensionPython"):
            obj.addExtension("App::GeoFeatureGroupExtensionPython")
        text = QT_TRANSLATE_NOOP("App::Property", "The kit whose parts stand here")
        add(obj, "App::PropertyLink", "Kit", "Assembly", text, 0)
        text = QT_TRANSLATE_NOOP("App::Property", "A joint, or a frame")
        add(obj, "App::PropertyString", "Layout", "Assembly", text, HIDDEN, "joint")
        for name, text in (
            ("Rows", QT_TRANSLATE_NOOP("App::Property", "Cells of the frame up")),
            ("Columns", QT_TRANSLATE_NOOP("App::Property", "Cells of the frame across")),
        ):
            limits = (2, 1, MOST_CELLS, 1)
            add(obj, "App::PropertyIntegerConstraint", name, "Assembly", text, 0, limits)
        text = QT_TRANSLATE_NOOP("App::Property", "How far it is pulled apart, in sides")
        add(obj, "App::PropertyFloatConstraint", "Explode", "Assembly", text, 0, _APART)
        text = QT_TRANSLATE_NOOP("App::Property", "Number of pieces")
        add(obj, "App::PropertyInteger", "Pieces", "Assembly", text, DERIVED)

    def compute(self, obj: Any) -> None:
        """Put each piece where it stands.

        Raises
        ------
        KitError
            The kit is gone.
        """
        if obj.Kit is None:
            msg = f"{obj.Label}: its kit is gone; undo, or set the property Kit"
            raise KitError(msg)
        found = placements_of(obj)
        for link in obj.Group:
            places = found.get(getattr(link, "Role", ""))
            if places:
                link.ElementCount = len(places)
                link.PlacementList = places
                link.purgeTouched()
        obj.Pieces = sum(len(places) for places in found.values())


def _layout(obj: Any) -> list[dict[str, Any]]:
    """All placements of an assembly."""
    if obj.Layout == "joint":
        return data_of(obj.Kit).joint
    return LAYOUTS[obj.Kit.Frame](obj.Rows, obj.Columns, obj.Kit.Key)


def parts_of(obj: Any) -> dict[str, str]:
    """The part of each role that there is in an assembly."""
    return {p["role"]: p["part"] for p in _layout(obj)}


def placements_of(obj: Any) -> dict[str, list[Any]]:
    """Where the pieces of each role stand, in the assembly's own coordinates.

    Pulled apart, vertices draw away from each other by two explosions an edge, and each
    piece moves along its edge; halves by half of it, and to their own sides.
    """
    side, edge = obj.Kit.Side.Value, obj.Kit.EdgeLength.Value
    apart = obj.Explode * side
    pitch = edge + 2 * apart
    ways = _ways(obj)
    found: dict[str, list[Any]] = {}
    for p in _layout(obj):
        place = placed(p, pitch)
        place.Base += place.Rotation.multVec(ways[p["role"]] * apart)
        found.setdefault(p["role"], []).append(place)
    return found


def _ways(obj: Any) -> dict[str, Any]:
    """How far a piece of each role moves along its edge and to its side, in explosions."""
    data = data_of(obj.Kit)
    points = data.parts["half"].points(data.values)
    left = 0.5 if sum(y for _, y, _ in points) > 0 else -0.5
    ways = dict.fromkeys(COLOURS, App.Vector(1, 0, 0))
    ways["half_a"] = ways["half_b"] = App.Vector(0.5, left, 0)
    if data.key == "loose":
        ways["peg"] = App.Vector(0.75, 0, 0)
    return ways
