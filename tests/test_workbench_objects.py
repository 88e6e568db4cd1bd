"""Kits as objects in FreeCAD without a window: made, saved, opened, edited, refused, exported."""

import csv
import re

import freecadcmd
import numpy as np
import pytest
import trimesh
from click.testing import CliRunner
from kits import kit, tee, tiled
from workbench import linked, objects

from scadgen.cli.main import cli
from scadgen.frame.placement import bill
from scadgen.kit.entries import part_entry
from scadgen.kit.store import load
from scadgen.solid.mesh import volume

NAMES = {
    "basic": "Basic",
    "one_sided": "OneSided",
    "two_sided": "TwoSided",
    "connector": "Connector",
    "half": "Half",
    "peg": "Peg",
    "tube": "Tube",
}


def expected(made, **values):
    """Volume of each part by the engine, in mm3, by the object's name."""
    at = {**made.values, **values}
    return {NAMES[n]: volume(s.points(at), s.triangles) for n, s in made.parts.items()}


@pytest.fixture(scope="module")
def made():
    return kit("hexagonal")


@pytest.fixture(scope="module")
def session():
    """What three starts of FreeCAD found: with the workbench, without it, with it again."""
    return objects()


def test_every_part_has_the_engines_volume(session, made):
    found = session["make"]
    assert found["invalid"] == {}
    assert {n: found["volumes"][n] for n in NAMES.values()} == pytest.approx(expected(made))


def test_properties_say_how_many_how_large_and_how_heavy(session, made):
    found = session["make"]
    counts = bill(made.placements, made.parts)
    each = expected(made)
    total = sum(n * each[NAMES[part]] for part, n in counts.items())
    assert found["bill"] == [f"{n} {part}" for part, n in counts.items()]
    assert found["kit"] == pytest.approx([61, total, total / 1000 * 1.24], rel=1e-5)
    half = each["Half"]
    kind, *numbers, name = found["half"]
    assert (kind, name) == ("half", "hexagonal half")
    assert numbers == pytest.approx([half, half / 1000 * 1.24, 32], rel=1e-3)
    assert {"Volume", "Mass", "Count", "ScadgenVersion"} <= {*found["read_only"]}
    assert not {"Clearance", "Density", "BomName"} & {*found["read_only"]}


def test_joint_and_frame_are_links_to_one_part_each(session):
    found = session["make"]
    assert found["joint"] == [5, ["Connector", "Half", "Peg"]]
    assert found["frame"] == [61, 61]
    assert found["frame_types"] == ["App::Link"]
    assert found["frame_volume"] == pytest.approx(found["kit"][1])


def test_a_document_survives_saving_and_opening(session):
    found = session["edit"]
    assert found["opened"] == pytest.approx(session["make"]["volumes"])
    assert found["touched"] == []


def test_the_kits_clearance_is_that_of_all_parts(session, made):
    assert session["edit"]["wide"] == pytest.approx(expected(made, clearance=0.3))


def test_a_part_may_have_a_clearance_of_its_own(session, made):
    found = session["edit"]
    assert found["own"] == pytest.approx(expected(made, clearance=0.1)["Half"])
    assert found["follows"] == [True, False]
    assert found["followed"] == pytest.approx(expected(made, clearance=0.3)["Half"])


def test_parts_are_placed_and_attached(session):
    assert session["edit"]["placed"]
    assert session["edit"]["attached"] == 50


def test_a_frame_has_rows_of_its_own_and_the_kits_edge_length(session, made):
    found = session["edit"]
    count = len(made.cells.laid(3, 2).placements)
    assert found["rows"] == [count, 61]
    assert found["pitch"] == pytest.approx(70)


def test_a_value_out_of_range_is_refused_and_the_shape_kept(session):
    words = "clearance = 3 mm: must be 0 to 0."
    found = session["refuse"]
    said, kept = found["part"]
    assert [*said] == ["Half"]
    assert said["Half"].startswith(words)
    assert kept
    said, kept = found["kit"]
    assert said["Kit"].startswith(words)
    assert kept
    assert found["again"] == [{}, True]
    assert words in session["said"]


def test_what_fails_midway_leaves_nothing(session):
    found = session["refuse"]
    assert found["broken"].startswith("not a sound kit: truncated or not JSON")
    assert (found["added"], found["midway"]) == (0, 0)


def test_older_objects_are_brought_up_to_date_and_newer_ones_left_alone(session):
    found = session["old"]
    assert (found["half"], found["peg"]) == ([True, 2], [False, 99])
    assert "Peg: made by a newer scadgen workbench" in session["said"]


def test_a_kit_of_a_newer_version_is_said_so_and_shapes_stay(session):
    found = session["old"]
    assert found["kit"].startswith("kit version 7: this reads version 5; make it again")
    assert found["kept"]
    assert "Kit: hexagonal: kit version 7" in session["said"]


def matrix(placement, edge_length):
    """Row by row: where x, y and z of the part point, and where it is, in mm."""
    x, z, at = (np.array(v) for v in (placement.pose.x, placement.pose.z, placement.pose.at))
    rows = np.column_stack([x, np.cross(z, x), z, at * edge_length])
    return [*rows.ravel(), 0, 0, 0, 1]


def assert_placed(found, placements, edge_length):
    """The same parts at the same places, in whatever order."""
    ours = [(p.part, *matrix(p, edge_length)) for p in placements]
    rows = [sorted(r, key=lambda r: (r[0], *np.round(r[1:], 3) + 0.0)) for r in (found, ours)]
    assert [r[0] for r in rows[0]] == [r[0] for r in rows[1]]
    np.testing.assert_allclose([r[1:] for r in rows[0]], [r[1:] for r in rows[1]], atol=1e-9)


