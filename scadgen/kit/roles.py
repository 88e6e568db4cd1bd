"""What parts are for, in one table; all files call parts by it.

What other files hold of it is written by ``scripts/tables.py``.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["PART_ROLES", "PartRole"]


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
    """

    text: str
    label: str
    alone: str
    icon: str = "kit"


#: What parts are for, by the name in ``kit.json``.
PART_ROLES = {
    "element": PartRole("Edge element {}", "Edge element", "row", "basic"),
    "connector": PartRole("Loose connector {} for the rim", "Connector", "cap", "connector"),
    "half": PartRole("Locking half {}", "Half", "half_a", "half"),
    "peg": PartRole("Loose peg {}", "Peg", "peg", "peg"),
    "tube": PartRole("Plain tube {}", "Tube", "row", "tube"),
}
