"""What the buttons do, and when they can be pressed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

from freecad.scadgen import document
from freecad.scadgen.kit_data import read_kit
from freecad.scadgen.kit_object import data_of
from freecad.scadgen.names import icon_of, joint_label, label_of
from freecad.scadgen.panels.check import CheckPanel
from freecad.scadgen.panels.choose import Choice, ChoosePanel
from freecad.scadgen.panels.explode import ExplodePanel
from freecad.scadgen.panels.export import ExportPanel
from freecad.scadgen.panels.new_kit import NewKitPanel, add_to_document

__all__ = [
    "add_frame",
    "add_joints",
    "add_parts",
    "always",
    "check",
    "explode",
    "export",
    "has_assembly",
    "has_document",
    "has_kit",
    "new_kit",
    "open_kit",
    "preferences",
    "restore",
]

translate = App.Qt.translate


def always() -> bool:
    """It always can."""
    return True


def has_document() -> bool:
    """It can where there is a document."""
    return App.ActiveDocument is not None


def has_kit() -> bool:
    """It can where there is a kit."""
    return App.ActiveDocument is not None and bool(document.kits(App.ActiveDocument))


def has_assembly() -> bool:
    """It can where there is a joint or a frame."""
    doc = App.ActiveDocument
    return doc is not None and any(map(document.kind_of, doc.findObjects("App::GeometryPython")))


def _selected() -> list[Any]:
    return [obj for obj in Gui.Selection.getSelection() if document.kit_of(obj) is not None]


def _kit() -> Any:
    """The kit that is meant: that of what is selected, or the newest."""
    chosen = [document.kit_of(obj) for obj in _selected()]
    return chosen[0] if chosen else document.kits(App.ActiveDocument)[-1]


def new_kit() -> None:
    """Ask for a kit, and have it made."""
    NewKitPanel().present()


def open_kit() -> None:
    """Ask for a file, and take its kit into the document."""
    title, kind = translate("Scadgen", "Open kit"), translate("Scadgen", "Kits (*.json)")
    found = QtGui.QFileDialog.getOpenFileName(Gui.getMainWindow(), title, "", kind)
    path = found[0] if isinstance(found, tuple) else found
    if path:
        read_kit(path)
        add_to_document(Path(path).read_text(encoding="utf-8"), "joint")


def _add(kit: Any, words: str, make: Iterable[Callable[[], Any]]) -> None:
    """Add something of a kit in one step of undo, and select it."""
    with document.one_step(kit.Document, words):
        made = [make_one() for make_one in make]
    Gui.Selection.clearSelection()
    for obj in made:
        Gui.Selection.addSelection(obj)
    Gui.SendMsgToActiveView("ViewFit")


def add_parts() -> None:
    """Ask which parts to add."""
    kit, title = _kit(), translate("Scadgen", "Parts")
    choices = [
        Choice(name, label_of(part), icon_of(part)) for name, part in data_of(kit).parts.items()
    ]

    def act(names: Iterable[str]) -> None:
        _add(kit, title, [partial(document.add_part, kit, name) for name in names])

    ChoosePanel(title, choices, act).present()


def add_joints() -> None:
    """Add an assembled joint; ask of which kind if there are several."""
    kit, title = _kit(), translate("Scadgen", "Joint")
    names = [joint["name"] for joint in data_of(kit).joints]

    def act(names: Iterable[str]) -> None:
        _add(kit, title, [partial(document.add_joint, kit, name) for name in names])

    if len(names) == 1:
        act(names)
    else:
        choices = [Choice(name, joint_label(name), "joint") for name in names]
        ChoosePanel(title, choices, act).present()


def add_frame() -> None:
    """Add the assembled frame."""
    kit = _kit()
    _add(kit, translate("Scadgen", "Frame"), [partial(document.add_frame, kit)])


def explode() -> None:
    """Pull the chosen joint or frame apart, or the newest."""
    chosen = [obj for obj in Gui.Selection.getSelection() if document.kind_of(obj) == "assembly"]
    ExplodePanel((chosen or document.ours(App.ActiveDocument, "assembly"))[-1]).present()


def check() -> None:
    """Check the kit."""
    CheckPanel(_kit()).present()


def export() -> None:
    """Write files."""
    ExportPanel(_kit()).present()


def restore() -> None:
    """Give lost behaviour back."""
    with document.one_step(App.ActiveDocument, translate("Scadgen", "Restore")):
        found = document.restore(App.ActiveDocument)
    text = translate("Scadgen", "{} objects have their behaviour back")
    App.Console.PrintMessage(text.format(len(found)) + "\n")


def preferences() -> None:
    """Show the preferences."""
    Gui.showPreferences("Scadgen", 0)
