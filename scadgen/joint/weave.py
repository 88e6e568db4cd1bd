"""Weaves: the shapes of site curves, those built in and the one for any joint.

Lengths are in units of the side, angles in radians; see ``docs/geometry.md``, step 2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from types import MappingProxyType

import numpy as np

from scadgen.errors import InputError

__all__ = ["BUILT_IN", "LIMITS", "SHAPE", "SLOPED_ROOM", "Weave", "any_joint", "built_in"]

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

#: How much farther from edges that slope walls are.
SLOPED_ROOM = 1.1


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
        said = {"name", "comment"}
        wanted = known - {"stretch"}
        if not isinstance(entries, dict) or not wanted <= set(entries) - said <= known:
            msg = f"weave {name}: must be a JSON object with {', '.join(sorted(wanted))}"
            if isinstance(entries, dict) and (strange := set(entries) - known - said):
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


def any_joint(least_gap: float, *, sloped: bool = False) -> Weave:
    """The weave of joints whose gaps differ; see ``docs/geometry.md``, "Any joint".

    The ring is so wide that the smallest gap, or 90 degrees, is as long as the stretch that
    arms weave in.  Its ratio is rounded up to a hundredth, and the stretch grows with it, so that
    such a gap is woven whole.  So in one joint all walls are nearly the same, whatever their gaps:
    they lock alike, and open alike for a piece that goes up or down and turns a little.

    Parameters
    ----------
    least_gap
        Smallest angle between two neighbouring edges, in radians.
    sloped
        Whether edges slope: their tubes stand farther out, so that neighbours' arms have to end
        farther from them.

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
    woven = min(least_gap, math.radians(_ANY[-1, 0]))
    room = SLOPED_ROOM if sloped else 1.0
    ring = math.ceil(100 * room * stretch / woven - 1e-6) / 100
    bend = max(0.0, round(1 - curl * ring, 3))
    return Weave(ring, span, amplitude, bend, periods, stretch=ring * woven / room, name="any")
