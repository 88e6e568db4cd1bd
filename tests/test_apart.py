"""What comes apart is taken apart; what does not is locked, captive or not settled."""

import burrs
import mechanisms
import numpy as np
import puzzles
import pytest

from scadgen.interlock.apart import take_apart
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import default_tolerance, find_contacts
from scadgen.interlock.path import replay
from scadgen.interlock.round import round_motions
from scadgen.interlock.verdict import Certificate, Motion, verdict

#: Burrs of pieces of published sets, by the numbers of their pieces.
BURRS = [
    (52, 824, 871, 943, 960, 992),
    (52, 824, 871, 911, 928, 1024),
    (103, 256, 824, 911, 956, 992),
    (52, 188, 824, 928, 975, 1024),
    (52, 256, 871, 943, 956, 992),
    (1, 256, 824, 960, 975, 992),
    (1, 256, 824, 928, 975, 1024),
    (103, 188, 824, 943, 956, 1024),
    (52, 188, 824, 975, 992, 1007),
    (1, 824, 871, 956, 992, 1024),
    (1, 52, 960, 992, 1007, 1024),
    (52, 824, 911, 928, 992, 1007),
    (1, 188, 824, 1007, 1024, 1024),
    (52, 256, 911, 943, 992, 1007),
    (52, 188, 824, 911, 992, 1024),
    (52, 103, 188, 928, 1024, 1024),
    (52, 188, 871, 928, 956, 1024),
    (52, 188, 256, 928, 943, 992),
    (1, 256, 824, 911, 992, 1024),
]


def taken(meshes, held=(), near=None, **options):
    near = near or default_tolerance(meshes)
    return take_apart(meshes, find_contacts(meshes, near), near, held, **options)


@pytest.mark.parametrize("numbers", BURRS, ids=str)
def test_burrs_are_locked_and_come_apart_as_their_cells_say(numbers):
    parts = dict(enumerate(burrs.assembled(numbers)))
    rng = np.random.default_rng(sum(numbers))
    meshes, _ = puzzles.placed(burrs.meshes_of(numbers), rng)
    contacts = find_contacts(meshes, default_tolerance(meshes))
    found = verdict(make_assembly(meshes, contacts, (0,)))
    # Flush cells leave no room to turn: what cannot shift by a cell is locked.
    assert isinstance(found, Motion) == bool(burrs.shifts(parts, 1))
    straight = taken(meshes, steps=0)
    assert (straight.answer == "apart") == burrs.comes_apart_straight(parts)
    if not burrs.shifts(parts, 1):
        assert taken(meshes).answer == "locked"


def test_what_parts_three_and_three_is_taken_out_as_a_group():
    numbers = BURRS[0]
    groups = {group for group, _ in burrs.shifts(dict(enumerate(burrs.assembled(numbers))), 12)}
    assert {len(group) for group in groups} == {3}
    found = taken(burrs.meshes_of(numbers), steps=0)
    assert frozenset(found.removals[0].parts) in groups
    assert found.answer == "apart"


def test_a_key_comes_out_on_a_way_that_is_clear():
    meshes = puzzles.three_piece_burr()
    found = taken(meshes, steps=0)
    assert [removal.parts for removal in found.removals] == [(2,), (1,)]
    assert found.answer == "apart"
    for removal in found.removals:
        moving, fixed = ([meshes[n] for n in group] for group in (removal.parts, removal.left))
        assert replay(removal.path, moving, fixed, 0.013) < 1e-9


def test_held_parts_stay_together():
    meshes = puzzles.three_piece_burr()
    assert taken(meshes, held=(0, 1), steps=0).answer == "apart"
    assert [r.parts for r in taken(meshes, held=(2,), steps=0).removals] == [(0, 1), (1,)]
    assert taken(meshes, held=(0, 2)).answer == "locked"


def test_a_cube_in_a_closed_box_is_captive_and_how_far_it_goes_is_told():
    meshes = puzzles.cube_in_box(0.4)
    found = taken(meshes, near=0.01)
    (left,) = found.left
    assert found.answer == left.answer == "captive"
    # To a corner at most, by the gap along each axis.
    assert 0.3 < left.shift < 0.4 * 3**0.5 + 0.05
    assert left.tries > 50


def test_a_search_that_has_no_steps_left_settles_nothing():
    plate, rod = puzzles.cube_in_box(0.4)
    found = taken([plate, rod], near=0.01, steps=30)
    assert found.answer == "not settled"


def test_the_same_input_is_taken_apart_alike():
    meshes, _ = puzzles.placed(puzzles.three_piece_burr(), np.random.default_rng(5))
    one, again = (taken(meshes) for _ in range(2))
    assert [r.parts for r in one.removals] == [r.parts for r in again.removals]
    assert all(
        a.path.poses.tobytes() == b.path.poses.tobytes()
        for a, b in zip(one.removals, again.removals, strict=True)
    )


# --------------------------------------------------------------------------- mechanisms


def turning(meshes, turn, size=1.0):
    """How the second part begins to move: nothing, or its turn about z and its way along it."""
    near = default_tolerance(meshes)
    contacts = find_contacts(meshes, near)
    found = verdict(make_assembly(meshes, contacts, (0,)))
    if isinstance(found, Certificate):
        (found,) = round_motions(meshes, contacts, near, [(1,)])
    if found is None:
        return None
    return (found.rotations[0] @ turn[:, 2]) * size, found.translations[0] @ turn[:, 2]


@pytest.mark.parametrize("gap", [0.0, 0.1])
@pytest.mark.parametrize("facets", [8, 10, 16, 23, 32, 64])
def test_mechanisms_move_as_a_hand_finds(facets, gap):
    rng = np.random.default_rng(facets)

    def of(meshes):
        placed, turn = puzzles.placed(meshes, rng)
        return turning(placed, turn)

    about, _ = of(mechanisms.hinge(facets, gap))
    assert about
    assert of(mechanisms.keyed_hinge(facets, gap)) is None
    about, along = of(mechanisms.plain_pin(facets, gap))
    assert along > 0
    about, _ = of(mechanisms.pin_at_stop(facets, gap))
    assert about < 0
    about, _ = of(mechanisms.bayonet(facets, gap))
    assert about > 0


@pytest.mark.parametrize("gap", [0.0, 0.1])
@pytest.mark.parametrize("facets", [16, 32])
def test_a_seated_screw_turns_out_and_not_in(facets, gap):
    meshes, turn = puzzles.placed(mechanisms.screw(facets, gap), np.random.default_rng(facets))
    about, along = turning(meshes, turn)
    assert about > 0
    assert along > 0


def test_a_screw_is_unscrewed():
    meshes, turn = puzzles.placed(mechanisms.screw(16, 0.1), np.random.default_rng(2))
    found = taken(meshes)
    assert found.answer == "apart"
    (removal,) = found.removals
    path = removal.path
    gone = path.poses[-1, :3, :3] @ path.middle + path.poses[-1, :3, 3] - path.middle
    # Out of the block's 16 mm, not far beyond, up the way that its head looks.
    high = float(np.ptp(meshes[0][0] @ turn[:, 2]))
    assert 0.9 * high < gone @ turn[:, 2] < 1.6 * high


def test_links_of_a_chain_stay_linked():
    found = taken(mechanisms.chain(10, 2), near=0.05)
    assert found.answer == "captive"
    assert found.left[0].parts == (0, 1)


def test_a_ball_stays_in_its_cage():
    found = taken(mechanisms.caged_ball(10, 0.2), near=0.3)
    assert found.answer == "captive"
