"""Play against what a person can work out, and against parts with real gaps."""

import numpy as np
import puzzles
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.play import loosest, measured

GAP = 0.004


def boxed(gap=GAP):
    """A cube of half side 1 in a box, with its contacts."""
    meshes = puzzles.cube_in_box(gap)
    return meshes, make_assembly(meshes, find_contacts(meshes, 0.01), (0,))


@given(st.floats(1, 20), st.integers(0, 2))
def test_a_lever_in_a_box_multiplies_the_gap(length, axis):
    """The cube turns, and the lever's tip goes length times as far across it."""
    _, assembly = boxed()
    tips = np.stack([np.zeros(3), length * np.eye(3)[axis]])
    # To 0.5 %: the contacts are in the middle of the gap, a little farther out than the cube.
    assert loosest(assembly, tips)[0] == pytest.approx(length, rel=5e-3)


def test_the_middle_of_a_cube_moves_by_the_gap():
    _, assembly = boxed()
    assert loosest(assembly, np.zeros((2, 3)))[0] == pytest.approx(1, rel=1e-6)


@pytest.mark.parametrize("gap", [0.004, 0.001])
def test_play_is_what_parts_with_a_gap_can_really_do(gap):
    meshes, assembly = boxed(gap)
    tips = np.array([[0, 0, 0], [5.0, 0, 0]])
    _, steps, _ = loosest(assembly, tips)
    assert measured(meshes, assembly.middles, steps, gap) == pytest.approx(1, abs=0.03)


def test_the_solver_is_silent(capfd):
    _, assembly = boxed()
    loosest(assembly, np.ones((2, 3)))
    assert capfd.readouterr() == ("", "")


def test_one_tip_alone_goes_as_far_as_among_all():
    """Each program starts from where the one before ended; that changes no answer."""
    _, assembly = boxed()
    tips = np.array([[0, 0, 0], [5.0, 2.0, 1.0]])
    alone = [loosest(assembly, tips, [(1, n)]).travel for n in range(6)]
    assert loosest(assembly, tips).travel == pytest.approx(max(alone), rel=1e-9)
    assert loosest(assembly, tips, [(1, n) for n in range(5, -1, -1)]).travel == pytest.approx(
        max(alone), rel=1e-9
    )


def test_what_slides_has_no_end():
    meshes = puzzles.peg_in_tube()
    assembly = make_assembly(meshes, find_contacts(meshes, 0.01), (0,))
    travel, steps, _ = loosest(assembly, np.full((2, 3), 1.5))
    assert np.isinf(travel)
    assert not steps.any()


def test_play_does_not_depend_on_size_or_place():
    meshes = puzzles.three_rods()
    plain = make_assembly(meshes, find_contacts(meshes, 0.01), (0,))
    tips = np.tile([1.0, 1.0, 4.0], (3, 1))
    shift = np.array([3.0, 1.0, 7.0])
    moved = [(10 * (points + shift), triangles) for points, triangles in meshes]
    there = make_assembly(moved, find_contacts(moved, 0.1), (0,))
    found, *_ = loosest(there, 10 * (tips + shift))
    assert np.isfinite(found)
    assert found == pytest.approx(loosest(plain, tips)[0], rel=1e-6)
