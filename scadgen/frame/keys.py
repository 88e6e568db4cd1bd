"""Which connectors of a frame's joints are split, so that it can be put together.

An element with whole connectors at both ends cannot close a loop of such elements: the edges
whose ends are both whole are a forest.  Every other edge has a key at one end at least, and
every vertex has one.  So n vertices and m edges take max(n, m - n + 1) keys or more.

The fewest parts come from joints that are alike.  In this order are tried: one key, the same in
all joints of a shape; one key, the same in all joints of a shape that are turned alike; what
takes few keys, wherever they are; and instead of that several keys, the same in all joints of a
shape, where the frame is so dense that it gives fewer parts.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, maximum_bipartite_matching

from scadgen.frame.graph import Frame
from scadgen.solid.affine import Floats, Ints

__all__ = ["ANGLE", "Places", "choose_keys"]

#: Directions as near as this are the same, in radians; twice what sameness allows a joint.
ANGLE = 2e-4

#: Choices for alike joints that are looked at, and how many edges they may have in all.
_CHOICES, _EDGES = 5000, 2_000_000

#: Keys that alike joints may have: next to each other, for so they are known to lock.
_KEYS = 4

#: The slots that have keys, of each vertex.
Keys = Sequence[Collection[int]]


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
    turn
        ``(n,) float``: the angle that maps its shape's directions to the vertex's.
    directions
        Of each shape.
    """

    frame: Frame
    shape_of: Ints
    counts: Sequence[tuple[int, int]]
    slots: Ints
    turn: Floats
    directions: Sequence[Floats]


def choose_keys(places: Places, parts: Callable[[Keys], int]) -> Keys:
    """The slots that have keys at each vertex.

    Parameters
    ----------
    places
        The joints.
    parts
        How many parts a choice needs.
    """
    alike = _alike(places, places.shape_of, 1, parts) or _alike(
        places, _turned_alike(places), 1, parts
    )
    if alike is not None:
        return alike
    few = _Few(places).chosen()
    several = _alike(places, places.shape_of, _KEYS, parts)
    return few if several is None or parts(few) <= parts(several) else several


def _turned_alike(places: Places) -> Ints:
    """A number for each vertex, the same for those of one shape that are turned alike."""
    turns = np.round(places.turn % (2 * np.pi) / (4 * ANGLE)).astype(np.int64)
    turns %= round(np.pi / (2 * ANGLE))
    pairs = np.column_stack([places.shape_of, turns])
    return np.asarray(np.unique(pairs, axis=0, return_inverse=True)[1]).ravel()


