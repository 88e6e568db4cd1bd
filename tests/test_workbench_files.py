"""What the workbench is made of, as far as it needs no FreeCAD: files, figures, layouts, words."""

import itertools
import re
import sys
from collections import Counter

import numpy as np
import pytest
import trimesh
from defusedxml import ElementTree
from hypothesis import given
from hypothesis import strategies as st
from python38 import newer

import scadgen
from scadgen.emit.macro import workbench

sys.path.append(str(workbench()))
sys.path.append(str(workbench().parent / "scripts"))
import freecad_translations

from freecad.scadgen import figures, mesh_files, plates
from freecad.scadgen.kit_data import KitError

ROOT = workbench().parent
SOURCE = workbench() / "freecad" / "scadgen"

BOX = trimesh.creation.box()
STILL = (1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0)


def body(name="box", size=(2.0, 3.0, 4.0), places=(STILL,)):
    points = [tuple(p) for p in (BOX.vertices * size).tolist()]
    return mesh_files.Body(name, points, [tuple(t) for t in BOX.faces.tolist()], places)


#: Parts that have an icon.
KINDS = {"basic", "one_sided", "two_sided", "connector", "half", "peg", "tube"}


# Figures


def test_volume_and_mass_of_a_box():
    box = body()
    assert figures.volume(box.points, box.triangles) == pytest.approx(24)
    assert figures.mass(2000, 1.25) == pytest.approx(2.5)


# Mesh files

QUARTER = (0, 1, 0, -1, 0, 0, 0, 0, 1, 10, 20, 30)  # about z, then moved


@pytest.mark.parametrize(("kind", "write"), [("stl", mesh_files.stl), ("3mf", mesh_files.threemf)])
def test_pieces_stand_where_they_are_placed(kind, write, tmp_path):
    bodies = [body(places=(STILL, QUARTER)), body('<"&>', (1, 1, 1))]
    data = write(bodies)
    assert write(bodies) == data
    path = tmp_path / f"pieces.{kind}"
    path.write_bytes(data)
    found = trimesh.load(path)
    mesh = found if kind == "stl" else found.to_mesh()
    assert mesh.volume == pytest.approx(24 + 24 + 1)
    assert mesh.is_watertight
    assert mesh.bounds == pytest.approx(np.array([[-1, -1.5, -2], [11.5, 21, 32]]), abs=1e-5)


@given(
    st.lists(st.tuples(*[st.floats(1, 90)] * 3, st.integers(1, 9)), min_size=1, max_size=6),
    st.tuples(st.floats(90, 250), st.floats(90, 250)),
)
def test_pieces_on_a_bed_do_not_meet(sizes, bed):
    bodies = [body(f"b{n}", s[:3], (STILL,) * s[3]) for n, s in enumerate(sizes)]
    found = plates.plates(bodies, bed)
    counts = Counter()
    for plate in found:
        boxes = []
        for placed in plate:
            counts[placed.name] += len(placed.places)
            for m in placed.places:
                points = np.array(placed.points) @ np.reshape(m[:9], (3, 3)) + m[9:]
                boxes.append((points.min(axis=0), points.max(axis=0)))
        for low, high in boxes:
            assert (low >= -1e-9).all()
            assert low[2] == pytest.approx(0, abs=1e-9)
            assert (high[:2] <= np.array(bed) + 1e-9).all()
        for (low, high), (low2, high2) in itertools.combinations(boxes, 2):
            apart = np.maximum(low[:2] - high2[:2], low2[:2] - high[:2])
            assert apart.max() >= 5 - 1e-6
    assert counts == {f"b{n}": s[3] for n, s in enumerate(sizes)}


def test_a_piece_is_turned_where_it_must_be_and_refused_where_it_does_not_fit():
    ((plate,),) = plates.plates([body(size=(90, 20, 10))], (30, 100))
    points = np.array(plate.points) @ np.reshape(plate.places[0][:9], (3, 3))
    assert np.ptp(points, axis=0) == pytest.approx([20, 90, 10])
    with pytest.raises(KitError, match="box is 90 x 20 mm: it must fit the bed of 80 x 30 mm"):
        plates.plates([body(size=(90, 20, 10))], (80, 30))


# Files


def test_all_versions_are_the_same():
    package = ElementTree.parse(workbench() / "package.xml").getroot()
    space = {"p": "https://wiki.freecad.org/Package_Metadata"}
    assert package.findtext("p:version", namespaces=space) == scadgen.__version__
    init = (SOURCE / "__init__.py").read_text()
    assert f'__version__ = "{scadgen.__version__}"' in init
    icon = package.findtext("p:icon", namespaces=space)
    assert (workbench() / icon).is_file()
    assert not (workbench() / "freecad" / "__init__.py").exists()
    assert (workbench() / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("rows = list[int]", ["list[int]"]),
        ("from collections.abc import Callable\nF = Callable[[], int]", ["Callable[[], int]"]),
        ("def f(x: list[int]): ...", ["list[int]"]),
        ("from __future__ import annotations\ndef f(x: list[int]) -> int | None: ...", []),
        ("from __future__ import annotations\nx: int | None = {**a}[1]", []),
        ("a = b | {1: 2}", ["b | {1: 2}"]),
        ("for a, b in zip(c, d, strict=True): ...", ["zip(c, d, strict=True)"]),
        ("a = 'b'.removeprefix('c')", ["'b'.removeprefix"]),
        ("from functools import cache", ["cache"]),
    ],
)
def test_what_is_newer_than_python_3_8_is_noticed(text, found):
    assert newer(text) == found


def test_the_workbench_runs_on_the_python_that_it_asks_for():
    assert "<pythonmin>3.8</pythonmin>" in (workbench() / "package.xml").read_text()
    found = {path.name: newer(path.read_text("utf-8")) for path in workbench().rglob("*.py")}
    assert len(found) > 30
    assert {name: what for name, what in found.items() if what} == {}


def test_every_icon_is_there_and_is_drawn():
    text = (SOURCE / "commands.py").read_text()
    used = set(re.findall(r'^        "([a-z_]+)",$', text, re.MULTILINE))
    assert len(used) == 10
    names = {path.stem for path in (SOURCE / "icons").glob("*.svg")}
    assert used | KINDS | {"workbench", "kit", "preferences-scadgen"} == names
    for path in (SOURCE / "icons").glob("*.svg"):
        assert ElementTree.parse(path).getroot().get("viewBox") == "0 0 64 64"


def test_modules_without_a_window_import_nothing_of_it():
    # These are what documents, macros and consoles need.
    for name in ("affine", "assembly_object", "kit_object", "part_object", "properties", "shape"):
        text = (SOURCE / f"{name}.py").read_text()
        assert "FreeCADGui" not in text
        assert "PySide" not in text


def test_all_words_are_translated():
    for path in (SOURCE / "translations").glob("*.ts"):
        found = freecad_translations.translated(path)
        assert sorted(found) == freecad_translations.words(), "run scripts/freecad_translations.py"
        for (context, text), translation in found.items():
            assert translation, (context, text)
            assert re.findall(r"{[^}]*}", translation) == re.findall(r"{[^}]*}", text)
        compiled = path.with_suffix(".qm").read_bytes()
        assert all(text.encode("utf-16-be") in compiled for text in found.values())


def test_every_picture_of_the_readme_is_there():
    text = (workbench() / "README.md").read_text()
    shown = set(re.findall(r"\]\((docs/[a-z_]+\.png)\)", text))
    kept = {p.relative_to(workbench()).as_posix() for p in (workbench() / "docs").iterdir()}
    assert shown == kept
