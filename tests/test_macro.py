"""The FreeCAD macro: the same solids as everywhere, driven by a spreadsheet, in FreeCAD itself."""

import ast
import sys

import freecadcmd
import numpy as np
import pytest
from kits import bounds, inside, kit, random_inside, tee, tiled
from python38 import newer

from scadgen.emit.macro import macro
from scadgen.kit.live import PARAMETERS
from scadgen.solid.mesh import volume

FREECAD = {"FreeCAD", "FreeCADGui", "Part"}

KINDS = {"hexagonal": ("hexagonal", "fixed", 0.0), "square": ("square", "loose", 1.5)}


def the(frame):
    return kit(*KINDS[frame])


@pytest.fixture(params=[*KINDS])
def made(request):
    return the(request.param)


@pytest.fixture
def file(made, tmp_path):
    path = tmp_path / f"{made.name}.FCMacro"
    path.write_text(macro(made), encoding="utf-8")
    return path


def test_same_kit_same_bytes_and_it_ends_in_a_newline(made):
    assert macro(made) == macro(made)
    assert macro(made).endswith("open_kit(KIT)\n")


def test_macro_imports_the_standard_library_and_freecad_alone(made):
    tree = ast.parse(macro(made))
    modules = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            modules |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0
            modules.add(node.module.split(".")[0])
    assert modules <= FREECAD | sys.stdlib_module_names


def test_macro_runs_on_the_oldest_python_that_freecad_has(made):
    assert newer(macro(made)) == []


def test_macro_has_all_that_it_uses(made):
    tree = ast.parse(macro(made))
    defined = {n.name for n in ast.walk(tree) if isinstance(n, ast.ClassDef | ast.FunctionDef)}
    assert {"parse_kit", "make_shape", "open_kit", "refuse"} <= defined


def expected(made, name, values):
    solid = made.parts[name]
    points = solid.points(values)
    return volume(points, solid.triangles), points.min(axis=0), points.max(axis=0)


def same(found, made, name, values):
    size, low, high = expected(made, name, values)
    assert found["state"] == ["Up-to-date"], (name, found["says"])
    assert (found["type"], found["closed"]) == ("Solid", True)
    assert found["volume"] == pytest.approx(size, rel=1e-6)
    np.testing.assert_allclose([found["low"], found["high"]], [low, high], rtol=0, atol=1e-6)


def test_every_part_is_the_same_solid_at_any_setting(made, file, tmp_path):
    settings = [random_inside(made, seed) for seed in range(10)]
    # The judge is slower than all the rest; where faces are smallest it matters most.
    found = (inside(made, [share] * len(PARAMETERS)) for share in (0.0, 0.5, 1.0))
    ends = [values for values in found if values is not None]
    given = {"settings": settings + ends, "judged": len(ends)}
    found, said = freecadcmd.run(
        "macro.py", tmp_path, task="shapes", macro=str(file), folder=str(tmp_path), **given
    )
    assert found["modules"] == []
    assert found["valid"] == [[True] * len(made.parts)] * (1 + len(ends))
    for values, parts in zip(given["settings"], found["settings"], strict=True):
        assert list(parts) == list(made.parts)
        for name, facts in parts.items():
            same(facts, made, name, values)
    for name, (valid, kind, size) in found["step"].items():
        assert (valid, kind) == (True, "Solid")
        assert size == pytest.approx(expected(made, name, made.values)[0], rel=1e-6)
    assert "rror" not in said


def test_the_macro_of_any_frame_opens_it_with_sound_solids(tmp_path):
    kits = {"tee": tee(), "cairo": tiled("V3.3.4.3.4")}
    for name, made in kits.items():
        (tmp_path / f"{name}.FCMacro").write_text(macro(made), encoding="utf-8")
    paths = [str(tmp_path / f"{name}.FCMacro") for name in kits]
    opened, said = freecadcmd.run("macro.py", tmp_path, task="opens", macros=paths)
    for made, found in zip(kits.values(), opened, strict=True):
        assert found["valid"] == [True] * len(made.parts)
        assert list(found["parts"]) == list(made.parts)
        for name, facts in found["parts"].items():
            same(facts, made, name, made.values)
        sizes = {name: expected(made, name, made.values)[0] for name in made.parts}
        pieces = {"Frame": made.placements} | {f"Joint{j.name}": j.pieces for j in made.joints}
        wholes = {name: sum(sizes[p.part] for p in placed) for name, placed in pieces.items()}
        assert found["wholes"] == pytest.approx(wholes, rel=1e-6)
        assert found["counts"] == ([] if made.cells is None else [1, 1])
    assert "rror" not in said


