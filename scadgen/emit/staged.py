"""A folder of files, all of them or none: made beside the one that is there, then swapped."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Collection, Iterable, Iterator
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
    own
        Names of files that are of what is in such a folder; without it, all that a new one has.
    """

    what: str
    file: str
    form: str
    is_stale: Callable[[Path], bool]
    own: Callable[[Path], Collection[str]] | None = None


def check_target(
    folder: Path,
    sort: Sort,
    names: Collection[str] = (),
    read: Iterable[Path] = (),
    *,
    force: bool = False,
) -> Path:
    """The folder itself, if one of some sort may be put there.

    Parameters
    ----------
    folder
        Where to.
    sort
        What sort of folder it is.
    names
        Files that will be put there.
    read
        Files that were read for it.
    force
        Whether to put it where other things are, and over files that are of none of its sort.

    Raises
    ------
    InputError
        It is a file, holds something else, or cannot be looked at; something in it that was
        read, or is not of what is there, would be lost.
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
        if not target.is_dir() or force:
            return target
        if any(target.iterdir()) and not _holds(target, sort):
            msg = f"{cannot} holds other things; name a new folder, or use --force"
            raise InputError(msg)
        for lost, why in _lost(target, sort, names, read):
            msg = f"{cannot} has {lost!r}, {why}; name another folder, or use --force"
            raise InputError(msg)
        return target


def _lost(
    target: Path, sort: Sort, names: Collection[str], read: Iterable[Path]
) -> Iterator[tuple[str, str]]:
    """Files in a folder that writing it anew would take from their owner, and why they are his."""
    for file in read:
        path = Path(os.path.realpath(file))
        if path.exists() and path.is_relative_to(target):
            top = target / path.relative_to(target).parts[0]
            if top.name in names or sort.is_stale(top):
                yield path.name, "which was read"
    if sort.own is not None:
        own = sort.own(target)
        there = {entry.name for entry in target.iterdir()}
        for name in sorted(there & {*names} - {*own}):
            yield name, f"which is not of the {sort.what} there"


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


def write_all(
    files: Iterable[tuple[str, str | bytes]],
    folder: Path,
    sort: Sort,
    read: Iterable[Path] = (),
    *,
    force: bool = False,
) -> None:
    """Write a folder; one that is there is replaced when the new one is complete.

    Parameters
    ----------
    files
        Names and what is in them, text in UTF-8; made one by one.
    folder
        Where to.  What is in it and not stale is kept.
    sort
        What sort of folder it is.
    read, force
        As `check_target` has them.

    Raises
    ------
    InputError
        As `check_target`, or the folder cannot be written.  Nothing is changed then.
    """
    target = check_target(folder, sort, force=force)
    with refusing(folder, sort):
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent, prefix=".scadgen-") as name:
            stage = Path(name) / sort.what
            stage.mkdir()
            for file, text in files:
                (stage / file).write_bytes(text if isinstance(text, bytes) else text.encode())
            check_target(folder, sort, {entry.name for entry in stage.iterdir()}, read, force=force)
            _swap(stage, target, Path(name) / "old", sort)


def _swap(stage: Path, target: Path, old: Path, sort: Sort) -> None:
    """Put the staged folder in the target's place, with what else the target holds."""
    if not target.exists():
        stage.rename(target)
        return
    ours = {entry.name for entry in stage.iterdir()}
    known = _holds(target, sort)
    for source in target.iterdir():
        if source.name in ours or (known and sort.is_stale(source)):
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
