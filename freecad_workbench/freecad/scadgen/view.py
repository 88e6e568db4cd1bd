"""How our objects look in the tree and in the 3D view."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad.scadgen.kit_data import KitError
from freecad.scadgen.kit_object import data_of
from freecad.scadgen.names import icon_of, role_alone
from freecad.scadgen.tables import COLOURS

__all__ = ["ICONS", "ViewAssembly", "ViewKit", "ViewPart", "icon", "restore", "show"]

ICONS = Path(__file__).parent / "icons"

translate = App.Qt.translate


def icon(name: str) -> str:
    """Absolute path of one of our icons."""
    return str(ICONS / f"{name}.svg")


class _View:
    """What all our views have in common.  FreeCAD finds these classes by their names."""

    #: Extension of the view that belongs to the object's.
    extension = ""

    #: The object; not known yet while a document is read.
    Object: Any = None

    def __init__(self, view: Any) -> None:
        if self.extension and not view.hasExtension(self.extension):
            view.addExtension(self.extension)
        self.Object = view.Object
        view.Proxy = self

    def paint(self, view: Any) -> None:
        """Give a new object its colour."""

    def attach(self, view: Any) -> None:
        """Remember the object."""
        self.Object = view.Object

    def dumps(self) -> None:
        """Nothing is kept."""

    def loads(self, state: Any) -> None:
        """Nothing was kept."""

    __getstate__ = dumps
    __setstate__ = loads


class ViewKit(_View):
    """A kit: in the tree only."""

    def isShow(self) -> bool:
        """Not grey in the tree, although there is nothing to see."""
        return True

    def getIcon(self) -> str:
        """Icon in the tree."""
        return icon("kit")


class ViewPart(_View):
    """A part."""

    extension = "PartGui::ViewProviderAttachExtensionPython"

    def paint(self, view: Any) -> None:
        """Give a new part its colour."""
        obj = view.Object
        view.ShapeColor = _colour(role_alone(data_of(obj.Kit).parts[obj.Kind]))
        # Curved walls are many flat faces: their edges would hide the shape.
        view.DisplayMode = "Shaded"

    def getIcon(self) -> str:
        """Icon in the tree: the one of its kind."""
        try:
            return icon(icon_of(data_of(self.Object.Kit).parts[self.Object.Kind]))
        except (AttributeError, KeyError, KitError):  # not all there yet, or gone, or broken
            return icon("kit")

    def setupContextMenu(self, view: Any, menu: Any) -> None:
        """Offer a clearance of its own, or the kit's again."""
        from freecad.scadgen.own_values import add_actions

        add_actions(view.Object, menu)


class ViewAssembly(_View):
    """A joint or a frame: what is in it is shown in its place."""

    extension = "Gui::ViewProviderGeoFeatureGroupExtensionPython"

    def getIcon(self) -> str:
        """Icon in the tree."""
        return icon(getattr(self.Object, "Layout", "joint"))

    def doubleClicked(self, view: Any) -> bool:
        """Pull it apart."""
        Gui.Selection.clearSelection()
        Gui.Selection.addSelection(view.Object)
        Gui.runCommand("Scadgen_Explode")
        return True


_VIEWS = {"kit": ViewKit, "part": ViewPart, "assembly": ViewAssembly}


def show(obj: Any) -> None:
    """Give a new object its looks."""
    view = obj.ViewObject
    role = getattr(obj, "Role", "")
    if role in COLOURS:
        view.OverrideMaterial = True
        view.ShapeMaterial.DiffuseColor = _colour(role)
    else:
        restore(obj)
        view.Proxy.paint(view)


def restore(obj: Any) -> None:
    """Give an object of ours its view's behaviour."""
    _VIEWS[obj.ScadgenType](obj.ViewObject)


def _colour(role: str) -> tuple[float, float, float]:
    red, green, blue = COLOURS[role]
    return red / 255, green / 255, blue / 255
