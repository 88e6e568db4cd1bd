"""Tilings: looked at face by face, by code that knows only vertices and edges."""

import math
from collections import Counter, defaultdict

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.plane.area import MOST_TILES
from scadgen.plane.catalogue import ALIASES, NAMES, OPTIONS, named
from scadgen.plane.cells import LAVES, LEFT_OUT, UNIFORM
from scadgen.plane.simple import ladder, ring, strip
from scadgen.plane.tilings import laves, rectangular, rhombic, uniform

#: Tiles of one cell by their number of sides, from the angles at a vertex by hand: a vertex
#: of configuration (..., n, ...) has 1/n of an n-gon for each time n occurs.
CELLS = {
    "6.6.6": {6: 1},
    "4.4.4.4": {4: 1},
    "3.3.3.3.3.3": {3: 2},
    "3.6.3.6": {3: 2, 6: 1},
    "3.4.6.4": {3: 2, 4: 3, 6: 1},
    "4.8.8": {4: 1, 8: 1},
    "3.3.4.3.4": {3: 4, 4: 2},
    "3.3.3.4.4": {3: 2, 4: 1},
    "3.3.3.3.6": {3: 8, 6: 1},
    "3.12.12": {3: 2, 12: 1},
    "4.6.12": {4: 3, 6: 2, 12: 1},
}


def faces(frame):
    """Vertices of each bounded face, counter-clockwise."""
    around = defaultdict(list)
    for a, b in frame.edges.tolist():
        for start, end in ((a, b), (b, a)):
            dx, dy = frame.plan[end] - frame.plan[start]
            around[start].append((math.atan2(dy, dx), end))
    after = {}
    for vertex, found in around.items():
        ends = [end for _, end in sorted(found)]
        for n, end in enumerate(ends):
            # Coming from `end`, the next side of the face on the left leaves clockwise of it.
            after[end, vertex] = (vertex, ends[n - 1])
    result = []
    while after:
        dart, face = next(iter(after)), []
        while dart in after:
            face.append(dart[0])
            dart = after.pop(dart)
        x, y = frame.plan[face].T
        if x @ np.roll(y, -1) - y @ np.roll(x, -1) > 0:
            result.append(face)
    return result


def turned_to_first(numbers):
    """A cycle's first writing in the dictionary, read either way round."""
    count = len(numbers)
    turns = [numbers[n:] + numbers[:n] for n in range(count)]
    return min(turns + [turn[::-1] for turn in turns])


def interior(frame, found):
    """Vertices with as many faces as edges, and the sizes of these faces in order."""
    sizes = defaultdict(list)
    for face in found:
        x, y = frame.plan[face].mean(axis=0)
        for vertex in face:
            at = frame.plan[vertex]
            sizes[vertex].append((math.atan2(y - at[1], x - at[0]), len(face)))
    return {
        vertex: [size for _, size in sorted(around)]
        for vertex, around in sizes.items()
        if len(around) == frame.degree[vertex]
    }


def test_there_are_eleven_uniform_tilings():
    assert set(UNIFORM) == set(CELLS)
    assert len(CELLS) == 11


@pytest.mark.parametrize("name", CELLS)
def test_every_interior_vertex_has_the_faces_that_the_name_says(name):
    frame = uniform(name, 10.0).fill(rows=5, columns=5)
    found = faces(frame)
    inside = interior(frame, found)
    wanted = turned_to_first([int(size) for size in name.split(".")])
    assert len(inside) >= 9
    assert all(turned_to_first(sizes) == wanted for sizes in inside.values())
    assert frame.lengths == pytest.approx(10.0)
    assert frame.degree.max() == len(wanted)


@pytest.mark.parametrize("name", CELLS)
def test_rows_and_columns_are_whole_cells_without_holes(name):
    frame = uniform(name, 10.0).fill(rows=3, columns=5)
    found = faces(frame)
    assert Counter(map(len, found)) == {size: 15 * n for size, n in CELLS[name].items()}
    # Euler: one piece without holes has V - E + F = 1, the outside not counted.
    assert len(frame.vertices) - len(frame.edges) + len(found) == 1
    assert frame.components.max() == 0
    assert frame.degree.min() >= 2


@pytest.mark.parametrize("name", CELLS)
def test_faces_are_regular(name):
    frame = uniform(name, 10.0).fill(rows=2, columns=2)
    for face in faces(frame):
        corners = frame.plan[face]
        # A regular n-gon of side s has the circumradius s / (2 sin(pi / n)).
        radius = np.linalg.norm(corners - corners.mean(axis=0), axis=1)
        assert radius == pytest.approx(5.0 / math.sin(math.pi / len(face)))


