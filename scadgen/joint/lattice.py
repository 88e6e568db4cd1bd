"""The lattice that fits a joint's domain.

Its axes, in this order a left-handed frame, are the angle, the share of the way from the hole's
outline to the outer one, and the height.  The domain's faces, and the vertical planes through its
edges, are unions of its faces.

Where the outside is upright, or slopes alike, nodes of one index are in a plane through the axis.
Between flats of different slopes they lean, on either side of the wall's middle: the outline above
goes on while that below stays, and then the other way around, so that outer faces are triangles.
Turned over that is itself.  Lengths are in units of the side.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scadgen.joint.domain import Domain, check_room, flats_of
from scadgen.joint.lean import LEANING, lean
from scadgen.joint.spokes import Spokes
from scadgen.solid.affine import Floats, Ints

__all__ = ["Lattice", "make_lattice", "without_corners"]

#: Half the width of the inner flats where there is room, in sides.
_PAD = 0.36

#: Cells a side where there are no walls.
_LONG = 2

#: A plane closer to the next than this, in cells, is left out.
_SLIVER = 0.5

#: Slopes of two flats that are as near as this are the same, in radians.
_SAME = 1e-9


@dataclass(frozen=True, eq=False)
class Lattice:
    """Nodes of the lattice and how its cells lie on the domain's faces.

    Parameters
    ----------
    domain
        The joint's domain.
    planes
        Angles of the lattice at its inner side, ascending; the cells after the last close the ring.
    edge_planes
        For each edge, the index of the plane through it.
    flats
        ``(edges, 2) int``: indices at which each edge's outer flat begins and ends.
    middles
        ``(edges,) int``: the cell in the middle of what is woven in the gap after each edge.
    strips
        ``(2, planes) int``: for each angular cell, the number of the domain's face that it
        lies on inside and outside.  Numbers ascend with the angle, but for the last half flat,
        which belongs to the first edge.
    ends
        ``(planes, 2) float``: angles at which the nodes outside are, below and above.
    nodes
        ``(planes, radii, heights, 3) float``.
    """

    domain: Domain
    planes: Floats
    edge_planes: Ints
    flats: Ints
    middles: Ints
    strips: Ints
    ends: Floats
    nodes: Floats

    @cached_property
    def edge_at(self) -> dict[int, int]:
        """For each plane through an edge, the edge's number."""
        return {int(plane): edge for edge, plane in enumerate(self.edge_planes)}

    @cached_property
    def firsts(self) -> Ints:
        """``(planes, 2) int``: the first index whose node on the outline below or above is this."""
        found = [np.unique(side, return_index=True, return_inverse=True) for side in self.ends.T]
        return np.stack([first[inverse] for _, first, inverse in found], axis=1)

    def longest_edges(self) -> Floats:
        """Length of the longest edge at the nodes of each plane, ``(planes,)``."""
        nodes = self.nodes
        ahead = np.linalg.norm(np.roll(nodes, -1, axis=0) - nodes, axis=-1).max(axis=(1, 2))
        across = np.linalg.norm(np.diff(nodes, axis=1), axis=-1).max(axis=(1, 2))
        rise = np.linalg.norm(np.diff(nodes, axis=2), axis=-1).max(axis=(1, 2))
        return np.asarray(np.maximum.reduce([ahead, np.roll(ahead, 1), across, rise]))

    def flat(self, side: int, edge: int) -> int:
        """Number of an edge's flat, inside (0) or outside (1)."""
        return int(self.strips[side, self.edge_planes[edge]])

    def lines(self, side: int, height: Floats) -> Floats:
        """Points of the lattice's lines inside (0) or outside (1), ``(planes, heights, 3)``."""
        low, high = (self.nodes[:, -side, end, None] for end in (0, -1))
        share = (height + 0.5)[:, None]
        return np.asarray(low * (1 - share) + high * share)


