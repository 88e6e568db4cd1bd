"""Kits: requests, ranges, and gaps between all that mates."""

import math
from itertools import combinations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from kits import KINDS, WEAVES, bounds, grid, inside, kit, named

from scadgen.check.geometry import placed
from scadgen.errors import GeometryError, InputError
from scadgen.frame.placement import Place, Placement
from scadgen.joint.weave import Weave
from scadgen.kit.build import build
from scadgen.kit.live import PARAMETERS
from scadgen.kit.ranges import check_values
from scadgen.solid.gap import overlap_volume, smallest_gap
from scadgen.solid.mesh import solid_faults
from scadgen.solid.pose import Pose

kinds = pytest.mark.parametrize("kind", KINDS, ids=named)
CLEARANCES = (0.05, 0.1, 0.2, 0.4)


def request(frame="hexagonal", **more):
    return grid(frame, detail="draft", **more)


def assert_one_line(error, *words):
    text = str(error.value)
    assert "\n" not in text
    assert all(word in text for word in words), text


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"frame": "gearbox"}, ("frame 'gearbox'", "hexagonal, square")),
        ({"key": "glued"}, ("key = 'glued'", "fixed, loose")),
        ({"detail": "ultra"}, ("detail = 'ultra'", "draft, standard, fine")),
        ({"rows": 0}, ("rows = 0", "1 to 100")),
        ({"columns": 101}, ("columns = 101", "1 to 100")),
        ({"values": {"gear": 1.0}}, ("gear", "side, edge_length")),
    ],
)
def test_names_and_counts_that_do_not_exist_are_refused(changes, words):
    with pytest.raises(InputError) as error:
        build(grid(**{"frame": "hexagonal", **changes}))
    assert_one_line(error, *words)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"side": -1.0}, ("side = -1", "a number from 0 to")),
        ({"side": math.nan}, ("side = nan", "a number from 0 to")),
        ({"edge_length": math.inf}, ("edge_length = inf", "a number from 0 to")),
        ({"side": 1.0}, ("side = 1 mm", "5 to 100")),
        ({"clearance": 3.0}, ("clearance = 3 mm", "0 to 0.", "turn over")),
        ({"edge_length": 20.0}, ("edge_length = 20 mm", "to 2000", "room")),
        ({"peg_width": 9.0}, ("peg_width = 9 mm", "socket's walls")),
        ({"peg_width": 0.5}, ("peg_width = 0.5 mm", "1.5 to")),
        ({"peg_length": 30.0}, ("peg_length = 30 mm", "socket breaks")),
        ({"peg_chamfer": 2.0}, ("peg_chamfer = 2 mm", "0.1 to 1")),
        ({"peg_clearance": 2.0}, ("peg_clearance = 2 mm", "0 to 1", "would not hold")),
        ({"bore": 5.0}, ("bore = 5 mm", "through the pegs")),
        ({"bore": 0.5}, ("bore = 0.5 mm", "0.7 to", "clearance = 0.2")),
    ],
)
def test_a_length_that_does_not_work_is_refused_with_what_does(values, words):
    with pytest.raises(InputError) as error:
        build(request(values=values))
    assert_one_line(error, *words)


def test_a_weave_that_loses_the_footprint_is_refused():
    with pytest.raises(GeometryError) as error:
        build(request("square", weave=Weave(1.809, 0.98, 0.093, 0.674, 1.018, "greedy")))
    assert_one_line(error, "weave greedy", "% of a tube's face", "helps")


@kinds
def test_defaults_are_inside_their_ranges_and_follow_the_side(kind):
    made = kit(*kind)
    check_values(made.ranges, made.values)
    assert list(made.values) == [p for p in PARAMETERS if p != "bore" or kind[2]]
    assert made.values["side"] == 10
    assert made.values["edge_length"] in (60, 70, 80)
    assert made.values["clearance"] == made.values["peg_clearance"] == 0.2
    assert {r.parameter for r in made.ranges} == set(made.values)


@pytest.mark.parametrize("side", [5.0, 7.3, 25.0, 100.0])
@pytest.mark.parametrize("key", ["fixed", "loose"])
def test_every_side_has_defaults_that_work(side, key):
    made = build(request(key=key, values={"side": side}))
    assert made.values["side"] == side
    for solid in made.parts.values():
        assert solid_faults(solid.points(made.values), solid.triangles) == []


def test_values_given_are_kept():
    values = {"side": 12.0, "clearance": 0.15, "peg_width": 4.5, "edge_length": 95.0}
    made = build(request("square", rows=3, columns=4, values=values))
    assert {n: made.values[n] for n in values} == values
    assert (made.rows, made.columns) == (3, 4)
    assert made.values["peg_clearance"] == 0.15


def test_the_same_request_gives_the_same_solids():
    one, other = build(request()), build(request())
    for name, solid in one.parts.items():
        again = other.parts[name]
        assert (solid.triangles == again.triangles).all()
        assert (solid.facets == again.facets).all()
        assert all((f == again.coefficients[p]).all() for p, f in solid.coefficients.items())


