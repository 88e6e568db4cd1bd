"""The ring decomposed: connectors and halves that partition it, all alike in a regular joint."""

import math
import re
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from kits import WEAVES, joint, kit, mesh, regular
from scipy.spatial import cKDTree

from scadgen.errors import GeometryError, InputError, InvariantError
from scadgen.joint.joint import DETAILS, make_joint, site_curves, wall_angles
from scadgen.joint.lattice import make_lattice
from scadgen.joint.site import distances, nearest_site
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import Weave, any_joint
from scadgen.solid.crossing import crossing_faces
from scadgen.solid.mesh import components, solid_faults, volume, weld_float32

#: Works for many directions of three to five edges.
UNEVEN = Weave(1.95, 0.55, 0.2, 0.4, 1.0, "uneven")
DIRECTIONS = [
    [0, 100, 220],
    [10, 140, 250],
    [0, 75, 180, 280],
    [5, 85, 190, 270],
    [0, 70, 140, 215, 290],
    [0, 180],
]
REGULAR = [(frame, detail) for frame in WEAVES for detail in ("draft", "standard")]


def general(frame, detail):
    """Joint by the general path: a hundred-billionth of a radian off regular."""
    edges = regular(len(joint(frame).spokes))
    edges[1] += 1e-11
    extra = int(kit(frame, detail=detail).joints[0].figures["lattice_extra"])
    return make_joint(Spokes.flat(edges), WEAVES[frame], DETAILS[detail], extra)


def pieces(made):
    return [*made.connectors, *(half for pair in made.halves for half in pair)]


def assert_partition(made):
    """Connectors fill the domain; halves fill their connector; all are sound."""
    whole = [volume(*mesh(c)) for c in made.connectors]
    assert sum(whole) == pytest.approx(made.lattice.domain.volume(), rel=1e-9)
    for connector, pair in zip(whole, made.halves, strict=True):
        assert sum(volume(*mesh(half)) for half in pair) == pytest.approx(connector, rel=1e-9)
    for surface in pieces(made):
        points, triangles = mesh(surface)
        assert solid_faults(10 * points, triangles) == []


def polygon_area(corners):
    """Shoelace formula."""
    x, y = corners.T
    return abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def matched(first, second):
    """Vertices of the second that are the first's, and how far off the worst is."""
    there, match = cKDTree(second).query(first)
    assert len(first) == len(second) == len(np.unique(match))
    return match, float(np.max(there))


def turned_first(triangles):
    """Triangles as a set, each from its lowest vertex on."""
    return {min((a, b, c), (b, c, a), (c, a, b)) for a, b, c in triangles.tolist()}


@pytest.mark.parametrize(("frame", "detail"), REGULAR)
def test_connectors_partition_the_domain(frame, detail):
    made = joint(frame, detail)
    assert_partition(made)
    nodes = made.lattice.nodes
    ring = polygon_area(nodes[:, -1, 0, :2]) - polygon_area(nodes[:, 0, 0, :2])
    assert len(made.spokes) * volume(*mesh(made.connectors[0])) == pytest.approx(ring, rel=1e-9)


@pytest.mark.parametrize(("frame", "detail"), REGULAR)
def test_all_connectors_and_halves_are_alike(frame, detail):
    one, every = joint(frame, detail), general(frame, detail)
    assert_partition(every)
    model = one.connectors[0]
    for connector in every.connectors:
        match, off = matched(connector.points, model.points)
        assert off < 1e-9
        assert turned_first(match[connector.walls]) == turned_first(model.walls)
    for first, second in every.halves:
        for half in (first.points, second.points * [1, -1, -1]):
            assert matched(half, one.halves[0][0].points)[1] < 1e-9


@pytest.mark.parametrize("frame", WEAVES)
def test_a_half_turn_about_its_edge_maps_a_connector_to_itself(frame):
    points = joint(frame).connectors[0].points
    assert matched(points * [1, -1, -1], points)[1] < 1e-9


