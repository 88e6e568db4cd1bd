"""What is set under Edit > Preferences > Scadgen."""

from __future__ import annotations

import FreeCAD as App

__all__ = ["GROUP", "bed", "clearance", "density", "engine_path"]

#: Where FreeCAD keeps it; the page's widgets name the same.
GROUP = "User parameter:BaseApp/Preferences/Mod/Scadgen"


def engine_path() -> str:
    """The ``scadgen`` program that was chosen; empty to look for it."""
    return str(App.ParamGet(GROUP).GetString("Engine", "")).strip()


def bed() -> tuple[float, float]:
    """Width and depth of the printer's bed, in mm."""
    group = App.ParamGet(GROUP)
    return group.GetFloat("BedWidth", 220.0), group.GetFloat("BedDepth", 220.0)


def clearance() -> float:
    """Clearance of new kits, in mm."""
    return float(App.ParamGet(GROUP).GetFloat("Clearance", 0.2))


def density() -> float:
    """Density of new kits' material, in g/cm3: that of PLA unless another is set."""
    return float(App.ParamGet(GROUP).GetFloat("Density", 1.24))
