"""A frame from the command line: its name or file, with the options of either."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from scadgen.cli.curves import roomiest
from scadgen.cli.words import LENGTH, length, meant
from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.frame.graph import Frame
    from scadgen.readers.reading import Read

__all__ = ["about_file", "about_named", "has_cells", "load_frame", "option", "source_options"]

#: Options of families: type, metavar, what it means; as in the catalogue.
_FAMILY: dict[str, tuple[type | click.ParamType[float], str, str]] = {
    "edge_length": (LENGTH, "MM", "length of the shortest edges, in mm"),
    "rows": (int, "N", "cells up"),
    "columns": (int, "N", "cells across"),
    "radius": (
        LENGTH,
        "MM",
        "radius of a circle to fill instead of rows and columns, in mm, with whole tiles",
    ),
    "outline": (
        str,
        '"X,Y ..."',
        "corners of a polygon to fill instead of rows and columns, in mm, with whole tiles",
    ),
    "width": (LENGTH, "MM", "width of a rectangle or ladder, in mm"),
    "height": (LENGTH, "MM", "height of a rectangle, in mm"),
    "angle": (float, "DEG", "angle of a rhomb at its lower left, in degrees"),
    "sides": (int, "N", "sides of the polygon"),
    "bays": (int, "N", "rectangles in a row"),
    "bay_length": (LENGTH, "MM", "distance of the rungs, in mm"),
    "triangles": (int, "N", "triangles in a row"),
}

_DRAWINGS = (".dxf", ".svg")

#: Options of files: type, metavar, what it means, and kinds of files if not all.
_READING: dict[
    str, tuple[type | click.ParamType[float], str | None, str, tuple[str, ...] | None]
] = {
    "scale": (LENGTH, "MM", "millimetres per unit.  [default: what the file says]", None),
    "unit": (str, "NAME", "the unit instead, by its name: mm, cm, m, inch, foot.", None),
    "centre": (bool, None, "move the middle of the frame to 0.", None),
    "tolerance": (
        LENGTH,
        "MM",
        "ends nearer than this are one; a mesh may be this far from plane.  [default: 0.01]",
        (*_DRAWINGS, ".obj", ".off"),
    ),
    "flatten": (
        LENGTH,
        "MM",
        "segments are this near to their curve.  [default: 0.05, or as joints have room for]",
        _DRAWINGS,
    ),
    "repair": (
        bool,
        None,
        "merge ends, split crossings and drop duplicates, as drawings always have it.",
        (".json", ".obj", ".off"),
    ),
    "no_split": (bool, None, "refuse segments that cross instead of splitting them.", _DRAWINGS),
    "strict": (
        bool,
        None,
        "refuse what cannot be part of a frame, instead of leaving it out.",
        (*_DRAWINGS, ".obj"),
    ),
    "components": (bool, None, "allow several parts that are not connected.", None),
    "shortest": (LENGTH, "MM", "refuse edges shorter than this.", None),
    "most": (int, "N", "allow this many vertices, segments or edges.  [default: 100000]", None),
}


#: What --snap does.
_SNAP = (
    "move vertices by up to this, so that lengths and angles that are nearly the same are the same"
)

#: Options that kinds of files have only with --repair, if at all.
_OF_REPAIR = ("tolerance", "no_split")


def source_options(
    without: Collection[str] = (),
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Give a command the options of named frames and of files, and of what is done to either.

    Parameters
    ----------
    without
        Names of options that the command has already.
    """

    def add(function: Callable[..., Any]) -> Callable[..., Any]:
        function = click.option(
            "--snap",
            type=LENGTH,
            metavar="MM",
            help=f"{_SNAP[0].upper()}{_SNAP[1:]}.",
        )(function)
        for name, (kind, metavar, what, _) in reversed(_READING.items()):
            text = f"Files: {what}"
            form: dict[str, Any] = {"type": kind, "metavar": metavar}
            given = {"is_flag": True} if kind is bool else form
            function = click.option(option(name), name, help=text, **given)(function)
        for name, (kind, metavar, what) in reversed(_FAMILY.items()):
            if name not in without:
                text = f"Named frames: {what}."
                add_one = click.option(option(name), name, type=kind, metavar=metavar, help=text)
                function = add_one(function)
        return function

    return add


def about_named(names: Iterable[str]) -> dict[str, dict[str, str | None]]:
    """What each option of a named frame takes, and what it means; as JSON values."""
    return {name: _about(*_FAMILY[name][1:]) for name in names}


