"""Which joints and edges are the same part: truths by hand, and what must not matter."""

import math
import time
from collections import defaultdict

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from scadgen.errors import InputError
from scadgen.frame.classes import classify, group_values, snap
from scadgen.plane.catalogue import NAMES, named
from scadgen.plane.drawn import make_frame


def star(*gaps):
    """Arms with these angles between them, in degrees; the first one along x."""
    angles = np.radians(np.cumsum([0, *gaps[:-1]]))
    tips = 10 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    edges = [[0, k + 1] for k in range(len(gaps))]
    return np.vstack([[[0, 0]], tips]), np.array(edges)


def together(*parts):
    """Several graphs side by side as one frame."""
    points, edges, count = [], [], 0
    for n, (p, e) in enumerate(parts):
        points.append(p + np.array([5000.0 * n, 0.0]))
        edges.append(e + count)
        count += len(p)
    return make_frame("together", np.vstack(points), np.vstack(edges))


def mirrored(frame):
    return frame.plan * [-1, 1], frame.edges


def partition(labels):
    groups = defaultdict(set)
    for element, label in enumerate(labels.tolist()):
        groups[label].add(element)
    return {frozenset(group) for group in groups.values()}


def classes(same, degree):
    return [joint for joint in same.joints if len(joint.directions) == degree]


def test_hexagonal_has_one_inner_joint_in_two_orientations():
    same = classify(named("hexagonal", rows=4, columns=4))
    (inner,) = classes(same, 3)
    assert inner.symmetry.turns == 3
    assert np.degrees(inner.directions) == pytest.approx([0, 120, 240], abs=1e-9)
    turns = np.degrees(same.turn[inner.vertices])
    assert sorted(set(turns.round(6))) == [30, 90]
    # At the rim one joint of two edges, which a half turn swaps.  Edges: inside; from inside to a
    # rim joint; and between two rim joints.
    assert len(same.joints) == 2
    assert len(same.edges) == 3


def test_square_has_an_inner_a_side_and_a_corner_joint():
    same = classify(named("square", rows=4, columns=4))
    assert [(len(j.directions), j.symmetry.turns, len(j.vertices)) for j in same.joints] == [
        (2, 1, 4),
        (3, 1, 12),
        (4, 4, 9),
    ]
    assert set(same.turn[same.joints[2].vertices].round(9)) == {0.0}
    # Inside; inside to side; along a side; and from a side's first or last edge to a corner, which
    # are the same turned over.
    assert sorted(len(edge.edges) for edge in same.edges) == [8, 8, 12, 12]


def test_3464_has_one_inner_joint_that_is_itself_turned_over():
    # Gaps 60, 90, 120, 90: read backwards they are the same cycle, and no turn maps them on
    # themselves.  It stands in the six orientations of the hexagon's corners.
    same = classify(named("3.4.6.4", rows=4, columns=4))
    (inner,) = classes(same, 4)
    assert inner.symmetry.turns == 1
    assert inner.symmetry.mirror is not None
    assert not same.over[inner.vertices].any()
    assert len(set(np.degrees(same.turn[inner.vertices]).round(6))) == 6


def test_every_other_joint_of_4612_is_turned_over():
    # Gaps 90, 120, 150 one way round in one half of them, the other way in the other, and every
    # edge is between the two.
    frame = named("4.6.12", rows=4, columns=4)
    same = classify(frame)
    (inner,) = classes(same, 3)
    gap = np.degrees(np.diff(np.append(inner.directions, 2 * np.pi)))
    assert np.roll(gap, -int(gap.argmin())).round(6).tolist() in [[90, 120, 150], [90, 150, 120]]
    assert (inner.symmetry.turns, inner.symmetry.mirror) == (1, None)
    between = frame.edges[np.isin(frame.edges, inner.vertices).all(axis=1)]
    assert (same.over[between[:, 0]] != same.over[between[:, 1]]).all()


def test_a_joint_is_the_same_as_one_with_its_edges_the_other_way_around_turned_over():
    same = classify(together(star(80, 120, 160), star(80, 160, 120), star(120, 160, 80)))
    (centres,) = classes(same, 3)
    over = same.over[centres.vertices]
    assert over[0] == over[2] != over[1]


