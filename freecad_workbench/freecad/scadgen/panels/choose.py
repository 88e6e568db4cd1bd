"""The task panel that asks which parts or joints of a kit to add."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

from PySide import QtGui

from freecad.scadgen.kit_data import KitError
from freecad.scadgen.panels.panel import Panel
from freecad.scadgen.view import icon

__all__ = ["Choice", "ChoosePanel"]


class Choice(NamedTuple):
    """Something to choose: its name in the kit, what a person calls it, and its icon."""

    name: str
    label: str
    picture: str


class ChoosePanel(Panel):
    """Shows choices, and does something with those chosen.

    Parameters
    ----------
    title
        Of the panel.
    choices
        What there is.
    act
        What is done with the names of those chosen.
    """

    page = "choose"

    def __init__(
        self, title: str, choices: Iterable[Choice], act: Callable[[list[str]], None]
    ) -> None:
        super().__init__()
        self.form.setWindowTitle(title)
        self._names: list[str] = []
        self._act = act
        for name, label, picture in choices:
            self._names.append(name)
            self.form.list.addItem(QtGui.QListWidgetItem(QtGui.QIcon(icon(picture)), label))
        self.form.list.setCurrentRow(0)
        self.form.list.itemDoubleClicked.connect(self.accept)

    def accept(self, *_: object) -> bool:
        """Do it, and close."""
        chosen = [n for n in range(len(self._names)) if self.form.list.item(n).isSelected()]
        try:
            self._act([self._names[n] for n in chosen])
        except KitError as error:
            self.tell(str(error), bad=True)
            return False
        self.leave()
        return True

    def reject(self) -> bool:
        """Close."""
        self.leave()
        return True
