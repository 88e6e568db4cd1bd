"""Frames from SVG and DXF: shapes by hand, and files that mean harm."""

import contextlib
import io
import math
import re
import time

import ezdxf
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.plane.catalogue import NAMES, named
from scadgen.readers.read import read
from scadgen.readers.reading import Reading

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
PAGE = 'width="100mm" height="100mm" viewBox="0 0 100 100"'
ALL = Reading(components=True)


@pytest.fixture
def svg(tmp_path):
    def read_svg(body, reading=None, page=PAGE):
        path = tmp_path / "drawing.svg"
        path.write_text(f"{HEAD} {page}>{body}</svg>")
        return read(path, reading)

    return read_svg


@pytest.fixture
def dxf(tmp_path):
    def read_dxf(draw, reading=None, **header):
        document = ezdxf.new(**({"units": 4} | header))
        draw(document.modelspace())
        document.saveas(tmp_path / "drawing.dxf")
        return read(tmp_path / "drawing.dxf", reading)

    return read_dxf


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


@pytest.mark.parametrize("name", sorted(NAMES)[::3])
def test_a_frame_drawn_as_dxf_lines_and_read_back_is_the_same(dxf, name):
    frame = named(name)

    def draw(space):
        for start, end in frame.plan[frame.edges].tolist():
            space.add_line(start, end)

    result = dxf(draw)
    assert result.notes == ()
    assert np.array_equal(result.frame.edges, frame.edges)
    assert result.frame.plan == pytest.approx(frame.plan, abs=1e-6)


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
    for fit, length in (("xMidYMid", 48), ("xMinYMax meet", 48), ("xMidYMid slice", 96)):
        page = uneven.replace('"none"', f'"{fit}"')
        assert box(svg(line, page=page))[1][0] == length
    assert box(svg(line, page=uneven.replace('"none"', '"none slice"')))[1][0] == 96


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
        ('<symbol id="a" viewBox="0 0 1 1"><line x2="5"/></symbol>', "used symbol with viewBox"),
        ('<symbol id="a" refX="4"><line x2="5"/></symbol>', "used symbol with refX"),
        ('<clipPath id="a"><line x2="5"/></clipPath>', "used clipPath"),
        ('<pattern id="a"><line x2="5"/></pattern>', "used pattern"),
        ('<x xmlns="editor" id="a"/>', "used foreign element"),
        ('<text id="a">t</text>', "2 text"),
    ],
)
def test_what_is_used_and_not_understood_is_told(svg, target, said):
    body = f'<line x2="9"/>{target}<use href="#a"/>'
    with pytest.raises(InputError, match=f"{said}: cannot be part of a frame; --skip-unknown"):
        svg(body)
    result = svg(body, Reading(skip_unknown=True))
    assert len(result.frame.edges) == 1
    assert said in result.notes[0]


def test_crossing_lines_are_joined_and_told(svg):
    result = svg('<path d="M0 0L10 10M0 10L10 0"/>')
    assert len(result.frame.edges) == 4
    assert result.notes == ("crossing split at (5, 95)",)
    with pytest.raises(InputError, match=r"segments cross at \(5, 95\)"):
        svg('<path d="M0 0L10 10M0 10L10 0"/>', Reading(split=False))


def test_unknown_elements_are_listed_and_skipped_if_asked(svg):
    body = '<line x2="10" y2="10"/><text>a</text><image href="a.png"/><text>b</text>'
    with pytest.raises(InputError, match="1 image, 2 text: cannot be part of a frame"):
        svg(body)
    assert svg(body, Reading(skip_unknown=True)).notes == ("left out: 1 image, 2 text",)


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
        ('<line x2="5em"/>', "x2 = '5em': must be a number"),
        ('<line x2="nan"/>', "x2 = 'nan': must be a number"),
        ('<rect width="50%" height="5"/>', "width = '50%': must be a number"),
        ('<g transform="twist(3)"/>', r"transform 'twist\(3\)': must be matrix"),
        ('<g transform="rotate(1 2)"/>', "transform"),
        ('<g transform="scale(2) and more"/>', "transform"),
        ('<circle r="4" transform="scale(0)"/>', "a transform leaves nothing of it"),
        ('<use href="other.svg#a"/>', "use of 'other.svg#a': must be the id of an element in the"),
        ('<use href="file:///etc/passwd"/>', "must be the id"),
        ('<use href="#none"/>', "must be the id"),
        ('<g id="a"><use href="#a"/></g>', "more than 8 uses within each other"),
        ('<svg><line x2="5"/></svg>', "1 svg: cannot be part of a frame"),
        ('<line x2="2e6" y2="0"/>', "must be within 1e.06 mm of 0"),
    ],
)
def test_svg_that_is_no_frame_is_refused(svg, body, said):
    with pytest.raises(InputError, match=said) as error:
        svg(body)
    assert "\n" not in str(error.value)


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
            "defines XML entities or refers to other files",
        ),
        (
            f'<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>{HEAD}>&x;</svg>',
            "defines XML entities or refers to other files",
        ),
        (
            f'<!DOCTYPE svg [<!ENTITY % x SYSTEM "http://127.0.0.1/x"> %x;]>{HEAD}></svg>',
            "defines XML entities or refers to other files",
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


@settings(
    deadline=None, max_examples=50, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.data())
def test_any_spoilt_dxf_is_read_or_refused(tmp_path, spoilt_dxf, data):
    lines = list(spoilt_dxf)
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(lines) - 1))
        lines[at] = data.draw(st.sampled_from(["", "0", "-1", "LINE", "1e999", "nan", "ENDSEC"]))
    path = tmp_path / "spoilt.dxf"
    path.write_text("\n".join(lines))
    with contextlib.suppress(InputError):
        read(path, Reading(components=True, skip_unknown=True))


