"""Frames from JSON and meshes, and what every reader refuses."""

import json
import math
import os
import re
import time
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.plane.catalogue import NAMES, named
from scadgen.plane.drawn import make_frame
from scadgen.readers.json_frame import dumps
from scadgen.readers.read import READERS, read
from scadgen.readers.reading import Reading, read_regular

TRIANGLE = {"vertices": [[0, 0], [30, 0], [0, 40]], "edges": [[0, 1], [1, 2], [2, 0]]}
CUBE_TOP = "v 0 0 5\nv 2 0 5\nv 2 2 5\nv 0 2 5\n"


def written(folder, name, content):
    path = folder / name
    if isinstance(content, bytes):
        path.write_bytes(content)
    else:
        path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def refusal(path, reading=None):
    with pytest.raises(InputError) as error:
        read(path, reading)
    said = str(error.value)
    assert "\n" not in said
    assert said.startswith(f"{path}: ")
    assert len(said) - len(str(path)) < 300
    return said


@pytest.mark.parametrize("name", NAMES)
def test_a_frame_written_as_json_and_read_back_is_the_same(tmp_path, name):
    frame = named(name)
    assert read(written(tmp_path, "any.json", dumps(frame))).frame == frame


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=25)
@given(st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 2), min_size=2, max_size=8))
def test_any_path_written_and_read_back_is_the_same(tmp_path, points):
    try:
        frame = make_frame("path", points, [[k, k + 1] for k in range(len(points) - 1)])
    except InputError:
        return
    assert read(written(tmp_path, "path.json", dumps(frame))).frame == frame


def test_json_may_have_a_name_and_a_unit(tmp_path):
    frame = read(written(tmp_path, "a.json", TRIANGLE)).frame
    assert frame.name == "a"
    assert sorted(frame.lengths) == pytest.approx([30, 40, 50])
    inches = read(written(tmp_path, "a.json", TRIANGLE | {"unit": "in", "name": "b c"})).frame
    assert inches.name == "b c"
    assert sorted(inches.lengths) == pytest.approx([762, 1016, 1270])
    scaled = read(written(tmp_path, "a.json", TRIANGLE | {"unit": "in"}), Reading(scale=2.0))
    assert sorted(scaled.frame.lengths) == pytest.approx([60, 80, 100])


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"edges": [[0, 1], [1, 1]]}, r"edge 1 goes from vertex 1 at \(30, 0\) to itself"),
        (
            {"vertices": [[0, 0], [0, 0], [0, 40]]},
            r"edge 0 from vertex 0 at \(0, 0\) to vertex 1 at \(0, 0\) has no length",
        ),
        ({"edges": [[0, 1], [1, 0]]}, r"edge 1 = \[1, 0\]: the same as edge 0"),
        ({"edges": [[0, 7]]}, "vertices go from 0 to 2$"),
        ({"vertices": []}, "there are no vertices"),
        ({"vertices": [[0, 0], [1e9, 0], [0, 1]]}, "must be within 1e\\+06 mm of 0$"),
        ({"edges": [[0, 1.5]]}, r"edges\[0\] = \[0, 1.5\]: must be two whole numbers"),
        ({"edges": [[False, True]]}, r"edges\[0\] = \[false, true\]: must be two whole"),
        ({"edges": [[0, 1, 2]]}, r"edges\[0\] = \[0, 1, 2\]: must be two"),
        ({"edges": "all"}, "edges: must be a list of pairs"),
        ({"edges": []}, "at least one edge"),
        ({"edges": [[0, 10**30]]}, r"edge"),
        ({"vertices": [[0, 10**400], [1, 1], [2, 2]]}, r"vertices\[0\]"),
        ({"vertices": [["0", 0], [1, 1], [2, 2]]}, r'vertices\[0\] = \["0", 0\]: must be two num'),
        ({"vertices": [None]}, r"vertices\[0\] = null: must be two numbers"),
        ({"vertices": [[0, 1e999], [1, 1], [2, 2]]}, "Infinity is no number"),
        ({"unit": "furlong"}, "unit 'furlong': must be one of mm, cm, m, in"),
        ({"unit": ["mm"]}, "unit .*: must be one of mm"),
        ({"name": "../../etc"}, "name '../../etc': must be letters"),
        ({"faces": []}, "unknown faces; known are comment, edges, name, unit, vertices"),
        ({"vertices": [[0, 0], [30, 0], [0, 40], [5, 5]]}, r"vertex 3 at \(5, 5\) has no edge"),
        ({"vertices": [[0, 0], [9, 0], [4, -5], [4, 5]], "edges": [[0, 1], [2, 3]]}, "cross"),
    ],
)
def test_json_that_is_no_frame_is_refused(tmp_path, change, said):
    path = written(tmp_path, "bad.json", TRIANGLE | change)
    assert re.search(said, refusal(path))


