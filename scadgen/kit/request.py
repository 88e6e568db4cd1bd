"""What kit to make, and the live parameters that were not said."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.frame.keys import Refused
from scadgen.frame.layout import LAYOUTS
from scadgen.frame.placement import KEYS
from scadgen.joint.joint import DETAILS
from scadgen.joint.weave import Weave, built_in
from scadgen.kit.model import RIMS
from scadgen.kit.pieces import Pieces
from scadgen.kit.ranges import WALL, check_values
from scadgen.solid.affine import PARAMETERS, Range

__all__ = ["CLEARANCE", "VALENCE", "Request", "default_values", "peg_length"]

#: Edges at each vertex of the frames that have rows and columns.
VALENCE: Mapping[str, int] = MappingProxyType({"hexagonal": 3, "square": 4})

#: Gap between mating faces that is not said, in mm.
CLEARANCE = 0.2

#: How far a loose peg reaches into the tube, in sides.
_INTO_TUBE = 0.35

#: Above every range, in mm, so that no sum of lengths leaves the numbers there are.
_LONGEST = 1e6


@dataclass(frozen=True, slots=True)
class Request:
    """What kit to make.

    Parameters
    ----------
    frame
        ``hexagonal`` or ``square``; or the name of `graph`.
    key
        ``fixed`` or ``loose``; with a graph only ``loose``, which closes any loop.
    rows, columns
        Cells of the frame; with a graph 0.
    detail
        Name of a level of `DETAILS`.
    weave
        The weave; by default the built-in one for the frame's joints and the key style.  With
        a graph each joint has that of its own angles, and there must be none.
    values
        Live parameters, in mm; those not given follow from the side.  A bore above zero
        makes a bored kit.  An edge length makes a graph as large that its shortest edge is
        as long.
    command
        The command line that makes this kit again.
    graph
        Any frame, in mm.
    rim
        One of `RIMS`; for a graph.
    resizable
        Whether a graph may be made as large as its joints need.
    refused
        Joints of a graph to keep out, by other keys, as far as that goes.

    Raises
    ------
    InputError
        A name or a count that does not exist.
    """

    frame: str
    key: str = "fixed"
    rows: int = 2
    columns: int = 2
    detail: str = "standard"
    weave: Weave | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    command: str = ""
    graph: Frame | None = None
    rim: str = "caps"
    resizable: bool = False
    refused: tuple[Refused, ...] = ()

    def __post_init__(self) -> None:
        """Refuse names that do not exist."""
        for name, value, known in (
            ("frame", self.frame, VALENCE if self.graph is None else (self.frame,)),
            ("key", self.key, KEYS),
            ("detail", self.detail, DETAILS),
            ("rim", self.rim, RIMS),
        ):
            if value not in known:
                msg = f"{name} = {value!r}: must be one of {', '.join(known)}"
                raise InputError(msg)
        if self.frame.lower() == "kit":
            msg = f"frame = {self.frame!r}: would name its files as kit.json; another name works"
            raise InputError(msg)
        self._check_values()
        if self.graph is not None and self.key != "loose":
            grids = " and ".join(VALENCE)
            msg = (
                f"key = {self.key!r}: must be loose, so that each joint closes with all its tubes "
                f"in place; only {grids} frames of rows and columns have fixed pegs"
            )
            raise InputError(msg)
        if self.graph is None:
            LAYOUTS[self.frame](self.rows, self.columns, self.key)
        elif self.weave:
            msg = f"weave {self.weave.name}: each joint of this frame has one of its own"
            raise InputError(msg)

    def _check_values(self) -> None:
        """Refuse live parameters that do not exist, and lengths that are none."""
        for name in self.values:
            if name not in PARAMETERS:
                msg = f"{name}: not a live parameter; must be one of {', '.join(PARAMETERS)}"
                raise InputError(msg)
        for name, length in self.values.items():
            if not 0 <= length <= _LONGEST:
                msg = f"{name} = {length:g} mm: must be a number from 0 to {_LONGEST:g}"
                raise InputError(msg)

    @property
    def chosen_weave(self) -> Weave:
        """The weave given, or the built-in one."""
        return self.weave or built_in(self.valence, self.key)

    @property
    def valence(self) -> int:
        """Edges at each vertex of a hexagonal or square frame."""
        return VALENCE[self.frame]

    @property
    def bored(self) -> bool:
        """Whether a bore runs along the edges."""
        return self.values.get("bore", 0.0) > 0


def default_values(
    request: Request, pieces: Sequence[Pieces], limits: Iterable[Range]
) -> dict[str, float]:
    """All live parameters: those given, and the others by the side.

    Raises
    ------
    InputError
        The side is not in its range; all other defaults are shares of it.
    """
    check_values([r for r in limits if r.parameter == "side"], {"side": 10.0, **request.values})
    side = request.values.get("side", 10.0)
    clearance = request.values.get("clearance", CLEARANCE)
    gap = request.values.get("peg_clearance", clearance)
    keys = [one.key for one in pieces]
    width = min(0.4 * side, 2 * (min(key.window for key in keys) - WALL) * side - 2 * gap)
    if request.key == "fixed":
        length = min(0.6 * side, (min(key.depth for key in keys) - WALL) * side - gap)
    else:
        through = max(key.tube_start - key.pad for key in keys)
        length = peg_length(through, side, clearance)
        length = min(length, (min(one.key_hole for one in pieces) - WALL) * side - 2 * gap)
    values = {
        "side": side,
        "edge_length": 0.0,
        "clearance": clearance,
        "peg_width": math.floor(10 * width) / 10,
        "peg_length": math.floor(10 * length) / 10,
        "peg_clearance": gap,
        "peg_chamfer": round(0.05 * side, 9),
    }
    values |= {name: v for name, v in request.values.items() if name != "bore" or v > 0}
    if "edge_length" not in request.values:
        least = max(r.low(values) for r in limits if r.parameter == "edge_length")
        values["edge_length"] = max(6, math.ceil(least / side + 0.9)) * side
    return values


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
