"""Checks of a kit's other files against its ``kit.json``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from scadgen.check.result import Result
from scadgen.emit.folder import files_of
from scadgen.kit.model import Kit

__all__ = ["unchanged"]


def unchanged(kit: Kit, folder: Path) -> Iterator[Result]:
    """Whether each file is what the kit makes of it, to the byte."""
    for name, write in files_of(kit).items():
        text = write(kit)
        data = text if isinstance(text, bytes) else text.encode()
        path = folder / name
        same = path.is_file() and path.read_bytes() == data
        figure = "same bytes" if same else "other bytes" if path.exists() else "missing"
        yield Result(f"{name} is this kit's", same, figure, "same bytes")
