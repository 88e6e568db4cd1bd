"""A part of a kit: one solid, evaluated at its own live parameters."""

from __future__ import annotations

import hashlib
from typing import Any

import FreeCAD as App

from freecad.scadgen.figures import mass
from freecad.scadgen.kit_data import KitData, KitError
from freecad.scadgen.kit_object import bill_of, data_of
from freecad.scadgen.names import property_of
from freecad.scadgen.properties import (
    DERIVED,
    HIDDEN,
    Scripted,
    add,
    length_properties,
    refuse,
    values_of,
)
from freecad.scadgen.shape import make_shape

__all__ = ["PartObject", "follow", "follows", "own"]

QT_TRANSLATE_NOOP = App.Qt.QT_TRANSLATE_NOOP


class PartObject(Scripted):
    """A part.  Its live parameters follow the kit's by expressions until they are cleared."""

    kind = "part"

    def __init__(self, obj: Any, kit: Any, kind: str) -> None:
        super().__init__(obj)
        obj.Kit = kit
        data = data_of(kit)
        obj.Kind = [*data.parts]
        obj.Kind = kind
        obj.BomName = f"{data.name} {kind}"
        length_properties(obj, values_of(kit, data))
        for parameter in data.values:
            follow(obj, parameter)
        obj.setExpression("Density", f"{kit.Name}.Density")

    def set_up(self, obj: Any) -> None:
        """Add the properties that are missing, with their defaults."""
        super().set_up(obj)
        if not obj.hasExtension("Part::AttachExtensionPython"):
            obj.addExtension("Part::AttachExtensionPython")
        text = QT_TRANSLATE_NOOP("App::Property", "The kit that the part belongs to")
        add(obj, "App::PropertyLink", "Kit", "Part", text, 0)
        text = QT_TRANSLATE_NOOP("App::Property", "Which part of the kit it is")
        add(obj, "App::PropertyEnumeration", "Kind", "Part", text, 0)
        text = QT_TRANSLATE_NOOP("App::Property", "Name in a bill of materials")
        add(obj, "App::PropertyString", "BomName", "Part", text, 0)
        text = QT_TRANSLATE_NOOP("App::Property", "Pieces that the kit's frame needs")
        add(obj, "App::PropertyInteger", "Count", "Part", text, DERIVED)
        text = QT_TRANSLATE_NOOP("App::Property", "Density of the material, in g/cm3")
        add(obj, "App::PropertyFloat", "Density", "Material", text, 0, 1.24)
        text = QT_TRANSLATE_NOOP("App::Property", "Volume of the part")
        add(obj, "App::PropertyVolume", "Volume", "Material", text, DERIVED)
        text = QT_TRANSLATE_NOOP("App::Property", "Mass of the part printed solid, in g")
        add(obj, "App::PropertyFloat", "Mass", "Material", text, DERIVED)
        text = QT_TRANSLATE_NOOP("App::Property", "What the shape was made of")
        add(obj, "App::PropertyString", "ShapeKey", "Scadgen", text, HIDDEN)

    def compute(self, obj: Any) -> None:
        """Make the shape again if anything that moves it has changed.

        Raises
        ------
        KitError
            The kit is gone, or a live parameter is out of its range: the shape is kept.
        """
        if obj.Kit is None:
            msg = f"{obj.Label}: its kit is gone; undo, or set the property Kit"
            raise KitError(msg)
        data = data_of(obj.Kit)
        values = values_of(obj, data)
        refuse(data, values)
        key = _key(obj, data, values)
        if key != obj.ShapeKey or obj.Shape.isNull():
            obj.Shape = make_shape(data.parts[obj.Kind], values)
            obj.ShapeKey, obj.Volume = key, obj.Shape.Volume
        obj.Mass = round(mass(obj.Volume.Value, obj.Density), 3)
        obj.Count = bill_of(obj.Kit).get(obj.Kind, 0)
        obj.positionBySupport()


def _key(obj: Any, data: KitData, values: dict[str, float]) -> str:
    """What the shape depends on, in short."""
    moving = [values[name] for name in data.parts[obj.Kind].parameters]
    text = "\n".join((obj.Kind, repr(moving), obj.Kit.Data))
    return hashlib.sha256(text.encode()).hexdigest()


def follow(part: Any, parameter: str) -> None:
    """Let a live parameter of a part be the kit's."""
    name = property_of(parameter)
    part.setExpression(name, f"{part.Kit.Name}.{name}")


def own(part: Any, parameter: str, value: float | None = None) -> None:
    """Let a part have a live parameter of its own, in mm; as it is unless a value is given."""
    name = property_of(parameter)
    part.setExpression(name, None)
    if value is not None:
        setattr(part, name, value)


def follows(part: Any, parameter: str) -> bool:
    """Whether a live parameter of a part is the kit's."""
    name = property_of(parameter)
    return (name, f"{part.Kit.Name}.{name}") in part.ExpressionEngine
