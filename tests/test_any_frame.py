"""Kits of any frame: joints of unequal angles, several kinds of parts."""

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from kits import bounds, drawn, once
from scipy.spatial import cKDTree

from scadgen.check.geometry import closed, footprint, gaps, partition, placed, same
from scadgen.check.locking import joint_locks
from scadgen.check.proof import proved
from scadgen.element.pieces import half
from scadgen.emit.part_words import words
from scadgen.emit.placing import placing
from scadgen.emit.readme import readme
from scadgen.emit.scad import scad
from scadgen.emit.scad_parameters import views
from scadgen.errors import GeometryError, InputError, KitError
from scadgen.frame.element_classes import ElementEnds
from scadgen.frame.placement import Place, Placement
from scadgen.joint.symmetry import Symmetry
from scadgen.joint.weave import any_joint
from scadgen.kit.bill import lines
from scadgen.kit.build import build
from scadgen.kit.named import Named, alike_pieces
from scadgen.kit.pieces import best_pieces
from scadgen.kit.store import dumps, loads, summary
from scadgen.plan.motion import motion_of
from scadgen.plan.order import make_plan
from scadgen.plan.standing import stand
from scadgen.plan.text import plan_text
from scadgen.plan.whole import whole_frame
from scadgen.plane.catalogue import named
from scadgen.plane.drawn import make_frame
from scadgen.solid.gap import smallest_gap
from scadgen.solid.mesh import volume
from scadgen.solid.pose import Pose
from scadgen.tools.openscad import render
from scadgen.tools.stl import check_stl

#: Three edges at unequal angles, and a fourth that hangs on one of them.
FORK = [[0, 0], [100, 0], [-30, 110], [-60, -90], [190, 60]], [[0, 1], [0, 2], [0, 3], [1, 4]]


def request(frame, **changes):
    return drawn("any", frame, **{"resizable": True} | changes)


def ladder():
    return once("any-ladder", lambda _: build(request(named("ladder", bays=2))))


def fork():
    return once("any-fork", lambda _: build(request(make_frame("fork", *FORK))))


def dozen():
    """A patch of 4.6.12, of whose joints every other one is turned over."""
    graph = named("4.6.12", rows=1, columns=1)
    return once("any-dozen", lambda _: build(request(graph)))


def butterfly():
    """Two joints with their edges the other way around from each other, and lone ends."""
    left = [[0, 0], [-20, 120], [-80, -90]]
    points = [*left, *([200 - x, y] for x, y in left)]
    graph = make_frame("butterfly", points, [[0, 1], [0, 2], [3, 4], [3, 5], [0, 3]])
    return once("any-butterfly", lambda _: build(request(graph)))


def all_of(*made):
    return pytest.mark.parametrize("made", made)


def test_the_parts_of_a_ladder_are_those_reasoned_out_by_hand():
    # Six vertices, all of three directions: right, up and left, where the rail ends a cap.  One
    # key each, at the edge to the left seen from a rung: rungs are whole at both ends, and so
    # are two of the four pieces of rails at one end.
    made = ladder()
    (joint,) = made.joints
    assert joint.turns == (0.0, 90.0, 180.0)
    assert len(joint.keys) == 1
    bill = summary(made)["bill"]
    assert sum(n for part, n in bill.items() if part.startswith("edge_")) == 7
    assert sum(n for part, n in bill.items() if part.startswith("half_")) == 12
    assert bill["peg"] == 6
    connectors = sum(n for part, n in bill.items() if part.startswith("connector_"))
    ends = {"edge_1", "edge_2", "edge_3"} & set(bill)
    assert ends
    # Each joint has two halves and two whole connectors, at elements or as caps.
    whole = sum(
        n * sum(1 for p in _ends(made, part) if p) for part, n in bill.items() if part in ends
    )
    assert whole + connectors == 12


def test_the_parts_of_4612_are_those_reasoned_out_by_hand():
    # Each edge is between two joints that have their edges the other way around, and their keys at
    # different ones.  So there are two kinds of joints, and an element for each kind of edge:
    # between square and hexagon, square and dodecagon, hexagon and dodecagon.
    made = dozen()
    assert [len(joint.turns) for joint in made.joints] == [3, 3]
    assert len(made.elements) == 3
    assert {vertex.joint for vertex in made.vertices} == {"A", "B"}
    for place in made.placements:
        if place.is_element:
            near, far = (made.vertices[end.vertex].joint for end in place.ends)
            assert near != far