@pytest.mark.parametrize(("frame", "detail"), REGULAR)
def test_every_piece_is_one_closed_solid_counted_by_hand(frame, detail):
    """By other means than the checks that the program itself makes."""
    made = joint(frame, detail)
    for surface in (made.connectors[0], *made.halves[0]):
        points, triangles = mesh(surface)
        for corners in (triangles, weld_float32(10 * points, triangles)[1]):
            sides = Counter((int(t[k]), int(t[(k + 1) % 3])) for t in corners for k in range(3))
            assert set(sides.values()) == {1}
            assert all((b, a) in sides for a, b in sides)
            assert all(len(set(t)) == 3 for t in corners.tolist())
        assert components(triangles, "vertices") == 1
        assert not len(crossing_faces(points, triangles))


def test_other_programs_find_the_pieces_watertight():
    import trimesh

    for frame in WEAVES:
        made = joint(frame)
        for surface in (made.connectors[0], *made.halves[0]):
            points, triangles = mesh(surface)
            read = trimesh.Trimesh(points, triangles, process=False)
            assert read.is_volume
            assert read.body_count == 1
            assert read.volume == pytest.approx(volume(points, triangles), rel=1e-12)


@pytest.mark.parametrize("degrees", DIRECTIONS, ids=lambda d: "-".join(map(str, d)))
def test_uneven_joints_partition_too(degrees):
    made = make_joint(Spokes.flat(np.radians(degrees)), UNEVEN, DETAILS["draft"])
    assert len(made.connectors) == len(made.halves) == len(degrees)
    assert_partition(made)
    nodes = made.lattice.nodes
    ring = polygon_area(nodes[:, -1, 0, :2]) - polygon_area(nodes[:, 0, 0, :2])
    assert made.lattice.domain.volume() == pytest.approx(ring, rel=1e-12)


@settings(max_examples=12)
@given(st.lists(st.floats(62, 150), min_size=2, max_size=4), st.floats(0, 20))
def test_any_directions_partition_or_are_refused(gaps, start):
    assume(62 <= 360 - sum(gaps) <= 180)
    edges = np.radians(start + np.cumsum([0, *gaps]))
    try:
        assert_partition(make_joint(Spokes.flat(edges), UNEVEN, DETAILS["draft"]))
    except (GeometryError, InvariantError) as error:  # kits take another lattice then
        assert "\n" not in str(error)  # noqa: PT017  both ends are good


@settings(max_examples=8)
@given(st.permutations([70, 95, 125, 70]), st.sampled_from([(0,), (1,), (0, 2), (1, 3)]))
def test_a_joint_with_its_edges_the_other_way_around_is_the_joint_turned_over(gaps, keys):
    edges = np.radians(np.cumsum([0, *gaps[:-1]]))
    back = np.sort(-edges % (2 * np.pi))
    count, weave = len(edges), any_joint(math.radians(min(gaps)))
    one = make_joint(Spokes.flat(edges), weave, DETAILS["draft"], 0, keys)
    other = make_joint(
        Spokes.flat(back), weave, DETAILS["draft"], 0, [-key % count for key in keys]
    )
    for slot in range(count):
        here, there = one.halves[slot], other.halves[-slot % count]
        pairs = [(one.connectors[slot], other.connectors[-slot % count])]
        pairs += [(here[0], there[1]), (here[1], there[0])]
        for surface, turned in pairs:
            assert len(surface.points) == len(turned.points)
            tree = cKDTree(surface.points * [1, -1, -1])
            assert tree.query(turned.points)[0].max() < 1e-9


@pytest.mark.parametrize("frame", WEAVES)
def test_tubes_start_as_exact_squares(frame):
    made = joint(frame)
    surface = made.connectors[0]
    (loop,) = surface.loops(("outer", 0))
    corners = surface.points[loop]
    assert len(corners) == 4
    assert np.allclose(corners[:, 0], made.lattice.domain.flats.distance[0], atol=1e-12)
    assert np.allclose(np.abs(corners[:, 1:]), 0.5, atol=1e-12)


def test_walls_are_equally_far_from_two_curves():
    made = joint("hexagonal", "standard")
    surface = made.connectors[0]
    points = surface.points[np.unique(surface.walls)]
    far = np.sort(np.stack([curve.distance(points)[0] for curve in made.curves]), axis=0)
    assert np.median(far[1] - far[0]) < 1e-12
    # Where short sides were merged a vertex stands between the two it replaces.
    assert (far[1] - far[0]).max() < 0.06


