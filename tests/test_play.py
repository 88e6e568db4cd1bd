"""Play against what a person can work out, and against parts with real gaps."""

import numpy as np
import puzzles
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.play import play
from scadgen.solid.gap import overlap_volume

GAP = 0.004


def boxed(gap=GAP):
    """A cube of half side 1 in a box, with its contacts."""
    meshes = puzzles.cube_in_box(gap)
    return meshes, make_assembly(meshes, find_contacts(meshes, 0.01), (0,))


@given(st.floats(1, 20), st.integers(0, 2))
def test_a_lever_in_a_box_multiplies_the_gap(length, axis):
    """Along the lever a gap is a gap; across it the cube turns, and its tip goes length times
    as far.
    """
    _, assembly = boxed()
    tip = length * np.eye(3)[axis]
    # To 0.5 %: the contacts are in the middle of the gap, a little farther out than the cube.
    expected = np.where(np.arange(3) == axis, 1.0, length)
    assert play(assembly, 1, tip) == pytest.approx(np.stack([expected] * 2), rel=5e-3)


def test_the_middle_of_a_cube_moves_by_the_gap():
    _, assembly = boxed()
    assert play(assembly, 1, np.zeros(3)) == pytest.approx(np.ones((2, 3)), rel=1e-6)


@pytest.mark.parametrize("gap", [0.004, 0.001])
def test_play_is_what_parts_with_a_gap_can_really_do(gap):
    meshes, assembly = boxed(gap)
    length = 5.0
    travel = play(assembly, 1, np.array([length, 0, 0]))[1, 1] * gap

    def entered(share):
        angle = share * travel / length
        c, s = np.cos(angle), np.sin(angle)
        turned = meshes[1][0] @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        return overlap_volume(*meshes[0], turned, meshes[1][1])

    assert entered(0.97) == 0
    assert entered(1.03) > 0


def test_what_slides_has_no_end():
    meshes = puzzles.peg_in_tube()
    assembly = make_assembly(meshes, find_contacts(meshes, 0.01), (0,))
    travel = play(assembly, 1, np.array([1.5, 1.5, 1.5]))
    assert np.isinf(travel[:, 2]).all()
    assert travel[:, :2] == pytest.approx(np.ones((2, 2)))


def test_play_does_not_depend_on_size_or_place():
    meshes = puzzles.three_rods()
    plain = make_assembly(meshes, find_contacts(meshes, 0.01), (0,))
    tip = np.array([1.0, 1.0, 4.0])
    shift = np.array([3.0, 1.0, 7.0])
    moved = [(10 * (points + shift), triangles) for points, triangles in meshes]
    there = make_assembly(moved, find_contacts(moved, 0.1), (0,))
    found = play(there, 2, 10 * (tip + shift))
    assert np.isfinite(found).all()
    assert found == pytest.approx(play(plain, 2, tip), rel=1e-6)


def test_a_held_part_has_no_play():
    _, assembly = boxed()
    with pytest.raises(InputError, match="part = 0"):
        play(assembly, 0, np.zeros(3))
