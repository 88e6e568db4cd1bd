"""The task panel that has the engine check a kit."""

from __future__ import annotations

import json
import math
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

from freecad.scadgen import document
from freecad.scadgen.engine import Engine, EngineError, Outcome
from freecad.scadgen.figures import volume
from freecad.scadgen.kit_data import KitError, read_kit
from freecad.scadgen.kit_object import data_of
from freecad.scadgen.panels.panel import Panel
from freecad.scadgen.properties import refuse, values_of
from freecad.scadgen.remake import remaking

__all__ = ["CheckPanel", "Row"]

#: Share of the time after which the kit is made again.
_MADE = 0.1

#: Volumes that differ by this share of them are the same: FreeCAD adds up in another order.
_EQUAL = 1e-6

translate = App.Qt.translate


class Row(NamedTuple):
    """One line of the table.

    Parameters
    ----------
    good
        Whether it holds.
    check, figure, bound
        What was checked, what was found, and what must be.
    objects
        Names of the objects that it is about.
    """

    good: bool
    check: str
    figure: str
    bound: str
    objects: tuple[str, ...]


class CheckPanel(Panel):
    """Has the engine make the kit again at the document's values, compares, and checks it."""

    page = "check"

    def __init__(self, kit: Any) -> None:
        super().__init__()
        self.kit = kit
        self._document = kit.Document.Name
        self.rows: list[Row] = []
        self.form.table.setColumnCount(4)
        self.form.table.setHorizontalHeaderLabels(
            [
                "",
                translate("Scadgen", "Check"),
                translate("Scadgen", "Found"),
                translate("Scadgen", "Must be"),
            ]
        )
        self.form.table.verticalHeader().hide()
        self.form.table.itemSelectionChanged.connect(self.select)
        self.engine = Engine(self.form)
        self.engine.went.connect(self._went)
        self.engine.ended.connect(self._ended)
        self._folder = tempfile.TemporaryDirectory(prefix="scadgen-")
        self._made = self._closing = False

    def getStandardButtons(self) -> int:
        """Close alone."""
        return int(QtGui.QDialogButtonBox.Close)

    def present(self) -> None:
        """Show the panel and start."""
        super().present()
        folder = Path(self._folder.name)
        try:
            self.rows = [row for part in self._parts() for row in _faults(part)]
            self._start(remaking(self.kit, folder))
        except KitError as error:
            self._ended(Outcome(False, "", str(error)))

    def reject(self) -> bool:
        """Close, once the engine has stopped and cleared up after itself."""
        if self.engine.running:
            self._closing = True
            self.tell(translate("Scadgen", "Stopping"))
            self.engine.stop()
            return False
        self._folder.cleanup()
        self.leave()
        return True

    def select(self) -> None:
        """Select the objects that the chosen line is about."""
        Gui.Selection.clearSelection()
        chosen = {item.row() for item in self.form.table.selectedItems()}
        doc = App.listDocuments().get(self._document)
        for name in {name for n in chosen for name in self.rows[n].objects}:
            if doc and doc.getObject(name):
                Gui.Selection.addSelection(self._document, name)

    def _parts(self) -> list[Any]:
        return [p for p in document.ours(self.kit.Document, "part") if p.Kit == self.kit]

    def _start(self, arguments: list[str]) -> None:
        try:
            self.engine.start(arguments)
        except EngineError as error:
            self._ended(Outcome(False, "", str(error)))

    def _went(self, percent: int, words: str) -> None:
        """Show how far both runs are: the first makes the kit."""
        share = percent / 100
        done = _MADE + (1 - _MADE) * share if self._made else _MADE * share
        self.show_progress(round(100 * done), words)

    def _ended(self, outcome: Outcome) -> None:
        if self._closing:
            # Not at once: that would delete the engine while it speaks.
            QtCore.QTimer.singleShot(0, self.reject)
            return
        try:
            self._go_on(outcome)
        except KitError as error:
            self._show()
            self.tell(str(error), bad=True)
        except ReferenceError:
            self.form.progress.hide()
            self.tell(translate("Scadgen", "The kit was deleted meanwhile"), bad=True)

    def _go_on(self, outcome: Outcome) -> None:
        if not outcome.good:
            raise KitError(outcome.message)
        if self._made:
            self._checked(outcome.output)
        else:
            self._remade()

    def _remade(self) -> None:
        """Compare what the engine made with what is in the document, and check it."""
        folder = Path(self._folder.name) / "kit"
        read_kit(folder)  # says what is wrong, if anything is
        made = json.loads((folder / "kit.json").read_text(encoding="utf-8"))["parts"]
        here = json.loads(self.kit.Data)["parts"]
        for part in dict.fromkeys((*here, *made)):
            good = here.get(part) == made.get(part)
            found = translate("Scadgen", "the same") if good else translate("Scadgen", "another")
            check = translate("Scadgen", "{} is what the engine makes").format(part)
            bound = translate("Scadgen", "the same")
            self.rows.append(Row(good, check, found, bound, self._about(part)))
        self._made = True
        self._start(["check", str(folder), "--json"])

    def _checked(self, output: str) -> None:
        """Add what the engine found."""
        for good, check, figure, bound in _results(output):
            words = check.replace(":", " ").split()
            about = next((p for p in data_of(self.kit).parts if p in words), "")
            self.rows.append(Row(good, check, figure, bound, self._about(about)))
        self._show()
        bad = sum(not row.good for row in self.rows)
        text = translate("Scadgen", "{} of {} checks are good")
        message = text.format(len(self.rows) - bad, len(self.rows))
        self.tell(message, bad=bad > 0)

    def _about(self, kind: str) -> tuple[str, ...]:
        """The parts of a kind, and the links that show them in joints and frames."""
        parts = [part for part in self._parts() if part.Kind == kind]
        links = [obj for part in parts for obj in part.InList if obj.isDerivedFrom("App::Link")]
        return tuple(obj.Name for obj in (*parts, *links))

    def _show(self) -> None:
        """Fill the table, what is bad first, and choose its first line if it is bad."""
        self.form.progress.hide()
        self.rows.sort(key=lambda row: row.good)
        table = self.form.table
        table.setRowCount(len(self.rows))
        for n, row in enumerate(self.rows):
            verdict = translate("Scadgen", "ok") if row.good else translate("Scadgen", "FAILED")
            for column, text in enumerate((verdict, row.check, row.figure, row.bound)):
                table.setItem(n, column, QtGui.QTableWidgetItem(text))
                table.item(n, column).setToolTip(text)
        table.resizeColumnsToContents()
        if self.rows and not self.rows[0].good:
            table.selectRow(0)


