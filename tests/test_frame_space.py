"""Frames in space: azimuths and slopes, and that turning a frame changes nothing else."""

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay, cKDTree
from scipy.spatial.transform import Rotation

from scadgen.errors import InputError
from scadgen.frame.classes import classify
from scadgen.frame.faces import at_rim
from scadgen.frame.graph import Frame
from scadgen.frame.kinds import choose_kinds
from scadgen.joint.symmetry import Symmetry
from scadgen.plane.drawn import make_frame

GOLDEN = (1 + 5**0.5) / 2


def nearest_joined(points):
    """All pairs of points that are as near to each other as the nearest two."""
    points = np.array(points, dtype=float)
    far = np.linalg.norm(points[:, None] - points, axis=2)
    edges = np.argwhere(np.triu(far < far[far > 0].min() * 1.001, 1))
    return points, edges


def cyclic(*rows):
    return [np.roll(row, k) for row in rows for k in range(3)]


SIGNS = list(itertools.product((-1, 1), repeat=2))

CUBE = list(itertools.product((-1, 1), repeat=3))

#: Their corners; all edges of each are equally long.
SOLIDS = {
    "tetrahedron": [corner for corner in CUBE if np.prod(corner) > 0],
    "cube": CUBE,
    "octahedron": cyclic((1, 0, 0), (-1, 0, 0)),
    "dodecahedron": CUBE + cyclic(*((0, a / GOLDEN, b * GOLDEN) for a, b in SIGNS)),
    "icosahedron": cyclic(*((0, a, b * GOLDEN) for a, b in SIGNS)),
}

#: Vertices, edges, and the slopes that are known of them, in degrees.
FACTS = {
    "tetrahedron": (4, 6, 54.74),
    "cube": (8, 12, 35.26),
    "octahedron": (6, 12, 45.0),
    "dodecahedron": (20, 30, 20.91),
    "icosahedron": (12, 30, 31.72),
}


@st.composite
def nets(draw):
    """Points anywhere, with normals anywhere near up, joined as their plan's triangles are."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    count = draw(st.integers(4, 12))
    points = rng.uniform(-50, 50, (count, 3)) * (1, 1, 0.2)
    normals = rng.uniform((-0.3, -0.3, 0.7), (0.3, 0.3, 1.3), (count, 3))
    triangles = Delaunay(points[:, :2]).simplices
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [0, 2]]])
    return points, normals, np.unique(np.sort(pairs, axis=1), axis=0)


def spokes(frame, vertex):
    """Gaps and slopes of a vertex, begun at the edge that leads to where it is told."""
    return np.stack([frame.gaps(vertex), frame.slopes(vertex)])


def begun_anywhere(two):
    return [np.roll(two, k, axis=1) for k in range(two.shape[1])]


def assert_same_spokes(frame, points, other):
    """That vertices at these places of another frame look like this one's."""
    number = cKDTree(other.vertices).query(points)[1]
    for vertex, there in enumerate(number):
        own = spokes(frame, vertex)
        ways = begun_anywhere(spokes(other, there))
        assert min(np.abs(own - way).max() for way in ways) < 1e-6


def turned(seed):
    return Rotation.random(random_state=seed)


@settings(deadline=None, max_examples=40)
@given(nets(), st.integers(0, 2**32 - 1))
def test_a_frame_turned_in_space_with_its_normals_has_the_same_spokes(net, seed):
    points, normals, edges = net
    frame = Frame.spatial("net", points, normals, edges)
    turn = turned(seed)
    other = Frame.spatial("net", turn.apply(points) + 7, turn.apply(normals), edges)
    assert_same_spokes(frame, turn.apply(np.array(frame.vertices)) + 7, other)
    assert np.sort(other.lengths) == pytest.approx(np.sort(frame.lengths))


@settings(deadline=None, max_examples=40)
@given(nets(), st.floats(0, 6.28), st.integers(0, 2**32 - 1))
def test_a_plane_frame_has_no_slopes_however_it_is_turned(net, angle, seed):
    points, edges = net[0][:, :2], net[2]
    frame = make_frame("net", points, edges)
    assert not frame.ends.slope.any()
    about_z = Rotation.from_euler("z", angle)
    flat = make_frame("net", about_z.apply(np.pad(points, ((0, 0), (0, 1))))[:, :2], edges)
    assert not flat.ends.slope.any()
    assert_same_spokes(frame, about_z.apply(np.array(frame.vertices)), flat)
    turn = turned(seed)
    leaning = Frame.spatial(
        "net",
        turn.apply(np.array(frame.vertices)),
        turn.apply(np.array(frame.normals)),
        edges=frame.edges,
    )
    assert np.abs(leaning.ends.slope).max() < 1e-9
    assert_same_spokes(frame, turn.apply(np.array(frame.vertices)), leaning)


