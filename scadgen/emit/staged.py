"""A folder of files, all of them or none: made beside the one that is there, then swapped."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from scadgen.errors import InputError

__all__ = ["Sort", "check_target", "refusing", "write_all"]


@dataclass(frozen=True, slots=True)
class Sort:
    """What sort of folder it is.

    Parameters
    ----------
    what
        What is in it, in a word.
    file, form
        The JSON file that every such folder has, and the format that it begins with.
    is_stale
        Whether something in such a folder is gone with what was in it before.
    """

    what: str
    file: str
    form: str
    is_stale: Callable[[Path], bool]


def check_target(folder: Path, sort: Sort) -> Path:
    """The folder itself, if one of some sort may be put there.

    Raises
    ------
    InputError
        It is a file, holds something else, or cannot be looked at.
    """
    cannot = f"cannot write the {sort.what} to {str(folder)!r}: it"
    with refusing(folder, sort):
        target = Path(os.path.realpath(folder))
        if target.exists() and not target.is_dir():
            msg = f"{cannot} is a file; name a folder"
            raise InputError(msg)
        if target == Path.cwd().resolve():
            msg = f"{cannot} is the current folder; name another"
            raise InputError(msg)
        if target.is_dir() and any(target.iterdir()) and not _holds(target, sort):
            msg = f"{cannot} holds other things; name a new folder"
            raise InputError(msg)
        return target


def _holds(folder: Path, sort: Sort) -> bool:
    """Whether a folder is of some sort, of whatever version."""
    try:
        start = (folder / sort.file).read_bytes()[:200]
    except FileNotFoundError:
        return False
    return f'"format": "{sort.form}"'.encode() in start


@contextmanager
def refusing(folder: Path, sort: Sort) -> Iterator[None]:
    """Turn what the system says of a folder into one line."""
    try:
        yield
    except OSError as error:
        msg = (
            f"cannot write the {sort.what} to {str(folder)!r}: {error.strerror or error}; "
            "name a folder in a writable place with space left"
        )
        raise InputError(msg) from error


def write_all(files: Iterable[tuple[str, str | bytes]], folder: Path, sort: Sort) -> None:
    """Write a folder; one that is there is replaced when the new one is complete.

    Parameters
    ----------
    files
        Names and what is in them, text in UTF-8; made one by one.
    folder
        Where to.  What is in it and not stale is kept.
    sort
        What sort of folder it is.

    Raises
    ------
    InputError
        The folder is a file, holds something else, or cannot be written.  Nothing is changed
        then.
    """
    target = check_target(folder, sort)
    with refusing(folder, sort):
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent, prefix=".scadgen-") as name:
            stage = Path(name) / sort.what
            stage.mkdir()
            for file, text in files:
                (stage / file).write_bytes(text if isinstance(text, bytes) else text.encode())
            _swap(stage, target, Path(name) / "old", sort)


def _swap(stage: Path, target: Path, old: Path, sort: Sort) -> None:
    """Put the staged folder in the target's place, with what else the target holds."""
    if not target.exists():
        stage.rename(target)
        return
    ours = {entry.name for entry in stage.iterdir()}
    for source in target.iterdir():
        if source.name in ours or sort.is_stale(source):
            continue
        if source.is_dir() and not source.is_symlink():
            shutil.copytree(source, stage / source.name, symlinks=True)
        else:
            shutil.copy2(source, stage / source.name, follow_symlinks=False)
    try:
        target.rename(old)
        stage.rename(target)
    except BaseException:  # an interrupt as well: what was there comes back
        if old.exists() and not target.exists():
            old.rename(target)
        raise
