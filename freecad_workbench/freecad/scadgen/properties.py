"""Properties of document objects: added once, whatever version made the object."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD as App

from freecad.scadgen import refusal
from freecad.scadgen.cells import MOST_CELLS
from freecad.scadgen.kit_data import KitData, KitError
from freecad.scadgen.names import CELLS, property_of
from freecad.scadgen.tables import LENGTHS

__all__ = [
    "DERIVED",
    "FIXED",
    "FORMAT",
    "HIDDEN",
    "Scripted",
    "add",
    "cell_properties",
    "frame_of",
    "length_properties",
    "refuse",
    "values_of",
]

#: Version of our properties.  An object that has another is brought up to date when it is opened.
FORMAT = 2

# What `addProperty` takes: read-only 1, hidden 4, output 8 (a change does not touch the object).
FIXED, HIDDEN, DERIVED = 1, 5, 9


class Scripted:
    """What all our objects have in common: no state but properties, and a version.

    FreeCAD finds the classes below this one by their names in saved documents, so that those
    and their modules' names must stay.
    """

    #: What `Restore` knows the object by.
    kind = ""

    def __init__(self, obj: Any) -> None:
        obj.Proxy = self
        self.set_up(obj)

    def set_up(self, obj: Any) -> None:
        """Add the properties that are missing, with their defaults."""
        add(obj, "App::PropertyString", "ScadgenType", "Scadgen", "", HIDDEN, self.kind)
        text = App.Qt.QT_TRANSLATE_NOOP("App::Property", "Version of these properties")
        add(obj, "App::PropertyInteger", "ScadgenVersion", "Scadgen", text, FIXED, FORMAT)

    def execute(self, obj: Any) -> None:
        """Bring what depends on the properties up to date.

        Raises
        ------
        ValueError
            That cannot be: FreeCAD shows why, and the object stays as it was.
        """
        try:
            self.compute(obj)
        except KitError as error:
            refusal.refuse(str(error))

    def compute(self, obj: Any) -> None:
        """Do it; a `KitError` says why it cannot be."""
        raise NotImplementedError

    def onDocumentRestored(self, obj: Any) -> None:
        """Bring an object of an older version up to date."""
        found = getattr(obj, "ScadgenVersion", 0)
        if found > FORMAT:
            App.Console.PrintWarning(
                f"{obj.Label}: made by a newer scadgen workbench (properties {found}, "
                f"known here {FORMAT}); update the workbench before you change it\n"
            )
            return
        try:
            self.set_up(obj)
        except KitError as error:
            App.Console.PrintError(f"{obj.Label}: {error}\n")
            return
        obj.ScadgenVersion = FORMAT

    def dumps(self) -> None:
        """Nothing is kept beside the properties."""

    def loads(self, state: Any) -> None:
        """Nothing was kept beside the properties."""

    __getstate__ = dumps
    __setstate__ = loads


def add(obj: Any, type_: str, name: str, group: str, text: str, flag: int, *default: Any) -> None:
    """Add a property unless it is there."""
    if name not in obj.PropertiesList:
        obj.addProperty(type_, name, group, text, flag)
        if default:
            setattr(obj, name, default[0])


def length_properties(obj: Any, values: Mapping[str, float]) -> None:
    """Add a length for each live parameter."""
    for parameter, value in values.items():
        name, text = LENGTHS[parameter]
        add(obj, "App::PropertyLength", name, "Parameters", text, 0, value)


def cell_properties(obj: Any, group: str, rows: int, columns: int) -> None:
    """Add the numbers of cells up and across."""
    for (name, text), count in zip(CELLS.items(), (rows, columns)):
        limits = (count, 1, MOST_CELLS, 1)
        add(obj, "App::PropertyIntegerConstraint", name, group, text, 0, limits)


def frame_of(obj: Any, data: KitData) -> list[dict[str, Any]]:
    """All placements of a kit's frame, at an object's rows and columns if the kit has them."""
    return data.placements(*(getattr(obj, name, 0) for name in CELLS))


def values_of(obj: Any, data: KitData) -> dict[str, float]:
    """The live parameters of an object that has them as properties, in mm."""
    return {name: float(getattr(obj, property_of(name)).Value) for name in data.values}


def refuse(data: KitData, values: Mapping[str, float]) -> None:
    """Raise unless all live parameters are in their ranges.

    Raises
    ------
    KitError
        They are not: says which, and what works.
    """
    wrong = data.check(values)
    if wrong:
        raise KitError("; ".join(wrong))
