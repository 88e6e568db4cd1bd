"""Meshes whose vertices move on straight lines."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from shapes import box, grooved, together, torus

from scadgen.solid.crossing import crossing_faces
from scadgen.solid.mesh import solid_faults, volume
from scadgen.solid.sweep import SAFE_MARGIN, first_fault, safe_share

TETRAHEDRON = (
    np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, 1]]),
    np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
)
OCTAHEDRON = (
    np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float),
    np.array(
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    ),
)
PAIR = together(box((0, 0, 0), (1, 1, 1)), box((2, 0.3, 0.4), (3, 1.1, 1.2)))
SHAPES = {
    "tetrahedron": TETRAHEDRON,
    "octahedron": OCTAHEDRON,
    "groove": grooved(),
    "pair": PAIR,
    "ring": torus(6, 4),
}


def moved(points, which, by):
    way = np.zeros_like(points)
    way[which] = by
    return way


@pytest.mark.parametrize("name", SHAPES)
def test_the_shapes_are_sound_to_begin_with(name):
    faults = solid_faults(*SHAPES[name])
    assert faults == (["one shell: 2 shells"] if name == "pair" else [])


def test_an_apex_pushed_through_its_base():
    points, triangles = TETRAHEDRON
    fault = first_fault(points, moved(points, 3, (0, 0, -4)), triangles)
    assert fault.t == pytest.approx(0.25)
    assert fault.kind == "faces touch"
    assert fault.features == ((3,), (0, 2, 1))
    assert str(fault) == "faces touch at t = 0.250000: 3 and 0-2-1"


def test_boxes_that_approach_meet_where_they_meet():
    points, triangles = PAIR
    way = moved(points, slice(8, 16), (-4, 0, 0))
    fault = first_fault(points, way, triangles)
    assert fault.t == pytest.approx(0.25)
    assert safe_share(points, way, triangles) == pytest.approx(0.25 - SAFE_MARGIN)
    assert first_fault(points, way * 0.249, triangles) is None
    assert safe_share(points, way * 0.249, triangles) == 1


def test_edges_that_cross_without_a_vertex_in_a_face():
    # Two boxes whose nearest edges are square to each other.
    turn = Rotation.from_euler("x", 45, degrees=True).as_matrix()
    beam = box((-3, -0.5, -0.5), (3, 0.5, 0.5))
    one = beam[0] @ turn.T
    other = one[:, [1, 0, 2]] * (1, -1, 1) + (0, 0, 3)
    points, triangles = together((one, beam[1]), (other, beam[1]))
    fault = first_fault(points, moved(points, slice(8, 16), (0, 0, -4)), triangles)
    assert fault.t == pytest.approx((3 - np.sqrt(2)) / 4)
    assert [len(f) for f in fault.features] == [2, 2]


def test_boxes_that_slide_past_each_other():
    points, triangles = together(box((0, 0, 0), (1, 1, 1)), box((-5, 1.001, 0), (-4, 2, 1)))
    way = moved(points, slice(8, 16), (10, 0, 0))
    assert first_fault(points, way, triangles) is None
    way[8:, 1] = -0.01
    # After a tenth of the way the gap is closed, but the boxes are not yet abreast.
    fault = first_fault(points, way, triangles)
    assert fault.t == pytest.approx(0.4)


def test_a_box_flies_through_a_ring():
    points, triangles = together(torus(), box((-0.5, -0.5, -9), (0.5, 0.5, -8)))
    assert first_fault(points, moved(points, slice(288, 296), (0, 0, 40)), triangles) is None
    fault = first_fault(points, moved(points, slice(288, 296), (40, 0, 120)), triangles)
    assert fault.kind == "faces touch"


def test_a_groove_folds_shut():
    points, triangles = grooved()
    rims = [1, 8, 6, 13]
    way = moved(points, rims, np.array([[2, 0, 0]] * 2 + [[-2, 0, 0]] * 2))
    fault = first_fault(points, way, triangles)
    assert fault.t == pytest.approx(0.5)
    assert fault.kind == "faces touch"
    # One wall alone folds onto the other.
    points, triangles = grooved(1.5)
    fault = first_fault(points, moved(points, [6, 13], (-3, 0, 0)), triangles)
    assert fault.t == pytest.approx(0.5)
    assert fault.kind == "faces touch"


def test_a_face_that_turns_by_a_right_angle_counts_as_turned_over():
    # On the straight way to a turn by 120 degrees the cosine is 1 - 1.5 t.
    points, triangles = box((0, 0, 0), (1, 1, 1))
    turn = Rotation.from_euler("z", 120, degrees=True).as_matrix()
    fault = first_fault(points, points @ turn.T - points, triangles)
    assert fault.kind == "face turns over"
    assert fault.t == pytest.approx(2 / 3, abs=1e-5)


def test_a_vertex_that_leaves_its_flat_area_turns_a_face_over():
    # The top of the box as four faces about its middle, vertex 8.
    points, triangles = box((0, 0, 0), (1, 1, 1))
    points = np.vstack([points, [[0.5, 0.5, 1]]])
    top = [[8, 1, 5], [8, 5, 7], [8, 7, 3], [8, 3, 1]]
    triangles = np.vstack([triangles[:-2], top])
    assert solid_faults(points, triangles) == []
    facets = np.array([0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 5, 5])
    way = moved(points, 8, (1, 0, 0))
    for given_facets in (None, facets):
        fault = first_fault(points, way, triangles, given_facets)
        assert fault.kind == "face turns over"
        assert fault.t == pytest.approx(0.5, abs=1e-5)
        assert fault.features == ((8, 5, 7),)
        assert first_fault(points, way * 0.4, triangles, given_facets) is None


def test_an_outline_that_touches_itself_in_its_plane():
    # The groove's walls part at the bottom and meet at the rims: a dovetail closing.
    points, triangles = grooved(1.9, 2.1)
    facets = np.repeat(np.arange(9), [5, 5, *[1] * 7])
    facets = np.concatenate([facets, np.arange(2, 9)])
    way = moved(points, [1, 8], (0.4, 0, 0))
    for given_facets in (None, facets):
        fault = first_fault(points, way, triangles, given_facets)
        assert fault.kind == "faces touch"
        assert fault.t == pytest.approx(0.5)


def test_a_growing_box_never_faults():
    points, triangles = box((0, 0, 0), (1, 1, 1))
    assert first_fault(points, points * (100, 0, 3), triangles) is None
    assert first_fault(points, points * (-0.999, 0, 0), triangles) is None
    assert first_fault(points, points * (-2, 0, 0), triangles).t == pytest.approx(0.5, abs=1e-5)


def test_no_faces_no_fault():
    assert first_fault(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3), dtype=int)) is None


def test_a_fault_at_the_very_start_leaves_nothing():
    points, triangles = together(box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (2, 1, 1)))
    assert safe_share(points, moved(points, slice(8, 16), (-1, 0, 0)), triangles) == 0


VECTOR = st.tuples(*[st.floats(-3, 3)] * 3).map(np.array)


@settings(deadline=None, max_examples=40)
@given(st.sampled_from(sorted(SHAPES)), VECTOR, st.floats(0, 1.3), VECTOR, st.floats(0.02, 50))
def test_rigid_motions_and_scaling_never_fault(name, axis, angle, shift, scale):
    assume(np.linalg.norm(axis) > 0.1)
    points, triangles = SHAPES[name]
    turn = Rotation.from_rotvec(axis / np.linalg.norm(axis) * angle).as_matrix()
    way = scale * points @ turn.T + shift - points
    assert first_fault(points, way, triangles) is None


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(sorted(SHAPES)), st.integers(0, 2**32 - 1), st.floats(0.1, 2))
def test_against_many_samples(name, seed, reach):
    rng = np.random.default_rng(seed)
    points, triangles = SHAPES[name]
    turn = Rotation.random(random_state=rng).as_matrix()
    points = points @ turn.T
    way = rng.normal(size=points.shape) * reach
    fault = first_fault(points, way, triangles)
    until = 1.0 if fault is None else fault.t
    for t in np.linspace(0, until * (1 - 1e-5), 40):
        assert len(crossing_faces(points + t * way, triangles)) == 0
    if fault is not None and fault.kind == "faces touch" and until < 1 - 1e-6:
        # A tetrahedron has no faces that could cross: it is inside out then.
        after = points + (until + 1e-6) * way
        assert len(crossing_faces(after, triangles)) > 0 or volume(after, triangles) < 0


@settings(deadline=None, max_examples=30)
@given(st.sampled_from(sorted(SHAPES)), st.integers(0, 2**32 - 1), st.floats(1e-3, 1e3))
def test_the_size_does_not_matter(name, seed, scale):
    points, triangles = SHAPES[name]
    way = np.random.default_rng(seed).normal(size=points.shape)
    one = first_fault(points, way, triangles)
    other = first_fault(points * scale, way * scale, triangles)
    assert (one is None) == (other is None)
    if one is not None:
        assert (other.kind, other.features) == (one.kind, one.features)
        assert other.t == pytest.approx(one.t)
