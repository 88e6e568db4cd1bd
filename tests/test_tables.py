"""The tables of live parameters and of parts: what is written from them, and what is added."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import trimesh
from kits import kit

from scadgen.emit.macro import workbench
from scadgen.kit import roles
from scadgen.kit.live import LIVE, PARAMETERS
from scadgen.kit.ranges import check_values

sys.path.append(str(workbench()))
sys.path.append(str(workbench().parent / "scripts"))
import tables

from freecad.scadgen.tables import LENGTHS, OPTIONAL, PART_ROLES

ROOT = workbench().parent

#: A live parameter that there is not: its entry in the table, and its geometry.
ENTRY = """
    Live(
        "tube_gap",
        "Gap at each end of plain tubes",
        "Tube",
        step=0.25,
        usual=1.5,
        default=lambda values: 0.15 * values["side"],
        ranges=lambda _: [
            Range("tube_gap", Linear({"side": 0.1}), Linear({"side": 0.2}), "tubes look lost")
        ],
        by_default="0.15 sides",
    ),
)

#: Their names"""
#: A part that there is not: what it is for, its solid, and where the kit gets it from.
ROLE = """    "spacer": PartRole("Spacer {}", "Spacer", "peg"),
}
"""
SOLID = '''

def spacer(key: Key) -> AffineSolid:
    """A tube half as long as others."""
    flat = flat_end(key, {})
    return part("spacer", flat, flat, {"edge_length": 0.5})
'''
TUBES = '"tube", length=1.0)'

#: A kit that is made fast.
KIT = ("kit", "hexagonal", "--detail", "draft", "--unchecked")

#: Where the end of a plain tube is.
FLAT = 'flat_end(key, {"side": key.tube_start, "clearance": 1.0'


@pytest.mark.parametrize(("path", "text"), [*tables.tables()], ids=lambda x: Path(x).name[:20])
def test_what_is_written_from_the_table_is_current(path, text):
    assert path.read_text("utf-8") == text, "run scripts/tables.py"


def test_all_know_the_same_names():
    assert tuple(LENGTHS) == PARAMETERS
    assert {name for name, _ in LENGTHS.values()} == {live.property_name for live in LIVE}
    assert {role: said[0] for role, said in PART_ROLES.items()} == {
        role: said.label for role, said in roles.PART_ROLES.items()
    }
    schema = json.loads(tables.SCHEMA.read_text("utf-8"))["$defs"]
    assert schema["parameter"]["enum"] == list(PARAMETERS)
    assert {*schema["lengths"]["required"], *OPTIONAL} == {*PARAMETERS}


@pytest.mark.parametrize("key", ["fixed", "loose"])
@pytest.mark.parametrize("bore", [0.0, 2.0])
def test_every_live_parameter_has_a_range_after_those_that_its_bounds_are_made_of(key, bore):
    made = kit("hexagonal", key, bore)
    names = [limit.parameter for limit in made.ranges]
    assert {*names} == {*made.values} == {*PARAMETERS} - (set() if bore else {"bore"})
    for number, limit in enumerate(made.ranges):
        assert not {*limit.low.terms, *limit.high.terms} & {*names[number:]}
    check_values(made.ranges, made.values)


@pytest.fixture(scope="module")
def longer(tmp_path_factory):
    """The project with one more live parameter and one more part, and a kit with both."""
    place = tmp_path_factory.mktemp("project")
    ignored = shutil.ignore_patterns("__pycache__")
    for folder in ("scadgen", "templates", "freecad_workbench", "scripts"):
        shutil.copytree(ROOT / folder, place / folder, ignore=ignored)
    edit(place / "scadgen" / "kit" / "live.py", "\n)\n\n#: Their names", ENTRY)
    edit(place / "scadgen" / "kit" / "solids.py", FLAT, f'{FLAT}, "tube_gap": 1.0')
    edit(place / "scadgen" / "kit" / "roles.py", "\n}\n", f"\n{ROLE}")
    with (place / "scadgen" / "element" / "ends.py").open("a", encoding="utf-8") as file:
        file.write(SOLID)
    solids = place / "scadgen" / "kit" / "solids.py"
    edit(solids, TUBES, f'{TUBES}, Part.of(spacer(key), "spacer", length=0.5)')
    edit(solids, "key_end, part, peg", "key_end, part, peg, spacer")
    assert run(place, "scripts/tables.py")[0] == 0
    assert run(place, "-m", "scadgen", *KIT, "--tube-gap", "1.8", "-o", "made")[0] == 0
    return place


def edit(path, old, new):
    text = path.read_text("utf-8")
    assert text.count(old) == 1
    path.write_text(text.replace(old, new), "utf-8")


