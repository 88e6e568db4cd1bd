"""A plan as a folder of files: all of them, or none."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from scadgen.emit.folder import PLAN_FILES
from scadgen.emit.staged import Sort, check_target, write_all
from scadgen.plan.as_json import FORMAT

__all__ = ["check_plan_folder", "write_plan"]

_PLAN = Sort(
    "plan",
    "plan.json",
    FORMAT,
    lambda entry: any(entry.match(pattern) for pattern in PLAN_FILES),
)


def check_plan_folder(folder: Path) -> Path:
    """The folder itself, if a plan may be put there.

    Raises
    ------
    InputError
        It is a file, holds something else, or cannot be looked at.
    """
    return check_target(folder, _PLAN)


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
    write_all(files.items(), folder, _PLAN)
