"""The checks of locking can fail, and say what moves."""

import re
from itertools import product

import numpy as np
import puzzles
import pytest
from kits import grid, kit

from scadgen.check.locking import (
    connectors_lock,
    joint_locks,
    largest_play,
    only_the_peg_moves,
    only_these_move,
)
from scadgen.check.proof import proved
from scadgen.errors import GeometryError
from scadgen.interlock.contacts import find_contacts
from scadgen.joint.weave import Weave
from scadgen.kit.build import build, build_joint

#: Arms that hardly weave.
LOOSE = Weave(1.54, 0.67, 0.23, 0.26, 0.81, name="loose")


def of_joint(check, made):
    """A check of a kit's only joint."""
    (joint,) = made.joints
    return check(made, joint)


@pytest.mark.parametrize("key", ["fixed", "loose"])
@pytest.mark.parametrize("frame", ["hexagonal", "square"])
def test_built_in_joints_lock_but_for_the_peg(frame, key):
    results = {r.check: r for r in of_joint(joint_locks, kit(frame, key, bore=0.0, detail="draft"))}
    assert all(result.good for result in results.values())
    assert results["in the joint only the peg moves"].figure == "the peg, along its axis"
    assert len(results) == 8


def test_a_joint_that_hardly_weaves_is_not_locked():
    made = build(grid("square", detail="draft", weave=LOOSE))
    result = of_joint(connectors_lock, made)
    assert not result.good
    assert "can move" in result.figure
    assert not all(found.good for found in of_joint(only_the_peg_moves, made))
    assert of_joint(largest_play, made) == float("inf")
    with pytest.raises(GeometryError, match="whole connectors lock: 3 parts can move"):
        proved(made)


def pegged(sockets, *, lid):
    """A block in a well, with a peg in each socket from above: what is found of its pegs."""
    block = puzzles.cells((1, 7), (1, 4), (1, 4))
    pegs = [puzzles.cells((x, x + 1), (2, 3), (2, 6)) for x in sockets]
    well = puzzles.cells((0, 8), (0, 5), (0, 4 + lid)) - block
    parts = [well.difference(*pegs), block.difference(*pegs), *pegs]
    meshes = [puzzles.voxels(cells) for cells in parts]
    axes = {n: np.array([0.0, 0.0, 1.0]) for n in range(2, len(meshes))}
    names = ["well", "block", *("peg" for _ in pegs)]
    found = only_these_move(meshes, find_contacts(meshes, 1e-3), (0,), axes, names)
    return [result.good for result in found]


@pytest.mark.parametrize("sockets", [(3,), (2, 5)])
def test_pegs_that_take_the_block_along_do_not_hold_it(sockets):
    """Each peg slides alone, and locks the block while it is held; but all lift out together."""
    assert pegged(sockets, lid=False) == [True, True, False]
    assert pegged(sockets, lid=True) == [True, True, True]


def test_a_peg_that_only_turns_does_not_move_along_its_axis():
    """A plug of 64 sides, shut in from above and below."""
    angle = 2 * np.pi * np.arange(64) / 64
    plug = puzzles.hull([(np.cos(a), np.sin(a), z) for a, z in product(angle, (0.0, 1.0))])
    hole = puzzles.without(puzzles.voxels(puzzles.cells((-2, 2), (-2, 2), (-1, 2))), plug)
    meshes = [hole, plug]
    axes = {1: np.array([0.0, 0.0, 1.0])}
    contacts = find_contacts(meshes, 1e-3)
    moves = next(only_these_move(meshes, contacts, (0,), axes, ["hole", "plug"]))
    assert not moves.good


def test_tighter_weaves_have_less_play():
    tight, loose = (
        of_joint(largest_play, build_joint(3, Weave(*shape), "fixed", "draft"))
        for shape in ((1.555, 0.817, 0.43, 0.691, 1.516), (1.504, 0.848, 0.336, 0.604, 1.409))
    )
    assert tight < loose < 40


def test_play_is_what_pieces_really_have():
    *_, result = of_joint(joint_locks, kit("hexagonal", detail="standard"))
    assert result.check == "play measured on the pieces"
    assert result.good
    first, own = (float(x) for x in re.findall(r"([\d.]+) at [\d.]+ mm", result.figure))
    by_faces = float(result.figure.split()[-4])
    assert first == pytest.approx(by_faces, abs=0.1)
    assert own == pytest.approx(by_faces, rel=0.1)