def run(place, *words):
    done = subprocess.run(
        [sys.executable, *words],
        cwd=place,
        env={**os.environ, "PYTHONPATH": str(place)},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


def test_a_new_one_is_an_option_with_its_default_and_its_range(longer):
    status, said, _ = run(longer, "-m", "scadgen", "kit", "--help")
    said = " ".join(said.split())
    assert status == 0
    assert "--tube-gap MM Gap at each end of plain tubes. [default: 0.15 sides]" in said
    status, _, said = run(longer, "-m", "scadgen", *KIT, "--tube-gap", "2.5", "-o", "no")
    assert (status, said.count("\n")) == (2, 1)
    assert "tube_gap = 2.5 mm: must be 1 to 2 mm for side = 10 (tubes look lost)" in said
    assert not (longer / "no").exists()


def test_a_new_one_is_in_the_kit_and_its_schema(longer):
    document = json.loads((longer / "made" / "kit.json").read_text("utf-8"))
    assert document["values"]["tube_gap"] == 1.8
    words = ("export", "made", "--part", "tube", "--set", "tube_gap=1", "-o", "tube.stl")
    assert run(longer, "-m", "scadgen", *words)[0] == 0
    kept = trimesh.load(longer / "tube.stl").extents[0]
    words = (*words[:5], "tube_gap=1.5", "-o", "tube.stl")
    assert run(longer, "-m", "scadgen", *words)[0] == 0
    assert trimesh.load(longer / "tube.stl").extents[0] == pytest.approx(kept - 2 * 0.5, abs=1e-4)
    del document["values"]["tube_gap"]
    (longer / "kit.json").write_text(json.dumps(document), "utf-8")
    status, _, said = run(longer, "-m", "scadgen", "export", "kit.json", *words[2:])
    assert status == 2, said
    assert "'tube_gap' is a required property" in said


def test_a_new_one_is_a_slider_of_its_section_with_its_limits(longer):
    text = (longer / "made" / "hexagonal.scad").read_text("ascii")
    tab = text.split("/* [Tube] */")[1].split("/* [")[0]
    assert "// Gap at each end of plain tubes, mm\ntube_gap = 1.8; // [1:0.025:2]\n" in tab
    assert "tubes look lost" in text
    lengths = []
    for gap in (1, 1.5):
        wanted = ["-D", 'part="tube"', "-D", f"tube_gap={gap}"]
        scad, stl = longer / "made" / "hexagonal.scad", longer / f"{gap}.stl"
        subprocess.run(["openscad", *wanted, "-o", stl, scad], check=True, capture_output=True)
        lengths.append(trimesh.load(stl).extents[0])
    assert lengths[0] - lengths[1] == pytest.approx(2 * 0.5, abs=1e-4)


def test_a_new_one_is_in_the_readme(longer):
    rows = (longer / "made" / "README.md").read_text("utf-8").splitlines()
    (row,) = [row for row in rows if row.startswith("| `tube_gap`")]
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    assert cells[1:] == ["1.8", "1", "2", "Gap at each end of plain tubes"]


def test_a_new_one_is_a_property_and_a_field_in_freecad(longer):
    code = (
        "import sys; sys.path.append('freecad_workbench')\n"
        "from freecad.scadgen.tables import LENGTHS; print(LENGTHS['tube_gap'])"
    )
    status, said, _ = run(longer, "-c", code)
    assert (status, said) == (0, "('TubeGap', 'Gap at each end of plain tubes')\n")
    panel = longer / "freecad_workbench" / "freecad" / "scadgen" / "ui" / "new_kit.ui"
    assert 'name="has_tube_gap"' in panel.read_text("utf-8")
    macro = (longer / "made" / "hexagonal.FCMacro").read_text("utf-8")
    assert '"TubeGap"' in macro


def test_a_new_part_is_in_all_files_and_drawn(longer):
    text = (longer / "made" / "hexagonal.scad").read_text("ascii")
    assert ", spacer:Spacer," in text
    assert "`spacer`" in (longer / "made" / "README.md").read_text("utf-8")
    assert "spacer" in (longer / "made" / "Makefile").read_text("utf-8")
    words = ("export", "made", "--part", "spacer", "--set", "edge_length=80", "-o", "spacer.stl")
    assert run(longer, "-m", "scadgen", *words)[0] == 0
    scad, stl = longer / "made" / "hexagonal.scad", longer / "drawn.stl"
    wanted = ["-D", 'part="spacer"', "-D", "edge_length=80"]
    subprocess.run(["openscad", *wanted, "-o", stl, scad], check=True, capture_output=True)
    for path in (longer / "spacer.stl", stl):
        mesh = trimesh.load(path)
        assert mesh.extents == pytest.approx([40, 10, 10], abs=1e-4)
        assert mesh.volume == pytest.approx(40 * 10 * 10, rel=1e-5)


def test_a_new_part_is_read_and_has_its_words_in_freecad(longer):
    code = (
        "import sys; sys.path.append('freecad_workbench')\n"
        "from freecad.scadgen.kit_data import read_kit\n"
        "from freecad.scadgen.tables import PART_ROLES\n"
        "print(PART_ROLES[read_kit('made').parts['spacer'].role])"
    )
    status, said, _ = run(longer, "-c", code)
    assert (status, said) == (0, "('Spacer', 'peg', 'kit')\n")
