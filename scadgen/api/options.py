"""The options of frames, in one table for the command line and for Python."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

__all__ = [
    "DRAWINGS",
    "FAMILY",
    "GRAPH",
    "LINES",
    "OF_REPAIR",
    "READING",
    "SNAP",
    "Option",
    "about_file",
    "about_named",
    "option",
]

#: Files that are drawings, by their endings.
DRAWINGS = (".dxf", ".svg")

#: What a program gives: vertices with edges, and lines.
GRAPH, LINES = "graph", "lines"


@dataclass(frozen=True, slots=True)
class Option:
    """An option of frames.

    Parameters
    ----------
    kind
        What its values are: a length in mm, a whole number, a number, a flag or a text.
    metavar
        What stands for its value in a help text; None for a flag.
    text
        What it means.
    sources
        Endings of files, `GRAPH` and `LINES`: what has it; None if all have it.
    """

    kind: Literal["length", "whole", "number", "flag", "text"]
    metavar: str | None
    text: str
    sources: tuple[str, ...] | None = None


#: Options of named frames, as in the catalogue.
FAMILY: Mapping[str, Option] = MappingProxyType(
    {
        "edge_length": Option("length", "MM", "length of the shortest edges, in mm"),
        "rows": Option("whole", "N", "cells up"),
        "columns": Option("whole", "N", "cells across"),
        "radius": Option(
            "length",
            "MM",
            "radius of a circle to fill instead of rows and columns, in mm, with whole tiles",
        ),
        "outline": Option(
            "text",
            '"X,Y ..."',
            "corners of a polygon to fill instead of rows and columns, in mm, with whole tiles",
        ),
        "width": Option("length", "MM", "width of a rectangle or ladder, in mm"),
        "height": Option("length", "MM", "height of a rectangle, in mm"),
        "angle": Option("number", "DEG", "angle of a rhomb at its lower left, in degrees"),
        "sides": Option("whole", "N", "sides of the polygon"),
        "bays": Option("whole", "N", "rectangles in a row"),
        "bay_length": Option("length", "MM", "distance of the rungs, in mm"),
        "triangles": Option("whole", "N", "triangles in a row"),
    }
)

#: Options of files, and of what a program gives.
READING: Mapping[str, Option] = MappingProxyType(
    {
        "scale": Option("length", "MM", "millimetres per unit.  [default: what the file says]"),
        "unit": Option("text", "NAME", "the unit instead, by its name: mm, cm, m, inch, foot."),
        "centre": Option("flag", None, "move the middle of the frame to 0."),
        "tolerance": Option(
            "length",
            "MM",
            "ends nearer than this are one; a mesh may be this far from plane.  [default: 0.01]",
            (*DRAWINGS, ".obj", ".off", LINES),
        ),
        "flatten": Option(
            "length",
            "MM",
            "segments are this near to their curve.  [default: 0.05, or as joints have room for]",
            DRAWINGS,
        ),
        "repair": Option(
            "flag",
            None,
            "merge ends, split crossings and drop duplicates, as drawings always have it.",
            (".json", ".obj", ".off", GRAPH),
        ),
        "no_split": Option(
            "flag",
            None,
            "refuse segments that cross instead of splitting them.",
            (*DRAWINGS, LINES),
        ),
        "strict": Option(
            "flag",
            None,
            "refuse what cannot be part of a frame, instead of leaving it out.",
            (*DRAWINGS, ".obj"),
        ),
        "components": Option("flag", None, "allow several parts that are not connected."),
        "shortest": Option("length", "MM", "refuse edges shorter than this."),
        "most": Option(
            "whole", "N", "allow this many vertices, segments or edges.  [default: 100000]"
        ),
    }
)

#: Options that some sources have only with ``repair``, if at all.
OF_REPAIR = ("tolerance", "no_split")


#: What ``snap`` does.
SNAP = Option(
    "length",
    "MM",
    "move vertices by up to this, so that lengths and angles that are nearly the same are the same",
)


def about_named(names: Iterable[str]) -> dict[str, dict[str, str | None]]:
    """What each option of a named frame takes, and what it means; as JSON values."""
    return {name: _about(FAMILY[name]) for name in names}


def about_file(kind: str) -> dict[str, dict[str, str | None]]:
    """The same of all options of a kind of file, by the end of its name."""
    found = {
        name: _about(one)
        for name, one in READING.items()
        if one.sources is None or kind in one.sources or name in OF_REPAIR
    }
    return {**found, "snap": _about(SNAP)}


def _about(one: Option) -> dict[str, str | None]:
    return {"form": one.metavar, "text": one.text.rstrip(".")}


def option(name: str) -> str:
    """How an option is typed."""
    return f"--{name.replace('_', '-')}"
