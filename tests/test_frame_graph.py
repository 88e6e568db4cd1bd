"""Frames as values: order, angles, and what is no planar frame."""

import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scadgen.errors import InputError, InvariantError
from scadgen.frame.graph import Frame
from scadgen.plane import planarity
from scadgen.plane.drawn import LARGEST, make_frame
from scadgen.plane.planarity import crossings, touches

#: A square with a diagonal, and a mast on its upper right corner.
POINTS = np.array([[0, 0], [10, 0], [10, 10], [0, 10], [10, 30]], dtype=float)
EDGES = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [2, 4]])


@pytest.fixture
def kite():
    return make_frame("kite", POINTS, EDGES)


def test_vertices_ascend_by_y_then_x_and_edges_by_vertex(kite):
    assert kite.plan.tolist() == [[0, 0], [10, 0], [0, 10], [10, 10], [10, 30]]
    assert kite.edges.tolist() == [[0, 1], [0, 2], [0, 3], [1, 3], [2, 3], [3, 4]]


@given(st.permutations(range(5)), st.permutations(range(6)), st.lists(st.booleans(), min_size=6))
def test_the_order_of_the_input_does_not_matter(vertices, edges, turned):
    number = np.argsort(vertices)
    pairs = [number[EDGES[k]][:: -1 if turned[k] else 1] for k in edges]
    assert make_frame("kite", POINTS[list(vertices)], pairs) == make_frame("kite", POINTS, EDGES)


def test_equal_frames_are_one_in_a_set(kite):
    same = make_frame("kite", POINTS, EDGES)
    other = make_frame("other", POINTS, EDGES)
    assert len({kite, same, other}) == 2
    assert kite != "kite"


def test_a_frame_cannot_be_changed(kite):
    with pytest.raises(ValueError, match="read-only"):
        kite.plan[0, 0] = 1.0


def test_degrees_lengths_bounds(kite):
    assert kite.degree.tolist() == [3, 2, 2, 4, 1]
    assert kite.lengths == pytest.approx([10, 10, 10 * 2**0.5, 10, 10, 20])
    assert kite.bounds.tolist() == [[0, 0], [10, 30]]


def test_directions_go_round_and_gaps_sum_to_a_turn(kite):
    assert np.degrees(kite.directions(3)) == pytest.approx([90, 180, 225, 270])
    assert np.degrees(kite.gaps(3)) == pytest.approx([90, 45, 45, 180])
    assert np.degrees(kite.directions(0)) == pytest.approx([0, 45, 90])
    assert np.degrees(kite.gaps(4)) == pytest.approx([360])
    for vertex in range(5):
        assert kite.gaps(vertex).sum() == pytest.approx(2 * np.pi)


def test_a_slot_is_the_place_of_an_edge_among_the_directions(kite):
    for (i, j), slots in zip(kite.edges, kite.slots, strict=True):
        for start, end, slot in ((i, j, slots[0]), (j, i, slots[1])):
            dx, dy = kite.plan[end] - kite.plan[start]
            assert kite.directions(start)[slot] == pytest.approx(np.arctan2(dy, dx) % (2 * np.pi))
    ends = kite.ends
    assert (kite.edges[ends.edge] == ends.neighbour[:, None]).any(axis=1).all()


def test_a_direction_that_rounds_to_a_full_turn_is_zero():
    frame = make_frame("almost level", [[0, 0], [10, -1e-9], [0, 10]], [[0, 1], [0, 2]])
    corner = int(np.flatnonzero(frame.degree == 2)[0])
    assert frame.directions(corner)[0] == 0


def test_components_are_numbered_by_their_first_vertex():
    frame = make_frame("two", [[0, 0], [0, 9], [5, 1], [5, 2]], [[2, 3], [0, 1]])
    assert frame.components.tolist() == [0, 1, 1, 0]


