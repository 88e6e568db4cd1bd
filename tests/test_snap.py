"""Frames whose vertices are moved a little for fewer kinds of parts."""

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scadgen.cli.main import main
from scadgen.errors import InputError
from scadgen.frame.classes import classify
from scadgen.kit.store import load
from scadgen.plane.catalogue import named
from scadgen.plane.drawn import make_frame
from scadgen.plane.snapping import move_vertices
from scadgen.readers.json_frame import dumps
from scadgen.readers.read import read

#: Frames to jitter and to snap back; edges of 60 mm and more.
FRAMES = {
    "hexagonal": named("hexagonal", edge_length=60, rows=2, columns=2),
    "square": named("square", edge_length=60, rows=2, columns=3),
    "trellis": named("rectangular", width=60, height=90, rows=2, columns=3),
    "3.4.6.4": named("3.4.6.4", edge_length=60, rows=2, columns=2),
    "cairo": named("cairo", edge_length=60, rows=1, columns=2),
}


def kinds(frame):
    """Kinds of joints and of edges."""
    same = classify(frame)
    return len(same.joints), len(same.edges)


def jittered(frame, most, seed):
    """The frame with each vertex moved by up to `most` mm in a random direction."""
    rng = np.random.default_rng(seed)
    far, turn = most * np.sqrt(rng.random(len(frame.vertices))), rng.random(len(frame.vertices))
    by = far[:, None] * np.column_stack([np.cos(2 * np.pi * turn), np.sin(2 * np.pi * turn)])
    return make_frame(frame.name, frame.plan + by, frame.edges)


def moves(old, new):
    """How far each vertex of one frame is from the nearest of the other."""
    return np.linalg.norm(old.plan[:, None] - new.plan, axis=2).min(axis=1)


@settings(max_examples=30)
@given(
    st.sampled_from(sorted(FRAMES)), st.floats(0.1, 3.0), st.floats(0.1, 0.95), st.integers(0, 999)
)
def test_a_jittered_frame_has_the_kinds_of_the_perfect_one_again(name, within, share, seed):
    perfect = FRAMES[name]
    rough = jittered(perfect, share * within, seed)
    found = move_vertices(rough, within)
    assert found.before == kinds(rough)
    assert found.after == kinds(found.frame) == kinds(perfect)
    assert sum(found.before) > sum(found.after)
    # All vertices stand, none of them further off than is allowed, and edges are as they were.
    assert found.frame.plan.shape == rough.plan.shape
    assert moves(rough, found.frame).max() <= found.largest + 1e-6 <= within + 2e-6
    assert 0 < found.mean <= found.largest
    assert len(found.frame.edges) == len(rough.edges)
    # Its edges are a little longer or shorter than the perfect one's: what is nearest.
    assert np.sort(found.frame.lengths) == pytest.approx(np.sort(perfect.lengths), abs=2 * within)


@pytest.mark.parametrize("name", sorted(FRAMES))
def test_a_perfect_frame_stays_as_it_is(name):
    frame = FRAMES[name]
    found = move_vertices(frame, 2.0)
    assert found.frame is frame
    assert (found.largest, found.mean) == (0, 0)
    assert found.before == found.after == kinds(frame)
    assert "nothing to gain" in found.notes[0]


@settings(max_examples=15)
@given(st.floats(0.05, 8.0), st.integers(0, 99))
def test_no_vertex_of_any_frame_moves_further_than_is_allowed(within, seed):
    frame = jittered(named("cairo", edge_length=60, rows=1, columns=1), 0.7, seed)
    found = move_vertices(frame, within)
    assert sum(found.after) <= sum(found.before)
    assert moves(frame, found.frame).max() <= within + 1e-6
    assert (found.frame is frame) == (found.before == found.after)