def make_lattice(
    spokes: Spokes,
    ring_ratio: float,
    cells: int,
    extra: int = 0,
    woven: Sequence[tuple[float, float]] | None = None,
) -> Lattice:
    """Fit a lattice to the domain of a joint.

    Parameters
    ----------
    spokes
        Its edges.
    ring_ratio
        Radius of the ring's centre line.
    cells
        Cells across the side; odd, and so is their number across each gap, so that no
        lattice edge lies on the half-turn axis of a regular joint's walls.
    extra
        Cells to add in each gap; even.
    woven
        Angles from each edge between which there are walls in the gap after it; by default all
        of it.  Beyond them a connector's arm is alone, and cells may be long.

    Raises
    ------
    GeometryError
        Two tubes would overlap where they leave the ring.
    """
    check_room(spokes, ring_ratio)
    gaps, least = spokes.gaps, float(spokes.gaps.min())
    half = flats_of(spokes.slopes, ring_ratio).half_angle
    rises = [_rise(flat, ring_ratio, least, cells) for flat in half.tolist()]
    leans = _leaning(spokes).tolist()
    angles: list[Floats] = []
    planes: list[int] = []
    middles: list[int] = []
    for edge, (azimuth, gap) in enumerate(zip(spokes.azimuths, gaps, strict=True)):
        (rise, _), (fall, _) = rises[edge], rises[(edge + 1) % len(rises)]
        planes.append(sum(map(len, angles)))
        low, high = rise[-1], gap - fall[-1]
        between = (low, high) if woven is None else woven[edge]
        least = LEANING if leans[edge] else 0
        span, middle = _between(low, high, between, ring_ratio, cells, extra, least)
        middles.append(planes[-1] + len(rise) - 1 + middle)
        angles.append(azimuth + np.concatenate([rise, span, (gap - fall)[:0:-1]]))
    theta, edge_planes = np.concatenate(angles), np.array(planes)
    flats = (edge_planes[:, None] + np.array([(-near, near) for _, near in rises])) % len(theta)
    off = np.abs((theta[:, None] - spokes.azimuths + np.pi) % (2 * np.pi) - np.pi)
    pads = np.array([rise[-1] for rise, _ in rises])
    corner = np.stack([(off > flat - 1e-9).all(axis=1) for flat in (pads, half)])
    at = np.array(middles)
    return _with_corners(spokes, ring_ratio, theta, edge_planes, flats, at, corner, cells)


def _leaning(spokes: Spokes) -> NDArray[np.bool_]:
    """The gaps, each by the edge before it, between flats of different slopes."""
    slopes = spokes.slopes
    return np.asarray(np.abs(np.roll(slopes, -1) - slopes) > _SAME)


def _rise(flat: float, ring_ratio: float, gap: float, cells: int) -> tuple[Floats, int]:
    """Angles from an edge to the end of its inner flat, and the index of that of the outer one."""
    pad = _pad_half_angle(ring_ratio, flat, gap, cells)
    near = max(1, round(flat * ring_ratio * cells))
    far = math.ceil((pad - flat) * ring_ratio * cells - 1e-9)
    rise = [np.linspace(0, flat, near + 1), np.linspace(flat, pad, far + 1)[1:]]
    return np.concatenate(rise), near