def about_file(kind: str) -> dict[str, dict[str, str | None]]:
    """The same of all options of a kind of file, by the end of its name."""
    found = {
        name: _about(metavar, what.rstrip("."))
        for name, (_, metavar, what, kinds) in _READING.items()
        if kinds is None or kind in kinds or name in _OF_REPAIR
    }
    return {**found, "snap": _about("MM", _SNAP)}


def _about(metavar: str | None, what: str) -> dict[str, str | None]:
    return {"form": metavar, "text": what}


def has_cells(name: str, options: Iterable[str]) -> bool:
    """Whether a kit of this frame, with these options given, has rows and columns to set.

    Parameters
    ----------
    name
        What was named: a frame or a file.
    options
        Names of the options of frames that are given.
    """
    from scadgen.plane.catalogue import ALIASES, NAMES

    family = NAMES.get(ALIASES.get(name, name))
    shaped = {"edge_length", "rows", "columns", "width", "height", "angle"}
    return family is not None and "rows" in family.options and {*options} <= shaped


def load_frame(
    name: str, options: Mapping[str, Any], room: Callable[[Frame], float] | None = None
) -> Read:
    """Make or read a frame.

    Parameters
    ----------
    name
        What was named: a frame or a file.
    options
        What `source_options` gave.
    room
        The share of the room that a frame's joints have, at 1 enough: curves of drawings are as
        fine as that allows, unless it is said how fine.

    Raises
    ------
    InputError
        It is neither; an option that this frame or kind of file does not have; or what the
        frame or the reader refuses.
    """
    given = {k: v for k, v in options.items() if v is not None and v is not False}
    within = given.pop("snap", None)
    found = _load(name, given, room)
    if within is None:
        return found
    from scadgen.plane.snapping import move_vertices
    from scadgen.readers.reading import Read

    moved = move_vertices(found.frame, within, given.get("shortest", 0.0))
    return Read(moved.frame, (*found.notes, *moved.notes), found.places)


def _load(name: str, given: dict[str, Any], room: Callable[[Frame], float] | None) -> Read:
    """Make or read a frame as it is."""
    from scadgen.plane.catalogue import ALIASES, NAMES, named
    from scadgen.readers.read import READERS, read
    from scadgen.readers.reading import Read, Reading
    from scadgen.readers.units import unit

    family = NAMES.get(ALIASES.get(name, name))
    if family is not None:
        _check_options(name, given, family.options)
        if "outline" in given:
            given["outline"] = _corners(given["outline"])
        return Read(named(name, **given))
    path = Path(name)
    kind = path.suffix.lower()
    if kind not in READERS:
        msg = (
            f"frame {name!r}: must be a name that scadgen frame --list shows"
            f"{meant(name, [*NAMES, *ALIASES])}, or a file that ends in {', '.join(READERS)}"
        )
        raise InputError(msg)
    taken = [
        one
        for one, (*_, kinds) in _READING.items()
        if kinds is None or kind in kinds or (one in _OF_REPAIR and "repair" in given)
    ]
    for one in _OF_REPAIR:
        if one in given and one not in taken:
            msg = f"frame {name}: {option(one)} needs --repair"
            raise InputError(msg)
    _check_options(name, given, taken)
    if "unit" in given:
        if "scale" in given:
            msg = f"frame {name}: --scale and --unit: give one of them"
            raise InputError(msg)
        given["scale"] = unit(given.pop("unit"))
    if given.pop("no_split", False):
        given["split"] = False
    how = Reading(**given)
    found = read(path, how)
    if room is not None and kind in _DRAWINGS and "flatten" not in given:
        found = roomiest(
            found, how.flatten, lambda within: read(path, replace(how, flatten=within)), room
        )
    # What a file is called may not do as a frame's name in JSON.
    called = found.frame.name.encode(errors="surrogateescape").decode(errors="replace")
    plain = re.sub(r"[^\w. -]", "_", called)[:100]
    return replace(found, frame=replace(found.frame, name=plain))


def option(name: str) -> str:
    """How an option is typed."""
    return f"--{name.replace('_', '-')}"


def _corners(text: str) -> list[list[float]]:
    """Corners of an outline, as they are typed."""
    try:
        corners = [[length(number) for number in pair.split(",")] for pair in text.split()]
    except InputError:
        corners = []
    if len(corners) < 3 or {len(corner) for corner in corners} != {2}:
        msg = f'outline = {text!r}: must be 3 or more corners such as "0,0 300,0 150,200", in mm'
        raise InputError(msg)
    return corners


def _check_options(name: str, given: Iterable[str], taken: Iterable[str]) -> None:
    strange = sorted(set(given) - set(taken))
    if strange:
        lists = [", ".join(map(option, names)) for names in (strange, taken)]
        msg = f"frame {name}: no option {lists[0]}; it has {lists[1]}"
        raise InputError(msg)