def _alike(places: Places, group: Ints, most: int, parts: Callable[[Keys], int]) -> Keys | None:
    """The choice with the fewest keys, and of these the fewest parts, alike in each group.

    None where none is enough, or there are too many to look at.
    """
    first = np.unique(group, return_index=True)[1]
    counts = [places.counts[n] for n in places.shape_of[first]]
    # Turned by a symmetry of all joints of a shape, a choice is the same.
    by_shape = len(first) == len(places.counts)
    runs = [list(_runs(count, period if by_shape else count, most)) for count, period in counts]
    number = math.prod(len(choices) for choices in runs)
    if number > min(_CHOICES, _EDGES // max(1, len(places.slots))):
        return None
    size = np.bincount(group)
    best: tuple[int, int] | None = None
    found: Keys | None = None
    for choice in sorted(itertools.product(*runs), key=lambda c: _keys(c, size)):
        pegs = _keys(choice, size)
        if best is not None and pegs > best[0]:
            break
        if _is_enough(places, group, choice):
            keys = [choice[n] for n in group]
            if best is None or (pegs, parts(keys)) < best:
                best, found = (pegs, parts(keys)), keys
    return found


def _keys(choice: Sequence[Collection[int]], size: Ints) -> int:
    """How many keys a choice for each group takes."""
    return int(size @ [len(slots) for slots in choice])


def _runs(count: int, period: int, most: int) -> Iterator[tuple[int, ...]]:
    """Slots next to each other, from one on."""
    for length, start in itertools.product(range(1, min(most, count) + 1), range(period)):
        yield tuple(sorted((start + n) % count for n in range(length)))


def _is_enough(places: Places, group: Ints, choice: Sequence[Collection[int]]) -> bool:
    """Whether the edges that no key is on close no loop."""
    split = np.zeros((len(choice), max(count for count, _ in places.counts)), dtype=bool)
    for n, slots in enumerate(choice):
        split[n, list(slots)] = True
    edges = places.frame.edges
    whole = ~split[group[edges], places.slots].any(axis=1)
    return _is_forest(edges[whole], len(group))


class _Few:
    """A choice of few keys.

    Edges of one direction are treated alike, for then joints are too.
    """

    def __init__(self, places: Places) -> None:
        self._places, self._frame = places, places.frame
        self._keys: list[set[int]] = [set() for _ in places.shape_of]

    def chosen(self) -> list[set[int]]:
        """The slots that have keys at each vertex."""
        split = np.flatnonzero(~_forest(self._frame))
        for edge, end in zip(split.tolist(), _ends(self._frame, split), strict=True):
            self._keys[int(self._frame.edges[edge, end])].add(int(self._places.slots[edge, end]))
        shape_of = self._places.shape_of.tolist()
        usual = Counter(
            (shape_of[v], self._direction(v, slot))
            for v, keys in enumerate(self._keys)
            for slot in keys
        )
        for vertex, keys in enumerate(self._keys):
            if not keys:
                keys.add(self._best(vertex, usual))
        return self._keys

    def _direction(self, vertex: int, slot: int) -> int:
        """Direction of a slot at a vertex, in steps that are coarse enough to be the same."""
        directions = self._places.directions[self._places.shape_of[vertex]]
        angle = self._places.turn[vertex] + directions[slot]
        return round(float(angle % (2 * np.pi)) / (4 * ANGLE)) % round(np.pi / (2 * ANGLE))

    def _best(self, vertex: int, usual: Counter[tuple[int, int]]) -> int:
        """The slot for a lone key: as at most others; else of a cap; else the last."""
        shape = int(self._places.shape_of[vertex])
        ends = np.argwhere(self._frame.edges == vertex)
        taken = {int(self._places.slots[edge, end]) for edge, end in ends}
        return max(
            range(self._places.counts[shape][0]),
            key=lambda slot: (
                usual[shape, self._direction(vertex, slot)],
                slot not in taken,
                slot,
            ),
        )


def _forest(frame: Frame) -> NDArray[np.bool_]:
    """Edges with whole connectors at both ends: all of a direction, while they close no loop."""
    steps = frame.vertices[frame.edges[:, 1]] - frame.vertices[frame.edges[:, 0]]
    angle = np.arctan2(steps[:, 1], steps[:, 0]) % np.pi
    direction = np.round(angle / (4 * ANGLE)).astype(np.int64) % round(np.pi / (4 * ANGLE))
    whole = np.zeros(len(frame.edges), dtype=bool)
    for value in np.unique(direction):
        tried = whole | (direction == value)
        if _is_forest(frame.edges[tried], len(frame.vertices)):
            whole = tried
    return whole


def _ends(frame: Frame, split: Ints) -> list[int]:
    """At which end each of these edges has its key: one a vertex, as far as that goes.

    The others have theirs at the upper end.
    """
    count = len(split)
    rows, columns = np.repeat(np.arange(count), 2), frame.edges[split].ravel()
    choice = coo_array((np.ones(2 * count), (rows, columns)), shape=(count, len(frame.vertices)))
    vertex = maximum_bipartite_matching(choice.tocsr(), perm_type="column")
    return [
        int(frame.edges[edge, 0] != v if v >= 0 else 1)
        for edge, v in zip(split.tolist(), vertex.tolist(), strict=True)
    ]


def _is_forest(edges: Ints, count: int) -> bool:
    """Whether edges close no loop."""
    graph = coo_array((np.ones(len(edges)), edges.T), shape=(count, count))
    parts, _ = connected_components(graph, directed=False)
    return parts == count - len(edges)
