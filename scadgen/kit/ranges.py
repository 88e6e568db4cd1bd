"""What any live parameter may be: limits that parts have in common, and how values are checked.

Every bound is linear in the other parameters; the reasons it is safe are in
``docs/geometry.md``, "Ranges".
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from scadgen.element.squares import Key
from scadgen.errors import InputError
from scadgen.solid.affine import Linear, Range

__all__ = ["LONGEST", "SIDE", "TUBE", "WALL", "check_values", "edge_range", "span"]

#: Longest that an edge may be, in mm.
LONGEST = 2000.0

#: Thinnest wall anywhere beside a hole, in sides; 0.4 mm, one line of a nozzle, at side 10 mm.
WALL = 0.04

#: Shortest tube between two joints, in sides.
TUBE = 0.5

#: What the side may be.
SIDE = Range("side", Linear({}, 5.0), Linear({}, 100.0), "thinner walls do not print")

#: What rounding of decimal input may take a value past its bound, in mm.
_SLACK = 1e-9


def edge_range(ends: Iterable[tuple[Key, bool]], times: float) -> Range:
    """The range of the edge length that an element needs.

    Parameters
    ----------
    ends
        The key of the joint at each end, and whether it has a socket there.
    times
        The element's length, in edge lengths.
    """
    sides, others = TUBE, dict.fromkeys(("clearance", "peg_length", "peg_clearance"), 0.0)
    for key, socket in ends:
        sides += key.pad if socket else key.tube_start
        for name in ("peg_length", "peg_clearance") if socket else ("clearance",):
            others[name] += 1.0
    terms = {"side": sides, **{name: factor for name, factor in others.items() if factor}}
    return Range(
        "edge_length",
        Linear({name: factor / times for name, factor in terms.items()}),
        Linear({}, LONGEST / times),
        "two joints need room, and half a side of tube between them",
    )


def span(limits: Iterable[Range], name: str, values: Mapping[str, float]) -> tuple[float, float]:
    """Lowest and highest value of a live parameter, in mm, if it alone is changed.

    Parameters
    ----------
    limits
        All ranges: a bound of another parameter may move with this one.
    name
        The parameter.
    values
        All parameters, within their ranges.
    """
    low, high = -math.inf, math.inf
    for limit in limits:
        for bound, sign in ((limit.low, 1.0), (limit.high, -1.0)):
            # What is to be at most zero, and by how much it grows with the parameter.
            over = sign * (bound(values) - values[limit.parameter])
            slope = sign * (bound.terms.get(name, 0.0) - (limit.parameter == name))
            if slope > 0:
                high = min(high, values[name] - over / slope)
            elif slope < 0:
                low = max(low, values[name] - over / slope)
    return low, high


def check_values(limits: Iterable[Range], values: Mapping[str, float]) -> None:
    """Refuse live parameters outside their ranges.

    Raises
    ------
    InputError
        The first that is not a finite number or not in its range: the value, and the range.
    """
    for name, value in values.items():
        if not math.isfinite(value):
            msg = f"{name} = {value:g}: must be a finite number of mm"
            raise InputError(msg)
    for limit in limits:
        low, high, value = limit.low(values), limit.high(values), values[limit.parameter]
        if not low - _SLACK <= value <= high + _SLACK:
            others = sorted({*limit.low.terms, *limit.high.terms})
            given = "".join(
                f"{', ' if n else ' for '}{name} = {values[name]:g}"
                for n, name in enumerate(others)
            )
            span = f"{low:.4g} to {high:.4g}" if low <= high else "less than is possible"
            msg = f"{limit.parameter} = {value:g} mm: must be {span} mm{given} ({limit.reason})"
            raise InputError(msg)
