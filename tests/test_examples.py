"""The examples run, and what README.md and docs/ say of the code is so."""

import ast
import importlib
import json
import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import kits
import pytest

from scadgen.cli.main import cli, main
from scadgen.emit.scad import scad
from scadgen.joint.joint import DETAILS
from scadgen.joint.weave import BUILT_IN, Weave
from scadgen.kit.store import load
from scadgen.tools.openscad import render
from scadgen.tools.stl import check_stl

ROOT = Path(__file__).parent.parent
EXAMPLES = ROOT / "examples"
README = (ROOT / "README.md").read_text()
PYTHON = re.compile(r"```python\n(.*?)```", re.DOTALL)
PAGES = [
    ROOT / page
    for page in (
        "README.md",
        "docs/geometry.md",
        "docs/architecture.md",
        "docs/python.md",
        "examples/README.md",
    )
]


def python(code, cwd):
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    return subprocess.run(
        [sys.executable, *code],
        cwd=cwd,
        env=os.environ | {"PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    ).stdout


def rows(text, first):
    """Cells of a Markdown table's body, by a cell of its head."""
    lines = text.split(f"| {first} |", 1)[1].splitlines()[2:]
    body = lines[: next(n for n, line in enumerate(lines) if not line.startswith("|"))]
    return [[cell.strip().strip("`") for cell in line.strip("|").split("|")] for line in body]


def test_python_example_writes_a_watertight_part(tmp_path):
    said = python([EXAMPLES / "from_python.py", "half.stl"], tmp_path)
    assert float(said.split()[-2]) == pytest.approx(
        check_stl(tmp_path / "half.stl") / 1000, abs=0.006
    )


def test_python_in_the_readme_writes_a_watertight_part(tmp_path):
    (code,) = PYTHON.findall(README)
    python(["-c", code], tmp_path)
    assert check_stl(tmp_path / "basic.stl") > 0


def test_python_in_the_geometry_page_prints_what_the_page_says(tmp_path):
    text = (ROOT / "docs/geometry.md").read_text()
    (code,) = PYTHON.findall(text)
    said = re.findall(r"([\d.]+)% within", python(["-c", code], tmp_path))
    stated = text.split("\nprints ", 1)[1].split(";")[0]
    assert [float(share) for share in said] == [
        float(share) for share in re.findall(r"([\d.]+) %", stated)
    ]


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """Give the OpenSCAD example beside a kit's file."""
    folder = tmp_path_factory.mktemp("library")
    (folder / "hexagonal.scad").write_text(scad(kits.kit("hexagonal")), encoding="ascii")
    example = folder / "use_library.scad"
    example.write_text((EXAMPLES / example.name).read_text(encoding="ascii"), encoding="ascii")
    return example


@pytest.mark.parametrize("show", ["drilled", "joint", "measured"])
def test_library_example_draws(library, tmp_path, show):
    render(library, tmp_path / "drawn.stl", {"show": show}, timeout=120)
    assert check_stl(tmp_path / "drawn.stl") > 0


def test_library_example_drills_what_it_says(library, tmp_path):
    width = 3.4
    volumes = []
    for name, hole in (("narrow", 1.0), ("wide", width)):
        output = tmp_path / f"{name}.stl"
        render(library, output, {"show": "drilled", "hole": hole}, timeout=120)
        volumes.append(check_stl(output))
    # A regular 32-gon of diameter d has the area 4 d^2 sin(2 pi / 32) = 0.7804 d^2.
    side = kits.kit("hexagonal").values["side"]
    assert volumes[0] - volumes[1] == pytest.approx(0.7804 * (width**2 - 1) * side, rel=1e-3)


def test_weave_example_makes_a_kit(tmp_path):
    entries = json.loads((EXAMPLES / "gentle.json").read_text())
    words = ["kit", "hexagonal", "--detail", "draft", "--weave", str(EXAMPLES / "gentle.json")]
    with pytest.raises(SystemExit) as done:
        main([*words, "-o", str(tmp_path / "kit")])
    assert done.value.code == 0
    assert load(tmp_path / "kit").joints[0].weave == Weave.from_dict(entries, "gentle").as_dict()


def test_weave_table_is_the_built_in_weaves():
    table = {name: tuple(map(float, numbers)) for name, _, *numbers in rows(README, "weave | for")}
    assert table == {
        name: (w.ring_ratio, w.span, w.amplitude, w.bend, w.periods) for name, w in BUILT_IN.items()
    }


def test_command_table_names_every_option():
    for words, _, options in rows(README, "command"):
        command = cli.commands[words.split()[1]]
        known = [opt for p in command.params for opt in p.opts if opt.startswith("--")]
        assert sorted(re.findall(r"`(--[a-z-]+)`", f"`{options}`")) == sorted(known), words


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for link in re.findall(r"\]\(([^)#]+)", page.read_text()):
        assert link.startswith("https://") or (page.parent / link).exists(), link


def test_module_map_names_every_module_once():
    text = (ROOT / "docs/architecture.md").read_text()
    named = re.findall(r"^\| `([\w/]+\.py)` \|", text, re.MULTILINE)
    folders = (ROOT / "scadgen", ROOT / "freecad_workbench/freecad/scadgen")
    there = [
        path.relative_to(folder).as_posix()
        for folder in folders
        for path in folder.rglob("*.py")
        if path.name != "__init__.py"
    ]
    assert sorted(named) == sorted(there)


def test_no_class_has_the_name_of_another():
    found = Counter(
        node.name
        for path in (ROOT / "scadgen").rglob("*.py")
        for node in ast.parse(path.read_text()).body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    )
    assert [name for name, count in found.items() if count > 1] == []


def test_numbers_are_those_of_the_code():
    numbers = rows((ROOT / "docs/geometry.md").read_text(), "constant")
    assert len(numbers) > 30
    for name, value, *_ in numbers:
        path, _, constant = name.rpartition(".")
        real = getattr(importlib.import_module(f"scadgen.{path}"), constant)
        assert float(value) == pytest.approx(float(real), rel=1e-12), name


def _tolerances(layer):
    """Names of a layer's constants that are far below 1, or as near to it."""
    for path in sorted((ROOT / "scadgen" / layer).glob("*.py")):
        module = importlib.import_module(f"scadgen.{layer}.{path.stem}")
        for node in ast.parse(path.read_text()).body:
            targets = node.targets if isinstance(node, ast.Assign) else []
            for name in (
                found.id for t in targets for found in ast.walk(t) if hasattr(found, "id")
            ):
                value = getattr(module, name)
                if isinstance(value, float) and 0 < min(value, abs(1 - value)) < 1e-3:
                    yield f"{layer}.{path.stem}.{name}"


@pytest.mark.parametrize("layer", ["solid", "joint", "element", "frame", "kit", "plan", "readers"])
def test_no_tolerance_is_left_out(layer):
    stated = {name for name, *_ in rows((ROOT / "docs/geometry.md").read_text(), "constant")}
    found = set(_tolerances(layer))
    assert found
    assert found - stated == set()


def test_levels_of_detail_are_those_of_the_code():
    table = rows((ROOT / "docs/geometry.md").read_text(), "detail")
    stated = {name: (int(samples), int(cells)) for name, samples, cells in table}
    assert stated == {name: (level.samples, level.cells) for name, level in DETAILS.items()}
