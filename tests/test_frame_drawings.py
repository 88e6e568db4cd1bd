"""Frames from SVG: shapes by hand, and files that mean harm."""

import contextlib
import math
import re
import time

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.plane.catalogue import NAMES, named
from scadgen.readers.read import read
from scadgen.readers.reading import Reading

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'fill="none" stroke="black"'
)
PAGE = 'width="100mm" height="100mm" viewBox="0 0 100 100"'
ALL = Reading(components=True)


@pytest.fixture
def svg(tmp_path):
    def read_svg(body, reading=None, page=PAGE):
        path = tmp_path / "drawing.svg"
        path.write_text(f"{HEAD} {page}>{body}</svg>")
        return read(path, reading)

    return read_svg


def box(result):
    return result.frame.bounds.round(6).tolist()


@pytest.mark.parametrize("name", sorted(NAMES)[::3])
def test_a_frame_drawn_as_svg_lines_and_read_back_is_the_same(svg, name):
    frame = named(name)
    (left, low), (right, high) = frame.bounds.tolist()
    lines = [
        f'<line x1="{a}" y1="{-b}" x2="{c}" y2="{-d}"/>'
        for (a, b), (c, d) in frame.plan[frame.edges].tolist()
    ]
    width, height = right - left, high - low
    page = f'width="{width}mm" height="{height}mm" viewBox="{left} {-high} {width} {height}"'
    result = svg("".join(lines), page=page)
    assert result.notes == ()
    assert np.array_equal(result.frame.edges, frame.edges)
    assert result.frame.plan == pytest.approx(frame.plan - [left, low], abs=1e-6)


def test_shapes_are_their_outlines(svg):
    assert len(svg('<line x1="0" y1="0" x2="10" y2="0"/>').frame.edges) == 1
    assert len(svg('<polyline points="0,0 10,0 10,10"/>').frame.edges) == 2
    assert len(svg('<polygon points="0 0 10 0 10 10"/>').frame.edges) == 3
    assert len(svg('<rect x="5" y="5" width="20" height="10"/>').frame.edges) == 4
    assert len(svg('<path d="M0 0h10v10z m20 20 l5 0"/>', ALL).frame.edges) == 4


def test_y_goes_up_as_the_drawing_looks(svg):
    # A mast of 30 on the left of a floor of 50 at the bottom of the page.
    frame = svg('<polyline points="0,70 0,100 50,100"/>').frame
    assert frame.plan.tolist() == [[0, 0], [50, 0], [0, 30]]


def test_units_and_view_boxes_give_millimetres(svg):
    line = '<line x1="0" y1="0" x2="96" y2="0"/>'
    assert box(svg(line, page="")) == [[0, 0], [25.4, 0]]
    assert box(svg(line, page='width="96" viewBox="0 0 96 96"'))[1][0] == 25.4
    assert box(svg(line, page='width="4.8cm" height="4.8cm" viewBox="0 0 96 96"'))[1][0] == 48
    assert box(svg(line, page='width="2in" height="1in" viewBox="0 0 96 96"'))[1][0] == 25.4
    assert box(svg(line, page='width="100%" viewBox="0 0 96 96"'))[1][0] == 25.4
    assert box(svg(line, Reading(scale=0.5)))[1][0] == 48
    assert box(svg('<line x2="1in" y2="0"/>', page=""))[1][0] == 25.4
    uneven = 'width="96mm" height="48mm" viewBox="0 0 96 96" preserveAspectRatio="none"'
    assert box(svg('<rect width="96" height="96"/>', page=uneven)) == [[0, 0], [96, 48]]
    middle = '<line x1="0" y1="48" x2="96" y2="48"/>'
    for fit, length in (("xMidYMid", 48), ("xMinYMax meet", 48), ("xMidYMid slice", 96)):
        page = uneven.replace('"none"', f'"{fit}"')
        assert box(svg(middle, page=page))[1][0] == length
    assert box(svg(middle, page=uneven.replace('"none"', '"none slice"')))[1][0] == 96


