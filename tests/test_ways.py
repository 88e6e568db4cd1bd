"""Joints come apart on ways that are proved again, and kits carry them."""

import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from kits import grid, kit, mesh, proved_kit, regular
from shapes import box, torus
from stub_kit import stub_kit, with_joint

import scadgen.joint.joint as joints
from scadgen.check import disassembly
from scadgen.check.disassembly import come_apart
from scadgen.check.joint_contacts import whole_contacts
from scadgen.check.locking import TIP
from scadgen.check.proof import proved
from scadgen.check.stored_paths import known_ways
from scadgen.errors import GeometryError, InputError, KitError
from scadgen.frame.placement import Place, Placement
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.escape import escape
from scadgen.interlock.path import Path, narrowest, replay
from scadgen.interlock.play import loosest
from scadgen.interlock.verdict import Certificate, Motion, verdict
from scadgen.joint.joint import DETAILS, make_joint
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import BUILT_IN, Weave
from scadgen.kit.build import build
from scadgen.kit.model import Way
from scadgen.kit.store import dumps, loads
from scadgen.solid.pose import Pose

STAGES = {
    "hexagonal": ["the peg", "half A", "half B", "2 connectors"],
    "square": ["the peg", "half A", "half B", "3 connectors", "2 connectors"],
}


@pytest.mark.parametrize("key", ["fixed", "loose"])
@pytest.mark.parametrize("frame", list(STAGES))
@pytest.mark.parametrize("detail", ["draft", "standard"])
def test_built_in_joints_come_apart_on_known_ways(frame, key, detail):
    made = kit(frame, key, detail=detail)
    found = list(come_apart(made, made.joints[0], known_ways(made, made.joints[0]), steps=0))
    assert all(result.good for result, _ in found)
    assert [result.check.split(" come")[0] for result, _ in found] == STAGES[frame]


@pytest.mark.parametrize("side", [5.0, 25.0])
def test_known_ways_hold_at_any_size_and_with_a_bore(side):
    values = {"side": side, "clearance": 0.03 * side, "bore": 0.15 * side}
    made = build(grid("hexagonal", "loose", detail="draft", values=values))
    assert all(
        result.good
        for result, _ in come_apart(made, made.joints[0], known_ways(made, made.joints[0]), steps=0)
    )


def test_a_kit_carries_what_is_proved_of_it():
    made = proved_kit("hexagonal")
    assert len(made.joints[0].ways) == 4
    assert "half A comes out" in made.joints[0].verdicts
    assert "play of a tube's tip" in made.joints[0].verdicts
    again = loads(dumps(made))
    assert dumps(again) == dumps(made)
    # Read back, its own ways are enough.
    assert all(
        result.good
        for result, _ in come_apart(again, again.joints[0], again.joints[0].ways, steps=0)
    )


def test_a_way_through_a_wall_is_not_believed_and_another_is_found():
    made = proved_kit("hexagonal")
    peg, half, *_ = made.joints[0].ways
    lifted = np.zeros((2, 6))
    lifted[1, 2] = 10.0
    through = replace(half, path=Path.through(lifted, half.path.middle))
    (_, first), (result, second), *_ = come_apart(made, made.joints[0], [peg, through])
    assert first is peg
    assert result.good
    assert second is not through
    assert len(second.path.poses) > 2


def test_a_joint_without_clearance_is_not_proved_to_come_apart():
    made = build(grid("hexagonal", detail="draft", values={"clearance": 0, "peg_clearance": 0}))
    with pytest.raises(
        GeometryError, match=r"comes out: none found in \d+ tries, must be.*more clearance"
    ):
        proved(made)


@pytest.fixture
def _linked_rings(monkeypatch):
    """A joint of four connectors: two linked rings that nothing takes apart, and two boxes."""
    ring, faces = torus(24, 12)
    upright = ring[:, [0, 2, 1]] * (1, 1, -1) + (3, 0, 0)
    boxes = [box((x, 0, 0), (x + 1, 1, 1)) for x in (20, 22)]
    shapes = [(ring, faces), (upright, faces), *boxes]
    monkeypatch.setattr(disassembly, "pieces", lambda *_: shapes)
    monkeypatch.setattr(disassembly, "tubes", lambda *_: {})


def of_four_connectors(known=(), **options):
    four = tuple(
        Placement("connector", "cap", Pose.flat((0, 0), 90.0 * n), (Place(0, n),)) for n in range(4)
    )
    made = with_joint(stub_kit("square"), pieces=four)
    return list(come_apart(made, made.joints[0], known, **options))


@pytest.mark.usefixtures("_linked_rings")
def test_connectors_that_leave_as_one_are_not_apart():
    together = Path.through(np.array([np.zeros(6), [0, 0, 40, 0, 0, 0]], dtype=float), np.zeros(3))
    known = [Way("4 connectors come apart", (0, 1), together)]
    found = of_four_connectors(known, steps=50)
    assert [way.moving for _, way in found if way] == [(2,), (3,)]
    assert not found[-1][0].good


@pytest.mark.usefixtures("_linked_rings")
def test_a_stage_is_given_up_after_its_steps_and_says_what_was_tried():
    *_, (result, _) = of_four_connectors(steps=20)
    assert result.check == "2 connectors come apart"
    assert re.fullmatch(r"none found in [1-9]\d* tries, not finished", result.figure)


