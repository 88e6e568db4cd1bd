"""The live parameters: all that is said of each, in one table.

Command line, Customizer, README, ``kit.json`` and FreeCAD have from here what can be set.  What
other files hold of it is written by ``scripts/tables.py``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from scadgen.kit.parameter import Live, Settings, Tightest
from scadgen.kit.ranges import SIDE, WALL, edge_range
from scadgen.solid.affine import Linear, Range

__all__ = [
    "CLEARANCE",
    "LIVE",
    "PARAMETERS",
    "USUAL_SIDE",
    "limits",
    "peg_length",
]

#: Side of the tubes that is not said, in mm.
USUAL_SIDE = 10.0

#: Gap between mating faces that is not said, in mm.
CLEARANCE = 0.2

#: How far a loose peg reaches into the tube, in sides.
_INTO_TUBE = 0.35


def peg_length(through: float, side: float, clearance: float) -> float:
    """Length of a loose peg that is not said, before it is rounded down to 0.1 mm.

    Parameters
    ----------
    through
        Its longest way through the halves, in sides.
    side, clearance
        In mm.
    """
    return (through + _INTO_TUBE) * side + clearance


def _edge_ranges(tightest: Tightest) -> Iterable[Range]:
    found: list[Range] = []
    for ends, times in tightest.elements:
        limit = edge_range(ends, times)
        if limit not in found:
            found.append(limit)
    return found


def _clearance_ranges(tightest: Tightest) -> Iterable[Range]:
    yield Range(
        "clearance",
        Linear({}),
        Linear({"side": tightest.clearance}),
        "wider, the walls of the connectors would turn over",
    )


def _peg_width(values: Settings) -> float:
    room = 2 * (values.tightest.window - WALL) * values["side"] - 2 * values["peg_clearance"]
    return math.floor(10 * min(0.4 * values["side"], room)) / 10


def _peg_width_ranges(tightest: Tightest) -> Iterable[Range]:
    yield Range(
        "peg_width",
        Linear({"side": 0.15}),
        Linear({"side": 2 * (tightest.window - WALL), "peg_clearance": -2.0}),
        "the peg breaks, or the socket's walls do",
    )


def _peg_length(values: Settings) -> float:
    tightest, side, gap = values.tightest, values["side"], values["peg_clearance"]
    if tightest.style == "fixed":
        length = min(0.6 * side, (tightest.depth - WALL) * side - gap)
    else:
        length = peg_length(tightest.through, side, values["clearance"])
        length = min(length, (tightest.hole - WALL) * side - 2 * gap)
    return math.floor(10 * length) / 10


def _peg_length_ranges(tightest: Tightest) -> Iterable[Range]:
    if tightest.style == "fixed":
        depth = tightest.through - 2 * WALL if tightest.bored else tightest.depth - WALL
        yield Range(
            "peg_length",
            Linear({"side": 0.25}),
            Linear({"side": depth, "peg_clearance": -1.0}),
            "the peg slips out, or its socket breaks into a wall",
        )
    else:
        yield Range(
            "peg_length",
            Linear({"side": tightest.through + 0.2, "clearance": 1.0}),
            Linear({"side": tightest.hole - WALL, "peg_clearance": -2.0}),
            "the peg reaches from the ring's hole into the tube, and fits into the hole",
        )


def _peg_clearance_ranges(_: Tightest) -> Iterable[Range]:
    wide = Linear({"side": 0.1})
    yield Range("peg_clearance", Linear({}), wide, "wider, the peg would not hold")


def _peg_chamfer_ranges(tightest: Tightest) -> Iterable[Range]:
    least = Linear({"side": 0.01})
    yield Range(
        "peg_chamfer", least, Linear({"peg_width": 0.25}), "the peg's tip keeps half its width"
    )
    if tightest.bored:
        most = Linear({"peg_width": 0.5, "bore": -0.5, "side": -WALL})
        yield Range("peg_chamfer", least, most, "the bore leaves the peg's tip a wall")


def _bore_ranges(tightest: Tightest) -> Iterable[Range]:
    if tightest.bored:
        yield Range(
            "bore",
            Linear({"side": 0.05, "clearance": 1.0}),
            Linear({"peg_width": 1.0, "side": -4 * WALL}),
            "the bore leaves a groove in each half, and runs through the pegs",
        )


#: The live parameters, in the order in which files list them.
LIVE = (
    Live(
        "side",
        "Side of the square tubes",
        "Dimensions",
        step=0.5,
        usual=USUAL_SIDE,
        default=USUAL_SIDE,
        ranges=lambda _: (SIDE,),
    ),
    Live(
        "edge_length",
        "Distance between the centres of two joints",
        "Dimensions",
        step=1.0,
        usual=60.0,
        default=0.0,
        ranges=_edge_ranges,
        by_default="6 sides, more for a wide ring; of a file what it says",
        asked="Length of the shortest edges; a frame from a file grows or shrinks to it",
    ),
    Live(
        "clearance",
        "Gap between mating faces",
        "Clearance",
        step=0.01,
        usual=CLEARANCE,
        default=CLEARANCE,
        ranges=_clearance_ranges,
    ),
    Live(
        "peg_width",
        "Side of the square peg",
        "Peg",
        step=0.1,
        usual=4.0,
        default=_peg_width,
        ranges=_peg_width_ranges,
        by_default="0.4 sides",
    ),
    Live(
        "peg_length",
        "Length of the peg",
        "Peg",
        step=0.1,
        usual=6.0,
        default=_peg_length,
        ranges=_peg_length_ranges,
        by_default="0.6 sides; loose: as far as it must reach",
    ),
    Live(
        "peg_clearance",
        "Gap between the peg and each wall of its socket",
        "Clearance",
        step=0.01,
        usual=0.2,
        default=lambda values: values["clearance"],
        ranges=_peg_clearance_ranges,
        by_default="the clearance",
    ),
    Live(
        "peg_chamfer",
        "Lead-in of the peg's tips",
        "Peg",
        step=0.05,
        usual=0.5,
        default=lambda values: round(0.05 * values["side"], 9),
        ranges=_peg_chamfer_ranges,
        by_default="0.05 sides",
    ),
    Live(
        "bore",
        "Side of the square bore along all edges",
        "Tube",
        step=0.1,
        usual=2.0,
        default=0.0,
        ranges=_bore_ranges,
        asked="Side of a square bore along all edges; 0 for solid ones",
        optional=True,
    ),
)

#: Their names, in this order.
PARAMETERS = tuple(live.name for live in LIVE)


def limits(tightest: Tightest) -> tuple[Range, ...]:
    """What the live parameters may be, each range after those of what its bounds depend on.

    So the first that is left is the one to blame.

    Parameters
    ----------
    tightest
        What they must fit.
    """
    rest = [limit for live in LIVE for limit in live.ranges(tightest)]
    found: list[Range] = []
    while rest:
        names = {limit.parameter for limit in rest}
        free = (r for r in rest if not {*r.low.terms, *r.high.terms} & names)
        found.append(next(free, rest[0]))
        rest.remove(found[-1])
    return tuple(found)