@pytest.mark.parametrize("name", ["cells", "drawn"])
def test_kits_of_any_frame_are_opened(session, name):
    made = {"cells": tiled("V3.3.4.3.4"), "drawn": tee()}[name]
    found, edge = session["other"][name], made.values["edge_length"]
    assert found["invalid"] == {}
    assert [*found["volumes"].values()] == pytest.approx(
        [volume(s.points(made.values), s.triangles) for s in made.parts.values()]
    )
    assert {*found["joints"]} == {joint.name for joint in made.joints}
    for joint in made.joints:
        assert_placed(found["joints"][joint.name], joint.pieces, edge)
    assert_placed(found["frame"], made.placements, edge)
    assert found["counts"] == found["of_frame"] == (["Rows", "Columns"] if made.cells else [])


def test_a_frame_of_any_cells_grows(session):
    made = tiled("V3.3.4.3.4")
    placed, pieces = session["other"]["cells"]["more"]
    ours = made.cells.laid(3, 2).placements
    assert_placed(placed, ours, made.values["edge_length"])
    assert pieces == len(ours)


@pytest.mark.parametrize("name", ["cells", "drawn"])
def test_a_document_says_all_that_makes_its_kit_again(session, name):
    made = {"cells": tiled("V3.3.4.3.4"), "drawn": tee()}[name]
    assert CliRunner().invoke(cli, session["other"][name]["again"]).exit_code == 0
    again = load(session["folder"] / f"{name}_again" / "kit")
    assert again.parts.keys() == made.parts.keys()
    for part, ours in made.parts.items():
        assert part_entry(again.parts[part]) == part_entry(ours)
    counts = (3, 2) if made.cells else (0, 0)
    assert (again.rows, again.columns, again.values["clearance"]) == (*counts, 0.25)


def test_parts_of_any_frame_are_called_by_what_they_are_for(session):
    labels = session["other"]["cells"]["labels"]
    assert {"Edge element 1", "Connector A1", "Half A1"} <= {*labels}


def test_without_the_workbench_shapes_and_properties_stay(session, made):
    found = session["bare"]
    assert found["proxies"] == []
    sizes = expected(made, clearance=0.3, edge_length=70.0)
    assert {n: found["volumes"][n] for n in sizes} == pytest.approx(sizes)
    assert found["kept"]
    assert found["half"][0] == 0.2
    assert found["frame"] == len(made.cells.laid(3, 2).placements)


def test_restore_gives_all_their_behaviour_back(session, made):
    found = session["restore"]
    assert {*NAMES.values(), "Kit", "Joint", "Frame"} <= {*found["restored"]}
    assert (found["again"], found["invalid"]) == ([], {})
    sizes = expected(made, clearance=0.2, edge_length=70.0)
    assert {n: found["volumes"][n] for n in sizes} == pytest.approx(sizes)


def test_whole_kits_are_exported_with_counts(session):
    folder = session["folder"]
    with (folder / "bill.csv").open(newline="") as file:
        rows = {row["part"]: row for row in csv.DictReader(file)}
    assert {part: int(row["count"]) for part, row in rows.items()} == {
        "basic": 13,
        "two_sided": 6,
        "connector": 6,
        "half": 32,
        "peg": 4,
    }
    total = 0.0
    for part, row in rows.items():
        path = folder / f"hexagonal_{part}_x{row['count']}.stl"
        mesh = trimesh.load(path)
        assert mesh.is_watertight
        assert mesh.volume == pytest.approx(float(row["volume_mm3"]), rel=1e-5)
        total += mesh.volume * int(row["count"])
        step = path.with_suffix(".step").read_text()
        assert "'1970-01-01T00:00:00'" in step
        assert f"PRODUCT('{part}'" in step
    assert total == pytest.approx(session["export"]["kit"], rel=1e-5)


def test_whole_kits_are_laid_out_on_beds(session):
    bodies = []
    for path in sorted(session["folder"].glob("hexagonal_plate_*.3mf")):
        scene = trimesh.load(path)
        low, high = scene.bounds
        assert (low >= -1e-5).all()
        assert (high[:2] <= 220 + 1e-5).all()
        bodies += [m for m in scene.dump() if m.is_watertight]
    assert len(bodies) == 61
    assert sum(m.volume for m in bodies) == pytest.approx(session["export"]["kit"], rel=1e-5)


def test_what_is_selected_is_exported_where_it_stands(session):
    folder, found = session["folder"], session["export"]
    half, joint = trimesh.load(folder / "Half.stl"), trimesh.load(folder / "Joint.stl")
    assert half.volume == pytest.approx(found["half"], rel=1e-5)
    assert joint.volume == pytest.approx(found["joint"], rel=1e-5)
    assert joint.bounds[:, 2] == pytest.approx([15, 25], abs=1e-4)
    both = trimesh.load(folder / "selection.3mf")
    assert sum(m.volume for m in both.dump()) == pytest.approx(half.volume + joint.volume, 1e-5)
    assert all(found[kind] for kind in ("step", "stl", "3mf"))


def test_wrong_exports_are_refused_in_one_line(session):
    found = session["export"]
    assert found["nothing"].startswith("nothing is selected")
    assert found["same"].startswith("Half.step: two of what is selected would be this file")
    assert found["other"].startswith("Box: not a part, joint or frame of a kit")
    assert "must fit the bed of 60 x 50 mm" in found["bed"]
    assert "cannot be written to" in found["folder"]
    assert not any("\n" in str(words) for words in found.values())


def test_users_can_have_freecad_test_the_workbench(tmp_path):
    said = freecadcmd.call(linked(tmp_path), "-t", "freecad.scadgen.self_test")
    assert re.search(r"^Ran 6 tests in .*\n\nOK$", said, re.MULTILINE), said