def test_listed_edges_are_repaired_where_that_is_wanted(tmp_path):
    # Two bars that cross, one of them twice; an end beside another; a vertex that nothing uses.
    vertices = [[0, 0], [10, 0], [5, -5], [5, 5], [10, 0.004], [20, 0], [7, 7]]
    edges = [[0, 1], [2, 3], [1, 0], [4, 5], [3, 3]]
    path = written(tmp_path, "rough.json", {"vertices": vertices, "edges": edges})
    assert refusal(path).endswith(
        "goes from vertex 3 at (5, 5) to itself; --repair mends what it can"
    )
    found = read(path, Reading(repair=True))
    assert found.frame.plan.tolist() == [[5, -5], [0, 0], [5, 0], [10, 0], [20, 0], [5, 5]]
    assert len(found.frame.edges) == 5
    said = "\n".join(found.notes)
    for what in (
        "without an edge left out: 1",
        "crossing split at (5, 0)",
        "without length",
        "merged",
    ):
        assert what in said
    assert "cross at (5, 0)" in refusal(path, Reading(repair=True, split=False))
    bars = written(tmp_path, "a.obj", "v 0 0 0\nv 9 0 0\nv 5 -5 0\nv 5 5 0\nl 1 2\nl 3 4\n")
    assert "--repair mends what it can" in refusal(bars)
    assert len(read(bars, Reading(repair=True)).frame.edges) == 4


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "is empty"),
        (" \n", "is empty"),
        ("{", "is not JSON"),
        ("[1, 2]", 'must be a JSON object with "vertices" and "edges"'),
        ('{"vertices": []}', 'must be a JSON object with "vertices" and "edges"'),
        ('{"vertices": [[NaN, 0]], "edges": []}', "NaN is no number"),
        (b"\xff\xfe\x00\x01\x02", "is not JSON"),
        ("[" * 100_000, "is not JSON"),
        ('{"vertices": ' + "[" * 50_000, "is not JSON"),
        ("<svg/>", "is not JSON"),
    ],
)
def test_what_is_not_json_is_refused(tmp_path, content, said):
    assert said in refusal(written(tmp_path, "bad.json", content))


def test_files_of_no_known_kind_missing_files_and_folders_are_refused(tmp_path):
    assert "must end in .dxf, .json, .obj, .off, .svg" in refusal(tmp_path / "frame.step")
    assert "No such file" in refusal(tmp_path / "frame.json")
    (tmp_path / "folder.svg").mkdir()
    assert "Is a directory" in refusal(tmp_path / "folder.svg")


@pytest.mark.parametrize("kind", READERS)
def test_devices_and_pipes_are_refused_at_once_and_links_to_files_read(tmp_path, kind):
    (tmp_path / f"zero{kind}").symlink_to("/dev/zero")
    os.mkfifo(tmp_path / f"pipe{kind}")
    for name in ("zero", "pipe"):
        said = refusal(tmp_path / f"{name}{kind}")
        assert said.endswith("is a device or a pipe: must be a regular file")
    (tmp_path / f"link{kind}").symlink_to(written(tmp_path, f"empty{kind}", ""))
    assert refusal(tmp_path / f"link{kind}").endswith("is empty")


def test_no_more_is_read_of_a_file_than_it_may_have(tmp_path):
    path = written(tmp_path, "any.json", b"x" * 100)
    assert read_regular(path, 100) == b"x" * 100
    # Nor is memory taken for what it might have.
    assert read_regular(path, 10**20) == b"x" * 100
    with pytest.raises(InputError, match=r"^100 bytes: at most 99, so far$"):
        read_regular(path, 99, ", so far")
    # It says that it has no bytes.
    with pytest.raises(InputError, match=r"^4 bytes: at most 3$"):
        read_regular(Path("/proc/self/status"), 3)


