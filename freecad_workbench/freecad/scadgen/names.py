"""Names of things: parts, live parameters, and what FreeCAD calls them."""

from __future__ import annotations

from FreeCAD import Qt

from freecad.scadgen.affine import Solid
from freecad.scadgen.tables import LENGTHS, PART_ROLES

__all__ = [
    "CELLS",
    "ROLE_LABELS",
    "icon_of",
    "joint_label",
    "label_of",
    "property_of",
    "role_alone",
]

QT_TRANSLATE_NOOP = Qt.QT_TRANSLATE_NOOP

#: Edge elements of regular joints by how many of their ends are keys', and their names.
_REGULAR = {
    "basic": QT_TRANSLATE_NOOP("Scadgen", "Basic element"),
    "one_sided": QT_TRANSLATE_NOOP("Scadgen", "One-sided element"),
    "two_sided": QT_TRANSLATE_NOOP("Scadgen", "Two-sided element"),
}

#: Cells of a frame whose rows and columns can be set.
CELLS = {
    "Rows": QT_TRANSLATE_NOOP("App::Property", "Cells of the frame up"),
    "Columns": QT_TRANSLATE_NOOP("App::Property", "Cells of the frame across"),
}

#: What a placed piece is to the viewer.
ROLE_LABELS = {
    "row": QT_TRANSLATE_NOOP("Scadgen", "Elements along the rows"),
    "cross": QT_TRANSLATE_NOOP("Scadgen", "Elements between the rows"),
    "half_a": QT_TRANSLATE_NOOP("Scadgen", "Halves A"),
    "half_b": QT_TRANSLATE_NOOP("Scadgen", "Halves B"),
    "cap": QT_TRANSLATE_NOOP("Scadgen", "Connectors"),
    "peg": QT_TRANSLATE_NOOP("Scadgen", "Pegs"),
}


def role_alone(part: Solid) -> str:
    """The role whose colour a part alone has."""
    if part.is_second:
        return "half_b"
    return "cross" if part.role == "element" and part.keys else PART_ROLES[part.role][1]


def icon_of(part: Solid) -> str:
    """The icon of a part."""
    return [*_REGULAR][part.keys] if part.role == "element" else PART_ROLES[part.role][2]


def property_of(parameter: str) -> str:
    """The property that a live parameter is."""
    return LENGTHS[parameter][0]


def joint_label(joint: str) -> str:
    """What a person calls a kind of joint, in the language of FreeCAD."""
    return f"{Qt.translate('Scadgen', 'Joint')} {joint}".strip()


def label_of(part: Solid) -> str:
    """What a person calls a part, in the language of FreeCAD."""
    if part.name in _REGULAR:
        return str(Qt.translate("Scadgen", _REGULAR[part.name]))
    number = part.name.split("_")[1:2]
    said = " ".join([Qt.translate("Scadgen", PART_ROLES[part.role][0]), *number])
    return f"{said} ({Qt.translate('Scadgen', 'second shape')})" if part.is_second else said
