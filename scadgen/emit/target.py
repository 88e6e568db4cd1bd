"""Which files a command may write: the one place that decides it.

A command does not write over what it read, nor over a file that scadgen did not make, by whatever
name or link it is reached, unless it is told to.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from scadgen.emit.mark import is_ours, marked
from scadgen.emit.mesh import check_writable, write_atomic
from scadgen.errors import InputError

__all__ = ["Target", "target"]


@dataclass(frozen=True, slots=True)
class Target:
    """A file that may be written; `target` makes one.

    Parameters
    ----------
    path
        Where to.
    read
        Files that were read.
    force
        Whether any file may be written over.
    """

    path: Path
    read: tuple[Path, ...] = ()
    force: bool = False

    def check(self) -> None:
        """Refuse a file that may not be written, or could not be.

        Raises
        ------
        InputError
            It was read, scadgen did not make it, or there is no room for it.
        """
        check_writable(self.path)
        if not self.force:
            _refuse_read(self.path, self.read)
            _refuse_others(self.path)

    def put(self, data: bytes, kind: str) -> None:
        """Put the file in place whole, with its mark.

        Parameters
        ----------
        data
            What is in it.
        kind
            What kind of file it is: ``svg``, ``json``, ``stl``, ...

        Raises
        ------
        InputError
            As `check`; it may have changed since.
        """
        self.check()
        write_atomic(self.path, marked(data, kind))


def target(path: Path, read: Iterable[Path] = (), *, force: bool = False) -> Target:
    """A file to write, refused before any work if it may not be written.

    Parameters
    ----------
    path
        Where to.
    read
        Files that the command reads.
    force
        Whether to write over any file.

    Raises
    ------
    InputError
        The file was read, was not made by scadgen, or cannot be written.
    """
    found = Target(path, tuple(read), force)
    found.check()
    return found


def _refuse_read(path: Path, read: Iterable[Path]) -> None:
    """Refuse to write over what was read, under any name."""
    if not path.exists():
        return
    for file in read:
        if file.exists() and path.samefile(file):
            same = "" if path == file else f", which is {str(file)!r}"
            msg = (
                f"cannot write {str(path)!r}{same}: it was read; name another file, or use --force"
            )
            raise InputError(msg)


def _refuse_others(path: Path) -> None:
    if not path.is_file():
        return
    try:
        data = path.read_bytes()
    except OSError as error:
        msg = f"cannot look at {str(path)!r}: {error.strerror}; name another file, or use --force"
        raise InputError(msg) from error
    # An empty file has nothing in it to lose.
    if data and not is_ours(data):
        msg = (
            f"cannot write {str(path)!r}: it is there, and scadgen did not make it as it is; name "
            "another file, or use --force"
        )
        raise InputError(msg)
