"""The task panel that pulls a joint or a frame apart."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from freecad.scadgen.panels.panel import Panel

__all__ = ["ExplodePanel"]

#: The slider's steps a side; it goes to 10 sides.
_STEPS = 10

translate = App.Qt.translate


class ExplodePanel(Panel):
    """Moves the pieces while its slider is moved; Cancel puts them back."""

    page = "explode"

    def __init__(self, assembly: Any) -> None:
        super().__init__()
        self.assembly = assembly
        self.form.what.setText(assembly.Label)
        assembly.Document.openTransaction(translate("Scadgen", "Pull apart"))
        self.form.slider.setValue(round(assembly.Explode * _STEPS))
        self.form.slider.valueChanged.connect(self.move)
        self._tell()

    def move(self, steps: int) -> None:
        """Pull the assembly apart by a number of the slider's steps."""
        self.assembly.Explode = steps / _STEPS
        self.assembly.recompute()
        self._tell()

    def accept(self) -> bool:
        """Leave it as it is."""
        self.assembly.Document.commitTransaction()
        self.leave()
        return True

    def reject(self) -> bool:
        """Put it back."""
        self.assembly.Document.abortTransaction()
        self.assembly.Document.recompute()
        self.leave()
        return True

    def _tell(self) -> None:
        text = translate("Scadgen", "{:.1f} sides, {:.1f} mm")
        apart = self.assembly.Explode
        self.form.figure.setText(text.format(apart, apart * self.assembly.Kit.Side.Value))