@pytest.mark.parametrize("kind", READERS)
def test_each_reader_refuses_noise_and_the_files_of_the_others(tmp_path, kind):
    others = [b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", b"solid cube\nendsolid", b"\0" * 100, b"OFFSET 3"]
    others += [json.dumps(TRIANGLE).encode()] if kind != ".json" else []
    others += [CUBE_TOP.encode()] if kind != ".obj" else []
    for content in others:
        refusal(written(tmp_path, f"bad{kind}", content), Reading())


def test_large_files_are_refused_unless_allowed(tmp_path):
    vertices = [[k, 0] for k in range(1001)]
    path = written(
        tmp_path, "long.json", {"vertices": vertices, "edges": [[k, k + 1] for k in range(1000)]}
    )
    assert "1001 vertices: at most 1000, unless more are allowed (--most)" in refusal(
        path, Reading(most=1000)
    )
    assert "bytes: at most 5120 for 10 segments" in refusal(path, Reading(most=10))
    assert len(read(path, Reading(most=1001)).frame.edges) == 1000


def test_a_million_vertices_are_refused_before_they_are_read(tmp_path):
    path = tmp_path / "huge.obj"
    path.write_text("v 0.123456 0.123456 0.000000\n" * 2_000_000)
    assert "bytes: at most" in refusal(path)


def test_parts_that_are_not_connected_are_refused_unless_asked_for(tmp_path):
    two = {"vertices": [[0, 0], [9, 0], [0, 5], [9, 5]], "edges": [[0, 1], [2, 3]]}
    path = written(tmp_path, "two.json", two)
    assert refusal(path).endswith(
        "2 parts that are not connected, the smallest of 1 edge between (0, 5) and (9, 5); connect "
        "them, by a larger --tolerance where ends nearly meet, or allow it with --components"
    )
    beside = TRIANGLE | {"vertices": [*TRIANGLE["vertices"], [50, 9], [60, 9], [60, 0], [50, 0]]}
    beside["edges"] = [*TRIANGLE["edges"], [3, 4], [4, 5], [5, 6], [6, 3]]
    said = refusal(written(tmp_path, "beside.json", beside))
    assert "the smallest of 4 edges between (50, 0) and (60, 9); connect them" in said
    assert len(read(path, Reading(components=True)).frame.edges) == 2


#: A square of 90 with a diagonal, in an order that no reader would choose.
CORNERS = [[90, 90], [0, 90], [90, 0], [0, 0]]
SIDES = [[0, 3], [1, 0], [3, 2], [2, 0], [1, 3]]


def test_json_counts_as_the_file_does(tmp_path):
    path = written(tmp_path, "a.json", {"vertices": CORNERS, "edges": SIDES})
    frame = read(path).frame
    for number, (start, end) in enumerate(SIDES):
        said = refusal(path, Reading(shortest=100.0)) if number == 1 else ""
        at = frame.called.edges.tolist().index(number)
        places = frame.plan[frame.edges[at]].tolist()
        assert sorted(places) == sorted([CORNERS[start], CORNERS[end]])
        assert frame.called_edge(at).startswith(f"edge {number} from vertex ")
        for vertex in (start, end):
            x, y = CORNERS[vertex]
            assert f"vertex {vertex} at ({x}, {y})" in frame.called_edge(at)
        assert not said or re.search(r"edge [1-4] from vertex \d .* is 90 mm long", said)
    # What is written is in the order of what was read.
    assert [sorted(pair) for pair in json.loads(dumps(frame))["edges"]] == [
        sorted(pair) for pair in SIDES
    ]
    assert json.loads(dumps(frame))["vertices"] == CORNERS
    assert read(written(tmp_path, "b.json", dumps(frame))).frame == frame


@pytest.mark.parametrize(("kind", "first"), [(".obj", 1), (".off", 0)])
def test_meshes_count_as_the_file_does(tmp_path, kind, first):
    # Two vertices that nothing uses come first, so that all others are counted on.
    points = [[5, 5], [6, 6], *CORNERS]
    rows = [f"{x} {y} 0" for x, y in points]
    faces = [[2, 5, 4], [2, 3, 5]]
    if kind == ".obj":
        text = "".join(f"v {row}\n" for row in rows)
        text += "".join(f"f {' '.join(str(v + 1) for v in face)}\n" for face in faces)
    else:
        text = "\n".join(["OFF", "6 2 0", *rows, *(f"3 {a} {b} {c}" for a, b, c in faces)])
    path = written(tmp_path, f"a{kind}", text)
    frame = read(path).frame
    for at, point in enumerate(frame.plan.tolist()):
        assert frame.called_vertex(at).startswith(f"vertex {points.index(point) + first} at ")
    said = refusal(path, Reading(shortest=91.0))
    number, x, y = map(int, re.search(r"vertex (\d) at \((\d+), (\d+)\)", said).groups())
    assert points[number - first] == [x, y]
    assert "the edge from vertex " in said


def test_drawings_have_places(tmp_path):
    document = ezdxf.new(units=4)
    for start, end in SIDES:
        document.modelspace().add_line(CORNERS[start], CORNERS[end])
    document.saveas(tmp_path / "a.dxf")
    said = refusal(tmp_path / "a.dxf", Reading(shortest=100.0))
    assert re.search(r"the edge from \(\d+, \d+\) to \(\d+, \d+\) is 90 mm long", said)


def test_short_edges_are_refused_with_what_is_missing(tmp_path):
    path = written(tmp_path, "a.json", TRIANGLE)
    read(path, Reading(shortest=30.0))
    assert refusal(path, Reading(shortest=42.0)).endswith(
        "edge 0 from vertex 0 at (0, 0) to vertex 1 at (30, 0) is 30 mm long: at least 42 mm, "
        "12 mm are missing (and 1 more)"
    )


@pytest.mark.parametrize(
    "wrong",
    [
        *({"scale": 0}, {"scale": math.nan}, {"tolerance": 0}, {"flatten": -1}, {"shortest": -1}),
        *({"shortest": math.nan}, {"shortest": math.inf}, {"most": -5}, {"most": 0}),
    ],
)
def test_readings_that_make_no_sense_are_refused(wrong):
    with pytest.raises(InputError, match=f"^{next(iter(wrong))} = .*: must be .*") as error:
        Reading(**wrong)
    assert "\n" not in str(error.value)


def test_obj_gives_the_sides_of_faces_and_lines(tmp_path):
    text = f"# a roof\no top\n{CUBE_TOP}vn 0 0 1\nv 4 2 5\nf 1/1/1 2//1 3 4\nl 3 -1\ns off\n"
    frame = read(written(tmp_path, "a.obj", text)).frame
    assert frame.plan.tolist() == [[0, 0], [2, 0], [0, 2], [2, 2], [4, 2]]
    assert frame.edges.tolist() == [[0, 1], [0, 2], [1, 3], [2, 3], [3, 4]]


def test_a_side_of_two_faces_is_one_edge_and_loose_vertices_are_none(tmp_path):
    text = f"{CUBE_TOP}v 9 9 5\nf 1 2 3\nf 1 3 4\n"
    frame = read(written(tmp_path, "a.obj", text)).frame
    assert (len(frame.vertices), len(frame.edges)) == (4, 5)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.obj", f"{CUBE_TOP}f 1 2 3 4\n"),
        ("a.off", "OFF\n4 1 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 1 2 3\n"),
        ("a.json", json.dumps(TRIANGLE)),
        ("a.svg", '<svg xmlns="http://www.w3.org/2000/svg"><line x2="9"/></svg>'),
    ],
)
def test_a_mark_of_the_byte_order_is_no_part_of_a_file(tmp_path, name, text):
    plain = read(written(tmp_path, name, text)).frame
    assert read(written(tmp_path, name, b"\xef\xbb\xbf" + text.encode())).frame == plain


