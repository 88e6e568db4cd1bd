"""The kit in a document: its text, its live parameters, and what there is to print."""

from __future__ import annotations

from collections import Counter
from functools import lru_cache
from typing import Any

import FreeCAD as App

from freecad.scadgen.figures import mass, volume
from freecad.scadgen.kit_data import KitData, parse_kit
from freecad.scadgen.properties import (
    DERIVED,
    FIXED,
    HIDDEN,
    Scripted,
    add,
    cell_properties,
    frame_of,
    length_properties,
    refuse,
    values_of,
)

__all__ = ["KitObject", "bill_of", "data_of"]

QT_TRANSLATE_NOOP = App.Qt.QT_TRANSLATE_NOOP


class KitObject(Scripted):
    """A kit.  Its ``kit.json`` travels in the document as the property `Data`."""

    kind = "kit"

    def __init__(self, obj: Any, text: str, density: float) -> None:
        super().__init__(obj)
        obj.Data, obj.Density = text, density
        self.fill(obj)

    def set_up(self, obj: Any) -> None:
        """Add the properties that are missing, with their defaults."""
        super().set_up(obj)
        text = QT_TRANSLATE_NOOP("App::Property", "The text of kit.json")
        add(obj, "App::PropertyString", "Data", "Scadgen", text, HIDDEN)
        for name, text in (
            ("Frame", QT_TRANSLATE_NOOP("App::Property", "What the kit's files are called")),
            ("Key", QT_TRANSLATE_NOOP("App::Property", "Pegs fixed to tubes, or loose")),
            ("Detail", QT_TRANSLATE_NOOP("App::Property", "How finely walls are cut up")),
            ("Command", QT_TRANSLATE_NOOP("App::Property", "The command that made the kit")),
        ):
            add(obj, "App::PropertyString", name, "Kit", text, FIXED)
        text = QT_TRANSLATE_NOOP("App::Property", "Density of the material, in g/cm3")
        add(obj, "App::PropertyFloat", "Density", "Material", text, 0, 1.24)
        text = QT_TRANSLATE_NOOP("App::Property", "Mass of all pieces printed solid, in g")
        add(obj, "App::PropertyFloat", "Mass", "Material", text, DERIVED)
        text = QT_TRANSLATE_NOOP("App::Property", "Volume of all pieces")
        add(obj, "App::PropertyVolume", "Volume", "Material", text, DERIVED)
        text = QT_TRANSLATE_NOOP("App::Property", "Number of pieces to print for the frame")
        add(obj, "App::PropertyInteger", "Pieces", "Frame", text, DERIVED)
        text = QT_TRANSLATE_NOOP("App::Property", "Number of pieces of each part")
        add(obj, "App::PropertyStringList", "Bill", "Frame", text, DERIVED)
        if obj.Data:
            _own_properties(obj, data_of(obj))

    def fill(self, obj: Any) -> None:
        """Take over what the text says."""
        data = data_of(obj)
        _own_properties(obj, data)
        obj.Frame, obj.Key, obj.Detail = data.name, data.key, data.detail
        obj.Command = data.command

    def parameters(self, obj: Any) -> tuple[str, ...]:
        """The live parameters of the kit."""
        return (*data_of(obj).values,)

    def compute(self, obj: Any) -> None:
        """Check the live parameters and count.

        Raises
        ------
        KitError
            A live parameter is out of its range, or the text is no kit.
        """
        data = data_of(obj)
        values = values_of(obj, data)
        refuse(data, values)
        bill = bill_of(obj)
        total = 0.0
        for part, count in bill.items():
            solid = data.parts[part]
            total += count * volume(solid.points(values), solid.triangles)
        obj.Bill = [f"{count} {part}" for part, count in bill.items()]
        obj.Pieces, obj.Volume = sum(bill.values()), total
        obj.Mass = round(mass(total, obj.Density), 3)


def _own_properties(obj: Any, data: KitData) -> None:
    """Add the properties that this kit has and others may not have."""
    length_properties(obj, data.values)
    if data.has_cells:
        cell_properties(obj, "Frame", data.rows, data.columns)


@lru_cache(maxsize=8)
def _parsed(text: str) -> KitData:
    return parse_kit(text)


def data_of(kit: Any) -> KitData:
    """The kit of a kit object.

    Raises
    ------
    KitError
        Its text is broken or of another version.
    """
    return _parsed(kit.Data)


def bill_of(kit: Any) -> dict[str, int]:
    """Number of pieces of each part that the frame needs, at its rows and columns."""
    data = data_of(kit)
    counts = Counter(p["part"] for p in frame_of(kit, data))
    return {part: counts[part] for part in data.parts if counts[part]}
