"""``scadgen frame`` on named frames and on files as somebody might draw them."""

import json
import math
import re
from pathlib import Path

import kits
import numpy as np
import pytest
from defusedxml import ElementTree
from kits import drawn

from scadgen.cli.frame_report import SIDES
from scadgen.cli.main import cli, main
from scadgen.emit.frame_picture import frame_svg, joint_name
from scadgen.frame.classes import classify
from scadgen.joint.weave import BUILT_IN
from scadgen.kit.build import build
from scadgen.kit.store import load
from scadgen.plane.catalogue import ALIASES, NAMES, OPTIONS, named
from scadgen.plane.drawn import make_frame
from scadgen.readers.read import READERS, read

ROOT = Path(__file__).parent.parent
NET = ROOT / "examples" / "frames" / "net.json"
SVG = "{http://www.w3.org/2000/svg}"

#: A square of 100 mm, a line across that does not quite reach, and one down that goes too far.
SKETCH = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 120" height="120mm"
 fill="none" stroke="black">
<rect x="0" y="0" width="100" height="100"/><path d="M0 50H99.995"/><path d="M50 0V120"/></svg>"""


@pytest.fixture
def run(capsys):
    def run(*words):
        with pytest.raises(SystemExit) as done:
            main(["frame", *map(str, words)])
        out, err = capsys.readouterr()
        return done.value.code, out, err

    return run


@pytest.fixture
def said(run):
    def said(*words, code=0):
        left, out, err = run(*words, "--json")
        assert (left, err) == (code, "")
        return json.loads(out)

    return said


@pytest.fixture
def sketch(tmp_path):
    path = tmp_path / "sketch.svg"
    path.write_text(SKETCH)
    return path


def test_a_ladder_by_hand(said):
    # Four corners, with an edge along x first or second, and the ends of one rung.
    ladder = said("ladder", "--bays", 2, "--width", 30, "--bay-length", 50)
    assert (ladder["vertices"], ladder["edges"], ladder["parts"]) == (6, 7, 1)
    assert ladder["bounds"] == [[0, 0], [100, 30]]
    corner, tee = ladder["kinds_of_joints"]
    assert (corner["name"], corner["count"], corner["angles"]) == ("A", 4, [90, 270])
    assert (tee["name"], tee["count"], tee["angles"]) == ("B", 2, [90, 90, 180])
    assert corner["least_ring_ratio"] == pytest.approx(0.5**0.5 - 0.5, abs=1e-6)
    kinds = [
        (e["length"], e["count"], [f"{end['joint']}{end['edge']}" for end in e["ends"]])
        for e in ladder["kinds_of_edges"]
    ]
    # The rungs at the rim, the rung between, and rails, which are the same to either side of it.
    assert sorted(kinds) == [
        (30, 1, ["B2", "B2"]),
        (30, 2, ["A1", "A1"]),
        (50, 4, ["A1", "B1"]),
    ]
    numbers = [n for e in ladder["kinds_of_edges"] for n in e["edges"]]
    assert sorted(numbers) == list(range(7))


def test_a_side_that_is_too_large_is_told_with_what_is_missing(run, said):
    # R = 1.5: two joints, half a side of tube, and a peg that reaches into it by 0.35 sides are
    # 2 sqrt(3.75) + 0.85 = 4.723 sides, and three clearances of 0.2.
    words = ("ring", "--edge-length", 40, "--ring-ratio", 1.5)
    assert said(*words)["largest_side"] == pytest.approx(39.4 / 4.72298, abs=1e-4)
    assert said(*words, "--side", 8.3)["in_the_way"] == []
    ring = said(*words, "--side", 10, code=1)
    (edge,) = ring["kinds_of_edges"]
    # Pegs are rounded down to 0.1.
    assert 7.73 < edge["missing"] <= 47.83 - 40
    code, out, _ = run(*words, "--side", 10)
    assert code == 1
    short = f"{edge['missing']:.4g}"
    said_so = f", of kind 1 and 40 mm long, is {short} mm too short for its two joints (and 5 more)"
    assert re.search(rf"^edge \d from vertex \d at .*{re.escape(said_so)}$", out, re.MULTILINE)
    assert re.search(r"^kind +count +length.*\n1 +6 +40 ", out, re.MULTILINE)
    assert " (and 5 more)\n" in out
    assert out.endswith("; a side of 8.342 mm or a frame 1.195 times as large would do\n")


def test_a_side_below_those_that_print_is_not_advised(run):
    code, out, _ = run("ring", "--edge-length", 20, "--side", 6)
    assert code == 1
    least = re.search(
        r"too small for sides of 6 mm; sides under 5 mm do not print; with 5 mm a frame "
        r"([\d.]+) times as large would do\n$",
        out,
    )
    assert run("ring", "--edge-length", 20 * float(least[1]), "--side", 5)[0] == 0
    assert run("ring", "--edge-length", 20 * float(least[1]) - 0.1, "--side", 5)[0] == 1


def test_what_is_said_of_a_hexagonal_frame_is_what_its_kit_says(said):
    kit = kits.kit("hexagonal")
    (side,) = (r for r in kit.ranges if r.parameter == "side")
    assert (side.low(kit.values), side.high(kit.values)) == SIDES
    length = next(r for r in kit.ranges if r.parameter == "edge_length")
    least = length.low({**kit.values, "side": 7.0})
    frame = said("hexagonal", "--edge-length", least, "--rows", 3)
    assert {j["ring_ratio"] for j in frame["kinds_of_joints"]} == {BUILT_IN["3-fixed"].ring_ratio}
    assert frame["largest_side"] == pytest.approx(7.0)
    assert said("hexagonal", "--edge-length", least, "--side", 6.99)["in_the_way"] == []
    assert said("hexagonal", "--edge-length", least, "--side", 7.01, code=1)["in_the_way"]


@pytest.mark.parametrize("name", ["hexagonal", "triangular", "cairo"])
def test_what_is_said_of_other_frames_is_what_their_kits_say(name, said, capsys):
    # As large as in examples: no longer the frame of a grid's kit.
    words = (name, "--radius", 100, "--edge-length", 60)
    frame = said(*words)
    largest = frame["largest_side"]
    assert said(*words, "--side", largest)["in_the_way"] == []
    with pytest.raises(SystemExit) as ended:
        main(["kit", *map(str, words), "--side", f"{largest + 0.05}"])
    assert ended.value.code == 2
    refusal = re.search(r" a side of ([\d.]+) mm or a frame ", capsys.readouterr().err)
    assert float(refusal[1]) == pytest.approx(largest, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "side", "given"),
    [("hexagonal", 10, 120), ("hexagonal", 10, None), ("cairo", 6, None), ("3.4.6.4", 5, None)],
)
def test_a_kit_stays_in_its_circle_whatever_the_length_of_its_edges(name, side, given, tmp_path):
    words = [name, "--radius", 250, "--side", side, "--detail", "draft", "--unchecked"]
    words += ["--edge-length", given] if given else []
    with pytest.raises(SystemExit) as ended:
        main(["kit", *map(str, words), "-o", str(tmp_path / "kit")])
    assert ended.value.code == 0
    made = load(tmp_path / "kit")
    # The circle's centre is in the middle of a tile; somewhere the next one would stick out.
    far, shortest = np.linalg.norm(made.frame.plan, axis=1).max(), made.frame.lengths.min()
    assert 250 / 3 < far <= 250 + 1e-6
    assert shortest == pytest.approx(given or side * round(shortest / side))
    assert shortest >= 6 * side - 1e-6


def test_rectangles_in_a_circle_are_as_large_as_is_said(tmp_path):
    size = ["--width", "90", "--height", "120"]
    words = ["rectangular", "--radius", "300", *size, "--detail", "draft", "--unchecked"]
    with pytest.raises(SystemExit) as ended:
        main(["kit", *words, "-o", str(tmp_path / "kit")])
    assert ended.value.code == 0
    graph = load(tmp_path / "kit").frame
    assert np.linalg.norm(graph.plan, axis=1).max() <= 300 + 1e-6
    assert set(graph.lengths.round(6)) == {90, 120}


def test_with_a_side_it_says_how_far_across_joints_are(run, said):
    words = ("ring", "--sides", 4, "--edge-length", 100)
    (joint,) = said(*words, "--ring-ratio", 2.5, "--side", 8)["kinds_of_joints"]
    # From one side of the outer circle, 3 sides from the axis, to the other.
    assert joint["across"] == 48
    assert "across" in run(*words, "--side", 8)[1]
    assert "across" not in run(*words)[1]


def test_rings_are_those_of_the_kit_and_so_are_the_sides_that_fit(said, tmp_path):
    path = tmp_path / "tee.json"
    graph = {"vertices": [[0, 0], [-90, 0], [90, 0], [0, 90]], "edges": [[0, 1], [0, 2], [0, 3]]}
    path.write_text(json.dumps(graph))
    tee, largest = kits.tee(), said(path)["largest_side"]
    kit_rings = {joint.weave["ring_ratio"] for joint in tee.joints}
    assert {joint["ring_ratio"] for joint in said(path)["kinds_of_joints"]} == kit_rings
    graph = read(path).frame
    within = math.floor(1000 * largest) / 1000
    made = build(drawn("tee", graph, values={"side": within}))
    low, _ = kits.bounds(made, "edge_length", made.values)
    # All that is left is what a peg is rounded down by.
    assert 90 - 0.11 < low <= 90


def test_angles_that_no_ring_holds_are_told_and_loose_ends_get_caps(run, said, tmp_path):
    path = tmp_path / "fan.svg"
    # 1 in 20 is 2.862 degrees: R > 1 / (2 sin 1.431) - 1/2 = 19.52; 2 asin(1 / 17) = 6.745.
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 10" width="200mm" height="10mm">'
        '<path fill="none" stroke="black" d="M0 0H200L0 10"/></svg>'
    )
    fan = said(path, "--side", 10, code=1)
    assert fan["largest_side"] is None
    assert fan["in_the_way"][0] == (
        "joint B, the vertex at (200, 10): edges 2.862 degrees apart: must be at least 25, or no "
        "ring is wide enough"
    )
    assert not [line for line in fan["in_the_way"] if "joint A" in line]
    narrow = said(path, "--ring-ratio", 10)["in_the_way"][0]
    assert "over 19.52; at most 10 works, for 5.459 degrees and more" in narrow
    code, out, _ = run(path)
    assert code == 0
    assert out.endswith("cannot be built at any side\n")


def test_edges_that_nearly_lie_on_each_other_are_told(said, tmp_path):
    path = tmp_path / "sliver.json"
    sliver = {"vertices": [[0, 0], [300, 0], [300, 0.05]], "edges": [[0, 1], [1, 2], [2, 0]]}
    path.write_text(json.dumps(sliver))
    assert "at (0, 0): edges 0.009549 degrees apart: " in said(path)["in_the_way"][0]


def test_repairs_of_a_drawing_are_told(said, run, sketch):
    frame = said(sketch)
    assert (frame["vertices"], frame["edges"]) == (10, 13)
    notes = frame["notes"]
    ends, crossings = notes
    assert ends.startswith("3 ends joined to a segment they lie on, up to 0.005 mm off: at ")
    assert "99.995" in ends
    assert crossings == "2 crossings split: at (50, 20), (50, 70)"
    code, out, _ = run(sketch)
    assert code == 0
    for note in notes:
        assert note in out
    assert out.startswith("sketch: ")


def test_snapping_says_what_it_costs(said, run):
    plain = said(NET)
    coarse = said(NET, "--snap-angle", 5, "--snap-length", 5)
    assert plain["snap"] is None
    assert len(coarse["kinds_of_joints"]) < len(plain["kinds_of_joints"]) == 44
    assert 0 < coarse["snap"]["angle_error"] <= 5
    assert 0 < coarse["snap"]["length_error"] <= 5
    assert coarse["snap"]["miss"] >= coarse["snap"]["length_error"]
    assert said(NET, "--snap-length", 5)["snap"]["angle_error"] < 0.006
    assert "snapped: ends miss by up to " in run(NET, "--snap-angle", 5)[1]


def test_a_frame_that_is_written_is_read_again(run, said, tmp_path, sketch):
    path = tmp_path / "frame.json"
    assert run(sketch, "-o", path)[0] == 0
    assert read(path).frame == read(sketch).frame
    assert said(path)["kinds_of_edges"] == said(sketch)["kinds_of_edges"]
    odd = sketch.rename(tmp_path / "my drawing (2), é<&>.svg")
    assert run(odd, "-o", path, "--picture", tmp_path / "odd.svg")[0] == 0
    assert read(path).frame.name == "my drawing _2__ é___"
    ElementTree.parse(tmp_path / "odd.svg")


def test_long_reports_are_cut_and_json_is_not(run, said):
    _, out, _ = run(NET, "--side", 50)
    assert "and 68 more; --json has all" in out
    assert "and 104 more; --json has all" in out
    # Every edge is too short, and one joint has an edge of others within its ring.
    assert len(said(NET, "--side", 50, code=1)["in_the_way"]) == 108 + 1


def test_outlines_are_typed_as_corners(run, said):
    square = said("square", "--edge-length", 20, "--outline", "0,0 100,0 100,60 0,60")
    assert square["bounds"] == [[0, 0], [100, 60]]
    # 5 x 3 squares.
    assert (square["vertices"], square["edges"], square["faces"]) == (24, 38, 15)
    words = ("--edge-length", 20, "--outline", "0,0 119,0 119,79 0,79")
    # Tiles are whole: the rest of the outline stays empty.
    assert said("square", *words)["faces"] == 15
    assert run("square", *words)[1].startswith("square: 24 vertices, 38 edges around 15 faces, ")


def test_the_list_names_all(run, said):
    listed = said("--list")["named"]
    assert [(f["name"], f["text"]) for f in listed] == [(n, f.text) for n, f in NAMES.items()]
    assert {a: f["name"] for f in listed for a in f["other_names"]} == ALIASES
    code, out, _ = run("--list")
    assert code == 0
    for name in (*NAMES, *ALIASES):
        assert re.search(rf"(?<![\w.]){re.escape(name)}(?![\w.])", out), name


def test_the_list_tells_what_options_take(said):
    listed = said("--list")
    for family in listed["named"]:
        assert [*family["about"]] == [*family["options"]] == [*NAMES[family["name"]].options]
    forms = {n: a["form"] for f in listed["named"] for n, a in f["about"].items()}
    assert (forms["rows"], forms["angle"], forms["width"]) == ("N", "DEG", "MM")
    files = {file["ending"]: file["about"] for file in listed["files"]}
    assert [*files] == [*READERS]
    assert files[".svg"]["no_split"] == {
        "form": None,
        "text": "refuse segments that cross instead of splitting them",
    }
    assert set(files[".json"]) >= {"repair", "tolerance", "snap"}
    assert "flatten" not in files[".json"]


def test_options_are_those_of_the_catalogue():
    known = {p.name: p.help for p in cli.commands["frame"].params if p.name in OPTIONS}
    whole = {name: ", with whole tiles" * (name in ("radius", "outline")) for name in OPTIONS}
    assert known == {n: f"Named frames: {text}{whole[n]}." for n, text in OPTIONS.items()}


def test_the_table_of_the_readme_is_the_catalogue():
    head = "| frame | other names |"
    lines = (ROOT / "README.md").read_text().split(head)[1].split("\n\n")[0].splitlines()[2:]
    area = {"rows", "columns", "radius", "outline"}
    table = {}
    for line in lines:
        name, others, text, options = (cell.strip() for cell in line.strip("|").split("|"))
        taken = {o.replace("-", "_") for o in re.findall(r"--([a-z-]+)", options)}
        taken |= area if options.endswith(", area") else set()
        table[name.strip("`")] = (set(re.findall(r"`([^`]+)`", others)), text, taken)
    assert table == {
        name: ({a for a, of in ALIASES.items() if of == name}, f.text, set(f.options))
        for name, f in NAMES.items()
    }


def test_a_picture_has_every_part_in_the_colour_of_its_kind(run, tmp_path):
    path = tmp_path / "picture.svg"
    assert run("3.4.6.4", "--picture", path)[0] == 0
    frame = named("3.4.6.4")
    same = classify(frame)
    assert path.read_text().startswith(frame_svg(frame, same))
    edges, joints = ElementTree.parse(path).getroot().findall(f"{SVG}g")[:2]
    lines = {p.get("stroke"): p.get("d").count("M") for p in edges}
    assert sorted(lines.values()) == sorted(len(e.edges) for e in same.edges)
    discs = {g.get("fill"): len(g.findall(f"{SVG}circle")) for g in joints}
    assert sorted(discs.values()) == sorted(len(j.vertices) for j in same.joints)


def test_a_picture_is_the_frame_to_scale_y_up():
    frame = make_frame("hook", [[0, 0], [0, 300], [40, 300]], [[0, 1], [1, 2]])
    root = ElementTree.fromstring(frame_svg(frame, classify(frame)))
    assert (float(root.get("width")), root.get("viewBox").split()[0]) == (900, "0")
    discs = root.findall(f"{SVG}g")[1].iter(f"{SVG}circle")
    points = np.array(sorted((float(d.get("cx")), -float(d.get("cy"))) for d in discs))
    assert points - points[0] == pytest.approx(np.array([[0, 0], [0, 840], [112, 840]]), abs=0.02)
    assert (-points[:, 1] < float(root.get("height"))).all()


def test_a_picture_has_rings_where_a_drawing_was_repaired_and_what_is_in_the_way(run, tmp_path):
    # Two bars cross in the middle of a page of 100; a third, of 2, is too short for any joint.
    path = tmp_path / "bars.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" width="100mm" '
        'height="100mm"><path fill="none" stroke="#000" d="M0 0L100 100M0 100L100 0V2"/></svg>'
    )
    assert run(path, "--side", 8, "--picture", tmp_path / "p.svg")[0] == 1
    root = ElementTree.parse(tmp_path / "p.svg").getroot()
    titles = [disc.findtext(f"{SVG}title") for disc in root.iter(f"{SVG}circle")]
    assert "joint A, the vertex at (100, 98)" in titles
    groups = {g.findtext(f"{SVG}title"): g for g in root.findall(f"{SVG}g")}

    def places(what):
        return [(float(c.get("cx")), float(c.get("cy"))) for c in groups[what].iter(f"{SVG}circle")]

    assert places("repaired") == [(450, 450)]
    # The bar of 2 goes from 100 to 98, its middle is 99; 8.4 pixels are a millimetre.
    assert [450 + 8.4 * 50, 450 - 8.4 * 49] in [pytest.approx(p) for p in places("in the way")]


def test_names_of_joints_go_on_after_z():
    names = [joint_name(kind) for kind in range(26 * 27)]
    assert names[:2] + names[25:28] + names[-1:] == ["A", "B", "Z", "AA", "AB", "ZZ"]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ((), "FRAME: is missing"),
        (("cairo", "--list"), "--list with FRAME 'cairo': give one of them"),
        (("circle",), "--list shows, or a file that ends in .dxf, .json, .obj, .off, .svg"),
        (("kagomee",), "shows (did you mean kagome?), or a file"),
        (("drawing.svg",), "drawing.svg: cannot be read: No such file"),
        (("ring", "--rows", 2), "frame ring: no option --rows; it has --sides, --edge-length"),
        (("ring", "--scale", 2), "frame ring: no option --scale"),
        ((NET, "--rows", 2), "net.json: no option --rows; it has --scale, --unit"),
        ((NET, "--no-split"), "net.json: --no-split needs --repair"),
        ((NET, "--tolerance", 1), "net.json: --tolerance needs --repair"),
        ((NET, "--most", 10), "at most 10"),
        ((NET, "--scale", 0), "scale = 0.0: must be a positive number"),
        ((NET, "--shortest", 50), "at least 50 mm"),
        (("ring", "--sides", 2), "sides = 2: must be a whole number from 3"),
        (("ring", "--sides", 2.5), "2.5"),
        (("square", "--outline", "0,0 1"), "outline = '0,0 1': must be 3 or more corners such as"),
        (("square", "--outline", "0,0 1,1"), "outline = '0,0 1,1': must be 3 or more corners"),
        (("ring", "--side", 4), "side = 4 mm: must be from 5 to 100"),
        (("ring", "--side", "nan"), "side = nan mm"),
        (("ring", "--ring-ratio", 11), "ring-ratio = 11 sides: must be from 0.8 to 10"),
        (("ring", "--snap-angle", 30), "snap-angle = 30 degrees: must be above 0 and under 30"),
        (("ring", "--snap-length", 0), "snap-length = 0 mm: must be a positive number of mm"),
        (("ring", "-o", "."), "cannot write '.': it is not a file"),
        (("ring", "--picture", "."), "cannot write '.': it is not a file"),
        (("ring", "-o", f"{'x' * 300}.json"), "File name too long"),
        (("ring", "-o", "nowhere/x.json"), "name one in a writable folder"),
        (("ring", "-o", "ring.txt"), "'ring.txt': must end in .json"),
        (("ring", "--picture", "ring.png"), "'ring.png': must end in .svg"),
        (("ring", "-o", "no/ring.json"), "cannot write 'no/ring.json'"),
    ],
)
def test_bad_requests_are_refused_in_a_line(words, reason, run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert reason in err
    assert err.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_kit_is_refused_for_what_frame_says_of_edges_all_but_along_each_other(
    run, capsys, tmp_path
):
    # From (10, 390) one edge goes to (390, 10) and one to (390, 10.02): 0.02 mm at 537 mm.
    path = tmp_path / "sliver.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="400mm" height="400mm" '
        'viewBox="0 0 400 400"><path fill="none" stroke="#000" d="M10 10H390V390H10Z'
        'M10 10L390 389.98M10 10L390 390"/></svg>'
    )
    code, out, _ = run(path, "--side", 10)
    assert code == 1
    said = "edges 0.001508 degrees apart: must be at least 25, or no ring is wide enough"
    assert f"the vertex at (10, 390): {said}" in out
    with pytest.raises(SystemExit):
        main(["kit", str(path), "-o", str(tmp_path / "kit")])
    err = capsys.readouterr().err
    assert "the vertex at (10, 390), angles " in err
    assert f": {said}\n" in err
    assert not (tmp_path / "kit").exists()


CIRCLE = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 400" width="400mm" height="400mm">'
    '<circle cx="200" cy="200" r="{}" fill="none" stroke="#000"/></svg>'
)


@pytest.mark.parametrize(("radius", "side"), [(129, 10), (129, 6), (190, 10), (40, 8)])
def test_curves_have_as_many_segments_as_joints_have_room_for(said, tmp_path, radius, side):
    path = tmp_path / "circle.svg"
    path.write_text(CIRCLE.format(radius))
    fine = said(path, "--side", side, "--flatten", 0.05, code=1)
    assert fine["largest_side"] < side
    # A circle of 40 has no room for joints of 8, however coarse it is: as fine as ever then.
    fits = radius > 100
    found = said(path, "--side", side, code=0 if fits else 1)
    assert any("--flatten" in note for note in found["notes"])
    if not fits:
        assert found["edges"] == fine["edges"]
        return
    assert found["largest_side"] >= side
    assert 4 <= found["edges"] < fine["edges"]
    # A segment more in each quarter would be too many.
    chord = 2 * radius * math.sin(math.pi / (found["edges"] + 4))
    needed = found["kinds_of_edges"][0]["length"] * side / found["largest_side"]
    assert chord < needed


def test_a_kit_of_a_curve_that_is_too_fine_names_what_helps(tmp_path, capsys):
    path = tmp_path / "circle.svg"
    path.write_text(CIRCLE.format(129))
    with pytest.raises(SystemExit):
        main(["kit", str(path), "--flatten", "0.05", "-o", str(tmp_path / "kit")])
    assert (
        "; a larger --flatten makes the segments of its curves longer\n" in capsys.readouterr().err
    )
