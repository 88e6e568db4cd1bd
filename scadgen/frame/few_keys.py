"""Few keys, wherever they are: one a vertex, and one more for each loop beyond that."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, maximum_bipartite_matching

from scadgen.frame.graph import Frame
from scadgen.frame.slots import Places, is_forest, same_angles
from scadgen.solid.affine import Ints

__all__ = ["FewKeys", "forests"]

#: Directions of edges each of which is tried as the first that has none.
_DIRECTIONS = 12


class FewKeys:
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
    return np.split(same_angles(np.concatenate(found)), np.cumsum([len(own) for own in found])[:-1])


def forests(frame: Frame) -> Iterator[NDArray[np.bool_]]:
    """Edges with whole connectors at both ends: all of a direction, while they close no loop.

    One for each direction that may come first, as seen from above, if there are few; the others
    follow around.
    """
    steps = frame.vertices[frame.edges[:, 1]] - frame.vertices[frame.edges[:, 0]]
    direction = same_angles(np.arctan2(steps[:, 1], steps[:, 0]), math.pi)
    count = int(direction.max()) + 1
    for first in range(count if count <= _DIRECTIONS else 1):
        whole = np.zeros(len(frame.edges), dtype=bool)
        for value in range(count):
            tried = whole | (direction == (first + value) % count)
            if is_forest(frame.edges[tried], len(frame.vertices)):
                whole = tried
        yield whole