def test_repairs_are_told_of_files_of_every_kind(tmp_path):
    # Two bars that cross at (5, 0).
    ends = [(0, 0), (9, 0), (5, -5), (5, 5)]
    vertices = "".join(f"{x} {y} 0\n" for x, y in ends)
    lines = "".join(
        f'<line x1="{a}" y1="{b}" x2="{c}" y2="{d}"/>' for (a, b), (c, d) in (ends[:2], ends[2:])
    )
    files = {
        "a.json": {"vertices": ends, "edges": [[0, 1], [2, 3]]},
        "a.obj": "".join(f"v {row}\n" for row in vertices.splitlines()) + "l 1 2\nl 3 4\n",
        "a.off": f"OFF\n6 2 0\n{vertices}0 -9 0\n0 9 0\n3 0 1 4\n3 2 3 5\n",
        "a.svg": f'<svg xmlns="http://www.w3.org/2000/svg">{lines}</svg>',
    }
    document = ezdxf.new(units=4)
    for start, end in (ends[:2], ends[2:]):
        document.modelspace().add_line(start, end)
    document.saveas(tmp_path / "a.dxf")
    for name, content in files.items():
        written(tmp_path, name, content)
    for kind in READERS:
        reading = Reading(scale=1.0, repair=kind in (".json", ".obj", ".off"))
        notes = read(tmp_path / f"a{kind}", reading).notes
        # Faces of OFF have more sides that cross.
        assert [n for n in notes if "split" in n and ("(5, 0)" in n or kind == ".off")], kind
    unknown = written(tmp_path, "b.obj", files["a.obj"] + "curv 0 1 1 2\n")
    notes = read(unknown, Reading(repair=True)).notes
    assert notes == ("left out: 1 curv", "crossing split at (5, 0)")


