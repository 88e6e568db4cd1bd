"""FreeCAD imports this at its start: the workbench."""

from __future__ import annotations

from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui

_HERE = Path(__file__).parent
_NOOP = App.Qt.QT_TRANSLATE_NOOP


class ScadgenWorkbench(Gui.Workbench):
    """Interlocking trusses."""

    MenuText = App.Qt.translate("Workbench", "Scadgen")
    ToolTip = App.Qt.translate("Workbench", "Trusses that interlock without glue or screws")
    Icon = str(_HERE / "icons" / "workbench.svg")

    def Initialize(self) -> None:
        """Make the commands, once."""
        from freecad.scadgen.commands import TOOLBAR, register

        register()
        self.appendToolbar(_NOOP("Workbench", "Scadgen"), [*TOOLBAR])
        self.appendMenu(_NOOP("Workbench", "Scadgen"), [*TOOLBAR])

    def GetClassName(self) -> str:
        """What FreeCAD makes of it."""
        return "Gui::PythonWorkbench"


Gui.addLanguagePath(str(_HERE / "translations"))
Gui.updateLocale()
Gui.addWorkbench(ScadgenWorkbench())
Gui.addPreferencePage(str(_HERE / "ui" / "preferences.ui"), "Scadgen")
Gui.addIconPath(str(_HERE / "icons"))
