"""Joints of any angles come apart on ways that need no search."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from kits import drawn, once

from scadgen.check.disassembly import come_apart
from scadgen.check.geometry import placed
from scadgen.check.opening_motions import Openings
from scadgen.interlock.path import replay
from scadgen.kit.build import build
from scadgen.plane.drawn import make_frame


def star(*gaps):
    """A kit of one vertex with long edges, by the gaps between them in degrees."""
    turns = np.radians(np.cumsum([0, *gaps])[:-1])
    ends = 900 * np.column_stack([np.cos(turns), np.sin(turns)])
    edges = [[0, n + 1] for n in range(len(gaps))]
    frame = make_frame("star", np.vstack([[0, 0], ends]), edges)
    return build(drawn("star", frame, rim="open"))


def made(*gaps):
    kit = once(f"star-{'-'.join(map(str, gaps))}", lambda _: star(*gaps))
    return kit, next(joint for joint in kit.joints if not joint.caps)


UNEVEN = (25.5, 120, 214.5), (90, 90, 180), (40, 50, 60, 70, 140)


@pytest.mark.parametrize("gaps", UNEVEN)
def test_every_piece_comes_out_without_a_search(gaps):
    kit, joint = made(*gaps)
    found = list(come_apart(kit, joint, steps=0))
    assert all(result.good for result, _ in found)
    # The peg, two halves, and all connectors but the last.
    assert len(found) == 3 + (len(gaps) - 1) - 1
    assert sorted(n for _, way in found for n in way.moving) == sorted(
        {n for _, way in found for n in way.moving}
    )


def test_what_comes_out_overlaps_nothing_when_it_is_moved_again():
    kit, joint = made(90, 90, 180)
    meshes = [placed(kit, place, kit.values) for place in joint.pieces]
    present = set(range(len(meshes)))
    for _, way in come_apart(kit, joint, steps=0):
        (piece,) = way.moving
        others = [meshes[n] for n in sorted(present - {piece})]
        path = way.path.scaled(kit.values["side"])
        assert replay(path, [meshes[piece]], others, 0.1) < 1e-9
        present -= {piece}


def test_a_connector_between_two_others_has_no_opening():
    kit, joint = made(40, 50, 60, 70, 140)
    caps = [n for n, place in enumerate(joint.pieces) if place.role == "cap"]
    openings = Openings(kit, joint)
    assert not list(openings.paths(caps[1], set(caps)))
    assert list(openings.paths(caps[0], set(caps)))


@settings(max_examples=3)
@given(st.lists(st.floats(26, 150), min_size=2, max_size=4))
def test_joints_of_any_angles_come_apart(gaps):
    rest = 360 - math.fsum(gaps)
    assume(rest > 26)
    kit = star(*gaps, rest)
    joint = next(joint for joint in kit.joints if not joint.caps)
    assert all(result.good for result, _ in come_apart(kit, joint, steps=0))
