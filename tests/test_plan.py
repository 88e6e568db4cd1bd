"""Plans: every step is replayed against all that is there, by code of the tests' own."""

import itertools
import json
import math
import re
import xml.etree.ElementTree as ET
from collections import Counter
from dataclasses import replace
from importlib import resources

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from kits import grid, kit, proved_kit, tee
from manifold3d import Manifold, Mesh64, OpType
from scipy.spatial.transform import Rotation
from shared import once

from scadgen.check.proof import proved
from scadgen.cli.main import main
from scadgen.errors import InputError
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.escape import Attempts
from scadgen.interlock.path import Path
from scadgen.joint.weave import BUILT_IN
from scadgen.kit.build import build, laid_out
from scadgen.kit.store import dumps as kit_text
from scadgen.plan import order, search
from scadgen.plan.as_json import dumps, plan_entry
from scadgen.plan.order import make_plan
from scadgen.plan.pegs import count_pegs
from scadgen.plan.picture import step_pictures
from scadgen.plan.proof import Prover
from scadgen.plan.rows import Rows
from scadgen.plan.standing import stand
from scadgen.plan.touching import Touching
from scadgen.plan.whole import whole_frame
from scadgen.solid.pose import Pose

SVG = "{http://www.w3.org/2000/svg}"

#: Frames that are planned: name, key, rows, columns.
FRAMES = [("hexagonal", "fixed", 1, 1), ("square", "fixed", 1, 1), ("square", "loose", 1, 1)]
every = pytest.mark.parametrize("frame", FRAMES, ids=lambda f: "-".join(map(str, f)))

#: One that is no grid: three edges at a joint.
TEE = ("tee", "loose", 0, 0)
also_tee = pytest.mark.parametrize("frame", [*FRAMES, TEE], ids=lambda f: "-".join(map(str, f)))


def checked(frame):
    """A proved kit of a frame."""
    name, key, rows, columns = frame
    if frame == TEE:
        return once("proved-tee", lambda _: proved(tee()))
    made = (
        proved_kit(name)
        if key == "fixed"
        else once(f"proved-{name}-{key}", lambda _: proved(kit(name, key)))
    )
    return laid_out(made, rows, columns)


def planned(frame):
    name = "-".join(map(str, frame))
    return once(f"plan-{name}", lambda _: make_plan(checked(frame)))


def told(frame):
    plan, name = planned(frame), "-".join(map(str, frame))
    return once(
        f"told-{name}", lambda _: json.loads(dumps(plan_entry(plan, whole_frame(plan.standing))))
    )


def backwards(entry):
    """Moves of the frame being taken apart, each with what it leaves behind.

    Those of a step leave each other behind as well.
    """
    tables = [set(range(len(entry["parts"])))]
    for step in reversed(entry["steps"]):
        rest = [next(t for t in tables if {*move["parts"]} <= t) for move in step["moves"]]
        pairs = list(zip(step["moves"], rest, strict=True))
        yield from [(step, move, sorted(table - {*move["parts"]})) for move, table in pairs]
        for move, table in pairs:
            table -= {*move["parts"]}
            tables.append({*move["parts"]})
    assert all(len(table) == 1 for table in tables if table)


def corners(made, part):
    """Corners of a part of the frame where it stands."""
    place = made.placements[part]
    axes = np.array([place.pose.x, np.cross(place.pose.z, place.pose.x), place.pose.z])
    points = made.parts[place.part].points(made.values) @ axes
    return points + made.values["edge_length"] * np.array(place.pose.at)


def solid(made, part):
    """A part of the frame as manifold3d takes it, where it stands."""
    triangles = made.parts[made.placements[part].part].triangles
    return Manifold(Mesh64(corners(made, part), triangles.astype(np.uint64)))


def poses(entry, move, step=1.0):
    """Poses in the frame, so many that no point within 150 mm moves farther than a step."""
    way = entry["ways"][move["way"]]
    middle, keys = np.array(way["middle_mm"]), np.array(way["steps"])
    axes = np.array([move["x"], np.cross(move["z"], move["x"]), move["z"]])
    spin = Rotation.from_matrix(axes.T)
    origin = np.array(move["at_mm"])
    for one, other in itertools.pairwise(keys):
        first, last = Rotation.from_rotvec(one[3:]), Rotation.from_rotvec(other[3:])
        turning = (first.inv() * last).as_rotvec()
        far = np.linalg.norm(other[:3] - one[:3]) + 150 * np.linalg.norm(turning)
        for share in np.linspace(0, 1, max(2, math.ceil(far / step))):
            turn = first * Rotation.from_rotvec(share * turning)
            centre = middle + one[:3] + share * (other[:3] - one[:3])
            whole = spin * turn * spin.inv()
            # x in the frame goes to the way's own coordinates, along it, and back.
            away = spin.apply(centre) + origin - whole.apply(spin.apply(middle) + origin)
            yield np.hstack([whole.as_matrix(), away[:, None]])