@pytest.mark.parametrize("name", NAMES)
def test_a_frame_turned_over_is_made_of_the_same_joints_and_edges(name):
    frame = named(name)
    alone, both = (
        classify(frame),
        classify(together((frame.plan, frame.edges), mirrored(frame))),
    )
    assert len(alone.joints) == len(both.joints)
    assert len(alone.edges) == len(both.edges)
    for one, two in zip(alone.edges, both.edges, strict=True):
        assert len(two.edges) == 2 * len(one.edges)


def test_a_rectangle_has_edges_of_two_lengths_between_like_joints():
    same = classify(named("rectangular", width=60.0, height=40.0, rows=4, columns=4))
    inner = len(same.joints) - 1
    between = [edge for edge in same.edges if edge.joints == (inner, inner)]
    assert [edge.length for edge in between] == [40.0, 60.0]


@pytest.mark.parametrize("name", NAMES)
def test_turn_and_shift_map_the_class_onto_each_joint(name):
    frame = named(name)
    same = classify(frame)
    for number, joint in enumerate(same.joints):
        assert len(joint.directions) == joint.symmetry.period * joint.symmetry.turns
        assert joint.directions[0] == 0
        for vertex in joint.vertices:
            assert same.joint_of[vertex] == number
            way = -1 if same.over[vertex] else 1
            slots = same.shift[vertex] + way * np.arange(len(joint.directions))
            seen = frame.directions(vertex)[slots % len(joint.directions)]
            off = seen - way * joint.directions - same.turn[vertex]
            off = (off + np.pi) % (2 * np.pi) - np.pi
            assert np.abs(off).max() == pytest.approx(same.angle_errors[vertex], abs=1e-12)
            assert same.angle_errors[vertex] < 1e-9
            assert -1e-4 <= same.turn[vertex] < 2 * np.pi / joint.symmetry.turns


def joint_from(joint, slot, way=1):
    """Directions of a joint from one of its edges on, counter-clockwise or clockwise."""
    own = way * (joint.directions - joint.directions[slot]) % (2 * np.pi)
    return tuple(np.sort(own.round(6) % round(2 * np.pi, 6)).tolist())


@pytest.mark.parametrize("name", NAMES)
def test_each_edge_connects_what_its_class_says(name):
    frame = named(name)
    same = classify(frame)
    for number, kind in enumerate(same.edges):
        for edge in kind.edges:
            assert same.edge_of[edge] == number
            assert frame.lengths[edge] == pytest.approx(kind.length)
            sides, turned = (1, 0) if same.swapped[edge] else (0, 1), []
            for side, joint, slot in zip(sides, kind.joints, kind.slots, strict=True):
                vertex = frame.edges[edge, side]
                assert same.joint_of[vertex] == joint
                way = -1 if same.over[vertex] else 1
                seen = way * (frame.slots[edge, side] - same.shift[vertex]) % frame.degree[vertex]
                # Seen from this edge on, or turned over, the joint is as from the class's slot.
                ways = joint_from(same.joints[joint], slot)
                fits = [ways == joint_from(same.joints[joint], seen, turn) for turn in (1, -1)]
                assert any(fits)
                turned.append({way * turn for turn, fit in zip((1, -1), fits, strict=True) if fit})
            assert {a * b for a in turned[0] for b in turned[1]} >= {-1 if kind.over else 1}


@settings(deadline=None, max_examples=30)
@given(
    st.sampled_from(["hexagonal", "3.4.6.4", "4.6.12", "3.3.3.3.6", "V3.3.3.4.4", "strip"]),
    st.floats(0, 360),
    st.tuples(st.floats(-500, 500), st.floats(-500, 500)),
    st.integers(0, 2**32 - 1),
)
def test_turning_moving_and_renumbering_change_no_group(name, degrees, move, seed):
    frame = named(name)
    angle = math.radians(degrees)
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    order = np.random.default_rng(seed).permutation(len(frame.vertices))
    moved = frame.plan @ turn + move
    other = make_frame("moved", moved[order], np.argsort(order)[frame.edges])
    number = cKDTree(other.plan).query(moved)[1]
    rows = {tuple(edge): n for n, edge in enumerate(other.edges.tolist())}
    edge_number = [rows[tuple(sorted(number[edge].tolist()))] for edge in frame.edges]
    one, two = classify(frame), classify(other)
    assert partition(one.joint_of) == partition(two.joint_of[number])
    assert partition(one.edge_of) == partition(two.edge_of[edge_number])
    assert (two.over[number] == one.over).all()
    difference = (two.turn[number] - one.turn) % (2 * np.pi)
    for joint in one.joints:
        spread = difference[joint.vertices] * joint.symmetry.turns
        assert np.cos(spread - spread[0]).min() > 1 - 1e-9


