"""The workbench in FreeCAD: its objects without a window, and pressed through in its own."""

import os
import shlex
import shutil
import sys
from contextlib import contextmanager
from pathlib import Path

import freecadcmd
from kits import kit, tee, tiled
from shared import once

from scadgen.emit.macro import workbench
from scadgen.kit.store import dumps

__all__ = ["PICTURES", "linked", "objects", "press_everything"]

ROOT = Path(__file__).parent.parent

#: Pictures that are taken on the way.
PICTURES = ("new_kit", "joint", "frame", "explode", "export", "check", "preferences")


def linked(home):
    """A home of FreeCAD with the workbench in it."""
    (home / "Mod").mkdir(parents=True)
    (home / "Mod" / "Scadgen").symlink_to(workbench(), target_is_directory=True)
    return home


def objects():
    """What three starts of FreeCAD found: with the workbench, without it, with it again."""
    return once("objects", _three_starts)


def _three_starts(place):
    ours, bare, folder = linked(place / "ours"), place / "bare", place / "folder"
    bare.mkdir()
    folder.mkdir()
    kits = {"kit": kit("hexagonal"), "cells": tiled("V3.3.4.3.4"), "drawn": tee()}
    places = {name: str(place / f"{name}.json") for name in kits} | {"folder": str(folder)}
    for name, made in kits.items():
        Path(places[name]).write_text(dumps(made), encoding="utf-8")

    def run(home, *steps):
        return freecadcmd.run("objects.py", home, steps=steps, **places)

    found, said = run(ours, "make", "edit", "refuse", "old", "other")
    without, _ = run(bare, "bare")
    again, _ = run(ours, "restore", "export")
    return {**found, **without, **again, "said": said, "folder": folder}


def press_everything(place):
    """The steps that held, what FreeCAD said, and the folder with the pictures."""
    folder = place / "folder"
    for path in (folder, place / "tmp"):
        path.mkdir()
    (place / "kit.json").write_text(dumps(kit("hexagonal")), encoding="utf-8")
    lost = shutil.copy(objects()["folder"] / "bare.FCStd", place)
    given = {"kit": place / "kit.json", "folder": folder, "engine": _engine(place), "lost": lost}
    given = {name: str(path) for name, path in given.items()}
    with _temporary(place / "tmp"):
        home = linked(place / "home")
        done, said = freecadcmd.run("gui.py", home, window=True, timeout=600, **given)
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
