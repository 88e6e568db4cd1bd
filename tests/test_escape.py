"""Ways out: found where a person sees one, replayed, and not found where there is none."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kits import kit
from puzzles import cells, cube_in_box, dovetail, hull, peg_in_tube, placed, voxels, without
from scipy.spatial.transform import Rotation
from shapes import box, torus

from scadgen.check.geometry import placed as standing
from scadgen.errors import InputError, InvariantError
from scadgen.interlock.escape import Attempts, escape
from scadgen.interlock.field import Field
from scadgen.interlock.path import Path, replay


def peg_in_socket():
    """A peg of side 0.9 in a blind hole of side 1, three deep and open at z = 4."""
    block = without(box((0, 0, 0), (3, 3, 4)), box((1, 1, 1), (2, 2, 5)))
    return block, box((1.05, 1.05, 1.1), (1.95, 1.95, 6))


def cube_in_tunnel():
    """A cube at the end of a tunnel along +y, that turns into +x and leaves at x = 4."""
    tunnel = cells((1, 2), (1, 4), (1, 2)) | cells((1, 4), (3, 4), (1, 2))
    block = voxels(cells((0, 4), (0, 5), (0, 3)) - tunnel)
    return block, box((1.1, 1.1, 1.1), (1.9, 1.9, 1.9))


def zigzag_in_plate():
    """A rod with both ends bent, in the hole of a plate that lets none of them past upright."""
    plate = without(box((-4, -4, 0), (4, 4, 0.4)), box((-0.9, -0.9, -1), (0.9, 0.9, 1)))
    upright = cells((0, 1), (0, 1), (0, 5))
    arms = cells((0, 4), (0, 1), (4, 5)) | cells((-3, 1), (0, 1), (0, 1))
    points, triangles = voxels(upright | arms)
    return plate, (0.8 * (points - (0.5, 0.5, 2.25)), triangles)


def sector(low, high, start, end):
    """Part of a disc of radius 2 between two heights and two angles in degrees."""
    turn = np.radians(np.linspace(start, end, 13))
    rim = [(2 * np.cos(a), 2 * np.sin(a)) for a in turn]
    return hull([(x, y, z) for z in (low, high) for x, y in [(0, 0), *rim]])


def bayonet():
    """A shaft with a pin in a bush: it turns by 60 degrees, and then the pin can rise."""
    round_ = np.radians(np.arange(0, 360, 15))
    shaft = hull([(np.cos(a), np.sin(a), z) for a in round_ for z in (-1.4, 3)])
    hole = hull([(1.1 * np.cos(a), 1.1 * np.sin(a), z) for a in round_ for z in (-1.5, 3)])
    bush = without(box((-3, -3, -2), (3, 3, 1)), hole, sector(-0.4, 0.4, -15, 75))
    bush = without(bush, sector(-0.4, 2, 45, 75))
    pin = box((0.5, -0.25, -0.3), (1.9, 0.25, 0.3))
    return bush, shaft, pin


def turn_of(path):
    """Largest turn on a path, in degrees."""
    return np.degrees(Rotation.from_matrix(path.poses[:, :3, :3]).magnitude()).max()


def out(moving, fixed, seed=1):
    """A way out, replayed with a step that the search does not know."""
    path = escape(moving, fixed, seed=seed)
    assert isinstance(path, Path)
    size = float(np.ptp(np.concatenate([p for p, _ in moving]), axis=0).max())
    assert replay(path, moving, fixed, 0.0037 * size) <= 1e-9 * size**3
    assert (path.poses[0] == np.eye(4)).all()
    return path


@settings(max_examples=8)
@given(st.integers(0, 2**32 - 1))
def test_a_peg_leaves_its_socket_straight(seed):
    rng = np.random.default_rng(seed)
    (block, peg), turn = placed(peg_in_socket(), rng)
    path = out([peg], [block])
    assert len(path.poses) == 2
    size = np.ptp(block[0] @ turn, axis=0)[2] / 4
    way = path.poses[-1, :3, 3] @ turn / size
    assert turn_of(path) < 1e-6
    assert way[2] > 2.9
    assert np.abs(way[:2]).max() < 0.1


def test_a_peg_that_touches_its_tube_slides_out_of_it():
    tube, peg = peg_in_tube()
    path = out([peg], [tube])
    assert abs(path.poses[-1, 2, 3]) >= 4


@settings(max_examples=4)
@given(st.integers(0, 2**32 - 1))
def test_a_dovetail_slides_along_its_slot(seed):
    block, (points, triangles) = dovetail(stopped=False)
    middle = points.mean(axis=0)
    tail = (middle + 0.97 * (points - middle), triangles)
    (block, tail), turn = placed([block, tail], np.random.default_rng(seed))
    path = out([tail], [block])
    way = path.poses[-1, :3, 3] @ turn
    assert np.abs(way[1:]).max() < 0.1 * abs(way[0])


def test_a_cube_takes_a_tunnel_of_two_legs():
    (block, cube), turn = placed(cube_in_tunnel(), np.random.default_rng(0))
    path = out([cube], [block])
    side = np.ptp(block[0] @ turn, axis=0)[0] / 4
    centres = path.poses[:, :3, :3] @ path.middle + path.poses[:, :3, 3]
    way = (centres - path.middle) @ turn / side
    assert len(way) > 2
    assert way[:, 1].max() > 1.7
    assert way[-1, 0] > 2.5


def test_a_bent_rod_has_to_turn():
    plate, rod = zigzag_in_plate()
    assert turn_of(out([rod], [plate])) > 40


def test_a_bayonet_turns_and_rises():
    bush, shaft, pin = bayonet()
    path = out([shaft, pin], [bush])
    turns = Rotation.from_matrix(path.poses[:, :3, :3]).as_rotvec()[:, 2]
    assert np.degrees(turns.max()) > 45
    assert path.poses[-1, 2, 3] > 1


def shut_in(gap):
    """What a search finds that has to fail."""
    shell, cube = cube_in_box(gap)
    return escape([cube], [shell], seed=1)


@pytest.fixture(scope="module")
def tight():
    return shut_in(0.05)


@pytest.mark.parametrize("gap", [0.05, 0.4])
def test_no_way_out_of_a_closed_box(gap, tight):
    found = tight if gap == 0.05 else shut_in(gap)
    assert isinstance(found, Attempts)
    assert found.finished
    assert found.tries > 50


def test_no_way_apart_for_linked_rings():
    points, faces = torus(16, 6)
    other = (points[:, [0, 2, 1]] * (1, 1, -1) + (3, 0, 0), faces)
    found = escape([other], [(points, faces)], seed=3)
    assert isinstance(found, Attempts)


def test_the_same_seed_goes_the_same_way(tight):
    bush, *bolt = bayonet()
    one, again = (escape(bolt, [bush], seed=5) for _ in range(2))
    assert one.poses.tobytes() == again.poses.tobytes()
    assert shut_in(0.05) == tight


def test_far_is_how_far_the_hulls_get():
    block, peg = peg_in_socket()
    path = escape([peg], [block], seed=1, far=10)
    assert path.poses[-1, 2, 3] == pytest.approx(2.9 + 10)


def test_a_search_that_runs_out_of_steps_is_not_finished():
    plate, rod = zigzag_in_plate()
    found = escape([rod], [plate], seed=1, steps=100)
    assert isinstance(found, Attempts)
    assert not found.finished
    assert found.steps < 200
    # Without any, straight ways are still tried.
    assert escape([rod], [plate], seed=1, steps=0).tries > 0
    assert isinstance(escape([rod], [plate], seed=1), Path)


def test_what_is_no_request():
    block, peg = peg_in_socket()
    with pytest.raises(InputError, match="steps = -1"):
        escape([peg], [block], seed=1, steps=-1)
    with pytest.raises(InputError, match="far = -1 mm"):
        escape([peg], [block], seed=1, far=-1)
    with pytest.raises(InputError, match="overlaps the others at the start"):
        escape([box((0, 0, 0), (2, 2, 2))], [block], seed=1)
    with pytest.raises(InputError, match="a body needs at least 1"):
        escape([], [block], seed=1)
    with pytest.raises(InvariantError, match="oriented 2-manifold"):
        escape([(peg[0], peg[1][1:])], [block], seed=1)


def lifted(*heights):
    """Straight up in some legs."""
    poses = np.tile(np.eye(4), (len(heights), 1, 1))
    poses[:, 2, 3] = heights
    return Path(poses, np.array([1.5, 1.5, 3.55]))


def test_a_replay_measures_what_is_in_the_way():
    block, peg = peg_in_socket()
    assert replay(lifted(0, 3), [peg], [block], 0.1) == 0
    # With a lid of thickness 0.5 on the hole the peg goes through it with all its section.
    lid = box((1.01, 1.01, 6.5), (1.99, 1.99, 7))
    assert replay(lifted(0, 6), [peg], [block, lid], 0.1) == pytest.approx(0.9**2 * 0.5)
    # Sideways through the wall, between two poses that are clear.
    poses = np.tile(np.eye(4), (2, 1, 1))
    poses[1, 0, 3] = 9
    assert replay(Path(poses, np.zeros(3)), [peg], [block], 0.1) == pytest.approx(
        0.9 * 0.9 * 2.9, rel=0.15
    )


def test_a_replay_sees_what_is_no_way_out():
    block, peg = peg_in_socket()

    def worst(path):
        return replay(path, [peg], [block], 0.1)

    assert worst(lifted(0, 2)) == np.inf  # not out yet
    assert worst(lifted(0)) == np.inf
    assert worst(lifted(0.01, 3)) == np.inf  # begins elsewhere
    assert worst(lifted(0, np.nan)) == np.inf
    shrunk = lifted(0, 1, 3)
    shrunk.poses[1, :3, :3] *= 0.5
    assert worst(shrunk) == np.inf
    mirrored = lifted(0, 1, 3)
    mirrored.poses[1, 0, 0] = -1
    assert worst(mirrored) == np.inf
    with pytest.raises(InputError, match="step = 0 mm"):
        replay(lifted(0, 3), [peg], [block], 0)


def test_a_path_goes_straight_while_it_turns():
    poses = np.tile(np.eye(4), (2, 1, 1))
    middle = np.array([1.0, 0, 0])
    poses[1, :3, :3] = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    poses[1, :3, 3] = (1, 0, 2) - poses[1, :3, :3] @ middle
    path = Path(poses, middle)
    half = path.at(np.array([0.0, 0.5, 1.0]))
    assert (half[[0, 2]] == poses).all()
    assert half[1, :3, :3] @ middle + half[1, :3, 3] == pytest.approx((1, 0, 1))
    assert half[1, :3, :3] @ (1, 0, 0) == pytest.approx((0.5**0.5, 0.5**0.5, 0))
    dense = path.dense(3.0, 0.1)
    point = np.array([4.0, 0, 0, 1])
    assert np.linalg.norm(np.diff(dense @ point, axis=0), axis=1).max() <= 0.1
    assert (dense[[0, -1]] == poses).all()


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1))
def test_a_field_knows_the_distance_to_a_box(seed):
    rng = np.random.default_rng(seed)
    high = rng.uniform(1, 3, size=3)
    points, faces = box(-high, high)
    points = np.concatenate([points, points / 2])  # and a cavity in it
    field = Field(points, np.concatenate([faces, faces[:, ::-1] + 8]), 0.1)
    asked = rng.uniform(-1.1, 1.1, size=(500, 3)) * high
    beyond = np.abs(asked)[:, None] - np.array([high, high / 2])
    away = np.linalg.norm(np.maximum(beyond, 0), axis=2) + np.minimum(beyond.max(axis=2), 0)
    true = np.maximum(away[:, 0], -away[:, 1])
    found = field.value(asked)
    near = np.abs(true) < 0.2
    assert np.abs(found - true)[near].max() < 0.05
    assert (np.sign(found) == np.sign(true))[np.abs(true) > 0.05].all()
    assert (np.abs(found) <= np.abs(true) + 0.05).all()


def stages(frame):
    """Meshes of a joint as it stands: half A, half B, the connectors, the peg."""
    made = kit(frame)
    meshes = [standing(made, p, made.values) for p in made.joints[0].pieces]
    return meshes[0], meshes[1], meshes[2:-1], meshes[-1]


@pytest.mark.parametrize("frame", ["hexagonal", "square"])
def test_a_joint_comes_apart_in_order(frame):
    half_a, half_b, others, peg = stages(frame)
    fixed = [half_a, half_b, *others]
    assert len(out([peg], fixed).poses) == 2
    out([half_a], [half_b, *others])
    out([half_b], others)
    while len(others) > 1:
        out([others[0]], others[1:])
        others = others[1:]


def test_whole_connectors_do_not_come_apart():
    _, _, others, _ = stages("hexagonal")
    points, faces = others[0]
    turn = Rotation.from_euler("z", 120, degrees=True).as_matrix()
    ring = [(points @ np.linalg.matrix_power(turn.T, k), faces) for k in range(3)]
    found = escape(ring[:1], ring[1:], seed=1)
    assert isinstance(found, Attempts)
    assert found.finished
