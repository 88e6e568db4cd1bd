"""Pictures: what is drawn can be worked out by hand."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from scadgen.emit.preview import render
from scadgen.errors import InputError

BLUE = (40, 90, 220)
RED = (220, 40, 40)
PAPER = (250, 250, 248)

# Twelve triangles, counter-clockwise seen from outside; the corner's bits are x, y, z.
CUBE = np.array(
    [
        *([0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4]),
        *([2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]),
    ]
)


def cube(colour, *, at=(0.0, 0.0, 0.0), edge=1.0):
    corners = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], dtype=float)
    return (corners - 0.5) * edge + np.array(at), CUBE, colour


def pixels(png):
    return np.array(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)


def covered(image):
    return (image != PAPER).any(axis=2)


def hue(colour):
    """Which of red, green, blue is strongest: shading keeps it."""
    return int(np.argmax(colour))


def test_picture_has_the_size_asked_for():
    image = pixels(render([cube(BLUE)], size=(120, 90)))
    assert image.shape == (90, 120, 3)


def test_cube_from_above_is_a_square_that_fills_the_height():
    drawn = covered(pixels(render([cube(BLUE)], size=(400, 300), view=(0, 90))))
    side = 0.92 * 300
    # The outline is a pixel wide and stands half outside.
    assert side**2 <= drawn.sum() <= (side + 2) ** 2
    rows, columns = drawn.any(axis=1).sum(), drawn.any(axis=0).sum()
    assert rows == pytest.approx(side, abs=2)
    assert columns == pytest.approx(side, abs=2)


def test_cube_from_its_diagonal_is_a_regular_hexagon():
    elevation = np.degrees(np.arctan(np.sqrt(0.5)))
    drawn = covered(pixels(render([cube(BLUE)], size=(300, 300), view=(45, elevation))))
    # Its height is twice the projected edge a; its area is 3/2 sqrt(3) a^2.
    edge = 0.92 * 300 / 2
    assert drawn.sum() == pytest.approx(1.5 * np.sqrt(3) * edge**2, rel=0.02)


@pytest.mark.parametrize(("view", "seen"), [((0, 0), RED), ((180, 0), BLUE)])
def test_nearer_hides_farther(view, seen):
    shells = [cube(RED, at=(5, 0, 0)), cube(BLUE, at=(-5, 0, 0))]
    for order in (shells, shells[::-1]):
        image = pixels(render(order, size=(100, 100), view=view))
        assert hue(image[50, 50]) == hue(seen)
        hidden = hue(RED) + hue(BLUE) - hue(seen)
        drawn = image[covered(image)]
        assert (drawn[:, hidden] <= drawn[:, hue(seen)] + 2).all()


def test_up_is_up_and_azimuth_turns_from_x_towards_y():
    # From -y, x points right and z up.
    shells = [cube(RED, at=(2, 0, 0)), cube(BLUE, at=(0, 0, 2))]
    image = pixels(render(shells, size=(200, 200), view=(-90, 0)))
    upper_left, lower_right = image[60, 60], image[140, 140]
    assert hue(upper_left) == hue(BLUE)
    assert hue(lower_right) == hue(RED)


def test_background_is_untouched_in_the_margin():
    image = pixels(render([cube(BLUE)], size=(200, 200), view=(30, 30), background=(1, 2, 3)))
    border = np.ones((200, 200), dtype=bool)
    border[6:-6, 6:-6] = False
    assert (image[border] == (1, 2, 3)).all()


def test_faces_differ_and_each_is_flat():
    image = pixels(render([cube((128, 128, 128))], size=(300, 300), view=(-60, 35)))
    colours, count = np.unique(image[covered(image)], axis=0, return_counts=True)
    large = colours[count > 0.1 * covered(image).sum()]
    assert len(large) == 3
    assert np.abs(np.diff(np.sort(large[:, 0]))).min() > 10


def test_edges_are_dark_and_coplanar_diagonals_are_not_drawn():
    image = pixels(render([cube((200, 200, 200))], size=(200, 200), view=(0, 90)))
    outline = image[100, covered(image)[100]][:3]
    assert outline.min() < 0.7 * image[100, 100].max()
    inside = image[20:180, 20:180]
    assert (inside == inside[0, 0]).all()


def test_step_in_depth_between_parallel_faces_is_drawn():
    # A small cube floats above a large one of the same shell: only depth tells them apart.
    low, high = cube(BLUE, edge=2.0), cube(BLUE, at=(0, 0, 2))
    one = (np.vstack([low[0], high[0]]), np.vstack([CUBE, CUBE + 8]), BLUE)
    image = pixels(render([one], size=(200, 200), view=(0, 90)))
    row = image[100, 20:180].sum(axis=1)
    assert len(np.unique(row)) > 1
    assert row[0] == row[80] == row[-1] > row.min()


def test_same_input_same_bytes_whatever_the_unit():
    shells = [cube(BLUE), cube(RED, at=(1.5, 0, 0))]
    first = render(shells, size=(80, 60))
    assert first == render(shells, size=(80, 60))
    doubled = [(2 * points, triangles, colour) for points, triangles, colour in shells]
    assert first == render(doubled, size=(80, 60))


@given(
    view=st.tuples(st.floats(-360, 360), st.floats(-90, 90)),
    count=st.integers(1, 6),
)
def test_neighbouring_triangles_leave_no_gap(view, count):
    """A convex solid, however finely cut, covers each of its rows in one run."""
    line = np.linspace(-0.5, 0.5, count + 1)
    u, v = (grid.ravel() for grid in np.meshgrid(line, line))
    first = np.array([i * (count + 1) + j for i in range(count) for j in range(count)])
    square = np.vstack(
        [
            np.stack([first, first + 1, first + count + 2], axis=1),
            np.stack([first, first + count + 2, first + count + 1], axis=1),
        ]
    )
    half = np.full_like(u, 0.5)
    faces = []
    for axis in range(3):
        top = np.roll(np.stack([u, v, half], axis=1), axis, axis=1)
        bottom = np.roll(np.stack([v, u, -half], axis=1), axis, axis=1)
        faces += [top, bottom]
    triangles = np.vstack([square + i * len(u) for i in range(6)])
    image = pixels(render([(np.vstack(faces), triangles, BLUE)], size=(60, 60), view=view))
    drawn = covered(image).astype(int)
    assert (np.abs(np.diff(drawn, axis=1)).sum(axis=1) <= 2).all()
    assert (np.abs(np.diff(drawn, axis=0)).sum(axis=0) <= 2).all()


def test_triangle_seen_from_behind_leaves_the_background():
    back = (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float), np.array([[0, 2, 1]]), RED)
    assert not covered(pixels(render([back], size=(40, 40), view=(0, 90)))).any()


@pytest.mark.parametrize("size", [(0, 10), (10, -1), (10, 5000)])
def test_size_out_of_range_is_an_input_error(size):
    with pytest.raises(InputError, match=r"preview size .* must be 1 to 4096 pixels"):
        render([cube(BLUE)], size=size)


def test_nothing_to_draw_is_an_input_error():
    with pytest.raises(InputError, match="0 triangles"):
        render([])


def test_points_that_are_not_finite_are_an_input_error():
    points, triangles, colour = cube(BLUE)
    points[3, 1] = np.nan
    with pytest.raises(InputError, match="not finite"):
        render([(points, triangles, colour)])