@pytest.mark.parametrize(
    ("points", "edges", "said"),
    [
        ([1, 2], [[0, 1]], r"vertices of shape \(2,\)"),
        ([[0, 0, 0], [1, 0, 0]], [[0, 1]], r"vertices of shape \(2, 3\)"),
        ([[0, 0], [1, np.nan]], [[0, 1]], r"vertex 1 at \(1, nan\): must be within"),
        ([[0, 0], [2 * LARGEST, 0]], [[0, 1]], r"vertex 1 at \(2e\+06, 0\): must be within"),
        ([[0, 0], [1, 0]], [], "edges of shape"),
        ([[0, 0], [1, 0]], [[0, 1, 0]], r"edges of shape \(1, 3\)"),
        ([[0, 0], [1, 0]], [[0.0, 1.0]], "edges of type float64"),
        ([[0, 0], [1, 0]], [[0, 2]], r"edge 0 = \[0, 2\]: vertices go from 0 to 1"),
        ([[0, 0], [1, 0]], [[0, -1]], r"edge 0 = \[0, -1\]"),
        ([[0, 0], [1, 0]], [[0, 1], [1, 1]], r"edge 1 goes from vertex 1 at \(1, 0\) to itself"),
        ([[0, 0], [1, 0]], [[0, 1], [1, 0]], r"edge 1 = \[1, 0\]: the same as edge 0"),
        ([[0, 0], [1, 0], [5, 5]], [[0, 1]], r"vertex 2 at \(5, 5\) has no edge"),
        (
            [[0, 0], [0, 1e-7]],
            [[0, 1]],
            r"edge 0 from vertex 0 at \(0, 0\) to vertex 1 at .* has no length",
        ),
        ([[0, 0], [9, 0], [9, 0], [9, 9]], [[0, 1], [2, 3]], r"at \(9, 0\) lies on vertex 2"),
        (
            [[0, 0], [9, 0], [4, 0], [4, 9]],
            [[0, 1], [2, 3]],
            r"vertex 2 at \(4, 0\) lies on edge 0",
        ),
        (
            [[0, 0], [9, 0], [4, -1], [4, 9]],
            [[0, 1], [2, 3]],
            r"edge 0 and edge 1 cross at \(4, 0\): a",
        ),
        ([[0, 0], [9, 0], [5, 0]], [[0, 1], [0, 2]], r"vertex 2 at \(5, 0\) lies on edge 0"),
    ],
)
def test_what_is_no_planar_frame_is_refused_with_its_place(points, edges, said):
    with pytest.raises(InputError, match=said) as error:
        make_frame("bad", points, edges)
    assert "\n" not in str(error.value)


def test_a_frame_out_of_order_is_a_bug(kite):
    with pytest.raises(InvariantError, match="canonical order"):
        Frame("bad", kite.vertices[::-1], kite.normals, kite.edges, kite.order)


def test_crossings_and_touches_are_found():
    points = np.array([[0, 0], [4, 4], [0, 4], [4, 0], [2, 0.01], [2, -9]])
    edges = np.array([[0, 1], [2, 3], [0, 3], [4, 5]])
    assert crossings(points, edges, 9).tolist() == [[0, 1], [2, 3]]
    assert touches(points, edges, 0.02, 9).tolist() == [[4, 2]]
    assert touches(points, edges, 0.005, 9).tolist() == []


@pytest.mark.parametrize("at_once", [1, 100, 10**6])
def test_the_first_crossings_and_touches_are_found_however_many_there_are(monkeypatch, at_once):
    # Bars at heights 0 to 9, and posts on the lowest one through all the others.
    points = np.array([*([x, y] for y in range(10) for x in (0, 20)), *np.ones((20, 2))])
    points[20:] = [[x, y] for x in range(1, 11) for y in (0, 9.5)]
    edges = np.arange(40).reshape(-1, 2)
    monkeypatch.setattr(planarity, "_AT_ONCE", at_once)
    all_of_them = [[bar, post] for bar in range(10) for post in range(10, 20)]
    assert crossings(points, edges, 100).tolist() == all_of_them
    assert crossings(points, edges, 34).tolist() == all_of_them[:35]
    assert touches(points, edges, 0.1, 10).tolist() == [[20 + 2 * k, 0] for k in range(10)]
    assert touches(points, edges, 0.1, 6).tolist() == [[20 + 2 * k, 0] for k in range(7)]


def test_of_very_many_crossings_and_touches_some_are_counted():
    start = time.process_time()
    ends = np.random.default_rng(1).random((3000, 2)) * 1000
    with pytest.raises(
        InputError, match=r"edge 0 and edge \d+ cross at .* \(and at least 1000 more\)"
    ):
        make_frame("scribble", ends, np.arange(3000).reshape(-1, 2))
    level = np.stack([np.arange(3000.0), np.zeros(3000)], axis=1)
    with pytest.raises(InputError, match=r"vertex 1 at .* lies on edge 0 \(and at least 1000 more"):
        make_frame("stack", level, np.arange(3000).reshape(2, -1).T)
    assert time.process_time() - start < 10.0
