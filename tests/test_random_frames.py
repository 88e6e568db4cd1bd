"""Random frames become kits whose plans are proved; what has no room is refused with its place."""

import importlib.util
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kits import drawn

from scadgen.errors import GeometryError, InputError
from scadgen.joint.weave import any_joint
from scadgen.kit.build import build
from scadgen.plane.drawn import make_frame

ROOT = Path(__file__).parents[1]


def script():
    """`benchmarks/random_frames.py`, which does so for many and large ones."""
    spec = importlib.util.spec_from_file_location("frames", ROOT / "benchmarks/random_frames.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


FRAMES = script()


@settings(max_examples=3)
@given(st.integers(0, 2**32 - 1))
def test_a_random_frame_becomes_a_proved_kit_with_a_proved_plan(seed):
    frame = FRAMES.random_frame(np.random.default_rng(seed), most=6)
    end, said = FRAMES.become(frame)
    # At lone ends of edges nothing may hold what is sharply bent.
    assert end in ("kit", "kit, not held"), said


@given(st.integers(0, 2**32 - 1))
def test_random_frames_are_what_they_are_said_to_be(seed):
    frame = FRAMES.random_frame(np.random.default_rng(seed))
    assert FRAMES.FEWEST <= len(frame.vertices) <= FRAMES.MOST
    assert FRAMES.connected(frame.edges, len(frame.vertices))
    for vertex, degree in enumerate(frame.degree):
        assert degree < 2 or np.degrees(frame.gaps(vertex).min()) > FRAMES.LEAST - 1e-6


def past_a_corner(far):
    """A bent edge whose corner is some distance from a longer one, and joined to it far away."""
    points = [[0, 0], [400, 0], [200, far], [60, 250], [340, 250]]
    return make_frame("past", points, [[0, 1], [2, 3], [2, 4], [0, 3], [1, 4]])


def test_a_joint_in_the_way_of_an_edge_is_refused_with_what_would_do():
    wish = drawn("past", past_a_corner(35.0))
    with pytest.raises(GeometryError, match=r"vertex 2 at .*: edge 0 is 35 mm away") as found:
        build(wish)
    (times,) = re.findall(r"a frame ([\d.]+) times as large would do", str(found.value))
    # Around it are the ring, half a side, half a tube, and a quarter of a side.
    ring = any_joint(2 * np.arctan2(140, 215)).ring_ratio
    assert float(times) == pytest.approx(10 * (ring + 1.25) / 35, rel=0.02)
    assert build(replace(wish, frame=past_a_corner(35 * float(times) + 3))).joints


def test_a_frame_that_may_grow_grows_until_its_joints_keep_apart():
    kit = build(drawn("past", past_a_corner(20.0), resizable=True))
    place = kit.frame.plan[2]
    assert place[1] - kit.frame.plan[0, 1] > 10 * 3.5


def test_edges_too_near_each_other_are_refused_with_their_vertex():
    ends = [[0, 0], [300, 0], [300 * np.cos(0.4), 300 * np.sin(0.4)]]
    frame = make_frame("narrow", ends, [[0, 1], [0, 2]])
    with pytest.raises(InputError, match=r"vertex 0 at .*22\.92 degrees apart"):
        build(drawn("narrow", frame, resizable=True))
