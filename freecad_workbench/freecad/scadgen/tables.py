"""The live parameters, and what parts are for; written by scripts/tables.py.  Do not edit."""

__all__ = ["COLOURS", "LENGTHS", "OPTIONAL", "PART_ROLES"]

#: The colour of what a placed piece is.
COLOURS = {
    "row": (70, 130, 180),
    "cross": (218, 165, 32),
    "half_a": (205, 92, 92),
    "half_b": (233, 150, 122),
    "cap": (46, 139, 87),
    "peg": (60, 95, 95),
}

#: The property that each is, and what it means.
LENGTHS = {
    "side": (
        "Side",
        "Side of the square tubes",
    ),
    "edge_length": (
        "EdgeLength",
        "Distance between the centres of two joints",
    ),
    "clearance": (
        "Clearance",
        "Gap between mating faces",
    ),
    "peg_width": (
        "PegWidth",
        "Side of the square peg",
    ),
    "peg_length": (
        "PegLength",
        "Length of the peg",
    ),
    "peg_clearance": (
        "PegClearance",
        "Gap between the peg and each wall of its socket",
    ),
    "peg_chamfer": (
        "PegChamfer",
        "Lead-in of the peg's tips",
    ),
    "bore": (
        "Bore",
        "Side of the square bore along all edges",
    ),
}

#: Those that a kit may lack.
OPTIONAL = ("bore",)

#: What a part is for: what it is called, the role whose colour it has alone, its icon.
PART_ROLES = {
    "element": ("Edge element", "row", "basic"),
    "connector": ("Connector", "cap", "connector"),
    "half": ("Half", "half_a", "half"),
    "peg": ("Peg", "peg", "peg"),
    "tube": ("Tube", "row", "tube"),
}