@settings(deadline=None, max_examples=40)
@given(nets())
def test_azimuths_and_slopes_say_where_edges_go(net):
    points, normals, edges = net
    frame = Frame.spatial("net", points, normals, edges)
    for vertex, normal in enumerate(frame.normals):
        first = frame.ends.first[vertex]
        others = frame.ends.neighbour[first : frame.ends.first[vertex + 1]]
        ways = frame.vertices[others] - frame.vertices[vertex]
        ways /= np.linalg.norm(ways, axis=1)[:, None]
        # Down by the sine of the slope, and turned about the normal by the gap.
        assert -(ways @ normal) == pytest.approx(np.sin(frame.slopes(vertex)))
        for way, gap, after in zip(
            ways, frame.gaps(vertex), np.roll(ways, -1, axis=0), strict=True
        ):
            level, then = (one - (one @ normal) * normal for one in (way, after))
            seen = Rotation.from_rotvec(gap * normal).apply(level)
            assert np.cross(seen, then) == pytest.approx(np.zeros(3), abs=1e-9)
            assert seen @ then > 0
        assert frame.gaps(vertex).sum() == pytest.approx(2 * np.pi)


@pytest.mark.parametrize("name", SOLIDS)
def test_edges_of_a_regular_solid_slope_alike(name):
    points, edges = nearest_joined(SOLIDS[name])
    frame = Frame.spatial(name, points, points, edges)
    vertices, count, degrees = FACTS[name]
    assert (len(frame.vertices), len(frame.edges)) == (vertices, count)
    # Half an edge, seen from the middle of the solid, is the slope at its ends.
    slope = np.arcsin(frame.lengths[0] / 2 / np.linalg.norm(points[0]))
    assert frame.ends.slope == pytest.approx(np.full(2 * count, slope))
    assert np.degrees(slope) == pytest.approx(degrees, abs=0.006)
    assert frame.ends.gap == pytest.approx(np.full(2 * count, 2 * np.pi / frame.degree[0]))
    assert not at_rim(frame).any()


def test_turned_inside_out_a_solid_slopes_up():
    points, edges = nearest_joined(SOLIDS["cube"])
    frame = Frame.spatial("cube", points, -points, edges)
    assert np.degrees(frame.ends.slope) == pytest.approx(np.full(24, -35.264), abs=1e-3)


def test_a_dome_has_its_rim_where_its_plan_has():
    side = np.arange(4.0)
    x, y = (axis.ravel() for axis in np.meshgrid(side, side))
    points = 10 * np.stack([x, y, -0.1 * ((x - 1.5) ** 2 + (y - 1.5) ** 2)], axis=1)
    normals = np.stack([0.2 * (x - 1.5), 0.2 * (y - 1.5), np.ones(16)], axis=1)
    _, edges = nearest_joined(np.stack([x, y], axis=1))
    dome = Frame.spatial("dome", points, normals, edges)
    rim = np.isin(dome.vertices[:, :2], [0, 30]).any(axis=1)
    assert at_rim(dome).tolist() == rim.tolist()
    assert at_rim(make_frame("flat", points[:, :2], edges)).tolist() == (
        np.isin(make_frame("flat", points[:, :2], edges).plan, [0, 30]).any(axis=1).tolist()
    )


def test_a_plan_is_of_plane_frames_alone():
    corners = [[0, 0, 0], [9, 0, 0], [0, 9, 2.5]]
    tilted = Frame.spatial("roof", corners, np.tile([0, 0, 2], (3, 1)), [[0, 1], [1, 2]])
    assert not tilted.is_plane
    with pytest.raises(
        InputError, match=r"frame roof is not plane: its vertices reach 2\.5 mm"
    ) as e:
        tilted.plan  # noqa: B018
    assert "\n" not in str(e.value)
    leaning = Frame.spatial(
        "fan", np.multiply(corners, (1, 1, 0)), [[0, 1, 2]] * 3, [[0, 1], [1, 2]]
    )
    with pytest.raises(InputError, match="its normals lean"):
        leaning.plan  # noqa: B018


@pytest.mark.parametrize(
    ("normals", "said"),
    [
        ([[0, 0, 1]] * 2, r"shape \(3, 3\) with normals of shape \(2, 3\): must both be \(n, 3\)"),
        ([[0, 0, 1], [0, 0, 0], [0, 0, 1]], r"normal at \(9, 0, 0\), \(0, 0, 0\): must have a dir"),
        ([[0, 0, 1], [1, 0, 0], [0, 0, 1]], r"an edge at \(9, 0, 0\) runs along the normal there"),
    ],
)
def test_normals_that_no_ring_can_have_are_refused(normals, said):
    with pytest.raises(InputError, match=said):
        Frame.spatial("bad", [[0, 0, 0], [9, 0, 0], [0, 9, 0]], normals, [[0, 1], [1, 2]])


def beside(points, normals, edges, others):
    """A net, and what others make of its points and normals, far from it: one frame.

    Also the numbers of both nets' vertices in it.
    """
    far = (1000, 0, 0)
    moved, turned_normals = others(points), others(normals)
    both = Frame.spatial(
        "both",
        np.concatenate([points, moved + far]),
        np.concatenate([normals, turned_normals]),
        np.concatenate([edges, edges + len(points)]),
    )
    tree = cKDTree(both.vertices)
    return both, tree.query(points)[1], tree.query(moved + far)[1]


