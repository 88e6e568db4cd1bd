"""The build and the commands around it: wheel, Makefile, setup script, layers."""

import os
import shutil
import subprocess
import sys
import time
import tomllib
import zipfile
from pathlib import Path

import pytest
from wheels import copy_tree, wheel

import scadgen
from scadgen.emit.templates import environment

ROOT = Path(__file__).parent.parent
SHELL = shutil.which("bash") or "/bin/bash"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def run(*command, cwd=ROOT, **variables):
    environ = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL")}
    return subprocess.run(
        [str(word) for word in command],
        cwd=cwd,
        env=environ | {name: str(value) for name, value in variables.items()},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        stdin=subprocess.DEVNULL,
    )


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory):
    """What is in the wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    with zipfile.ZipFile(wheel()) as archive:
        archive.extractall(folder)
    return folder


def test_wheel_has_the_package_its_types_and_its_templates(unpacked):
    assert (unpacked / f"scadgen_truss-{scadgen.__version__}.dist-info").is_dir()
    assert (unpacked / "scadgen/py.typed").is_file()
    shipped = {p.name for p in (unpacked / "scadgen/templates").iterdir()}
    assert shipped == {p.name for p in (ROOT / "templates").iterdir()}


def test_wheel_has_the_workbench_without_leavings(unpacked):
    ours = ROOT / "freecad_workbench"
    shipped = unpacked / "scadgen" / "freecad_workbench"
    names = {p.relative_to(ours) for p in ours.rglob("*") if p.is_file()}
    kept = {name for name in names if "__pycache__" not in name.parts}
    assert {p.relative_to(shipped) for p in shipped.rglob("*") if p.is_file()} == kept


def test_templates_are_found_from_the_wheel_alone(unpacked, tmp_path):
    code = (
        "import scadgen; from scadgen.emit.templates import environment;"
        "print(scadgen.__file__, *environment().list_templates())"
    )
    found = run(sys.executable, "-c", code, cwd=tmp_path, PYTHONPATH=unpacked)
    assert found.returncode == 0, found.stderr
    where, *names = found.stdout.split()
    assert Path(where).is_relative_to(unpacked)
    assert names == environment().list_templates()


def test_a_template_that_uses_an_unknown_name_is_an_error():
    with pytest.raises(Exception, match="'clearence' is undefined"):
        environment().from_string("{{ clearence }}").render(clearance=0.2)


def test_block_tags_leave_no_lines_and_the_last_newline_stays():
    text = environment().from_string("a\n  {% if true %}\nb\n  {% endif %}\n").render()
    assert text == "a\nb\n"


def test_nothing_is_escaped_for_html():
    assert environment().from_string("{{ x }}").render(x="<a&b>") == "<a&b>"


def test_make_without_target_lists_the_targets():
    said = run("make", "--no-print-directory")
    assert said.returncode == 0, said.stderr
    listed = [line.split()[1] for line in said.stdout.splitlines()]
    named = {
        *("setup", "demo", "test", "lint", "bench", "bench-against", "bench-frames"),
        *("pictures", "fresh", "clean", "help"),
    }
    assert named == set(listed)


def test_every_lint_rule_that_is_off_says_why():
    text = (ROOT / "pyproject.toml").read_text()
    rules = [*PROJECT["tool"]["ruff"]["lint"]["ignore"]]
    for ignored in PROJECT["tool"]["ruff"]["lint"]["per-file-ignores"].values():
        rules += ignored
    for rule in rules:
        lines = [line for line in text.splitlines() if line.strip().startswith(f'"{rule}",')]
        assert lines
        assert all("# " in line for line in lines), rule


@pytest.fixture
def bare_path(tmp_path):
    """A PATH with the usual commands, but no OpenSCAD and no package manager."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name in ("bash", "cat", "cmp", "dirname", "env", "id", "mkdir", "python3", "tail"):
        (folder / name).symlink_to(shutil.which(name))
    return folder


def test_setup_without_apt_get_says_in_one_line_what_is_missing(tmp_path, bare_path):
    copy = copy_tree(tmp_path / "tree")
    said = run(SHELL, "scripts/setup", cwd=copy, PATH=bare_path)
    assert said.returncode != 0
    assert said.stdout == ""
    (line,) = said.stderr.splitlines()
    assert line.startswith("setup: missing: openscad xvfb xauth ")
    assert not (copy / ".venv").exists()


def test_setup_for_tests_also_needs_node_and_freecad(tmp_path, bare_path):
    copy = copy_tree(tmp_path / "tree")
    said = run(SHELL, "scripts/setup", "tests", cwd=copy, PATH=bare_path)
    (line,) = said.stderr.splitlines()
    assert line.startswith("setup: missing: openscad xvfb xauth nodejs npm freecad chromium")


def test_setup_refuses_an_unknown_argument_in_one_line():
    said = run(SHELL, "scripts/setup", "everything")
    assert said.returncode != 0
    assert said.stderr == "setup: unknown argument: everything; takes nothing, or: tests\n"


@pytest.mark.skipif(not (ROOT / ".venv/recipe").exists(), reason="not set up by `make setup`")
def test_setup_is_quick_and_silent_when_there_is_nothing_to_do():
    start = time.monotonic()
    said = run("make", "--no-print-directory", "setup")
    seconds = time.monotonic() - start
    assert (said.returncode, said.stdout, said.stderr) == (0, "", "")
    # Alone it takes a fifth of a second; the other workers are busy meanwhile.
    assert seconds < 5


@pytest.mark.parametrize(
    ("module", "line", "broken"),
    [
        ("solid/affine.py", "import scadgen.cli", "scadgen.solid is not allowed to import"),
        ("emit/preview.py", "import scadgen.cli", "scadgen.emit is not allowed to import"),
        ("joint/weave.py", "import json", "scadgen.joint is not allowed to import json"),
    ],
)
def test_an_import_against_the_layers_is_caught(tmp_path, module, line, broken):
    shutil.copytree(ROOT / "scadgen", tmp_path / "scadgen")
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    path = tmp_path / "scadgen" / module
    path.write_text(path.read_text() + f"\n{line}  # noqa\n")
    lint = Path(sys.executable).parent / "lint-imports"
    said = run(lint, "--no-cache", cwd=tmp_path, PYTHONPATH=tmp_path)
    assert said.returncode != 0
    assert broken in said.stdout
