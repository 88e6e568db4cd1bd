"""Where FreeCAD is, which version, and where it looks for addons."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from scadgen.errors import InputError

__all__ = ["FreeCAD", "find", "mod_folder"]

#: Names of FreeCAD without a window.
_PROGRAMS = ("freecadcmd", "FreeCADCmd", "freecadcmd-daily")

#: Seconds that FreeCAD may take to say who it is; usually less than one.
_TIMEOUT = 60.0

# FreeCAD ends before it would save its settings.
_QUESTION = """\
import json, os
import FreeCAD
with open({answer!r}, "w", encoding="utf-8") as file:
    json.dump([FreeCAD.Version()[:3], FreeCAD.getUserAppDataDir()], file)
os._exit(0)
"""


@dataclass(frozen=True, slots=True)
class FreeCAD:
    """A FreeCAD on this machine.

    Parameters
    ----------
    program
        The program without a window.
    version
        Such as ``0.20.2``.
    data
        Its folder for what belongs to the user.
    """

    program: str
    version: str
    data: Path


def find() -> FreeCAD | None:
    """Find FreeCAD and ask it who it is; None if there is none that answers.

    Raises
    ------
    InputError
        ``SCADGEN_FREECAD`` names a program that is not there.
    """
    named = os.environ.get("SCADGEN_FREECAD")
    found = next(filter(None, map(shutil.which, [named] if named else _PROGRAMS)), None)
    if found is None:
        if named:
            msg = f"SCADGEN_FREECAD = {named}: not found; must name freecadcmd"
            raise InputError(msg)
        return None
    with tempfile.TemporaryDirectory(prefix="scadgen-") as folder:
        answer, question = Path(folder) / "answer.json", Path(folder) / "question.py"
        question.write_text(_QUESTION.format(answer=str(answer)), encoding="utf-8")
        try:
            # Options before the script would crash some versions.
            subprocess.run(
                [found, str(question)],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                check=False,
                timeout=_TIMEOUT,
            )
            version, data = json.loads(answer.read_text(encoding="utf-8"))
        except (OSError, ValueError, subprocess.TimeoutExpired):
            return None
    return FreeCAD(found, ".".join(version).rstrip("."), Path(data))


def mod_folder(freecad: FreeCAD | None) -> Path:
    """Where FreeCAD looks for addons.

    Parameters
    ----------
    freecad
        The FreeCAD that says so; without one it is the place that FreeCAD would take.
    """
    if freecad is not None:
        return freecad.data / "Mod"
    for name in ("FREECAD_USER_DATA", "FREECAD_USER_HOME"):
        given = os.environ.get(name)
        if given and Path(given).is_dir():
            return Path(given) / "Mod"
    folder = _data_home() / "FreeCAD"
    old = Path.home() / ".FreeCAD"
    if sys.platform.startswith("linux") and old.is_dir() and not folder.is_dir():
        return old / "Mod"  # before 0.20
    return _newest(folder) / "Mod"


def _data_home() -> Path:
    """Where programs of this system keep what belongs to the user."""
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA", Path.home() / "AppData" / "Roaming"))
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support"
    return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")


def _newest(folder: Path) -> Path:
    """The folder of the newest version in FreeCAD's own; itself if it has none, as before 1.1."""
    found = {
        (int(m[1]), int(m[2])): path
        for path in (folder.iterdir() if folder.is_dir() else ())
        if (m := re.fullmatch(r"v(\d+)-(\d+)", path.name))
    }
    return found[max(found)] if found else folder