def collides(entry, made, move, rest):
    """Volume that a move shares with the rest on its way, in mm3; and whether it gets out."""
    body = Manifold.batch_boolean([solid(made, n) for n in move["parts"]], OpType.Add)
    others = Manifold.batch_boolean([solid(made, n) for n in rest], OpType.Add)
    way = list(poses(entry, move))
    worst = max((body.transform(pose) ^ others).volume() for pose in way)
    apart = (body.hull().transform(way[-1]) ^ others.hull()).volume() <= 0
    return worst, apart


@also_tee
def test_every_step_is_proved_and_every_part_goes_in_once(frame):
    entry = told(frame)
    assert entry["proved"]
    alone = Counter(
        m["parts"][0] for s in entry["steps"] for m in s["moves"] if len(m["parts"]) == 1
    )
    assert set(alone.values()) == {1}
    assert set(alone) < set(range(len(entry["parts"])))
    assert len(list(backwards(entry))) == sum(len(s["moves"]) for s in entry["steps"])


@also_tee
def test_ways_are_free_when_they_are_replayed(frame):
    entry, made = told(frame), checked(frame)
    seen = set()
    for step, move, rest in backwards(entry):
        what = step["what"], move["way"], len(move["parts"])
        if what not in seen:
            seen.add(what)
            assert collides(entry, made, move, rest) == (0, True), (step["text"], move)
    assert {what for what, *_ in seen} == {step["what"] for step in entry["steps"]}


def test_hexagons_need_no_loose_peg_and_rows_go_on_as_one():
    plan = planned(FRAMES[0])
    pegs = count_pegs(plan.standing)
    assert (pegs.loose, pegs.least) == (0, 0)
    *_, row = plan.steps
    assert row.what == "rows"
    (move,) = row.moves
    # The upper half of a hexagon: three joints, the middle one with a peg at the rim.
    roles = Counter(plan.standing.kit.placements[part].role for part in move.parts)
    assert roles == {"row": 2, "cap": 2, "half_a": 3, "half_b": 3, "peg": 1}
    assert move.origin.degrees == pytest.approx(90)


def test_a_part_from_the_middle_does_not_come_out_before_its_turn():
    frame = FRAMES[0]
    entry, made, plan = told(frame), checked(frame), planned(frame)
    elements = [m for step in plan.steps if step.what == "connectors" for m in step.moves]
    move = next(m for m in elements if made.placements[m.parts[0]].part == "basic")
    everything = range(len(made.placements))
    path = plan.ways[move.way]
    found = Prover(plan.standing).proved(path, move.parts, everything, move.origin)
    assert found.blocking is not None
    told_moves = [m for s in entry["steps"] if s["what"] == "connectors" for m in s["moves"]]
    same = next(m for m in told_moves if m["parts"] == list(move.parts))
    rest = sorted(set(everything) - set(move.parts))
    assert collides(entry, made, same, rest)[0] > 1


def test_rows_do_not_slide_the_other_way():
    plan = planned(FRAMES[0])
    (move,) = plan.steps[-1].moves
    path, everything = plan.ways[move.way], range(len(plan.standing.kit.placements))
    found = Prover(plan.standing).proved(
        path, move.parts, everything, move.origin @ Pose.flat((0, 0), 180.0)
    )
    assert found.blocking is not None


def real_contacts(made):
    """All contacts of a frame's parts where they stand."""
    values = {**made.values, "clearance": 0.0, "peg_clearance": 0.0}
    tight = replace(made, values=values)
    parts = enumerate(made.placements)
    meshes = [(corners(tight, n), made.parts[place.part].triangles) for n, place in parts]
    return find_contacts(meshes, 1e-4)