@given(st.integers(1, 7), st.integers(1, 7))
@settings(deadline=None, max_examples=25)
def test_counts_of_hexagons_and_squares_by_hand(rows, columns):
    # A row of c hexagons has 5 c + 1 edges; each further row adds what it does not share.
    hexagons = uniform("6.6.6", 10.0).fill(rows=rows, columns=columns)
    assert len(hexagons.vertices) == 2 * (rows * columns + rows + columns)
    assert len(hexagons.edges) == 3 * rows * columns + 2 * rows + 2 * columns - 1
    squares = uniform("4.4.4.4", 10.0).fill(rows=rows, columns=columns)
    assert len(squares.vertices) == (rows + 1) * (columns + 1)
    assert len(squares.edges) == rows * (columns + 1) + columns * (rows + 1)


def test_hexagons_stand_in_rows_above_one_another():
    width = 10 * math.sqrt(3)
    low, high = uniform("6.6.6", 10.0).fill(rows=9, columns=4).bounds
    assert high - low == pytest.approx([4.5 * width, 8 * 15 + 20])


@pytest.mark.parametrize("name", LAVES)
def test_every_face_of_a_dual_has_the_degrees_that_the_name_says(name):
    frame = laves(name, 10.0).fill(rows=4, columns=4)
    found = faces(frame)
    degrees = [int(size) for size in name.split(".")]
    assert {len(face) for face in found} == {len(degrees)}
    inside = set(interior(frame, found))
    whole = [face for face in found if inside.issuperset(face)]
    assert whole
    for face in whole:
        assert turned_to_first(frame.degree[face].tolist()) == turned_to_first(degrees)
    assert len(frame.vertices) - len(frame.edges) + len(found) == 1


@pytest.mark.parametrize("name", LAVES)
def test_lengths_of_a_dual_are_sums_of_apothems(name):
    def apothem(sides):
        return 0.5 / math.tan(math.pi / sides)

    degrees = [int(size) for size in name.split(".")]
    neighbours = list(zip(degrees, degrees[1:] + degrees[:1], strict=True))
    spans = sorted({round(apothem(a) + apothem(b), 9) for a, b in neighbours})
    frame = laves(name, 10.0).fill(rows=3, columns=3)
    assert sorted(set(frame.lengths.round(6))) == pytest.approx(
        [10 * span / spans[0] for span in spans]
    )
    assert frame.lengths.max() <= 10 * math.sqrt(3) + 1e-6


@pytest.mark.parametrize("name", LEFT_OUT)
def test_a_dual_that_is_left_out_says_why(name):
    with pytest.raises(InputError, match="longest edge is twice its shortest; must be one of"):
        laves(name)


def test_the_other_duals_are_regular_tilings_themselves():
    assert set(LAVES) | set(LEFT_OUT) == set(UNIFORM) - {"6.6.6", "4.4.4.4", "3.3.3.3.3.3"}


def test_a_circle_keeps_the_tiles_that_just_fit():
    one = uniform("6.6.6", 10.0).fill(radius=10.0)
    assert (len(one.vertices), len(one.edges)) == (6, 6)
    # The farthest corner of the hexagons around it is sqrt(7) edges away.
    seven = uniform("6.6.6", 10.0).fill(radius=10 * math.sqrt(7))
    assert (len(seven.vertices), len(seven.edges)) == (24, 30)
    assert uniform("6.6.6", 10.0).fill(radius=10 * math.sqrt(7) - 0.01) == one


@pytest.mark.parametrize("name", [*UNIFORM, *(f"V{name}" for name in LAVES)])
def test_within_a_circle_no_edge_dangles_and_all_hangs_together(name):
    frame = named(name, edge_length=10.0, radius=61.0)
    assert np.linalg.norm(frame.plan, axis=1).max() <= 61.0 + 1e-4
    assert frame.degree.min() >= 2
    assert frame.components.max() == 0
    found = faces(frame)
    used = {frozenset(pair) for f in found for pair in zip(f, f[1:] + f[:1], strict=True)}
    assert used == {frozenset(edge) for edge in frame.edges.tolist()}


def test_a_polygon_is_filled_from_its_middle():
    box = [[100, 100], [200, 100], [200, 200], [100, 200]]
    frame = uniform("4.4.4.4", 20.0).fill(outline=box)
    assert len(frame.vertices) == 36
    assert frame.bounds.tolist() == [[100, 100], [200, 200]]


