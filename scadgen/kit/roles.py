"""What parts are for, and their colours, each in one table for all files.

What other files hold of it is written by ``scripts/tables.py``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

__all__ = ["COLOURS", "PART_ROLES", "Colour", "PartRole"]

Colour = tuple[int, int, int]

#: The colour of what a placed piece is, in all pictures and files: steel blue, goldenrod, Indian
#: red, dark salmon, sea green, slate.
COLOURS: Mapping[str, Colour] = MappingProxyType(
    {
        "row": (70, 130, 180),
        "cross": (218, 165, 32),
        "half_a": (205, 92, 92),
        "half_b": (233, 150, 122),
        "cap": (46, 139, 87),
        "peg": (60, 95, 95),
    }
)


@dataclass(frozen=True, slots=True)
class PartRole:
    """What a part is for.

    Parameters
    ----------
    text
        What it is, with a place for its number or letter; no comma, colon or bracket.
    label
        What it is called in FreeCAD, before its number.
    alone
        The role of placed pieces whose colour it has alone.
    icon
        Its picture in FreeCAD, one of the workbench's icons.
    ends
        How many ends it has that belong to joints.
    """

    text: str
    label: str
    alone: str
    icon: str = "kit"
    ends: int = 0


#: What parts are for, by the name in ``kit.json``.
PART_ROLES = {
    "element": PartRole("Edge element {}", "Edge element", "row", "basic", 2),
    "connector": PartRole("Loose connector {} for the rim", "Connector", "cap", "connector", 1),
    "half": PartRole("Locking half {}", "Half", "half_a", "half", 1),
    "peg": PartRole("Loose peg {}", "Peg", "peg", "peg", 1),
    "tube": PartRole("Plain tube {}", "Tube", "row", "tube"),
}
