"""Where joints can stand, against the joint's own lattice."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scadgen.errors import GeometryError
from scadgen.frame.joints import (
    least_gap,
    least_ring_ratio,
    least_scale,
    tube_start,
)
from scadgen.joint.lattice import make_lattice
from scadgen.joint.spokes import Spokes
from scadgen.plane.catalogue import named


def test_tubes_that_touch_by_hand():
    # At a right angle the corners of two unit squares meet where X0 = 1/2.
    assert least_ring_ratio([math.pi / 2] * 4) == pytest.approx(math.sqrt(0.5) - 0.5)
    # At 60 degrees X0 = 1 / (2 tan 30) = 0.866, and R = 1/2.
    assert least_ring_ratio([math.pi / 3] * 6) == pytest.approx(0.5)


@given(st.lists(st.floats(0.35, 2.0), min_size=2, max_size=8))
def test_the_least_ratio_is_where_the_lattice_begins_to_work(parts):
    gaps = np.array(parts) / sum(parts) * 2 * np.pi
    edges = np.cumsum(gaps) - gaps[0]
    ratio = least_ring_ratio(gaps)
    if ratio > 0.6:
        make_lattice(Spokes.flat(edges), ratio + 1e-6, 5)
        with pytest.raises(GeometryError, match="two tubes overlap"):
            make_lattice(Spokes.flat(edges), ratio - 1e-6, 5)


@given(st.floats(0.1, 3.0), st.floats(0.0, 1.0))
def test_spacing_is_the_distance_of_the_corners(gap, spacing):
    ratio = least_ring_ratio([gap, 2 * math.pi - gap], spacing)
    start = float(tube_start(ratio))
    corner = start + 0.5j
    other = (start - 0.5j) * complex(math.cos(gap), math.sin(gap))
    if start > 1e-6:
        assert abs(other - corner) == pytest.approx(spacing, abs=1e-9)
        assert least_gap(ratio, spacing) == pytest.approx(gap)


def test_a_narrower_gap_needs_a_larger_ring():
    ratios = [least_ring_ratio([gap, 2 * math.pi - gap]) for gap in np.linspace(0.1, 3.1, 30)]
    assert (np.diff(ratios) < 0).all()


def test_the_least_scale_has_room_for_joints_and_rest():
    # R = 1.5: X0 = sqrt(3.75) = 1.936; two of them and a side of rest are 4.873 sides.
    frame = named("rectangular", width=60.0, height=40.0, rows=1, columns=1)
    assert least_scale(frame, 10.0, 1.5, rest=1.0) == pytest.approx(48.7298 / 40)
    strip = named("strip", triangles=1, edge_length=30.0)
    own = least_scale(strip, 10.0, [0.9, 0.9, 1.9])
    assert own == pytest.approx(10 * (2.4**2 - 0.25) ** 0.5 / 30 + 10 * (1.4**2 - 0.25) ** 0.5 / 30)
