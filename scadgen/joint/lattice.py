"""The domain of a joint, and the lattice that fits it.

The domain (``docs/geometry.md``, step 1) is a prism: in plan, a polygon around the ring's
outside less a polygon around its hole; from z = -1/2 to 1/2.  Towards each edge both
polygons have one flat side.  The outer flat is exactly one side wide, so a tube starts on
it as an exact square; the inner flat opposite is where a channel along the edge comes out.

The lattice's axes, in this order a left-handed frame, are the angle, the share of the way
from the inner to the outer polygon, and the height.  It has planes of constant angle, of
constant share and of constant height.  The domain's faces are unions of its faces.
Lengths are in units of the side.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scadgen.errors import GeometryError, InputError
from scadgen.solid.affine import Floats, Ints

__all__ = ["Lattice", "directions_and_gaps", "make_lattice", "without_corners"]

#: Half the width of the inner flats where there is room, in sides.
_PAD = 0.36

#: Cells a side where there are no walls.
_LONG = 2

#: A plane closer to the next than this, in cells, is left out.
_SLIVER = 0.5


@dataclass(frozen=True, eq=False)
class Lattice:
    """Nodes of the lattice and how its cells lie on the domain's faces.

    Parameters
    ----------
    ring_ratio
        Radius of the ring's centre line.
    edges
        Directions of the edges, ascending, in [0, 2 pi).
    planes
        Angles of the lattice planes, ascending; the cells after the last close the ring.
    edge_planes
        For each edge, the index of the plane through it.
    strips
        ``(2, planes) int``: for each angular cell, the number of the domain's face that it
        lies on inside and outside.  Numbers ascend with the angle, but for the last half flat,
        which belongs to the first edge.
    nodes
        ``(planes, radii, heights, 3) float``.
    """

    ring_ratio: float
    edges: Floats
    planes: Floats
    edge_planes: Ints
    strips: Ints
    nodes: Floats

    @cached_property
    def edge_at(self) -> dict[int, int]:
        """For each plane through an edge, the edge's number."""
        return {int(plane): edge for edge, plane in enumerate(self.edge_planes)}

    @property
    def tube_start(self) -> float:
        """Distance X0 of the outer flats from the axis, where the tubes start."""
        return math.sqrt((self.ring_ratio + 0.5) ** 2 - 0.25)

    @cached_property
    def _pad_half_angle(self) -> float:
        first = int(self.edge_planes[0])
        inside = self.strips[0, first:] == self.strips[0, first]
        return float(self.planes[first + np.argmin(inside)] - self.planes[first])

    @property
    def pad(self) -> float:
        """Distance of the inner flats from the axis."""
        return (self.ring_ratio - 0.5) * math.cos(self._pad_half_angle)

    @property
    def pad_half_width(self) -> float:
        """Half the width of the inner flats."""
        return (self.ring_ratio - 0.5) * math.sin(self._pad_half_angle)

    def longest_edges(self) -> Floats:
        """Length of the longest edge at the nodes of each plane, ``(planes,)``."""
        rim = self.nodes[:, -1, 0]
        ahead = np.linalg.norm(np.roll(rim, -1, axis=0) - rim, axis=1)
        across = np.linalg.norm(self.nodes[:, 1, 0] - self.nodes[:, 0, 0], axis=1)
        rise = self.nodes[0, 0, 1, 2] - self.nodes[0, 0, 0, 2]
        return np.asarray(np.maximum.reduce([ahead, np.roll(ahead, 1), across]).clip(min=rise))

    def flat(self, side: int, edge: int) -> int:
        """Number of an edge's flat, inside (0) or outside (1)."""
        return int(self.strips[side, self.edge_planes[edge]])

    def volume(self) -> float:
        """Volume of the domain, from its two outlines alone, in cubic sides."""
        area = 0.0
        for strips, sign, radius in zip(
            self.strips, (-1, 1), (self.ring_ratio - 0.5, self.ring_ratio + 0.5), strict=True
        ):
            angles = self.planes[strips != np.roll(strips, 1)]
            turns = np.diff(np.append(angles, angles[0] + 2 * np.pi))
            area += sign * 0.5 * radius**2 * float(np.sin(turns).sum())
        return area


def directions_and_gaps(edges: Sequence[float]) -> tuple[Floats, Floats]:
    """Directions as an array, and the angle from each to the next.

    Raises
    ------
    InputError
        Fewer than two edges, or directions that do not ascend.
    """
    directions = np.asarray(edges, dtype=float)
    gaps = np.diff(np.append(directions, directions[:1] + 2 * np.pi))
    if len(directions) < 2 or not (gaps > 0).all() or directions[0] < 0:
        msg = f"edges {list(edges)}: must be two or more ascending angles in [0, 2 pi)"
        raise InputError(msg)
    return directions, gaps