def test_two_lengths_by_hand():
    # Two squares side by side whose edges are 60 and 61 mm; at 0.5 mm all are of one length.
    points = [(0, 0), (60, 0), (121, 0), (0, 60), (60, 60), (121, 60)]
    edges = [(0, 1), (1, 2), (3, 4), (4, 5), (0, 3), (1, 4), (2, 5)]
    frame = make_frame("pair", points, edges)
    found = move_vertices(frame, 0.6)
    assert found.frame.lengths == pytest.approx(np.full(7, found.frame.lengths[0]), abs=1e-5)
    quarters = np.degrees(found.frame.ends.gap) / 90
    assert quarters == pytest.approx(np.rint(quarters), abs=1e-6)
    assert found.largest <= 0.6
    assert move_vertices(frame, 0.01).frame is frame


def test_edges_stay_as_long_as_they_must():
    rough = jittered(FRAMES["square"], 0.8, 1)
    assert sum(move_vertices(rough, 1.0).after) < sum(move_vertices(rough, 1.0).before)
    found = move_vertices(rough, 1.0, shortest=61.0)
    assert found.frame is rough


@pytest.mark.parametrize("within", [0.0, -1.0, math.nan, math.inf, 15.0])
def test_distances_that_cannot_be_are_refused(within):
    with pytest.raises(InputError, match=r"snap = .*: must be above 0 and under 15, a quarter"):
        move_vertices(FRAMES["hexagonal"], within)


@pytest.fixture
def run(capsys):
    def call(*words):
        with pytest.raises(SystemExit) as ended:
            main([str(word) for word in words])
        said = capsys.readouterr()
        return ended.value.code, said.out, said.err

    return call


def test_scadgen_frame_says_what_is_gained_and_what_it_costs(run, tmp_path):
    rough = jittered(FRAMES["trellis"], 0.8, 5)
    (tmp_path / "rough.json").write_text(dumps(rough))
    words = ("frame", tmp_path / "rough.json", "--snap", 1, "-o", tmp_path / "snapped.json")
    code, out, err = run(*words)
    assert (code, err) == (0, "")
    joints, edges = kinds(FRAMES["trellis"])
    before = " and ".join(map(str, kinds(rough)))
    assert f"snapped by 1 mm: {joints} kinds of joints, {edges} of edges instead of {before}" in out
    assert "snapped by 1 mm: vertices move by up to 0." in out
    assert "snapped by 1 mm: lengths change by up to " in out
    assert kinds(read(tmp_path / "snapped.json").frame) == (joints, edges)
    said = json.loads(run(*words[:4], "--json")[1])
    assert len(said["kinds_of_joints"]) == joints
    assert [note for note in said["notes"] if note.startswith("snapped by 1 mm: vertices move")]


@pytest.mark.parametrize("command", ["frame", "kit"])
@pytest.mark.parametrize("distance", ["0", "-2", "nan", "inf", "30"])
def test_wrong_distances_are_refused_in_a_line(command, distance, run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "trellis.json").write_text(dumps(FRAMES["trellis"]))
    code, out, err = run(command, "trellis.json", f"--snap={distance}")
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert "must be above 0 and under 15, a quarter of the shortest edge" in err
    assert [path.name for path in tmp_path.iterdir()] == ["trellis.json"]


def test_a_kit_of_a_rough_drawing_has_the_parts_of_the_perfect_one(run, tmp_path):
    perfect = named("ring", sides=6, edge_length=90)
    (tmp_path / "rough.json").write_text(dumps(jittered(perfect, 0.5, 3)))
    words = ("kit", tmp_path / "rough.json", "--snap", 1, "--detail", "draft", "--unchecked")
    code, out, _ = run(*words, "-o", tmp_path / "kit")
    assert code == 0
    assert "note: snapped by 1 mm: 1 kind of joints, 1 of edges instead of 6 and 6" in out
    made = load(tmp_path / "kit")
    assert len(made.joints) == 1
    assert "--snap 1.0" in made.command
    # Alternate edges may have their keys at either end, both or none.
    assert len(made.elements) <= 3
