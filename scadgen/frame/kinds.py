"""What stands at every vertex: kinds of joints, with caps at the rim and keys chosen.

A vertex at the rim often lacks some edges of an inner one.  Caps, which are connectors without
a tube, stand for them, so that both are the same joint.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.frame.graph import Frame
from scadgen.frame.keys import ANGLE, Places, choose_keys
from scadgen.frame.sameness import Sameness
from scadgen.solid.affine import Floats, Ints

__all__ = ["Kind", "Kinds", "Shape", "choose_kinds"]

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
    place = (frame.slots - same.shift[frame.edges]) % frame.degree[frame.edges]
    slots = np.array(
        [
            [hosts[same.joint_of[v]].slots[n] for v, n in zip(*pair, strict=True)]
            for pair in zip(frame.edges, place, strict=True)
        ]
    )
    turn, slots = _least_turned(shapes, shape_of, turn, frame, slots)

    def gathered(keys: Sequence[Collection[int]]) -> Kinds:
        return _gathered(shapes, shape_of, turn, frame, slots, keys)

    counts = [(len(shape.directions), shape.period) for shape in shapes]
    directions = [shape.directions for shape in shapes]
    places = Places(frame, shape_of, counts, slots, turn, directions)
    return gathered(choose_keys(places, lambda keys: _parts(gathered(keys), frame, same)))


def _least_turned(
    shapes: Sequence[Shape], shape_of: Ints, turn: Floats, frame: Frame, slots: Ints
) -> tuple[Floats, Ints]:
    """Turns and slots of the joints, each turned as little as its shape's symmetry allows."""
    symmetry = np.array([shape.symmetry for shape in shapes])[shape_of]
    count = np.array([len(shape.directions) for shape in shapes])[shape_of]
    step = 2 * np.pi / symmetry
    steps = np.floor((turn + ANGLE) / step).astype(np.int64)
    shift = (steps * (count // symmetry))[frame.edges]
    return turn - steps * step, (slots + shift) % count[frame.edges]


def _parts(kinds: Kinds, frame: Frame, same: Sameness) -> int:
    """How many kinds of joints and of edge elements there are."""
    kind = kinds.kind_of[frame.edges]
    period = np.array([kinds.period(n) for n in range(len(kinds.kinds))])
    ends = kind * (kinds.slots.max() + 1) + kinds.slots % period[kind]
    length = np.array([edge.length for edge in same.edges])[same.edge_of]
    elements = np.column_stack([np.sort(ends, axis=1), length])
    return len(kinds.kinds) + len(np.unique(elements, axis=0))


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
        fits = ((n, _fits(own, directions[n])) for n in larger)
        fitting = next(((n, found) for n, found in fits if found), None)
        if fitting:
            host = max(
                (_Host(fitting[0], *fit) for fit in fitting[1]),
                key=lambda host: _turned_alike(same, number, host),
            )
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


def _fits(own: Floats, other: Floats) -> list[tuple[float, tuple[int, ...]]]:
    """Turns and slots that put some directions among others."""
    found = []
    for start in other:
        off = (own[:, None] + start - other + np.pi) % (2 * np.pi) - np.pi
        slots = np.abs(off).argmin(axis=1)
        if (np.abs(off[np.arange(len(own)), slots]) < ANGLE).all():
            found.append((float(start), tuple(slots.tolist())))
    return found


def _turned_alike(same: Sameness, number: int, host: _Host) -> int:
    """How many joints of a class are turned as one of their host's class is."""
    step = 2 * np.pi / same.joints[host.shape].symmetry
    own = same.turn[same.joint_of == number] - host.turn
    off = (own[:, None] - same.turn[same.joint_of == host.shape] + step / 2) % step - step / 2
    return int((np.abs(off) < ANGLE).any(axis=1).sum())


def _gathered(
    shapes: tuple[Shape, ...],
    shape_of: Ints,
    turn: Floats,
    frame: Frame,
    slots: Ints,
    keys: Sequence[Collection[int]],
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