def test_one_of_two_joints_is_turned_over():
    made = butterfly()
    over = {place.vertex for place in made.placements if place.role == "half_a" and place.pose.over}
    assert len(over) == 1
    # Its wings are two elements, and each is at one of the joints turned over.
    bill = summary(made)["bill"]
    assert sorted(bill[name] for name in made.elements) == [1, 2, 2]
    wings = [place for place in made.placements if bill[place.part] == 2 and place.role != "peg"]
    flips = [place.pose.over for place in wings if place.part in made.elements]
    assert sorted(flips) == [False, False, True, True]


def test_halves_of_one_shape_have_one_name():
    # In 3.4.6.4 half B of the joint with its key between squares is half A turned over, though
    # the joint is not alike on both sides of that edge.
    made = build(request(named("3.4.6.4", rows=1, columns=1)))
    assert sorted(len(joint.half_parts) for joint in made.joints) == [1, 2]


def spiders():
    """Three joints of three edges, no two angles the same, in a row."""
    middles = np.array([[0.0, 0.0], [200.0, -90.0], [390.0, -30.0]])
    points, edges = middles.tolist(), [[0, 1], [1, 2]]
    for start, turns in ((0, (115, 225)), (1, (270,)), (2, (75, 315))):
        for turn in np.radians(turns):
            edges.append([start, len(points)])
            points.append((middles[start] + 150 * np.array([np.cos(turn), np.sin(turn)])).tolist())
    return points, edges


def test_joints_with_wide_gaps_beside_their_keys_share_their_halves():
    # Walls beside a key are the same in wide gaps, so that halves A of all joints whose rings are
    # equally large are one part, and halves B.  Lone ends are such joints with caps.
    made = build(request(make_frame("spiders", *spiders())))
    assert len({joint.turns for joint in made.joints}) == 3
    for role in ("half_a", "half_b"):
        assert len({p.part for joint in made.joints for p in joint.pieces if p.role == role}) == 1
    # They are no other shape than what each joint by itself is given.
    for joint in made.joints:
        weave = any_joint(math.radians(np.diff([*joint.turns, 360]).min()))
        own = best_pieces(joint.directions, weave, made.key, made.detail, joint.keys, bored=False)
        for piece, role in zip(own.halves[joint.keys[0]], ("half_a", "half_b"), strict=True):
            (name,) = {p.part for p in joint.pieces if p.role == role}
            shared, solid = made.parts[name], half(own.key, piece)
            for clearance in (0.0, 0.5):
                values = {**made.values, "clearance": clearance}
                far = cKDTree(shared.points(values)).query(solid.points(values))[0]
                assert far.max() < 1e-4


def test_parts_know_the_kind_of_joint_that_they_are_pieces_of():
    made = dozen()
    assert made.cells is None
    for place in made.placements:
        joints = [made.joint(made.vertices[end.vertex].joint) for end in place.ends]
        if not place.is_element:
            mine = [p for p in joints[0].pieces if (p.role, p.slot) == (place.role, place.slot)]
            assert [p.part for p in mine] == [place.part]
            continue
        for end, joint, own in zip(place.ends, joints, made.parts[place.part].ends, strict=True):
            assert own.is_key == (end.slot in joint.keys)
    again = loads(dumps(made))
    assert again.placements == made.placements
    assert again.vertices == made.vertices


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"A": "C"}, "vertices: there is no joint 'C'"),
        ({"A": "B", "B": "A"}, "does not belong where it is"),
    ],
)
def test_pieces_of_another_kind_of_joint_are_refused(changed, message):
    made = dozen()
    vertices = tuple(replace(v, joint=changed.get(v.joint, v.joint)) for v in made.vertices)
    with pytest.raises(KitError, match=message):
        loads(dumps(replace(made, vertices=vertices)))


def test_kinds_of_joints_have_different_names():
    made = dozen()
    first, second = made.joints
    with pytest.raises(KitError, match="two are called 'A'"):
        loads(dumps(replace(made, joints=(first, replace(second, name="A")))))


