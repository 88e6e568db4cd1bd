"""The spreadsheet of a kit's macro: what can be set, and what it may be."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from freecad.scadgen.cells import MOST_CELLS
from freecad.scadgen.kit_data import KitData
from freecad.scadgen.names import CELLS
from freecad.scadgen.tables import LENGTHS

__all__ = ["COUNTS", "parameters_sheet"]

#: Cells of a frame whose rows and columns can be set: properties and aliases.
COUNTS = {"Rows": "rows", "Columns": "columns"}


def parameters_sheet(document: Any, kit: KitData) -> Any:
    """The live parameters and the cells, one a row: an alias for each value, and its bounds."""
    sheet = document.addObject("Spreadsheet::Sheet", "Parameters")
    titles = ("Parameter", "Value", "From", "To", "Meaning", "Why")
    for column, title in zip("ABCDEF", titles):
        sheet.set(f"{column}1", title)
    sheet.setStyle("A1:F1", "bold")
    for row, (name, value) in enumerate(kit.values.items(), 2):
        limits = [r for r in kit.ranges if r["parameter"] == name]
        low, high = (
            " and ".join(dict.fromkeys(_words(r[end]) for r in limits)) for end in ("low", "high")
        )
        why = "; ".join(r["reason"] for r in limits)
        for column, cell in zip("ACDEF", (name, low, high, LENGTHS[name][1], why)):
            sheet.set(f"{column}{row}", f"'{cell}")
        sheet.set(f"B{row}", f"={value!r} mm")
        sheet.setAlias(f"B{row}", name)
    counts = COUNTS.items() if kit.has_cells else ()
    for row, (own, alias) in enumerate(counts, len(kit.values) + 2):
        for column, cell in zip("ACDE", (alias, "1", MOST_CELLS, CELLS[own])):
            sheet.set(f"{column}{row}", f"'{cell}")
        sheet.set(f"B{row}", f"={getattr(kit, alias)}")
        sheet.setAlias(f"B{row}", alias)
    for column, width in zip("ABCDEF", (110, 90, 190, 260, 290, 400)):
        sheet.setColumnWidth(column, width)
    return sheet


def _words(linear: Mapping[str, Any]) -> str:
    """A bound as a person writes it."""
    terms = [(f"{abs(f):.5g} {name}", f) for name, f in linear["terms"].items() if f]
    if linear["constant"] or not terms:
        terms.append((f"{abs(linear['constant']):.5g} mm", linear["constant"]))
    words = "".join(f" {'-' if f < 0 else '+'} {text}" for text, f in terms)
    return words[3:] if terms[0][1] >= 0 else words[1:]
