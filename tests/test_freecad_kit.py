"""Kits read and evaluated by the FreeCAD side, in plain Python."""

import ast
import copy
import json
import sys
from collections import Counter

import numpy as np
import pytest
from kits import kit, random_inside, tee, tiled

from scadgen.emit.macro import workbench
from scadgen.frame import placement
from scadgen.kit import cells as engine_cells
from scadgen.kit.entries import pose_entry
from scadgen.kit.roles import COLOURS
from scadgen.kit.solids import REGULAR
from scadgen.kit.store import dumps
from scadgen.plane.catalogue import NAMES

sys.path.append(str(workbench()))
from freecad.scadgen import cells, sense
from freecad.scadgen.faces import newell
from freecad.scadgen.kit_data import KitError, parse_kit, read_kit

KINDS = {"hexagonal": ("hexagonal", "fixed", 0.0), "square": ("square", "loose", 1.5)}


def the(frame):
    return kit(*KINDS[frame])


@pytest.fixture(params=[*KINDS])
def made(request):
    return the(request.param)


def test_plain_python_evaluates_the_same_points(made):
    data = parse_kit(dumps(made))
    for seed in range(3):
        values = random_inside(made, seed)
        for name, solid in made.parts.items():
            found = np.array(data.parts[name].points(values))
            np.testing.assert_allclose(found, solid.points(values), rtol=0, atol=1e-9)


def test_faces_cover_the_surface_and_stay_flat(made):
    data = parse_kit(dumps(made))
    for name, solid in data.parts.items():
        assert sorted(t for face in solid.faces for t in face.triangles) == sorted(solid.triangles)
        assert len(solid.polygons()) < len(solid.triangles)
        for seed in range(3):
            points = solid.points(random_inside(made, seed))
            for face in solid.faces:
                total = sum(np.array(newell(loop, points)) for loop in face.loops)
                whole = sum(np.array(newell(t, points)) for t in face.triangles)
                np.testing.assert_allclose(total, whole, atol=1e-6)
                normal = np.array(newell(face.loops[0], points))
                normal /= np.linalg.norm(normal)
                corners = np.array([points[v] for loop in face.loops for v in loop])
                assert np.abs((corners - corners[0]) @ normal).max() < 1e-6, name


def places(found):
    """The same for the same placements, in whatever order."""
    return Counter((p["part"], p["role"], *map(tuple, (p["at"], p["x"], p["z"]))) for p in found)


TILINGS = [name for name, family in NAMES.items() if "rows" in family.options]


@pytest.mark.parametrize("name", TILINGS)
def test_any_rows_and_columns_stand_where_the_engine_has_them(name):
    made = tiled(name)
    data = parse_kit(dumps(made))
    for rows, columns in ((1, 1), (2, 3), (5, 4)):
        ours = made.cells.laid(rows, columns).placements
        entries = [{"part": p.part, "role": p.role, **pose_entry(p.pose)} for p in ours]
        assert places(data.placements(rows, columns)) == places(entries)
        assert {(p.role, p.part) for p in ours} <= {*data.frame_pieces}


def test_a_frame_without_cells_stands_as_it_is():
    data = parse_kit(dumps(tee()))
    ours = [{"part": p.part, "role": p.role, **pose_entry(p.pose)} for p in tee().placements]
    assert not data.has_cells
    assert places(data.placements(0, 0)) == places(data.placements(9, 9)) == places(ours)


def test_each_kind_of_joint_has_its_pieces():
    made = tiled("4.6.12")
    data = parse_kit(dumps(made))
    for joint in made.joints:
        ours = [{"part": p.part, "role": p.role, **pose_entry(p.pose)} for p in joint.pieces]
        assert places(data.pieces(joint.name)) == places(ours)
    with pytest.raises(KitError, match=r"^joint = 'Z': must be one of 'A', 'B'$"):
        data.pieces("Z")


def test_parts_know_what_they_are_for():
    data = parse_kit(dumps(the("square")))
    assert [data.parts[n].keys for n in ("basic", "one_sided", "two_sided")] == [0, 1, 2]
    assert [data.parts[n].role for n in data.parts][3:] == ["connector", "half", "peg", "tube"]
    second = {n for n, part in parse_kit(dumps(tiled("4.8.8"))).parts.items() if part.is_second}
    assert second == {"half_A1_over"}


def test_values_out_of_range_are_named_with_what_works():
    data = parse_kit(dumps(the("hexagonal")))
    assert data.check(data.values) == []
    high = data.limits("clearance", data.values)[1]
    (said,) = data.check(data.values | {"clearance": 9.0})[:1]
    assert said.startswith(f"clearance = 9 mm: must be 0 to {high:.4g} mm for side = 10 (")
    assert data.check(data.values | {"side": float("nan")}) == [
        "side = nan: must be a finite number of mm"
    ]