def matrix(placement, edge_length):
    """Four by four, row by row: where x, y and z of the part point, and where it is."""
    x, z, at = (np.array(v) for v in (placement.pose.x, placement.pose.z, placement.pose.at))
    rows = np.column_stack([x, np.cross(z, x), z, at * edge_length])
    return [*rows.ravel(), 0, 0, 0, 1]


def assert_placed(found, placements, edge_length):
    """The same parts at the same places, in whatever order."""
    ours = [(p.part, *matrix(p, edge_length)) for p in placements]
    ordered = [
        sorted(rows, key=lambda r: (r[0], *np.round(r[1:], 3) + 0.0)) for rows in (found, ours)
    ]
    assert [r[0] for r in ordered[0]] == [r[0] for r in ordered[1]]
    np.testing.assert_allclose([r[1:] for r in ordered[0]], [r[1:] for r in ordered[1]], atol=1e-9)


def test_joint_and_frame_are_links_to_the_parts(made, file, tmp_path):
    found, _ = freecadcmd.run(
        "macro.py", tmp_path, task="assembly", macro=str(file), wider=123.0, rows=5, columns=1
    )
    assert found["types"] == ["App::Link", "App::LinkPython"]
    frame, wider = made.placements, made.cells.laid(5, 1).placements
    for name, placements in (("joint", made.joints[0].pieces), ("frame", frame)):
        sizes = [expected(made, p.part, made.values)[0] for p in placements]
        assert found[f"{name}_volume"] == pytest.approx(sum(sizes), rel=1e-6)
    assert_placed(found["joint"], made.joints[0].pieces, 0.0)
    assert_placed(found["frame"], wider, 123.0)
    assert found["none"] == "rows = 0: must be a whole number from 1 to 100"


def test_spreadsheet_drives_the_parts_and_what_is_out_of_range_is_refused(made, file, tmp_path):
    other = tmp_path / "other.FCMacro"
    other.write_text(macro(kit("square")), encoding="utf-8")
    high = bounds(made, "clearance", made.values)[1]
    steps = [
        ["clearance", "=0.3 mm"],
        ["clearance", f"={high + 0.1!r} mm"],
        ["clearance", "=-0.1 mm"],
        ["clearance", "0.25"],
        ["clearance", "=0.0125 in"],
    ]
    found, said = freecadcmd.run(
        "macro.py",
        tmp_path,
        task="life",
        macro=str(file),
        other=str(other),
        path=str(tmp_path / "kit.FCStd"),
        steps=steps,
    )
    changed, above, below, plain, inches = found["steps"]
    for step, clearance in ((changed, 0.3), (plain, 0.25), (inches, 0.0125 * 25.4)):
        for name, facts in step.items():
            same(facts, made, name, {**made.values, "clearance": clearance})
    for step, value in ((above, high + 0.1), (below, -0.1)):
        message = f"clearance = {value:g} mm: must be 0 to {high:.4g} mm for side = 10"
        for name, facts in step.items():
            assert "Invalid" in facts["state"]
            assert facts["says"].startswith(message)
            assert "\n" not in facts["says"]
            assert facts["volume"] == changed[name]["volume"]
        # FreeCAD 1.0 says it once more, after the part's label.
        assert said.count(f"'ValueError'>: {message}") == len(made.parts)
    assert found["limited"] is False
    last = inches["half"]["volume"]
    asleep, facts = found["asleep"]
    assert asleep
    assert facts["volume"] == pytest.approx(last, rel=1e-9)
    assert found["still"]["volume"] == facts["volume"]
    same(found["awake"], made, "half", {**made.values, "clearance": 0.1})
    assert found["names"] == [True, True]


def test_a_document_of_something_else_is_left_alone(tmp_path):
    path = tmp_path / "kit.FCMacro"
    path.write_text(macro(the("hexagonal")), encoding="utf-8")
    found, _ = freecadcmd.run("macro.py", tmp_path, task="beside", macro=str(path))
    assert found == [1, True, len(the("hexagonal").parts)]


def test_all_of_it_is_drawn_in_its_colours(tmp_path):
    path = tmp_path / "kit.FCMacro"
    path.write_text(macro(the("hexagonal")), encoding="utf-8")
    given = {"task": "looks", "macro": str(path), "picture": str(tmp_path / "top.png")}
    (hues, shown), _ = freecadcmd.run("macro.py", tmp_path, window=True, **given)
    # Red, salmon, yellow, green and blue; without the frame there is as much green as blue.
    assert min(hues.get(hue, 0) for hue in ("0", "10", "40", "140", "200")) > 100
    assert hues["200"] > 2 * hues["140"]
    assert all(shown)
