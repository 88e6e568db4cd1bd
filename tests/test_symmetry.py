"""Which edges of a joint are alike, by hand; and kits hold to it however frames are rounded."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kits import drawn, joint, regular

from scadgen.errors import InputError
from scadgen.joint.joint import DETAILS, make_joint
from scadgen.joint.spokes import Spokes
from scadgen.joint.surface import Surface, half_turn
from scadgen.joint.symmetry import Symmetry, lopsided
from scadgen.joint.weave import any_joint
from scadgen.kit.build import build
from scadgen.plane.drawn import make_frame

TURN = 2 * math.pi


@pytest.mark.parametrize(
    ("gaps", "keys", "expected"),
    [
        ([120, 120, 120], [0], [False, False, False]),
        ([120, 120, 120], [0, 1], [True, False, False]),  # between two keys
        ([120, 120, 120], [0, 1, 2], [True, True, True]),
        ([200, 100, 60], [2], [True, False, False]),  # wide, and beside no key
        ([200, 100, 60], [0], [False, False, False]),  # the key is on one side of it
        ([180, 100, 80], [2], [False, False, False]),  # straight is not wide
    ],
)
def test_lopsided_gaps_by_hand(gaps, keys, expected):
    assert lopsided(np.radians(gaps), keys).tolist() == expected


def test_keys_leave_of_a_symmetry_what_they_have_themselves():
    gaps = np.radians([60, 120, 60, 120])
    whole = Symmetry(4, 2, 1)  # two turns, and turned over edge 0 lies where 1 was
    assert whole.with_keys([], gaps) == whole
    assert whole.with_keys([0], gaps) == Symmetry(4, 4, None)
    assert whole.with_keys([0, 2], gaps) == Symmetry(4, 2, None)
    # Turned over, two keys side by side change places; but the gap between them is lopsided.
    assert whole.with_keys([0, 1], gaps) == Symmetry(4, 4, None)
    even = Symmetry(3, 1, 0)
    assert even.with_keys([1], np.radians([120, 120, 120])) == Symmetry(3, 3, 2)


@given(st.lists(st.floats(-20, 20), min_size=1, max_size=9), st.sampled_from([1, 2, 3, 6]))
def test_the_least_turn_is_less_than_a_step_and_off_by_whole_ones(turns, count):
    symmetry, step = Symmetry(6, 6 // count, None), TURN / count
    least, steps = symmetry.least_turn(np.array(turns), 1e-9)
    assert (least >= -1e-9 - 1e-12).all()
    assert (least < step).all()
    assert np.allclose(least + steps * step, turns, rtol=0, atol=1e-12)


def renumbered(surface, seed):
    order = np.random.default_rng(seed).permutation(len(surface.points))
    place = np.argsort(order)
    outlines = {facet: place[sides][::-1] for facet, sides in surface.outlines.items()}
    return Surface(surface.points[order], np.roll(place[surface.walls], 1, axis=1), outlines)


def test_surfaces_are_alike_by_their_shape_alone():
    whole = joint("hexagonal").connectors[0]
    assert whole.match(renumbered(whole, 4)) is not None
    assert whole.match(half_turn(half_turn(whole))) is not None
    moved = whole.points.copy()
    moved[17] += 1e-3
    assert whole.match(Surface(moved, whole.walls, whole.outlines)) is None
    assert whole.match(Surface(whole.points, whole.walls[:, ::-1], whole.outlines)) is None
    bent = make_joint(Spokes.flat([0.0, 2.0, 4.0]), any_joint(2.0), DETAILS["draft"], keys=[0])
    assert bent.connectors[0].match(bent.connectors[1]) is None
    mirror = Surface(whole.points * [1, -1, 1], whole.walls[:, ::-1], whole.outlines)
    assert whole.match(mirror) is None


@st.composite
def stars(draw):
    """A joint that is nearly alike when turned or turned over, with its edges' other ends."""
    some = draw(st.lists(st.floats(0.5, 2.0), min_size=1, max_size=3))
    gaps = draw(st.sampled_from([some * 2, some * 3, some + some[::-1], [*some, 1, *some[::-1]]]))
    gaps = np.array(gaps) * TURN / sum(gaps)
    off = draw(st.sampled_from([0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3]))
    turns = draw(st.floats(0, TURN)) + np.append(0, np.cumsum(gaps)[:-1])
    ends = 200 * np.column_stack([np.cos(turns), np.sin(turns)])
    points = np.vstack([[0, 0], ends + off * np.random.default_rng(len(gaps)).normal(size=(1, 2))])
    points[1:] += 200 * off * np.sin(np.outer(np.arange(len(gaps)), [3, 5]))
    return gaps.min(), points


@settings(max_examples=20)
@given(stars(), st.sampled_from(["caps", "open"]))
def test_what_is_alike_by_angles_and_keys_is_one_part_however_it_is_rounded(star, rim):
    """Or an invariant would say so; with edges too near each other it is refused, with words."""
    narrowest, points = star
    frame = make_frame("star", points, [[0, n] for n in range(1, len(points))])
    wanted = drawn("star", frame, resizable=True, rim=rim)
    if narrowest < math.radians(24.9):
        with pytest.raises(InputError, match="degrees"):
            build(wanted)
    elif narrowest > math.radians(25.1):
        assert len(build(wanted).elements) <= len(frame.edges)


def test_a_regular_joint_is_one_connector_and_one_half():
    made = make_joint(Spokes.flat(regular(3)), any_joint(TURN / 3), DETAILS["draft"], keys=[0])
    assert made.alike == ((0, False), (1, False), (1, True))
    assert made.halves[0][0].match(half_turn(made.halves[0][1])) is not None
