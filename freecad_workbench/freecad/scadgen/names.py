"""Names of things: parts, live parameters, and what FreeCAD calls them."""

from __future__ import annotations

from FreeCAD import Qt

__all__ = [
    "COLOURS",
    "FRAMES",
    "KINDS",
    "LENGTHS",
    "ROLE_LABELS",
    "label_of",
    "property_of",
    "role_alone",
]

QT_TRANSLATE_NOOP = Qt.QT_TRANSLATE_NOOP

#: Kinds of parts in the order of a kit, and what a person calls them.
KINDS = {
    "basic": QT_TRANSLATE_NOOP("Scadgen", "Basic element"),
    "one_sided": QT_TRANSLATE_NOOP("Scadgen", "One-sided element"),
    "two_sided": QT_TRANSLATE_NOOP("Scadgen", "Two-sided element"),
    "connector": QT_TRANSLATE_NOOP("Scadgen", "Connector"),
    "half": QT_TRANSLATE_NOOP("Scadgen", "Half"),
    "peg": QT_TRANSLATE_NOOP("Scadgen", "Peg"),
    "tube": QT_TRANSLATE_NOOP("Scadgen", "Tube"),
}

#: The frames there are.
FRAMES = {
    "hexagonal": QT_TRANSLATE_NOOP("Scadgen", "Hexagons"),
    "square": QT_TRANSLATE_NOOP("Scadgen", "Squares"),
}

#: Live parameters, all lengths: the property each is, and what it means.
LENGTHS = {
    "side": ("Side", QT_TRANSLATE_NOOP("App::Property", "Side of the square tubes")),
    "edge_length": (
        "EdgeLength",
        QT_TRANSLATE_NOOP("App::Property", "Distance between the centres of two joints"),
    ),
    "clearance": ("Clearance", QT_TRANSLATE_NOOP("App::Property", "Gap between mating faces")),
    "peg_width": ("PegWidth", QT_TRANSLATE_NOOP("App::Property", "Side of the square peg")),
    "peg_length": ("PegLength", QT_TRANSLATE_NOOP("App::Property", "Length of the peg")),
    "peg_clearance": (
        "PegClearance",
        QT_TRANSLATE_NOOP("App::Property", "Gap between the peg and each wall of its socket"),
    ),
    "peg_chamfer": ("PegChamfer", QT_TRANSLATE_NOOP("App::Property", "Lead-in of the peg's tips")),
    "bore": ("Bore", QT_TRANSLATE_NOOP("App::Property", "Side of the square bore along all edges")),
}

#: What a placed piece is to the viewer, and its colour: the same as in the kit's other files.
COLOURS = {
    "row": (70, 130, 180),
    "cross": (218, 165, 32),
    "half_a": (205, 92, 92),
    "half_b": (233, 150, 122),
    "cap": (46, 139, 87),
    "peg": (60, 95, 95),
}

ROLE_LABELS = {
    "row": QT_TRANSLATE_NOOP("Scadgen", "Elements along the rows"),
    "cross": QT_TRANSLATE_NOOP("Scadgen", "Elements between the rows"),
    "half_a": QT_TRANSLATE_NOOP("Scadgen", "Halves A"),
    "half_b": QT_TRANSLATE_NOOP("Scadgen", "Halves B"),
    "cap": QT_TRANSLATE_NOOP("Scadgen", "Connectors"),
    "peg": QT_TRANSLATE_NOOP("Scadgen", "Pegs"),
}

#: Any edge element of a frame that has its own kinds of them.
_EDGE = QT_TRANSLATE_NOOP("Scadgen", "Edge element")

_ALONE = {
    "edge": "row",
    "basic": "row",
    "tube": "row",
    "connector": "cap",
    "half": "half_a",
    "peg": "peg",
}


def role_alone(kind: str) -> str:
    """The role whose colour a part alone has."""
    return _ALONE.get(kind, _ALONE.get(kind.partition("_")[0], "cross"))


def property_of(parameter: str) -> str:
    """The property that a live parameter is."""
    return LENGTHS[parameter][0]


def label_of(kind: str) -> str:
    """What a person calls a kind of part, in the language of FreeCAD."""
    if kind in KINDS:
        return str(Qt.translate("Scadgen", KINDS[kind]))
    first, _, number = kind.partition("_")
    return f"{Qt.translate('Scadgen', KINDS.get(first, _EDGE))} {number.replace('_', ' ')}"
