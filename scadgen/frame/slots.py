"""The connectors of a frame's joints before any is split, and joints that are not to be made."""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.frame.classes import group_values
from scadgen.frame.graph import Frame
from scadgen.solid.affine import Floats, Ints

__all__ = ["ANGLE", "Keys", "Places", "Refused", "is_forest", "same_angles"]

#: Directions as near as this are the same, in radians; twice what sameness allows a joint.
ANGLE = 2e-4

#: The slots that have keys, of each vertex.
Keys = Sequence[Collection[int]]


@dataclass(frozen=True, slots=True)
class Refused:
    """A joint that is not to be made, with its keys where they are.

    Parameters
    ----------
    turns
        Directions of its connectors from its first key on, ascending, in degrees.
    keys
        Which of these are keys.
    """

    turns: tuple[float, ...]
    keys: tuple[int, ...]

    def is_like(self, directions: Floats, slots: Collection[int]) -> bool:
        """Whether it is the joint with these directions and keys, or that turned over."""
        count = len(directions)
        if count != len(self.turns) or len(slots) != len(self.keys):
            return False
        for first, way in itertools.product(slots, (1, -1)):
            turns = way * (directions[(first + way * np.arange(count)) % count] - directions[first])
            off = (turns - np.radians(self.turns) + np.pi) % (2 * np.pi) - np.pi
            keys = tuple(sorted(way * (slot - first) % count for slot in slots))
            if keys == self.keys and bool((np.abs(off) < ANGLE).all()):
                return True
        return False


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """The joints' connectors before any is split.

    Parameters
    ----------
    frame
        The frame.
    shape_of
        ``(n,) int``: the shape of each vertex.
    counts
        Of each shape, how many connectors it has, and after how many it is alike.
    slots
        ``(m, 2) int``: the slot of its shape that each end of an edge takes.
    over
        ``(n,) bool``: whether its shape is turned over at each vertex.
    turn
        ``(n,) float``: where its shape's first direction is there.
    directions
        Of each shape.
    refused
        Joints to keep out.
    """

    frame: Frame
    shape_of: Ints
    counts: Sequence[tuple[int, int]]
    slots: Ints
    over: NDArray[np.bool_]
    turn: Floats
    directions: Sequence[Floats]
    refused: Sequence[Refused] = ()

    def direction(self, vertex: int, slot: int) -> float:
        """Direction of a slot at a vertex, in radians."""
        own = float(self.directions[int(self.shape_of[vertex])][slot])
        return float(self.turn[vertex]) + (-own if self.over[vertex] else own)

    def refuse(self, vertex: int, keys: Collection[int]) -> bool:
        """Whether the joint at a vertex is to be kept out, if it has these keys."""
        directions = self.directions[int(self.shape_of[vertex])]
        return any(one.is_like(directions, keys) for one in self.refused)


def same_angles(angles: Floats, turn: float = 2 * math.pi) -> Ints:
    """A number for each of some angles, the same where they are: how all are turned is no matter.

    Numbers ascend from an angle of 0 on, around a turn.
    """
    within = angles % turn
    ascending = np.sort(within)
    # No group reaches across the widest gap.
    widest = int(np.diff(ascending, append=ascending[:1] + turn).argmax())
    start = ascending[(widest + 1) % len(ascending)]
    middles, group = group_values((within - start) % turn, ANGLE)
    place = np.argsort(np.argsort((middles + start + ANGLE) % turn))
    return np.asarray(place[group])


def is_forest(edges: Ints, count: int) -> bool:
    """Whether edges close no loop."""
    if len(edges) >= count:
        return False
    graph = coo_array((np.ones(len(edges)), edges.T), shape=(count, count))
    parts, _ = connected_components(graph, directed=False)
    return parts == count - len(edges)