@pytest.mark.parametrize("edges", [[], [0.0], [0.0, 3.0, 2.0], [0.0, 0.0], [-1.0, 2.0], [0.0, 7.0]])
def test_directions_that_do_not_ascend_are_refused(edges):
    with pytest.raises(InputError, match=re.escape(f"edges {edges}: must be two or more")):
        make_joint(Spokes.flat(edges), UNEVEN, DETAILS["draft"])


def test_a_ring_too_small_for_its_tubes_is_refused_with_what_is_needed():
    with pytest.raises(GeometryError, match="tubes overlap 30 degrees apart") as said:
        make_lattice(Spokes.flat(np.radians([0, 30, 180])), 1.2, 5)
    need = float(str(said.value).rsplit("at least ", 1)[1])
    # Two squares of side 1, 30 degrees apart, touch where half a side is seen under 15 degrees.
    assert need == pytest.approx(0.5 / math.sin(math.radians(15)) - 0.5, abs=1e-3)
    make_lattice(Spokes.flat(np.radians([0, 30, 180])), need + 1e-3, 5)


@pytest.mark.parametrize(
    ("count", "weave", "message"),
    [
        (2, Weave(1.31, 1.16, 0.5, 0.64, 2.63), "a connector falls apart into [2-9] pieces"),
        (3, Weave(1.25, 0.77, 0.54, 1.16, 1.73), "the halves of a connector hang together"),
        (3, Weave(2.02, 0.82, 0.4, 1.0, 1.5), "its weave is too fine for this detail"),
        (4, Weave(2.34, 1.04, 0.52, 0.83, 0.99), r"only \d+\.\d% of a tube's face"),
    ],
)
def test_a_weave_that_makes_no_pieces_is_refused(count, weave, message):
    with pytest.raises(GeometryError, match=message):
        make_joint(Spokes.flat(regular(count)), weave, DETAILS["draft"])


def test_walls_are_beside_keys_and_else_in_the_middle_of_their_gaps():
    edges, weave = np.radians([0, 90, 210]), any_joint(np.pi / 2)
    near = np.degrees(weave.stretch / 2 / weave.ring_ratio)
    assert near == pytest.approx(45, abs=0.2)
    for keys, expected in (
        ((), [45, 60, 75]),
        ((0,), [near, 60, 150 - near]),
        ((2,), [45, 120 - near, near]),
        ((1, 2), [90 - near, near, near]),
    ):
        assert np.degrees(wall_angles(Spokes.flat(edges), weave, keys)) == pytest.approx(expected)
    plain = replace(weave, stretch=None)
    assert np.degrees(wall_angles(Spokes.flat(edges), plain, (0,))) == pytest.approx([45, 60, 75])


def test_distances_that_are_not_wanted_are_bounded_from_above():
    made = joint("square")
    points = np.random.default_rng(5).uniform([-3, -3, -0.5], [3, 3, 0.5], (400, 3))
    exact, nearly = distances(made.curves, points), distances(made.curves, points, 0.5)
    assert (nearly >= exact - 1e-12).all()
    wanted = exact <= exact.min(axis=0) + 0.5
    wanted &= wanted.sum(axis=0) > 1
    assert wanted.sum() < wanted.size
    assert np.allclose(nearly[wanted], exact[wanted], rtol=0, atol=1e-12)
    assert np.array_equal(nearly.argmin(axis=0), exact.argmin(axis=0))


@given(st.floats(0.8, 2.6), st.integers(0, 2**32))
def test_the_nearest_site_is_that_of_the_least_distance(turn, seed):
    edges = [0.0, turn, 4.2]
    curves = site_curves(Spokes.flat(edges), any_joint(turn), 40)
    points = np.random.default_rng(seed).uniform([-5, -5, -0.6], [5, 5, 0.6], (300, 3))
    assert np.array_equal(nearest_site(curves, points), distances(curves, points).argmin(axis=0))
