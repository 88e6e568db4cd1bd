"""The task panel that makes a new kit."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore

from freecad.scadgen import document
from freecad.scadgen.affine import KitError, read_kit
from freecad.scadgen.engine import Engine, EngineError, Outcome
from freecad.scadgen.panels.panel import Panel
from freecad.scadgen.preferences import clearance
from freecad.scadgen.tables import LENGTHS

__all__ = ["NewKitPanel", "add_to_document"]

translate = App.Qt.translate

_FRAMES = ("hexagonal", "square")
_KEYS = ("fixed", "loose")
_DETAILS = ("draft", "standard", "fine")
_PLACES = ("joint", "frame", "nothing")


class NewKitPanel(Panel):
    """Asks for a kit, has the engine make it, and puts it into the document."""

    page = "new_kit"

    def __init__(self) -> None:
        super().__init__()
        form = self.form
        for name in _FRAMES:
            form.frame.addItem(name)
        form.detail.setCurrentIndex(1)
        form.clearance.setProperty("rawValue", clearance())
        for name in LENGTHS:
            getattr(form, f"has_{name}").toggled.connect(getattr(form, name).setEnabled)
            getattr(form, f"has_{name}").toggled.connect(self.update)
            getattr(form, name).valueChanged.connect(self.update)
        for box in (form.frame, form.key, form.weave):
            box.currentIndexChanged.connect(self.update)
        for box in (form.rows, form.columns):
            box.valueChanged.connect(self.update)
        form.weave_file.fileNameChanged.connect(self.update)
        self.engine = Engine(form)
        self.engine.went.connect(self.show_progress)
        self.engine.ended.connect(self._ended)
        self._folder: Any = None
        self.update()

    # What is asked for

    @property
    def frame(self) -> str:
        """The frame chosen."""
        return _FRAMES[self.form.frame.currentIndex()]

    @property
    def key(self) -> str:
        """The key style chosen."""
        return _KEYS[self.form.key.currentIndex()]

    def lengths(self) -> dict[str, float]:
        """The live parameters that are given, in mm."""
        form = self.form
        return {
            name: float(getattr(form, name).property("rawValue"))
            for name in LENGTHS
            if getattr(form, f"has_{name}").isChecked()
        }

    def arguments(self, folder: str) -> list[str]:
        """The engine's arguments for what is asked for."""
        form = self.form
        words = ["kit", self.frame, "--output", folder, "--key", self.key]
        words += ["--rows", str(form.rows.value()), "--columns", str(form.columns.value())]
        words += ["--detail", _DETAILS[form.detail.currentIndex()]]
        if form.weave.currentIndex() == 1:
            words += ["--weave", form.weave_file.property("fileName")]
        for name, value in self.lengths().items():
            words += [f"--{name.replace('_', '-')}", repr(value)]
        return words if form.proved.isChecked() else [*words, "--unchecked"]

    def update(self, *_: Any) -> None:
        """Show what belongs to what is chosen."""
        form = self.form
        form.weave_file.setVisible(form.weave.currentIndex() == 1)

    # The engine's run

    def accept(self) -> bool:
        """Start the engine; the panel stays until it is done."""
        if self.engine.running:
            return False
        self._folder = tempfile.TemporaryDirectory(prefix="scadgen-")
        self.tell(translate("Scadgen", "The engine is at work"))
        self._working(True)
        try:
            self.engine.start(self.arguments(str(Path(self._folder.name) / "kit")))
        except EngineError as error:
            self._ended(Outcome(False, "", str(error)))
        return False

    def reject(self) -> bool:
        """Stop the engine if it runs; close the panel if not."""
        if self.engine.running:
            self.tell(translate("Scadgen", "Stopping"))
            self.engine.stop()
            return False
        self.leave()
        return True

    def _working(self, working: bool) -> None:  # noqa: FBT001  as Qt has it
        self.form.inputs.setEnabled(not working)
        self.form.progress.setVisible(working)
        self.form.progress.setValue(0)
        self.enable_ok(not working)

    def _ended(self, outcome: Outcome) -> None:
        self._working(False)
        folder, self._folder = self._folder, None
        try:
            if outcome.good:
                self._made(Path(folder.name) / "kit" / "kit.json")
            elif outcome.message:
                self.tell(outcome.message, bad=True)
            else:
                self.tell(translate("Scadgen", "Stopped; nothing was made"))
        finally:
            folder.cleanup()

    def _made(self, path: Path) -> None:
        try:
            read_kit(path)
        except KitError as error:
            self.tell(str(error), bad=True)
            return
        add_to_document(path.read_text(encoding="utf-8"), _PLACES[self.form.place.currentIndex()])
        # Not at once: that would delete the engine while it speaks.
        QtCore.QTimer.singleShot(0, self.leave)


def add_to_document(text: str, place: str) -> Any:
    """Put a kit into the active document, or into a new one, in one step of undo.

    Parameters
    ----------
    text
        The text of its ``kit.json``.
    place
        What to add besides: ``joint``, ``frame`` or ``nothing``.

    Returns
    -------
    kit
        The kit object.
    """
    doc = App.ActiveDocument or App.newDocument()
    with document.one_step(doc, translate("Scadgen", "New kit")):
        kit = document.add_kit(doc, text)
        if place == "joint":
            document.add_joint(kit)
        elif place == "frame":
            document.add_frame(kit)
    if place != "nothing":
        view = Gui.getDocument(doc.Name).activeView()
        view.viewIsometric()
        view.fitAll()
    return kit
