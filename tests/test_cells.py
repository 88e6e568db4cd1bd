"""Rows and columns of every named tiling: counts by hand, every end once, the same in OpenSCAD."""

import ast
import math
import re
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kits import grid, kit
from scipy.spatial import cKDTree
from shared import once

from scadgen.emit.scad import scad
from scadgen.errors import GeometryError, InputError
from scadgen.frame.placement import bill
from scadgen.kit.build import Request, build, laid_out
from scadgen.kit.cells import MOST_CELLS
from scadgen.plane.catalogue import NAMES, NamedTiling, named
from scadgen.tools.openscad import render

TILINGS = [name for name, family in NAMES.items() if "rows" in family.options]
SIZES = [(1, 1), (2, 3), (5, 4)]
REGULAR = [(frame, key) for frame in ("hexagonal", "square") for key in ("fixed", "loose")]
cells = st.integers(1, 6)


def tiled(name):
    """A kit of a named tiling, not proved."""
    if NAMES[name].regular:
        return kit(name)
    wish = Request.tiled(NamedTiling(name), detail="draft")
    return once(f"cells-{name}", lambda _: build(wish))


@pytest.mark.parametrize(
    ("frame", "rows", "columns", "key", "expected"),
    [
        # One hexagon: 6 vertices; the two verticals are keys, the other four are rows.
        ("hexagonal", 1, 1, "fixed", (4, 2, 4, 12, 2)),
        ("hexagonal", 1, 1, "loose", (4, 2, 4, 12, 6)),
        # 2 x 3: lines of 7, 8 and 7 vertices; 6 + 7 + 6 zigzags, 2 rows of 4 verticals;
        # 22 vertices; 2 rim ends a line; 3 low ones below and 3 high ones above.
        ("hexagonal", 2, 3, "fixed", (19, 8, 6, 44, 6)),
        ("hexagonal", 2, 3, "loose", (19, 8, 6, 44, 22)),
        # 3 x 1: lines of 3, 4, 4, 3 vertices.
        ("hexagonal", 3, 1, "fixed", (2 + 3 + 3 + 2, 6, 8, 28, 2)),
        # One square: 4 vertices of 4 ends; 2 left, 2 right, 2 top rim ends.
        ("square", 1, 1, "fixed", (2, 2, 6, 8, 2)),
        # 2 x 3: 12 vertices, 9 horizontals, 8 verticals; rim 3 + 3 + 4; 4 pegs below.
        ("square", 2, 3, "fixed", (9, 8, 10, 24, 4)),
        ("square", 2, 3, "loose", (9, 8, 10, 24, 12)),
    ],
)
def test_bill_by_hand(frame, rows, columns, key, expected):
    cross = {"hexagonal": "two_sided", "square": "one_sided"}[frame]
    names = ("basic", cross, "connector", "half", "peg")
    made = laid_out(kit(frame, key), rows, columns)
    assert bill(made.placements, made.parts) == dict(zip(names, expected, strict=True))


def test_bill_of_octagons_by_hand():
    # A cell is an octagon and the square on its lower right side.  One cell: 8 + 4 - 2 vertices
    # and 8 + 4 - 1 edges; of 2 x 3 cells, octagons share 2 x 2 + 3 sides, and inner squares have
    # all four sides on octagons; see the counts of the tiling's own frame.
    one = laid_out(tiled("4.8.8"), 1, 1)
    roles = Counter(p.role for p in one.placements)
    assert (len(one.vertices), roles["row"] + roles["cross"]) == (10, 11)
    # Each vertex has three ends: a key, and connectors on its other edges, or caps.
    assert roles["half_a"] == roles["half_b"] == roles["peg"] == 10
    keyed = sum(len(p.ends) for p in one.placements if p.is_element)
    assert roles["cap"] + keyed + free_keys(one) == 3 * 10


def free_keys(made):
    """Keys that have no tube."""
    taken = {end for p in made.placements if p.is_element for end in p.ends}
    halves = [p for p in made.placements if p.role == "half_a"]
    return sum((p.vertex, p.slot) not in taken for p in halves)


@pytest.mark.parametrize("name", TILINGS)
@pytest.mark.parametrize(("rows", "columns"), SIZES)
def test_cells_make_the_frame_of_the_tiling(name, rows, columns):
    made = laid_out(tiled(name), rows, columns)
    drawn = named(name, rows=rows, columns=columns)
    lengths = [frame.lengths.min() for frame in (made.frame, drawn)]
    assert np.array_equal(made.frame.edges, drawn.edges)
    scaled = drawn.plan * (lengths[0] / lengths[1])
    assert np.allclose(made.frame.plan, scaled, rtol=0, atol=1e-5)


@pytest.mark.parametrize("name", TILINGS)
@pytest.mark.parametrize(("rows", "columns"), SIZES)
def test_every_slot_of_every_joint_is_filled_once(name, rows, columns):
    made = laid_out(tiled(name), rows, columns)
    found = Counter(
        (end, p.role == "half_b", p.role == "peg")
        for p in made.placements
        for end in p.ends
        if not (p.is_element and end.slot in keys(made, end.vertex))
    )
    assert set(found.values()) == {1}
    for vertex, place in enumerate(made.vertices):
        joint = made.joint(place.joint)
        slots = {end.slot for end, *_ in found if end.vertex == vertex}
        assert slots == set(range(len(joint.turns)))
    assert [p.edge for p in made.placements if p.is_element] == [*range(len(made.frame.edges))]