def _between(
    low: float,
    high: float,
    woven: tuple[float, float],
    ring_ratio: float,
    cells: int,
    extra: int,
    least: int,
) -> tuple[Floats, int]:
    """Angles of the planes between two flats, these not included, and which cell is in the middle.

    There are at least so many cells where walls are, an odd number.
    """
    start, end = max(low, woven[0]), min(high, woven[1])
    fine = max(least, math.ceil((end - start) * ring_ratio * cells) // 2 * 2 + 1 + extra)
    long = ring_ratio * min(cells, _LONG)
    before, after = (math.ceil(way * long - _SLIVER) for way in (start - low, high - end))
    stations = [low, start, end, high][before == 0 : 4 - (after == 0)]
    counts = [count for count in (before, fine, after) if count]
    angles = [
        np.linspace(a, b, count + 1)[1:]
        for (a, b), count in zip(itertools.pairwise(stations), counts, strict=True)
    ]
    return np.concatenate(angles)[:-1], before + fine // 2


def _pad_half_angle(ring_ratio: float, flat: float, gap: float, cells: int) -> float:
    """Half the angle of the inner flats: wide enough for a hole, where the gaps allow it."""
    wanted = math.asin(min(1.0, _PAD / (ring_ratio - 0.5)))
    angle = min(wanted, 0.4 * gap)
    return angle if (angle - flat) * ring_ratio * cells > _SLIVER else flat


def without_corners(lattice: Lattice, dropped: NDArray[np.bool_]) -> Lattice:
    """The lattice with some corners of its outlines taken away.

    Parameters
    ----------
    lattice
        The lattice.
    dropped
        ``(2, planes) bool``: which corners go, inside and outside; those at the ends of flats
        stay whatever it says.
    """
    corner = lattice.strips != np.roll(lattice.strips, 1, axis=1)
    kept = ~dropped
    spokes = lattice.domain.spokes
    for side in range(2):
        for edge in range(len(spokes)):
            flat = np.flatnonzero(lattice.strips[side] == lattice.flat(side, edge))
            kept[side, [*flat, *((flat + 1) % len(lattice.planes))]] = True
    return _with_corners(
        spokes,
        lattice.domain.ring_ratio,
        lattice.planes,
        lattice.edge_planes,
        lattice.flats,
        lattice.middles,
        corner & kept,
        lattice.nodes.shape[2] - 1,
    )


def _with_corners(
    spokes: Spokes,
    ring_ratio: float,
    planes: Floats,
    edge_planes: Ints,
    flats: Ints,
    middles: Ints,
    corner: NDArray[np.bool_],
    cells: int,
) -> Lattice:
    """Let the outside lean where it must, number the strips between corners, place the nodes."""
    ends, bends = np.repeat(planes[:, None], 2, axis=1), []
    for edge in np.flatnonzero(_leaning(spokes)).tolist():
        after, start = (edge + 1) % len(flats), flats[edge, 1]
        between, middle = slice(start, flats[after, 0] + 1), int(middles[edge] - start)
        mean = float(spokes.slopes[edge] + spokes.slopes[after]) / 2
        level = lean(ends[between], corner[1, between], middle)
        bends += [(planes[start + n], mean) for n in level]
    domain = Domain(
        spokes,
        ring_ratio,
        planes[corner[0]],
        ends[corner[1]],
        np.array(bends).reshape(-1, 2),
    )
    strips = np.cumsum(corner, axis=1, dtype=np.int64)
    strips[strips == strips[:, -1:]] = 0
    height = np.linspace(0, 1, cells + 1)
    # In plan as x + iy, as seen from each plane: nodes that do not lean are real there.
    low, high = (domain.outside(ends) * np.exp(1j * (ends - planes[:, None]))).T
    outside = low[:, None] + height * (high - low)[:, None]
    # Halfway up, cells across the ring are no longer than across its height.
    across = np.abs(low + high).max() / 2 - ring_ratio + 0.5
    share = np.linspace(0, 1, round(cells * float(across)) + 1)
    upright = outside
    if domain.leans:
        # Only the nodes on the outside lean: cells within stay as good as they can be.
        around = np.exp(1j * planes)[:, None] + 0 * height
        points = np.stack([around.real, around.imag, around.real * 0 + height - 0.5], axis=-1)
        upright = 1 - domain.beyond(points.reshape(-1, 3)).reshape(outside.shape) + 0j
    plan = (1 - share)[:, None] * domain.hole(planes)[:, None, None]
    plan = plan + share[:, None] * upright[:, None]
    plan[:, -1] = outside
    plan = plan * (np.cos(planes) + 1j * np.sin(planes))[:, None, None]
    nodes = np.stack([plan.real, plan.imag, np.broadcast_to(height - 0.5, plan.shape)], axis=-1)
    return Lattice(domain, planes, edge_planes, flats, middles, strips, ends, nodes)
