"""What a search has found, in a file: one line of JSON each, written as it is found."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from scadgen.errors import InputError
from scadgen.tune.judge import Figures, Wish

__all__ = ["Record", "Shape"]

#: A weave's parameters: ring ratio, span, amplitude, bend, periods.
Shape = tuple[float, float, float, float, float]


class Record:
    """The figures of weaves.

    Parameters
    ----------
    path
        The file; one that is there is read, and added to.  None: nothing is kept.
    wish, seed
        What the search is for, and its seed: what is on file must be for the same.

    Raises
    ------
    InputError
        The file is of another search, or cannot be read or written.
    """

    def __init__(self, path: Path | None, wish: Wish, seed: int) -> None:
        self._path = path
        self._known: dict[tuple[str, Shape], Figures] = {}
        head = json.dumps({"format": "scadgen-tune", "version": 1, **asdict(wish), "seed": seed})
        if path is None:
            return
        try:
            if path.exists():
                self._read(path, head)
            else:
                path.write_text(head + "\n", encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            msg = f"{path}: {getattr(error, 'strerror', None) or error}; name another file"
            raise InputError(msg) from error

    def __len__(self) -> int:
        """Count what is known."""
        return len(self._known)

    def get(self, kind: str, shape: Shape) -> Figures | None:
        """What is known of a weave, if anything."""
        return self._known.get((kind, shape))

    def add(self, kind: str, shape: Shape, found: Figures) -> None:
        """Write down what was found."""
        self._known[kind, shape] = found
        if self._path is not None:
            with self._path.open("a", encoding="utf-8") as file:
                file.write(json.dumps([kind, shape, asdict(found)]) + "\n")

    def _read(self, path: Path, head: str) -> None:
        first, _, rest = path.read_text(encoding="utf-8").partition("\n")
        if first != head:
            msg = f"{path}: not the record of this search ({head}); name another file"
            raise InputError(msg)
        *lines, last = rest.split("\n")
        for line in lines:
            try:
                kind, shape, found = json.loads(line)
                self._known[kind, tuple(shape)] = Figures(**found)
            except (ValueError, TypeError) as error:
                msg = f"{path}: not a line of a search: {line[:60]!r}; name another file"
                raise InputError(msg) from error
        if last:  # the search was stopped while it wrote
            text = "\n".join([first, *lines, ""])
            path.write_text(text, encoding="utf-8")
