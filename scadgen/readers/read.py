"""Reads a frame from a file of any known kind."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from scadgen.errors import InputError
from scadgen.readers.dxf import read_dxf
from scadgen.readers.json_frame import read_json
from scadgen.readers.mesh import read_obj, read_off
from scadgen.readers.reading import Read, Reading
from scadgen.readers.svg import read_svg

__all__ = ["READERS", "read"]

#: The reader of each kind of file, by the end of its name.
READERS: Mapping[str, Callable[[Path, Reading], Read]] = MappingProxyType(
    {
        ".dxf": read_dxf,
        ".json": read_json,
        ".obj": read_obj,
        ".off": read_off,
        ".svg": read_svg,
    }
)


def read(path: Path, reading: Reading | None = None) -> Read:
    """Read a frame; its name is the file's without the ending, or what the file says.

    Parameters
    ----------
    path
        The file; the end of its name says what kind it is.
    reading
        How to read it.

    Raises
    ------
    InputError
        It is of no known kind, cannot be read, or is no frame; the message begins with the
        file's name.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        msg = f"{path}: must end in {', '.join(READERS)}"
        raise InputError(msg)
    try:
        return reader(path, reading or Reading())
    except InputError as error:
        msg = f"{path}: {error}"
        raise InputError(msg) from None
