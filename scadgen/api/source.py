"""A frame from its name, its file, or what a program has, with the options of each."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from scadgen.api.curves import roomiest
from scadgen.api.drawing import Drawing
from scadgen.api.options import DRAWINGS, OF_REPAIR, READING, option
from scadgen.api.words import length, meant
from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.frame.graph import Frame
    from scadgen.plane.catalogue import Family
    from scadgen.readers.reading import Read, Reading

__all__ = ["Source", "called", "family_of", "has_cells", "is_file", "load_frame", "renamed"]

#: The name of a frame, or of a file; or what a program has.
Source: TypeAlias = str | Drawing


def called(source: Source) -> str:
    """What messages call it."""
    return source if isinstance(source, str) else source.name


def family_of(source: Source) -> Family | None:
    """The named frames that it is one of, if it is."""
    from scadgen.plane.catalogue import ALIASES, NAMES

    return NAMES.get(ALIASES.get(source, source)) if isinstance(source, str) else None


def is_file(source: Source) -> bool:
    """Whether it can be a file only."""
    return isinstance(source, str) and family_of(source) is None


def has_cells(source: Source, options: Iterable[str]) -> bool:
    """Whether a kit of this frame, with these options given, has rows and columns to set.

    Parameters
    ----------
    source
        What was named: a frame or a file; or what a program has.
    options
        Names of the options of frames that are given.
    """
    family = family_of(source)
    shaped = {"edge_length", "rows", "columns", "width", "height", "angle"}
    return family is not None and "rows" in family.options and {*options} <= shaped


def load_frame(
    source: Source, options: Mapping[str, Any], room: Callable[[Frame], float] | None = None
) -> Read:
    """Make or read a frame.

    Parameters
    ----------
    source
        What was named: a frame or a file; or what a program has.
    options
        Those of `FAMILY` or `READING`, and ``snap``; None and False where they are not given.
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
    found = _load(source, given, room)
    if within is None:
        return found
    from scadgen.plane.snapping import move_vertices
    from scadgen.readers.reading import Read

    moved = move_vertices(found.frame, within, given.get("shortest", 0.0))
    return Read(moved.frame, (*found.notes, *moved.notes), found.places)


def _load(source: Source, given: dict[str, Any], room: Callable[[Frame], float] | None) -> Read:
    """Make or read a frame as it is."""
    from scadgen.plane.catalogue import named
    from scadgen.readers.reading import Read

    family = family_of(source)
    if family is not None and isinstance(source, str):
        _check_options(source, given, family.options)
        if "outline" in given:
            given["outline"] = _corners(given["outline"])
        return Read(named(source, **given))
    kind, read = _reader(source)
    how = _reading(called(source), kind, given)
    found = read(how)
    if room is not None and kind in DRAWINGS and "flatten" not in given:
        found = roomiest(
            found, how.flatten, lambda within: read(replace(how, flatten=within)), room
        )
    return replace(found, frame=renamed(found.frame, found.frame.name))


def renamed(frame: Frame, name: str) -> Frame:
    """The same frame by another name, or by what of it does as a frame's name in JSON."""
    known = name.encode(errors="surrogateescape").decode(errors="replace")
    return replace(frame, name=re.sub(r"[^\w. -]", "_", known)[:100])


def _reader(source: Source) -> tuple[str, Callable[[Reading], Read]]:
    """What kind of source it is, and what reads it."""
    from scadgen.plane.catalogue import ALIASES, NAMES
    from scadgen.readers.read import READERS, read

    if isinstance(source, Drawing):
        return source.kind, lambda how: _told(source, how)
    path = Path(source)
    kind = path.suffix.lower()
    if kind not in READERS:
        msg = (
            f"frame {source!r}: must be a name that scadgen frame --list shows"
            f"{meant(source, [*NAMES, *ALIASES])}, or a file that ends in {', '.join(READERS)}"
        )
        raise InputError(msg)
    return kind, lambda how: read(path, how)


def _told(source: Drawing, how: Reading) -> Read:
    """What a program has as a frame; what is wrong with it is told with its name."""
    try:
        return source.read(how)
    except InputError as error:
        msg = f"{source.name}: {error}"
        raise InputError(msg) from None


def _reading(name: str, kind: str, given: Mapping[str, Any]) -> Reading:
    """How to read a kind of source, with these options given.

    Raises
    ------
    InputError
        It does not have one of them, or not with the others.
    """
    from scadgen.readers.reading import Reading
    from scadgen.readers.units import unit

    taken = [
        one
        for one, known in READING.items()
        if known.sources is None
        or kind in known.sources
        or (one in OF_REPAIR and "repair" in given)
    ]
    for one in OF_REPAIR:
        if one in given and one not in taken:
            msg = f"frame {name}: {option(one)} needs --repair"
            raise InputError(msg)
    _check_options(name, given, taken)
    wanted = dict(given)
    if "unit" in wanted:
        if "scale" in wanted:
            msg = f"frame {name}: --scale and --unit: give one of them"
            raise InputError(msg)
        wanted["scale"] = unit(wanted.pop("unit"))
    if wanted.pop("no_split", False):
        wanted["split"] = False
    return Reading(**wanted)


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