@pytest.fixture(scope="module")
def spoilt_dxf():
    """Lines of a short DXF file of entities alone."""
    document = ezdxf.new("R12", units=4)
    space = document.modelspace()
    space.add_line((0, 0), (9, 0))
    space.add_polyline2d([(0, 0, 1), (5, 5, 0), (9, 0, -0.5)], format="xyb", close=True)
    space.add_arc((0, 0), 5, 30, 60)
    stream = io.StringIO()
    document.write(stream)
    lines = stream.getvalue().split("\n")
    return lines[lines.index("ENTITIES") - 3 :]


def test_a_dxf_with_a_misplaced_entity_is_refused_unless_asked(tmp_path, spoilt_dxf, capfd):
    path = tmp_path / "spoilt.dxf"
    at = spoilt_dxf.index("LINE") - 1
    lines = [*spoilt_dxf[:at], "  0", "NONSENSE", "  8", "0", *spoilt_dxf[at:]]
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match="1 NONSENSE: cannot be part of a frame"):
        read(path, Reading(components=True))
    lines = [*spoilt_dxf[:-3], "  0", "SECTION", "  2", "CLASSES", "  0", "VERTEX"]
    path.write_text("\n".join([*lines, "  0", "ENDSEC", "  0", "EOF", ""]))
    with pytest.raises(InputError, match="is broken: Ignored invalid DXF entity type 'VERTEX'"):
        read(path, Reading(components=True))
    assert len(read(path, Reading(components=True, skip_unknown=True)).frame.edges) > 10
    assert capfd.readouterr() == ("", "")


def test_a_plain_doctype_is_no_harm(tmp_path):
    path = tmp_path / "old.svg"
    path.write_text(
        '<?xml version="1.0"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" '
        f'"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">{HEAD}><line x2="9"/></svg>'
    )
    assert len(read(path).frame.edges) == 1


def test_dxf_lines_and_polylines(dxf):
    def draw(space):
        space.add_line((0, 0), (10, 0))
        space.add_lwpolyline([(10, 0), (10, 10), (0, 10)])
        space.add_polyline2d([(0, 10), (-5, 5), (0, 0)])

    result = dxf(draw)
    assert (len(result.frame.vertices), len(result.frame.edges)) == (5, 5)
    assert result.frame.bounds.tolist() == [[-5, 0], [10, 10]]


def test_dxf_closed_polylines_and_circles_close(dxf):
    assert (
        len(dxf(lambda s: s.add_lwpolyline([(0, 0), (9, 0), (0, 9)], close=True)).frame.edges) == 3
    )
    circle = dxf(lambda s: s.add_circle((0, 0), 40)).frame
    assert (circle.degree == 2).all()


@pytest.mark.parametrize("flatten", [1.0, 0.01])
def test_dxf_bulges_and_arcs_are_within_the_tolerance(dxf, flatten):
    # A bulge of 1 is half a circle: from (-40, 0) to (40, 0) below the x axis; an arc above.
    def draw(space):
        space.add_lwpolyline([(-40, 0, 1), (40, 0, 0)], format="xyb")
        space.add_arc((0, 0), 40, 0, 180)

    found = dxf(draw, Reading(flatten=flatten))
    frame = found.frame
    assert found.notes[0].startswith(f"shapes with curves: 2, now {len(frame.edges)} segments")
    assert np.linalg.norm(frame.plan, axis=1) == pytest.approx(40, abs=0.01)
    middles = frame.plan[frame.edges].mean(axis=1)
    assert np.linalg.norm(middles, axis=1).min() >= 40 - flatten - 1e-9
    assert (frame.degree == 2).all()
    assert frame.bounds == pytest.approx(np.array([[-40, -40], [40, 40]]), abs=flatten)


