"""A kit as a folder of files: all of them, or none."""

from __future__ import annotations

import json
import re
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from scadgen.emit.macro import macro
from scadgen.emit.makefile import makefile, stl_check
from scadgen.emit.mesh import check_writable
from scadgen.emit.parts_csv import parts_csv
from scadgen.emit.picture import assembly_picture, preview
from scadgen.emit.placing import placing
from scadgen.emit.readme import readme
from scadgen.emit.scad import parameter_sets, scad
from scadgen.emit.staged import Sort, check_target, refusing, write_all
from scadgen.errors import InputError
from scadgen.kit.model import Kit
from scadgen.kit.store import FORMAT, dumps

__all__ = ["PLAN_FILES", "check_bill", "check_folder", "files_of", "update_bill", "write_kit"]

#: What a new kit makes stale: what the kit's Makefile and `scadgen render` write, and what not
#: every kit has.
_STALE = {"stl", "3mf", "png", "plates", ".build", "assembly.png", "placing.svg"}

#: Bytes at the start of a kit's file that hold the name of its frame.
_START = 100_000

#: The files of a plan, which a new kit makes stale, and so does a new plan.
PLAN_FILES = ("plan.json", "plan.txt", "plan-*.svg")


def _is_stale(entry: Path) -> bool:
    """Whether something in a kit's folder is of the old kit: a plan, if nothing else is in it."""
    if entry.name != "plan" or entry.is_symlink() or not entry.is_dir():
        return entry.name in _STALE
    return all(any(file.match(pattern) for pattern in PLAN_FILES) for file in entry.iterdir())


def _names(frame: str) -> tuple[str, ...]:
    """All files that a kit of a frame may have."""
    own = (f"{frame}.scad", f"{frame}.json", f"{frame}.FCMacro")
    pictures = ("preview.png", "assembly.png", "placing.svg")
    return ("kit.json", *own, "Makefile", "check_stl.py", "README.md", "parts.csv", *pictures)


def _own(folder: Path) -> tuple[str, ...]:
    """The files of the kit that is in a folder."""
    if not (folder / "kit.json").is_file():
        return ()
    with (folder / "kit.json").open("rb") as file:
        # Kits of older versions call it their frame.
        found = re.search(rb'\n "(?:name|frame)": ("[^"\n]*")', file.read(_START))
    return _names(json.loads(found[1])) if found else _names("kit")


_KIT = Sort("kit", "kit.json", FORMAT, _is_stale, _own)


def files_of(kit: Kit) -> Mapping[str, Callable[[Kit], str | bytes]]:
    """The kit's files by name, and what writes each."""
    files: dict[str, Callable[[Kit], str | bytes]] = {
        "kit.json": dumps,
        f"{kit.name}.scad": scad,
        f"{kit.name}.json": parameter_sets,
        f"{kit.name}.FCMacro": macro,
        "Makefile": makefile,
        "check_stl.py": stl_check,
        "README.md": readme,
        "parts.csv": parts_csv,
        "preview.png": preview,
    }
    if kit.proved:
        files["assembly.png"] = assembly_picture
    if kit.tiling is None or not kit.tiling.regular:
        files["placing.svg"] = placing
    return files


def write_kit(
    kit: Kit,
    folder: Path,
    *,
    read: Iterable[Path] = (),
    force: bool = False,
    progress: Callable[[str], None] = lambda _: None,
) -> None:
    """Write a kit's folder; one that is there is replaced when the new one is complete.

    Parameters
    ----------
    kit
        The kit.
    folder
        Where to; a kit that is there is replaced, with what was rendered from it, and all
        other files in it are kept.
    read
        Files that the kit was made of, which are not written over.
    force
        Whether to put it where other things are, and over any file.
    progress
        Called with the name of each file before it is written.

    Raises
    ------
    InputError
        The folder is a file, holds something else, or cannot be written.  Nothing is
        changed then.
    """
    files = files_of(kit).items()

    def made() -> Iterator[tuple[str, str | bytes]]:
        for file, write in files:
            progress(file)
            yield file, write(kit)

    write_all(made(), folder, _KIT, read, force=force)


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
    with (
        refusing(folder, _KIT),
        tempfile.TemporaryDirectory(dir=folder, prefix=".scadgen-") as name,
    ):
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
    return "kit.json", "parts.csv", "README.md", f"{kit.name}.FCMacro"


def check_folder(
    folder: Path, frame: str, read: Iterable[Path] = (), *, force: bool = False
) -> Path:
    """The folder itself, if a kit may be put there.

    Parameters
    ----------
    folder
        Where to.
    frame
        The name of the kit's frame.
    read, force
        As `write_kit` has them.

    Raises
    ------
    InputError
        It is a file, holds something else, or cannot be looked at; a file in it that was read,
        or is not of the kit that is there, would be lost.
    """
    return check_target(folder, _KIT, _names(frame), read, force=force)
