"""Frames from DXF: shapes by hand, and files that are not quite DXF."""

import contextlib
import io
import math

import ezdxf
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scadgen.errors import InputError
from scadgen.plane.catalogue import NAMES, named
from scadgen.readers.read import read
from scadgen.readers.reading import Reading

ALL = Reading(components=True)


@pytest.fixture
def dxf(tmp_path):
    def read_dxf(draw, reading=None, **header):
        document = ezdxf.new(**({"units": 4} | header))
        draw(document.modelspace())
        document.saveas(tmp_path / "drawing.dxf")
        return read(tmp_path / "drawing.dxf", reading)

    return read_dxf


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
        read(path, Reading(components=True))


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


def test_a_dxf_with_a_misplaced_entity_is_read_and_told(tmp_path, spoilt_dxf, capfd):
    path = tmp_path / "spoilt.dxf"
    at = spoilt_dxf.index("LINE") - 1
    lines = [*spoilt_dxf[:at], "  0", "NONSENSE", "  8", "0", *spoilt_dxf[at:]]
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match="1 NONSENSE: cannot be part of a frame"):
        read(path, Reading(components=True, strict=True))
    assert "left out: 1 NONSENSE" in read(path, Reading(components=True)).notes
    lines = [*spoilt_dxf[:-3], "  0", "SECTION", "  2", "CLASSES", "  0", "VERTEX"]
    path.write_text("\n".join([*lines, "  0", "ENDSEC", "  0", "EOF", ""]))
    found = read(path, Reading(components=True))
    assert (
        found.notes[0]
        == "is not quite DXF: Ignored invalid DXF entity type 'VERTEX' in section CLASSES."
    )
    assert len(found.frame.edges) > 10
    assert capfd.readouterr() == ("", "")


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


def test_dxf_unknown_entities_are_left_out_and_told_or_refused(dxf):
    def draw(space):
        space.add_line((0, 0), (9, 0))
        space.add_text("a")
        space.add_point((1, 1))
        space.add_text("b")

    with pytest.raises(InputError, match="1 POINT, 2 TEXT: cannot be part of a frame"):
        dxf(draw, Reading(strict=True))
    assert dxf(draw).notes == ("left out: 1 POINT, 2 TEXT",)


def test_dxf_entities_that_are_not_shown_are_left_out_and_told(dxf):
    def draw(space):
        layers = space.doc.layers
        layers.add("Off").off()
        layers.add("Frozen").freeze()
        layers.add("Locked").lock()
        layers.add("Help").dxf.plot = 0
        space.add_line((0, 0), (7, 7), {"layer": "HELP"})
        space.add_line((0, 0), (8, 8), {"layer": "Defpoints"})
        space.add_line((0, 0), (9, 0), {"layer": "locked"})
        space.add_line((0, 0), (0, 9), {"layer": "nowhere"})
        space.add_line((0, 0), (5, 5), {"layer": "off"})
        space.add_text("note", dxfattribs={"layer": "Frozen"})
        space.add_circle((0, 0), 3, {"invisible": 1})

    result = dxf(draw)
    assert result.frame.plan.tolist() == [[0, 0], [9, 0], [0, 9]]
    what = "entities that are invisible, or on layers that are off, frozen or not plotted, left out"
    assert result.notes == (f"{what}: 5",)
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


def test_dxf_meshes_are_the_sides_of_their_faces(dxf):
    def grid(space):
        mesh = space.add_polymesh((3, 3))
        for row in range(3):
            for column in range(3):
                mesh.set_mesh_vertex((row, column), (10 * column, 10 * row, 0))

    def faces(space):
        # Of the second triangle the side from (10, 10) to (0, 0) is hidden, which the first shows.
        space.add_3dface([(0, 0), (10, 0), (10, 10), (10, 10)])
        space.add_3dface([(0, 0), (10, 10), (0, 10), (0, 10)]).set_edge_visibility(0)

    def mesh(space):
        with space.add_mesh().edit_data() as data:
            data.vertices = [(0, 0, 5), (10, 0, 5), (10, 10, 5), (0, 10, 5)]
            data.faces = [(0, 1, 2), (0, 2, 3)]

    assert len(dxf(grid).frame.edges) == 12
    assert len(dxf(faces).frame.edges) == 5
    assert len(dxf(mesh).frame.edges) == 5
    hidden = dxf(lambda s: s.add_3dface([(0, 0), (9, 0), (9, 9), (0, 9)]).set_edge_visibility(1))
    assert len(hidden.frame.edges) == 3


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