def test_connectors_between_the_same_walls_are_one_part_in_joints_of_any_kind():
    # All with their key at the first edge.  The edge opposite is between gaps of 90 and 100
    # degrees, the other way around in the third joint and of 90 twice in the last: walls there
    # know nothing of the key or of the other gaps.  So do walls beside keys in gaps as wide as
    # these: all first connectors are one.  The third joint is the first one turned over.
    joints = (95, 90, 100, 75), (75, 90, 100, 95), (75, 100, 90, 95), (75, 90, 90, 105)
    weave = any_joint(math.radians(75))
    rings = [np.radians(np.cumsum([0, *gaps[:-1]])) for gaps in joints]
    made = [best_pieces(ring, weave, "loose", "draft", [0], bored=False) for ring in rings]
    found = Named(made, [Symmetry(4, 4, None)] * 4)
    opposite = [found.connector(number, 2) for number in range(4)]
    assert opposite[:2] == [("connector_A3", False)] * 2
    assert opposite[2:] == [("connector_A3", True), ("connector_D3", False)]
    assert {found.connector(number, 0)[0] for number in range(4)} == {"connector_A1"}
    assert [found.connector(2, slot) for slot in (1, 3)] == [
        ("connector_A4", True),
        ("connector_A2", True),
    ]
    # Only the one between equal gaps is itself turned over.
    assert np.argwhere(found.slots.either).tolist() == [[3, 2]]
    # An edge that ends in them is one element too, whichever kind of joint it is at.
    same = found.slots.what[[0, 1, 2, 3], 2]
    over = found.slots.over[[0, 1, 2, 3], 2]
    ends = ElementEnds(
        np.column_stack([same, np.full(4, 99)]),
        np.column_stack([over, np.zeros(4, dtype=bool)]),
        np.tile([False, True], (4, 1)),
        np.ones(4),
    )
    assert ends.alike().which.tolist() == [0, 0, 0, 1]


def test_a_joint_turned_over_has_the_same_connectors_turned_over():
    gaps = np.radians([100.0, 120.0, 140.0])
    sides = [np.cumsum([0.0, *own[:-1]]) for own in (gaps, gaps[::-1])]
    weave = any_joint(gaps.min())
    made = [best_pieces(own, weave, "loose", "draft", [0], bored=False) for own in sides]
    both = [piece for one in made for piece in one.connectors]
    found = alike_pieces(both, [0] * 6, turned=True)
    assert found[:3] == [(0, False), (1, False), (2, False)]
    assert found[4:] == [(2, True), (1, True)]
    assert found[3][0] == 0
    # Nothing is turned over unless it may be, and other groups are other parts.
    assert alike_pieces(both, [0] * 6, turned=False)[4:] == [(4, False), (5, False)]
    assert alike_pieces(both, range(6), turned=True) == [(n, False) for n in range(6)]


def test_a_plan_tells_what_lies_the_other_way_up():
    made = proved(butterfly())
    plan = make_plan(made)
    assert plan.proved
    assert whole_frame(plan.standing).held
    text = " ".join(plan_text(plan, whole_frame(plan.standing)).split())
    for place in made.placements:
        if place.other_way_up:
            how = "turned over" if place.pose.over else "as printed"
            assert f"{place.part}, {how}," in text
    # The way of a half into the joint that is turned over is the other one's, turned over.
    halves = {}
    for move in (move for step in plan.steps if step.what == "halves" for move in step.moves):
        (part,) = move.parts
        halves[made.placements[part].part, move.origin.over] = move
    both = {name for name, over in halves if over} & {name for name, over in halves if not over}
    assert both
    for name in both:
        one, other = halves[name, False], halves[name, True]
        assert motion_of(plan, one).above == -motion_of(plan, other).above != 0


@pytest.mark.parametrize("name", ["butterfly", "V3.3.4.3.4", "V3.6.3.6"])
def test_what_is_turned_over_is_one_clearance_from_its_neighbours(name):
    # All around each joint, as everything stands in the frame.
    tiling = name != "butterfly"
    made = build(request(named(name, rows=2, columns=2))) if tiling else butterfly()
    assert any(place.other_way_up for place in made.placements)
    clearance, unit, side = (made.values[n] for n in ("clearance", "edge_length", "side"))
    meshes = [placed(made, place, made.values) for place in made.placements]
    reach = side * max(joint.key.tube_start for joint in made.joints)
    for at in {vertex.pose.at for vertex in made.vertices}:
        around = [
            (points, triangles)
            for place, (points, triangles) in zip(made.placements, meshes, strict=True)
            if place.role != "peg"
            and np.hypot(*(points[:, :2] - unit * np.array(at[:2])).T).min() < reach
        ]
        found = [smallest_gap(*a, *b, 10.0) for a, b in itertools.combinations(around, 2)]
        touching = [gap for gap in found if gap < 2 * clearance]
        assert len(touching) >= len(around)
        assert min(found) > 0.9 * clearance


