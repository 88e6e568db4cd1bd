"""Weaves and the site curves they make.

A site curve is the sinusoid that one connector grows around; see ``docs/geometry.md``,
step 2.  Lengths are in units of the side, angles in radians.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from functools import cached_property
from types import MappingProxyType

import numpy as np
from scipy.optimize import brentq
from scipy.spatial import cKDTree

from scadgen.errors import InputError
from scadgen.solid.affine import Floats

__all__ = ["BUILT_IN", "LIMITS", "SHAPE", "SiteCurve", "Weave", "any_joint", "built_in"]

#: What each weave parameter may be: (low, high).
LIMITS: Mapping[str, tuple[float, float]] = {
    "ring_ratio": (0.8, 10.0),
    "span": (0.1, 1.5),
    "amplitude": (0.0, 1.0),
    "bend": (0.0, 1.5),
    "periods": (0.25, 4.0),
    "stretch": (1.0, 20.0),
}

#: The parameters that every weave has, in the order of `Weave.shape`.
SHAPE = ("ring_ratio", "span", "amplitude", "bend", "periods")

#: What angles may be off by rounding, in degrees.
_ROUNDING = 1e-4

#: How gently an arm that followed the ring begins to weave, in sides.
_GENTLE = 0.25

#: Newton steps to the nearest point; quadratic from a sample's distance, so 1e-12 after 4.
_STEPS = 4


@dataclass(frozen=True, slots=True)
class Weave:
    """The shape of the site curves and of the ring they run in.

    Parameters
    ----------
    ring_ratio
        Distance of the ring's centre line from its axis, in sides.
    span
        How far a curve runs, as a share of the gap to the neighbouring edge.
    amplitude
        How far it rises and dips, in sides.
    bend
        Ring ratio over the radius of its arc in plan: 0 is straight, 1 follows the ring.
    periods
        Half waves on each side of the edge.
    stretch
        Longest part of a gap, in sides along the ring's centre line, that the arms of two
        neighbours weave in.  In a wider gap they follow the ring up to it, so that gaps of any
        width are woven alike.  Without one all of each gap is woven in.
    name
        What to call it.

    Raises
    ------
    InputError
        A parameter is not a finite number in its range.
    """

    ring_ratio: float
    span: float
    amplitude: float
    bend: float
    periods: float
    stretch: float | None = field(default=None, kw_only=True)
    name: str = field(default="custom", compare=False)

    def __post_init__(self) -> None:
        """Refuse what no curve can be made of."""
        for key, (low, high) in LIMITS.items():
            value = getattr(self, key)
            if key == "stretch" and value is None:
                continue
            number = isinstance(value, int | float) and not isinstance(value, bool)
            if not number or not low <= value <= high:
                msg = f"weave: {key} = {value!r}: must be a number from {low:g} to {high:g}"
                raise InputError(msg)

    @classmethod
    def from_dict(cls, entries: object, name: str) -> Weave:
        """Read a weave from a JSON object.

        Raises
        ------
        InputError
            It is not an object with just the weave's parameters.
        """
        known = {f.name for f in fields(cls)} - {"name"}
        wanted = known - {"stretch"}
        if not isinstance(entries, dict) or not wanted <= set(entries) - {"name"} <= known:
            msg = f"weave {name}: must be a JSON object with {', '.join(sorted(wanted))}"
            if isinstance(entries, dict) and (strange := set(entries) - known - {"name"}):
                msg += f", not {', '.join(sorted(map(str, strange)))}"
            raise InputError(msg)
        return cls(**{key: entries[key] for key in known & set(entries)}, name=name)

    @property
    def shape(self) -> tuple[float, float, float, float, float]:
        """The parameters without stretch and name, in the order above."""
        return self.ring_ratio, self.span, self.amplitude, self.bend, self.periods

    def as_dict(self) -> dict[str, float | str]:
        """Name and parameters, as JSON writes them; the stretch only where there is one."""
        return {key: value for key, value in asdict(self).items() if value is not None}


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
        self._arguments = (after, before, samples)
        self._angle = angle
        gaps = 2 * weave.ring_ratio * np.array([before, after])
        woven = np.minimum(gaps, gaps.max() if weave.stretch is None else weave.stretch)
        self._plain, self._reach = (gaps - woven) / 2, weave.span * woven
        self._rate = np.array(
            [_way_of(*pair) for pair in zip(self._reach, self._plain, strict=True)]
        )
        self._parameters = np.linspace(-1.0, 1.0, samples)
        self._spacing = 2.0 / (samples - 1)
        # Sides that differ meet at an angle, which no step towards a nearest point may cross.
        sides = np.stack([self._reach, self._plain])
        self._is_smooth = bool(np.allclose(sides[:, 0], sides[:, 1], rtol=0, atol=1e-9))
        if not self._is_smooth:
            self._parameters = np.union1d(self._parameters, [0.0])
        self._tree = cKDTree(self.points(self._parameters))

    def turned(self, angle: float) -> SiteCurve:
        """The curve turned about the ring's axis."""
        return SiteCurve(self.weave, self._angle + angle, *self._arguments)

    def points(self, u: Floats) -> Floats:
        """Points of the curve: ``u`` in [-1, 1], shape ``(...)``, gives ``(..., 3)``."""
        return self._derivatives(u)[0]

    def _derivatives(self, u: Floats) -> tuple[Floats, Floats, Floats]:
        """Position, first and second derivative by ``u``, each ``(..., 3)``.

        The woven arm at its own length, carried along the ring by what it starts late.
        """
        side = np.where(u >= 0, 1, 0)
        rate, way = self._rate[side][..., None], u * self._rate[side]
        length, slope, curve = _delayed(way, self._plain[side])
        place, first, second = self._woven(length, self._reach[side])
        radius = self.weave.ring_ratio
        turn = self._angle + (way - length) / radius
        if self._plain.any():
            slope, curve = slope[..., None], curve[..., None]
            spin, spun = (1 - slope) / radius, -curve / radius
            second = (
                spun * _across(place)
                - spin**2 * place * [1.0, 1.0, 0.0]
                + 2 * spin * slope * _across(first)
                + curve * first
                + slope**2 * second
            )
            first = spin * _across(place) + slope * first
        return _turned(place, turn), _turned(first, turn) * rate, _turned(second, turn) * rate**2

    def _woven(self, length: Floats, reach: Floats) -> tuple[Floats, Floats, Floats]:
        """An arm that weaves from its edge on: place and derivatives by its length in plan."""
        weave = self.weave
        bend = weave.bend / weave.ring_ratio
        turn = length * bend
        # (1 - cos t)/b and (sin t)/b written so that a straight curve (b = 0) is no special case.
        half = np.sinc(turn / (2 * np.pi))
        x = weave.ring_ratio - 0.5 * length * turn * half**2
        y = length * np.sinc(turn / np.pi)
        c, s = np.cos(turn), np.sin(turn)
        wave = math.pi * weave.periods / reach
        rise, fall = (
            weave.amplitude * np.sin(wave * length),
            weave.amplitude * np.cos(wave * length),
        )
        return (
            np.stack([x, y, rise], axis=-1),
            np.stack([-s, c, wave * fall], axis=-1),
            np.stack([-bend * c, -bend * s, -(wave**2) * rise], axis=-1),
        )

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
        u, low, high = self._around(points)
        for _ in range(_STEPS):
            place, first, second = self._derivatives(u)
            off = place - points
            slope = np.einsum("ij,ij->i", off, first)
            curvature = np.einsum("ij,ij->i", first, first) + np.einsum("ij,ij->i", off, second)
            low, high = np.where(slope < 0, u, low), np.where(slope > 0, u, high)
            convex = curvature > 0
            step = u - slope / np.where(convex, curvature, 1.0)
            u = np.clip(np.where(convex, step, 0.5 * (low + high)), low, high)
        away = points - self.points(u)
        distance = np.sqrt(np.einsum("ij,ij->i", away, away))
        return distance, away / np.maximum(distance, np.finfo(float).tiny)[:, None]

    def from_sample(self, points: Floats) -> Floats:
        """Distance from the nearest sample, ``(k,)``: above the curve's."""
        return np.asarray(self._tree.query(points)[0], dtype=np.float64)

    @cached_property
    def between_samples(self) -> float:
        """By how much a distance from the nearest sample may be above the curve's, in sides."""
        samples = np.asarray(self._tree.data)
        return float(np.linalg.norm(np.diff(samples, axis=0), axis=1).max())

    def _around(self, points: Floats) -> tuple[Floats, Floats, Floats]:
        """The sample nearest to each point, and between what its nearest point is sought."""
        _, nearest = self._tree.query(points)
        u = self._parameters[nearest]
        low, high = np.maximum(u - self._spacing, -1.0), np.minimum(u + self._spacing, 1.0)
        if not self._is_smooth:
            place, after, _ = self._derivatives(u)
            ahead = np.einsum("ij,ij->i", place - points, after) < 0
            low = np.where((u > 0) | ((u == 0) & ahead), np.maximum(low, 0.0), low)
            high = np.where((u < 0) | ((u == 0) & ~ahead), np.minimum(high, 0.0), high)
        return u, low, high