def damaged(change):
    document = json.loads(dumps(proved_kit("hexagonal")))
    change(document["joints"][0]["ways"][0])
    return json.dumps(document)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda way: way["moving"].append(9), "moves pieces that are not there then"),
        (lambda way: way["steps"][0].pop(), "way 'the peg comes out'|inhomogeneous"),
        (lambda way: way.pop("middle"), "'middle' is a required property"),
    ],
)
def test_a_kit_with_a_broken_way_is_refused(change, words):
    with pytest.raises(KitError, match=words):
        loads(damaged(change))


# A peg of 1 x 1 x 3 stands in a socket 1.2 wide; it can be lifted, or pushed aside first.
PEG = box((0.1, 0.1, 0.1), (1.1, 1.1, 3.1))
WALLS = [
    box((-1, -1, -1), (2.2, 2.2, 0)),
    box((-1, -1, 0), (0, 2.2, 2)),
    box((1.2, -1, 0), (2.2, 2.2, 2)),
]


def moved(*shifts):
    steps = np.zeros((len(shifts), 6))
    steps[:, :3] = shifts
    return Path.through(steps, np.array([0.6, 0.6, 1.6]))


def test_the_narrowest_gap_of_a_straight_way():
    up = moved((0, 0, 0), (0, 0, 4))
    assert narrowest(up, [PEG], WALLS, least=0.01, look=1) == pytest.approx(0.1)
    assert narrowest(up, [PEG], WALLS, least=0.11, look=1) == 0
    aside = moved((0, 0, 0), (0.06, 0, 0), (0.06, 0, 4))
    assert narrowest(aside, [PEG], WALLS, least=0.01, look=1) == pytest.approx(0.04)


def test_the_proof_sees_what_stands_between_two_poses():
    """A wall a thousandth thick between the first pose and the second."""
    wall = box((5, -5, -5), (5.001, 5, 5))
    over = moved((0, 0, 0), (10, 0, 0))
    assert narrowest(over, [PEG], [wall], least=1e-4, look=1) == 0
    assert replay(over, [PEG], [wall], 20) == 0
    past = moved((0, 0, 0), (0, 0, 8), (10, 0, 8))
    assert narrowest(past, [PEG], [wall], least=1e-4, look=1) == pytest.approx(1)


def test_what_is_no_way_out_is_not_proved():
    stay = moved((0, 0, 0), (0, 0, 1))
    assert narrowest(stay, [PEG], WALLS, least=0.01, look=1) == 0
    with pytest.raises(InputError, match="must be above 0"):
        narrowest(stay, [PEG], WALLS, least=0, look=1)


def pieces_of(shape):
    """Halves and whole connectors of a joint without clearance, where they stand, in sides."""
    made = make_joint(Spokes.flat(regular(3)), Weave(*shape), DETAILS["draft"])
    whole = []
    for angle, surface in zip(made.spokes.azimuths, made.connectors, strict=True):
        points, triangles = mesh(surface)
        c, s = math.cos(angle), math.sin(angle)
        whole.append((points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), triangles))
    return [mesh(half) for half in made.halves[0]], whole


def judged(meshes, held):
    return verdict(make_assembly(meshes, find_contacts(meshes, 1e-3), held))


@pytest.fixture
def _whole_rings(monkeypatch):
    """Judge weaves that do not leave a tube all of its face, as long as no tube is there."""
    monkeypatch.setattr(joints, "check_footprint", lambda *_: None)


@pytest.mark.usefixtures("_whole_rings")
def test_a_weave_that_locks_and_comes_apart_without_clearance():
    (first, second), whole = pieces_of((1.694, 0.961, 0.25, 0.695, 1.53))
    assert isinstance(judged(whole, (0,)), Certificate)
    for moving, fixed in (
        (first, [second, *whole[1:]]),
        (second, whole[1:]),
        (whole[1], whole[2:]),
    ):
        tries = (escape([moving], fixed, seed=seed) for seed in range(1, 6))
        assert any(isinstance(found, Path) for found in tries)


@pytest.mark.usefixtures("_whole_rings")
def test_a_weave_that_is_tight_but_cannot_be_put_together():
    (first, second), whole = pieces_of((1.215, 0.966, 0.658, 0.618, 1.758))
    assert isinstance(judged(whole, (0,)), Certificate)
    # Half A is locked by the other pieces, though the peg is out.
    assert isinstance(judged([first, second, *whole[1:]], (1, 2, 3)), Certificate)


@pytest.mark.usefixtures("_whole_rings")
@pytest.mark.parametrize("shape", [(1.5, 0.9, 0.3, 1.0, 1.0), (1.5, 0.8, 0.15, 1.0, 1.0)])
def test_connectors_that_follow_the_ring_are_movable(shape):
    _, whole = pieces_of(shape)
    assert isinstance(judged(whole, (0,)), Motion)


def largest(made):
    """Play of the worst tip of a joint's whole connectors, along the worst axis."""
    tips = TIP * np.column_stack(
        [np.cos(made.spokes.azimuths), np.sin(made.spokes.azimuths), 0 * made.spokes.azimuths]
    )
    return loosest(make_assembly(*whole_contacts(made.lattice, made.curves), (0,)), tips)[0]


@pytest.mark.usefixtures("_whole_rings")
@pytest.mark.parametrize(
    ("count", "plausible"), [(3, (1.5, 0.9, 0.3, 0.65, 1.0)), (4, (1.5, 0.9, 0.15, 0.35, 1.0))]
)
def test_built_in_weaves_have_at_most_half_the_play_of_plausible_ones(count, plausible):
    ours, other = (
        largest(make_joint(Spokes.flat(regular(count)), weave, DETAILS["standard"]))
        for weave in (BUILT_IN[f"{count}-fixed"], Weave(*plausible))
    )
    assert ours < other / 2
