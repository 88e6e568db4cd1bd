"""What stands at every vertex: kinds of joints, with caps at the rim and keys chosen."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.frame.graph import Frame
from scadgen.frame.hosts import Hosted, Shape, hosted
from scadgen.frame.keys import Places, Refused, choose_keys
from scadgen.frame.sameness import Sameness
from scadgen.solid.affine import Floats, Ints

__all__ = ["Kind", "Kinds", "Shape", "choose_kinds"]


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


def choose_kinds(
    frame: Frame, same: Sameness, *, rim: bool = True, refused: Sequence[Refused] = ()
) -> Kinds:
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
    refused
        Joints to keep out, by other keys, as far as that goes.
    """
    found = hosted(frame, same, rim=rim)

    def gathered(keys: Sequence[Collection[int]]) -> Kinds:
        return _gathered(found, frame, keys)

    counts = [(len(shape.directions), shape.period) for shape in found.shapes]
    directions = [shape.directions for shape in found.shapes]
    places = Places(frame, found.shape_of, counts, found.slots, found.turn, directions, refused)
    return gathered(choose_keys(places, lambda keys: _parts(gathered(keys), frame, same)))


def _parts(kinds: Kinds, frame: Frame, same: Sameness) -> int:
    """How many kinds of joints and of edge elements there are."""
    kind = kinds.kind_of[frame.edges]
    period = np.array([kinds.period(n) for n in range(len(kinds.kinds))])
    ends = kind * (kinds.slots.max() + 1) + kinds.slots % period[kind]
    length = np.array([edge.length for edge in same.edges])[same.edge_of]
    elements = np.column_stack([np.sort(ends, axis=1), length])
    return len(kinds.kinds) + len(np.unique(elements, axis=0))


def _gathered(found: Hosted, frame: Frame, keys: Sequence[Collection[int]]) -> Kinds:
    """Turn each joint so that alike keys are in the same slots, and number the kinds."""
    shapes, shape_of = found.shapes, found.shape_of
    turn, slots = found.turn.copy(), found.slots.copy()
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
