"""All frames that have a name, with the options of each."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from types import MappingProxyType
from typing import Any

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.plane.periodic import Tiling
from scadgen.plane.simple import ladder, ring, strip
from scadgen.plane.tilings import laves, rectangular, rhombic, uniform

__all__ = ["ALIASES", "NAMES", "OPTIONS", "Family", "NamedTiling", "named"]

#: What each option means; a family takes some of them.
OPTIONS: Mapping[str, str] = MappingProxyType(
    {
        "angle": "angle of a rhomb at its lower left, in degrees",
        "bay_length": "distance of the rungs, in mm",
        "bays": "rectangles in a row",
        "columns": "cells across",
        "edge_length": "length of the shortest edges, in mm",
        "height": "height of a rectangle, in mm",
        "outline": "corners of a polygon to fill instead of rows and columns, in mm",
        "radius": "radius of a circle to fill instead of rows and columns, in mm",
        "rows": "cells up",
        "sides": "sides of the polygon",
        "triangles": "triangles in a row",
        "width": "width of a rectangle or ladder, in mm",
    }
)

_AREA = ("rows", "columns", "radius", "outline")


@dataclass(frozen=True, slots=True)
class NamedTiling:
    """A tiling by its name.

    Parameters
    ----------
    name
        One of `NAMES` whose frames are blocks of cells.
    options
        Options of the family that say how large it is.
    """

    name: str
    options: Mapping[str, float] = field(default_factory=dict)

    def made(self) -> Tiling:
        """The tiling.

        Raises
        ------
        InputError
            A name or option that does not exist, or what the family refuses.
        """
        made = _family(self.name, self.options).make(**self.options)
        if not isinstance(made, Tiling):
            msg = f"frame {self.name}: has no cells in rows and columns"
            raise InputError(msg)
        return replace(made, name=self.name)

    @property
    def regular(self) -> bool:
        """Whether its kits have the weave of regular joints, and keys in rows."""
        return _family(self.name, ()).regular


@dataclass(frozen=True, slots=True)
class Family:
    """Frames of one name.

    Parameters
    ----------
    make
        Makes one, or the tiling that such frames are blocks of; takes those of `options` that
        say how large it is by name, all of them optional.
    options
        Names of its options, keys of `OPTIONS`.
    text
        What it is, in a few words.
    regular
        Whether its kits have the weave of regular joints, and keys in rows.
    """

    make: Callable[..., Frame | Tiling]
    options: tuple[str, ...]
    text: str
    regular: bool = False

    @property
    def defaults(self) -> dict[str, object]:
        """What each option is where nothing is said; None where that depends on the others."""
        known = inspect.signature(self.make).parameters
        return {n: known[n].default if n in known else None for n in self.options}


def _uniform(configuration: str, text: str, *, regular: bool = False) -> Family:
    return Family(partial(uniform, configuration), ("edge_length", *_AREA), text, regular)


def _laves(configuration: str, text: str) -> Family:
    return Family(partial(laves, configuration), ("edge_length", *_AREA), text)


#: The families by name: common ones first, then uniform tilings, then duals.
NAMES: Mapping[str, Family] = MappingProxyType(
    {
        "hexagonal": _uniform("6.6.6", "regular hexagons", regular=True),
        "square": _uniform("4.4.4.4", "squares", regular=True),
        "triangular": _uniform("3.3.3.3.3.3", "equilateral triangles"),
        "rectangular": Family(rectangular, ("width", "height", *_AREA), "rectangles"),
        "rhombic": Family(rhombic, ("angle", "edge_length", *_AREA), "rhombs in leaning rows"),
        "ring": Family(ring, ("sides", "edge_length"), "one regular polygon"),
        "ladder": Family(ladder, ("bays", "width", "bay_length"), "two rails with rungs"),
        "strip": Family(strip, ("triangles", "edge_length"), "triangles in a row"),
        "3.6.3.6": _uniform("3.6.3.6", "triangles and hexagons, in straight lines"),
        "3.4.6.4": _uniform("3.4.6.4", "triangles, squares and hexagons"),
        "4.8.8": _uniform("4.8.8", "squares and octagons"),
        "3.3.4.3.4": _uniform("3.3.4.3.4", "squares, each between four triangles"),
        "3.3.3.4.4": _uniform("3.3.3.4.4", "rows of squares and of triangles"),
        "3.3.3.3.6": _uniform(
            "3.3.3.3.6", "hexagons, each between triangles; differs from its mirror image"
        ),
        "3.12.12": _uniform("3.12.12", "triangles and dodecagons"),
        "4.6.12": _uniform("4.6.12", "squares, hexagons and dodecagons"),
        "V3.6.3.6": _laves("3.6.3.6", "rhombs of 60 degrees"),
        "V3.4.6.4": _laves("3.4.6.4", "kites"),
        "V4.8.8": _laves("4.8.8", "squares with both diagonals"),
        "V3.3.4.3.4": _laves("3.3.4.3.4", "pentagons in fours"),
        "V3.3.3.4.4": _laves("3.3.3.4.4", "pentagons in rows"),
        "V3.12.12": _laves("3.12.12", "triangles cut in three"),
    }
)

#: Other names of families.
ALIASES: Mapping[str, str] = MappingProxyType(
    {
        "6.6.6": "hexagonal",
        "4.4.4.4": "square",
        "3.3.3.3.3.3": "triangular",
        "kagome": "3.6.3.6",
        "trihexagonal": "3.6.3.6",
        "rhombitrihexagonal": "3.4.6.4",
        "truncated-square": "4.8.8",
        "snub-square": "3.3.4.3.4",
        "elongated-triangular": "3.3.3.4.4",
        "snub-hexagonal": "3.3.3.3.6",
        "truncated-hexagonal": "3.12.12",
        "truncated-trihexagonal": "4.6.12",
        "rhombille": "V3.6.3.6",
        "deltoidal": "V3.4.6.4",
        "tetrakis": "V4.8.8",
        "cairo": "V3.3.4.3.4",
        "prismatic": "V3.3.3.4.4",
        "triakis": "V3.12.12",
        "V4.4.4.4": "square",
        "V6.6.6": "triangular",
        "V3.3.3.3.3.3": "hexagonal",
    }
)


def named(name: str, **options: Any) -> Frame:  # noqa: ANN401 -- each family has its own
    """The frame of this name.

    Parameters
    ----------
    name
        One of `NAMES` or `ALIASES`.
    **options
        Options of the family.

    Raises
    ------
    InputError
        A name or option that is not one of those, or what the family refuses.
    """
    family = _family(name, options)
    area = {n: options.pop(n) for n in _AREA if n in options}
    made = family.make(**options)
    frame = made.fill(**area) if isinstance(made, Tiling) else made
    return replace(frame, name=ALIASES.get(name, name))


def _family(name: str, options: Iterable[str]) -> Family:
    """The family of this name, which has these options."""
    family = NAMES.get(ALIASES.get(name, name))
    if family is None:
        msg = f"frame {name!r}: must be one of {', '.join(NAMES)}"
        raise InputError(msg)
    strange = sorted(set(options) - set(family.options))
    if strange:
        msg = f"frame {name}: no option {', '.join(strange)}; it has {', '.join(family.options)}"
        raise InputError(msg)
    return family
