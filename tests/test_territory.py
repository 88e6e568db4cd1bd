"""Proofs that a box belongs to one connector alone, against dense sampling."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kits import joint, regular
from scipy.spatial import cKDTree

from scadgen.joint.joint import DETAILS, check_footprint, make_joint, site_curves
from scadgen.joint.lattice import make_lattice
from scadgen.joint.spokes import Spokes
from scadgen.joint.territory import arm, belongs, share
from scadgen.joint.weave import Weave

GRID = np.stack(np.meshgrid(*[np.linspace(0, 1, 9)] * 3), axis=-1).reshape(-1, 3)


def curves_of(frame):
    return joint(frame).curves


def sampled_leads(curves, own, points):
    """How much nearer points are to their own curve than to any other, by 4000 samples each."""
    trees = [cKDTree(curve.points(np.linspace(-1, 1, 4001))) for curve in curves]
    far = np.stack([tree.query(points)[0] for tree in trees])
    return np.delete(far, own, axis=0).min(axis=0) - far[own]


corner = st.tuples(st.floats(0.9, 2.0), st.floats(-1.5, 1.5), st.floats(-0.5, 0.5))
extent = st.tuples(st.floats(0.0, 0.6), st.floats(0.0, 0.6), st.floats(0.0, 0.6))


@given(corner, extent, st.floats(0.0, 0.1), st.sampled_from(["hexagonal", "square"]))
def test_belongs_agrees_with_dense_sampling(low, size, margin, frame):
    curves = curves_of(frame)
    low, size = np.array(low), np.array(size)
    proven = belongs(curves, 0, low, low + size, margin)
    lead = sampled_leads(curves, 0, low + GRID * size).min()
    spacing = np.linalg.norm(size) / 8
    if proven:
        assert lead > 2 * margin - 1e-6
    else:
        # A place where it fails is at most half a spacing from a sample.
        assert lead <= 2 * (margin + spacing / 2 + np.linalg.norm(size) / 2**9) + 1e-6


@pytest.mark.parametrize("frame", ["hexagonal", "square"])
def test_every_tube_face_is_proven_and_sampled_to_be_its_connectors(frame):
    made = joint(frame)
    start = made.lattice.domain.flats.distance[0]
    face = np.stack(np.meshgrid([start], *[np.linspace(-0.5, 0.5, 41)] * 2), axis=-1).reshape(-1, 3)
    for edge, angle in enumerate(made.spokes.azimuths):
        check_footprint(made.lattice, made.curves, edge)
        c, s = np.cos(angle), np.sin(angle)
        turned = face @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        assert sampled_leads(made.curves, edge, turned).min() > 0


def test_a_weave_that_loses_the_footprint_is_refused_with_the_share():
    weave = Weave(1.809, 0.98, 0.093, 0.674, 1.018, "greedy")
    with pytest.raises(Exception, match=r"weave greedy: only \d+\.\d% of a tube's face") as said:
        make_joint(Spokes.flat(regular(4)), weave, DETAILS["draft"])
    told = float(str(said.value).split("only ")[1].split("%")[0]) / 100
    lattice = make_lattice(Spokes.flat(regular(4)), weave.ring_ratio, 5)
    curves = site_curves(lattice.domain.spokes, weave, 60)
    grid = np.linspace(-0.5, 0.5, 201)
    face = np.stack(np.meshgrid([lattice.domain.flats.distance[0]], grid, grid), axis=-1).reshape(
        -1, 3
    )
    assert told == pytest.approx((sampled_leads(curves, 0, face) > 0).mean(), abs=0.02)
    assert told < 0.5


def test_share_by_hand():
    curves = curves_of("square")
    points = np.array([[1.5, 0, 0], [-1.5, 0, 0], [0, 1.5, 0], [2.0, 0, 0]])
    assert share(curves, 0, points) == 0.5
    assert share(curves, 1, points @ curves[1].turn) == 0.5


def test_a_box_with_a_wall_right_in_its_middle_is_foreign():
    curves = curves_of("square")
    middle = np.array([1.5, 1.5, 0]) / np.sqrt(2)
    assert not belongs(curves, 0, middle - 0.2, middle + 0.2, 0.0)


def test_arms_of_straight_connectors_end_in_the_middle_of_the_gap():
    weave = Weave(1.5, 0.3, 0.0, 0.3, 1.0)
    lattice = make_lattice(Spokes.flat(regular(4)), weave.ring_ratio, 9)
    curves = site_curves(lattice.domain.spokes, weave, 60)
    thickness = arm(lattice, curves, 0, np.full(4, np.pi / 4))
    middle = lattice.planes[lattice.edge_planes[0] : lattice.edge_planes[1]]
    before = middle[middle < np.pi / 4][-1]
    # All that is left of the arm there is what is nearer to it than to its mirror image.
    assert thickness < 2 * 2.0 * np.sin(np.pi / 4 - before)
    assert thickness > np.sin(np.pi / 4 - before)


def test_arms_are_the_same_all_around():
    made = joint("hexagonal")
    found = [arm(made.lattice, made.curves, edge, made.walls) for edge in range(3)]
    assert np.ptp(found) < 1e-9