def test_off_gives_the_sides_of_faces(tmp_path):
    text = "OFF # any\n4 2 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n3 0 1 2\n3 0 2 3 255 0 0\n"
    frame = read(written(tmp_path, "a.off", text)).frame
    assert (len(frame.vertices), len(frame.edges)) == (4, 5)


def test_a_tilted_plane_is_laid_flat_the_shortest_way(tmp_path):
    # A square of side 10, its far side raised by 30 degrees: from above 10 x 8.66.
    rise, run = 10 * math.sin(math.pi / 6), 10 * math.cos(math.pi / 6)
    text = f"v 0 0 0\nv 10 0 0\nv 10 {run} {rise}\nv 0 {run} {rise}\nf 1 2 3 4\n"
    frame = read(written(tmp_path, "a.obj", text)).frame
    assert frame.bounds == pytest.approx(np.array([[0, 0], [10, 10]]))


@pytest.mark.parametrize("tilt", [-89, -60, 60, 89])
def test_a_steep_plane_is_laid_flat_the_shortest_way(tmp_path, tilt):
    # Turned about the x axis; seen from above it is shorter, and not turned over.
    flat = np.array([[0, 0], [10, 0], [7, 4], [0, 12]])
    up = math.radians(tilt)
    lines = [f"v {x} {y * math.cos(up)} {y * math.sin(up)}\n" for x, y in flat.tolist()]
    frame = read(written(tmp_path, "a.obj", "".join([*lines, "f 1 2 3 4\n"]))).frame
    assert frame.plan == pytest.approx(flat, abs=1e-9)


def test_a_plane_of_many_vertices_is_read_in_a_moment(tmp_path):
    corners = "".join(f"v {k % 200} {k // 200} {{z}}\n" for k in range(40_000))
    sides = "".join(f"l {k} {k + 1}\n" for k in range(1, 40_000) if k % 200)
    start = time.process_time()
    for height in ("0", "1e-3"):
        path = written(tmp_path, "a.obj", corners.format(z=height) + sides)
        assert len(read(path, Reading(components=True)).frame.edges) == 200 * 199
    tilted = "".join(f"v {k % 200} {k // 200} {k // 200}\n" for k in range(40_000)) + sides
    frame = read(written(tmp_path, "a.obj", tilted), Reading(components=True)).frame
    assert frame.bounds[1] - frame.bounds[0] == pytest.approx([199, 199 * math.sqrt(2)])
    assert time.process_time() - start < 30.0


def test_a_standing_plane_keeps_its_angles(tmp_path):
    text = "v 0 0 0\nv 10 0 0\nv 10 0 20\nv 0 0 20\nf 1 2 3 4\nl 1 3\n"
    frame = read(written(tmp_path, "a.obj", text)).frame
    assert sorted(frame.lengths) == pytest.approx([10, 10, 20, 20, math.sqrt(500)])


