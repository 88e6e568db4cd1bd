"""The task panel that writes files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad.scadgen import export
from freecad.scadgen.kit_data import KitError
from freecad.scadgen.panels.panel import Panel
from freecad.scadgen.preferences import bed

__all__ = ["ExportPanel"]

translate = App.Qt.translate


class ExportPanel(Panel):
    """Writes what is selected, or all that a kit needs."""

    page = "export"

    def __init__(self, kit: Any) -> None:
        super().__init__()
        self.kit = kit
        self.form.selected.setChecked(bool(Gui.Selection.getSelection()))
        path = kit.Document.FileName
        home = Path(path).parent if path else Path.home()
        self.form.folder.setProperty("fileName", str(home))
        for signal in (self.form.selected.toggled, self.form.format.currentIndexChanged):
            signal.connect(self.update)
        self.update()

    def update(self, *_: Any) -> None:
        """Say what will be written."""
        width, depth = bed()
        kind = self.format
        if self.form.selected.isChecked():
            text = translate("Scadgen", "As it stands in the document, at its own values")
        elif kind == "3mf":
            text = translate(
                "Scadgen", "Every piece laid out on beds of {:g} x {:g} mm, and a bill of materials"
            ).format(width, depth)
        else:
            text = translate(
                "Scadgen", "One file a part with its count in the name, and a bill of materials"
            )
        self.form.about.setText(text)

    @property
    def format(self) -> str:
        """The format chosen."""
        return export.FORMATS[self.form.format.currentIndex()]

    def accept(self) -> bool:
        """Write, and close unless something is wrong."""
        folder = Path(self.form.folder.property("fileName"))
        try:
            if self.form.selected.isChecked():
                files = export.selection_files(Gui.Selection.getSelection(), self.format)
            else:
                files = export.whole_files(self.kit, self.format, bed())
            export.write(files, folder)
        except KitError as error:
            self.tell(str(error), bad=True)
            return False
        text = translate("Scadgen", "Written to {}: {}")
        App.Console.PrintMessage(text.format(folder, ", ".join(files)) + "\n")
        self.leave()
        return True

    def reject(self) -> bool:
        """Close."""
        self.leave()
        return True