def _ends(made, name):
    """Whether each end of an element has a whole connector: it reaches behind its vertex."""
    points = made.parts[name].points(made.values)
    length = made.values["edge_length"] * made.parts[name].coefficients["edge_length"][:, 0].max()
    reach = 1.2 * made.values["side"]
    yield points[:, 0].min() < reach
    yield points[:, 0].max() > length - reach


@all_of(ladder, fork, butterfly)
def test_a_kit_read_back_is_the_kit_that_was_written(made):
    text = dumps(made())
    assert dumps(loads(text)) == text


@all_of(ladder, fork, butterfly)
def test_its_parameters_make_it_again(made):
    assert same(made()).good


@pytest.mark.parametrize("name", ["ring", "3.6.3.6", "V3.3.4.3.4"])
def test_a_frame_that_grew_for_its_joints_makes_the_same_kit_again(name):
    assert same(build(request(named(name)))).good


@all_of(ladder, fork, butterfly)
def test_its_solids_are_sound_and_its_joints_lock(made):
    kit = made()
    results = list(closed(kit))
    for joint in kit.joints:
        results += [*partition(kit, joint), footprint(kit, joint), *gaps(kit, joint)]
        results += joint_locks(kit, joint)
    assert [result for result in results if not result.good] == []


@all_of(ladder, fork, butterfly)
def test_openscad_draws_all_of_it(made, tmp_path):
    kit = made()
    file = tmp_path / "any.scad"
    file.write_text(scad(kit), encoding="ascii")
    content = {n: volume(s.points(kit.values), s.triangles) for n, s in kit.parts.items()}
    for name in [next(iter(kit.parts)), *views(kit)]:
        render(file, tmp_path / "one.stl", {"part": name, "bed": [400.0, 400.0]}, timeout=120)
        found = check_stl(tmp_path / "one.stl")
        if name in content:
            assert found == pytest.approx(content[name], rel=1e-6)
        if name == "frame":
            expected = sum(content[p.part] for p in kit.placements)
            assert found == pytest.approx(expected, rel=1e-6)


def test_its_joints_turn_with_the_frame():
    turn = 0.3
    c, s = math.cos(turn), math.sin(turn)
    points = np.array(FORK[0]) @ [[c, s], [-s, c]]
    turned = build(request(make_frame("fork", points, FORK[1])))
    assert sorted(turned.parts) == sorted(fork().parts)
    for name, solid in fork().parts.items():
        ours, theirs = (
            volume(x.points(kit.values), x.triangles)
            for x, kit in ((solid, fork()), (turned.parts[name], turned))
        )
        assert theirs == pytest.approx(ours, rel=1e-6)


def test_a_picture_says_where_each_piece_goes():
    made = fork()
    text = placing(made)
    assert len(re.findall('text-anchor="start">([^<]+)<', text)) == 5 + ("*" in text)
    text = text.partition('text-anchor="start"')[0]  # without the legend
    text = text[: text.rindex("<circle")]
    names = re.findall(r"<text[^>]*>([^<]*)</text>", text)
    several = len(made.joints) > 1  # a lone kind of joint has no letter
    expected = []
    for place in made.placements:
        other = "*" if place.role != "peg" and place.pose.over != (place.role == "half_b") else ""
        if place.is_element:
            expected.append(place.part + other)
        elif place.role == "cap":
            expected.append(place.part.removeprefix("connector_") + other)
        elif place.role == "half_a":
            expected.append((made.vertices[place.vertex].joint if several else "") + other)
    numbers = [str(number) for number in range(1, len(FORK[0]) + 1)]
    assert sorted(names) == sorted([*expected, *numbers])
    assert text.count('r="14.0"') == len(FORK[0])


