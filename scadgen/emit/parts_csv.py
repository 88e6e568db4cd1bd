"""The bill of materials as a table for a spreadsheet."""

from __future__ import annotations

import csv
import io

from scadgen.emit.part_words import words
from scadgen.kit.bill import Line, lines
from scadgen.kit.model import DENSITIES, Kit

__all__ = ["HEADER", "parts_csv"]

#: The columns; all but the counts are of one piece.
HEADER = (
    "number",
    "part",
    "what",
    "count",
    "spares",
    "volume_mm3",
    "mass_g",
    "material",
    "print_time_s",
    "filament_g",
)


def parts_csv(kit: Kit) -> str:
    """Write the bill as CSV: a header, then a line for each part that the frame needs.

    Parameters
    ----------
    kit
        The kit.

    Returns
    -------
    text
        Comma-separated, with the decimal point; print time and filament are empty unless a
        slicer was asked.
    """
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(HEADER)
    what = words(kit)
    table.writerows(_row(kit, line, what[line.part]) for line in lines(kit))
    return text.getvalue()


def _row(kit: Kit, line: Line, what: str) -> tuple[str | int | float | None, ...]:
    grams = None
    if line.filament is not None:
        grams = round(line.filament / 1000 * DENSITIES[kit.material], 3)
    return (
        line.number,
        line.part,
        what,
        line.count,
        line.spares,
        line.volume,
        line.mass,
        kit.material,
        line.seconds,
        grams,
    )
