"""The kit's own README: what to print, how to print it, how to put it together."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from scadgen import __version__
from scadgen.emit.part_words import words
from scadgen.emit.picture import MOST_JOINTS
from scadgen.emit.scad_parameters import Parameter, sections
from scadgen.emit.scad_text import literal
from scadgen.emit.templates import environment
from scadgen.frame.placement import bill
from scadgen.kit.bill import Line, in_words, lines
from scadgen.kit.cells import MOST_CELLS
from scadgen.kit.model import DENSITIES, Joint, Kit
from scadgen.kit.ranges import span

__all__ = ["readme"]

#: Decimals to which bounds are shown, rounded inwards.
_DECIMALS = 2

#: What halves are called, by their role.
_HALVES = {"half_a": "half A", "half_b": "half B"}

#: All that has a meaning in the middle of a line of Markdown.
_MARKS = re.compile(r"([\\`*_\[\]<>&|~#!])")


def readme(kit: Kit) -> str:
    """Write the README that stands beside a kit's other files.

    Parameters
    ----------
    kit
        The kit; nothing in it is trusted to be harmless as text.

    Returns
    -------
    text
        Markdown, UTF-8.
    """
    needed, what = lines(kit), words(kit)
    asked = [line.part for line in needed]
    settings = {p.name: p for section in sections(kit) for p in section.parameters}
    engine = environment()
    engine.filters["md"] = _plain
    return engine.get_template("kit_readme.md.j2").render(
        version=__version__,
        frame=kit.name,
        key=kit.key,
        rows=kit.rows,
        columns=kit.columns,
        detail=kit.detail,
        scad=f"{kit.name}.scad",
        macro=f"{kit.name}.FCMacro",
        needed=[_needed(line, what[line.part]) for line in needed],
        all=_whole(kit, needed),
        material=kit.material,
        density=DENSITIES[kit.material],
        sliced=kit.slicing and kit.slicing.how,
        pegs=[name for name in asked if kit.parts[name].role == "peg" and name != "peg"],
        others=[f"`{name}`" for name in kit.parts if name not in asked],
        joints=[_joint(kit, one) for one in kit.joints],
        regular=kit.tiling is not None and kit.tiling.regular,
        cells=kit.cells is not None,
        caps=any(place.role == "cap" for place in kit.placements),
        halves=_halves(kit),
        lopsided=any(kit.parts[name].fits_one_way for name in asked),
        second_shapes=[
            f"`{name}`"
            for name in asked
            if kit.parts[name].role == "half" and kit.parts[name].ends[0].over
        ],
        half_names=sorted({name for one in kit.joints for name in one.half_parts}),
        other_way_up=any(place.other_way_up for place in kit.placements),
        side=literal(kit.values["side"]),
        peg_length=literal(kit.values["peg_length"]),
        coupon_count=settings["coupon_count"].value,
        coupon_first=settings["coupon_first"].value,
        coupon_step=settings["coupon_step"].value,
        live=[_live(kit, settings[name]) for name in settings if name in kit.values],
        most_cells=MOST_CELLS,
        most_joints=MOST_JOINTS,
        proved=kit.proved,
        command=_fenced(kit.command),
    )


def _joint(kit: Kit, one: Joint) -> dict[str, Any]:
    """What a kind of joint is made of, and what is known about it."""
    return {
        "name": one.name,
        "title": one.title,
        "plain_bill": [_count(*line) for line in bill(one.pieces, kit.parts).items()],
        "bill": [_counted(one, *line) for line in bill(one.pieces, kit.parts).items()],
        "angles": [f"{b - a:.5g}" for a, b in pairwise([*one.turns, 360.0])],
        "weave": {name: _text(value) for name, value in one.weave.items()},
        "verdicts": {name: _text(found) for name, found in one.verdicts.items()},
        "figures": {name: _text(value) for name, value in one.figures.items()},
    }


def _halves(kit: Kit) -> str:
    """The halves of a key in the order in which they go in; "" where that is not one for all."""
    orders = {
        tuple(
            one.pieces[piece].role
            for way in reversed(one.ways)
            for piece in way.moving
            if one.pieces[piece].role in _HALVES
        )
        for one in kit.joints
    }
    order = [_HALVES[role] for role in orders.pop()]
    return "" if orders or len(order) != len(_HALVES) else " and then ".join(order)


def _counted(one: Joint, part: str, count: int) -> str:
    """How many of a part a joint has, as which half, and at which angle one lies upside down."""
    mine = [p for p in one.pieces if p.part == part]
    roles = {p.role for p in mine}
    notes = []
    for role, half in _HALVES.items():
        turns = ", ".join(f"{p.pose.degrees:.4g}°" for p in mine if p.role == role)
        if turns and len(one.half_parts) > 1:
            notes.append(half if len(roles) == 1 else f"{half} at {turns}")
    if over := [f"{p.pose.degrees:.4g}°" for p in mine if p.other_way_up]:
        notes.append(f"upside down at {', '.join(over)}")
    return _count(part, count) + (f" ({', '.join(notes)})" if notes else "")


def _count(part: str, count: int) -> str:
    return f"{count} x `{part}`"


def _needed(line: Line, what: str) -> dict[str, Any]:
    """A line of the bill, and what the part is; volumes in cm3, time in words."""
    return {
        "number": line.number,
        "part": line.part,
        "what": what,
        "count": line.count,
        "spare": line.spares,
        "each": line.volume / 1000,
        "all": line.count * line.volume / 1000,
        "grams": line.count * line.mass,
        "time": "" if line.seconds is None else in_words(line.seconds),
    }


def _whole(kit: Kit, needed: Sequence[Line]) -> dict[str, Any]:
    """The whole frame, without spares."""
    times = [line.count * line.seconds for line in needed if line.seconds is not None]
    spun = [line.count * line.filament for line in needed if line.filament is not None]
    return {
        "count": sum(line.count for line in needed),
        "volume": sum(line.count * line.volume for line in needed) / 1000,
        "grams": sum(line.count * line.mass for line in needed),
        "time": in_words(sum(times)) if times else "",
        "spun": sum(spun) / 1000 * DENSITIES[kit.material],
    }


def _live(kit: Kit, parameter: Parameter) -> Mapping[str, str]:
    """One live parameter: name, value, range if it alone is changed, meaning."""
    low, high = span(kit.ranges, parameter.name, kit.values)
    unit = 10.0**_DECIMALS
    return {
        "name": parameter.name,
        "value": parameter.value,
        "low": literal(math.ceil(low * unit - 1e-6) / unit),
        "high": literal(math.floor(high * unit + 1e-6) / unit),
        "meaning": parameter.text.removesuffix(", mm"),
    }


def _text(value: float | str) -> str:
    """A name as it is; a number with five significant digits."""
    return value if isinstance(value, str) else f"{value:.5g}"


def _one_line(text: str) -> str:
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


def _plain(text: str) -> str:
    """Text that Markdown shows as it is, in one line."""
    return _MARKS.sub(r"\\\1", _one_line(text))


def _fenced(text: str) -> str:
    """Text as a code block, whatever it holds, in one line; nothing for no text."""
    line = _one_line(text)
    if not line:
        return ""
    fence = "`" * max(3, 1 + max(map(len, re.findall("`+", line)), default=0))
    return f"{fence}\n{line}\n{fence}"