def make_lattice(
    edges: Sequence[float],
    ring_ratio: float,
    cells: int,
    extra: int = 0,
    woven: Sequence[tuple[float, float]] | None = None,
) -> Lattice:
    """Fit a lattice to the domain of a joint.

    Parameters
    ----------
    edges
        Directions of the edges, ascending, in [0, 2 pi), at least two.
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
    InputError
        Fewer than two edges, or directions that do not ascend.
    GeometryError
        Two tubes would overlap where they leave the ring.
    """
    directions, gaps = directions_and_gaps(edges)
    flat = math.asin(0.5 / (ring_ratio + 0.5))
    if (gaps <= 2 * flat).any():
        need = 0.5 / math.sin(gaps.min() / 2) - 0.5
        msg = (
            f"ring_ratio = {ring_ratio:g}: two tubes overlap {math.degrees(gaps.min()):.4g} "
            f"degrees apart; it must be at least {need:.4g}"
        )
        raise GeometryError(msg)
    pad = _pad_half_angle(ring_ratio, flat, float(gaps.min()), cells)
    near = max(1, round(flat * ring_ratio * cells))
    far = math.ceil((pad - flat) * ring_ratio * cells - 1e-9)
    rise = np.concatenate([np.linspace(0, flat, near + 1), np.linspace(flat, pad, far + 1)[1:]])
    angles: list[Floats] = []
    planes: list[int] = []
    for number, (edge, gap) in enumerate(zip(directions, gaps, strict=True)):
        planes.append(sum(map(len, angles)))
        between = (pad, gap - pad) if woven is None else woven[number]
        span = _between(pad, gap - pad, between, ring_ratio, cells, extra)
        angles.append(edge + np.concatenate([rise, span, (gap - rise)[:0:-1]]))
    theta = np.concatenate(angles)
    off = np.abs((theta[:, None] - directions + np.pi) % (2 * np.pi) - np.pi).min(axis=1)
    corner = np.stack([off > pad - 1e-9, off > flat - 1e-9])
    return _with_corners(ring_ratio, directions, theta, np.array(planes), corner, cells)


def _between(
    low: float, high: float, woven: tuple[float, float], ring_ratio: float, cells: int, extra: int
) -> Floats:
    """Angles of the planes between two flats, these not included."""
    start, end = max(low, woven[0]), min(high, woven[1])
    fine = math.ceil((end - start) * ring_ratio * cells) // 2 * 2 + 1 + extra
    long = ring_ratio * min(cells, _LONG)
    before, after = (math.ceil(way * long - _SLIVER) for way in (start - low, high - end))
    stations = [low, start, end, high][before == 0 : 4 - (after == 0)]
    counts = [count for count in (before, fine, after) if count]
    return np.concatenate(
        [
            np.linspace(a, b, count + 1)[1:]
            for (a, b), count in zip(itertools.pairwise(stations), counts, strict=True)
        ]
    )[:-1]


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
    for side in range(2):
        for edge in range(len(lattice.edges)):
            flat = np.flatnonzero(lattice.strips[side] == lattice.flat(side, edge))
            kept[side, [*flat, *((flat + 1) % len(lattice.planes))]] = True
    return _with_corners(
        lattice.ring_ratio,
        lattice.edges,
        lattice.planes,
        lattice.edge_planes,
        corner & kept,
        lattice.nodes.shape[1] - 1,
    )


def _with_corners(
    ring_ratio: float,
    edges: Floats,
    planes: Floats,
    edge_planes: Ints,
    corner: NDArray[np.bool_],
    cells: int,
) -> Lattice:
    """Number the strips between corners, and place the nodes."""
    strips = np.cumsum(corner, axis=1, dtype=np.int64)
    strips[strips == strips[:, -1:]] = 0
    radii = [
        radius * _chord(planes, planes[corner[side]])
        for side, radius in enumerate((ring_ratio - 0.5, ring_ratio + 0.5))
    ]
    share = np.linspace(0, 1, cells + 1)
    radius = (1 - share) * radii[0][:, None] + share * radii[1][:, None]
    nodes = np.empty((len(planes), cells + 1, cells + 1, 3))
    nodes[..., 0] = (radius * np.cos(planes)[:, None])[..., None]
    nodes[..., 1] = (radius * np.sin(planes)[:, None])[..., None]
    nodes[..., 2] = np.linspace(-0.5, 0.5, cells + 1)
    return Lattice(ring_ratio, edges, planes, edge_planes, strips, nodes)


def _chord(angles: Floats, corners: Floats) -> Floats:
    """Distance of the polygon with these corners on the unit circle, in each direction."""
    around = np.concatenate([corners[-1:] - 2 * np.pi, corners, corners[:1] + 2 * np.pi])
    after = np.searchsorted(around, angles, side="right")
    low, high = around[after - 1], around[after]
    return np.asarray(np.cos((high - low) / 2) / np.cos(angles - (high + low) / 2))
