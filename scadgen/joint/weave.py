"""Weaves and the site curves they make.

A site curve is the sinusoid that one connector grows around; see ``docs/geometry.md``,
step 2.  Lengths are in units of the side, angles in radians.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from types import MappingProxyType

import numpy as np
from scipy.spatial import cKDTree

from scadgen.errors import InputError
from scadgen.solid.affine import Floats

__all__ = ["BUILT_IN", "LIMITS", "SiteCurve", "Weave", "built_in"]

#: What each weave parameter may be: (low, high).
LIMITS: Mapping[str, tuple[float, float]] = {
    "ring_ratio": (0.8, 8.0),
    "span": (0.1, 1.5),
    "amplitude": (0.0, 1.0),
    "bend": (0.0, 1.5),
    "periods": (0.25, 4.0),
}

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
    name: str = field(default="custom", compare=False)

    def __post_init__(self) -> None:
        """Refuse what no curve can be made of."""
        for key, (low, high) in LIMITS.items():
            value = getattr(self, key)
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
        wanted = {f.name for f in fields(cls)} - {"name"}
        if not isinstance(entries, dict) or set(entries) - {"name"} != wanted:
            msg = f"weave {name}: must be a JSON object with {', '.join(sorted(wanted))}"
            raise InputError(msg)
        return cls(**{key: entries[key] for key in wanted}, name=name)

    @property
    def shape(self) -> tuple[float, float, float, float, float]:
        """The parameters without the name, in the order above."""
        return self.ring_ratio, self.span, self.amplitude, self.bend, self.periods

    def as_dict(self) -> dict[str, float | str]:
        """Name and parameters, as JSON writes them."""
        return asdict(self)


class SiteCurve:
    """One connector's site: a sinusoid on an arc, up on one side and down on the other.

    Parameters
    ----------
    weave
        Its shape.
    angle
        Direction of its edge.
    gap_after, gap_before
        Angle to the next edge counter-clockwise and clockwise.
    samples
        Points from which nearest points are sought; they decide which of several
        nearly equal distances is looked at, not how exact it is.
    """

    def __init__(
        self, weave: Weave, angle: float, gap_after: float, gap_before: float, samples: int
    ) -> None:
        self.weave = weave
        self._arguments = (gap_after, gap_before, samples)
        self._angle = angle
        self._turn = (math.cos(angle), math.sin(angle))
        self._reach = (
            gap_before * weave.span * weave.ring_ratio,
            gap_after * weave.span * weave.ring_ratio,
        )
        self._parameters = np.linspace(-1.0, 1.0, samples)
        self._tree = cKDTree(self.points(self._parameters))

    def turned(self, angle: float) -> SiteCurve:
        """The curve turned about the ring's axis."""
        gap_after, gap_before, samples = self._arguments
        return SiteCurve(self.weave, self._angle + angle, gap_after, gap_before, samples)

    def points(self, u: Floats) -> Floats:
        """Points of the curve: ``u`` in [-1, 1], shape ``(...)``, gives ``(..., 3)``."""
        return self._derivatives(u)[0]

    def _derivatives(self, u: Floats) -> tuple[Floats, Floats, Floats]:
        """Position, first and second derivative by ``u``, each ``(..., 3)``."""
        weave = self.weave
        rate = np.where(u >= 0, self._reach[1], self._reach[0])
        length = u * rate
        bend = weave.bend / weave.ring_ratio
        turn = length * bend
        # (1 - cos t)/b and (sin t)/b written so that a straight curve (b = 0) is no special case.
        half = np.sinc(turn / (2 * np.pi))
        x = weave.ring_ratio - 0.5 * length * turn * half**2
        y = length * np.sinc(turn / np.pi)
        wave = math.pi * weave.periods
        lift = weave.amplitude
        place = (x, y, lift * np.sin(wave * u))
        first = (-rate * np.sin(turn), rate * np.cos(turn), lift * wave * np.cos(wave * u))
        pull = rate**2 * bend
        second = (
            -pull * np.cos(turn),
            -pull * np.sin(turn),
            -lift * wave**2 * np.sin(wave * u),
        )
        return self._turned(place), self._turned(first), self._turned(second)

    def _turned(self, vector: tuple[Floats, Floats, Floats]) -> Floats:
        x, y, z = vector
        c, s = self._turn
        return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)

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
        _, nearest = self._tree.query(points)
        u = self._parameters[nearest]
        spacing = self._parameters[1] - self._parameters[0]
        low, high = np.maximum(u - spacing, -1.0), np.minimum(u + spacing, 1.0)
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
