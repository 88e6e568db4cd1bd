"""Puts the workbench where FreeCAD looks for it, and takes it away again.

What this did not put there is never overwritten and never removed: a link is ours if it leads
to this very workbench, a copy if it has our list of files and they are as they were.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from scadgen.emit.macro import workbench
from scadgen.errors import InputError

__all__ = ["NAME", "Installed", "inspect", "install", "uninstall"]

#: Name of the workbench's folder.
NAME = "Scadgen"

#: In a copy: the program it belongs to, and the digest of each file.  The workbench reads it too.
_LIST = ".scadgen-copy.json"

#: What Python leaves beside modules.
_CACHE = "__pycache__"


@dataclass(frozen=True, slots=True)
class Installed:
    """What there is in FreeCAD's folder of addons.

    Parameters
    ----------
    where
        The place of the workbench in it.
    kind
        ``link`` or ``copy`` if it is ours, ``other`` if it is not, ``none`` if there is nothing.
    version
        Version of that workbench; empty if it is not ours.
    current
        Whether it is the workbench of this scadgen, as it is now.
    why
        If it is not ours: what it is, in a few words.
    """

    where: Path
    kind: str
    version: str
    current: bool
    why: str = ""


def inspect(mod: Path) -> Installed:
    """Say what is installed.

    Parameters
    ----------
    mod
        FreeCAD's folder of addons.

    Raises
    ------
    InputError
        It cannot be looked at.
    """
    with _refusing(mod, "looked at"):
        return _inspected(mod / NAME, workbench())


def _inspected(where: Path, source: Path) -> Installed:
    """What there is at a place."""
    if where.is_symlink():
        target = where.readlink()
        if Path(os.path.realpath(where)) != source.resolve():
            return Installed(where, "other", "", current=False, why=f"a link to {target}")
        return Installed(where, "link", _version(where), current=True)
    if not where.exists():
        return Installed(where, "none", "", current=False)
    why = _why_not_ours(where)
    if why:
        return Installed(where, "other", "", current=False, why=why)
    return Installed(where, "copy", _version(where), current=_digests(where) == _digests(source))


def install(mod: Path, *, copy: bool) -> Installed:
    """Install the workbench; one of ours that is there is replaced.

    Parameters
    ----------
    mod
        FreeCAD's folder of addons; made if it is missing.
    copy
        Copy the files; otherwise link to them.

    Raises
    ------
    InputError
        Something else is there, or the folder cannot be written to.  Nothing is changed.
    """
    found = inspect(mod)
    _refuse_others(found)
    if found.current and found.kind == ("copy" if copy else "link"):
        return found
    with _refusing(mod):
        mod.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=mod, prefix=".scadgen-") as folder:
            stage = Path(folder) / "new"
            if copy:
                _copy(workbench(), stage)
            else:
                stage.symlink_to(workbench(), target_is_directory=True)
            if found.kind == "none":
                stage.rename(found.where)
            else:
                _swap(stage, found.where, Path(folder) / "old")
    return inspect(mod)


def uninstall(mod: Path) -> Installed:
    """Take the workbench away.

    Parameters
    ----------
    mod
        FreeCAD's folder of addons.

    Returns
    -------
    removed
        What there was.

    Raises
    ------
    InputError
        It is not there, or not ours, or cannot be removed.
    """
    found = inspect(mod)
    if found.kind == "none":
        msg = f"{found.where}: nothing is installed there; --mod FOLDER names another place"
        raise InputError(msg)
    _refuse_others(found)
    with _refusing(mod):
        if found.kind == "link":
            found.where.unlink()
        else:
            shutil.rmtree(found.where)
    return found


def _refuse_others(found: Installed) -> None:
    if found.kind == "other":
        msg = (
            f"{found.where}: {found.why}, which scadgen did not put there; "
            "move it away, or name another place with --mod FOLDER"
        )
        raise InputError(msg)


@contextmanager
def _refusing(mod: Path, what: str = "changed") -> Iterator[None]:
    """Turn what the system says into one line: that the folder cannot be `what`."""
    try:
        yield
    except OSError as error:
        works = "name a writable folder with --mod FOLDER"
        if os.name == "nt":
            works = "use --copy, as Windows may forbid links, or " + works
        msg = f"{mod}: cannot be {what} ({error.strerror}); {works}"
        raise InputError(msg) from error


def _swap(stage: Path, where: Path, old: Path) -> None:
    """Put the new workbench in the place of the old one, which comes back if that fails."""
    where.rename(old)
    try:
        stage.rename(where)
    except BaseException:  # an interrupt as well
        old.rename(where)
        raise


def _copy(source: Path, target: Path) -> None:
    """Copy the workbench, with a list of what was copied."""
    shutil.copytree(source, target, ignore=shutil.ignore_patterns(_CACHE))
    program = Path(sys.executable).with_name("scadgen" + (".exe" if os.name == "nt" else ""))
    about = {"engine": str(program), "files": _digests(target)}
    (target / _LIST).write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")


def _why_not_ours(where: Path) -> str:
    """What keeps a folder from being an unchanged copy of ours; nothing if it is one."""
    try:
        listed = {**json.loads((where / _LIST).read_text(encoding="utf-8"))["files"]}
    except (OSError, ValueError, KeyError, TypeError):
        return "a folder" if where.is_dir() else "a file"
    found = _digests(where)
    for name in sorted({*listed, *found}):
        if listed.get(name) != found.get(name):
            return f"a copy in which {name} was changed"
    return ""


def _digests(folder: Path) -> Mapping[str, str]:
    """Digest of each file, but the list and Python's caches, by its path in the folder."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and _CACHE not in path.parts and path.name != _LIST
    }


def _version(folder: Path) -> str:
    text = (folder / "freecad" / "scadgen" / "__init__.py").read_text(encoding="utf-8")
    found = re.search(r'^__version__ = "(.*)"$', text, re.MULTILINE)
    return found[1] if found else ""
