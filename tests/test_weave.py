"""Weaves and their site curves."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.frame.placement import KEYS
from scadgen.joint.curve import SiteCurve
from scadgen.joint.weave import BUILT_IN, Weave, any_joint

GOOD = {"ring_ratio": 1.5, "span": 0.8, "amplitude": 0.2, "bend": 0.5, "periods": 1.0}
GAP = 2 * math.pi / 3


def curve(samples=60, **changes):
    return SiteCurve(Weave(**{**GOOD, **changes}), 0.0, GAP / 2, GAP / 2, samples)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("ring_ratio", 0.79),
        ("ring_ratio", 10.01),
        ("span", 0.0),
        ("span", 1.51),
        ("amplitude", -0.1),
        ("amplitude", 1.01),
        ("bend", -0.01),
        ("bend", math.inf),
        ("periods", 0.2),
        ("periods", math.nan),
        ("periods", "1"),
        ("periods", True),
        ("periods", None),
        ("stretch", 0.9),
        ("stretch", math.inf),
    ],
)
def test_a_parameter_out_of_its_limits_is_refused_with_value_and_limits(name, value):
    with pytest.raises(InputError, match=rf"weave: {name} = \S+: must be a number from") as said:
        Weave(**{**GOOD, name: value})
    assert repr(value) in str(said.value)
    assert "\n" not in str(said.value)


def test_a_weave_read_back_is_the_weave():
    weave = Weave(**GOOD, name="mine")
    assert Weave.from_dict(weave.as_dict(), "mine") == weave
    assert Weave.from_dict(GOOD, "mine").name == "mine"
    stretched = Weave(**GOOD, stretch=3.0)
    assert Weave.from_dict(stretched.as_dict(), "mine") == stretched != weave


@pytest.mark.parametrize("entries", [{}, [], "weave", None, {**GOOD, "twist": 1.0}, {"span": 0.8}])
def test_other_entries_are_refused(entries):
    with pytest.raises(InputError, match=r"weave mine: must be a JSON object with amplitude, bend"):
        Weave.from_dict(entries, "mine")


def test_entries_that_no_weave_has_are_named():
    with pytest.raises(InputError, match=r"periods, ring_ratio, span, not arm, play$"):
        Weave.from_dict({**GOOD, "play": 9.0, "arm": 0.3}, "mine")


def test_every_frame_has_a_built_in_weave():
    assert {f"{count}-{key}" for count in (3, 4) for key in KEYS} <= set(BUILT_IN)
    assert all(weave.name == name for name, weave in BUILT_IN.items())


def test_without_bend_it_is_a_straight_sinusoid():
    u = np.linspace(-1, 1, 9)
    x, y, z = curve(bend=0.0).points(u).T
    assert np.allclose(x, 1.5, atol=1e-15)
    assert np.allclose(y, u * 0.8 * GAP * 1.5, atol=1e-15)
    assert np.allclose(z, 0.2 * np.sin(np.pi * u), atol=1e-15)


def test_with_bend_one_it_follows_the_ring():
    u = np.linspace(-1, 1, 9)
    points = curve(bend=1.0).points(u)
    assert np.allclose(np.hypot(points[:, 0], points[:, 1]), 1.5, atol=1e-14)
    assert np.allclose(np.arctan2(points[:, 1], points[:, 0]), u * 0.8 * GAP, atol=1e-14)


def test_in_plan_it_is_an_arc_of_ring_ratio_over_bend():
    points = curve(bend=0.5).points(np.linspace(-1, 1, 9))
    assert np.allclose(np.hypot(points[:, 0] + 1.5, points[:, 1]), 3.0, atol=1e-14)


def test_each_side_reaches_by_its_own_gap():
    both = SiteCurve(Weave(**{**GOOD, "bend": 0.0}), 0.0, 0.5, 1.0, 60)
    assert both.points(np.array(1.0))[1] == pytest.approx(0.8 * 1.5)
    assert both.points(np.array(-1.0))[1] == pytest.approx(-0.8 * 1.5 * 2)


def test_it_goes_up_on_one_side_and_down_on_the_other():
    u = np.linspace(0, 1, 20)
    ahead, behind = curve().points(u), curve().points(-u)
    assert np.allclose(ahead, behind * [1, -1, -1], atol=1e-15)


def test_a_stretch_as_long_as_the_gap_changes_nothing():
    u = np.linspace(-1, 1, 9)
    plain, whole = curve(), curve(stretch=GAP * 1.5 + 0.1)
    assert np.array_equal(plain.points(u), whole.points(u))


def test_beyond_its_stretch_an_arm_follows_the_ring_and_then_weaves_as_in_a_narrow_gap():
    stretch, wide = 2.0, 5.0
    weave = Weave(**GOOD, stretch=stretch)
    narrow = SiteCurve(weave, 0.0, stretch / 3, stretch / 3, 60)
    site = SiteCurve(weave, 0.0, wide / 3, wide / 3, 60)
    # Half of what is not woven lies on each side of the gap's middle.
    turn = (wide - stretch) / 2 / 1.5
    c, s = math.cos(turn), math.sin(turn)
    end = narrow.points(np.array(1.0)) @ [[c, s, 0], [-s, c, 0], [0, 0, 1]]
    assert np.allclose(site.points(np.array(1.0)), end, atol=1e-4)
    x, y, z = site.points(np.linspace(0, 0.2, 9)).T
    assert np.allclose(np.hypot(x, y), 1.5, atol=1e-3)
    assert np.allclose(z, 0, atol=0.02)


@pytest.mark.parametrize("degrees", [25, 45, 60, 75, 90, 120, 180])
def test_the_weave_for_any_joint_weaves_in_all_of_the_smallest_gap(degrees):
    weave = any_joint(math.radians(degrees))
    assert weave.stretch is not None
    woven = weave.ring_ratio * math.radians(min(degrees, 90))
    assert weave.stretch <= woven < weave.stretch + 0.02


@given(st.floats(25, 180), st.floats(0, 1e-3))
def test_the_weave_for_any_joint_hardly_changes_with_its_gap(degrees, more):
    one, other = (any_joint(math.radians(gap)) for gap in (degrees, degrees + more))
    assert np.allclose(one.shape, other.shape, rtol=0, atol=0.012)


def test_edges_too_near_each_other_for_any_ring_are_refused():
    with pytest.raises(InputError, match=r"edges 20 degrees apart: must be at least 25, or"):
        any_joint(math.radians(20))


def test_turned_about_the_axis():
    one, other = curve(), SiteCurve(Weave(**GOOD), 0.3, GAP / 2, GAP / 2, 60)
    c, s = math.cos(0.3), math.sin(0.3)
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    assert np.allclose(other.turn, turn, atol=1e-15)
    u = np.linspace(-1, 1, 9)
    assert np.allclose(other.points(u), one.points(u) @ turn, atol=1e-14)


@pytest.mark.parametrize("samples", [60, 120, 240])
@pytest.mark.parametrize("after", [GAP / 2, GAP / 3])
def test_a_distance_is_between_what_the_nearest_sample_tells(samples, after):
    site = SiteCurve(Weave(**GOOD), 0.4, after, GAP / 2, samples)
    points = np.random.default_rng(3).uniform([-3, -3, -0.6], [3, 3, 0.6], (4000, 3))
    exact, (far, near) = site.distance(points)[0], site.from_sample(points)
    assert np.allclose(far, np.linalg.norm(points - site.points(near), axis=1), atol=1e-7)
    assert (exact <= far + 1e-7).all()
    assert (exact >= site.at_least(far) - 1e-7).all()
    # Both are close to it, so that few points are left whose nearest curve they do not tell.
    assert (far - site.at_least(far)).mean() < 30 / samples**2


def test_distance_from_a_straight_curve_by_hand():
    line = curve(amplitude=0.0, bend=0.0, samples=7)
    end = 0.8 * GAP * 1.5
    points = np.array([[1.5, 0.3, 0.2], [1.1, -0.7, 0.0], [1.5, end + 0.3, 0.4]])
    distance, gradient = line.distance(points)
    assert np.allclose(distance, [0.2, 0.4, 0.5], atol=1e-14)
    assert np.allclose(gradient, [[0, 0, 1], [-1, 0, 0], [0, 0.6, 0.8]], atol=1e-13)


@given(
    st.floats(1.2, 2.5),
    st.floats(0.3, 1.1),
    st.floats(0.0, 0.4),
    st.floats(0.0, 1.0),
    st.sampled_from([None, 1.0, 2.0]),
    st.integers(0, 2**32 - 1),
)
def test_distance_is_that_from_the_nearest_of_many_samples(ring, span, lift, bend, stretch, seed):
    weave = Weave(ring, span, lift, bend, 1.2, stretch=stretch)
    site = SiteCurve(weave, 0.0, GAP / 2, GAP / 2 - 0.35, 240)
    points = np.random.default_rng(seed).uniform([0, -2, -0.5], [ring + 0.5, 2, 0.5], (40, 3))
    found, gradient = site.distance(points)
    dense = site.points(np.linspace(-1, 1, 4001))
    sampled = np.linalg.norm(points[:, None] - dense, axis=2).min(axis=1)
    spacing = np.linalg.norm(np.diff(dense, axis=0), axis=1).max()
    # No sample is nearer; the nearest is half a spacing beside the nearest point, along a curve
    # that may bend towards the point: a whole spacing is enough for that.
    assert (found <= sampled + 1e-12).all()
    assert (sampled <= np.hypot(found, spacing) + 1e-9).all()
    assert np.allclose(np.linalg.norm(gradient, axis=1)[found > 1e-6], 1, atol=1e-9)


def test_gradient_is_the_slope_of_the_distance():
    site = curve(samples=240)
    points = np.random.default_rng(1).uniform([0.9, -1, -0.5], [2, 1, 0.5], (50, 3))
    _, gradient = site.distance(points)
    step = 1e-6
    for axis in range(3):
        shift = step * np.eye(3)[axis]
        slope = (site.distance(points + shift)[0] - site.distance(points - shift)[0]) / (2 * step)
        assert np.allclose(slope, gradient[:, axis], atol=1e-6)
