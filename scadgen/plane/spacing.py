"""Whether a frame's joints keep apart from each other and from edges that pass by."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from scadgen.frame.graph import Frame
from scadgen.solid.affine import Floats, Ints

__all__ = ["Spacing"]

#: Room between two joints, or a joint and a tube, in sides: to put parts in past others.
_GAP = 0.25

#: Half a tube's width, in sides.
_TUBE = 0.5

#: What is as near as this, in mm, may have been meant to meet.
_MEANT = 1.0

#: Share of its need by which a distance may be short: rounding.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Spacing:
    """What the joints of a frame need around them.

    Parameters
    ----------
    frame
        The frame.
    rings
        ``(n,) float``: the ring ratio of each vertex.
    """

    frame: Frame
    rings: Floats

    def least_scale(self, side: float) -> float:
        """How many times as large the frame must be at least for a side, in mm; or 1."""
        return max((float((need / far).max()) for *_, need, far in self._near(side)), default=1.0)

    def largest_side(self, side: float) -> float:
        """The largest side, in mm, up to the given one, with which nothing is too near."""
        return side / max(1.0, self.least_scale(side))

    def fault(self, side: float) -> str | None:
        """Which joint has the least room for a side, in mm, of those that have too little."""
        found = [
            (float((need / far)[worst]), what, int(vertex[worst]), int(other[worst]), far[worst])
            for what, vertex, other, need, far in self._near(side)
            for worst in [int((need / far).argmax())]
        ]
        if not found:
            return None
        scale, what, vertex, other, far = max(found)
        meant = " (a larger --tolerance joins ends that are repaired)" if far < _MEANT else ""
        return (
            f"{self.frame.called_vertex(vertex)}: {self._called(what, other)} is "
            f"{far:.4g} mm away{meant}, {(scale - 1) * far:.4g} mm too near for the joint's ring "
            f"with a side of {side:g} mm"
        )

    def _called(self, what: str, number: int) -> str:
        if what == "vertex":
            return self.frame.called_vertex(number)
        ends = self.frame.edges[number]
        return self.frame.called.short(number, ends, self.frame.plan[ends])

    def _near(self, side: float) -> Iterator[tuple[str, Ints, Ints, Floats, Floats]]:
        """What is too near to vertices: its name, numbers, what is needed and what there is."""
        frame, around = self.frame, side * (self.rings + 0.5)
        points, edges = np.asarray(shapely.points(frame.plan)), frame.edges
        lines = np.asarray(shapely.linestrings(frame.plan[edges]))
        vertex, edge = _within(points, lines, around + side * (_TUBE + _GAP))
        foreign = (edges[edge] != vertex[:, None]).all(axis=1)
        vertex, edge = vertex[foreign], edge[foreign]
        need = around[vertex] + side * (_TUBE + _GAP)
        far = np.asarray(shapely.distance(points[vertex], lines[edge]))
        yield from _short("edge", vertex, edge, need, far)
        vertex, other = _within(points, points, 2 * around + side * _GAP)
        count = len(points)
        pair = np.minimum(vertex, other) * count + np.maximum(vertex, other)
        joined = np.isin(pair, edges.min(axis=1) * count + edges.max(axis=1))
        # The larger ring finds the smaller one.
        foreign = ~joined & (vertex != other) & (around[vertex] >= around[other])
        vertex, other = vertex[foreign], other[foreign]
        need = around[vertex] + around[other] + side * _GAP
        far = np.linalg.norm(frame.plan[vertex] - frame.plan[other], axis=1)
        yield from _short("vertex", vertex, other, need, far)


def _within(points: NDArray[Any], others: NDArray[Any], reach: Floats) -> tuple[Ints, Ints]:
    """Pairs of a point and another geometry that is within its reach."""
    first, second = shapely.STRtree(others).query(points, predicate="dwithin", distance=reach)
    return np.asarray(first, dtype=np.int64), np.asarray(second, dtype=np.int64)


def _short(
    what: str, vertex: Ints, other: Ints, need: Floats, far: Floats
) -> Iterator[tuple[str, Ints, Ints, Floats, Floats]]:
    """Those that are nearer than is needed, if there are any."""
    near = np.flatnonzero(far < need * (1 - _ROUNDING))
    if len(near):
        yield what, vertex[near], other[near], need[near], far[near]