def test_edges_at_alike_slots_of_a_symmetric_joint_are_alike():
    # Gaps 60, 120, 60, 120: half a turn maps the joint on itself, and turning it over swaps the
    # edges beside a gap, so that all four arms are one kind.
    same = classify(together(star(60, 120, 60, 120)))
    assert same.joints[-1].symmetry.turns == 2
    assert [len(edge.edges) for edge in same.edges] == [4]


def test_angles_within_the_tolerance_are_the_same_and_beyond_it_not():
    frame = together(star(100, 120, 140), star(100.2, 120, 139.8), star(101, 120, 139))
    joints = classes(classify(frame, math.radians(0.2)), 3)
    assert sorted(len(joint.vertices) for joint in joints) == [1, 2]
    assert len(classes(classify(frame), 3)) == 3
    assert len(classes(classify(frame, math.radians(2)), 3)) == 1


def test_numbers_are_grouped_into_as_few_as_can_be():
    results, group = group_values(np.array([3.0, 1.0, 1.2, 5.0, 3.1]), 0.1)
    assert results == pytest.approx([1.1, 3.05, 5.0])
    assert group.tolist() == [1, 0, 0, 2, 1]


@given(st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=50), st.floats(1e-3, 10))
def test_no_number_moves_by_more_than_the_tolerance(values, tolerance):
    results, group = group_values(np.array(values), tolerance)
    assert np.abs(results[group] - values).max() <= tolerance * (1 + 1e-9)
    assert (np.diff(results) > 0).all()


def test_snapping_makes_fewer_parts_and_says_what_it_costs():
    # Two ladders of rungs 40 and 40.3 mm; snapped by 0.2 mm both become 40.15.
    rungs = np.array([[0, 0], [50, 0], [0, 40], [50, 40]])
    longer = rungs * [1, 40.3 / 40]
    edges = np.array([[0, 1], [2, 3], [0, 2], [1, 3]])
    frame = together((rungs, edges), (longer, edges))
    assert sorted({e.length for e in classify(frame).edges}) == pytest.approx([40, 40.3, 50])
    snapped = snap(frame, 0.01, 0.2)
    assert sorted({e.length for e in snapped.same.edges}) == pytest.approx([40.15, 50])
    assert snapped.length_error == pytest.approx(0.15)
    assert snapped.angle_error == pytest.approx(0, abs=1e-9)
    assert snapped.miss == pytest.approx(0.15)
    assert "lengths change by up to 0.15 mm, at (0, 20)" in snapped.notes


def test_snapped_angles_are_within_the_tolerance():
    # The joint's mean is 100.5, 119.5, 140 or its first one: either way within a degree.
    frame = together(star(100, 120, 140), star(101, 119, 140))
    snapped = snap(frame, math.radians(1), 0.01)
    assert len(classes(snapped.same, 3)) == 1
    assert 0 < snapped.angle_error <= math.radians(1)
    assert snapped.miss == pytest.approx(10 * math.sin(snapped.angle_error), rel=1e-3)


@pytest.mark.parametrize("angle", [0, -1, math.nan, math.radians(40)])
def test_angles_that_would_merge_edges_are_refused(angle):
    with pytest.raises(InputError, match=r"angle_tolerance = .*a quarter of the smallest gap"):
        classify(named("square"), angle)


def test_lengths_need_a_tolerance():
    with pytest.raises(InputError, match="tolerance = 0"):
        classify(named("square"), 0.01, 0)


def test_thirty_thousand_edges_are_grouped_in_two_seconds():
    frame = named("hexagonal", rows=100, columns=100)
    assert len(frame.edges) == 30_399
    start = time.process_time()
    same = classify(frame)
    assert time.process_time() - start < 2.0
    assert (len(same.joints), len(same.edges)) == (2, 3)