def keys(made, vertex):
    return made.joint(made.vertices[vertex].joint).keys


@pytest.mark.parametrize("name", TILINGS)
def test_elements_reach_from_vertex_to_vertex_and_caps_point_nowhere(name):
    made = laid_out(tiled(name), 2, 3)
    for p in made.placements:
        near, *far = (np.array(made.vertices[end.vertex].pose.at) for end in p.ends)
        assert np.allclose(p.pose.at, near, rtol=0, atol=1e-8)
        keyed = [end.slot in keys(made, end.vertex) for end in p.ends]
        if far:
            assert [end.is_key for end in made.parts[p.part].ends] == keyed
            reach = near + made.parts[p.part].length * np.array(p.pose.x)
            assert np.allclose(reach, far[0], rtol=0, atol=1e-6)


@given(rows=cells, columns=cells)
def test_square_pegs_all_point_the_same_way(rows, columns):
    halves = [p for p in laid_out(kit("square"), rows, columns).placements if p.role == "half_a"]
    assert {p.pose.x for p in halves} == {(0.0, -1.0, 0.0)}
    assert len(halves) == (rows + 1) * (columns + 1)


@pytest.mark.parametrize("key", ["fixed", "loose"])
def test_the_pieces_of_a_joint(key):
    pieces = kit("hexagonal", key).joints[0].pieces
    assert [(p.part, round(p.pose.degrees, 9), p.pose.over, p.role, p.slot) for p in pieces] == [
        ("half", 0.0, False, "half_a", 0),
        ("half", 0.0, True, "half_b", 0),
        ("connector", 120.0, False, "cap", 1),
        ("connector", 240.0, False, "cap", 2),
        ("peg", 0.0, False, "peg", 0),
    ]
    assert {p.pose.at for p in pieces} == {(0.0, 0.0, 0.0)}


@pytest.mark.parametrize("count", [0, -1, MOST_CELLS + 1])
def test_counts_outside_the_range_are_refused(count):
    with pytest.raises(InputError, match=rf"columns = {count}: must be a whole number from 1 to"):
        grid("hexagonal", rows=1, columns=count)
    with pytest.raises(InputError, match=rf"rows = {count}: must be a whole number from 1 to"):
        laid_out(kit("square"), count, 1)


def test_cells_whose_joints_would_meet_are_refused_with_what_would_do():
    # Rhombs of 30 degrees: the short diagonal is 0.52 edges long, and two rings must fit on it.
    lean = NamedTiling("rhombic", {"angle": 30.0})
    made = build(Request.tiled(lean, detail="draft"))
    least = max(r.low(made.values) for r in made.ranges if r.parameter == "edge_length")
    ring = made.joints[0].weave["ring_ratio"]
    apart = 2 * math.sin(math.radians(15))
    assert least * apart == pytest.approx(10 * (2 * (ring + 0.5) + 0.25), rel=1e-6)
    short = Request.tiled(lean, detail="draft", values={"edge_length": least - 1})
    with pytest.raises(InputError, match="joints and tubes that pass by must keep apart"):
        build(short)


def test_sides_that_are_too_long_are_told_as_such():
    tall = NamedTiling("rectangular", {"width": 60.0, "height": 20_000.0})
    with pytest.raises(GeometryError, match="is too long: at most 2000 mm works"):
        build(Request.tiled(tall, detail="draft"))


def test_a_frame_without_cells_has_no_rows_and_columns():
    made = build(Request("ladder", frame=named("ladder", bays=1), detail="draft", resizable=True))
    with pytest.raises(InputError, match="ladder: this kit's frame has no rows and columns to set"):
        laid_out(made, 2, 2)


def assert_same_places(found, expected):
    """Placements are the same in whatever order; OpenSCAD says six digits of a number."""
    assert Counter(row[:2] for row in found) == Counter(row[:2] for row in expected)
    for what in {row[:2] for row in found}:
        ours, theirs = (
            np.array([np.ravel(row[2:]) for row in rows if row[:2] == what])
            for rows in (found, expected)
        )
        far, nearest = cKDTree(theirs).query(ours)
        assert far.max() < 1e-4
        assert len({*nearest.tolist()}) == len(theirs)


@pytest.mark.parametrize("name", TILINGS)
def test_openscad_lays_out_the_same(name, tmp_path):
    made = tiled(name)
    (tmp_path / "kit.scad").write_text(scad(made), encoding="ascii")
    calls = ", ".join(f"frame_layout({r}, {c})" for r, c in SIZES)
    (tmp_path / "uses.scad").write_text(f"use <kit.scad>\necho([{calls}]);", encoding="ascii")
    said = render(tmp_path / "uses.scad", tmp_path / "said.echo", {}, timeout=60).output.read_text()
    assert not re.search("^(WARNING|ERROR)", said, re.MULTILINE)
    found = ast.literal_eval(said.removeprefix("ECHO: ").strip())
    for (rows, columns), layout in zip(SIZES, found, strict=True):
        expected = [
            [p.part, p.role, p.pose.at, p.pose.x, p.pose.z]
            for p in laid_out(made, rows, columns).placements
        ]
        assert_same_places([tuple(row) for row in layout], [tuple(row) for row in expected])
