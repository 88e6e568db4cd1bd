"""What stands at every vertex: kinds of joints, with caps at the rim and keys chosen.

A vertex at the rim often lacks some edges of an inner one.  Caps, which are connectors without
a tube, stand for them, so that both are the same joint.

An element with whole connectors at both ends cannot close a loop of such elements: the edges
whose ends are both whole are a forest.  Every other edge has a key at one end at least, and
every vertex has one, or it could not be put together.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, maximum_bipartite_matching

from scadgen.frame.graph import Frame
from scadgen.frame.sameness import Sameness
from scadgen.solid.affine import Floats, Ints

__all__ = ["Kind", "Kinds", "Shape", "choose_kinds"]

#: Directions as near as this are the same, in radians; twice what sameness allows a joint.
_ANGLE = 2e-4

#: Choices of the same key for all joints of a shape that are tried at most.
_CHOICES = 2000

#: Directions of a joint at the end of a lone edge: its own, and two caps.
_LONE = np.array([0.0, 2 * np.pi / 3, 4 * np.pi / 3])


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Directions in which a joint has connectors.

    Parameters
    ----------
    directions
        ``(k,) float``: ascending from 0, in radians, caps' included.
    symmetry
        In how many ways it can be turned onto itself.
    """

    directions: Floats
    symmetry: int

    @property
    def period(self) -> int:
        """Slots that differ by this are alike."""
        return len(self.directions) // self.symmetry

    @property
    def gaps(self) -> Floats:
        """``(k,) float``: angle from each direction to the next."""
        return np.diff(np.append(self.directions, 2 * np.pi))


@dataclass(frozen=True, slots=True)
class Kind:
    """Joints of one shape with the same keys.

    Parameters
    ----------
    shape
        Number of its shape.
    keys
        Slots of the connectors that are split, ascending.
    caps
        Slots that have no edge at any of its vertices.
    """

    shape: int
    keys: tuple[int, ...]
    caps: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Kinds:
    """What stands where.

    Parameters
    ----------
    shapes, kinds
        Of all joints.
    kind_of
        ``(n,) int``: the kind of each vertex.
    turn
        ``(n,) float``: the angle that maps its shape's directions to the vertex's.
    slots
        ``(m, 2) int``: the slot of its shape that each end of an edge takes.
    """

    shapes: tuple[Shape, ...]
    kinds: tuple[Kind, ...]
    kind_of: Ints
    turn: Floats
    slots: Ints

    def shape(self, kind: int) -> Shape:
        """The shape of a kind's joints."""
        return self.shapes[self.kinds[kind].shape]

    def period(self, kind: int) -> int:
        """Slots of a kind that differ by this are alike, and so are their keys."""
        shape, keys = self.shape(kind), self.kinds[kind].keys
        count = len(shape.directions)
        return next(
            turn
            for turn in range(shape.period, count + 1, shape.period)
            if {(slot + turn) % count for slot in keys} == set(keys)
        )


def choose_kinds(frame: Frame, same: Sameness, *, rim: bool = True) -> Kinds:
    """Fill up rims with caps, and choose the keys.

    Parameters
    ----------
    frame
        The frame.
    same
        What of it is the same.
    rim
        Whether a joint that lacks edges of another gets caps in their place.  Without, only
        lone ends of edges get some.
    """
    inner = np.unique(same.joint_of[~_at_rim(frame)]).tolist()
    hosts = _hosts(same, range(len(same.joints)) if not rim else inner)
    used = sorted({host.shape for host in hosts})
    shapes = tuple(
        Shape(_LONE, 3) if n < 0 else Shape(same.joints[n].directions, same.joints[n].symmetry)
        for n in used
    )
    shape_of = np.array([used.index(host.shape) for host in hosts])[same.joint_of]
    turn = same.turn - np.array([host.turn for host in hosts])[same.joint_of]
    places = (frame.slots - same.shift[frame.edges]) % frame.degree[frame.edges]
    slots = np.array(
        [
            [hosts[same.joint_of[v]].slots[place] for v, place in zip(*pair, strict=True)]
            for pair in zip(frame.edges, places, strict=True)
        ]
    )
    keys = _Keys(frame, [shapes[n] for n in shape_of], slots, turn).chosen()
    return _gathered(shapes, shape_of, turn, frame, slots, keys)


