"""Where faces touch, against what a person can work out."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from puzzles import diagonal, placed, voxels
from shapes import box

from scadgen.errors import InputError
from scadgen.interlock.bodies import bodies, open_edges
from scadgen.interlock.contacts import default_tolerance, find_contacts
from scadgen.interlock.nearby import near_pairs
from scadgen.interlock.overlap import overlaps

LOWER = box((0, 0, 0), (4, 4, 2))


def joined(*meshes):
    points = np.concatenate([p for p, _ in meshes])
    shift = np.cumsum([0, *(len(p) for p, _ in meshes)])
    triangles = np.concatenate([t + s for (_, t), s in zip(meshes, shift, strict=False)])
    merged, where = np.unique(points, axis=0, return_inverse=True)
    return merged, where.reshape(-1)[triangles]


@given(st.integers(0, 2**32 - 1), st.floats(-0.009, 0.009))
def test_a_box_on_a_box_touches_in_its_footprint(seed, gap):
    upper = box((1, 1, 2 + gap), (3, 6, 5))
    meshes, turn = placed([LOWER, upper], np.random.default_rng(seed))
    size = diagonal(meshes) / diagonal([LOWER, upper])
    contacts = find_contacts(meshes, 0.01 * size)
    assert len(contacts) >= 4
    assert (contacts.first == 0).all()
    assert (contacts.second == 1).all()
    assert contacts.normals == pytest.approx(np.tile(turn[:, 2], (len(contacts), 1)), abs=1e-9)
    # Against the corners of the footprint, in the middle of the gap.
    plain = find_contacts([LOWER, upper], 0.01).points
    assert plain[:, 2] == pytest.approx(2 + gap / 2)
    assert plain.min(axis=0)[:2] == pytest.approx([1, 1])
    assert plain.max(axis=0)[:2] == pytest.approx([3, 4])


def test_faces_farther_apart_than_the_tolerance_do_not_touch():
    upper = box((1, 1, 2.1), (3, 3, 5))
    assert not len(find_contacts([LOWER, upper], 0.09))
    assert len(find_contacts([LOWER, upper], 0.11))


def test_faces_that_only_share_an_edge_do_not_touch():
    assert not len(find_contacts([LOWER, box((4, 0, 2), (8, 4, 4))], 0.01))


def test_boxes_side_by_side_facing_the_same_way_do_not_touch():
    assert not len(find_contacts([LOWER, box((4.5, 0, 0), (8, 4, 2))], 0.1))


def test_curved_walls_touch_up_to_ten_degrees():
    wedge = np.array(LOWER[0])
    for angle, touches in ((5, True), (15, False)):
        tilted = np.array(LOWER[0]) * [0.1, 0.1, 1] + [0, 0, 2.0]
        low = tilted[:, 2] < 2.5
        tilted[low, 2] += tilted[low, 0] * np.tan(np.radians(angle))
        found = find_contacts([(wedge, LOWER[1]), (tilted, LOWER[1])], 0.2)
        assert bool(len(found)) == touches


def test_the_default_tolerance_is_a_hundredth_of_the_median_diagonal():
    meshes = [box((0, 0, 0), (s, 0.0001, 0.0001)) for s in (1, 3, 100)]
    assert default_tolerance(meshes) == pytest.approx(0.03, rel=1e-6)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan"), float("inf")])
def test_a_tolerance_that_is_none_is_refused(tolerance):
    with pytest.raises(InputError, match="tolerance"):
        find_contacts([LOWER, LOWER], tolerance)


@given(st.integers(0, 2**32 - 1), st.integers(0, 60))
def test_near_pairs_are_all_pairs_of_boxes_that_overlap(seed, count):
    rng = np.random.default_rng(seed)
    low = rng.integers(0, 8, size=(count, 3)).astype(float)
    high = low + rng.choice([0.0, 0.5, 1.0, 6.0], size=(count, 3))
    owner = rng.integers(0, 3, size=count)
    found = [
        tuple(sorted(pair))
        for one, other in near_pairs(low, high, owner)
        for pair in zip(one.tolist(), other.tolist(), strict=True)
    ]
    expected = {
        (a, b)
        for a in range(count)
        for b in range(a)
        if owner[a] != owner[b] and (low[a] <= high[b]).all() and (low[b] <= high[a]).all()
    }
    assert sorted(found) == sorted((b, a) for a, b in expected)


def test_bodies_that_share_a_face_an_edge_or_a_corner_are_told_apart():
    mesh = joined(
        voxels([(0, 0, 0)]),
        voxels([(1, 0, 0), (1, 0, 1)]),
        voxels([(0, 1, 1)]),
        voxels([(2, 1, 1)]),
    )
    assert not len(open_edges(mesh[1]))
    assert [len(faces) for faces in bodies(*mesh)] == [12, 20, 12, 12]


def test_a_cavity_belongs_to_the_body_around_it():
    points, triangles = box((1, 1, 0.5), (2, 2, 1))
    hollow = joined(LOWER, (points, triangles[:, ::-1]))
    inside = box((1.2, 1.2, 0.6), (1.8, 1.8, 0.9))
    assert [len(faces) for faces in bodies(*hollow)] == [24]
    assert [len(faces) for faces in bodies(*joined(hollow, inside))] == [24, 12]


def test_open_edges_are_found():
    assert len(open_edges(LOWER[1])) == 0
    assert len(open_edges(LOWER[1][1:])) == 3


def test_overlaps_give_the_volume_and_leave_touching_parts_alone():
    parts = [LOWER, box((3, 3, 1), (5, 5, 5)), box((0, 0, 2), (2, 2, 3))]
    ((a, b, shared, depth),) = overlaps(parts)
    assert (a, b) == (0, 1)
    assert shared == pytest.approx(1)
    assert depth == pytest.approx(1 / 3)  # a cube of side 1: 2 of volume over 6 of surface
