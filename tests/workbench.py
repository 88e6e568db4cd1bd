"""The workbench pressed through in FreeCAD's own window."""

import os
import shlex
import sys
from contextlib import contextmanager
from pathlib import Path

import freecadcmd
from kits import kit

from scadgen.emit.macro import workbench
from scadgen.kit.store import dumps

__all__ = ["PICTURES", "linked", "press_everything"]

ROOT = Path(__file__).parent.parent

#: Pictures that are taken on the way.
PICTURES = ("new_kit", "joint", "frame", "explode", "export", "check", "preferences")


def linked(home):
    """A home of FreeCAD with the workbench in it."""
    (home / "Mod").mkdir(parents=True)
    (home / "Mod" / "Scadgen").symlink_to(workbench(), target_is_directory=True)
    return home


def press_everything(place):
    """The steps that held, what FreeCAD said, and the folder with the pictures."""
    ours, bare, folder = linked(place / "ours"), place / "bare", place / "folder"
    for path in (bare, folder, place / "tmp"):
        path.mkdir()
    given = {"kit": str(place / "kit.json"), "folder": str(folder)}
    (place / "kit.json").write_text(dumps(kit("hexagonal")), encoding="utf-8")
    for home, step in ((ours, "make"), (bare, "bare")):
        freecadcmd.run("objects.py", home, steps=[step], **given)
    given |= {"engine": str(_engine(place)), "lost": str(folder / "bare.FCStd")}
    with _temporary(place / "tmp"):
        done, said = freecadcmd.run("gui.py", ours, window=True, timeout=600, **given)
    return done, said, folder


def _engine(place):
    """The program, of this checkout, as users have it on their path."""
    path = place / "scadgen"
    code = "from scadgen.cli.main import main; main()"
    command = shlex.join(["env", f"PYTHONPATH={ROOT}", sys.executable, "-c", code])
    path.write_text(f'#!/bin/sh\nexec {command} "$@"\n')
    path.chmod(0o755)
    return path


@contextmanager
def _temporary(folder):
    """Programs put what they need for a while into a folder where it is seen."""
    before = os.environ.get("TMPDIR")
    os.environ["TMPDIR"] = str(folder)
    try:
        yield
    finally:
        del os.environ["TMPDIR"]
        if before is not None:
            os.environ["TMPDIR"] = before
