"""The examples run, and what README.md and docs/ say of the code is so."""

import ast
import importlib
import json
import os
import re
import shlex
import subprocess
import sys
from collections import Counter
from pathlib import Path

import click
import kits
import pytest

from scadgen.cli.main import cli, main
from scadgen.emit.scad import scad
from scadgen.emit.scad_parameters import sections
from scadgen.joint.joint import DETAILS
from scadgen.joint.weave import BUILT_IN, LIMITS, Weave
from scadgen.kit.live import PARAMETERS
from scadgen.kit.store import load
from scadgen.plane.catalogue import NAMES
from scadgen.tools.openscad import render
from scadgen.tools.stl import check_stl

ROOT = Path(__file__).parent.parent
EXAMPLES = ROOT / "examples"
DOCS = ROOT / "docs"
PYTHON = re.compile(r"```python\n(.*?)```", re.DOTALL)
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted(DOCS.glob("*.md")),
    ROOT / "examples/README.md",
    ROOT / "freecad_workbench/README.md",
]
#: An option as it is written on a page; not a rule of a table.
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
#: Programs that the pages name beside scadgen, with their options.
OTHERS = ("dask ", "openscad ", "python3 -m pip")


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
    text = (DOCS / "parameters.md").read_text()
    table = {name: tuple(map(float, numbers)) for name, _, *numbers in rows(text, "weave | for")}
    assert table == {
        name: (w.ring_ratio, w.span, w.amplitude, w.bend, w.periods) for name, w in BUILT_IN.items()
    }


def test_numbers_of_a_weave_are_what_they_may_be():
    table = rows((DOCS / "parameters.md").read_text(), "number")
    limits = {re.findall(r"\w+", name)[0]: (float(a), float(b)) for name, a, b, _ in table}
    assert limits == LIMITS


def test_tables_of_parameters_are_those_of_the_code():
    text = (DOCS / "parameters.md").read_text()
    assert tuple(row[0] for row in rows(text, "parameter")) == PARAMETERS
    own = {p.name for p in cli.commands["kit"].params}
    shape = [row[0] for row in rows(text.split("## Shape parameters")[1], "parameter")]
    assert {"key", "detail", "weave"} <= set(shape) <= own


def every_command():
    """Commands and commands of commands, each as it is typed."""
    for name, command in cli.commands.items():
        inner = getattr(command, "commands", {})
        yield from [(f"{name} {sub}", one) for sub, one in inner.items()] or [(name, command)]


def test_command_table_names_every_command():
    table = rows((DOCS / "commands.md").read_text(), "command")
    assert {words.split()[1] for words, *_ in table} == set(cli.commands)
    (freecad,) = (" ".join(row) for row in table if row[0].startswith("scadgen freecad"))
    assert all(name in freecad for name in cli.commands["freecad"].commands)


@pytest.mark.parametrize(("words", "command"), [*every_command()], ids=str)
def test_help_says_what_every_option_does(words, command):
    assert command.help, words
    options = [p for p in command.params if p.param_type_name == "option"]
    shown = " ".join(command.get_help(click.Context(command)).split())
    for option in options:
        assert option.help, (words, option.name)
        assert option.opts[-1] in shown, (words, option.name)
        assert " ".join(option.help.split()) in shown, (words, option.name)


def test_every_option_of_a_named_frame_is_in_its_table():
    table = " ".join(
        " ".join(row) for row in rows((DOCS / "frames.md").read_text(), "frame | other names")
    )
    area = {"rows", "columns", "radius", "outline"}
    known = {o.replace("_", "-") for family in NAMES.values() for o in family.options} - area
    assert set(re.findall(r"--([a-z-]+)", table)) == known


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_option_on_a_page_is_one(page):
    known = {o for _, command in every_command() for p in command.params for o in p.opts}
    known |= {"--help"}
    for line in page.read_text().splitlines():
        if not line.strip().startswith(OTHERS):
            assert set(OPTION.findall(line)) <= known, line


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_commands_on_a_page_can_be_typed(page):
    for line in re.findall(r"^    (scadgen [^\n]*)", page.read_text(), re.MULTILINE):
        _, name, *words = shlex.split(line, comments=True)
        # Refuses what the command has not; nothing is run.
        cli.commands[name].make_context(name, words)


def test_targets_of_the_make_page_are_those_of_a_kit():
    makefile = (ROOT / "templates" / "kit.mk.j2").read_text()
    (phony,) = re.findall(r"^\.PHONY: (.*)", makefile, re.MULTILINE)
    table = rows((DOCS / "make.md").read_text(), "target")
    assert {row[0].split("`")[0] for row in table} == set(phony.split()) - {"FORCE"}


def test_sliders_of_the_openscad_page_are_those_of_a_kit():
    table = rows((DOCS / "openscad.md").read_text(), "slider")
    named = {name for row in table for name in re.findall(r"\w+", row[0])}
    own = {p.name for one in sections(kits.kit("hexagonal")) for p in one.parameters}
    assert named == own - set(PARAMETERS)


def test_modules_of_the_openscad_page_are_those_of_a_kit():
    drawn = scad(kits.kit("hexagonal"))
    for call, _ in rows((DOCS / "openscad.md").read_text(), "module"):
        name, arguments = re.fullmatch(r"(\w+)\((.*)\)", call).groups()
        (real,) = re.findall(rf"^module {name}\((.*)\) ", drawn, re.MULTILINE)
        real = re.sub(r"\([^()]*\)", "", real)
        assert arguments.split(", ") == [one.split(" =")[0] for one in real.split(", ")], name


def anchors(page):
    """What links can lead to on a page: its headings, as GitHub names them."""
    heads = re.findall(r"^#+ (.*)", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for link in re.findall(r"\]\(([^)]+)", page.read_text()):
        if link.startswith("https://"):
            continue
        file, _, place = link.partition("#")
        target = page.parent / file if file else page
        assert target.exists(), link
        assert not place or place in anchors(target), link


def test_play_on_the_page_on_printing_is_that_of_the_figures():
    figures = rows((DOCS / "geometry.md").read_text().split("## Figures")[1], "weave")
    plays = [float(row[-1]) for row in figures]
    table = rows((DOCS / "printing.md").read_text().split("## How much")[1], "joint")
    stated = [[float(cell.removesuffix(" mm")) for cell in row[1:]] for row in table]
    assert stated == [[round(play), round(0.2 * play, 1)] for play in plays]


def test_the_readme_is_one_page():
    assert len((ROOT / "README.md").read_text().splitlines()) <= 80


def test_every_page_is_reached_from_the_readme():
    seen, rest = set(), [ROOT / "README.md"]
    while rest:
        page = rest.pop()
        if page not in seen and page.suffix == ".md":
            seen.add(page)
            links = re.findall(r"\]\(([^)#]+)", page.read_text())
            rest += [(page.parent / link).resolve() for link in links if "://" not in link]
    assert set(PAGES) <= seen


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