def triangle(space, at=(0, 0)):
    space.add_lwpolyline([at, (at[0] + 10, at[1]), (at[0], at[1] + 10)], close=True)


def test_dxf_blocks_stand_where_they_are_inserted(dxf):
    def draw(space):
        triangle(space.doc.blocks.new("tile", base_point=(10, 0)))
        pair = space.doc.blocks.new("pair")
        pair.add_blockref("tile", (10, 0))
        pair.add_blockref("tile", (0, 0), {"rotation": 180})
        space.add_blockref("pair", (100, 50), {"xscale": 2, "yscale": 3})

    # The corners (0, 0), (10, 0), (0, 10) less (10, 0); as they are at (10, 0), and turned about.
    first, second = [(0, 0), (10, 0), (0, 10)], [(10, 0), (0, 0), (10, -10)]
    expected = sorted({(50 + 3 * y, 100 + 2 * x) for x, y in first + second})
    frame = dxf(draw).frame
    assert sorted((y, x) for x, y in frame.plan.round(6).tolist()) == expected
    assert len(frame.edges) == 5


def test_dxf_arrays_of_blocks_are_rows_and_columns(dxf):
    def draw(space):
        space.doc.blocks.new("bar").add_line((0, 0), (10, 0))
        grid = {"row_count": 3, "row_spacing": 5, "column_count": 4, "column_spacing": 10}
        space.add_blockref("bar", (1, 2), grid | {"rotation": 90})

    found = dxf(draw, Reading(components=True)).frame
    assert len(found.edges) == 12
    # A quarter turn: columns go up, rows to the left.
    assert found.bounds.round(6).tolist() == [[-9, 2], [1, 42]]


def test_dxf_circles_in_stretched_blocks_are_ellipses(dxf):
    def draw(space):
        space.doc.blocks.new("disc").add_circle((0, 0), 10)
        space.add_blockref("disc", (0, 0), {"xscale": 3, "yscale": 1})

    vertices = dxf(draw).frame.plan
    assert np.hypot(vertices[:, 0] / 30, vertices[:, 1] / 10) == pytest.approx(1, abs=1e-9)


def test_dxf_layers_of_blocks_hide_what_is_in_them(dxf):
    def draw(space):
        space.doc.layers.add("Off").off()
        space.doc.layers.add("Frozen").freeze()
        block = space.doc.blocks.new("both")
        block.add_line((0, 0), (10, 0))
        block.add_line((0, 0), (0, 10), {"layer": "own"})
        space.add_blockref("both", (0, 0), {"layer": "Off"})
        space.add_blockref("both", (50, 0), {"layer": "Frozen"})

    found = dxf(draw)
    # Of a block that is off only what has a layer of its own is seen; of a frozen one nothing.
    assert found.frame.plan.tolist() == [[0, 0], [0, 10]]
    assert found.notes[0].endswith("left out: 2")


def test_dxf_blocks_that_mean_harm_are_refused_in_a_moment(dxf):
    def circle(space):
        space.doc.blocks.new("again").add_blockref("again", (1, 0))
        space.add_blockref("again", (0, 0))

    def many(space):
        space.doc.blocks.new("b0").add_line((0, 0), (1, 0))
        for level in range(1, 9):
            block = space.doc.blocks.new(f"b{level}")
            for at in range(30):
                block.add_blockref(f"b{level - 1}", (at, level))
        space.add_blockref("b8", (0, 0))

    def grid(space):
        space.doc.blocks.new("dot").add_line((0, 0), (1, 0))
        space.add_blockref(
            "dot",
            (0, 0),
            {"row_count": 30000, "column_count": 30000, "row_spacing": 1, "column_spacing": 1},
        )

    with pytest.raises(InputError, match="block 'again': more than 32 blocks within each other"):
        dxf(circle)
    few = Reading(most=2000)
    for draw in (many, grid):
        with pytest.raises(InputError, match="more than 2000 entities, unless more are allowed"):
            dxf(draw, few)


