"""Whether a frame has room for its joints: on its edges, and beside them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scadgen.errors import GeometryError
from scadgen.frame.graph import Frame
from scadgen.frame.kinds import Kinds
from scadgen.frame.words import more
from scadgen.joint.joint import DETAILS
from scadgen.joint.lattice import make_lattice
from scadgen.joint.spokes import Spokes
from scadgen.kit.live import CLEARANCE, peg_length
from scadgen.kit.ranges import SIDE, TUBE
from scadgen.plane.spacing import Spacing
from scadgen.solid.affine import Floats

__all__ = ["Room", "reaches", "room"]

#: An edge is too short if more than this is missing, in mm: rounding, far below a vertex's.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Room:
    """What the joints of a frame need.

    Parameters
    ----------
    frame
        The frame.
    starts
        ``(m,) float``: how far the joints of each edge reach into it, both together, in sides;
        that at a socket to where its peg begins.
    sockets
        ``(m,) int``: how many ends of each edge have a socket.
    through
        Longest way of a loose peg through the halves, in sides.
    values
        The live parameters that are said, in mm.
    apart
        What the joints need around them.
    """

    frame: Frame
    starts: Floats
    sockets: NDArray[np.int64]
    through: float
    values: Mapping[str, float]
    apart: Spacing

    def missing(self, side: float) -> Floats:
        """What each edge is too short by: ``(m,) float``, at least 0, in mm.

        Parameters
        ----------
        side
            Side of the tubes, in mm.
        """
        missing = self._needs(side) - self.frame.lengths
        return np.where(missing > _ROUNDING, missing, 0.0)

    def largest_side(self) -> float:
        """The largest side for which there is room, in mm; pegs are not rounded."""
        fixed, one = (self._needs(side, rounded=False) for side in (0.0, 1.0))
        return self.apart.largest_side(float(((self.frame.lengths - fixed) / (one - fixed)).min()))

    def least_scale(self, side: float) -> float:
        """How many times as large the frame must be at least for a side, in mm."""
        on_edges = float((self._needs(side) / self.frame.lengths).max())
        return max(on_edges, self.apart.least_scale(side))

    def works(self, side: float) -> str:
        """What would do instead of a side that is too large, in words."""
        least, largest = SIDE.low.constant, min(self.largest_side(), SIDE.high.constant)
        if largest < least:
            larger = f"a frame {_up(self.least_scale(least))} times as large"
            return f"sides under {least:g} mm do not print; with {least:g} mm {larger} would do"
        larger = f"a frame {_up(self.least_scale(side))} times as large"
        return f"a side of {_down(largest)} mm or {larger} would do"

    def check(self, side: float) -> None:
        """Refuse edges that are too short, and joints that are too near to what passes by.

        Parameters
        ----------
        side
            Side of the tubes, in mm.

        Raises
        ------
        GeometryError
            There is too little room: where, how much is missing, and what would help.
        """
        missing = self.missing(side)
        if missing.any():
            count, edge = int(np.count_nonzero(missing)), int(missing.argmax())
            msg = (
                f"{self.frame.called_edge(edge)}, {self.frame.lengths[edge]:.4g} mm "
                f"long, is {missing[edge]:.4g} mm too short for its two joints with a side of "
                f"{side:g} mm{more(count)}; {self.works(side)}"
            )
            raise GeometryError(msg)
        fault = self.apart.fault(side)
        if fault:
            msg = f"{fault}; {self.works(side)}"
            raise GeometryError(msg)

    def _ends(self, edge: int) -> list[int]:
        return list(map(int, self.frame.edges[edge]))

    def _needs(self, side: float, *, rounded: bool = True) -> Floats:
        """Length that each edge needs, in mm."""
        clearance = self.values.get("clearance", CLEARANCE)
        gap = self.values.get("peg_clearance", clearance)
        peg = peg_length(self.through, side, clearance)
        peg = self.values.get("peg_length", math.floor(10 * peg) / 10 if rounded else peg)
        return np.asarray(
            side * (self.starts + TUBE)
            + self.sockets * (peg + gap)
            + (2 - self.sockets) * clearance
        )


def reaches(directions: Iterable[float], ring_ratio: float) -> tuple[float, float]:
    """How far a joint's domain reaches: to where its tubes start, and pegs, both in sides.

    Parameters
    ----------
    directions
        Of its edges, ascending, in [0, 2 pi).
    ring_ratio
        Radius of its ring, in sides.

    Raises
    ------
    GeometryError
        Two tubes would overlap.
    """
    spokes = Spokes.flat(tuple(directions))
    domain = make_lattice(spokes, ring_ratio, DETAILS["standard"].cells).domain
    return float(domain.flats.distance[0]), domain.pad(0)[0]


def room(
    frame: Frame,
    kinds: Kinds,
    reach: Floats,
    rings: Floats,
    values: Mapping[str, float],
    *,
    fixed: bool = False,
) -> Room:
    """What the joints of a frame need of its edges.

    Parameters
    ----------
    frame, kinds
        The frame, and what stands where.
    reach
        ``(k, 2) float``: `reaches` of each kind.
    rings
        ``(k,) float``: the ring ratio of each kind.
    values
        The live parameters that are said, in mm.
    fixed
        Whether pegs are fixed, which stay within the joints; else they are loose.
    """
    kind = kinds.kind_of[frame.edges]
    split = np.array(
        [
            [not fixed and slot in kinds.kinds[k].keys for k, slot in zip(*pair, strict=True)]
            for pair in zip(kind.tolist(), kinds.slots.tolist(), strict=True)
        ]
    )
    starts = np.where(split, reach[kind, 1], reach[kind, 0]).sum(axis=1)
    through = float((reach[:, 0] - reach[:, 1]).max())
    apart = Spacing(frame, rings[kinds.kind_of])
    return Room(frame, starts, split.sum(axis=1), through, values, apart)


def _down(value: float) -> str:
    return f"{math.floor(value * 1000) / 1000:g}"


def _up(value: float) -> str:
    return f"{math.ceil(value * 1000) / 1000:g}"