def _results(output: str) -> list[tuple[bool, str, str, str]]:
    """What the engine found: whether it is good, what was checked, what it is and must be.

    Raises
    ------
    KitError
        It gave no such results.
    """
    try:
        return [(r["good"], r["check"], r["figure"], r["bound"]) for r in json.loads(output)]
    except (ValueError, KeyError, TypeError) as error:
        text = translate("Scadgen", "scadgen check gave no results: try it at a terminal")
        raise KitError(text) from error


def _faults(part: Any) -> Iterator[Row]:
    """What is wrong with a part's own values, or with its shape at these.

    Raises
    ------
    KitError
        The kit is broken.
    """
    data = data_of(part.Kit)
    values, solid = values_of(part, data), data.parts[part.Kind]
    try:
        refuse(data, values)
    except KitError as error:
        check = translate("Scadgen", "{} is in its ranges").format(part.Label)
        yield Row(False, check, str(error), translate("Scadgen", "in range"), (part.Name,))
        return
    found = 0.0 if part.Shape.isNull() else part.Shape.Volume
    bound = volume(solid.points(values), solid.triangles)
    if not math.isclose(found, bound, rel_tol=_EQUAL):
        check = translate("Scadgen", "{} has the shape that its values make").format(part.Label)
        yield Row(False, check, f"{found:.7g} mm3", f"{bound:.7g} mm3", (part.Name,))
