"""Joints whose edges slope: connectors divide the domain, lock, and open."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kits import mesh, regular
from sloped import decomposed, openings, pieces, standing, touches, tube

from scadgen.check.joint_contacts import whole_contacts
from scadgen.errors import GeometryError, InputError
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.path import narrowest
from scadgen.interlock.verdict import Certificate, verdict
from scadgen.joint.domain import flats_of
from scadgen.joint.lattice import make_lattice
from scadgen.joint.pieces import LEDGE, TUBE
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import Weave, any_joint
from scadgen.solid.mesh import volume

#: Valence, and slope in degrees: the angle whose sine is edge over twice the circumradius.
SOLIDS = {
    "tetrahedron": (3, 54.74),
    "cube": (3, 35.26),
    "octahedron": (4, 45.0),
    "dodecahedron": (3, 20.91),
    "icosahedron": (5, 31.72),
}
STEEP = Weave(2.484, 1.029, 0.521, 0.593, 1.663, name="steep")

#: Gaps and slopes in degrees.
MIXED = [
    ((120, 90, 150), (-30, 20, 10)),
    ((72, 100, 88, 100), (40, -35, 0, 25)),
    ((48, 54, 69, 73, 40, 37, 39), (-21, 19, 9, -34, -5, 20, -6)),
]


def solid(name):
    count, slope = SOLIDS[name]
    return Spokes.of(regular(count), [math.radians(slope)] * count)


def mixed(gaps, slopes):
    return Spokes.of(np.radians(np.cumsum(gaps) - gaps[0]), np.radians(slopes))


def loose(spokes):
    return any_joint(float(spokes.gaps.min()), sloped=True)


def assert_partition(made):
    """Connectors fill the domain, and halves their connector."""
    whole = [volume(*mesh(c)) for c in made.connectors]
    assert sum(whole) == pytest.approx(made.lattice.domain.volume(), rel=1e-9)
    for connector, pair in zip(whole, made.halves, strict=True):
        assert sum(volume(*mesh(half)) for half in pair) == pytest.approx(connector, rel=1e-9)


def assert_locked(made):
    """By their exact walls, and by the faces that there are."""
    whole = [(standing(made, n, mesh(c)[0]), mesh(c)[1]) for n, c in enumerate(made.connectors)]
    for meshes, contacts in (
        whole_contacts(made.lattice, made.curves),
        (whole, find_contacts(whole, 1e-5)),
    ):
        assert isinstance(verdict(make_assembly(meshes, contacts, (0,))), Certificate)


def opened(made, which, up, clearance=0.01):
    """The gap that is left on the best way of a half, past all else and all tubes; 0 if none."""
    bodies = pieces(made, 0, clearance)
    moving, others = bodies[which], [bodies[1 - which], *bodies[2:]]
    tubes = [tube(made, edge, clearance) for edge in range(len(made.spokes))]
    ways = openings(*touches(made, 0, which, twin=True), up)
    found = (
        narrowest(path, [moving], [*others, *tubes], least=clearance / 20, look=0.1)
        for _, path in ways
    )
    return next((gap for gap in found if gap), 0.0)


@pytest.mark.parametrize("name", SOLIDS)
def test_joints_of_the_five_solids_are_divided_and_lock(name):
    made = decomposed(solid(name), loose(solid(name)))
    assert_partition(made)
    assert_locked(made)


@pytest.mark.parametrize("name", ["cube", "dodecahedron", "icosahedron"])
def test_half_a_opens_upwards_and_not_downwards(name):
    made = decomposed(solid(name), loose(solid(name)))
    assert opened(made, 0, 1.0) > 0
    assert not list(openings(*touches(made, 0, 0, twin=True), -1.0))


def test_a_steep_joint_opens_with_a_weave_of_its_own():
    spokes = solid("tetrahedron")
    assert not list(openings(*touches(decomposed(spokes, loose(spokes)), 0, 0, twin=True), 1.0))
    made = decomposed(spokes, STEEP)
    assert_partition(made)
    assert_locked(made)
    assert opened(made, 0, 1.0) > 0


@pytest.mark.parametrize(("gaps", "slopes"), MIXED)
def test_joints_of_mixed_slopes_are_divided_lock_and_open(gaps, slopes):
    spokes = mixed(gaps, slopes)
    made = decomposed(spokes, loose(spokes))
    assert_partition(made)
    assert_locked(made)
    assert max(opened(made, 0, 1.0), opened(made, 1, -1.0)) > 0


@st.composite
def stars(draw):
    """Three to seven edges no nearer than 32 degrees, with slopes from -50 to 55."""
    count = draw(st.integers(3, 7))
    shares = np.array(draw(st.lists(st.floats(0.1, 1), min_size=count, max_size=count)))
    gaps = 32 + shares / shares.sum() * (360 - 32 * count)
    slopes = draw(st.lists(st.floats(-50, 55), min_size=count, max_size=count))
    return mixed(gaps, slopes)


@settings(max_examples=12, deadline=None)
@given(stars())
def test_lattices_of_any_slopes_fit_their_domain(spokes):
    weave = loose(spokes)
    lattice = make_lattice(spokes, weave.ring_ratio, 5)
    nodes, domain = lattice.nodes, lattice.domain
    rim = nodes[:, -1].reshape(-1, 3)
    assert np.abs(domain.beyond(rim)).max() < 1e-9
    # Of all cells on one outer face the corners are in one plane.
    for face in range(int(lattice.strips[1].max()) + 1):
        (cells,) = np.nonzero(lattice.strips[1] == face)
        planes = np.unique([*cells, *((cells + 1) % len(nodes))])
        corners = nodes[planes, -1].reshape(-1, 3)
        assert np.linalg.svd(corners - corners.mean(axis=0))[1][2] < 1e-9
    # Each tube's square is on its flat, within it, and square to the edge.
    for edge, (azimuth, slope) in enumerate(zip(spokes.azimuths, spokes.slopes, strict=True)):
        face = domain.tube_face(edge)
        axes = face.axes
        corners = face.apply([(0, y, z) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
        assert (np.abs(corners[:, 2]) <= 0.5 + 1e-12).all()
        assert np.abs(domain.beyond(corners)).max() < 1e-9
        away = [math.cos(slope) * math.cos(azimuth), math.cos(slope) * math.sin(azimuth)]
        assert axes[0] == pytest.approx([*away, -math.sin(slope)])
        assert np.abs(axes @ axes.T - np.eye(3)).max() < 1e-12


@pytest.mark.parametrize("slope", [0.0, 20.0, -54.7])
def test_a_pyramid_has_the_volume_of_a_frustum(slope):
    spokes = Spokes.of(regular(4), np.radians([slope] * 4))
    domain = make_lattice(spokes, 2.5, 5).domain
    flats = flats_of(spokes.slopes, 2.5)
    scale = 1 + np.array([-0.5, 0.5]) * math.tan(math.radians(slope)) / flats.distance[0]
    # Corners are all equally far from the axis, at the outer lines' azimuths.
    turns = np.diff(np.append(domain.outer[:, 0], domain.outer[0, 0] + 2 * np.pi))
    base = float(np.sin(turns).sum()) / 2 * flats.corner[0] ** 2
    low, high = base * scale**2
    hole = np.diff(np.append(domain.inner, domain.inner[0] + 2 * np.pi))
    expected = (low + high + math.sqrt(low * high)) / 3 - np.sin(hole).sum() / 2 * 2**2
    assert domain.volume() == pytest.approx(expected, rel=1e-12)


def test_a_flat_keeps_a_ledge_around_its_tube():
    spokes = solid("cube")
    made = decomposed(spokes, loose(spokes))
    for surface in (made.connectors[0], *made.halves[0]):
        assert {TUBE, LEDGE} <= set(surface.outlines)
    points = made.connectors[0].points[np.unique(made.connectors[0].outlines[TUBE])]
    sides = np.linalg.norm(points[:, None] - points, axis=2)
    assert np.sort(sides, axis=1)[:, 1:] == pytest.approx(np.tile([1, 1, math.sqrt(2)], (4, 1)))


@given(stars(), st.integers(0, 6))
def test_a_joint_turned_or_turned_over_is_alike_edge_by_edge(spokes, shift):
    first = spokes.seen_from(0)
    assert first.is_like(spokes)
    assert first.turned_over().turned_over().is_like(first)
    turned = first.seen_from(shift)
    assert turned.slopes == pytest.approx(np.roll(spokes.slopes, -shift), abs=0)
    assert turned.gaps == pytest.approx(np.roll(spokes.gaps, -shift))


def test_symmetries_of_slopes_by_hand():
    def symmetry(gaps, slopes):
        return mixed(gaps, slopes).symmetry()

    even = (90, 90, 90, 90)
    assert (symmetry(even, (0,) * 4).period, symmetry(even, (0,) * 4).mirror) == (1, 0)
    # All down: turned over it is all up.
    assert (symmetry(even, (30,) * 4).period, symmetry(even, (30,) * 4).mirror) == (1, None)
    # A hypar's vertex: turned over about the middle of a gap, down and up change places.
    assert (symmetry(even, (9, -9, 9, -9)).period, symmetry(even, (9, -9, 9, -9)).mirror) == (2, 1)
    assert not symmetry(even, (9, -9, 9, -9)).either(0)
    assert symmetry((100, 80, 100, 80), (9, 9, 9, 9)).period == 2


def test_edges_that_are_alike_turned_over_have_one_shape():
    spokes = mixed((90, 90, 90, 90), (9, -9, 9, -9))
    made = decomposed(spokes, loose(spokes), keys=())
    assert made.alike == ((0, False), (0, True), (0, False), (0, True))
    assert_partition(made)


def test_what_is_no_joint_is_refused():
    with pytest.raises(InputError, match="slopes 61, 0: must be one an edge, from -60 to 60"):
        Spokes.of([0.0, 2.0], np.radians([61, 0]))
    with pytest.raises(InputError, match="must be one an edge"):
        Spokes.of([0.0, 2.0], [0.1])
    with pytest.raises(GeometryError, match=r"two tubes overlap 30 degrees apart"):
        make_lattice(mixed((30, 150, 180), (50, 50, 0)), 1.2, 5)
