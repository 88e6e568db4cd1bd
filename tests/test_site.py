"""Another family of sites, of which no module of ours knows, makes a joint as site curves do."""

from dataclasses import dataclass

import numpy as np
import pytest

from scadgen.check.joint_contacts import whole_contacts
from scadgen.joint.fan import fanned
from scadgen.joint.joint import check_footprint
from scadgen.joint.lattice import make_lattice
from scadgen.joint.pieces import SPLIT, halves
from scadgen.joint.place import beside_walls, place
from scadgen.joint.site import Rough, distances, nearest_site, slopes
from scadgen.joint.spokes import Spokes
from scadgen.joint.surface import join
from scadgen.joint.territory import belongs
from scadgen.joint.tidy import merge_short_sides
from scadgen.joint.walls import wedges

RATIO, HALF, CELLS = 1.5, 0.9, 5


@dataclass(frozen=True, eq=False)
class Segment:
    """A straight piece across an edge, that rises from one end to the other."""

    angle: float
    slope: float
    name: str = "segment"

    @property
    def turn(self):
        c, s = np.cos(self.angle), np.sin(self.angle)
        return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]])

    @property
    def ends(self):
        end = np.array([0, HALF, HALF * self.slope])
        return (np.array([RATIO, 0, 0]) + np.stack([-end, end])) @ self.turn

    def together(self, sites):
        return Segments(np.stack([site.ends for site in sites]))


class Segments:
    def __init__(self, ends):
        self.start, self.way = ends[:, 0], ends[:, 1] - ends[:, 0]

    def roughly(self, which, points):
        """From the sphere around each: no better than that."""
        far = np.linalg.norm(points - (self.start + self.way / 2)[which], axis=1)
        half = np.linalg.norm(self.way, axis=1)[which] / 2
        return Rough(np.maximum(far - half, 0), far, np.zeros(len(far)))

    def away(self, which, points, start):
        assert (start == 0).all()
        off, way = points - self.start[which], self.way[which]
        share = np.clip((off * way).sum(axis=1) / (way * way).sum(axis=1), 0, 1)
        return off - share[:, None] * way


def by_hand(sites, points):
    """Distances by many points of each segment's line, then the projection between its ends."""
    found = []
    for site in sites:
        a, b = site.ends
        share = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        found.append(np.linalg.norm(points - a - share[..., None] * (b - a), axis=-1))
    return np.stack(found)


EDGES = np.radians([0.0, 110.0, 230.0])
SITES = tuple(Segment(angle, 0.35) for angle in EDGES.tolist())


@pytest.mark.parametrize("count", [40, 6000])
@pytest.mark.parametrize("beyond", [0.0, 0.3, np.inf])
def test_distances_that_are_wanted_are_exact(count, beyond):
    points = np.random.default_rng(count).uniform([-2, -2, -0.5], [2, 2, 0.5], (count, 3))
    true, found = by_hand(SITES, points), distances(SITES, points, beyond)
    wanted = true <= true.min(axis=0) + beyond
    wanted &= wanted.sum(axis=0) > 1
    assert np.allclose(found[wanted], true[wanted], rtol=0, atol=1e-12)
    assert (found >= true - 1e-12).all()
    assert (nearest_site(SITES, points) == true.argmin(axis=0)).all()
    # A site that is alone may be told as farther than it is, but never as far as another.
    alone = wanted.sum(axis=0) == 0
    others = np.sort(true[:, alone], axis=0)[1]
    assert (found[:, alone].min(axis=0) < others).all()


def test_slopes_are_those_of_the_distance():
    rng = np.random.default_rng(1)
    points, which = rng.uniform([-2, -2, -0.5], [2, 2, 0.5], (300, 3)), rng.integers(0, 3, 300)
    found, slope = slopes(SITES, points, which)
    assert np.allclose(found, by_hand(SITES, points)[which, np.arange(300)], atol=1e-12)
    for axis in range(3):
        step = 1e-6 * np.eye(3)[axis]
        ends = [slopes(SITES, points + sign * step, which)[0] for sign in (1, -1)]
        assert np.allclose((ends[0] - ends[1]) / 2e-6, slope[:, axis], atol=1e-5)


def volume(surface):
    """Of a closed surface whose facets are outlines."""
    cones = [surface.points[surface.walls]]
    for sides in surface.outlines.values():
        apex = np.broadcast_to(surface.points[sides[0, 0]], (len(sides), 3))
        cones.append(np.stack([apex, *surface.points[sides.T]], axis=1))
    return np.linalg.det(np.concatenate(cones)).sum() / 6


def test_segments_part_the_ring():
    lattice = make_lattice(Spokes.flat(EDGES), RATIO, CELLS)
    far = beside_walls(lattice, SITES)
    labels = far.argmin(axis=0)
    assert (labels == by_hand(SITES, lattice.nodes).argmin(axis=0)).all()
    found = list(wedges(lattice, labels))
    keys = sorted({corner for wedge in found for corner in wedge.corners})
    position = dict(zip(keys, place(lattice, SITES, far, keys), strict=True))
    found = merge_short_sides(found, position, 1 / CELLS, lattice.domain)
    found = fanned(found, position, SITES, lattice.domain)
    connectors = []
    for edge in range(3):
        check_footprint(lattice, SITES, edge)
        connectors.append(join(*halves(lattice, labels, found, position, edge), SPLIT))
    whole = [volume(one) for one in connectors]
    assert min(whole) > 0
    assert sum(whole) == pytest.approx(lattice.domain.volume(), rel=1e-9)


def test_a_box_across_a_wall_belongs_to_nobody():
    low = np.array([RATIO - 0.1, -0.1, -0.1])
    assert belongs(SITES, 0, low, low + 0.2, 0.05)
    assert not belongs(SITES, 0, low, low + np.array([0.2, 3.0, 0.2]), 0.0)


def test_contacts_are_equally_far_from_two_segments():
    lattice = make_lattice(Spokes.flat(EDGES), RATIO, CELLS)
    _, contacts = whole_contacts(lattice, SITES)
    true = by_hand(SITES, contacts.points)
    row = np.arange(len(contacts))
    assert len(contacts) > 50
    assert np.allclose(true[contacts.first, row], true.min(axis=0), rtol=0, atol=2e-7)
    assert np.allclose(true[contacts.second, row], true.min(axis=0), rtol=0, atol=2e-7)
