"""The walls against another way: Qhull's Voronoi diagram of many samples of the site curves."""

from itertools import pairwise

import numpy as np
import pytest
from kits import WEAVES, joint
from scipy.spatial import Voronoi, cKDTree

#: Samples of each curve; each step doubles them.
COUNTS = (60, 120, 240)


class Sampled:
    """Voronoi diagram of samples of all curves of a joint, each labelled with its curve."""

    def __init__(self, curves, count):
        u = np.linspace(-1, 1, count)
        self.points = np.concatenate([curve.points(u) for curve in curves])
        self.labels = np.repeat(np.arange(len(curves)), count)
        self.trees = [cKDTree(self.points[self.labels == n]) for n in range(len(curves))]

    def gaps(self, points):
        """How much farther the second nearest label's samples are than the nearest's."""
        far = np.sort(np.stack([tree.query(points)[0] for tree in self.trees]), axis=0)
        return far[1] - far[0]

    def nearest(self, points):
        return np.stack([tree.query(points)[0] for tree in self.trees]).argmin(axis=0)

    def wall_vertices(self, lattice):
        """Qhull's vertices, within the domain, of ridges between different labels."""
        diagram = Voronoi(self.points)
        between = self.labels[diagram.ridge_points]
        used = {
            vertex
            for ridge, (a, b) in zip(diagram.ridge_vertices, between, strict=True)
            if a != b
            for vertex in ridge
            if vertex >= 0
        }
        places = diagram.vertices[sorted(used)]
        radius = np.hypot(places[:, 0], places[:, 1])
        ring = lattice.domain.ring_ratio
        inside = (np.abs(places[:, 2]) < 0.5) & (radius > ring - 0.4) & (radius < ring + 0.4)
        return places[inside]


def wall_points(made):
    """Vertices of all walls of a joint that are on the exact walls, in its own frame."""
    surface = made.connectors[0]
    points = surface.points[np.unique(surface.walls)]
    far = np.sort(np.stack([c.distance(points)[0] for c in made.curves]), axis=0)
    return points[far[1] - far[0] < 1e-9]


@pytest.mark.parametrize("frame", WEAVES)
def test_our_vertices_come_onto_the_sampled_walls_as_samples_grow(frame):
    made = joint(frame, "standard")
    points = wall_points(made)
    assert len(points) > 300
    exact = made.curves[0].distance(points)[0]
    means = []
    for count in COUNTS:
        u = np.linspace(-1, 1, count)
        spacing = max(
            np.linalg.norm(np.diff(c.points(u), axis=0), axis=1).max() for c in made.curves
        )
        gaps = Sampled(made.curves, count).gaps(points)
        # Half a spacing aside at distance d adds spacing^2 / 8d; the curve may bend towards it.
        assert (gaps < spacing**2 / (3 * exact)).all()
        means.append(gaps.mean())
    for coarse, fine in pairwise(means):
        assert 3 < coarse / fine < 5.5
    assert means[-1] < 2e-4


@pytest.mark.parametrize("frame", WEAVES)
def test_qhulls_vertices_come_onto_our_walls_as_samples_grow(frame):
    made = joint(frame, "standard")
    worst = []
    for count in COUNTS:
        places = Sampled(made.curves, count).wall_vertices(made.lattice)
        assert len(places) > count / 2
        far = np.sort(np.stack([c.distance(places)[0] for c in made.curves]), axis=0)
        worst.append((far[1] - far[0]).max())
    # Two doublings: a sixteenth, but for where Qhull's vertices happen to lie.
    assert 8 < worst[0] / worst[-1] < 32
    assert worst[-1] < 5e-4


@pytest.mark.parametrize("frame", WEAVES)
def test_qhulls_vertices_lie_on_our_triangles(frame):
    made = joint(frame, "standard")
    places = Sampled(made.curves, 120).wall_vertices(made.lattice)
    surface = made.connectors[0]
    grid = np.array([(i, j, 6 - i - j) for i in range(7) for j in range(7 - i)]) / 6
    dense = np.einsum("qk,tkx->tqx", grid, surface.points[surface.walls]).reshape(-1, 3)
    mine = np.sort(np.stack([c.distance(places)[0] for c in made.curves]), axis=0)[0]
    own = made.curves[0].distance(places)[0] - mine < 1e-3
    assert own.sum() > 50
    # The walls are flat within a cell of a ninth of the side, and samples of them 1/50 apart.
    off = cKDTree(dense).query(places[own])[0]
    assert off.mean() < 0.01
    assert off.max() < 0.05


@pytest.mark.parametrize("frame", WEAVES)
def test_labels_agree_away_from_walls(frame):
    made = joint(frame)
    sampled = Sampled(made.curves, 480)
    rng = np.random.default_rng(7)
    angle, radius, height = rng.random((3, 5000))
    radius = made.lattice.domain.ring_ratio - 0.5 + radius
    points = np.column_stack([radius * np.cos(7 * angle), radius * np.sin(7 * angle), height - 0.5])
    ours = np.stack([c.distance(points)[0] for c in made.curves]).argmin(axis=0)
    away = sampled.gaps(points) > 1e-3
    assert away.mean() > 0.98
    assert (ours == sampled.nearest(points))[away].all()
    # And every label has its fair share of a ring that looks the same all around.
    assert np.allclose(np.bincount(ours) / len(ours), 1 / len(made.curves), atol=0.1)