def test_transforms_work_from_the_inside_out(svg):
    shape = '<g transform="translate(50 50) scale(2)"><rect transform="rotate(90)" {}/></g>'
    assert box(svg(shape.format('width="10" height="5"'))) == [[40, 30], [50, 50]]
    assert box(svg('<rect transform="matrix(1 0 0 2 5 0)" width="10" height="10"/>')) == [
        [5, 80],
        [15, 100],
    ]
    assert box(svg('<rect transform="skewX(45)" width="10" height="10"/>'))[1] == [20, 100]
    assert box(svg('<rect transform="translate(3),rotate(90 0 0)" width="4" height="2"/>')) == [
        [1, 96],
        [3, 100],
    ]


@pytest.mark.parametrize("flatten", [1.0, 0.1, 0.01])
@pytest.mark.parametrize(
    "shape",
    [
        '<circle cx="50" cy="50" r="40"/>',
        '<path d="M 10 50 A 40 40 0 0 1 90 50 A 40 40 0 0 1 10 50 z"/>',
        '<circle r="4" transform="translate(50 50) rotate(30) scale(-10 10)"/>',
        '<ellipse rx="20" ry="40" transform="translate(50 50) scale(2 1)"/>',
        '<rect x="10" y="10" width="80" height="80" rx="40"/>',
    ],
)
def test_a_circle_is_a_polygon_within_the_tolerance(svg, flatten, shape):
    found = svg(shape, Reading(flatten=flatten))
    frame = found.frame
    told = r"shapes with curves: 1, now (\d+) segments within ([\d.]+) mm of them; a larger --flat"
    count, within = re.match(told, found.notes[0]).groups()
    assert float(within) == flatten
    # That which closes the outline may have no length, nor the straight sides of the rectangle.
    assert 0 <= int(count) - len(frame.edges) <= 5
    from_middle = np.linalg.norm(frame.plan - 50, axis=1)
    assert from_middle == pytest.approx(40, abs=1e-6)
    middles = frame.plan[frame.edges].mean(axis=1) - 50
    assert np.linalg.norm(middles, axis=1).min() >= 40 - flatten - 1e-9
    # Not many more chords than the sagitta needs; whole numbers in each quarter.
    needed = math.pi / math.acos(1 - flatten / 40)
    assert needed <= len(frame.edges) <= 1.5 * needed + 8
    assert (frame.degree == 2).all()


@pytest.mark.parametrize("flatten", [0.5, 0.05])
def test_bezier_curves_are_within_the_tolerance(svg, flatten):
    frame = svg('<path d="M0 100 C 0 0 100 0 100 100"/>', Reading(flatten=flatten), page=PAGE).frame
    t = np.linspace(0, 1, 2001)[:, None]
    points = [np.array(p, dtype=float) for p in ((0, 0), (0, 100), (100, 100), (100, 0))]
    curve = sum(math.comb(3, k) * t**k * (1 - t) ** (3 - k) * p for k, p in enumerate(points))
    start, end = frame.plan[frame.edges].transpose(1, 0, 2)
    along = end - start
    share = ((curve[:, None] - start) * along).sum(axis=2) / (along**2).sum(axis=1)
    foot = start + np.clip(share, 0, 1)[..., None] * along
    off = np.linalg.norm(curve[:, None] - foot, axis=2).min(axis=1)
    assert flatten / 10 < off.max() <= flatten
    assert len(svg('<path d="M0 0 Q 50 90 100 0 T 100 90"/>').frame.edges) > 10


def test_what_is_not_drawn_is_left_out(svg):
    body = (
        '<defs><rect id="r" width="4" height="4"/></defs><title>t</title><style>a{}</style>'
        '<rect display="none" width="4" height="4"/><g style="display: none"><text>t</text></g>'
        '<metadata><any xmlns="other"/></metadata><!-- note --><x xmlns="editor"/>'
        '<line x2="10" y2="10"/>'
    )
    result = svg(body)
    assert len(result.frame.edges) == 1
    assert result.notes == ()


