"""What all task panels have in common."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

__all__ = ["Panel"]

_UI = Path(__file__).parent.parent / "ui"


class Panel:
    """A task panel from a ``.ui`` file; FreeCAD calls `accept` and `reject`."""

    page = ""

    def __init__(self) -> None:
        self.form = Gui.PySideUic.loadUi(str(_UI / f"{self.page}.ui"))
        self._box: Any = None

    def getStandardButtons(self) -> int:
        """OK and Cancel."""
        return int(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)

    def modifyStandardButtons(self, box: Any) -> None:
        """Keep the buttons."""
        self._box = box

    def enable_ok(self, enabled: bool) -> None:  # noqa: FBT001  as Qt has it
        """Let OK be pressed, or not."""
        if self._box is not None:
            self._box.button(QtGui.QDialogButtonBox.Ok).setEnabled(enabled)

    def tell(self, message: str, *, bad: bool = False) -> None:
        """Show a line in the panel; a bad one in the report view as well."""
        self.form.message.setStyleSheet("color: #c00000" if bad else "")
        self.form.message.setText(message)
        if bad:
            App.Console.PrintError(message + "\n")

    def show_progress(self, percent: int, words: str) -> None:
        """Show how far the engine is, and what it does."""
        self.form.progress.setValue(percent)
        self.tell(words)

    def present(self) -> None:
        """Show the panel.  FreeCAD has one at a time, and says so if there is another."""
        Gui.Control.showDialog(self)

    def leave(self) -> None:
        """Close the panel."""
        self._box = None  # it would be taken for the next widget that comes to lie there
        Gui.Control.closeDialog()