def edge_classes(same, frame, numbers, edges):
    known = {tuple(pair): n for n, pair in enumerate(frame.edges.tolist())}
    return [same.edge_of[known[tuple(sorted(numbers[pair].tolist()))]] for pair in edges]


@settings(deadline=None, max_examples=40)
@given(nets(), st.integers(0, 2**32 - 1))
def test_joints_and_edges_turned_in_space_are_the_same(net, seed):
    points, normals, edges = net
    frame, here, there = beside(points, normals, edges, turned(seed).apply)
    assume(frame.ends.gap.min() > 0.01)
    same = classify(frame)
    assert same.joint_of[here].tolist() == same.joint_of[there].tolist()
    assert (same.over[here] == same.over[there]).all()
    assert edge_classes(same, frame, here, edges) == edge_classes(same, frame, there, edges)


@settings(deadline=None, max_examples=40)
@given(nets(), st.integers(0, 2**32 - 1))
def test_seen_from_below_joints_are_turned_over_and_edges_the_same(net, seed):
    points, normals, edges = net
    frame, here, there = beside(points, normals, edges, turned(seed).apply)
    below = np.array(frame.normals)
    below[there] *= -1
    frame = Frame.spatial("both", frame.vertices, below, frame.edges)
    assume(frame.ends.gap.min() > 0.01)
    same = classify(frame)
    assert same.joint_of[here].tolist() == same.joint_of[there].tolist()
    lone = [same.joints[n].symmetry.mirror is not None for n in same.joint_of[here]]
    assert ((same.over[here] != same.over[there]) | lone).all()
    assert edge_classes(same, frame, here, edges) == edge_classes(same, frame, there, edges)


@settings(deadline=None, max_examples=40)
@given(nets())
def test_a_mirrored_net_has_other_joints(net):
    points, normals, edges = net
    frame, here, there = beside(points, normals, edges, lambda some: some * (-1, 1, 1))
    assume(frame.ends.gap.min() > 0.01)
    same = classify(frame)
    for one, other in zip(here, there, strict=True):
        # A joint of two edges or more that leans is itself mirrored only by chance.
        if frame.degree[one] > 2 and np.abs(frame.slopes(one)).min() > 0.01:
            assert same.joint_of[one] != same.joint_of[other]
    assert frame.twists[np.isin(frame.edges[:, 0], here)] == pytest.approx(
        [-frame.twists[n] for n in mirrored_edges(frame, here, there)], abs=1e-9
    )


def mirrored_edges(frame, here, there):
    """Of each edge between some vertices, that between their images."""
    image = dict(zip(here.tolist(), there.tolist(), strict=True))
    known = {tuple(pair): n for n, pair in enumerate(frame.edges.tolist())}
    own = frame.edges[np.isin(frame.edges[:, 0], here)].tolist()
    return [known[tuple(sorted(image[v] for v in pair))] for pair in own]


@pytest.mark.parametrize("name", SOLIDS)
def test_a_regular_solid_has_one_joint_and_one_edge(name):
    points, edges = nearest_joined(SOLIDS[name])
    for turn in (Rotation.identity(), turned(3)):
        frame = Frame.spatial(name, 30 * turn.apply(points), turn.apply(points), edges)
        same = classify(frame)
        assert (len(same.joints), len(same.edges)) == (1, 1)
        (joint,) = same.joints
        valence = frame.degree[0]
        assert joint.symmetry == Symmetry(valence, 1, None)
        assert joint.slopes == pytest.approx(np.full(valence, frame.ends.slope[0]))
        assert frame.twists == pytest.approx(np.zeros(len(edges)), abs=1e-9)
        kinds = choose_kinds(frame, same)
        assert {len(kinds.shape(n).directions) for n in range(len(kinds.kinds))} == {valence}


def test_lone_ends_that_slope_differ_and_those_turned_over_are_one():
    # Posts up, up again, down, and one that is level, each from its own foot to its own top.
    feet = np.array([[0, 0, 0], [100, 0, 0], [200, 0, 0], [300, 0, 0]], dtype=float)
    tops = feet + np.array([[20, 0, 20], [20, 0, 30], [20, 0, -20], [20, 0, 0]])
    points = np.concatenate([feet, tops])
    frame = Frame.spatial("posts", points, [(0, 0, 1)] * 8, [[n, n + 4] for n in range(4)])
    same = classify(frame)
    at = cKDTree(frame.vertices).query(points)[1]
    first, steeper, down, level = same.joint_of[at[:4]]
    assert len({first, steeper, level}) == 3
    assert first == down
    assert same.over[at[0]] != same.over[at[2]]
    kinds = choose_kinds(frame, same)
    for vertex in range(8):
        shape = kinds.shape(int(kinds.kind_of[vertex]))
        assert len(shape.directions) == 3
        seen = -shape.slopes if kinds.over[vertex] else shape.slopes
        edge, end = np.argwhere(frame.edges == vertex)[0]
        assert seen[kinds.slots[edge, end]] == pytest.approx(frame.slopes(vertex)[0])
        assert kinds.directions(vertex)[kinds.slots[edge, end]] % (2 * np.pi) == pytest.approx(
            frame.directions(vertex)[0]
        )
