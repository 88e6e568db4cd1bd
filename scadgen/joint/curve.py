"""Site curves: the sinusoids that connectors grow around, and how far points are from them.

See ``docs/geometry.md``, step 2.  Lengths are in units of the side, angles in radians.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from scadgen.joint.arms import Arms, Vectors, derivatives, way_of
from scadgen.joint.site import Rough, slopes
from scadgen.joint.weave import Weave
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.vectors import cross

__all__ = ["SiteCurve"]

#: Decimals of lengths along which arms follow the ring, in sides: rounding is no such length.
_DECIMALS = 12

#: Newton steps to the nearest point; quadratic from a sample's distance, so 1e-12 after 4, where
#: the last one measures.
_STEPS = 5

#: A step smaller than this, in a curve's parameter, is not taken: by its square distances change.
_STILL = 1e-8

#: Points whose samples are compared at once: what that takes stays in a processor's cache.
_CHUNK = 2048

#: Between two samples a curve is looked at so many times for how it bends, and may bend by this
#: much more than is found.
_FINER, _SHARPER = 4, 1.25


class SiteCurve:
    """One connector's site: a sinusoid on an arc, up on one side and down on the other.

    Parameters
    ----------
    weave
        Its shape.
    angle
        Direction of its edge.
    after, before
        Angle to the wall counter-clockwise and clockwise; half a gap where it is in the middle.
    samples
        Points from which nearest points are sought; they decide which of several
        nearly equal distances is looked at, not how exact it is.
    """

    def __init__(
        self, weave: Weave, angle: float, after: float, before: float, samples: int
    ) -> None:
        self.weave = weave
        gaps = 2 * weave.ring_ratio * np.array([before, after])
        woven = np.minimum(gaps, gaps.max() if weave.stretch is None else weave.stretch)
        plain, reach = ((gaps - woven) / 2).round(_DECIMALS), weave.span * woven
        rate = np.array([way_of(*pair) for pair in zip(reach, plain, strict=True)])
        self.arms = Arms(np.array(angle), plain, reach, rate)
        # Sides that differ meet at an angle, which no step towards a nearest point may cross.
        self.is_smooth = bool(np.allclose([reach[0], plain[0]], [reach[1], plain[1]], 0, 1e-9))
        if not self.is_smooth:
            samples |= 1
        self.spacing = 2.0 / (samples - 1)
        self._parameters = np.linspace(-1.0, 1.0, samples)
        places = self.points(self._parameters)
        self._twice, self._squares = -2 * places.T, (places**2).sum(axis=1)

    @property
    def name(self) -> str:
        """What a message calls what it was made from."""
        return f"weave {self.weave.name}"

    @property
    def turn(self) -> Floats:
        """What turns rows ``(..., 3)`` from where its edge is +x to where it is, ``(3, 3)``."""
        along, across = np.cos(self.arms.angle), np.sin(self.arms.angle)
        return np.array([[along, across, 0.0], [-across, along, 0.0], [0.0, 0.0, 1.0]])

    def points(self, u: Floats) -> Floats:
        """Points of the curve: ``u`` in [-1, 1], shape ``(...)``, gives ``(..., 3)``."""
        one = _Curves((self,))
        return one.derivatives(np.zeros(u.shape, dtype=np.intp), u)[0].stacked()

    def distance(self, points: Floats) -> tuple[Floats, Floats]:
        """Distance from the curve, and its gradient.

        Parameters
        ----------
        points
            ``(k, 3) float``, in sides.

        Returns
        -------
        distance
            ``(k,) float``.
        gradient
            ``(k, 3) float``, unit vectors away from the nearest point.
        """
        return slopes([self], points, np.zeros(len(points), dtype=np.intp))

    def together(self, sites: Sequence[SiteCurve]) -> _Curves:
        """Site curves of one weave as one."""
        return _Curves(sites)

    def from_sample(self, points: Floats) -> tuple[Floats, Floats]:
        """Distance from the nearest sample, ``(k,)``, no less than the curve's, and its parameter.

        What is compared is squared distances less those of the points from the origin.
        """
        sample, square = np.empty(len(points), dtype=np.intp), np.einsum("ki,ki->k", points, points)
        for start in range(0, len(points), _CHUNK):
            some = slice(start, start + _CHUNK)
            far = points[some] @ self._twice
            far += self._squares
            sample[some] = nearest = far.argmin(axis=1)
            square[some] += far[np.arange(len(far)), nearest]
        return np.sqrt(np.maximum(square, 0.0)), self._parameters[sample]

    def at_least(self, distance: Floats) -> Floats:
        """What points are from the curve at least if they are so far from the nearest sample.

        Between the nearest point f of the curve and the sample s nearest to that lies an arc of at
        most l, half of that between two samples.  The way from a point p to f is square to the
        curve there, so that s - f is off by no more than k l^2 / 2 along it, where the curve bends
        by k at most: |p - s|^2 <= |p - f|^2 + k l^2 |p - f| + l^2.
        """
        arc, bend = self._between_samples
        return np.asarray(np.sqrt(np.maximum(distance**2 - arc**2 * (1 + bend * distance), 0.0)))

    @cached_property
    def _between_samples(self) -> tuple[float, float]:
        """Half the longest arc between two samples, in sides, and how much it bends at most."""
        u = np.linspace(-1.0, 1.0, (len(self._parameters) - 1) * _FINER + 1)
        place, first, second = _Curves((self,)).derivatives(np.zeros(len(u), dtype=np.intp), u)
        ways = np.linalg.norm(np.diff(place.stacked(), axis=0), axis=1)
        arc = float(ways.reshape(-1, _FINER).sum(axis=1).max()) / 2
        across = cross(first.stacked(), second.stacked())
        bend = np.linalg.norm(across, axis=1) / first.dot(first) ** 1.5
        return _SHARPER * arc, _SHARPER * float(bend.max())


class _Curves:
    """Site curves of one weave, for points each of which has one of them."""

    def __init__(self, curves: Sequence[SiteCurve]) -> None:
        self._curves = curves
        self._weave = curves[0].weave
        arms = zip(*(curve.arms for curve in curves), strict=True)
        self._arms = Arms(*(np.stack(each) for each in arms))
        self._spacing = np.array([curve.spacing for curve in curves])
        self._bent = np.array([not curve.is_smooth for curve in curves])

    @cached_property
    def _corners(self) -> tuple[Vectors, Vectors]:
        """Where their arms meet, and which way those after it go on."""
        count = len(self._spacing)
        return self.derivatives(np.arange(count), np.zeros(count))[:2]

    def derivatives(self, which: Ints, u: Floats) -> tuple[Vectors, Vectors, Vectors]:
        """Position, first and second derivative by ``u``."""
        return derivatives(self._weave, self._arms.of(which, (u >= 0).astype(np.intp)), u)

    def roughly(self, which: Ints, points: Floats) -> Rough:
        """Bounds of distances by the curves' samples, and the parameters of the nearest."""
        rough = Rough(*np.empty((3, len(points))))
        for number, curve in enumerate(self._curves):
            mine = np.flatnonzero(which == number)
            most, start = curve.from_sample(points.take(mine, axis=0))
            rough.least[mine], rough.most[mine], rough.start[mine] = (
                curve.at_least(most),
                most,
                start,
            )
        return rough

    def away(self, which: Ints, points: Floats, start: Floats) -> Floats:
        """The way to points from the nearest ones of their curves, near their samples."""
        target = Vectors(points[:, 0] + 1j * points[:, 1], points[:, 2])
        u, (low, high) = start.copy(), self._around(which, target, start)
        away = Vectors(np.empty(len(u), dtype=np.complex128), np.empty(len(u)))
        left = np.arange(len(u))
        for _ in range(_STEPS):
            place, first, second = self.derivatives(which[left], u[left])
            off = place.less(target.rows(left))
            away.plan[left], away.height[left] = -off.plan, -off.height
            slope, curvature = off.dot(first), first.dot(first) + off.dot(second)
            low[left] = np.where(slope < 0, u[left], low[left])
            high[left] = np.where(slope > 0, u[left], high[left])
            convex = curvature > 0
            step = u[left] - slope / np.where(convex, curvature, 1.0)
            halved = 0.5 * (low[left] + high[left])
            found = np.clip(np.where(convex, step, halved), low[left], high[left])
            moving = np.abs(found - u[left]) > _STILL
            u[left] = found
            left = left[moving]
            if not len(left):
                break
        return away.stacked()

    def _around(self, which: Ints, points: Vectors, u: Floats) -> tuple[Floats, Floats]:
        """Between what the nearest points are sought."""
        spacing = self._spacing[which]
        low, high = np.maximum(u - spacing, -1.0), np.minimum(u + spacing, 1.0)
        bent = self._bent[which]
        if bent.any():
            start, way = (each.rows(which) for each in self._corners)
            ahead = (u > 0) | ((u == 0) & (start.less(points).dot(way) < 0))
            low = np.where(bent & ahead, np.maximum(low, 0.0), low)
            high = np.where(bent & ~ahead, np.minimum(high, 0.0), high)
        return low, high