def broken(change, made=None):
    document = json.loads(dumps(made or the("hexagonal")))
    change(document)
    return json.dumps(document)


def set_in(*path, value):
    def change(document):
        for step in path[:-1]:
            document = document[step]
        document[path[-1]] = copy.deepcopy(value)

    return change


def drop(*path):
    def change(document):
        for step in path[:-1]:
            document = document[step]
        del document[path[-1]]

    return change


def piece(name, value):
    return set_in("joints", 0, "pieces", 0, name, value=value)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (
            set_in("version", value=4),
            "kit version 4: this reads version 5; make it again with scadgen kit",
        ),
        (set_in("format", value="kit"), "not a kit: format is not scadgen-kit"),
        (drop("ranges"), "not a sound kit: 'ranges' is missing; make it again"),
        (drop("parts"), "not a sound kit: 'parts' is missing"),
        (set_in("name", value="../up"), "name = '../up': must be a name for files"),
        (set_in("values", "clearance", value=99), "clearance = 99 mm: must be 0 to"),
        (set_in("values", "clearance", value="x"), "not a sound kit: "),
        (set_in("values", "clearance", value=float("nan")), "not a sound kit: "),
        (set_in("ranges", value=[]), "no range for side"),
        (
            set_in("parts", "peg", "triangles", 0, value=[0, 0, 0]),
            "part peg: its triangles are not",
        ),
        (
            set_in("parts", "peg", "triangles", 0, value=[0, 1, 99]),
            "part peg: its triangles are not",
        ),
        (set_in("parts", "peg", "triangles", 0, value=[0, 1]), "not a sound kit: "),
        (set_in("parts", "peg", "facets", value=[1]), "part peg: tables of the wrong shape"),
        (set_in("parts", "peg", "points", "side", 0, value=[1]), "part peg: tables of the wrong"),
        (set_in("parts", "peg", "points", value={}), "part peg: tables of the wrong shape"),
        (set_in("parts", "peg", "points", "side", 0, 0, value="x"), "not a sound kit: "),
        (set_in("parts", "peg", "points", "side", 0, 0, value=1e999), "not a finite number"),
        (set_in("parts", "peg", "points", "length", value=[]), "moved by a parameter"),
        (set_in("rows", value="two"), "rows = 'two': must be a whole number from 1 to 100"),
        (set_in("rows", value=0), "rows = 0: must be"),
        (set_in("rows", value=True), "rows = True: must be"),
        (set_in("columns", value=101), "columns = 101: must be"),
        (set_in("columns", value=2.0), "columns = 2.0: must be"),
        (set_in("key", value="glue"), "key = 'glue': must be one of fixed, loose"),
        (set_in("key", value=["fixed"]), "key = ['fixed']: must be text"),
        (set_in("name", value={}), "name = {}: must be a name for files"),
        (set_in("command", value=3), "command = 3: must be text"),
        (set_in("detail", value=None), "detail = None: must be text"),
        (set_in("ranges", 0, "reason", value=3), "reason = 3: must be text"),
        (set_in("values", "girth", value=1.0), "live parameter = 'girth': must be one of side,"),
        (set_in("ranges", 0, "parameter", value="girth"), "live parameter = 'girth': must be"),
        (set_in("values", "side", value="10"), "side = '10': must be a finite number of mm"),
        (set_in("values", "side", value=10**400), "not a sound kit: "),
        (drop("values", "peg_length"), "live parameter peg_length is missing"),
        (drop("parts", "basic"), "there is no part 'basic'"),
        (set_in("parts", "../up", value={}), "name of a part = '../up': must be letters"),
        (set_in("parts", "peg", "role", value="hero"), "role of a part = 'hero': must be one of"),
        (set_in("parts", "peg", "length", value="1"), "length of a part = '1': must be"),
        (set_in("parts", "half", "ends", value=[]), "ends of a part = []: must be"),
        (set_in("parts", "half", "ends", 0, "slot", value="0"), "slot of an end = '0': must be"),
        (set_in("parts", "half", "ends", 0, "over", value=1), "over of an end = 1: must be"),
        (drop("parts", "peg", "ends"), "not a sound kit: 'ends' is missing"),
        (set_in("joints", value=[]), "joints = []: must be at least one"),
        (set_in("joints", 0, "name", value=1), "name of a joint = 1: must be text"),
        (set_in("joints", 0, "connectors", value=[]), "connectors of a joint = []: must be"),
        (set_in("joints", 0, "connectors", 0, value="cog"), "there is no part 'cog'"),
        (drop("joints", 0, "weave"), "not a sound kit: 'weave' is missing"),
        (set_in("joints", 0, "weave", "name", value=1), "name of a weave = 1: must be text"),
        (
            set_in("joints", 0, "weave", "span", value="1"),
            "span of a weave = '1': must be",
        ),
        (drop("joints", 0, "weave", "bend"), "not a sound kit: 'bend' is missing"),
        (piece("part", "cog"), "there is no part 'cog'"),
        (piece("at", [0, 0]), "at = [0, 0]: must be three finite numbers"),
        (piece("at", [0, 0, "x"]), "at = [0, 0, 'x']: must be three finite numbers"),
        (piece("at", [0, 0, 1e999]), "at = [0, 0, inf]: must be three finite numbers"),
        (piece("x", [1, 0]), "x = [1, 0]: must be three finite numbers"),
        (piece("z", [0, 0, 2]), "must be unit vectors, square to each other"),
        (piece("z", [1, 0, 0]), "must be unit vectors, square to each other"),
        (piece("role", "hero"), "role = 'hero': must be one of row, cross, half_a,"),
        (piece("role", "a\nb" * 99), "role = 'a\\nb"),
        (set_in("joints", 0, value=3), "not a sound kit: "),
        (set_in("cells", "across", value=[1]), "across = [1]: must be two finite numbers"),
        (set_in("cells", "up", value=3), "up = 3: must be two finite numbers"),
        (set_in("cells", "drift", value="1"), "drift = '1': must be a finite number of cells"),
        (set_in("cells", "pieces", value=[]), "placements: must be at least one"),
        (drop("cells", "pieces", 0, "any_of"), "not a sound kit: 'any_of' is missing"),
        (set_in("cells", "pieces", 0, "any_of", value=[[0.5, 0]]), "cell in any_of = [0.5, 0]:"),
        (set_in("cells", "pieces", 0, "none_of", value=[[0]]), "cell in none_of = [0]: must be"),
        (set_in("parts", value=3), "not a sound kit: "),
    ],
)
def test_a_broken_kit_is_refused_in_one_line(change, says):
    with pytest.raises(KitError) as refused:
        parse_kit(broken(change))
    assert says in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (set_in("rows", value=2), "rows = 2: must be 0"),
        (set_in("placements", value=[]), "placements: must be at least one"),
        (set_in("placements", 0, "role", value="hero"), "role = 'hero': must be"),
        (set_in("placements", 0, "at", value=3), "at = 3: must be three finite numbers"),
        (drop("placements"), "not a sound kit: 'placements' is missing"),
    ],
)
def test_a_broken_kit_of_another_frame_is_refused_in_one_line(change, says):
    with pytest.raises(KitError) as refused:
        parse_kit(broken(change, tee()))
    assert says in str(refused.value)
    assert "\n" not in str(refused.value)


