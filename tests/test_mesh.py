"""Facts about meshes, and faces that cross."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import box, merged, together, torus

from scadgen.solid.crossing import crossing_faces
from scadgen.solid.mesh import (
    areas,
    components,
    edge_faults,
    euler,
    genus,
    heights,
    normals,
    pinched_vertices,
    solid_faults,
    volume,
    weld_float32,
)


def test_a_box_has_the_measures_of_a_box():
    points, triangles = box((1, 1, 1), (2, 3, 4))
    assert volume(points, triangles) == pytest.approx(6)
    assert areas(points, triangles).sum() == pytest.approx(22)
    assert volume(points, triangles[:, ::-1]) == pytest.approx(-6)
    outwards = normals(points, triangles)
    assert sorted(map(tuple, np.unique(outwards, axis=0) + 0.0)) == sorted(
        [(-1, 0, 0), (0, -1, 0), (0, 0, -1), (0, 0, 1), (0, 1, 0), (1, 0, 0)]
    )
    middles = points[triangles].mean(axis=1) - (1.5, 2, 2.5)
    assert ((outwards * middles).sum(axis=1) > 0).all()
    assert (euler(triangles), genus(triangles), components(triangles)) == (2, 0, 1)
    assert solid_faults(points, triangles) == []


def test_volume_keeps_its_digits_far_away():
    points, triangles = box((0, 0, 0), (1, 1, 1))
    assert volume(points + 2.0**20, triangles) == 1


def test_heights_are_the_smallest_ones():
    points = np.array([[0, 0, 0], [4, 0, 0], [0, 3, 0], [2, 0, 0]], dtype=float)
    found = heights(points, np.array([[0, 1, 2], [0, 1, 3], [1, 1, 1]]))
    assert found == pytest.approx([12 / 5, 0, 0])
    assert normals(points, np.array([[0, 1, 3]])).tolist() == [[0, 0, 0]]


def test_a_torus_has_one_handle_and_two_tori_have_two():
    points, triangles = torus()
    assert (euler(triangles), genus(triangles)) == (0, 1)
    assert solid_faults(points, triangles) == []
    both, faces = together((points, triangles), (points + 20, triangles))
    assert (genus(faces), components(faces)) == (2, 2)
    assert solid_faults(both, faces) == ["one shell: 2 shells"]


def test_a_missing_face_leaves_its_three_edges_open():
    points, triangles = box((0, 0, 0), (1, 1, 1))
    assert edge_faults(triangles[1:]).tolist() == [[0, 1], [0, 3], [1, 3]]
    (fault,) = [x for x in solid_faults(points, triangles[1:]) if x.startswith("closed:")]
    assert fault == "closed: edges without exactly two faces: 3 (0-1, 0-3, 1-3)"


def test_a_turned_face_is_not_oriented():
    points, triangles = box((0, 0, 0), (1, 1, 1))
    turned = triangles.copy()
    turned[0] = turned[0][::-1]
    assert edge_faults(turned).tolist() == [[0, 1], [0, 3], [1, 3]]
    assert any(x.startswith("oriented: ") for x in solid_faults(points, turned))
    assert solid_faults(points, triangles[:, ::-1]) == ["positive volume: -1 mm3"]


def test_boxes_that_share_an_edge_or_a_vertex_are_no_solid():
    points, triangles = merged(*together(box((0, 0, 0), (1, 1, 1)), box((1, 1, 0), (2, 2, 1))))
    assert len(edge_faults(triangles)) == 1
    points, triangles = merged(*together(box((0, 0, 0), (1, 1, 1)), box((1, 1, 1), (2, 2, 2))))
    assert len(edge_faults(triangles)) == 0
    assert points[pinched_vertices(triangles)].tolist() == [[1, 1, 1]]
    assert components(triangles) == 2
    assert components(triangles, "vertices") == 1
    assert [x.split(":")[0] for x in solid_faults(points, triangles)] == [
        "one shell",
        "one fan at a vertex",
    ]


def test_a_degenerate_face_is_named():
    # The point on the middle of an edge makes two good faces and one without area.
    points, triangles = box((0, 0, 0), (1, 1, 1))
    points = np.vstack([points, [[0, 0, 0.5]]])
    triangles = np.vstack([triangles[1:], [[0, 8, 3], [8, 1, 3]]])
    flat = np.array([[0, 1, 8]])
    faults = solid_faults(points, np.vstack([triangles, flat]))
    assert faults == ["no degenerate face: faces: 1 (13)"]


@pytest.mark.parametrize(
    ("points", "triangles", "start"),
    [
        (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64), "closed: the mesh has no faces"),
        (np.zeros((3, 3)), np.array([[0, 1, 3]]), "vertex numbers: "),
        (np.full((3, 3), np.nan), np.array([[0, 1, 2]]), "finite: points: 3 (0, 1, 2)"),
    ],
)
def test_what_is_no_mesh_at_all_is_told_first(points, triangles, start):
    (fault,) = solid_faults(points, triangles)
    assert fault.startswith(start)


def test_rounding_to_float32_merges_what_is_too_close():
    # Near 1000 mm neighbouring float32 numbers are 6e-5 mm apart.
    points, triangles = box((1000, 0, 0), (1000.00001, 1, 1))
    rounded, welded = weld_float32(points, triangles)
    assert len(rounded) == 4
    assert rounded.dtype == np.float32
    assert welded.shape == (12, 3)
    (fault,) = solid_faults(points, triangles)
    assert fault.startswith("no collapsed face in float32: faces: ")
    assert solid_faults(*box((1000, 0, 0), (1000.001, 1, 1))) == []


def test_minus_zero_is_zero():
    points = np.array([[0.0, 0, 0], [-0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    assert len(weld_float32(points, np.array([[0, 2, 3], [1, 3, 2]]))[0]) == 3


FIRST = [(0, 0, 0), (4, 0, 0), (0, 4, 0)]


@pytest.mark.parametrize(
    ("second", "crosses"),
    [
        ([(1, 1, -1), (1, 1, 1), (5, 5, 1)], True),  # pierces
        ([(1, 1, 0), (1, 1, 1), (5, 5, 1)], True),  # stands on it
        ([(1, 1, 1e-3), (1, 1, 1), (5, 5, 1)], False),  # hovers
        ([(1, 1, 0), (2, 1, 0), (1, 2, 0)], True),  # lies within it
        ([(-9, -9, 0), (30, -9, 0), (-9, 30, 0)], True),  # holds it
        ([(3, 3, 0), (9, 3, 0), (3, 9, 0)], False),  # in its plane, beside it
        ([(2, 2, 0), (9, 3, 0), (3, 9, 0)], True),  # in its plane, touching its side
        ([(-1, 1, 0), (5, 1, 0), (2, 9, 0)], True),  # in its plane, across
        ([(3, 3, -1), (3, 3, 1), (5, 5, 1)], False),  # pierces the plane beside it
        ([(0, 0, 0), (1, 1, -1), (1, 1, 1)], True),  # through it, from a common vertex
        ([(0, 0, 0), (-1, -1, 1), (-1, 1, 1)], False),  # only the common vertex
        ([(0, 0, 0), (1, 1, 0), (1, 2, 0)], True),  # over it, from a common vertex
        ([(0, 0, 0), (9, 9, 0), (9, 10, 0)], True),  # the same, larger
        ([(0, 0, 0), (-1, 0, 0), (0, -1, 0)], False),  # opposite sectors
        ([(0, 0, 0), (4, 0, 0), (1, 1, 0)], True),  # folded onto it
        ([(4, 0, 0), (0, 0, 0), (1, -1, 0)], False),  # unfolded
        ([(4, 0, 0), (0, 0, 0), (1, 1, 1e-3)], False),  # nearly folded
        ([(4, 0, 0), (0, 4, 0), (0, 0, 0)], True),  # the same face again
    ],
)
def test_two_faces(second, crosses):
    points, triangles = merged(np.array(FIRST + second, dtype=float), np.arange(6).reshape(2, 3))
    for order in ([0, 1], [1, 0]):
        for turn in range(3):
            faces = np.roll(triangles[order], turn, axis=1)
            assert len(crossing_faces(points, faces)) == crosses


def test_no_faces_do_not_cross():
    assert crossing_faces(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)).shape == (0, 2)


def sign(x):
    return (x > 0) - (x < 0)


def orient(a, b, c, d):
    return sign(round(np.linalg.det(np.array([b, c, d]) - np.array(a))))


def segment_meets(p, q, triangle):
    """Segment against triangle in small whole numbers, where the signs are exact."""
    a, b, c = triangle
    above = orient(a, b, c, p), orient(a, b, c, q)
    if above[0] * above[1] > 0:
        return False
    if above != (0, 0):
        turns = {orient(p, q, a, b), orient(p, q, b, c), orient(p, q, c, a)}
        return not {1, -1} <= turns
    normal = np.cross(np.subtract(b, a), np.subtract(c, a))
    drop = int(np.argmax(np.abs(normal)))
    p, q, a, b, c = (tuple(np.delete(x, drop).tolist()) for x in (p, q, a, b, c))

    def side(u, v, w):
        return sign((v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0]))

    def within(w):
        return not {1, -1} <= {side(a, b, w), side(b, c, w), side(c, a, w)}

    def meets(u, v):
        if side(p, q, u) * side(p, q, v) > 0 or side(u, v, p) * side(u, v, q) > 0:
            return False
        return all(
            max(min(p[k], q[k]), min(u[k], v[k])) <= min(max(p[k], q[k]), max(u[k], v[k]))
            for k in range(2)
        )

    return within(p) or within(q) or meets(a, b) or meets(b, c) or meets(c, a)


SPOT = st.tuples(*[st.integers(-3, 3)] * 3)


@settings(deadline=None, max_examples=300)
@given(st.lists(SPOT, min_size=6, max_size=6, unique=True))
def test_two_faces_against_signs_in_whole_numbers(spots):
    points, triangles = np.array(spots, dtype=float), np.arange(6).reshape(2, 3)
    if not heights(points, triangles).all():
        return
    one, other = spots[:3], spots[3:]
    meet = any(segment_meets(one[k - 1], one[k], other) for k in range(3)) or any(
        segment_meets(other[k - 1], other[k], one) for k in range(3)
    )
    assert len(crossing_faces(points, triangles)) == meet


@settings(deadline=None, max_examples=10)
@given(st.integers(0, 2**32 - 1))
def test_candidates_are_never_lost(seed):
    # Every pair put to the test by itself, without the search for candidates.
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(24, 3))
    triangles = np.array([rng.choice(24, 3, replace=False) for _ in range(16)])
    size = np.linalg.norm(np.ptp(points, axis=0))
    pairs = [
        [i, j]
        for j in range(16)
        for i in range(j)
        if len(crossing_faces(points, triangles[[i, j]], touch=1e-9 * size))
    ]
    assert crossing_faces(points, triangles).tolist() == sorted(pairs)


def test_two_interleaved_tori_cross():
    points, triangles = torus()
    turned = points[:, [0, 2, 1]] * (1, 1, -1)
    linked, faces = together((points, triangles), (np.add(turned, (3, 0, 0)), triangles))
    assert len(crossing_faces(linked, faces)) == 0
    crossed, faces = together((points, triangles), (np.add(turned, (0.5, 0, 0)), triangles))
    found = crossing_faces(crossed, faces)
    assert len(found) > 0
    assert (found[:, 0] < len(triangles)).all()
    assert (found[:, 1] >= len(triangles)).all()
    assert solid_faults(crossed, faces)[-1].startswith("no crossing faces: pairs of faces: ")