def test_dxf_units_give_millimetres(dxf):
    def draw(space):
        space.add_line((0, 0), (1, 0))

    assert dxf(draw, units=1).frame.lengths == pytest.approx([25.4])
    assert dxf(draw, units=5).frame.lengths == pytest.approx([10])
    assert dxf(draw, units=0).frame.lengths == pytest.approx([1])
    assert dxf(draw, Reading(scale=3.0), units=1).frame.lengths == pytest.approx([3])


def test_dxf_unknown_entities_are_listed_and_skipped_if_asked(dxf):
    def draw(space):
        space.add_line((0, 0), (9, 0))
        space.add_text("a")
        space.add_point((1, 1))
        space.add_text("b")

    with pytest.raises(InputError, match="1 POINT, 2 TEXT: cannot be part of a frame"):
        dxf(draw)
    assert dxf(draw, Reading(skip_unknown=True)).notes == ("left out: 1 POINT, 2 TEXT",)


def test_dxf_entities_that_are_not_shown_are_left_out_and_told(dxf):
    def draw(space):
        layers = space.doc.layers
        layers.add("Off").off()
        layers.add("Frozen").freeze()
        layers.add("Locked").lock()
        space.add_line((0, 0), (9, 0), {"layer": "locked"})
        space.add_line((0, 0), (0, 9), {"layer": "nowhere"})
        space.add_line((0, 0), (5, 5), {"layer": "off"})
        space.add_text("note", dxfattribs={"layer": "Frozen"})
        space.add_circle((0, 0), 3, {"invisible": 1})

    result = dxf(draw)
    assert result.frame.plan.tolist() == [[0, 0], [9, 0], [0, 9]]
    what = "entities that are invisible, or on layers that are off or frozen, left out"
    assert result.notes == (f"{what}: 3",)
    with pytest.raises(InputError, match=f"nothing in it that could be an edge; {what}: 1$"):
        dxf(lambda space: space.add_line((0, 0), (9, 0), {"invisible": 1}))


@pytest.mark.parametrize("kind", ["add_polyline2d", "add_polyline3d"])
def test_dxf_splines_are_the_points_on_them(dxf, kind):
    # As it is drawn, a corner at (5, 5) that the curve does not reach stands among the others.
    def draw(space):
        points = [(0, 0, 0), (0, 0, 0), (2, 1.6, 0), (5, 5, 0), (8, 1.6, 0), (10, 0, 0)]
        spline = getattr(space, kind)(points)
        spline.dxf.flags |= 4
        for vertex, flags in zip(spline.vertices, (16, 8, 8, 16, 8, 8), strict=True):
            vertex.dxf.flags |= flags

    assert dxf(draw).frame.plan.tolist() == [[0, 0], [10, 0], [2, 1.6], [8, 1.6]]


def test_dxf_polylines_without_points_are_nothing(dxf):
    def draw(space):
        space.add_line((0, 0), (9, 0))
        space.add_lwpolyline([])
        space.add_polyline2d([])

    assert len(dxf(draw).frame.edges) == 1


def test_dxf_meshes_are_no_polylines(dxf):
    with pytest.raises(InputError, match="1 POLYLINE: cannot be part of a frame"):
        dxf(lambda space: space.add_polymesh((3, 3)))


def test_dxf_points_at_different_heights_are_refused(dxf):
    def draw(space):
        space.add_line((0, 0, 0), (9, 0, 2))

    with pytest.raises(InputError, match="is not plane: its points are at heights from 0 to 2"):
        dxf(draw)
    flat = dxf(lambda space: space.add_line((0, 0, 7), (9, 0, 7))).frame
    assert flat.lengths == pytest.approx([9])


def test_dxf_with_too_much_in_it_is_refused(dxf):
    def draw(space):
        space.add_circle((0, 0), 1e5)

    with pytest.raises(InputError, match="more segments than are allowed"):
        dxf(draw, Reading(most=2000, flatten=1e-4))


def test_dxf_cut_short_is_refused(tmp_path, dxf):
    dxf(lambda space: space.add_line((0, 0), (9, 0)))
    path = tmp_path / "drawing.dxf"
    text = path.read_text()
    for share in (0.1, 0.5, 0.9):
        path.write_text(text[: int(share * len(text))])
        with pytest.raises(InputError) as error:
            read(path)
        assert "\n" not in str(error.value)
