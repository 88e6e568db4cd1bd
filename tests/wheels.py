"""The wheel, built once from what a clean clone has."""

import shutil
import subprocess
import sys
from pathlib import Path

from shared import once

__all__ = ["copy_tree", "wheel"]

ROOT = Path(__file__).parent.parent


def copy_tree(target):
    """Copy what a clean clone has."""
    left_out = shutil.ignore_patterns(
        ".git", ".venv", ".cache", "out", "node_modules", "__pycache__", ".*_cache"
    )
    return Path(shutil.copytree(ROOT, target, ignore=left_out))


def wheel():
    """The path of the wheel."""
    return once("wheel", _build)


def _build(place):
    copy = copy_tree(place / "tree")
    said = subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(place)],
        cwd=copy,
        capture_output=True,
        text=True,
        check=False,
        timeout=240,
    )
    assert said.returncode == 0, said.stderr
    shutil.rmtree(copy)
    (path,) = place.glob("*.whl")
    return path