@all_of(ladder(), fork(), dozen())
def test_elements_are_marked_where_their_ends_differ(made):
    uneven = set()
    for name in made.elements:
        points = made.parts[name].points(made.values)
        length = points[:, 0].min() + points[:, 0].max()
        about = [length, 0.0, 0.0] - points * [1.0, 1.0, -1.0]
        if cKDTree(points).query(about)[0].max() > 1e-6:
            uneven.add(name)
    assert {name for name, part in made.parts.items() if part.fits_one_way} == uneven
    circles = [
        np.array(re.findall(rf'cx="(.*?)" cy="(.*?)" r="{radius}"', placing(made)), dtype=float)
        for radius in ("14.0", "3.0")
    ]
    joints, dots = (found[:-1] for found in circles)  # without the legend
    first = next(p for p in made.placements if p.role == "half_a")
    expected = []
    for place in made.placements:
        if place.part in uneven:
            off = 120 * np.subtract(place.pose.at, first.pose.at)[:2]
            off += 1.4 * 14 * np.array(place.pose.x[:2])
            expected.append(joints[0] + off * (1, -1))
    assert len(dots) == len(expected) > 0
    assert np.abs(dots - expected).max() < 0.2


@all_of(ladder(), fork(), dozen(), butterfly())
def test_the_bill_says_what_is_at_the_ends_of_elements(made):
    said = words(made)
    ends = {}
    for site in stand(made).sites:
        for number, part in [*site.parts.items(), *site.tubes.items()]:
            piece, place = site.kind.pieces[number], made.placements[part]
            if place.part not in made.elements:
                continue
            end = "socket"
            if piece.role == "cap":
                points = made.parts[piece.part].points(made.values)
                even = cKDTree(points).query(points * [1, -1, -1])[0].max() < 1e-6
                over = not even and piece.pose.over != (site.pose.over != place.pose.over)
                end = piece.part.replace("_", " ") + (" turned over" if over else "")
            far = not np.allclose(place.pose.at, site.pose.at, rtol=0, atol=1e-6)
            ends.setdefault(place.part, [set(), set()])[far].add(end)
    assert ends.keys() == set(made.elements)
    for name, found in ends.items():
        (near,), (far,) = found
        times = made.parts[name].coefficients["edge_length"].max()
        length = f"{times * made.values['edge_length']:.1f}".removesuffix(".0")
        assert said[name] == f"Edge element, {length} mm, {near} to {far}"
    assert f"| {said['edge_1']} |" in readme(made)


def test_a_second_shape_of_a_half_is_not_told_as_one_turned_over():
    said = words(ladder())
    assert said["half_A1_over"] == "Locking half A1 - second shape"
    assert "`half_A1_over` is a shape of its own, not another half turned over." in readme(ladder())


@pytest.mark.parametrize("narrow", [26, 40])
def test_a_straight_gap_is_no_more_than_half_a_turn_however_it_is_rounded(narrow):
    turns = np.radians([-narrow, 0, narrow, 90, 270])
    points = np.vstack([[0, 0], 300 * np.column_stack([np.cos(turns), np.sin(turns)])])
    made = build(request(make_frame("cross", points, [[0, n] for n in range(1, 6)])))
    assert len(made.elements) == 3  # the middle one, and two that come twice


def test_an_edge_that_is_too_long_is_refused_with_its_place():
    words = (
        r"edge 0 from vertex 0 at \(0, 0\) to vertex 1 at \(2100, 0\), 2100 mm .*at most 2000 mm"
    )
    with pytest.raises(GeometryError, match=words):
        build(request(make_frame("long", [[0, 0], [2100, 0], [2100, 300]], [[0, 1], [1, 2]])))


def test_what_cannot_be_built_is_refused_with_its_place():
    near = make_frame("near", [[0, 0], [200, 0], [199, 20]], [[0, 1], [0, 2]])
    with pytest.raises(InputError, match=r"vertex 0 at \(0, 0\), angles 5\.\d+, .*at least 25"):
        build(request(near))
    with pytest.raises(InputError, match="side = 3 mm: must be 5 to 100 mm"):
        build(request(make_frame("fork", *FORK), values={"side": 3.0}))
    triangle = make_frame("three", [[0, 0], [200, 0], [90, 210]], [[0, 1], [1, 2], [0, 2]])
    with pytest.raises(InputError, match=r"key = 'fixed': .* loose pegs fit every frame"):
        build(drawn("any", triangle, key="fixed"))


