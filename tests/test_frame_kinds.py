"""Kinds of joints: caps at the rim, and keys that let a frame be put together."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import Delaunay

from scadgen.frame.classes import classify
from scadgen.frame.kinds import choose_kinds
from scadgen.frame.slots import Refused
from scadgen.joint.joint import wall_angles
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import any_joint
from scadgen.plane.catalogue import NAMES, named
from scadgen.plane.drawn import make_frame


def kinds_of(frame, **options):
    return choose_kinds(frame, classify(frame), **options)


def whole_edges(frame, kinds):
    """Edges with whole connectors at both ends."""
    keys = [kinds.kinds[kind].keys for kind in kinds.kind_of]
    split = [
        any(slot in keys[v] for v, slot in zip(*pair, strict=True))
        for pair in zip(frame.edges, kinds.slots, strict=True)
    ]
    return frame.edges[~np.array(split)]


def assert_can_be_put_together(frame, kinds):
    """No loop of whole connectors, a key at every vertex, and every edge in its own slot."""
    edges = whole_edges(frame, kinds)
    count = len(frame.vertices)
    graph = coo_array((np.ones(len(edges)), edges.T), shape=(count, count))
    assert connected_components(graph, directed=False)[0] == count - len(edges)
    assert all(kind.keys for kind in kinds.kinds)
    for vertex in range(count):
        slots = kinds.slots[frame.edges == vertex]
        assert len(set(slots.tolist())) == len(slots)


def assert_directions_are_those_of_the_edges(frame, kinds):
    for edge, (pair, slots) in enumerate(zip(frame.edges, kinds.slots, strict=True)):
        for end, vertex in enumerate(pair):
            step = frame.plan[pair[1 - end]] - frame.plan[vertex]
            turn = kinds.directions(vertex)[slots[end]]
            off = (np.arctan2(step[1], step[0]) - turn + np.pi) % (2 * np.pi) - np.pi
            assert abs(off) < 3e-4, (edge, end)


@pytest.mark.parametrize("name", NAMES)
def test_named_frames_can_be_put_together(name):
    frame = named(name)
    kinds = kinds_of(frame)
    assert_can_be_put_together(frame, kinds)
    assert_directions_are_those_of_the_edges(frame, kinds)


#: In these, one key at the same edge of every joint leaves no loop of whole connectors: of four
#: edges in a row every other direction is left, of three a zigzag or lone edges, of 3.6.3.6
#: lines.  In 4.6.12 every edge is between a joint and one that is turned over, in the same place
#: of both, so that keys in one place would take both ends of some edges and leave loops: the
#: joints that are turned over have theirs elsewhere.
ONE_KIND = {
    "hexagonal": 1,
    "square": 1,
    "3.6.3.6": 1,
    "4.8.8": 1,
    "3.12.12": 1,
    "4.6.12": 2,
}


@pytest.mark.parametrize("name", ONE_KIND)
def test_a_tiling_of_alike_vertices_has_one_kind_of_joint_rim_included(name):
    kinds = kinds_of(named(name))
    assert len(kinds.kinds) == ONE_KIND[name]
    assert {len(kind.keys) for kind in kinds.kinds} == {1}


def seen(joint, kind, slot):
    """A joint from one of its edges on: walls and keys counter-clockwise, and clockwise.

    Turned over it is seen the other way around.
    """
    steps = walls_of(joint, kind)
    ahead = np.roll(steps, -slot, axis=0).ravel()
    keys = [(slot + n) % len(steps) in kind.keys for n in range(len(steps))]
    onwards = *ahead.round(6).tolist(), *keys
    back = *ahead[::-1].round(6).tolist(), *keys[:1], *keys[:0:-1]
    return onwards, back


def walls_of(joint, kind):
    """From each edge to the wall after it, and from there to the next edge."""
    after = wall_angles(
        Spokes.flat(joint.directions), any_joint(float(joint.gaps.min())), kind.keys
    )
    return np.column_stack([after, joint.gaps - after])


def element_count(frame, kinds):
    """How many edge elements differ in an end or in their length.

    An end is a socket of a shape's joints, or a connector with its joint's walls around it as
    they are seen from its edge.
    """
    found = set()
    for pair, slots, length in zip(frame.edges, kinds.slots, frame.lengths, strict=True):
        ends = []
        for vertex, slot in zip(pair, slots, strict=True):
            number, over = kinds.kind_of[vertex], kinds.over[vertex]
            kind = kinds.kinds[number]
            views = seen(kinds.shape(number), kind, slot)
            socket = (("socket", kind.shape),) * 2
            ends.append(socket if slot in kind.keys else views[::-1] if over else views)
        forms = [[ends[a][flip], ends[b][flip]] for a, b in ((0, 1), (1, 0)) for flip in (0, 1)]
        found.add((*min(forms, key=repr), round(length, 6)))
    return len(found)


#: What a tiling takes, reasoned out by hand: keys at a joint, kinds of joints, edge elements.
#:
#: Keys.  A joint of d edges has d / 2 to itself, of which a forest leaves one whole: d / 2 - 1
#: keys, rounded up, and one at least.
#:
#: Joints.  Turns and shifts carry every vertex of a uniform tiling to every other, but in 4.6.12,
#: where every other one is turned over, and has its key at another edge (see `ONE_KIND`).  In
#: 3.4.6.4 no one slot does for all, as hexagons would be closed by whole connectors or triangles:
#: some joints have their key at another edge.
#:
#: Elements, where a joint looks the same after a full turn only: one for each set of edges that
#: turns and shifts of the tiling carry onto each other.
#:   4.8.8, 3.12.12: edges of the small polygon, and those between two of them.
#:   4.6.12: between square and hexagon, square and dodecagon, hexagon and dodecagon.
#:   3.3.4.3.4: between two triangles; between triangle and square there are two a vertex, one to
#:     the left of the square's corner and one to the right, each of which is the other turned over:
#:     of both the other end is a key's, and the wall in the square nearer to a key than to it.
#:   3.3.3.4.4: between squares, between square and triangle, and two slants between triangles.
#:   3.3.3.3.6: around hexagons; between triangles those that a half turn reverses, and the others.
#: Where a joint would look the same after less, its key tells its edges apart, but for those that
#: are as far from it on either side: a half turn about the key's edge swaps them.
#:   square, rectangular, rhombic, triangular: every joint is turned alike, so that one for each
#:     direction of an edge; across the key's edge an edge goes between such a pair.  A triangular
#:     joint's two keys are next to each other, and each is the other turned over about the line
#:     between them, and so are the edges that go on behind them: two directions have one element.
#:   hexagonal: the two edges beside the key are such a pair, so that there is one with keys at
#:     both ends, and one with none.
#:   3.6.3.6: of four slots each meets the next one, around.
#:   ring: every edge goes from a joint's first slot to the next one's second.
#:   ladder, strip: a half turn carries one rail to the other, so that there is one element for
#:     both rails, and one for the rungs; of a strip's slants one for each direction.
TILINGS = {
    "hexagonal": (1, 1, 2),
    "square": (1, 1, 2),
    "rectangular": (1, 1, 2),
    "rhombic": (1, 1, 2),
    "triangular": (2, 1, 2),
    "ring": (1, 1, 1),
    "3.6.3.6": (1, 1, 4),
    "4.8.8": (1, 1, 2),
    "3.12.12": (1, 1, 2),
    "4.6.12": (1, 2, 3),
    "3.3.4.3.4": (2, 1, 2),
    "3.3.3.4.4": (2, 1, 4),
    "3.3.3.3.6": (2, 1, 3),
    "3.4.6.4": (1, 2, 6),
    "ladder": (1, 1, 2),
    "strip": (1, 1, 3),
}


@pytest.mark.parametrize("name", TILINGS)
def test_a_tiling_has_the_keys_and_parts_reasoned_out_by_hand(name):
    keys, joints, elements = TILINGS[name]
    frame = named(name)
    kinds = kinds_of(frame)
    assert {len(kind.keys) for kind in kinds.kinds} == {keys}
    assert len(kinds.kinds) == joints
    assert element_count(frame, kinds) == elements


@pytest.mark.parametrize("name", ["3.4.6.4", "cairo"])
def test_a_drawing_has_the_same_kinds_however_it_is_turned(name):
    # Three decimals change directions a little, so that no fixed steps of an angle tell them apart.
    frame = named(name, rows=2, columns=2)
    found = set()
    for degrees in (0, 19, 30, 79):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        points = (frame.plan @ np.array([[c, s], [-s, c]])).round(3)
        kinds = kinds_of(make_frame(name, points, frame.edges))
        keys = sum(len(kinds.kinds[number].keys) for number in kinds.kind_of)
        found.add((len(kinds.kinds), keys))
    assert len(found) == 1


def test_a_path_has_the_same_kinds_however_it_is_turned():
    # Its only face is the outer one, and has no area but for rounding.
    path = np.array([[0, 0], [0, 120], [0, 240], [-120, 240]])
    found = set()
    for degrees in range(0, 360, 15):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        frame = make_frame("path", path @ np.array([[c, s], [-s, c]]), [[0, 1], [1, 2], [2, 3]])
        kinds = kinds_of(frame)
        counts = np.bincount(kinds.kind_of).tolist()
        gaps = [kinds.shape(number).gaps.min() for number in range(len(kinds.kinds))]
        found.add((*np.degrees(gaps).round(6).tolist(), *counts))
    # The bend, and three straight joints: at its ends with a cap.
    assert found == {(90, 180, 1, 3)}


#: The duals by cell, which shifts repeat: how many joints of how many edges there are, each kind
#: of face of the tiling making one kind of joint; and how many keys each has.
#:
#: Keys.  Of a cell's edges a forest leaves as many whole as it has joints.  All others have a key,
#: and every joint has one.
#:
#: Elements.  Joints of one kind that shifts do not carry to each other are turned otherwise, and
#: so may be their keys: one for each edge of the cell is enough.  Of the joint of the most edges,
#: an edge's element tells how far it is from the key, to whichever side; with several keys next to
#: each other, where exactly it is.  So there are as many elements at least as there are such
#: places, the keys' being one, less where an element has such places at both ends.
DUALS = {
    "V3.6.3.6": ({3: 2, 6: 1}, {3: 1, 6: 1}, 1 + 3),
    "V3.4.6.4": ({3: 2, 4: 3, 6: 1}, {3: 1, 4: 1, 6: 1}, 1 + 3),
    # Of eight edges every other one goes to a joint of its own kind, in the opposite place.
    "V4.8.8": ({4: 1, 8: 1}, {4: 3, 8: 1}, 1 + 4),
    "V3.3.4.3.4": ({3: 4, 4: 2}, {3: 1, 4: 1}, 1 + 2),
    "V3.3.3.4.4": ({3: 2, 4: 1}, {3: 1, 4: 1}, 1 + 2),
    # Of twelve edges every other one goes to a joint of its own kind, in the opposite place: with
    # four keys the eight places left are four by themselves, one pair, and two opposite a key.
    "V3.12.12": ({3: 2, 12: 1}, {3: 1, 12: 4}, 4 + 1 + 2),
}


@pytest.mark.parametrize("name", DUALS)
def test_a_dual_has_the_keys_and_parts_reasoned_out_by_hand(name):
    joints, keys, least = DUALS[name]
    edges = sum(size * count for size, count in joints.items()) // 2
    vertices = sum(joints.values())
    assert sum(keys[size] * joints[size] for size in joints) == max(vertices, edges - vertices)
    frame = named(name)
    kinds = kinds_of(frame)
    assert {
        len(kinds.shape(n).directions): len(kind.keys) for n, kind in enumerate(kinds.kinds)
    } == keys
    assert len(kinds.kinds) == len(joints)
    assert least <= element_count(frame, kinds) <= edges


def test_without_caps_a_corner_is_a_joint_of_its_own():
    frame = named("square")
    assert [len(shape.directions) for shape in kinds_of(frame).shapes] == [4]
    bare = kinds_of(frame, rim=False)
    assert sorted(len(shape.directions) for shape in bare.shapes) == [2, 3, 4]
    assert_can_be_put_together(frame, bare)


def test_a_lone_end_gets_two_caps():
    frame = make_frame("stick", [[0, 0], [100, 0]], [[0, 1]])
    (kind,) = kinds_of(frame).kinds
    assert len(kinds_of(frame).shapes[0].directions) == 3
    assert len(kind.caps) == 2


def delaunay(seed, count):
    points = np.random.default_rng(seed).uniform(0, 300, (count, 2))
    corners = Delaunay(points).simplices
    pairs = np.sort(np.concatenate([corners[:, :2], corners[:, 1:], corners[:, ::2]]), axis=1)
    return make_frame("random", points, np.unique(pairs, axis=0))


@given(st.integers(0, 2**32 - 1), st.integers(3, 25))
def test_random_frames_can_be_put_together(seed, count):
    frame = delaunay(seed, count)
    kinds = kinds_of(frame)
    assert_can_be_put_together(frame, kinds)
    assert_directions_are_those_of_the_edges(frame, kinds)
    # One key a vertex, or one an edge beyond a spanning tree: no fewer would do.
    keys = sum(len(kinds.kinds[kind].keys) for kind in kinds.kind_of)
    beyond = len(frame.edges) - len(frame.vertices) + 1
    assert max(len(frame.vertices), beyond) <= keys
    # Joints that are alike may take more, for fewer parts: then each of a shape has as many.
    if keys > len(frame.vertices) + beyond:
        shapes = {(kind.shape, len(kind.keys)) for kind in kinds.kinds}
        assert len(shapes) == len(kinds.shapes)


@given(st.integers(0, 2**32 - 1))
def test_a_grid_that_is_a_little_off_has_a_joint_at_every_vertex(seed):
    # Some of its joints are alike within what is told apart, some just not, and so on in a chain.
    points = np.stack(np.meshgrid([0.0, 100.0, 200.0], [0.0, 100.0, 200.0]), axis=-1).reshape(-1, 2)
    points += np.random.default_rng(seed).uniform(-0.03, 0.03, points.shape)
    rows = [[n, n + 1] for n in range(9) if n % 3 < 2]
    frame = make_frame("grid", points, [*rows, *([n, n + 3] for n in range(6))])
    assert_can_be_put_together(frame, kinds_of(frame))


def fork(*degrees):
    """A vertex with lone edges in these directions."""
    ends = 100 * np.exp(1j * np.radians(degrees))
    points = np.concatenate([[[0, 0]], np.column_stack([ends.real, ends.imag])])
    return make_frame("fork", points, [[0, n] for n in range(1, len(points))])


def forks_of(kinds):
    """From the first key on, the gaps of joints with narrow ones; lone ends have none."""
    found = set()
    for number, kind in enumerate(kinds.kinds):
        gaps = np.degrees(np.roll(kinds.shape(number).gaps, -kind.keys[0])).round().astype(int)
        if gaps.min() < 60:
            found.add((tuple(gaps.tolist()), len(kind.keys)))
    return found


def test_a_joint_that_is_refused_is_made_with_another_key():
    frame = fork(0, 50, 150)
    ways = {(50, 100, 210), (100, 210, 50), (210, 50, 100)}
    refused: list[Refused] = []
    while ways:
        ((gaps, keys),) = forks_of(kinds_of(frame, refused=refused))
        assert keys == 1
        ways.remove(gaps)  # which no key before made
        refused.append(Refused(tuple(np.cumsum([0.0, *gaps[:-1]]).tolist()), (0,)))
    # Where all are refused one of them is made all the same.
    assert len(forks_of(kinds_of(frame, refused=refused))) == 1


def refused_of(kinds, number):
    """The joint of a kind, to be kept out."""
    directions, keys = kinds.shape(number).directions, kinds.kinds[number].keys
    turns = np.degrees((np.roll(directions, -keys[0]) - directions[keys[0]]) % (2 * np.pi))
    return Refused(tuple(turns), tuple((slot - keys[0]) % len(directions) for slot in keys))


@pytest.mark.parametrize("seed", range(8))
def test_keys_of_refused_joints_move_along_the_loops_they_are_on(seed):
    frame = delaunay(seed, 12 + seed)
    kinds, refused = kinds_of(frame), []
    for _ in range(3):
        most = max(range(len(kinds.kinds)), key=lambda n: len(kinds.kinds[n].keys))
        refused.append(refused_of(kinds, most))
        kinds = kinds_of(frame, refused=refused)
        assert_can_be_put_together(frame, kinds)
        for number, kind in enumerate(kinds.kinds):
            directions = kinds.shape(number).directions
            assert not any(one.is_like(directions, kind.keys) for one in refused)


def test_lone_ends_do_not_take_the_wide_ring_of_a_narrow_joint():
    kinds = kinds_of(fork(0, 50, 150))
    gaps = {tuple(np.degrees(shape.gaps).round().tolist()) for shape in kinds.shapes}
    assert gaps == {(50, 100, 210), (120, 120, 120)}
