"""Kits, parts and assemblies in documents: found, made, and given back their behaviour.

Everything here works without a screen::

    from freecad.scadgen import document

    kit = document.add_kit(App.newDocument(), open("kit.json").read())
    half = document.add_part(kit, "half")
    frame = document.add_frame(kit)
    kit.Document.recompute()
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import FreeCAD as App

from freecad.scadgen.assembly_object import AssemblyObject, parts_of
from freecad.scadgen.kit_data import parse_kit
from freecad.scadgen.kit_object import KitObject, data_of
from freecad.scadgen.names import ROLE_LABELS, joint_label, label_of
from freecad.scadgen.part_object import PartObject, follows
from freecad.scadgen.preferences import density
from freecad.scadgen.properties import HIDDEN, add

__all__ = [
    "add_frame",
    "add_joint",
    "add_kit",
    "add_part",
    "kind_of",
    "kit_of",
    "kits",
    "one_step",
    "ours",
    "restore",
]

_CLASSES = {c.kind: c for c in (KitObject, PartObject, AssemblyObject)}

translate = App.Qt.translate


@contextmanager
def one_step(doc: Any, name: str) -> Iterator[None]:
    """Make everything inside one step of undo, or nothing at all if it fails."""
    mode, doc.UndoMode = doc.UndoMode, 1  # without a screen there is no undo unless asked for
    doc.openTransaction(name)
    try:
        yield
        doc.recompute()
        doc.commitTransaction()
    except BaseException:
        doc.abortTransaction()
        raise
    finally:
        doc.UndoMode = mode


def kind_of(obj: Any) -> str:
    """``kit``, ``part`` or ``assembly``; empty for what is not ours."""
    # A link has the properties of what it links to as well.
    is_link = obj.isDerivedFrom("App::Link")
    return "" if is_link else str(getattr(obj, "ScadgenType", ""))


def ours(doc: Any, kind: str) -> list[Any]:
    """All objects of a kind in a document, in the order in which they were made."""
    return [obj for obj in doc.Objects if kind_of(obj) == kind]


def kits(doc: Any) -> list[Any]:
    """All kits in a document; quick enough to be asked all the time."""
    return [obj for obj in doc.findObjects("App::FeaturePython") if kind_of(obj) == "kit"]


def kit_of(obj: Any) -> Any:
    """The kit that an object is or belongs to, through links; None if there is none."""
    obj = obj.getLinkedObject(True) if obj.isDerivedFrom("App::Link") else obj
    return obj if kind_of(obj) == "kit" else getattr(obj, "Kit", None) if kind_of(obj) else None


def add_kit(doc: Any, text: str) -> Any:
    """Add a kit to a document.

    Parameters
    ----------
    doc
        The document.
    text
        The text of a ``kit.json``.

    Returns
    -------
    kit
        The object; live parameters are its properties.

    Raises
    ------
    KitError
        The text is broken, or of another version.  Nothing is added.
    """
    name = parse_kit(text).name
    kit = doc.addObject("App::FeaturePython", "Kit")
    KitObject(kit, text, density())
    kit.Label = translate("Scadgen", "Kit: {}").format(name)
    _show(kit)
    return kit


def add_part(kit: Any, kind: str) -> Any:
    """Add a part of a kit beside it.

    Parameters
    ----------
    kit
        The kit object.
    kind
        Which part: ``basic``, ``half``, ``edge_1``, ...
    """
    name = "".join(word[:1].upper() + word[1:] for word in kind.split("_"))
    part = kit.Document.addObject("Part::FeaturePython", name)
    PartObject(part, kit, kind)
    part.Label = label_of(data_of(kit).parts[kind])
    _show(part)
    return part


def add_joint(kit: Any, joint: str | None = None) -> Any:
    """Add one assembled joint of a kit.

    Parameters
    ----------
    kit
        The kit object.
    joint
        Name of its kind; the kit's first unless given.
    """
    joint = data_of(kit).joints[0]["name"] if joint is None else joint
    return _assembly(kit, joint, f"Joint{joint}", joint_label(joint))


def add_frame(kit: Any) -> Any:
    """Add the assembled frame of a kit; rows and columns, if it has them, are its properties."""
    return _assembly(kit, None, "Frame", translate("Scadgen", "Frame"))


def _assembly(kit: Any, joint: str | None, name: str, label: str) -> Any:
    doc = kit.Document
    assembly = doc.addObject("App::GeometryPython", name)
    AssemblyObject(assembly, kit, joint)
    assembly.Label = label
    for role, kind in parts_of(assembly):
        link = doc.addObject("App::Link", f"{name}_{role}")
        for own, value in (("Role", role), ("Piece", kind)):
            add(link, "App::PropertyString", own, "Scadgen", "", HIDDEN, value)
        link.Label = f"{assembly.Label}: {translate('Scadgen', ROLE_LABELS[role])}"
        link.LinkedObject = _part_for(kit, kind)
        link.ShowElement = False
        assembly.addObject(link)
        _show(link)
    _show(assembly)
    return assembly


def _part_for(kit: Any, kind: str) -> Any:
    """A part that follows the kit in everything: the one there is, or a new hidden one."""
    for part in ours(kit.Document, "part"):
        same = part.Kit == kit and part.Kind == kind
        if same and all(follows(part, name) for name in kit.Proxy.parameters(kit)):
            return part
    part = add_part(kit, kind)
    part.Visibility = False
    return part


def restore(doc: Any) -> list[Any]:
    """Give back their behaviour to objects saved by a FreeCAD without this workbench.

    Returns
    -------
    restored
        The objects that had lost it.
    """
    lost = [obj for obj in doc.Objects if kind_of(obj) in _CLASSES and _is_lost(obj)]
    for obj in lost:
        proxy = _CLASSES[kind_of(obj)].__new__(_CLASSES[kind_of(obj)])
        obj.Proxy = proxy
        proxy.onDocumentRestored(obj)
        obj.touch()
        if App.GuiUp:
            from freecad.scadgen import view

            view.restore(obj)
    return lost


def _is_lost(obj: Any) -> bool:
    return not isinstance(getattr(obj, "Proxy", None), _CLASSES[kind_of(obj)])


def _show(obj: Any) -> None:
    """Give an object its looks, if there is a screen."""
    if App.GuiUp:
        from freecad.scadgen.view import show

        show(obj)
