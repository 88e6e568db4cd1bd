"""A kit as a folder of files: all of them, or none."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from scadgen.emit.macro import macro
from scadgen.emit.makefile import makefile, stl_check
from scadgen.emit.mesh import check_writable
from scadgen.emit.parts_csv import parts_csv
from scadgen.emit.picture import assembly_picture, preview
from scadgen.emit.placing import placing
from scadgen.emit.readme import readme
from scadgen.emit.scad import parameter_sets, scad
from scadgen.errors import InputError
from scadgen.kit.model import Kit
from scadgen.kit.store import FORMAT, dumps

__all__ = ["check_bill", "check_folder", "files_of", "update_bill", "write_kit"]

#: What a new kit makes stale: what the kit's Makefile and `scadgen render` write, and what not
#: every kit has.
_STALE = {"stl", "3mf", "png", "plates", ".build", "assembly.png", "placing.svg"}

#: The files of a plan of the kit, which is stale as well.
_PLAN = ("plan.json", "plan.txt", "plan-*.svg")


def files_of(kit: Kit) -> Mapping[str, Callable[[Kit], str | bytes]]:
    """The kit's files by name, and what writes each."""
    files: dict[str, Callable[[Kit], str | bytes]] = {
        "kit.json": dumps,
        f"{kit.frame}.scad": scad,
        f"{kit.frame}.json": parameter_sets,
        f"{kit.frame}.FCMacro": macro,
        "Makefile": makefile,
        "check_stl.py": stl_check,
        "README.md": readme,
        "parts.csv": parts_csv,
        "preview.png": preview,
    }
    if kit.proved:
        files["assembly.png"] = assembly_picture
    if kit.graph is not None:
        files["placing.svg"] = placing
    return files


def write_kit(kit: Kit, folder: Path, *, progress: Callable[[str], None] = lambda _: None) -> None:
    """Write a kit's folder; one that is there is replaced when the new one is complete.

    Parameters
    ----------
    kit
        The kit.
    folder
        Where to; a kit that is there is replaced, with what was rendered from it, and all
        other files in it are kept.
    progress
        Called with the name of each file before it is written.

    Raises
    ------
    InputError
        The folder is a file, holds something else, or cannot be written.  Nothing is
        changed then.
    """
    target = check_folder(folder)
    with _refusing(folder):
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent, prefix=".scadgen-") as name:
            stage = Path(name) / "kit"
            stage.mkdir()
            for file, write in files_of(kit).items():
                progress(file)
                text = write(kit)
                data = text if isinstance(text, bytes) else text.encode()
                (stage / file).write_bytes(data)
            _swap(stage, target, Path(name) / "old")


def check_bill(kit: Kit, path: Path) -> Path:
    """The folder in which `update_bill` could write a kit's bill.

    Parameters
    ----------
    kit
        The kit that is there.
    path
        Its folder, or the ``kit.json`` in it.

    Raises
    ------
    InputError
        It is another file, or one of the files could not be written.  Nothing is changed.
    """
    if not path.is_dir() and path.name != "kit.json":
        msg = f"cannot put a bill into {str(path)!r}: name a kit's folder, or the kit.json in it"
        raise InputError(msg)
    folder = path if path.is_dir() else path.parent
    for file in _of_bill(kit):
        check_writable(folder / file)
    return folder


def update_bill(kit: Kit, folder: Path) -> None:
    """Write anew all files of a kit's folder that have its bill, or none; nothing else is touched.

    Parameters
    ----------
    kit
        The kit that is there, but for its material and its print times.
    folder
        Its folder.

    Raises
    ------
    InputError
        The folder cannot be written.  Nothing is changed then.
    """
    texts = {name: files_of(kit)[name](kit) for name in _of_bill(kit)}
    with _refusing(folder), tempfile.TemporaryDirectory(dir=folder, prefix=".scadgen-") as name:
        new, old = Path(name) / "new", Path(name) / "old"
        new.mkdir()
        old.mkdir()
        for file, text in texts.items():
            (new / file).write_bytes(text if isinstance(text, bytes) else text.encode())
            if (folder / file).exists():
                shutil.copy2(folder / file, old / file)
        try:
            for file in texts:
                (new / file).replace(folder / file)
        except BaseException:  # an interrupt as well: the old files come back
            for file in texts:
                if (old / file).exists():
                    (old / file).replace(folder / file)
                else:
                    (folder / file).unlink(missing_ok=True)
            raise


def _of_bill(kit: Kit) -> tuple[str, ...]:
    """The files that have a kit's bill; the macro has all of the kit."""
    return "kit.json", "parts.csv", "README.md", f"{kit.frame}.FCMacro"


def check_folder(folder: Path) -> Path:
    """The folder itself, if a kit may be put there.

    Raises
    ------
    InputError
        It is a file, holds something else, or cannot be looked at.
    """
    with _refusing(folder):
        target = Path(os.path.realpath(folder))
        if target.exists() and not target.is_dir():
            msg = f"cannot write the kit to {str(folder)!r}: it is a file; name a folder"
            raise InputError(msg)
        if target == Path.cwd().resolve():
            msg = f"cannot write the kit to {str(folder)!r}: it is the current folder; name another"
            raise InputError(msg)
        if target.is_dir() and any(target.iterdir()) and not _holds_kit(target):
            msg = (
                f"cannot write the kit to {str(folder)!r}: it holds other things; name a new folder"
            )
            raise InputError(msg)
        return target


def _holds_kit(folder: Path) -> bool:
    """Whether a folder holds a kit, of whatever version."""
    try:
        start = (folder / "kit.json").read_bytes()[:200]
    except FileNotFoundError:
        return False
    return f'"format": "{FORMAT}"'.encode() in start


@contextmanager
def _refusing(folder: Path) -> Iterator[None]:
    """Turn what the system says of a folder into one line."""
    try:
        yield
    except OSError as error:
        msg = (
            f"cannot write the kit to {str(folder)!r}: {error.strerror or error}; "
            "name a folder in a writable place with space left"
        )
        raise InputError(msg) from error


def _swap(stage: Path, target: Path, old: Path) -> None:
    """Put the staged folder in the target's place, with what else the target holds."""
    if not target.exists():
        stage.rename(target)
        return
    ours = {entry.name for entry in stage.iterdir()} | _STALE
    kept = [
        entry.name for entry in target.iterdir() if entry.name not in ours and not _is_plan(entry)
    ]
    for name in kept:
        source = target / name
        if source.is_dir() and not source.is_symlink():
            shutil.copytree(source, stage / name, symlinks=True)
        else:
            shutil.copy2(source, stage / name, follow_symlinks=False)
    target.rename(old)
    try:
        stage.rename(target)
    except BaseException:  # an interrupt as well: the old kit comes back
        old.rename(target)
        raise


def _is_plan(entry: Path) -> bool:
    """Whether a folder holds a plan, and nothing else."""
    if entry.name != "plan" or entry.is_symlink() or not entry.is_dir():
        return False
    return all(any(file.match(pattern) for pattern in _PLAN) for file in entry.iterdir())