def test_a_scaled_kit_is_the_kit_scaled():
    made = kit("hexagonal")
    twice = {name: 2 * value for name, value in made.values.items()}
    for solid in made.parts.values():
        assert np.allclose(solid.points(twice), 2 * solid.points(made.values))


@pytest.mark.parametrize(
    ("kind", "detail"),
    [(kind, "draft") for kind in KINDS] + [(kind, "standard") for kind in KINDS if not kind[2]],
    ids=lambda x: x if isinstance(x, str) else named(x),
)
def test_all_that_mates_is_one_clearance_apart(kind, detail):
    made = kit(*kind, detail)
    pieces = list(made.joints[0].pieces)
    if made.key == "loose":
        # The tube with the peg's other socket; it starts where the halves end.
        pieces.append(Placement("two_sided", "cross", Pose(), (Place(0, 0), Place(1, 0))))
    pairs = list(combinations(range(len(pieces)), 2))
    almost = meshes_at(made, pieces, 0.01)
    mating = [(a, b) for a, b in pairs if smallest_gap(*almost[a], *almost[b], limit=1.0) < 0.02]
    roles = {frozenset((pieces[a].role, pieces[b].role)) for a, b in mating}
    assert {
        frozenset(pair)
        for pair in (
            ("cap",),
            ("half_a", "half_b"),
            ("half_a", "cap"),
            ("half_b", "cap"),
            ("half_a", "peg"),
            ("half_b", "peg"),
        )
    } <= roles
    assert made.key == "fixed" or {frozenset(("peg", "cross"))} < roles
    for clearance in CLEARANCES:
        meshes = meshes_at(made, pieces, clearance)
        for a, b in pairs:
            gap = smallest_gap(*meshes[a], *meshes[b], limit=1.0)
            who = (pieces[a], pieces[b], clearance)
            assert gap > 0.9 * clearance, who
            assert (a, b) not in mating or gap < 1.1 * clearance, who
            assert overlap_volume(*meshes[a], *meshes[b]) == 0, who


def meshes_at(made, pieces, clearance):
    values = {**made.values, "clearance": clearance, "peg_clearance": clearance}
    check_values(made.ranges, values)
    return [placed(made, piece, values) for piece in pieces]


shares = st.lists(
    st.one_of(st.sampled_from([0.0, 1.0]), st.floats(0, 1)),
    min_size=len(PARAMETERS),
    max_size=len(PARAMETERS),
)


@settings(max_examples=60)
@given(st.sampled_from(KINDS), shares)
def test_every_part_is_sound_anywhere_inside_the_ranges(kind, chosen):
    made = kit(*kind)
    values = inside(made, chosen)
    assume(values is not None)
    check_values(made.ranges, values)
    for name, solid in made.parts.items():
        assert solid_faults(solid.points(values), solid.triangles) == [], name


@given(st.sampled_from(KINDS), shares, st.sampled_from(PARAMETERS), st.booleans())
def test_outside_any_range_is_refused_with_value_and_range(kind, chosen, name, high):
    made = kit(*kind)
    values = inside(made, chosen)
    assume(values is not None and name in values)
    low, top = bounds(made, name, values)
    values[name] = top + 1e-3 if high else low - 1e-3
    with pytest.raises(InputError) as error:
        check_values(made.ranges, values)
    assert_one_line(error, " mm: must be ", " mm", "(")
    parameter, value = str(error.value).split(" mm: must be ")[0].split(" = ")
    assert float(value) == pytest.approx(values[parameter], rel=1e-5)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("name", PARAMETERS)
def test_what_is_not_finite_is_outside_every_range(name, value):
    made = kit("hexagonal", "fixed", 1.5)
    with pytest.raises(InputError, match=rf"{name} = {value:g}: must be a finite number"):
        check_values(made.ranges, {**made.values, name: value})


@kinds
def test_nothing_turns_over_or_crosses_up_to_the_widest_clearance(kind):
    made = kit(*kind)
    limit = made.joints[0].figures["clearance_limit_sides"] * 10
    assert limit >= 0.4
    for share in np.linspace(0, 1, 20):
        values = {**made.values, "clearance": share * limit}
        for name in ("connector", "half"):
            solid = made.parts[name]
            points = solid.points(values)
            assert solid_faults(points, solid.triangles) == [], (name, share)


def test_nothing_turns_over_at_a_finer_level_either():
    for frame in WEAVES:
        made = kit(frame, detail="standard")
        limit = made.joints[0].figures["clearance_limit_sides"] * 10
        for share in (0.25, 0.5, 0.75, 1.0):
            values = {**made.values, "clearance": share * limit}
            for name in ("connector", "half"):
                solid = made.parts[name]
                assert solid_faults(solid.points(values), solid.triangles) == [], (frame, share)
