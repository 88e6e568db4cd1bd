"""DXF files as documents of ezdxf, also those that are not quite DXF."""

from __future__ import annotations

import io
import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from scadgen.errors import InputError
from scadgen.readers.reading import Reading, checked_scale
from scadgen.readers.units import DXF_UNITS

if TYPE_CHECKING:
    from ezdxf.document import Drawing

__all__ = ["open_dxf", "units_of"]

#: The group code of an entity's handle.
_HANDLE = 5

#: Bytes at the end of a file that are looked at.
_TAIL = 1000

_BOM = b"\xef\xbb\xbf"

#: How a whole file ends; the tags of text files stand on lines, those of binary ones after a 0.
_END = re.compile(rb"(?:EOF|ENDSEC)[\s\0]*\Z")


def open_dxf(path: Path, data: bytes) -> tuple[Drawing, tuple[str, ...]]:
    """Open a DXF file, with repairs if it needs some; and what to say of them.

    Parameters
    ----------
    path
        The file.
    data
        Its bytes.

    Raises
    ------
    InputError
        It is none, or cut short.
    """
    from ezdxf import recover
    from ezdxf.filemanagement import readfile

    with _complaints() as said:
        try:
            return readfile(path), _told("is not quite DXF", said)
        except Exception as error:  # noqa: BLE001 -- its parsers let out whatever broken files cause
            fault = _one_line(str(error)) or type(error).__name__
        if not _END.search(data[-_TAIL:]):
            msg = f"is not DXF, or cut short: {fault}"
            raise InputError(msg)
        said.clear()
        try:
            document, audit = recover.read(io.BytesIO(_with_own_handles(data.removeprefix(_BOM))))
        except Exception:  # noqa: BLE001 -- as above
            msg = f"is not DXF: {fault}"
            raise InputError(msg) from None
        said += [_one_line(entry.message) for entry in (*audit.errors, *audit.fixes)]
        return document, _told("is not quite DXF, read with repairs", [fault, *said])


def units_of(document: Drawing, data: bytes, reading: Reading) -> tuple[float, tuple[str, ...]]:
    """Millimetres per unit, and what to say of it.

    A file that states none has millimetres, which is told if it has imperial measures.
    """
    # What a file does not state has a default of the library's.
    stated = _header(document, "$INSUNITS") if b"$INSUNITS" in data else 0
    imperial = b"$MEASUREMENT" in data and _header(document, "$MEASUREMENT") == 0
    scale = checked_scale(reading, DXF_UNITS.get(stated, 1.0))
    if stated in DXF_UNITS or reading.scale is not None:
        return scale, ()
    if stated:
        return scale, (
            f"its unit has the unknown number {stated}: taken as mm; --unit says another",
        )
    if imperial:
        return scale, (
            "it has imperial measures and no unit: taken as mm; --unit inch takes it as inches",
        )
    return scale, ()


def _header(document: Drawing, name: str) -> int:
    """A whole number of the header; 0 if there is none."""
    try:
        return int(document.header.get(name, 0))
    except (ValueError, TypeError):
        return 0


def _told(what: str, said: list[str]) -> tuple[str, ...]:
    """A line of what was said, if anything was."""
    others = f" (and {len(said) - 1} more)" if len(said) > 1 else ""
    return (f"{what}: {said[0]}{others}",) if said else ()


def _with_own_handles(data: bytes) -> bytes:
    """The same with a handle of its own for each entity.

    Of those that share one, all but the last are lost otherwise.
    """
    lines = data.splitlines()
    codes, values = lines[::2], lines[1::2]
    try:
        numbers = [int(code) for code in codes]
        used = [int(v, 16) for c, v in zip(numbers, values, strict=False) if c == _HANDLE]
    except ValueError:  # binary, or not in pairs of lines
        return data
    if len({*used}) == len(used):
        return data
    free, seen = max(used) + 1, set[int]()
    for at, (code, value) in enumerate(zip(numbers, values, strict=False)):
        if code != _HANDLE:
            continue
        if int(value, 16) in seen:
            lines[2 * at + 1] = b"%X" % free
            free += 1
        seen.add(int(value, 16))
    return b"\n".join(lines) + b"\n"


@contextmanager
def _complaints() -> Iterator[list[str]]:
    """What ezdxf says of a file while it reads it; it would go to stderr otherwise."""
    said: list[str] = []

    class Handler(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            said.append(_one_line(record.getMessage()))

    logger, handler = logging.getLogger("ezdxf"), Handler(logging.WARNING)
    logger.addHandler(handler)
    try:
        yield said
    finally:
        logger.removeHandler(handler)


def _one_line(text: str) -> str:
    return " ".join(text.split())[:120]