def test_dxf_blocks_that_are_not_there_are_told(dxf):
    def draw(space):
        triangle(space)
        space.add_blockref("nowhere", (0, 0))

    assert "left out: 1 INSERT of a block that is not there"[:40] in dxf(draw).notes[0]


@pytest.mark.parametrize("flatten", [1.0, 0.05])
def test_dxf_splines_and_ellipses_are_within_the_tolerance(dxf, flatten):
    # One turn of a rational spline of degree 2 is a circle of 40; an ellipse of 60 and 30.
    corner = math.sqrt(0.5)

    def circle(space):
        square = [(40, 0), (40, 40), (0, 40), (-40, 40), (-40, 0), (-40, -40), (0, -40), (40, -40)]
        space.add_rational_spline(
            [*square, (40, 0)],
            weights=[1, corner] * 4 + [1],
            degree=2,
            knots=[0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4],
        )

    def ellipse(space):
        space.add_ellipse((0, 0), (60, 0), 0.5)

    for draw, axes in ((circle, (40, 40)), (ellipse, (60, 30))):
        frame = dxf(draw, Reading(flatten=flatten)).frame
        assert (frame.degree == 2).all()
        assert np.linalg.norm(frame.plan / axes, axis=1) == pytest.approx(1, abs=1e-6)
        middles = frame.plan[frame.edges].mean(axis=1) / axes
        # How far a chord is off is less than what its middle falls short along a radius.
        assert ((1 - np.linalg.norm(middles, axis=1)) * min(axes)).max() <= flatten + 1e-9
        needed = math.pi / math.acos(1 - flatten / max(axes))
        assert len(frame.edges) <= 2.5 * needed + 8


def test_dxf_hatches_are_their_outlines_as_drawn(dxf):
    def draw(space):
        space.add_lwpolyline([(0, 0, 0), (40, 0, 1), (40, 20, 0), (0, 20, 0)], "xyb", close=True)
        space.add_circle((20, 10), 5)
        hatch = space.add_hatch()
        hatch.paths.add_polyline_path([(0, 0, 0), (40, 0, 1), (40, 20, 0), (0, 20, 0)])
        hatch.paths.add_edge_path().add_arc((20, 10), 5, 0, 360)

    found, bare = dxf(draw, ALL), dxf(lambda s: (draw(s), s.query("HATCH")[0].destroy()), ALL)
    # What is drawn with its hatch is drawn twice, point by point.
    assert np.array_equal(found.frame.plan, bare.frame.plan)
    assert np.array_equal(found.frame.edges, bare.frame.edges)
    alone = dxf(lambda s: s.add_hatch().paths.add_polyline_path([(0, 0), (9, 0), (0, 9)]))
    assert len(alone.frame.edges) == 3
    mixed = dxf(
        lambda s: (
            (path := s.add_hatch().paths.add_edge_path()).add_line((0, 0), (20, 0)),
            path.add_ellipse((10, 0), (10, 0), 0.5, 0, 180),
        )
    )
    assert mixed.frame.bounds == pytest.approx(np.array([[0, 0], [20, 5]]), abs=0.06)


LINES = "0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n"
LINE = "0\nLINE\n8\n0\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n"
HANDLED = LINE.replace("8\n0\n", "5\n9A\n8\n0\n")
SHUFFLED = "0\nLINE\n8\n0\n10\n{0}\n11\n{2}\n20\n{1}\n21\n{3}\n"
SIDES = ((0, 0, 80, 0), (80, 0, 80, 80), (80, 80, 0, 0))