def test_of_tiles_that_do_not_hang_together_the_most_are_kept():
    # Rooms of 5 x 5 and 3 x 5 squares, with a corridor between them that is too low.
    rooms = [[0, 0], [50, 0], [50, 24], [60, 24], [60, 0], [90, 0], [90, 50]]
    rooms += [[60, 50], [60, 26], [50, 26], [50, 50], [0, 50]]
    frame = uniform("4.4.4.4", 10.0).fill(outline=rooms)
    assert frame.components.max() == 0
    assert frame.bounds.tolist() == [[0, 0], [50, 50]]


def test_rectangles_and_rhombs_have_their_sides_and_angles():
    frame = rectangular(60.0, 25.0).fill(rows=2, columns=3)
    assert frame.bounds.tolist() == [[0, 0], [180, 50]]
    lean = rhombic(70.0, 10.0).fill(rows=3, columns=3)
    middle = np.flatnonzero(lean.degree == 4)
    assert len(middle) == 4
    assert np.degrees(lean.gaps(int(middle[0]))) == pytest.approx([70, 110, 70, 110])
    assert lean.lengths == pytest.approx(10.0)


def test_ring_ladder_and_strip_by_hand():
    assert ring(6, 10.0).bounds == pytest.approx(
        np.array([[-10, -math.sqrt(75)], [10, math.sqrt(75)]])
    )
    assert np.degrees(ring(5).gaps(0)) == pytest.approx([108, 252])
    rungs = ladder(4, 10.0, 15.0)
    assert (len(rungs.vertices), len(rungs.edges)) == (10, 13)
    assert rungs.bounds.tolist() == [[0, 0], [60, 10]]
    row = strip(5, 10.0)
    assert (len(row.vertices), len(row.edges)) == (7, 11)
    assert row.lengths == pytest.approx(10.0)
    assert Counter(map(len, faces(row))) == {3: 5}


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("hexagons", {}, "frame 'hexagons': must be one of hexagonal, square"),
        ("ring", {"rows": 2}, "frame ring: no option rows; it has sides, edge_length"),
        ("ring", {"sides": 2}, "sides = 2: must be a whole number from 3 to"),
        ("ladder", {"bays": 1.5}, "bays = 1.5: must be a whole number"),
        ("strip", {"edge_length": 0}, "edge_length = 0: must be a positive number"),
        ("square", {"rows": 0}, "rows = 0: must be a whole number"),
        ("square", {"columns": 2.5}, "columns = 2.5: must be a whole number"),
        ("square", {"edge_length": math.inf}, "edge_length = inf"),
        ("square", {"edge_length": 40.0, "radius": 20.0}, "no tile with edges of 40 mm fits"),
        ("square", {"rows": 2, "radius": 90.0}, "rows and radius: give rows and columns, or one"),
        ("square", {"radius": math.nan}, "radius = nan"),
        ("square", {"outline": [[0, 0], [1, 1]]}, r"outline of shape \(2, 2\)"),
        ("square", {"outline": [[0, 0], [9, 9], [9, 0], [0, 9]]}, "of a simple polygon"),
        ("square", {"rows": 1000, "columns": 1000}, f"1000000 tiles: at most {MOST_TILES}"),
        ("square", {"edge_length": 1e-3, "radius": 9e5}, f"tiles: at most {MOST_TILES}"),
        ("rhombic", {"angle": 180}, "angle = 180: must be between 0 and 180"),
        ("rectangular", {"width": -1}, "width = -1"),
    ],
)
def test_what_does_not_work_is_refused_in_one_line(name, options, said):
    with pytest.raises(InputError, match=said) as error:
        named(name, **options)
    assert "\n" not in str(error.value)


def test_unknown_configurations_are_refused():
    with pytest.raises(InputError, match=r"uniform tiling '5.5.5': must be one of 6.6.6"):
        uniform("5.5.5")


@pytest.mark.parametrize("name", NAMES)
def test_every_family_works_as_it_is_listed(name):
    family = NAMES[name]
    assert set(family.options) <= set(OPTIONS)
    given = {option: value for option, value in family.defaults.items() if value is not None}
    assert named(name) == named(name, **given)
    assert named(name).name == name


def test_aliases_lead_to_families():
    assert set(ALIASES.values()) <= set(NAMES)
    assert not set(ALIASES) & set(NAMES)
    assert named("kagome") == named("3.6.3.6")
    assert set(UNIFORM) | {f"V{name}" for name in LAVES} <= set(NAMES) | set(ALIASES)
