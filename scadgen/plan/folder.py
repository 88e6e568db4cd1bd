"""A plan as a folder of files: all of them, or none."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from scadgen.errors import InputError
from scadgen.plan.told import FORMAT

__all__ = ["check_plan_folder", "write_plan"]

#: Names of the files that a new plan replaces, besides those that it has itself.
_OURS = ("plan.json", "plan.txt", "plan-*.svg")


def check_plan_folder(folder: Path) -> Path:
    """The folder itself, if a plan may be put there.

    Raises
    ------
    InputError
        It is a file, holds something else, or cannot be looked at.
    """
    try:
        target = Path(os.path.realpath(folder))
        if target == Path.cwd().resolve():
            msg = (
                f"cannot write the plan to {str(folder)!r}: it is the current folder; name another"
            )
            raise InputError(msg)
        if target.exists() and not target.is_dir():
            msg = f"cannot write the plan to {str(folder)!r}: it is a file; name a folder"
            raise InputError(msg)
        if target.is_dir() and any(target.iterdir()) and not _holds_plan(target):
            msg = (
                f"cannot write the plan to {str(folder)!r}: it holds other things; name a new "
                "folder"
            )
            raise InputError(msg)
    except OSError as error:
        raise _refusal(folder, error) from error
    return target


def _holds_plan(folder: Path) -> bool:
    try:
        start = (folder / "plan.json").read_bytes()[:200]
    except FileNotFoundError:
        return False
    return f'"format": "{FORMAT}"'.encode() in start


def _refusal(folder: Path, error: OSError) -> InputError:
    return InputError(
        f"cannot write the plan to {str(folder)!r}: {error.strerror or error}; "
        "name a folder in a writable place with space left"
    )


def write_plan(files: Mapping[str, str], folder: Path) -> None:
    """Write a plan's files; those of a plan that is there are replaced, others are kept.

    Parameters
    ----------
    files
        Their texts by name.
    folder
        Where to.

    Raises
    ------
    InputError
        The folder is a file, holds something else, or cannot be written.  Nothing is changed
        then.
    """
    target = check_plan_folder(folder)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent, prefix=".scadgen-") as name:
            stage = Path(name) / "plan"
            stage.mkdir()
            for file, text in files.items():
                (stage / file).write_text(text, encoding="utf-8")
            _swap(stage, target, Path(name) / "old")
    except OSError as error:
        raise _refusal(folder, error) from error


def _swap(stage: Path, target: Path, old: Path) -> None:
    """Put the staged folder in the target's place, with what else the target holds."""
    if not target.exists():
        stage.rename(target)
        return
    for entry in target.iterdir():
        if any(entry.match(pattern) for pattern in _OURS):
            continue
        if entry.is_dir() and not entry.is_symlink():
            shutil.copytree(entry, stage / entry.name, symlinks=True)
        else:
            shutil.copy2(entry, stage / entry.name, follow_symlinks=False)
    target.rename(old)
    try:
        stage.rename(target)
    except BaseException:  # an interrupt as well: the old plan comes back
        old.rename(target)
        raise
