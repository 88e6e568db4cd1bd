"""From loose segments to a frame: each repair by hand, and twice is as good as once."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.plane.catalogue import named
from scadgen.plane.repair import REPAIRS, repair

NONE = dict.fromkeys(REPAIRS, 0)


def segments(frame):
    return frame.plan[frame.edges]


def drawn(result):
    """Edges as pairs of points."""
    return sorted(sorted(map(tuple, pair)) for pair in segments(result.frame).tolist())


def test_ends_that_are_close_are_one_where_most_of_them_are():
    result = repair(
        "corner", [[[0, 0], [10, 0]], [[10, 0], [10, 10]], [[10.004, 0], [20, 5]]], 0.01
    )
    assert drawn(result) == [[(0, 0), (10, 0)], [(10, 0), (10, 10)], [(10, 0), (20, 5)]]
    assert result.counts == NONE | {"merged": 1}
    assert result.notes == ("2 places within 0.01 mm merged at (10, 0)",)


def test_ends_that_are_not_close_stay_apart():
    result = repair("gap", [[[0, 0], [10, 0]], [[10.02, 0], [20, 5]]], 0.01)
    assert len(result.frame.vertices) == 4
    assert result.counts == NONE


def test_crossings_are_split():
    result = repair("cross", [[[0, 0], [10, 10]], [[0, 10], [10, 0]]])
    assert len(result.frame.edges) == 4
    assert [5, 5] in result.frame.plan.tolist()
    assert result.counts == NONE | {"crossings": 1}
    assert result.notes == ("crossing split at (5, 5)",)


def test_crossings_are_refused_where_they_are_not_to_be_split():
    with pytest.raises(
        InputError, match=r"segments cross at \(5, 5\); they must not cross, or be split"
    ):
        repair("cross", [[[0, 0], [10, 10]], [[0, 10], [10, 0]]], split=False)


def test_an_end_on_a_segment_splits_it_whatever_is_asked():
    result = repair("tee", [[[0, 0], [10, 0]], [[4, 0.006], [4, 9]]], 0.01, split=False)
    assert len(result.frame.edges) == 3
    assert result.counts == NONE | {"joined": 1}
    assert result.notes == ("end at (4, 0.006) joined to segment (0, 0) to (10, 0), 0.006 mm off",)


def test_duplicates_and_overlaps_are_dropped():
    result = repair("over", [[[0, 0], [10, 0]], [[10, 0], [0, 0]], [[4, 0], [14, 0]]])
    assert drawn(result) == [[(0, 0), (4, 0)], [(4, 0), (10, 0)], [(10, 0), (14, 0)]]
    assert result.counts == NONE | {"duplicates": 1, "joined": 2, "overlaps": 1}


def test_segments_without_length_are_dropped():
    result = repair("dot", [[[0, 0], [10, 0]], [[3, 3], [3, 3]], [[5, 5], [5.005, 5]]], 0.01)
    assert drawn(result) == [[(0, 0), (10, 0)]]
    assert result.counts == NONE | {"dropped": 2, "merged": 1}


def test_many_lines_through_one_point_meet_in_one_vertex():
    angles = np.radians(np.arange(0, 180, 20))
    arms = 10 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    result = repair("asterisk", np.stack([arms, -arms], axis=1))
    assert len(result.frame.vertices) == 19
    assert len(result.frame.edges) == 18


@pytest.mark.parametrize("name", ["hexagonal", "3.4.6.4", "V3.12.12", "rhombic"])
def test_a_frame_comes_back_as_it_is(name):
    frame = named(name)
    result = repair(name, segments(frame))
    assert result.frame == frame
    assert result.counts == NONE
    assert result.notes == ()


whole = st.integers(0, 6).map(float)
fine = st.floats(0, 6)
points = st.one_of(st.tuples(whole, whole), st.tuples(fine, fine))


@settings(deadline=None, max_examples=150)
@given(st.lists(st.tuples(points, points), min_size=1, max_size=14), st.sampled_from([1e-6, 0.01]))
def test_repairing_twice_is_repairing_once(drawing, tolerance):
    try:
        once = repair("scribble", drawing, tolerance)
    except InputError:
        return  # All of it is shorter than the tolerance.
    twice = repair("scribble", segments(once.frame), tolerance)
    assert twice.frame == once.frame
    assert twice.counts == NONE
    assert sum(once.counts.values()) == len(once.places)
    assert sum(count > 0 for count in once.counts.values()) == len(once.notes)
    assert not any("\n" in note for note in once.notes)


@settings(deadline=None, max_examples=50)
@given(st.lists(st.tuples(points, points), min_size=1, max_size=8), st.randoms())
def test_the_order_of_segments_and_ends_does_not_matter(drawing, random):
    shuffled = [pair[:: random.choice((1, -1))] for pair in drawing]
    random.shuffle(shuffled)
    results = []
    for given_order in (drawing, shuffled):
        try:
            results.append(repair("scribble", given_order).frame)
        except InputError as error:
            results.append(str(error))
    assert results[0] == results[1]


@pytest.mark.parametrize(
    ("given_segments", "options", "said"),
    [
        ([], {}, r"segments of shape \(0,\)"),
        ([[0, 0], [1, 1]], {}, r"segments of shape \(2, 2\)"),
        ([[[0, 0], [np.inf, 0]]], {}, r"segment 0, \(0, 0\) to \(inf, 0\): must be within"),
        ([[[0, 0], [1, 0]]], {"tolerance": 1e-7}, "tolerance = 1e-07: must be at least 1e-06"),
        ([[[0, 0], [1, 0]]], {"tolerance": np.nan}, "tolerance = nan"),
        ([[[0, 0], [1, 0]]], {"tolerance": 2.0}, "nothing is longer than the tolerance of 2 mm"),
        (
            [[[0, 0], [1, 0]]] * 11,
            {"most": 10},
            "11 segments: at most 10, unless .*--most",
        ),
        ([[[k, 0], [k + 1, 0]] for k in range(20)], {"tolerance": 1.0}, r"21 places near .* 19 mm"),
    ],
)
def test_what_cannot_be_repaired_is_refused_in_one_line(given_segments, options, said):
    with pytest.raises(InputError, match=said) as error:
        repair("bad", given_segments, **options)
    assert "\n" not in str(error.value)


def test_pieces_count_too():
    grid = [[[k, -1], [k, 10]] for k in range(10)] + [[[-1, k], [10, k]] for k in range(10)]
    assert len(repair("grid", grid, most=220).frame.edges) == 220
    with pytest.raises(
        InputError, match=r"^more than 219 segments once 20 are split where they cross, unless .*--"
    ):
        repair("grid", grid, most=219)
    bars = [[[k, 0], [k + 10, 0]] for k in range(10)]
    assert len(repair("stack", bars, most=100).frame.edges) == 19
    with pytest.raises(InputError, match="more than 99 segments once 10 are split where ends lie"):
        repair("stack", bars, most=99)


@pytest.mark.parametrize(
    ("spread", "options", "said"),
    [
        ([1000, 1000], {}, r"more than 100000 segments once \d+ are split where they cross"),
        ([1000, 1000], {"split": False}, r"segments cross at .* \(and at least 1000 more\);"),
        ([1000, 0], {}, r"more than 100000 segments once \d+ are split where ends lie on them"),
        ([0.005, 0.005], {}, "places near .* are within the tolerance of 0.01 mm of each other"),
    ],
)
def test_what_would_be_very_many_pieces_is_refused_before_they_are_made(spread, options, said):
    ends = np.random.default_rng(1).random((2500, 2, 2)) * spread
    start = time.process_time()
    with pytest.raises(InputError, match=said):
        repair("scribble", ends, **options)
    assert time.process_time() - start < 10.0


def test_thirty_thousand_segments_take_a_moment():
    frame = named("hexagonal", rows=100, columns=100)
    start = time.process_time()
    repair("hexagonal", segments(frame))
    assert time.process_time() - start < 5.0