@dataclass(frozen=True, slots=True, eq=False)
class _Host:
    """A joint whose directions a class of joints fits into.

    Parameters
    ----------
    shape
        Number of the class that it is; -1 for that of a lone end.
    turn
        The angle by which the class's directions are turned to be among its own.
    slots
        Which of its directions each of the class's becomes.
    """

    shape: int
    turn: float
    slots: tuple[int, ...]


def _at_rim(frame: Frame) -> NDArray[np.bool_]:
    """Which vertices are on the outline of the frame, or of one of its components."""
    ends = frame.ends
    count = len(ends.edge)
    vertex = np.repeat(np.arange(len(frame.vertices)), frame.degree)
    pairs = np.argsort(ends.edge, kind="stable").reshape(-1, 2)
    twin = np.empty(count, dtype=np.int64)
    twin[pairs] = pairs[:, ::-1]
    # The way around a face on the left: from where an edge arrives to the end before it there.
    start = ends.first[ends.neighbour]
    after = start + (twin - start - 1) % frame.degree[ends.neighbour]
    around = coo_array((np.ones(count), (np.arange(count), after)), shape=(count, count))
    faces, face = connected_components(around, directed=False)
    first, second = frame.vertices[vertex], frame.vertices[ends.neighbour]
    area = np.bincount(face, first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0], faces)
    at_rim = np.zeros(len(frame.vertices), dtype=bool)
    at_rim[vertex[area[face] <= 0]] = True
    return at_rim


def _hosts(same: Sameness, kept: Collection[int]) -> list[_Host]:
    """A host for each class that is not to be kept as it is.

    Of the classes with more edges that it fits into it is the one that is most used.
    """
    directions = [joint.directions for joint in same.joints]
    found: list[_Host] = []
    for number, own in enumerate(directions):
        host = _Host(number, 0.0, tuple(range(len(own))))
        larger = [n for n, other in enumerate(directions) if len(other) > len(own)]
        larger = [] if number in kept else larger
        larger.sort(key=lambda n: (-len(same.joints[n].vertices), n))
        fits = ((n, _fit(own, directions[n])) for n in larger)
        fitting = next(((n, fit) for n, fit in fits if fit), None)
        if fitting:
            host = _Host(fitting[0], *fitting[1])
        elif len(own) == 1:
            host = _Host(-1, 0.0, (0,))
        found.append(host)
    return [_root(found, host) for host in found]


def _root(hosts: Sequence[_Host], host: _Host) -> _Host:
    """The host of the host, and so on."""
    while host.shape >= 0 and hosts[host.shape].shape != host.shape:
        above = hosts[host.shape]
        slots = tuple(above.slots[slot] for slot in host.slots)
        host = _Host(above.shape, host.turn + above.turn, slots)
    return host


def _fit(own: Floats, other: Floats) -> tuple[float, tuple[int, ...]] | None:
    """Turn and slots that put some directions among others, if any do."""
    for start in other:
        off = (own[:, None] + start - other + np.pi) % (2 * np.pi) - np.pi
        slots = np.abs(off).argmin(axis=1)
        if (np.abs(off[np.arange(len(own)), slots]) < _ANGLE).all():
            return float(start), tuple(slots.tolist())
    return None