def test_a_use_is_what_it_shows_where_it_stands(svg):
    body = (
        '<defs><g id="tile"><rect width="10" height="10"/></g></defs>'
        '<use href="#tile"/><use xlink:href="#tile" x="10" y="0"/>'
        '<use href="#tile" transform="translate(0 10)"/>'
    )
    result = svg(body)
    assert (len(result.frame.vertices), len(result.frame.edges)) == (8, 10)


def test_a_used_symbol_is_what_is_in_it(svg):
    body = (
        '<symbol id="tile" display="none"><rect width="10" height="10"/><path d="M0 0L10 10"/>'
        '</symbol><use href="#tile"/><use href="#tile" x="10" transform="translate(0 0)"/>'
    )
    result = svg(body)
    assert (len(result.frame.vertices), len(result.frame.edges)) == (6, 9)
    assert result.notes == ("segment (10, 90) to (10, 100) was there 2 times",)


@pytest.mark.parametrize(
    ("target", "said"),
    [
        ('<clipPath id="a"><line x2="5"/></clipPath>', "used clipPath"),
        ('<g id="b"/>', "used nothing"),
        ('<pattern id="a"><line x2="5"/></pattern>', "used pattern"),
        ('<x xmlns="editor" id="a"/>', "used foreign element"),
        ('<text id="a">t</text>', "2 text"),
    ],
)
def test_what_is_used_and_not_understood_is_told(svg, target, said):
    body = f'<line x2="9"/>{target}<use href="#a"/>'
    with pytest.raises(InputError, match=f"{said}: cannot be part of a frame; without --strict"):
        svg(body, Reading(strict=True))
    result = svg(body)
    assert len(result.frame.edges) == 1
    assert said in result.notes[0]


def test_crossing_lines_are_joined_and_told(svg):
    result = svg('<path d="M0 0L10 10M0 10L10 0"/>')
    assert len(result.frame.edges) == 4
    assert result.notes == ("crossing split at (5, 95)",)
    with pytest.raises(InputError, match=r"segments cross at \(5, 95\)"):
        svg('<path d="M0 0L10 10M0 10L10 0"/>', Reading(split=False))


def test_unknown_elements_are_left_out_and_told_or_refused(svg):
    body = '<line x2="10" y2="10"/><text>a</text><image href="a.png"/><text>b</text>'
    with pytest.raises(InputError, match="1 image, 2 text: cannot be part of a frame"):
        svg(body, Reading(strict=True))
    assert svg(body).notes == ("left out: 1 image, 2 text",)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("", "nothing in it that could be an edge"),
        ("<path/><path d=' '/><polygon points=''/><rect width='0' height='4'/>", "nothing in it"),
        ('<path d="M0 0 L 10"/>', "path 'M0 0 L 10': is no path data"),
        ('<path d="M0 0 L 10 foo"/>', "is no path data"),
        ('<path d="L 10 10"/>', "is no path data"),
        ('<path d="M0 0 L 1e999 3"/>', "number that is too large"),
        ('<path d="M0 0 C 1e308 0 0 1e308 3 3"/>', "too large"),
        ('<polyline points="0 0 1"/>', "polyline: its points are 3 numbers, an odd count"),
        ('<polyline points="0 0 a b"/>', "points '0 0 a b': must be numbers"),
        ('<polyline points="0 0 1e999 0"/>', "too large"),
        ('<line x2="5ly"/>', "x2 = '5ly': must be a number, with or without a unit"),
        ('<line x2="nan"/>', "x2 = 'nan': must be a number"),
        ('<rect width="50%%" height="5"/>', "width = '50%%': must be a number"),
        ('<g transform="twist(3)"/>', r"transform 'twist\(3\)': must be matrix"),
        ('<g transform="rotate(1 2)"/>', "transform"),
        ('<g transform="scale(2) and more"/>', "transform"),
        ('<circle r="4" transform="scale(0)"/>', "a transform leaves nothing of it"),
        ('<use href="other.svg#a"/>', "use of 'other.svg#a': must be the id of an element in the"),
        ('<use href="file:///etc/passwd"/>', "must be the id"),
        ('<g id="a"><use href="#a"/></g>', "more than 8 uses within each other"),
        ('<svg overflow="visible" viewBox="0 0 1"/>', "viewBox '0 0 1': must be x, y, a width"),
    ],
)
def test_svg_that_is_no_frame_is_refused(svg, body, said):
    with pytest.raises(InputError, match=said) as error:
        svg(body)
    assert "\n" not in str(error.value)


