"""What kit the command line asks for."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scadgen.cli.frame_source import is_grid, load_frame, option
from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.kit.build import Request

__all__ = ["kit_request"]

#: Options of named frames that say how large one is, and how large what it fills is, in mm.
_SIZES, _AREAS = {"width", "height", "bay_length"}, {"radius", "outline"}

#: A weave's file has at most this many bytes: its six numbers have some hundred.
_LONGEST_WEAVE = 100_000


def kit_request(
    frame: str, options: Mapping[str, Any], lengths: Collection[str], command: str
) -> tuple[Request, tuple[str, ...]]:
    """What kit to make, and what there is to say of the frame it is for.

    Parameters
    ----------
    frame
        The name of a frame, or of a file.
    options
        Those of the frame and of the kit, by name; None and False where they are not given.
    lengths
        Which of them are live parameters.
    command
        The command that makes the kit again.

    Raises
    ------
    InputError
        There is no such frame or weave, or an option does not go with it.
    """
    from scadgen.kit.build import Request

    own = {"rows", "columns", "key", "rim", "detail", "weave", *lengths}
    values = {n: v for n, v in options.items() if n in lengths and v is not None}
    weave = _weave(options["weave"]) if options["weave"] is not None else None
    # A length of 0 is given, and wrong, though it equals False.
    of_frame = {
        n: v for n, v in options.items() if n not in own and v is not None and v is not False
    }
    detail, rim = options["detail"], options["rim"]
    rows, columns = options["rows"], options["columns"]
    if is_grid(frame, of_frame) and rim == "caps":
        rows, columns = (2 if count is None else count for count in (rows, columns))
        key = options["key"] or "fixed"
        return Request(frame, key, rows, columns, detail, weave, values, command), ()
    from scadgen.frame.catalogue import ALIASES, NAMES

    cells = {"rows": rows, "columns": columns}
    of_frame |= {n: v for n, v in cells.items() if v is not None}
    family = NAMES.get(ALIASES.get(frame, frame))
    areas = sorted(of_frame.keys() & _AREAS)
    cells_grow = family is not None and "edge_length" in family.options
    if cells_grow and "edge_length" in values:
        of_frame["edge_length"] = values["edge_length"]
    elif areas and "edge_length" in values:
        msg = f"frame {frame}: --edge-length and {option(areas[0])}: give one of them"
        raise InputError(msg)
    read = load_frame(frame, of_frame)
    name = re.sub(r"[^A-Za-z0-9.-]+", "_", frame if family else Path(frame).stem).strip("._-")
    request = Request(
        "frame" if name.lower() in ("", "kit") else name,
        options["key"] or "loose",
        0,
        0,
        detail,
        weave,
        values,
        command,
        read.frame,
        rim,
        resizable=family is not None and not of_frame.keys() & (_SIZES | _AREAS),
    )
    if areas and cells_grow and "edge_length" not in values:
        shortest = float(read.frame.lengths.min())
        request = _filled(request, frame, of_frame, shortest)
    plain = _plain(frame, [*of_frame, *(["rim"] if rim != "caps" else [])])
    return request, (*plain, *read.notes)


def _plain(frame: str, given: Sequence[str]) -> tuple[str, ...]:
    """A note that a grid is made as other frames are, if it is one, with the options given."""
    if not is_grid(frame, ()):
        return ()
    causes = " and ".join(option(name) for name in given if not is_grid(frame, [name]))
    note = (
        f"with {causes} this {frame} frame is made as other frames are: its pegs are loose, and "
        "its rows and columns cannot be set later"
    )
    return (note,)


def _filled(request: Request, frame: str, options: Mapping[str, Any], length: float) -> Request:
    """The same with an area that is filled with cells as large as their joints need.

    Raises
    ------
    InputError
        None of them fits.
    """
    from scadgen.kit.any_frame import growth

    scale = growth(request)
    while True:
        length = round(length * scale, 6)
        try:
            read = load_frame(frame, {**options, "edge_length": length})
        except InputError as error:
            if scale < 1:
                # Smaller cells fit; it is something else.
                raise
            msg = (
                f"frame {frame}: its joints need edges of {length:g} mm, and no tile with such "
                "edges fits inside the outline; a larger one or a smaller side works"
            )
            raise InputError(msg) from error
        request = replace(request, graph=read.frame)
        scale = growth(request)
        if scale < 1 + 1e-6:
            return request


def _weave(name: str) -> Any:  # noqa: ANN401  imported late: the import takes a while
    """The built-in weave of a name, or the one in a file."""
    from scadgen.joint.weave import BUILT_IN, Weave
    from scadgen.readers.reading import read_regular

    if name in BUILT_IN:
        return BUILT_IN[name]
    path = Path(name)
    try:
        entries = json.loads(read_regular(path, _LONGEST_WEAVE))
    except OSError as error:
        msg = f"weave {name!r}: neither a file nor one of {', '.join(BUILT_IN)} ({error.strerror})"
        raise InputError(msg) from error
    except InputError as error:
        msg = f"weave {name!r}: {error}"
        raise InputError(msg) from None
    except (ValueError, RecursionError) as error:
        msg = f"weave {name!r}: not a JSON file ({error})"
        raise InputError(msg) from error
    return Weave.from_dict(entries, path.stem)