@pytest.mark.parametrize("which", [Touching.all, Touching.extreme, Touching.directions])
def test_contacts_of_the_frame_are_those_of_its_parts(which):
    made = checked(FRAMES[0])
    real, ours = real_contacts(made), which(Touching(stand(made)))
    pairs = [{(min(p), max(p)) for p in zip(c.first, c.second, strict=True)} for c in (real, ours)]
    assert pairs[0] == pairs[1]


@every
def test_the_finished_frame_holds_unless_pegs_slide(frame):
    standing = stand(checked(frame))
    whole = whole_frame(standing)
    assert whole.held
    assert whole.moves == "rows"
    alone = {one.parts[0] for one in whole.loose if len(one.parts) == 1}
    assert alone == {n for n, p in enumerate(standing.kit.placements) if p.role == "peg"}
    rows = [one for one in whole.loose if len(one.parts) > 1]
    assert {tuple(np.round(one.way, 6) + 0.0) for one in rows} == {(0, 1, 0), (0, -1, 0)}


@also_tee
def test_what_can_move_is_in_the_way_of_no_contact_at_all(frame):
    made = checked(frame)
    contacts = real_contacts(made)
    for one in whole_frame(stand(made)).loose:
        inside = [np.isin(part, one.parts) for part in (contacts.first, contacts.second)]
        across = inside[0] != inside[1]
        away = np.where(inside[1], 1.0, -1.0) * (contacts.normals @ np.array(one.way))
        assert across.any()
        assert away[across].min() > -1e-6


def test_with_pegs_that_are_too_small_halves_move():
    made = checked(FRAMES[2])
    peg = made.parts["peg"]
    small = replace(peg, coefficients={k: 0.5 * v for k, v in peg.coefficients.items()})
    whole = whole_frame(stand(replace(made, parts={**made.parts, "peg": small})))
    assert not whole.held
    moving = {made.placements[n].role for n in whole.loose[-1].parts}
    assert moving & {"half_a", "half_b"}


def test_rows_slide_until_a_plane_is_between_however_wide_the_rings_are():
    wide = build(
        grid("hexagonal", detail="draft", weave=replace(BUILT_IN["3-fixed"], ring_ratio=6))
    )
    made = laid_out(wide, 2, 1)
    everything = set(range(len(made.placements)))
    for choice in next(Rows(stand(made)).choices()):
        way = np.array(choice.origin.x)
        near = [corners(made, n) @ way for n in everything - choice.parts]
        gone = [corners(made, n) @ way + choice.path.poses[-1][0, 3] for n in choice.parts]
        assert min(map(min, gone)) > max(map(max, near))


@also_tee
def test_ways_are_written_as_they_are_proved(frame):
    plan, entry = planned(frame), told(frame)
    for way, written in zip(plan.ways, entry["ways"], strict=True):
        again = Path.through(np.array(written["steps"]), np.array(written["middle_mm"]))
        assert again.poses == pytest.approx(way.poses, rel=0, abs=1e-12)
        assert again.middle.tolist() == way.middle.tolist()


def pages(frame):
    """The pictures of a plan, by step."""
    pictures = once(f"pictures-{frame[0]}-{frame[1]}", lambda _: step_pictures(planned(frame)))
    return {
        int(name[5:7]): ET.fromstring(text)  # noqa: S314
        for name, text in pictures.items()
    }


def of_class(page, name):
    """Elements of a picture of some class, but those of its legend."""
    *_, drawing, _legend = page.findall(f"{SVG}g")
    return [e for e in drawing.iter() if name in e.get("class", "").split()]


def names_of(entry, step):
    """What a step's picture has to name: what goes in, and first of all what is laid out."""
    moved = [move["parts"] for move in step["moves"]]
    alone = {m["parts"][0] for s in entry["steps"] for m in s["moves"] if len(m["parts"]) == 1}
    laid = set(range(len(entry["parts"]))) - alone if step["step"] == 1 else set()
    single = [*laid, *(part for parts in moved if len(parts) <= 4 for part in parts)]
    sets = [f"{len(parts)} parts as one" for parts in moved if len(parts) > 4]
    return Counter([*(entry["parts"][part]["part"] for part in single), *sets])