@pytest.mark.parametrize("values", [{}, {"peg_length": 15.0}, {"clearance": 0.4}], ids=str)
def test_an_edge_that_is_too_short_is_named_with_the_side_that_would_do(values):
    bent = make_frame("bent", [[0, 0], [70, 0], [70, 200], [300, 200]], [[0, 1], [1, 2], [2, 3]])
    with pytest.raises(GeometryError) as error:
        build(request(bent, resizable=False, values={**values, "side": 12.0}))
    said = re.fullmatch(
        r"edge 0 from vertex 0 at \(0, 0\) to vertex 1 at \(70, 0\), 70 mm long, is ([\d.]+) mm "
        r"too short for its two joints with a side of 12 mm; "
        r"a side of ([\d.]+) mm or a frame ([\d.]+) times as large would do",
        str(error.value),
    )
    missing, side, scale = map(float, said.groups())
    assert scale == pytest.approx((70 + missing) / 70, abs=1e-3)
    for own, times in ((side, 1.0), (12.0, scale)):
        frame = make_frame("bent", bent.plan * times, bent.edges)
        made = build(request(frame, resizable=False, values={**values, "side": own}))
        low, _ = bounds(made, "edge_length", made.values)
        assert low <= made.values["edge_length"] < low + 0.3


def test_what_all_but_meets_is_told_how_to_be_joined():
    points = [[0, 0], [100, 0], [0.3, 0.2], [50, 80]]
    frame = make_frame("open", points, [[0, 1], [2, 3], [1, 3]])
    message = r"edge 0 is 0\.2 mm away \(a larger --tolerance joins ends that are repaired\), "
    with pytest.raises(GeometryError, match=message):
        build(drawn("open", frame, values={"side": 5.0}))


def test_pegs_of_wider_rings_are_of_one_shape_and_told_so():
    # Gaps of 60 and of 90 degrees: rings of 4.05 and of 2.7 sides.
    ends = [[0, 0], [300, 0], [150, 260], [300, 300]]
    frame = make_frame("two", ends, [[0, 1], [0, 2], [1, 3]])
    made = build(request(frame, resizable=False, rim="open"))
    pegs = [part for part in made.parts.values() if part.role == "peg"]
    first, *others = (peg.points(made.values) for peg in pegs)
    for other in others:
        assert other - other.min(axis=0) == pytest.approx(first - first.min(axis=0), abs=1e-9)
    assert len({peg.points(made.values)[:, 0].min() for peg in pegs}) == len(pegs) > 1
    names = ", ".join(f"`{peg.name}`" for peg in pegs)
    assert f"{names} are pegs of one shape" in readme(made)
    # So one of ten of all of them is spare, not of each kind.
    spares = [line.spares for line in lines(made) if line.part.startswith("peg")]
    assert spares == [1] + [0] * (len(pegs) - 1)


def test_edges_of_nearly_one_length_are_as_long_when_the_kit_is_made_again():
    # As people write an equilateral triangle: its sides differ by 0.002 mm, and are one part.
    frame = make_frame("drawn", [[0, 0], [100, 0], [50, 86.6]], [[0, 1], [1, 2], [2, 0]])
    kit = build(drawn("drawn", frame, values={"side": 6.0}))
    assert kit.values["edge_length"] == pytest.approx(
        (frame.lengths.min() + frame.lengths.max()) / 2, abs=1e-6
    )
    assert same(kit).good


def test_a_readme_says_which_half_a_part_is_where_it_is_both():
    # A joint with two keys, the second turned over: half A of one is the part half B of the other.
    made = dozen()
    first = made.joints[0]
    pieces = [p for p in first.pieces if p.role not in ("half_a", "half_b")]
    one, other = sorted(p.part for p in first.pieces if p.role in ("half_a", "half_b"))
    for turn, parts in ((0.0, (one, other)), (90.0, (other, one))):
        for role, part in zip(("half_a", "half_b"), parts, strict=True):
            pose = Pose.flat((0, 0), turn, over=role == "half_b")
            pieces.append(Placement(part, role, pose, (Place(0, 0),)))
    text = readme(replace(made, joints=(replace(first, pieces=tuple(pieces)), *made.joints[1:])))
    assert f"2 x `{one}` (half A at 0°, half B at 90°)" in text
    assert f"2 x `{other}` (half A at 90°, half B at 0°)" in text
