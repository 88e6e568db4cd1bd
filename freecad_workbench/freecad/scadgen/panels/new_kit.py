"""The task panel that makes a new kit."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore

from freecad.scadgen import document
from freecad.scadgen.engine import Engine, EngineError, Outcome
from freecad.scadgen.kit_data import KitError, read_kit
from freecad.scadgen.panels.frame_options import FrameOptions
from freecad.scadgen.panels.panel import Panel
from freecad.scadgen.preferences import clearance
from freecad.scadgen.tables import LENGTHS

__all__ = ["NewKitPanel", "add_to_document"]

translate = App.Qt.translate

_KEYS = ("", "fixed", "loose")
_DETAILS = ("draft", "standard", "fine")
_PLACES = ("joint", "frame", "nothing")


class NewKitPanel(Panel):
    """Asks for a kit, has the engine make it, and puts it into the document.

    The engine tells first which frames there are, and what their options are.
    """

    page = "new_kit"

    def __init__(self) -> None:
        super().__init__()
        form = self.form
        form.detail.setCurrentIndex(1)
        form.clearance.setProperty("rawValue", clearance())
        for name in LENGTHS:
            getattr(form, f"has_{name}").toggled.connect(getattr(form, name).setEnabled)
        for box in (form.frame, form.weave):
            box.currentIndexChanged.connect(self.update)
        form.file.fileNameChanged.connect(self.update)
        self.options = FrameOptions(form.options_grid)
        self.engine = Engine(form)
        self.engine.went.connect(self.show_progress)
        self.engine.ended.connect(self._ended)
        self._named: list[dict[str, Any]] = []
        self._files: dict[str, Any] = {}
        self._folder: Any = None
        self._closing = False
        self.update()

    def present(self) -> None:
        """Show the panel, and ask the engine for the frames."""
        super().present()
        self._start(["frame", "--list", "--json"])

    # What is asked for

    @property
    def family(self) -> dict[str, Any] | None:
        """The named frame chosen; None for a file."""
        number = self.form.frame.currentIndex()
        return self._named[number] if 0 <= number < len(self._named) else None

    @property
    def file(self) -> str:
        """The file chosen."""
        return str(self.form.file.property("fileName")).strip()

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
        form, family = self.form, self.family
        words = ["kit", *self.options.words(), "--output", folder]
        if key := _KEYS[form.key.currentIndex()]:
            words += ["--key", key]
        words += ["--detail", _DETAILS[form.detail.currentIndex()]]
        if form.weave.currentIndex() == 1:
            words += ["--weave", form.weave_file.property("fileName")]
        for name, value in self.lengths().items():
            words += [f"--{name.replace('_', '-')}", repr(value)]
        words += [] if form.proved.isChecked() else ["--unchecked"]
        return [*words, "--", self.file if family is None else family["name"]]

    def update(self, *_: Any) -> None:
        """Show what belongs to what is chosen."""
        form, family = self.form, self.family
        form.weave_file.setVisible(form.weave.currentIndex() == 1)
        form.file.setVisible(family is None and bool(self._named))
        form.frame_text.setText("" if family is None else family["text"])
        if family is None:
            self.options.show(self._files.get(Path(self.file).suffix.lower(), {}), {})
        else:
            about = {n: a for n, a in family["about"].items() if n not in LENGTHS}
            self.options.show(about, family["options"])

    # The engine's run

    def accept(self) -> bool:
        """Start the engine; the panel stays until it is done."""
        if self.engine.running:
            return False
        if not self._named:
            self._start(["frame", "--list", "--json"])
        elif self.family is None and not self.file:
            self.tell(translate("Scadgen", "Choose the file that the frame is in"), bad=True)
        else:
            self._folder = tempfile.TemporaryDirectory(prefix="scadgen-")
            self._start(self.arguments(str(Path(self._folder.name) / "kit")))
        return False

    def reject(self) -> bool:
        """Stop the engine if it runs; close the panel if not."""
        if self.engine.running:
            self._closing = self._folder is None
            self.tell(translate("Scadgen", "Stopping"))
            self.engine.stop()
            return False
        self.leave()
        return True

    def _start(self, arguments: list[str]) -> None:
        self.tell(translate("Scadgen", "The engine is at work"))
        self._working(True)
        try:
            self.engine.start(arguments)
        except EngineError as error:
            self._ended(Outcome(False, "", str(error)))

    def _working(self, working: bool) -> None:  # noqa: FBT001  as Qt has it
        self.form.inputs.setEnabled(not working)
        self.form.progress.setVisible(working)
        self.form.progress.setValue(0)
        self.enable_ok(not working)

    def _ended(self, outcome: Outcome) -> None:
        self._working(False)
        folder, self._folder = self._folder, None
        try:
            if self._closing:
                # Not at once: that would delete the engine while it speaks.
                QtCore.QTimer.singleShot(0, self.leave)
            elif not outcome.good:
                stopped = translate("Scadgen", "Stopped; nothing was made")
                self.tell(outcome.message or stopped, bad=bool(outcome.message))
            elif folder is None:
                self._listed(outcome.output)
            else:
                self._made(Path(folder.name) / "kit" / "kit.json")
        finally:
            if folder is not None:
                folder.cleanup()

    def _listed(self, output: str) -> None:
        """Take over which frames there are."""
        try:
            found = json.loads(output)
            names = [family["name"] for family in found["named"]]
            files = {kind["ending"]: kind["about"] for kind in found["files"]}
        except (ValueError, KeyError, TypeError):
            text = translate("Scadgen", "scadgen frame gave no list: try it at a terminal")
            self.tell(text, bad=True)
            return
        self.tell("")
        self._named, self._files = found["named"], files
        self.form.file.setProperty("filter", f"({' '.join(f'*{ending}' for ending in files)})")
        self.form.frame.addItems([*names, translate("Scadgen", "From a file")])

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
