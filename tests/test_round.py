"""Round parts turn, though their facets lock; parts that are not round stay locked."""

import numpy as np
import puzzles
import pytest
from shapes import box

from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import default_tolerance, find_contacts
from scadgen.interlock.follow import first_touch, middle, moved, screw
from scadgen.interlock.round import round_motions, smooth_normals
from scadgen.interlock.verdict import Certificate, Motion, verdict


def found(meshes, *bodies, tolerance=None):
    near = tolerance or default_tolerance(meshes)
    contacts = find_contacts(meshes, near)
    return round_motions(meshes, contacts, near, bodies)


@pytest.mark.parametrize(("radius", "sides"), [(4.8, 100), (4.98, 36), (4.99, 64), (5.0, 64)])
def test_an_axle_turns_in_its_hub_anywhere(radius, sides):
    meshes, turn = puzzles.placed(puzzles.axle_in_hub(radius, sides), np.random.default_rng(sides))
    near = default_tolerance(meshes)
    contacts = find_contacts(meshes, near)
    assert isinstance(verdict(make_assembly(meshes, contacts, (0,))), Certificate)
    for motion in round_motions(meshes, contacts, near, [(0,), (1,)]):
        assert motion.rounded
        axis = motion.rotations[0] / np.linalg.norm(motion.rotations[0])
        assert abs(axis @ turn[:, 2]) == pytest.approx(1, abs=1e-4)


def test_a_ball_turns_in_its_socket_about_an_axis_of_coordinates():
    ball = puzzles.fine_ball(1.0)
    block = puzzles.without(box((-2, -2, -2), (2, 2, 0.5)), puzzles.fine_ball(1.01))
    (motion,) = found([block, ball], (1,), tolerance=0.03)
    axis = motion.rotations[0] / np.linalg.norm(motion.rotations[0])
    assert axis == pytest.approx([1, 0, 0], abs=0.01)


def test_parts_that_hang_together_turn_as_one():
    hub, axle = puzzles.axle_in_hub(4.8, 100)
    far = box((-50, -50, -50), (50, 50, 0))
    halves = [puzzles.without(axle, far), puzzles.without(axle, puzzles.without(axle, far))]
    (motion,) = found([hub, *halves], (1, 2))
    assert motion.parts == (1, 2)
    assert motion.rotations[0] == pytest.approx(motion.rotations[1])


@pytest.mark.parametrize(
    "meshes",
    [
        puzzles.axle_in_hub(4.99, 64, pin=box((4, -1, -3), (8, 1, 3))),
        puzzles.axle_in_hub(4.99, 6, hole=6),
        puzzles.three_rods(),
        puzzles.dovetail(stopped=True),
        puzzles.cube_in_box(0.02),
    ],
    ids=["keyed axle", "hexagon", "rods", "dovetail", "cube"],
)
def test_what_is_not_round_does_not_turn(meshes):
    assert found(meshes, *((n,) for n in range(len(meshes)))) == [None] * len(meshes)


def test_smooth_normals_are_those_of_the_cylinder():
    points, triangles = puzzles.rod(2.0, 48, 0.0, 5.0)
    normals = smooth_normals(points, triangles)
    corners = points[triangles]
    wall = np.ptp(corners[..., 2], axis=1) > 0
    radial = corners[wall] * [0.5, 0.5, 0]
    assert normals[wall] == pytest.approx(radial, abs=1e-9)
    assert np.abs(normals[~wall]) == pytest.approx(np.broadcast_to([0, 0, 1], (sum(~wall), 3, 3)))


def test_a_screw_goes_round_its_axis_and_along_it():
    pose = screw(np.array([2.0, 0, 0]), np.array([0, 2.0, 0.5]), np.array([0, 0, 1.0]), np.pi)
    assert pose @ [2, 0, 0, 1] == pytest.approx([-2, 0, np.pi / 2])
    assert pose @ [0, 0, 0, 1] == pytest.approx([0, 0, np.pi / 2])
    straight = screw(np.ones(3), np.array([0, 0, 2.0]), np.zeros(3), 3.0)
    assert straight @ [1, 2, 3, 1] == pytest.approx([1, 2, 9])


def test_what_turns_touches_what_is_in_its_way():
    # A bar that turns about z through the origin, and a post a quarter turn ahead.
    bar, post = box((-4, -1, 0), (4, 1, 1)), box((-1, 2, 0), (1, 3, 1))
    turns = Motion((0,), np.zeros((1, 3)), np.array([[0, 0, 0.25]]), slides=True)
    time, part = first_touch([bar, post], turns)
    assert part == 1
    there = moved(bar[0], np.zeros(3), turns.rotations[0], time)
    assert middle(there) == pytest.approx([0, 0, 0.5])
    assert 0.25 * time == pytest.approx(np.arctan2(2, 1) - np.arcsin(1 / 5**0.5), abs=0.02)
