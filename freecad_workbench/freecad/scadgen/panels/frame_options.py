"""The options of a frame or of a kind of file, as the engine tells them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD as App
from PySide import QtGui

__all__ = ["FrameOptions"]

translate = App.Qt.translate

_NOOP = App.Qt.QT_TRANSLATE_NOOP

#: Names of options as a person reads them; one that is not among them stays as it is.
_WORDS = (
    _NOOP("Scadgen", "Angle"),
    _NOOP("Scadgen", "Bay length"),
    _NOOP("Scadgen", "Bays"),
    _NOOP("Scadgen", "Centre"),
    _NOOP("Scadgen", "Columns"),
    _NOOP("Scadgen", "Components"),
    _NOOP("Scadgen", "Flatten"),
    _NOOP("Scadgen", "Height"),
    _NOOP("Scadgen", "Most"),
    _NOOP("Scadgen", "No split"),
    _NOOP("Scadgen", "Outline"),
    _NOOP("Scadgen", "Radius"),
    _NOOP("Scadgen", "Repair"),
    _NOOP("Scadgen", "Rows"),
    _NOOP("Scadgen", "Scale"),
    _NOOP("Scadgen", "Shortest"),
    _NOOP("Scadgen", "Sides"),
    _NOOP("Scadgen", "Snap"),
    _NOOP("Scadgen", "Strict"),
    _NOOP("Scadgen", "Tolerance"),
    _NOOP("Scadgen", "Triangles"),
    _NOOP("Scadgen", "Unit"),
    _NOOP("Scadgen", "Width"),
)


class FrameOptions:
    """Fields for options, in a grid of the panel; a field left empty is an option not given.

    Parameters
    ----------
    grid
        The layout that they are put into.
    """

    def __init__(self, grid: Any) -> None:
        self._grid = grid
        self._shown: dict[str, Any] = {}
        self._fields: dict[str, Any] = {}

    def show(self, about: Mapping[str, Any], defaults: Mapping[str, Any]) -> None:
        """Show the fields of some options.

        Parameters
        ----------
        about
            By the option's name what it takes (``form``; None if it is on or off) and what it
            means (``text``), as ``scadgen frame --list --json`` says.
        defaults
            What they are if nothing is said.
        """
        if self._shown == about:
            return
        self._clear()
        self._shown = dict(about)
        for row, (name, what) in enumerate(about.items()):
            words = translate("Scadgen", name.replace("_", " ").capitalize())
            if what["form"] is None:
                field = QtGui.QCheckBox(words)
                self._grid.addWidget(field, row, 0, 1, 2)
            else:
                label, field = QtGui.QLabel(words), QtGui.QLineEdit()
                default = defaults.get(name)
                field.setPlaceholderText(what["form"] if default is None else f"{default:g}")
                self._grid.addWidget(label, row, 0)
                self._grid.addWidget(field, row, 1)
            field.setToolTip(what["text"])
            field.setObjectName(f"option_{name}")
            self._fields[name] = field

    def words(self) -> list[str]:
        """Arguments that give the engine what is filled in."""
        found = []
        for name, field in self._fields.items():
            option = f"--{name.replace('_', '-')}"
            if isinstance(field, QtGui.QCheckBox):
                found += [option] * field.isChecked()
            elif text := field.text().strip():
                found.append(f"{option}={text}")
        return found

    def _clear(self) -> None:
        self._fields = {}
        while self._grid.count():
            widget = self._grid.takeAt(0).widget()
            widget.setParent(None)
            widget.deleteLater()
