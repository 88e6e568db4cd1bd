"""A frame from the command line: its name or file, with the options of either."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.readers.reading import Read

__all__ = ["has_cells", "load_frame", "option", "source_options"]

#: Options of families: type, metavar, what it means; as in the catalogue.
_FAMILY: dict[str, tuple[type, str, str]] = {
    "edge_length": (float, "MM", "length of the shortest edges, in mm"),
    "rows": (int, "N", "cells up"),
    "columns": (int, "N", "cells across"),
    "radius": (
        float,
        "MM",
        "radius of a circle to fill instead of rows and columns, in mm, with whole tiles",
    ),
    "outline": (
        str,
        '"X,Y ..."',
        "corners of a polygon to fill instead of rows and columns, in mm, with whole tiles",
    ),
    "width": (float, "MM", "width of a rectangle or ladder, in mm"),
    "height": (float, "MM", "height of a rectangle, in mm"),
    "angle": (float, "DEG", "angle of a rhomb at its lower left, in degrees"),
    "sides": (int, "N", "sides of the polygon"),
    "bays": (int, "N", "rectangles in a row"),
    "bay_length": (float, "MM", "distance of the rungs, in mm"),
    "triangles": (int, "N", "triangles in a row"),
}

_DRAWINGS = (".dxf", ".svg")

#: Options of files: type, metavar, what it means, and kinds of files if not all.
_READING: dict[str, tuple[type, str | None, str, tuple[str, ...] | None]] = {
    "scale": (float, "MM", "millimetres per unit.  [default: what the file says]", None),
    "tolerance": (
        float,
        "MM",
        "ends nearer than this are one; a mesh may be this far from plane.  [default: 0.01]",
        (*_DRAWINGS, ".obj", ".off"),
    ),
    "flatten": (float, "MM", "segments are this near to their curve.  [default: 0.05]", _DRAWINGS),
    "repair": (
        bool,
        None,
        "merge ends, split crossings and drop duplicates, as drawings always have it.",
        (".json", ".obj", ".off"),
    ),
    "no_split": (bool, None, "refuse segments that cross instead of splitting them.", _DRAWINGS),
    "skip_unknown": (bool, None, "leave out what cannot be part of a frame.", (*_DRAWINGS, ".obj")),
    "components": (bool, None, "allow several parts that are not connected.", None),
    "shortest": (float, "MM", "refuse edges shorter than this.", None),
    "most": (int, "N", "allow this many vertices, segments or edges.  [default: 100000]", None),
}


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
            type=float,
            metavar="MM",
            help="Move vertices by up to this, so that lengths and angles that are nearly the same "
            "are the same.",
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


def load_frame(name: str, options: Mapping[str, Any]) -> Read:
    """Make or read a frame.

    Parameters
    ----------
    name
        What was named: a frame or a file.
    options
        What `source_options` gave.

    Raises
    ------
    InputError
        It is neither; an option that this frame or kind of file does not have; or what the
        frame or the reader refuses.
    """
    given = {k: v for k, v in options.items() if v is not None and v is not False}
    within = given.pop("snap", None)
    found = _load(name, given)
    if within is None:
        return found
    from scadgen.plane.snapping import move_vertices
    from scadgen.readers.reading import Read

    moved = move_vertices(found.frame, within, given.get("shortest", 0.0))
    return Read(moved.frame, (*found.notes, *moved.notes))


def _load(name: str, given: dict[str, Any]) -> Read:
    """Make or read a frame as it is."""
    from scadgen.plane.catalogue import ALIASES, NAMES, named
    from scadgen.readers.read import READERS, read
    from scadgen.readers.reading import Read, Reading

    family = NAMES.get(ALIASES.get(name, name))
    if family is not None:
        _check_options(name, given, family.options)
        if "outline" in given:
            given["outline"] = _corners(given["outline"])
        return Read(named(name, **given))
    path = Path(name)
    kind = path.suffix.lower()
    if kind not in READERS:
        near = get_close_matches(name, [*NAMES, *ALIASES], n=1)
        meant = f", such as {near[0]}" if near else ""
        msg = (
            f"frame {name!r}: must be a name that scadgen frame --list shows{meant}, or a file "
            f"that ends in {', '.join(READERS)}"
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
    if given.pop("no_split", False):
        given["split"] = False
    found = read(path, Reading(**given))
    # What a file is called may not do as a frame's name in JSON.
    plain = re.sub(r"[^\w. -]", "_", found.frame.name)[:100]
    return Read(replace(found.frame, name=plain), found.notes)


def option(name: str) -> str:
    """How an option is typed."""
    return f"--{name.replace('_', '-')}"


def _corners(text: str) -> list[list[float]]:
    """Corners of an outline, as they are typed."""
    try:
        corners = [[float(number) for number in pair.split(",")] for pair in text.split()]
    except ValueError:
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
