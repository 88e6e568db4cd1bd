"""Which connectors of a frame's joints are split, so that it can be put together.

An element with whole connectors at both ends cannot close a loop of such elements: the edges
whose ends are both whole are a forest.  Every other edge has a key at one end at least, and
every vertex has one.  So n vertices and m edges take max(n, m - n + 1) keys or more.

The fewest parts come from joints that are alike.  In this order are tried: one key, the same in
all joints of a shape; one key, the same in all joints of a shape with the same side up; one key,
the same in those that are turned alike as well; what takes few keys, wherever they are; and
instead of that several keys, the same in all joints of a shape, where the frame is so dense that
it gives fewer parts.  Joints that were refused with their keys where they were are kept out of
all of these as far as that goes.
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
from scipy.sparse.csgraph import (
    breadth_first_order,
    connected_components,
    maximum_bipartite_matching,
)

from scadgen.frame.graph import Frame
from scadgen.frame.sameness import group_values
from scadgen.solid.affine import Floats, Ints

__all__ = ["ANGLE", "Keys", "Places", "Refused", "choose_keys", "turned_alike"]

#: Directions as near as this are the same, in radians; twice what sameness allows a joint.
ANGLE = 2e-4

#: Choices for alike joints that are looked at, and how many edges they may have in all.
_CHOICES, _EDGES = 5000, 2_000_000

#: Directions of edges each of which is tried as the first that has none.
_DIRECTIONS = 12

#: Keys that alike joints may have: next to each other, for so they are known to lock.
_KEYS = 4

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


def choose_keys(places: Places, parts: Callable[[Keys], int]) -> Keys:
    """The slots that have keys at each vertex.

    Parameters
    ----------
    places
        The joints.
    parts
        How many parts a choice needs.
    """
    for group in (places.shape_of, *turned_alike(places)):
        alike = _alike(places, group, 1, parts)
        if alike is not None:
            return alike
    few = min((_Few(places, whole).chosen() for whole in _forests(places.frame)), key=parts)
    several = _alike(places, places.shape_of, _KEYS, parts)
    return few if several is None or parts(few) <= parts(several) else several


def _same_angles(angles: Floats, turn: float = 2 * math.pi) -> Ints:
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


def turned_alike(places: Places) -> Iterator[Ints]:
    """A number for each vertex, the same for joints of one shape with the same side up.

    Then the same for those that are turned alike as well.
    """
    columns = [places.shape_of, places.over, _same_angles(places.turn)]
    for count in (2, 3):
        alike = np.column_stack(columns[:count])
        yield np.asarray(np.unique(alike, axis=0, return_inverse=True)[1]).ravel()


def _alike(places: Places, group: Ints, most: int, parts: Callable[[Keys], int]) -> Keys | None:
    """The choice with the fewest keys, and of these the fewest parts, alike in each group.

    None where none is enough, or there are too many to look at.
    """
    first = np.unique(group, return_index=True)[1]
    counts = [places.counts[n] for n in places.shape_of[first]]
    # Turned by a symmetry of all joints of a shape, a choice is the same.
    by_shape = len(first) == len(places.counts)
    runs = [
        [
            slots
            for slots in _runs(count, period if by_shape else count, most)
            if not places.refuse(vertex, slots)
        ]
        for vertex, (count, period) in zip(first.tolist(), counts, strict=True)
    ]
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
            cost = pegs, parts(keys)
            if best is None or cost < best:
                best, found = cost, keys
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

    def __init__(self, places: Places, whole: NDArray[np.bool_]) -> None:
        self._places, self._frame = places, places.frame
        #: The edges with whole connectors at both ends.
        self._whole = whole
        self._keys: list[set[int]] = [set() for _ in places.shape_of]
        #: The number of each slot's direction, of each vertex.
        self._directions = _directions(places)

    def chosen(self) -> list[set[int]]:
        """The slots that have keys at each vertex."""
        split = np.flatnonzero(~self._whole)
        ends = list(zip(split.tolist(), self._one_a_vertex(split), strict=True))
        for edge, end in ends:
            if end is not None:
                self._add(edge, end)
        for edge, end in ends:
            if end is None:
                self._add(edge, 0 if self._refuse(edge, 1) and not self._refuse(edge, 0) else 1)
        shape_of = self._places.shape_of.tolist()
        usual = Counter(
            (shape_of[v], int(self._directions[v][slot]))
            for v, keys in enumerate(self._keys)
            for slot in keys
        )
        for vertex, keys in enumerate(self._keys):
            if not keys:
                keys.add(self._best(vertex, usual))
        for vertex, keys in enumerate(self._keys):
            if self._places.refuse(vertex, keys):
                self._move_a_key(vertex)
        return self._keys

    def _move_a_key(self, vertex: int) -> None:
        """Move one of a vertex's keys so that neither joint is to be kept out, if there is a way.

        It goes to the other end of its edge; or the edge becomes a whole one, and another one of
        the loop that this closes gets a key instead.
        """
        for edge, end in np.argwhere(self._frame.edges == vertex).tolist():
            if not self._has(edge, end):
                continue
            self._take(edge, end)
            loop = [] if self._has(edge, 1 - end) else self._loop(edge)
            for other, side in [(edge, 1 - end), *itertools.product(loop, (0, 1))]:
                ends = {vertex, int(self._frame.edges[other, side])}
                had = self._has(other, side)
                self._add(other, side)
                if all(self._keys[v] and not self._places.refuse(v, self._keys[v]) for v in ends):
                    return
                if not had:
                    self._take(other, side)
            self._add(edge, end)

    def _loop(self, edge: int) -> list[int]:
        """The edges without keys that close a loop with one that is to be without."""
        edges, size = self._frame.edges, len(self._frame.vertices)
        whole = [n for n in range(len(edges)) if not (self._has(n, 0) or self._has(n, 1))]
        number = {frozenset(edges[n].tolist()): n for n in whole if n != edge}
        pairs = np.array([sorted(pair) for pair in number]).reshape(-1, 2)
        graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(size, size))
        start, place = edges[edge].tolist()
        before = breadth_first_order(graph.tocsr(), start, directed=False)[1].tolist()
        found = []
        while before[place] >= 0:
            found.append(number[frozenset((place, before[place]))])
            place = before[place]
        return found

    def _one_a_vertex(self, split: Ints) -> list[int | None]:
        """At which end each of these edges has its key: one a vertex, as far as that goes."""
        rows, columns = np.repeat(np.arange(len(split)), 2), self._frame.edges[split].ravel()
        fit = [not self._refuse(edge, end) for edge in split.tolist() for end in (0, 1)]
        pairs = (np.ones(sum(fit)), (rows[fit], columns[fit]))
        choice = coo_array(pairs, shape=(len(split), len(self._frame.vertices)))
        vertex = maximum_bipartite_matching(choice.tocsr(), perm_type="column").tolist()
        return [
            None if v < 0 else int(self._frame.edges[edge, 0] != v)
            for edge, v in zip(split.tolist(), vertex, strict=True)
        ]

    def _refuse(self, edge: int, end: int) -> bool:
        """Whether a joint is to be kept out once it has a key at this end of an edge as well."""
        vertex = int(self._frame.edges[edge, end])
        return self._places.refuse(
            vertex, self._keys[vertex] | {int(self._places.slots[edge, end])}
        )

    def _has(self, edge: int, end: int) -> bool:
        """Whether there is a key at this end of an edge."""
        return int(self._places.slots[edge, end]) in self._keys[int(self._frame.edges[edge, end])]

    def _add(self, edge: int, end: int) -> None:
        self._keys[int(self._frame.edges[edge, end])].add(int(self._places.slots[edge, end]))

    def _take(self, edge: int, end: int) -> None:
        self._keys[int(self._frame.edges[edge, end])].remove(int(self._places.slots[edge, end]))

    def _best(self, vertex: int, usual: Counter[tuple[int, int]]) -> int:
        """The slot for a lone key: not a refused one; as at most others; of a cap; the last."""
        shape = int(self._places.shape_of[vertex])
        ends = np.argwhere(self._frame.edges == vertex)
        taken = {int(self._places.slots[edge, end]) for edge, end in ends}
        return max(
            range(self._places.counts[shape][0]),
            key=lambda slot: (
                not self._places.refuse(vertex, {slot}),
                usual[shape, int(self._directions[vertex][slot])],
                slot not in taken,
                slot,
            ),
        )


def _directions(places: Places) -> list[Ints]:
    """Numbers of the directions of each vertex's slots."""
    found = [
        turn + (-1 if over else 1) * places.directions[shape]
        for shape, over, turn in zip(places.shape_of, places.over, places.turn, strict=True)
    ]
    return np.split(
        _same_angles(np.concatenate(found)), np.cumsum([len(own) for own in found])[:-1]
    )


def _forests(frame: Frame) -> Iterator[NDArray[np.bool_]]:
    """Edges with whole connectors at both ends: all of a direction, while they close no loop.

    One for each direction that may come first, if there are few; the others follow around.
    """
    steps = frame.vertices[frame.edges[:, 1]] - frame.vertices[frame.edges[:, 0]]
    direction = _same_angles(np.arctan2(steps[:, 1], steps[:, 0]), math.pi)
    count = int(direction.max()) + 1
    for first in range(count if count <= _DIRECTIONS else 1):
        whole = np.zeros(len(frame.edges), dtype=bool)
        for value in range(count):
            tried = whole | (direction == (first + value) % count)
            if _is_forest(frame.edges[tried], len(frame.vertices)):
                whole = tried
        yield whole


def _is_forest(edges: Ints, count: int) -> bool:
    """Whether edges close no loop."""
    if len(edges) >= count:
        return False
    graph = coo_array((np.ones(len(edges)), edges.T), shape=(count, count))
    parts, _ = connected_components(graph, directed=False)
    return parts == count - len(edges)