@pytest.mark.parametrize(
    ("line", "before", "said"),
    [
        (LINE, b"", None),
        (LINE, b"\xef\xbb\xbf", "is not quite DXF, read with repairs: "),
        (SHUFFLED, b"", "is not quite DXF, read with repairs: Missing required y coordinate"),
        (HANDLED, b"", "is not quite DXF: Found non-unique entity handle #9A"),
        (HANDLED.replace("10\n{}\n20\n{}\n11\n{}\n21\n{}\n", SHUFFLED[11:]), b"", "repairs"),
        (LINE + "0\nACDBNOTHING\n8\n0\n", b"", "left out: 3 ACDBNOTHING"),
    ],
)
def test_files_that_are_not_quite_dxf_are_read_whole_and_told(tmp_path, line, before, said):
    path = tmp_path / "a.dxf"
    text = LINES.format("".join(line.format(*ends) for ends in SIDES))
    path.write_bytes(before + text.encode())
    found = read(path)
    assert found.frame.plan.tolist() == [[0, 0], [80, 0], [80, 80]]
    assert len(found.frame.edges) == 3
    assert bool(found.notes) == (said is not None)
    assert any((said or "") in note for note in found.notes) or not said


def test_dxf_in_binary_is_read(tmp_path):
    document = ezdxf.new(units=4)
    triangle(document.modelspace())
    document.saveas(tmp_path / "a.dxf", fmt="bin")
    found = read(tmp_path / "a.dxf")
    assert (len(found.frame.edges), found.notes) == (3, ())


#: Units by their numbers in the header, in mm, worked out from what defines them.
IN_MM = dict(
    enumerate(
        [
            *(25.4, 304.8, 1609344, 1, 10, 1000, 1e6, 25.4e-6, 25.4e-3, 914.4, 1e-7, 1e-6, 1e-3),
            *(100, 1e4, 1e5, 1e12, 1.495978707e14, 9.4607304725808e18, 3.0856775814913673e19),
            *(1200 / 3.937, 100 / 3.937, 3600 / 3.937, 5280 * 1200 / 3.937),
        ],
        1,
    )
)


@pytest.mark.parametrize("number", IN_MM)
def test_dxf_has_all_units_of_its_header(dxf, number):
    length = 100 / IN_MM[number]
    assert dxf(lambda s: s.add_line((0, 0), (length, 0)), units=number).frame.lengths == (
        pytest.approx([100], rel=1e-7)
    )


def test_dxf_without_a_unit_but_imperial_is_told(dxf):
    def draw(space):
        space.doc.header["$MEASUREMENT"] = 0
        space.add_line((0, 0), (4, 0))

    found = dxf(draw, units=0)
    assert found.frame.lengths == pytest.approx([4])
    assert found.notes == (
        "it has imperial measures and no unit: taken as mm; --unit inch takes it as inches",
    )
    assert dxf(draw, Reading(scale=25.4), units=0).notes == ()


def test_dxf_heights_within_the_tolerance_are_flat(dxf):
    def draw(space):
        space.add_line((0, 0, 0), (9, 0, 0.004))

    assert dxf(draw).frame.lengths == pytest.approx([9])
    with pytest.raises(InputError, match=r"heights from 0 to 0\.004 mm, 0\.001 mm apart at most"):
        dxf(draw, Reading(tolerance=0.001))


def test_drawings_far_from_zero_are_moved_there_or_told(dxf):
    def at(x, y):
        return lambda space: triangle(space, (x, y))

    middle = [[-5, -5], [5, 5]]
    site = dxf(at(4.5e6, 5.4e6), units=6)
    assert site.frame.bounds.round(3).tolist() == [[-5000, -5000], [5000, 5000]]
    assert "as with --centre: its places were up to 5.4e+09 mm from it" in site.notes[0]
    far = dxf(at(5000, 0))
    assert far.frame.bounds.tolist() == [[5000, 0], [5010, 10]]
    assert far.notes == ("its places are up to 5010 mm from 0; --centre moves its middle there",)
    assert dxf(at(5000, 0), Reading(centre=True)).frame.bounds.tolist() == middle
    assert dxf(at(50, 0)).notes == ()