def _across(vector: Floats) -> Floats:
    """A vector's part in plan, turned by a quarter."""
    return np.stack([-vector[..., 1], vector[..., 0], np.zeros_like(vector[..., 0])], axis=-1)


def _turned(vector: Floats, angle: Floats) -> Floats:
    """A vector turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vector[..., 0], vector[..., 1]
    return np.stack([c * x - s * y, s * x + c * y, vector[..., 2]], axis=-1)


def _delayed(way: Floats, plain: Floats) -> tuple[Floats, Floats, Floats]:
    """A length that starts to grow after a plain one, smoothly and oddly, and its derivatives.

    It is ``way`` less ``plain`` further out, and nearly 0 within.
    """
    if not np.any(plain):
        return way, np.ones_like(way), np.zeros_like(way)
    after, before = (way + plain) / _GENTLE, (way - plain) / _GENTLE
    # log cosh, up to a constant that cancels.
    off = np.logaddexp(after, -after) - np.logaddexp(before, -before)
    after, before = np.tanh(after), np.tanh(before)
    return (
        way - _GENTLE / 2 * off,
        1 - (after - before) / 2,
        (after**2 - before**2) / (2 * _GENTLE),
    )


def _way_of(length: float, plain: float) -> float:
    """The way at which a delayed length is this."""
    if not plain:
        return length

    def short(way: float) -> float:
        return float(_delayed(np.asarray(way), np.asarray(plain))[0]) - length

    return float(brentq(short, 0.0, length + plain + _GENTLE))


#: The weaves of regular joints, by number of edges and key style: the tightest that a search
#: found with arms that print; see the table in ``docs/geometry.md``.
BUILT_IN: Mapping[str, Weave] = MappingProxyType(
    {
        name: Weave(*shape, name=name)
        for name, shape in {
            "2-fixed": (1.691, 1.057, 0.426, 0.749, 1.371),
            "2-loose": (1.691, 1.057, 0.426, 0.749, 1.371),
            "3-fixed": (1.79, 0.892, 0.365, 0.724, 1.413),
            "3-loose": (1.79, 0.892, 0.365, 0.724, 1.413),
            "4-fixed": (2.241, 0.858, 0.401, 0.609, 1.394),
            "4-loose": (2.241, 0.858, 0.401, 0.609, 1.394),
            "5-fixed": (2.323, 0.816, 0.347, 0.373, 1.499),
            "5-loose": (2.323, 0.816, 0.347, 0.373, 1.499),
            "6-fixed": (4.258, 0.741, 0.403, 0.52, 1.811),
            "6-loose": (4.258, 0.741, 0.403, 0.52, 1.811),
        }.items()
    }
)


#: Weaves of joints of any gaps, by the smallest of these in degrees: span, amplitude, the
#: curvature in plan that arms give up of the ring's, half waves, and the stretch.  Between two
#: rows all go evenly; see ``docs/geometry.md``, "Any joint".
_ANY = np.array(
    [
        [25.0, 0.765, 0.378, 0.061, 1.478, 4.044],
        [42.0, 0.781, 0.35, 0.12, 1.472, 4.249],
        [90.0, 0.781, 0.35, 0.12, 1.472, 4.249],
    ]
)


def built_in(valence: int, key: str) -> Weave:
    """The built-in weave of a regular joint.

    Raises
    ------
    InputError
        There is none.
    """
    name = f"{valence}-{key}"
    if name not in BUILT_IN:
        msg = f"weave {name}: none is built in; must be one of {', '.join(BUILT_IN)}"
        raise InputError(msg)
    return BUILT_IN[name]


def any_joint(least_gap: float) -> Weave:
    """The weave of joints whose gaps differ; see ``docs/geometry.md``, "Any joint".

    The ring is so wide that the smallest gap, or 90 degrees, is as long as the stretch that
    arms weave in.  So in one joint all walls are nearly the same, whatever their gaps: they lock
    alike, and open alike for a piece that goes up or down and turns a little.

    Parameters
    ----------
    least_gap
        Smallest angle between two neighbouring edges, in radians.

    Raises
    ------
    InputError
        It is smaller than such weaves are known for.
    """
    degrees = math.degrees(least_gap)
    if degrees < _ANY[0, 0] - _ROUNDING:
        msg = (
            f"edges {degrees:.4g} degrees apart: must be at least {_ANY[0, 0]:g}, "
            "or no ring is wide enough"
        )
        raise InputError(msg)
    rows = (np.interp(degrees, _ANY[:, 0], column) for column in _ANY[:, 1:].T)
    span, amplitude, curl, periods, stretch = (round(float(value), 3) for value in rows)
    ring = math.ceil(100 * stretch / min(least_gap, math.radians(_ANY[-1, 0])) - 1e-6) / 100
    bend = max(0.0, round(1 - curl * ring, 3))
    return Weave(ring, span, amplitude, bend, periods, stretch=stretch, name="any")
