"""The wheel, installed outside of the checkout, makes a kit."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from shared import once
from wheels import wheel


def run(*command, cwd):
    """Run a command that must succeed, with nothing of the checkout in its environment."""
    environ = {n: v for n, v in os.environ.items() if n not in ("PYTHONPATH", "VIRTUAL_ENV")}
    said = subprocess.run(
        [str(word) for word in command],
        cwd=cwd,
        env=environ,
        capture_output=True,
        text=True,
        check=False,
        timeout=240,
        stdin=subprocess.DEVNULL,
    )
    assert said.returncode == 0, said.stdout + said.stderr
    return said.stdout


@pytest.fixture(scope="module")
def installed():
    """Folder of programs of a fresh environment with the wheel in it.

    What the wheel needs is taken from the environment that runs the tests; the wheel itself
    and its metadata are its own.
    """
    return once("installed", _install)


def _install(place):
    run(sys.executable, "-m", "venv", "--without-pip", place / "venv", cwd=place)
    python = place / "venv" / "bin" / "python"
    (site,) = (place / "venv" / "lib").glob("python3*/site-packages")
    ours = run(
        sys.executable, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", cwd=place
    )
    (site / "requirements.pth").write_text(ours)
    install = (sys.executable, "-m", "pip", "--python", python, "install", "--no-index", "--quiet")
    run(*install, "--no-deps", "--force-reinstall", wheel(), cwd=place)
    return python.parent


def test_the_program_is_the_installed_one(installed, tmp_path):
    where = run(installed / "python", "-c", "import scadgen; print(scadgen.__file__)", cwd=tmp_path)
    assert Path(where).is_relative_to(installed.parent)


def test_its_requirements_are_those_it_imports(installed, tmp_path):
    code = "import importlib.metadata as m; print(*m.requires('scadgen-truss'), sep='\\n')"
    said = run(installed / "python", "-c", code, cwd=tmp_path).splitlines()
    needed = {line.split(">")[0] for line in said if "extra ==" not in line}
    assert {"click", "jinja2", "jsonschema", "numpy", "scipy", "shapely"} <= needed


def test_it_makes_a_kit(installed, tmp_path):
    said = run(installed / "scadgen", "kit", "hexagonal", "--detail", "draft", cwd=tmp_path)
    assert "61 pieces to print" in said
    assert {p.name for p in (tmp_path / "hexagonal").iterdir()} == {
        "kit.json",
        "hexagonal.scad",
        "hexagonal.json",
        "hexagonal.FCMacro",
        "Makefile",
        "check_stl.py",
        "README.md",
        "parts.csv",
        "preview.png",
        "assembly.png",
    }
    said = run(
        *(installed / "scadgen", "export", "hexagonal", "--part", "half", "-o", "half.stl"),
        cwd=tmp_path,
    )
    assert "half.stl: half, " in said
    run(sys.executable, "hexagonal/check_stl.py", "half.stl", cwd=tmp_path)