def test_what_is_not_plane_is_refused_with_how_far_off(tmp_path):
    # The best plane through a square with one pair of opposite corners 1 up halves the way.
    text = "v 0 0 0\nv 9 0 1\nv 9 9 0\nv 0 9 1\nf 1 2 3 4\n"
    path = written(tmp_path, "a.obj", text)
    assert "is not plane: a vertex is 0.5 mm off the plane of best fit, at most 0.01" in refusal(
        path
    )
    assert len(read(path, Reading(tolerance=0.6)).frame.edges) == 4


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.obj", "v 0 0\nl 1 1\n", "line 1: must have 3 numbers"),
        ("a.obj", "v 0 0 x\n", "line 1: must have 3 numbers"),
        ("a.obj", "v 0 0 nan\n", "line 1: must have 3 numbers"),
        ("a.obj", f"{CUBE_TOP}f 1 2\n", "line 5: must have 3 vertices or more"),
        ("a.obj", f"{CUBE_TOP}f 1 2 5\n", "line 5: '5' is none of the 4 vertices before it"),
        ("a.obj", f"{CUBE_TOP}f 1 2 0\n", "line 5: '0' is none"),
        ("a.obj", f"{CUBE_TOP}f 1 2 -5\n", "line 5: '-5' is none"),
        ("a.obj", f"{CUBE_TOP}f 1 2 {'9' * 5000}\n", "is none of the 4 vertices"),
        ("a.obj", f"{CUBE_TOP}l 1 1\n", "has no faces and no lines"),
        ("a.obj", CUBE_TOP, "has no faces and no lines"),
        (
            "a.obj",
            f"{CUBE_TOP}v 1 1 5\nf 1 2 3 4\nl 1 5\nl 5 3\nl 2 4\n",
            "vertex 5 at (1, 1) lies on the edge",
        ),
        ("a.off", "PLY\n", "is not OFF"),
        ("a.off", "OFF\nthree 1\n", "line 2: must be the numbers of vertices, faces"),
        ("a.off", "OFF\n3 1 0\n0 0 0\n", "ends after 1 of 3 vertices"),
        ("a.off", "OFF\n999999999 1 0\n", "999999999 vertices or more: at most"),
        (
            "a.off",
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
            "ends after 3 of 3 vertices and 0 of 1 faces",
        ),
        ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "line 6: must have 3 vertices"),
        ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: '3' is none of the 3"),
        ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6: '-1' is none of the 3"),
    ],
)
def test_meshes_that_are_no_frame_are_refused_with_the_line(tmp_path, name, text, said):
    assert said in refusal(written(tmp_path, name, text))


def test_unknown_statements_are_left_out_and_told_or_refused(tmp_path):
    path = written(tmp_path, "a.obj", f"{CUBE_TOP}f 1 2 3\ncurv 0 1 1 2\ncurv 0 1 1 2\n")
    assert read(path).notes == ("left out: 2 curv",)
    assert "2 curv: cannot be part of a frame" in refusal(path, Reading(strict=True))


@pytest.mark.parametrize(
    ("text", "edges", "notes"),
    [
        # A triangle whose last corner is there twice, a face of one line in two, a lone point.
        ("f 1 2 3 3\n", 3, ("line 5: a vertex twice in a row, taken once",)),
        ("f 1 2 2\nf 1 1 1\nl 3 3 4\n", 2, None),
        ("f 1 2 \\\n 3 4\n", 4, ()),
        ("f 1/1/1 2/2/1 \\\n 3//1\n", 3, ()),
        ("l 1 2 3 4 1", 4, ()),
    ],
)
def test_obj_is_read_as_programs_write_it(tmp_path, text, edges, notes):
    found = read(written(tmp_path, "a.obj", CUBE_TOP + text), Reading(components=True))
    assert len(found.frame.edges) == edges
    if notes is None:
        notes = ("lines 5, 6, 7: a vertex twice in a row, taken once",)
    assert found.notes == notes


@pytest.mark.parametrize(
    "text",
    [
        "OFF 4 2 0 0 0 0 2 0 0 2 2 0 0 2 0\n3 0 1 2\n3 0 2 3",
        "OFF\n4 2\n0\n0 0 0 2 0 0\n2 2 0\n0 2\n0 3 0 1 2\n3 0\n2 3\n",
        "COFF\n4 2 0\n0 0 0 255 0 0 255\n2 0 0 1 1 1 1\n2 2 0 1 1 1\n0 2 0\n3 0 1 2\n3 0 2 3 1\n",
        "OFF\n4 2 0\n0 0 0 9 9\n2 0 0 9 9\n2 2 0 9 9\n0 2 0 9 9\n3 0 1 2 9 9\n3 0 2 3\n",
    ],
)
def test_off_is_free_text_but_for_the_ends_of_faces(tmp_path, text):
    frame = read(written(tmp_path, "a.off", text)).frame
    assert frame.plan.tolist() == [[0, 0], [2, 0], [0, 2], [2, 2]]
    assert len(frame.edges) == 5
