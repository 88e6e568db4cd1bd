"""The commands: name, icon and words of each button."""

from __future__ import annotations

from typing import Callable, NamedTuple

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

from freecad.scadgen import actions
from freecad.scadgen.kit_data import KitError
from freecad.scadgen.view import icon

__all__ = ["TOOLBAR", "register"]

_NOOP = App.Qt.QT_TRANSLATE_NOOP


class _Entry(NamedTuple):
    """Name, icon, menu text, tooltip, when it can be used, and what it does."""

    name: str
    picture: str
    text: str
    tip: str
    active: Callable[[], bool]
    act: Callable[[], None]


class _Command:
    """A command as FreeCAD wants it."""

    def __init__(self, entry: _Entry) -> None:
        self._entry = entry

    def GetResources(self) -> dict[str, str]:
        """Icon and words; FreeCAD translates them."""
        entry = self._entry
        return {"Pixmap": icon(entry.picture), "MenuText": entry.text, "ToolTip": entry.tip}

    def IsActive(self) -> bool:
        """Whether it can be used now."""
        return self._entry.active() and not Gui.Control.activeDialog()

    def Activated(self) -> None:
        """Do it; what is wrong is said in one line."""
        try:
            self._entry.act()
        except KitError as error:
            App.Console.PrintError(f"{error}\n")
            QtGui.QMessageBox.critical(Gui.getMainWindow(), "Scadgen", str(error))


_COMMANDS = (
    _Entry(
        "Scadgen_NewKit",
        "new_kit",
        _NOOP("Scadgen_NewKit", "New kit"),
        _NOOP("Scadgen_NewKit", "Make the parts of a frame that locks without glue or screws"),
        actions.always,
        actions.new_kit,
    ),
    _Entry(
        "Scadgen_OpenKit",
        "open_kit",
        _NOOP("Scadgen_OpenKit", "Open kit"),
        _NOOP("Scadgen_OpenKit", "Take the kit.json that scadgen wrote into the document"),
        actions.always,
        actions.open_kit,
    ),
    _Entry(
        "Scadgen_Joint",
        "joint",
        _NOOP("Scadgen_Joint", "Joint"),
        _NOOP("Scadgen_Joint", "Add one assembled joint"),
        actions.has_kit,
        actions.add_joints,
    ),
    _Entry(
        "Scadgen_Part",
        "connector",
        _NOOP("Scadgen_Part", "Part"),
        _NOOP("Scadgen_Part", "Add parts of the kit"),
        actions.has_kit,
        actions.add_parts,
    ),
    _Entry(
        "Scadgen_Frame",
        "frame",
        _NOOP("Scadgen_Frame", "Frame"),
        _NOOP(
            "Scadgen_Frame",
            "Add the assembled frame; its rows and columns are properties",
        ),
        actions.has_kit,
        actions.add_frame,
    ),
    _Entry(
        "Scadgen_Explode",
        "explode",
        _NOOP("Scadgen_Explode", "Explode"),
        _NOOP("Scadgen_Explode", "Pull a joint or a frame apart to see how it goes together"),
        actions.has_assembly,
        actions.explode,
    ),
    _Entry(
        "Scadgen_Check",
        "check",
        _NOOP("Scadgen_Check", "Check"),
        _NOOP("Scadgen_Check", "Check all that is known about the kit at its present values"),
        actions.has_kit,
        actions.check,
    ),
    _Entry(
        "Scadgen_Export",
        "export",
        _NOOP("Scadgen_Export", "Export"),
        _NOOP("Scadgen_Export", "Write what is selected or the whole kit as STEP, STL or 3MF"),
        actions.has_kit,
        actions.export,
    ),
    _Entry(
        "Scadgen_Restore",
        "restore",
        _NOOP("Scadgen_Restore", "Restore"),
        _NOOP(
            "Scadgen_Restore",
            "Give parts back their behaviour that were saved without this workbench",
        ),
        actions.has_document,
        actions.restore,
    ),
    _Entry(
        "Scadgen_Preferences",
        "preferences",
        _NOOP("Scadgen_Preferences", "Preferences"),
        _NOOP("Scadgen_Preferences", "Where the engine is, new kits' clearance, printer's bed"),
        actions.always,
        actions.preferences,
    ),
)

#: The commands as toolbar and menu have them; an empty one is a gap.
TOOLBAR = (
    *("Scadgen_NewKit", "Scadgen_OpenKit", "Separator"),
    *("Scadgen_Joint", "Scadgen_Part", "Scadgen_Frame", "Separator"),
    *("Scadgen_Explode", "Scadgen_Check", "Scadgen_Export", "Separator"),
    *("Scadgen_Restore", "Scadgen_Preferences"),
)


def register() -> None:
    """Tell FreeCAD about the commands."""
    for entry in _COMMANDS:
        Gui.addCommand(entry.name, _Command(entry))