@also_tee
def test_pictures_name_what_goes_in_as_its_files_are_named(frame):
    entry = told(frame)
    for step in entry["steps"]:
        page = pages(frame)[step["step"]]
        assert Counter(e.text for e in of_class(page, "name")) == names_of(entry, step)
        # Each has its ground below it, and is read where strokes are painted above letters.
        marks = [e for e in page.iter(f"{SVG}text") if e.get("class") in ("halo", "name")]
        places = [(e.text, e.get("x"), e.get("y")) for e in marks]
        assert [e.get("class") for e in marks] == ["halo", "name"] * (len(marks) // 2)
        assert places[::2] == places[1::2]
        assert "paint-order" not in page.findtext(f"{SVG}style")
        drawn = [len(group) for look in ("new", "set") for group in of_class(page, look)]
        assert sum(drawn) == sum(len(move["parts"]) for move in step["moves"])
    assert len(list(page.iter(f"{SVG}use"))) == len(entry["parts"])


@also_tee
def test_pictures_and_words_have_the_same_joints_and_steps(frame):
    entry = told(frame)
    for step in entry["steps"]:
        page = pages(frame)[step["step"]]
        *_, drawing, _ = page.findall(f"{SVG}g")
        marks = list(drawing)
        busy = {int(marks[n + 1].text) for n, e in enumerate(marks) if e.get("class") == "busy"}
        assert busy == {joint for move in step["moves"] for joint in move["joints"]}
        title = " ".join(e.text for e in page.findall(f"{SVG}g")[0])
        assert title.startswith(f"Step {step['step']} of {len(entry['steps'])}: ")
        assert step["text"] in title or title.endswith("as named below")


@also_tee
def test_pictures_explain_their_marks_and_no_others(frame):
    entry = told(frame)
    for step in entry["steps"]:
        page = pages(frame)[step["step"]]
        legend = " ".join(e.text for e in page.findall(f"{SVG}g")[-1].iter(f"{SVG}text"))
        moves = step["moves"]
        assert ("from above" in legend) == any(m["from"] == "above" for m in moves)
        assert ("from below" in legend) == any(m["from"] == "below" for m in moves)
        along = any(m["towards_deg"] is not None for m in moves)
        assert ("along the frame" in legend) == along
        assert bool(of_class(page, "arrow")) == along
        assert ("as one" in legend) == any(len(m["parts"]) > 1 for m in moves)


@also_tee
def test_pictures_are_as_large_as_what_they_show(frame):
    for page in pages(frame).values():
        _, _, wide, high = map(float, page.get("viewBox").split())
        at = [
            [float(x) for x in e.get("transform").split("(")[1].split(")")[0].split()]
            for e in page.iter(f"{SVG}use")
        ]
        joints = (e for look in ("busy", "joint") for e in of_class(page, look))
        at += [[float(e.get("cx")), float(e.get("cy"))] for e in joints]
        low, top = np.min(at, axis=0)
        right, bottom = np.max(at, axis=0)
        assert low > 0 < top
        assert right < wide
        assert bottom < high
        assert high < bottom - top + 350


@also_tee
def test_how_parts_go_in_is_how_their_ways_end(frame):
    entry = told(frame)
    for step in entry["steps"]:
        for move in step["moves"]:
            _, _, rise = entry["ways"][move["way"]]["steps"][-1][:3]
            assert move["from"] == ("plane" if abs(rise) < 5 else "above" if rise > 0 else "below")
            if step["what"] == "pegs":  # along its edge, out of the ring or into it
                x, y, _ = entry["parts"][move["parts"][0]]["x"]
                off = (move["towards_deg"] - math.degrees(math.atan2(y, x))) % 180
                assert min(off, 180 - off) < 1


@also_tee
def test_what_can_move_is_told_once_with_its_joints(frame):
    entry = told(frame)
    movable = entry["finished"]["movable"]
    assert len(set(movable)) == len(movable)
    assert all("joint" in words for words in movable)
    (pegs,) = [words for words in movable if "its edge" in words]
    count = sum(len(one["parts"]) == 1 for one in entry["finished"]["loose"])
    assert pegs.startswith(f"{count} x peg, each along its edge, at ")
    texts = [entry["finished"]["text"], *movable, *(step["text"] for step in entry["steps"])]
    assert not any(re.search(r" mm|\b1 x ", text) for text in texts)


def test_loose_pegs_are_as_many_as_joints():
    pegs = count_pegs(stand(checked(FRAMES[2])))
    assert (pegs.loose, pegs.least, pegs.fixed, pegs.rim) == (4, 4, 0, 0)


@pytest.fixture
def run(capsys):
    """Run the command in this process; its status, and what it said on stdout and stderr."""

    def call(*words):
        with pytest.raises(SystemExit) as ended:
            main(["plan", *map(str, words)])
        said = capsys.readouterr()
        return ended.value.code, said.out, said.err

    return call


@pytest.fixture
def folder(tmp_path):
    """A folder with a small kit."""
    place = tmp_path / "kit"
    place.mkdir()
    small = laid_out(proved_kit("hexagonal"), 1, 1)
    (place / "kit.json").write_text(kit_text(small), encoding="utf-8")
    return place


def test_the_command_writes_json_text_and_pictures(run, folder, tmp_path, monkeypatch):
    code, out, err = run(folder)
    assert (code, err) == (0, "")
    plan = folder / "plan"
    assert out.startswith((plan / "plan.txt").read_text(encoding="utf-8"))
    entry = json.loads((plan / "plan.json").read_text(encoding="utf-8"))
    schema = resources.files("scadgen.plan").joinpath("plan.schema.json").read_text("utf-8")
    Draft202012Validator(json.loads(schema)).validate(entry)
    assert {p.name for p in plan.iterdir()} == {
        "plan.json",
        "plan.txt",
        *(step["picture"] for step in entry["steps"]),
    }
    words = " ".join(out.split())
    for number, step in enumerate(entry["steps"], 1):
        assert f"{number}. {step['text']} " in words
        page = ET.fromstring((plan / step["picture"]).read_text(encoding="utf-8"))  # noqa: S314
        assert page.tag.endswith("svg")
    # The same plan as was made before, of the same kit.
    before = json.loads(dumps(told(FRAMES[0])))
    for step in before["steps"]:
        step["picture"] = f"plan-{step['step']:02d}.svg"
    assert entry == before
    monkeypatch.setattr(order, "make_plan", lambda *_: planned(FRAMES[0]))
    again = tmp_path / "again"
    code, said, _ = run(folder, "-o", again, "--json")
    assert code == 0
    assert said == (again / "plan.json").read_text(encoding="utf-8")
    assert json.loads(said) == entry


def test_a_step_that_is_not_proved_is_told_with_its_joint(run, folder, monkeypatch):
    monkeypatch.setattr(search, "escape", lambda *_, **__: Attempts(1, 1, 0.0, 0.0, finished=True))
    text = (folder / "kit.json").read_text(encoding="utf-8")
    document = json.loads(text)
    (way,) = [w for w in document["joints"][0]["ways"] if w["name"].startswith("the peg")]
    way["steps"] = [[0.0] * 6, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]  # up through the halves
    (folder / "kit.json").write_text(json.dumps(document), encoding="utf-8")
    code, out, _ = run(folder)
    assert code == 1
    assert "NOT ALL PROVED" in out
    assert "not proved: joint 1: no way is proved past half at" in out


def refusals(place):
    """Wrong requests, and what is said of each."""
    (place / "broken").mkdir()
    (place / "broken" / "kit.json").write_text('{"format": "scadgen-kit"', encoding="utf-8")
    (place / "unchecked").mkdir()
    (place / "unchecked" / "kit.json").write_text(kit_text(kit("hexagonal")), encoding="utf-8")
    return {
        "missing": "no kit can be read there",
        "broken": "not a sound kit",
        "unchecked": "make it again without --unchecked",
    }


@pytest.mark.parametrize("name", ["missing", "broken", "unchecked"])
def test_bad_kits_are_refused_in_one_line(run, tmp_path, name):
    words = refusals(tmp_path)[name]
    code, out, err = run(tmp_path / name, "-o", tmp_path / "plan")
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert words in err
    assert not (tmp_path / "plan").exists()


def test_a_folder_with_other_things_is_left_alone(run, folder, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    (other / "mine.txt").write_text("mine", encoding="utf-8")
    code, out, err = run(folder, "-o", other)
    assert (code, out) == (2, "")
    assert "it holds other things" in err
    assert [p.name for p in other.iterdir()] == ["mine.txt"]
    code, _, err = run(folder, "-o", other / "mine.txt")
    assert code == 2
    assert "it is a file" in err


def test_a_kit_without_a_frame_has_no_plan():
    single = replace(checked(FRAMES[0]), placements=())
    with pytest.raises(InputError, match="nothing to plan"):
        make_plan(single)
