"""The bill of materials: which parts, how many, how heavy, and how long they print.

Parts are numbered in the order of the kit, from 1, whether its frame needs them or not; so a
part keeps its number when the frame gets other rows and columns.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from scadgen.errors import InputError
from scadgen.frame.placement import bill
from scadgen.kit.model import DENSITIES, Kit, Slicing
from scadgen.solid.mesh import volume

__all__ = ["Line", "as_json", "check_material", "in_words", "lines", "numbers", "with_bill"]

#: Share of the small pieces, which get lost or break, to print as spares; rounded up.
_SPARES = 0.1

#: Decimals of a volume in mm3 and of a mass in g: far below what printing resolves.
_DECIMALS = 3

#: What a line is called in JSON.
_NAMES = {
    "number": "number",
    "part": "part",
    "count": "count",
    "spares": "spares",
    "volume": "volume_mm3",
    "mass": "mass_g",
    "seconds": "print_time_s",
    "filament": "filament_mm3",
}


@dataclass(frozen=True, slots=True)
class Line:
    """One part of the bill; volume, mass, time and filament are those of one piece.

    Parameters
    ----------
    number
        The part's number.
    part
        Its name.
    count
        How many the frame needs.
    spares
        How many to print beyond that.
    volume
        In mm3, of the solid at the kit's values.
    mass
        In g, printed solid.
    seconds
        Print time; None if no slicer was asked.
    filament
        In mm3, with supports, as the slicer fills the part; likewise.
    """

    number: int
    part: str
    count: int
    spares: int
    volume: float
    mass: float
    seconds: int | None = None
    filament: float | None = None


def numbers(kit: Kit) -> dict[str, int]:
    """The number of every part.

    Parameters
    ----------
    kit
        The kit.
    """
    return {name: number for number, name in enumerate(kit.parts, 1)}


def lines(kit: Kit) -> tuple[Line, ...]:
    """The parts that the frame of a kit needs, by number.

    Of parts that are no edge elements one spare in ten is added, rounded up; of pegs, which are
    all of one shape, to those of the first kind.

    Parameters
    ----------
    kit
        The kit; its values, its material, and what a slicer said of it count.
    """
    number, large, density = numbers(kit), set(kit.elements), DENSITIES[kit.material]
    slicing = kit.slicing or Slicing("", {}, {})
    counts = bill(kit.placements, kit.parts)
    small = {part: count for part, count in counts.items() if part not in large}
    pegs = [part for part in small if kit.parts[part].role == "peg"]
    for part in pegs[1:]:
        small[pegs[0]] += small.pop(part)
    found = []
    for part, count in counts.items():
        solid = kit.parts[part]
        size = volume(solid.points(kit.values), solid.triangles)
        found.append(
            Line(
                number=number[part],
                part=part,
                count=count,
                spares=math.ceil(_SPARES * small.get(part, 0)),
                volume=round(size, _DECIMALS),
                mass=round(size / 1000 * density, _DECIMALS),
                seconds=slicing.seconds.get(part),
                filament=slicing.filament.get(part),
            )
        )
    return tuple(found)


def as_json(kit: Kit) -> dict[str, Any]:
    """The bill of materials as JSON values.

    Parameters
    ----------
    kit
        The kit.
    """
    return {
        "material": kit.material,
        "density_g_cm3": DENSITIES[kit.material],
        "sliced": kit.slicing and kit.slicing.how,
        "lines": [
            {name: getattr(line, field) for field, name in _NAMES.items()} for line in lines(kit)
        ],
    }


def with_bill(kit: Kit, entry: Mapping[str, Any]) -> Kit:
    """A kit with the material and the print times of a bill that was written.

    Parameters
    ----------
    kit
        The kit that the bill is of.
    entry
        What `as_json` gave.

    Raises
    ------
    ValueError
        The bill is another kit's.
    """
    times, filament = (
        {line["part"]: line[name] for line in entry["lines"] if line[name] is not None}
        for name in ("print_time_s", "filament_mm3")
    )
    how = entry["sliced"]
    slicing = None if how is None else Slicing(how, times, filament)
    again = replace(kit, material=check_material(entry["material"]), slicing=slicing)
    if _counted(as_json(again)) != _counted(entry):
        msg = "the bill of materials is not the frame's"
        raise ValueError(msg)
    return again


def _counted(entry: Mapping[str, Any]) -> list[Any]:
    """What of a bill is taken as it stands; volumes and masses are computed again."""
    counted = ("number", "part", "count", "spares", "print_time_s", "filament_mm3")
    return [entry["density_g_cm3"], *([line[name] for name in counted] for line in entry["lines"])]


def check_material(name: str) -> str:
    """A material by its name, in whatever case.

    Raises
    ------
    InputError
        Its density is not known.
    """
    if name.upper() not in DENSITIES:
        msg = f"material = {name!r}: must be one of {', '.join(DENSITIES)}"
        raise InputError(msg)
    return name.upper()


def in_words(seconds: float) -> str:
    """A time as people read it, to the minute, rounded up.

    Examples
    --------
    >>> in_words(59), in_words(3661), in_words(200_000)
    ('1 min', '1 h 2 min', '55 h 34 min')
    """
    hours, minutes = divmod(math.ceil(seconds / 60), 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"
