"""What kit is asked for: a frame, with options, as a request."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scadgen.api.curves import share_of_room
from scadgen.api.options import option
from scadgen.api.source import Source, called, family_of, has_cells, is_file, load_frame
from scadgen.api.words import meant
from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.kit.build import Request
    from scadgen.kit.model import Kit

__all__ = ["keys_note", "kit_request", "plain_name"]

#: Options of named frames that say how large one is, and how large what it fills is, in mm.
_SIZES, _AREAS = {"width", "height", "bay_length"}, {"radius", "outline"}

#: A weave's file has at most this many bytes: its six numbers have some hundred.
_LONGEST_WEAVE = 100_000


def kit_request(
    frame: Source, options: Mapping[str, Any], lengths: Collection[str], command: str
) -> tuple[Request, tuple[str, ...]]:
    """What kit to make, and what there is to say of the frame it is for.

    Parameters
    ----------
    frame
        The name of a frame, or of a file; or what a program has.
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
    from scadgen.plane.catalogue import ALIASES, NamedTiling

    own = {"rows", "columns", "key", "rim", "detail", "weave", *lengths}
    # A length of 0 is given, and wrong, though it equals False.
    of_frame = {
        n: v for n, v in options.items() if n not in own and v is not None and v is not False
    }
    family = family_of(frame)
    name = called(frame)
    wanted: dict[str, Any] = {
        "name": plain_name(Path(name).stem if is_file(frame) else name),
        "detail": options["detail"],
        "weave": _weave(options["weave"]) if options["weave"] is not None else None,
        "values": {n: v for n, v in options.items() if n in lengths and v is not None},
        "command": command,
        "resizable": family is not None and not of_frame.keys() & (_SIZES | _AREAS),
    }
    cells = {n: options[n] for n in ("rows", "columns")}
    if has_cells(frame, of_frame) and options["rim"] == "caps":
        tiling = NamedTiling(ALIASES.get(name, name), of_frame)
        return Request.tiled(tiling, key=options["key"], **cells, **wanted), ()
    of_frame |= {n: v for n, v in cells.items() if v is not None}
    key, rim = options["key"] or "loose", options["rim"]
    return _of_frame(Request(key=key, rim=rim, **wanted), frame, of_frame)


def _of_frame(
    wanted: Request, frame: Source, options: dict[str, Any]
) -> tuple[Request, tuple[str, ...]]:
    """The kit of a frame as it is, and what there is to say of the frame."""
    family = family_of(frame)
    areas = sorted(options.keys() & _AREAS)
    cells_grow = family is not None and "edge_length" in family.options
    if cells_grow and "edge_length" in wanted.values:
        options["edge_length"] = wanted.values["edge_length"]
    elif areas and "edge_length" in wanted.values:
        msg = f"frame {called(frame)}: --edge-length and {option(areas[0])}: give one of them"
        raise InputError(msg)
    length = wanted.values.get("edge_length")
    read = load_frame(frame, options, lambda drawn: share_of_room(drawn, wanted.side, length))
    request = replace(wanted, frame=read.frame)
    if areas and cells_grow and "edge_length" not in wanted.values:
        request = _filled(request, frame, options, float(read.frame.lengths.min()))
    given = [*options, *(["rim"] if wanted.rim != "caps" else [])]
    return request, (*_plain(frame, given), *read.notes)


def plain_name(name: str) -> str:
    """What a kit's files are called."""
    plain = re.sub(r"[^A-Za-z0-9.-]+", "_", name).strip("._-")
    return "frame" if plain.lower() in ("", "kit") else plain


def _plain(frame: Source, given: Sequence[str]) -> tuple[str, ...]:
    """A note that cells are made as other frames are, if they are, with the options given."""
    if not has_cells(frame, ()):
        return ()
    causes = " and ".join(option(name) for name in given if not has_cells(frame, [name]))
    return (
        f"with {causes} the rows and columns of this {called(frame)} frame cannot be set later",
    )


def _filled(request: Request, frame: Source, options: Mapping[str, Any], length: float) -> Request:
    """The same with an area that is filled with cells as large as their joints need.

    Raises
    ------
    InputError
        None of them fits.
    """
    from scadgen.kit.sizing import growth

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
                f"frame {called(frame)}: its joints need edges of {length:g} mm, and no tile with "
                "such edges fits inside the outline; a larger one or a smaller side works"
            )
            raise InputError(msg) from error
        request = replace(request, frame=read.frame)
        scale = growth(request)
        if scale < 1 + 1e-6:
            return request


def keys_note(kit: Kit) -> tuple[str, ...]:
    """A note that keys are elsewhere than was chosen first, if they are."""
    count = len(kit.refused)
    if not count:
        return ()
    choices = "1 choice" if count == 1 else f"{count} choices"
    return (f"{choices} of a key not proved, or the frame loose with it: another is used",)


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
        msg = (
            f"weave {name!r}: neither a file nor one of {', '.join(BUILT_IN)}"
            f"{meant(name, BUILT_IN)} ({error.strerror})"
        )
        raise InputError(msg) from error
    except InputError as error:
        msg = f"weave {name!r}: {error}"
        raise InputError(msg) from None
    except (ValueError, RecursionError) as error:
        msg = f"weave {name!r}: not a JSON file ({error})"
        raise InputError(msg) from error
    return Weave.from_dict(entries, path.stem)
