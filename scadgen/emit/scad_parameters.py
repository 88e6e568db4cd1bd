"""The Customizer's side of a kit: sections, sliders, choices and parameter sets."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass

from scadgen.emit.scad_numbers import HIGHEST
from scadgen.emit.scad_text import literal
from scadgen.errors import InvariantError
from scadgen.kit.cells import MOST_CELLS
from scadgen.kit.live import LIVE
from scadgen.kit.model import Kit, Part
from scadgen.kit.roles import PART_ROLES

__all__ = [
    "Parameter",
    "Section",
    "label",
    "limits",
    "parameter_sets",
    "sections",
    "views",
]

#: What each part of regular joints is, for the Customizer; no comma, colon or bracket.
_PARTS: Mapping[str, str] = {
    "basic": "Edge element with two connectors",
    "one_sided": "Edge element with connector and peg end",
    "two_sided": "Edge element with two peg ends",
    "half": "Locking half - print two a joint",
}

#: What else is drawn.
_VIEWS: Mapping[str, str] = {
    "plate": "Print plate of a whole frame",
    "joint_plate": "Print plate of one joint to try first",
    "frame": "Frame assembled",
    "coupon": "Coupon to find the clearance",
}

#: A slider longer than this, in mm, cannot be set by hand.
_LONGEST = 1000.0


@dataclass(frozen=True, slots=True)
class Parameter:
    """One line of the Customizer.

    Parameters
    ----------
    name
        OpenSCAD variable.
    value
        Its default, as OpenSCAD text.
    widget
        What stands in the comment behind it.
    text
        What stands in the comment above it.
    """

    name: str
    value: str
    widget: str
    text: str


@dataclass(frozen=True, slots=True)
class Section:
    """One tab of the Customizer."""

    title: str
    parameters: tuple[Parameter, ...]


#: What is set for numbers on tubes.
_NUMBERS = Section(
    "Numbers",
    (
        Parameter(
            "number_height",
            "0",
            f"[-{HIGHEST}:0.1:{HIGHEST}]",
            "Height of each edge element's number on its tube, mm (0: none; below 0: sunk in)",
        ),
    ),
)


def views(kit: Kit) -> dict[str, str]:
    """What is drawn beside single parts, as ``part`` names it, and what that is."""
    joints: dict[str, str] = {}
    for one in kit.joints:
        name = f"Joint {one.name}".strip()
        joints |= {one.view: f"{name} assembled", f"{one.view}_exploded": f"{name} pulled apart"}
    plates, others = ("plate", "joint_plate"), ("frame", "coupon")
    return {n: _VIEWS[n] for n in plates} | joints | {n: _VIEWS[n] for n in others}


def label(part: Part) -> str:
    """What a part is, in a few words."""
    if part.name in _PARTS:
        return _PARTS[part.name]
    number = part.name.partition("_")[2].removesuffix("_over")
    said = " ".join(PART_ROLES[part.role].text.format(number).split())
    return f"{said} - second shape" if part.role == "half" and part.ends[0].over else said


def sections(kit: Kit) -> tuple[Section, ...]:
    """Everything a user can set, in the order of the file."""
    choices = {name: label(part) for name, part in kit.parts.items()} | views(kit)
    widget = "[" + ", ".join(f"{name}:{text}" for name, text in choices.items()) + "]"
    shown = f'"{kit.joints[0].view}"'
    live: dict[str, list[Parameter]] = {}
    for one in LIVE:
        if one.name in kit.values:
            value, slider = literal(kit.values[one.name]), _slider(kit, one.name, one.step)
            live.setdefault(one.section, []).append(
                Parameter(one.name, value, slider, f"{one.text}, mm")
            )
    first = literal(min(1.0, max(0.02, round(kit.values["peg_clearance"] - 0.05, 2))))
    return (
        Section("Part", (Parameter("part", shown, widget, "What to draw"),)),
        *(Section(title, tuple(rows)) for title, rows in live.items()),
        _NUMBERS,
        *([_cells(kit)] if kit.cells else []),
        Section(
            "Plate",
            (
                Parameter("bed", "[220, 220]", "[20:1:1000]", "Width and depth of the bed, mm"),
                Parameter("plate_number", "1", "[1:1:200]", "Which of the plates to draw"),
                Parameter("spacing", "3", "[0.5:0.5:20]", "Room between two parts, mm"),
            ),
        ),
        Section(
            "Coupon",
            (
                Parameter("coupon_first", first, "[0:0.01:1]", "Gap of the first socket, mm"),
                Parameter("coupon_step", "0.05", "[0.01:0.01:0.5]", "Added gap a socket, mm"),
                Parameter("coupon_count", "5", "[1:1:8]", "Number of sockets"),
            ),
        ),
        Section(
            "View",
            (
                Parameter(
                    "explode",
                    "0",
                    "[0:0.1:4]",
                    "How far the frame is pulled apart, in sides (the joint: 3.5 when 0)",
                ),
            ),
        ),
    )


def _cells(kit: Kit) -> Section:
    """The sliders of a frame that has rows and columns."""
    cells = f"[1:1:{MOST_CELLS}]"
    return Section(
        "Frame",
        (
            Parameter("rows", str(kit.rows), cells, "Cells of the frame, bottom to top"),
            Parameter("columns", str(kit.columns), cells, "Cells of the frame, left to right"),
        ),
    )


def limits(kit: Kit, name: str, values: Mapping[str, float]) -> tuple[float, float]:
    """Lowest and highest value of a live parameter, in mm, at the others' values.

    Raises
    ------
    InvariantError
        If the kit has no range for it.
    """
    own = [r for r in kit.ranges if r.parameter == name]
    if not own:
        msg = f"every live parameter has a range: {name} has none"
        raise InvariantError(msg)
    return max(r.low(values) for r in own), min(r.high(values) for r in own)


def _slider(kit: Kit, name: str, step: float) -> str:
    """Range at the defaults, on a grid of steps that the default is on too."""
    low, high = limits(kit, name, kit.values)
    default = kit.values[name]
    high = min(high, max(_LONGEST, 2 * default))
    while step > 1e-4 and abs(default / step - round(default / step)) > 1e-6:
        step /= 10
    # Nudged by a millionth of a step: bounds that are on the grid stay on it.
    first = math.ceil(low / step - 1e-6) * step
    last = math.floor(high / step + 1e-6) * step
    return "[" + ":".join(literal(round(x, 6)) for x in (first, step, last)) + "]"


def parameter_sets(kit: Kit) -> str:
    """JSON file of parameter sets that the Customizer finds beside the ``.scad``.

    Every set is inside the kit's ranges; one that cannot be is left out.

    Returns
    -------
    text
        JSON, all values strings as OpenSCAD wants them.
    """
    defaults = {p.name: p.value.strip('"') for s in sections(kit) for p in s.parameters}
    gaps = [name for name in ("clearance", "peg_clearance") if name in kit.values]
    lengths = [name for name in kit.values if name not in gaps]
    sets = {
        "default": defaults,
        "tight fit": _scaled(kit, defaults, gaps, 0.75),
        "loose fit": _scaled(kit, defaults, gaps, 1.5),
        "half size": _scaled(kit, defaults, lengths, 0.5),
        "double size": _scaled(kit, defaults, lengths, 2.0),
        "short edges": _scaled(kit, defaults, ["edge_length"], 0.75),
        "exploded joint": defaults | {"part": f"{kit.joints[0].view}_exploded"},
        "whole frame": defaults | {"part": "frame"},
        "print plate": defaults | {"part": "plate"},
        "coupon": defaults | {"part": "coupon"},
    }
    kept = {name: values for name, values in sets.items() if values is not None}
    return json.dumps({"fileFormatVersion": "1", "parameterSets": kept}, indent=2) + "\n"


def _scaled(
    kit: Kit, defaults: Mapping[str, str], names: list[str], factor: float
) -> dict[str, str] | None:
    """Set with some live parameters scaled, or None if a range forbids it."""
    values = {n: round(v * factor, 3) if n in names else v for n, v in kit.values.items()}
    for name, value in values.items():
        low, high = limits(kit, name, values)
        if not low <= value <= high:
            return None
    return {**defaults, **{name: literal(value) for name, value in values.items()}}