def test_svg_that_is_too_large_is_refused(svg):
    with pytest.raises(InputError, match=r"must be within 1e.06 mm of 0"):
        svg('<line x2="8e6" y2="0"/>', page="")


@pytest.mark.parametrize("box", ["", "0 0 10", "0 0 -1 5", "a b c d"])
def test_view_boxes_that_are_none_are_refused(svg, box):
    with pytest.raises(InputError, match="viewBox"):
        svg('<line x2="5"/>', page=f'viewBox="{box}"')


@pytest.mark.parametrize("size", ['width="0"', 'height="-5mm"', 'width="9" height="0mm"'])
def test_pages_without_a_size_are_refused_in_one_line(svg, size):
    with pytest.raises(InputError, match=r"(width|height) = '(0|-5mm|0mm)': must be above 0") as e:
        svg('<line x2="5"/>', page=f'{size} viewBox="0 0 9 9"')
    assert "\n" not in str(e.value)


LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 10))
USES = "".join(f'<g id="u{n}">{f"""<use href="#u{n - 1}"/>""" * 30}</g>' for n in range(1, 8))


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (
            f'<!DOCTYPE svg [<!ENTITY l0 "lol">{LAUGHS}]>{HEAD}><text>&l9;</text></svg>',
            "refers to other files, or defines XML entities that are no plain text",
        ),
        (
            f'<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>{HEAD}>&x;</svg>',
            "refers to other files, or defines XML entities that are no plain text",
        ),
        (
            f'<!DOCTYPE svg [<!ENTITY % x SYSTEM "http://127.0.0.1/x"> %x;]>{HEAD}></svg>',
            "refers to other files, or defines XML entities that are no plain text",
        ),
        (f'{HEAD}><defs><line id="u0" x2="9"/>{USES}</defs><use href="#u7"/></svg>', "more than"),
        (f"{HEAD}>{'<g>' * 50_000}{'</g>' * 50_000}</svg>", "nothing in it"),
        (f'{HEAD}><path d="M0 0 {"L" * 1_000_000}x"/></svg>', "is no path data"),
        (f'{HEAD}><polyline points="{" " * 1_000_000}x"/></svg>', "must be numbers"),
        (f'{HEAD}><polyline points="{"1" * 1_000_000}x"/></svg>', "must be numbers"),
        (f'{HEAD}><line x2="{"1" * 1_000_000}"/></svg>', "must be a number"),
        (f'{HEAD}><g transform="{"a" * 1_000_000}"/></svg>', "transform"),
        (f'{HEAD}><circle r="1e300"/></svg>', "must be a number"),
        (f'{HEAD}><circle r="1e12"/></svg>', "more segments than are allowed"),
        ("<html><body/></html>", "is not SVG: its first element is 'html'"),
        ("<svg", "is not XML"),
        ('<?xml version="1.0" encoding="no-such-code"?><svg/>', "is not XML"),
    ],
)
def test_files_that_mean_harm_are_refused_in_a_moment(tmp_path, content, said):
    path = tmp_path / "evil.svg"
    path.write_text(content)
    start = time.process_time()
    with pytest.raises(InputError, match=said) as error:
        read(path)
    assert "\n" not in str(error.value)
    assert time.process_time() - start < 5.0


@settings(
    deadline=None, max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.text("MmZzLlHhVvCcSsQqTtAa0123456789 ,.-+e", max_size=40))
def test_any_path_data_is_read_or_refused(svg, data):
    with contextlib.suppress(InputError):
        svg(f'<path d="M0 0{data}"/>', ALL)


def test_a_plain_doctype_is_no_harm(tmp_path):
    path = tmp_path / "old.svg"
    path.write_text(
        '<?xml version="1.0"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" '
        f'"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">{HEAD}><line x2="9"/></svg>'
    )
    assert len(read(path).frame.edges) == 1