def test_both_sides_know_the_same_names():
    assert (sense.ROLES, sense.KEYS) == (placement.ROLES, placement.KEYS)
    assert cells.MOST_CELLS == engine_cells.MOST_CELLS
    path = workbench() / "freecad" / "scadgen" / "names.py"
    tables = {
        node.targets[0].id: tuple(key.value for key in node.value.keys)
        for node in ast.parse(path.read_text("utf-8")).body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Dict)
    }
    assert tables["ROLE_LABELS"] == sense.ROLES == tuple(COLOURS)
    assert tables["_REGULAR"] == REGULAR


def test_an_older_kit_names_the_command_that_makes_it_again():
    known, no_command = "scadgen kit square", "a\nb"
    for command, how in ((known, f": {known}"), (no_command, " with scadgen kit")):
        text = json.dumps({"format": "scadgen-kit", "version": 4, "command": command})
        with pytest.raises(KitError) as refused:
            parse_kit(text)
        assert str(refused.value) == f"kit version 4: this reads version 5; make it again{how}"


@pytest.mark.parametrize("text", ["", "{", "[]", "3", None, "[" * 100000])
def test_text_that_is_no_kit_is_refused_in_one_line(text):
    text = dumps(the("hexagonal"))[:-100] if text is None else text
    with pytest.raises(KitError, match=r"^not a (sound )?kit: [^\n]*$"):
        parse_kit(text)


def test_files_that_cannot_be_read_are_named(tmp_path):
    with pytest.raises(KitError, match=r"^.*kit\.json: no kit can be read there \(No such file"):
        read_kit(tmp_path / "kit.json")
    (tmp_path / "kit.json").write_bytes(b"\xff")
    with pytest.raises(KitError, match=r"kit\.json: not a kit: byte 0 is not UTF-8$"):
        read_kit(tmp_path)
    (tmp_path / "kit.json").write_text("{")
    with pytest.raises(KitError, match=r"kit\.json: not a sound kit: truncated or not JSON"):
        read_kit(tmp_path)


def test_a_kit_is_read_from_its_folder(tmp_path):
    (tmp_path / "kit.json").write_text(dumps(the("square")), encoding="utf-8")
    data = read_kit(tmp_path)
    assert (data.name, data.key, data.values) == ("square", "loose", the("square").values)
