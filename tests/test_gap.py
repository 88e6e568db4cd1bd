"""The gap between two solids and what they have in common."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from shapes import box, torus

from scadgen.errors import InputError, InvariantError
from scadgen.solid.gap import overlap_volume, smallest_gap


@pytest.mark.parametrize("gap", [1, 0.05, 1e-3, 1e-6])
def test_two_long_boxes_turned_in_space(gap):
    turn = Rotation.from_rotvec((0.3, -0.8, 0.5)).as_matrix()
    one, faces = box((0, 0, 0), (100, 20, 20))
    other, _ = box((100 + gap, 3, 4), (200, 11, 12))
    found = smallest_gap(one @ turn.T, faces, other @ turn.T, faces, 5)
    assert found == pytest.approx(gap, abs=1e-12)


def test_two_edges_square_to_each_other():
    beam, faces = box((-3, -0.5, -0.5), (3, 0.5, 0.5))
    one = beam @ Rotation.from_euler("x", 45, degrees=True).as_matrix().T
    other = one[:, [1, 0, 2]] * (1, -1, 1)
    higher = np.add(other, (0, 0, np.sqrt(2) + 0.05))
    assert smallest_gap(one, faces, higher, faces, 1) == pytest.approx(0.05, abs=1e-12)


def test_linked_rings():
    # The other ring stands upright and passes through this one's hole, of radius 2, with
    # its tube of radius 1 off the middle by 0.95.
    points, faces = torus(120, 60)
    upright = np.add(points[:, [0, 2, 1]] * (1, 1, -1), (3.95, 0, 0))
    assert smallest_gap(points, faces, upright, faces, 1) == pytest.approx(0.05, rel=0.05)
    assert overlap_volume(points, faces, upright, faces) == 0


def test_the_limit_is_the_answer_for_whatever_is_farther():
    one, faces = box((0, 0, 0), (1, 1, 1))
    assert smallest_gap(one, faces, one + 5, faces, 0.3) == 0.3


def test_touching_overlapping_and_nested_solids_have_no_gap():
    one, faces = box((0, 0, 0), (4, 4, 4))
    for low, high, common in (
        ((4, 0, 0), (5, 4, 4), 0),
        ((3, 3, 3), (6, 6, 6), 1),
        ((1, 1, 1), (3, 3, 2), 4),
    ):
        other, _ = box(low, high)
        assert smallest_gap(one, faces, other, faces, 1) == 0
        assert overlap_volume(one, faces, other, faces) == pytest.approx(common)


@settings(deadline=None, max_examples=60)
@given(
    st.tuples(*[st.floats(-30, 30)] * 3),
    st.tuples(*[st.floats(0.1, 20)] * 6),
    st.integers(0, 2**32 - 1),
)
def test_boxes_anywhere(at, sizes, seed):
    turn = Rotation.random(random_state=np.random.default_rng(seed)).as_matrix()
    one, faces = box((0, 0, 0), sizes[:3])
    other, _ = box(at, np.add(at, sizes[3:]))
    apart = np.maximum(np.subtract(at, sizes[:3]), -np.add(at, sizes[3:]))
    common = np.prod(np.minimum(sizes[:3], np.add(at, sizes[3:])) - np.maximum(at, 0))
    overlaps = (apart < 0).all()
    found = smallest_gap(one @ turn.T, faces, other @ turn.T, faces, 100)
    assert found == pytest.approx(np.linalg.norm(np.maximum(apart, 0)), abs=1e-9)
    volume = overlap_volume(one @ turn.T, faces, other @ turn.T, faces)
    assert volume == pytest.approx(common if overlaps else 0, abs=1e-6)


@pytest.mark.parametrize("limit", [0, -1, np.inf, np.nan])
def test_a_limit_that_is_none(limit):
    one, faces = box((0, 0, 0), (1, 1, 1))
    with pytest.raises(InputError, match=r"limit of the gap is .* mm; it must be above 0"):
        smallest_gap(one, faces, one, faces, limit)


def test_what_is_no_solid_is_refused():
    one, faces = box((0, 0, 0), (1, 1, 1))
    with pytest.raises(InvariantError, match=r"oriented 2-manifold: .* NotManifold"):
        smallest_gap(one, faces[1:], one, faces, 1)
    with pytest.raises(InvariantError, match="positive volume: manifold3d finds -1 mm3"):
        overlap_volume(one, faces, one, faces[:, ::-1])
    with pytest.raises(InvariantError, match="NonFiniteVertex"):
        overlap_volume(one * np.nan, faces, one, faces)
