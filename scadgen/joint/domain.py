"""The domain of a joint: what its connectors divide among them, a polyhedron.

It is the slab |z| <= 1/2 around the ring, less a prism, the ring's hole.  Towards each edge it has
a flat, on which the edge's tube stands square to the edge: with the slope b the plane

    r cos b - z sin b = R cos b + t

where r is the distance from the axis along the edge's azimuth, and t what makes a flat of slope 0
exactly one side wide.  Between two flats of one slope all faces are those of one pyramid, whose
apex is on the axis, or of a prism where the slope is 0; so the lines in which they meet lie in
planes through the axis.  Between flats whose slopes differ the slope goes evenly with the angle, to
their mean where the wall is; outlines above and below are joined by triangles there, for no other
faces would be plane.

Lengths are in units of the side, angles in radians.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from scadgen.errors import GeometryError
from scadgen.joint.spokes import Spokes
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Pose

__all__ = ["OUTSIDE", "Domain", "Flats", "check_room", "flats_of"]

#: What a sloped flat leaves beside its tube at least, in sides; less where the slope is so small
#: that it leaves less above and below.
_LEDGE = 0.02

#: What is so far outside a domain is no rounding, in sides.
OUTSIDE = 1e-9

#: Two tubes keep apart at any ring ratio that is more than this over their gap.
_WIDE = 4.0


class Flats(NamedTuple):
    """The flats of a joint's edges, at z = 0, ``(k,) float`` each.

    Parameters
    ----------
    corner
        Distance of their ends from the axis.
    half_width
        Half of how wide they are.
    """

    corner: Floats
    half_width: Floats

    @property
    def distance(self) -> Floats:
        """Distance of their middles from the axis, where tubes start."""
        return np.asarray(np.sqrt(self.corner**2 - self.half_width**2))

    @property
    def half_angle(self) -> Floats:
        """Angle from an edge to the ends of its flat."""
        return np.array([math.asin(share) for share in (self.half_width / self.corner).tolist()])


def flats_of(slopes: Floats, ring_ratio: float) -> Flats:
    """The flats of edges.

    Each is as wide as its tube needs at the height where it is narrowest.  Where all is level, its
    ends are exactly half a side from the ring's centre line.

    Parameters
    ----------
    slopes
        ``(k,) float``.
    ring_ratio
        Radius of the ring's centre line.
    """
    round_ = ring_ratio + 0.5
    level = math.sqrt(round_**2 - 0.25)
    distance = ring_ratio + (level - ring_ratio) / np.cos(slopes)
    above, ledge = _ledges(slopes)
    # It narrows upwards or downwards, as the faces of a pyramid do.
    lowest = (0.5 + above - ledge) * np.abs(np.sin(slopes))
    half_width = (0.5 + ledge) / (1 - lowest / distance)
    farther = np.hypot(distance, half_width) - math.hypot(level, 0.5)
    return Flats(np.where(slopes == 0, round_, round_ + farther), half_width)


def _ledges(slopes: Floats) -> tuple[Floats, Floats]:
    """What flats leave above and below tubes in their middles, and what they leave at least."""
    middle = (1 / np.cos(slopes) - 1) / 2
    return middle, np.minimum(middle, _LEDGE)


@dataclass(frozen=True, eq=False)
class Domain:
    """A joint's domain.

    Parameters
    ----------
    spokes
        The joint's edges.
    ring_ratio
        Radius of the ring's centre line.
    inner
        ``(n,) float``: azimuths of the upright lines in which faces of the hole meet, ascending.
    outer
        ``(m, 2) float``: azimuths of the lower and the upper ends of the lines in which outer faces
        meet, ascending.  Any two that follow each other are in one plane.
    bends
        ``(b, 2) float``: azimuths between flats of different slopes at which the outside has a
        given slope; from one to the next, and from flats to these, it goes evenly with the angle.
    """

    spokes: Spokes
    ring_ratio: float
    inner: Floats
    outer: Floats
    bends: Floats

    @cached_property
    def flats(self) -> Flats:
        """The flats of its edges."""
        return flats_of(self.spokes.slopes, self.ring_ratio)

    def tube_face(self, edge: int) -> Pose:
        """Where an edge's tube starts: the middle of its square, its x axis the way out.

        Its y axis goes counter-clockwise around the ring.

        It is as near to the ring's centre line as the flat has room for: so it goes on into the
        ring the farthest.
        """
        azimuth, slope = float(self.spokes.azimuths[edge]), float(self.spokes.slopes[edge])
        out = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
        along = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
        axis = np.array([0.0, 0.0, 1.0])
        c, s = math.cos(slope), math.sin(slope)
        axes = np.stack([c * out - s * axis, along, s * out + c * axis])
        middle, least = (float(ledge) for ledge in _ledges(np.array(slope)))
        down = math.copysign(middle - least, slope)
        return Pose.of(float(self.flats.distance[edge]) * out - down * axes[2], axes)

    def pad(self, edge: int) -> tuple[float, float]:
        """Distance of the hole's flat opposite an edge from the axis, and half its width."""
        after = float(((self.inner - self.spokes.azimuths[edge]) % (2 * np.pi)).min())
        radius = self.ring_ratio - 0.5
        return radius * math.cos(after), radius * math.sin(after)

    def hole(self, azimuths: Floats) -> Floats:
        """Distance of the hole's outline from the axis in these directions, ``(n,)``."""
        radius = np.full(len(self.inner), self.ring_ratio - 0.5)
        return _reach(azimuths, self.inner, radius)

    def outside(self, azimuths: Floats) -> Floats:
        """Distance of the outer outline from the axis.

        Parameters
        ----------
        azimuths
            ``(n, 2) float``: directions in which it is wanted at its lower and its upper end.

        Returns
        -------
        distance
            ``(n, 2) float``.
        """
        slope = self._slope(self.outer)
        flats = flats_of(slope, self.ring_ratio)
        radius = flats.corner * (1 + np.array([-0.5, 0.5]) * np.tan(slope) / flats.distance)
        ends = []
        for side in (0, 1):
            corners, first = np.unique(self.outer[:, side], return_index=True)
            ends.append(_reach(azimuths[:, side], corners, radius[first, side]))
        return np.stack(ends, axis=1)

    @cached_property
    def _lines(self) -> NDArray[np.complex128]:
        """The lower and the upper ends of the outer lines in plan as x + iy, ``(2, m)``."""
        return np.asarray((self.outside(self.outer) * np.exp(1j * self.outer)).T)

    @property
    def leans(self) -> bool:
        """Whether some of its outer faces meet at an edge that goes inwards."""
        return bool(len(self.bends))

    def beyond(self, points: Floats) -> Floats:
        """How far points ``(n, 3)`` are outside the outer faces at their height, in sides.

        Less than 0 inside; measured away from the axis.
        """
        lower, upper = self._lines
        corners = lower + (points[:, 2, None] + 0.5) * (upper - lower)
        plan = (points[:, 0] + 1j * points[:, 1])[:, None]
        # The side that is met in a point's direction begins behind it and ends ahead of it.
        ahead = (plan.conj() * corners).imag
        near = (plan.conj() * corners).real > 0
        side = ((ahead <= 0) & (np.roll(ahead, -1, axis=1) > 0) & near).argmax(axis=1)
        row = np.arange(len(points))
        start = corners[row, side]
        way = corners[row, (side + 1) % corners.shape[1]] - start
        plan = plan[:, 0]
        share = (way.conj() * start).imag / (way.conj() * plan).imag
        return np.asarray(np.abs(plan) * (1 - share))

    def _slope(self, azimuths: Floats) -> Floats:
        """Slope of the outside in some directions."""
        edges, half = self.spokes.azimuths, self.flats.half_angle
        at = np.concatenate([edges - half, edges + half, self.bends[:, 0]])
        slopes = np.concatenate([np.tile(self.spokes.slopes, 2), self.bends[:, 1]])
        return np.asarray(np.interp(azimuths, at, slopes, period=2 * np.pi))

    def volume(self) -> float:
        """Volume, from the lines in which its faces meet alone, in cubic sides."""
        lower, upper = self._lines
        hole = self.hole(self.inner) * np.exp(1j * self.inner)
        # Outlines at a height have corners that go evenly with it: their area is a quadratic.
        around = _area(lower) + 4 * _area((lower + upper) / 2) + _area(upper)
        return around / 6 - _area(hole)


