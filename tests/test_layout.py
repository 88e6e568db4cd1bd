"""Layouts of frames: counts worked out by hand, and every end closed exactly once."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.frame.layout import LAYOUTS, MOST_CELLS, bill, hexagonal, joint, square
from scadgen.frame.placement import Placement

cells = st.integers(1, 6)
keys = st.sampled_from(["fixed", "loose"])

#: A part's ends as (distance along its edge, direction, kind).
ENDS = {
    "basic": ((0, 0, "connector"), (1, 180, "connector")),
    "one_sided": ((0, 0, "connector"), (1, 180, "key")),
    "two_sided": ((0, 0, "key"), (1, 180, "key")),
    "connector": ((0, 0, "connector"),),
}


def ends(placements: Sequence[Placement]) -> Counter[tuple[float, float, int, str]]:
    """Ends of edges that stand at each vertex: position, direction, kind."""
    found: Counter[tuple[float, float, int, str]] = Counter()
    for p in placements:
        for along, turn, kind in ENDS.get(p.part, ()):
            x = p.at[0] + along * math.cos(math.radians(p.turn))
            y = p.at[1] + along * math.sin(math.radians(p.turn))
            found[round(x, 6) + 0.0, round(y, 6) + 0.0, round(p.turn + turn) % 360, kind] += 1
    return found


def standing(placements: Sequence[Placement], role: str) -> Counter[tuple[float, float, int]]:
    """Position and direction of every piece of one role."""
    return Counter(
        (round(p.at[0], 6) + 0.0, round(p.at[1], 6) + 0.0, round(p.turn) % 360)
        for p in placements
        if p.role == role
    )


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
def test_bill_by_hand(
    frame: str, rows: int, columns: int, key: str, expected: tuple[int, ...]
) -> None:
    cross = {"hexagonal": "two_sided", "square": "one_sided"}[frame]
    names = ("basic", cross, "connector", "half", "peg")
    assert bill(LAYOUTS[frame](rows, columns, key=key)) == dict(zip(names, expected, strict=True))


@given(rows=cells, columns=cells, key=keys, frame=st.sampled_from(sorted(LAYOUTS)))
def test_every_vertex_has_every_end_once(rows: int, columns: int, key: str, frame: str) -> None:
    placements = LAYOUTS[frame](rows, columns, key=key)
    valence = {"hexagonal": 3, "square": 4}[frame]
    half_a, half_b = standing(placements, "half_a"), standing(placements, "half_b")
    pegs = standing(placements, "peg")
    found = ends(placements)

    assert half_a == half_b
    assert max(half_a.values()) == 1
    assert max(pegs.values()) == 1
    assert max(found.values()) == 1
    assert len({(x, y) for x, y, _ in half_a}) == len(half_a)

    element_keys = {(x, y, turn) for x, y, turn, kind in found if kind == "key"}
    assert element_keys <= set(half_a)
    rim = set(half_a) - element_keys
    assert set(pegs) == (set(half_a) if key == "loose" else rim)

    directions = {(x, y, turn) for x, y, turn, kind in found if kind == "connector"} | set(half_a)
    by_vertex = Counter((x, y) for x, y, _ in directions)
    assert set(by_vertex) == {(x, y) for x, y, _ in half_a}
    assert set(by_vertex.values()) == {valence}
    assert len(directions) == sum(k == "connector" for *_, k in found) + len(half_a)


@given(rows=cells, columns=cells)
def test_hexagonal_edges_have_length_one_and_regular_angles(rows: int, columns: int) -> None:
    by_vertex: dict[tuple[float, float], set[int]] = {}
    placements = hexagonal(rows, columns)
    for x, y, turn, _ in ends(placements):
        by_vertex.setdefault((x, y), set()).add(turn)
    for x, y, turn in standing(placements, "half_a"):
        by_vertex[x, y].add(turn)
    assert {frozenset(t) for t in by_vertex.values()} <= {
        frozenset({90, 210, 330}),
        frozenset({30, 150, 270}),
    }


def test_a_hexagon_closes() -> None:
    corners = {p.at for p in hexagonal(1, 1) if p.role == "half_a"}
    centre = (math.sqrt(3) / 2, 1.0)
    assert {round(math.dist(c, centre), 12) for c in corners} == {1.0}


@given(rows=cells, columns=cells)
def test_square_pegs_all_point_the_same_way(rows: int, columns: int) -> None:
    halves = standing(square(rows, columns), "half_a")
    assert {turn for *_, turn in halves} == {270}
    assert {(x, y) for x, y, _ in halves} == {
        (float(j), float(i)) for i in range(rows + 1) for j in range(columns + 1)
    }


@pytest.mark.parametrize("key", ["fixed", "loose"])
def test_joint(key: str) -> None:
    pieces = joint(3, key)
    assert [(p.part, p.turn, p.flip, p.role) for p in pieces] == [
        ("half", 0.0, False, "half_a"),
        ("half", 0.0, True, "half_b"),
        ("connector", 120.0, False, "cap"),
        ("connector", 240.0, False, "cap"),
        ("peg", 0.0, False, "peg"),
    ]
    assert {p.at for p in pieces} == {(0.0, 0.0)}
    assert bill(joint(4, key)) == {"connector": 3, "half": 2, "peg": 1}


@pytest.mark.parametrize("count", [0, -1, MOST_CELLS + 1])
def test_counts_outside_the_range_are_refused(count: int) -> None:
    with pytest.raises(InputError, match=rf"columns = {count}: must be a whole number from 1 to"):
        hexagonal(1, count)
    with pytest.raises(InputError, match=rf"rows = {count}: must be a whole number from 1 to"):
        square(count, 1)


def test_unknown_key_and_small_valence_are_refused() -> None:
    with pytest.raises(InputError, match="key = 'glue': must be one of fixed, loose"):
        square(1, 1, key="glue")
    with pytest.raises(InputError, match="valence = 1: must be at least 2"):
        joint(1, "fixed")