class _Keys:
    """The choice of keys: for each vertex, slots of its shape.

    Edges of one direction are treated alike, for then joints are too.
    """

    def __init__(self, frame: Frame, shapes: Sequence[Shape], slots: Ints, turn: Floats) -> None:
        self._frame, self._shapes, self._slots, self._turn = frame, shapes, slots, turn
        self._keys: list[set[int]] = [set() for _ in shapes]

    def chosen(self) -> list[set[int]]:
        """The slots that have keys at each vertex."""
        alike = self._alike()
        if alike is not None:
            return alike
        split = np.flatnonzero(~_forest(self._frame))
        for edge, end in zip(split.tolist(), _ends(self._frame, split), strict=True):
            self._keys[int(self._frame.edges[edge, end])].add(int(self._slots[edge, end]))
        usual = Counter(
            (id(self._shapes[v]), self._direction(v, slot))
            for v, keys in enumerate(self._keys)
            for slot in keys
        )
        for vertex, keys in enumerate(self._keys):
            if not keys:
                keys.add(self._best(vertex, usual))
        return self._keys

    def _alike(self) -> list[set[int]] | None:
        """One key that is the same in all joints of a shape, if that is enough."""
        shapes = {id(shape): shape for shape in self._shapes}
        if math.prod(shape.period for shape in shapes.values()) > _CHOICES:
            return None
        for slots in itertools.product(*(range(shape.period) for shape in shapes.values())):
            slot_of = dict(zip(shapes, slots, strict=True))
            keys = [{slot_of[id(shape)]} for shape in self._shapes]
            if self._is_enough(keys):
                return keys
        return None

    def _is_enough(self, keys: Sequence[set[int]]) -> bool:
        """Whether the edges that no key is on close no loop."""
        edges = self._frame.edges
        whole = [
            not any(int(slot) in keys[v] for v, slot in zip(*pair, strict=True))
            for pair in zip(edges, self._slots, strict=True)
        ]
        return _is_forest(edges[whole], len(self._shapes))

    def _direction(self, vertex: int, slot: int) -> int:
        """Direction of a slot at a vertex, in steps that are coarse enough to be the same."""
        angle = self._turn[vertex] + self._shapes[vertex].directions[slot]
        return round(float(angle % (2 * np.pi)) / (4 * _ANGLE)) % round(np.pi / (2 * _ANGLE))

    def _best(self, vertex: int, usual: Counter[tuple[int, int]]) -> int:
        """The slot for a lone key: as at most others; else of a cap; else the last."""
        slots = range(len(self._shapes[vertex].directions))
        ends = np.argwhere(self._frame.edges == vertex)
        taken = {int(self._slots[edge, end]) for edge, end in ends}
        return max(
            slots,
            key=lambda slot: (
                usual[id(self._shapes[vertex]), self._direction(vertex, slot)],
                slot not in taken,
                slot,
            ),
        )


def _forest(frame: Frame) -> NDArray[np.bool_]:
    """Edges with whole connectors at both ends: all of a direction, while they close no loop."""
    steps = frame.vertices[frame.edges[:, 1]] - frame.vertices[frame.edges[:, 0]]
    angle = np.arctan2(steps[:, 1], steps[:, 0]) % np.pi
    direction = np.round(angle / (4 * _ANGLE)).astype(np.int64) % round(np.pi / (4 * _ANGLE))
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


def _gathered(
    shapes: tuple[Shape, ...],
    shape_of: Ints,
    turn: Floats,
    frame: Frame,
    slots: Ints,
    keys: Sequence[set[int]],
) -> Kinds:
    """Turn each joint so that alike keys are in the same slots, and number the kinds."""
    turn, slots = turn.copy(), slots.copy()
    ends: list[list[tuple[int, int]]] = [[] for _ in shape_of]
    for edge, pair in enumerate(frame.edges):
        for end, vertex in enumerate(pair):
            ends[vertex].append((edge, end))
    chosen, taken = [], []
    for vertex, own in enumerate(keys):
        shape = shapes[shape_of[vertex]]
        count = len(shape.directions)
        turned = {
            tuple(sorted((slot - shift) % count for slot in own)): shift
            for shift in range(0, count, shape.period)
        }
        best = min(turned)
        turn[vertex] += shape.directions[turned[best]]
        for edge, end in ends[vertex]:
            slots[edge, end] = (slots[edge, end] - turned[best]) % count
        chosen.append((int(shape_of[vertex]), best))
        taken.append({int(slots[edge, end]) for edge, end in ends[vertex]})
    known = sorted(set(chosen))
    kind_of = np.array([known.index(one) for one in chosen])
    kinds = []
    for number, (shape_number, best) in enumerate(known):
        used = set().union(*(taken[v] for v in np.flatnonzero(kind_of == number)))
        free = set(range(len(shapes[shape_number].directions))) - used
        kinds.append(Kind(shape_number, best, tuple(sorted(free))))
    return Kinds(shapes, tuple(kinds), kind_of, turn, slots)