def check_room(spokes: Spokes, ring_ratio: float) -> None:
    """Refuse a ring that is too small for its tubes.

    Raises
    ------
    GeometryError
        Two tubes would overlap where they leave the ring.
    """

    def room(ratio: float) -> Floats:
        half = flats_of(spokes.slopes, ratio).half_angle
        return spokes.gaps - half - np.roll(half, -1)

    left = room(ring_ratio)
    if (left <= 0).any():
        enough = ring_ratio + _WIDE / float(spokes.gaps.min())
        need = float(brentq(lambda ratio: room(ratio).min(), ring_ratio, enough))
        gap = math.degrees(float(spokes.gaps[left.argmin()]))
        msg = (
            f"ring_ratio = {ring_ratio:g}: two tubes overlap {gap:.4g} degrees apart; "
            f"it must be at least {need:.4g}"
        )
        raise GeometryError(msg)


def _reach(azimuths: Floats, corners: Floats, radii: Floats) -> Floats:
    """Distance of a polygon from the axis in some directions, by its corners there."""
    around = np.concatenate([corners[-1:] - 2 * np.pi, corners, corners[:1] + 2 * np.pi])
    far = np.concatenate([radii[-1:], radii, radii[:1]])
    after = np.searchsorted(around, azimuths, side="right")
    low, high, near, away = around[after - 1], around[after], far[after - 1], far[after]
    half, off = (high - low) / 2, azimuths - (high + low) / 2
    # Written so that nothing but the chord of a circle is left where its ends are equally far.
    tilt = (near - away) / (near + away) * np.sin(off) / np.tan(half)
    return np.asarray(near * (2 * away / (near + away)) * (np.cos(half) / (np.cos(off) + tilt)))


def _area(corners: NDArray[np.complex128]) -> float:
    """Area of a polygon, its corners as x + iy, by the shoelace formula."""
    return float((corners.conj() * np.roll(corners, -1)).imag.sum()) / 2
