"""What stands at every vertex: kinds of joints, with caps at the rim and keys chosen."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scadgen.frame.classes import Classes, joint_name
from scadgen.frame.element_classes import ElementEnds, Slots
from scadgen.frame.graph import Frame
from scadgen.frame.keys import choose_keys
from scadgen.frame.rows import choose_keys_in_rows
from scadgen.frame.slots import Places, Refused
from scadgen.frame.template import Template
from scadgen.frame.templates import Templates, fit_templates
from scadgen.joint.symmetry import Symmetry
from scadgen.solid.affine import Floats, Ints

__all__ = ["Kind", "Kinds", "choose_kinds"]


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


@dataclass(frozen=True, eq=False)
class Kinds:
    """What stands where.

    Parameters
    ----------
    shapes, kinds
        Of all joints.
    kind_of
        ``(n,) int``: the kind of each vertex.
    over
        ``(n,) bool``: whether its kind is turned over there.
    turn
        ``(n,) float``: where its shape's first direction is there; the others follow it
        counter-clockwise, or clockwise where it is turned over.
    slots
        ``(m, 2) int``: the slot of its shape that each end of an edge takes.
    """

    shapes: tuple[Template, ...]
    kinds: tuple[Kind, ...]
    kind_of: Ints
    over: NDArray[np.bool_]
    turn: Floats
    slots: Ints

    def shape(self, kind: int) -> Template:
        """The shape of a kind's joints."""
        return self.shapes[self.kinds[kind].shape]

    def name(self, kind: int) -> str:
        """A kind's letter; empty where there is one kind."""
        return joint_name(kind) if len(self.kinds) > 1 else ""

    def from_first_key(self, kind: int, slot: int) -> int:
        """A slot of a kind's shape as it is counted from the kind's first key."""
        return (slot - self.kinds[kind].keys[0]) % len(self.shape(kind).directions)

    @cached_property
    def symmetries(self) -> tuple[Symmetry, ...]:
        """Which slots of each kind are alike, keys and all."""
        return tuple(
            shape.symmetry.with_keys(kind.keys, shape.gaps)
            for kind in self.kinds
            for shape in [self.shapes[kind.shape]]
        )

    def ends(
        self,
        edges: Ints,
        lengths: Floats,
        sockets: Sequence[int],
        slots: Slots,
        twists: Floats | float = 0.0,
    ) -> ElementEnds:
        """What the elements of some edges end in.

        Parameters
        ----------
        edges
            ``(m, 2) int``: the frame's.
        lengths
            ``(m,) float``: theirs; the same for those that may be the same part.
        sockets
            For each kind a number under that of all kinds: what an element ends in at a key.
        slots
            Which connectors are the same.
        twists
            ``(m,) float``, or one for all: how far the edges turn about themselves; as lengths.

        Returns
        -------
        ends
            Connectors have the number of all kinds, and more than that by what they are.
        """
        place = self.kind_of[edges], self.slots
        keyed = np.zeros(slots.what.shape, dtype=bool)
        for number, one in enumerate(self.kinds):
            keyed[number, list(one.keys)] = True
        split = keyed[place]
        what = np.where(split, np.array(sockets)[place[0]], len(self.kinds) + slots.what[place])
        over, either = slots.over[place] ^ self.over[edges], slots.either[place] | split
        return ElementEnds(what, over, either, lengths, twists)

    def directions(self, vertex: int) -> Floats:
        """Where the connectors of a vertex point, by slot, in radians."""
        own = self.shape(int(self.kind_of[vertex])).directions
        return np.asarray(self.turn[vertex] + (-own if self.over[vertex] else own))


def choose_kinds(
    frame: Frame,
    same: Classes,
    *,
    rim: bool = True,
    refused: Sequence[Refused] = (),
    in_rows: bool = False,
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
    in_rows
        Whether keys are to be such that the frame is rows that slide onto parallel pegs.

    Raises
    ------
    InputError
        There are no such rows.
    """
    found = fit_templates(frame, same, rim=rim)

    def gathered(keys: Sequence[Collection[int]]) -> Kinds:
        return _gathered(found, frame, keys)

    places = Places(
        frame,
        found.shape_of,
        [(shape.symmetry.count, shape.symmetry.period) for shape in found.shapes],
        found.slots,
        found.over,
        found.turn,
        [shape.directions for shape in found.shapes],
        refused,
    )
    choose = choose_keys_in_rows if in_rows else choose_keys
    chosen = choose(places, lambda keys: _parts(gathered(keys), frame, same))
    return _as_most_lie(gathered(chosen), frame)


def _parts(kinds: Kinds, frame: Frame, same: Classes) -> int:
    """How many kinds of joints and, at most, of edge elements: shapes may have more in common."""
    # Sockets are those of a ring, which joints of one shape have alike.
    sockets = [one.shape for one in kinds.kinds]
    slots = Slots.of(kinds.symmetries)
    elements = kinds.ends(frame.edges, same.lengths, sockets, slots, same.twists).alike()
    return len(kinds.kinds) + len(elements.what)


def _gathered(found: Templates, frame: Frame, keys: Sequence[Collection[int]]) -> Kinds:
    """Turn each joint so that alike keys are in the same slots, and number the kinds."""
    shapes, shape_of = found.shapes, found.shape_of
    over, turn, slots = found.over.copy(), found.turn.copy(), found.slots.copy()
    ends: list[list[tuple[int, int]]] = [[] for _ in shape_of]
    for edge, pair in enumerate(frame.edges):
        for end, vertex in enumerate(pair):
            ends[vertex].append((edge, end))
    chosen, taken = [], []
    for vertex, own in enumerate(keys):
        shape, way = shapes[shape_of[vertex]], -1 if over[vertex] else 1
        best, first, mirrored = _first_keys(shape.symmetry, own)
        turn[vertex] += way * shape.directions[first]
        over[vertex] ^= mirrored
        for edge, end in ends[vertex]:
            off = slots[edge, end] - first
            slots[edge, end] = (-off if mirrored else off) % shape.symmetry.count
        chosen.append((int(shape_of[vertex]), best))
        taken.append({int(slots[edge, end]) for edge, end in ends[vertex]})
    known = sorted(set(chosen))
    kind_of = np.array([known.index(one) for one in chosen])
    kinds = []
    for number, (shape_number, best) in enumerate(known):
        used = set().union(*(taken[v] for v in np.flatnonzero(kind_of == number)))
        free = set(range(len(shapes[shape_number].directions))) - used
        kinds.append(Kind(shape_number, best, tuple(sorted(free))))
    return Kinds(shapes, tuple(kinds), kind_of, over, turn, slots)


def _first_keys(symmetry: Symmetry, keys: Collection[int]) -> tuple[tuple[int, ...], int, bool]:
    """The least slots that keys have once their joint is turned so that it is itself.

    Returns
    -------
    keys
        Their slots then, ascending.
    first
        The slot that becomes 0.
    mirrored
        Whether the joint is turned over as well: slots count down from the first.
    """
    count, mirror = symmetry.count, symmetry.mirror
    ways = [(first, 1) for first in range(0, count, symmetry.period)]
    if mirror is not None:
        ways += [((mirror + first) % count, -1) for first, _ in ways]
    found = {
        (first, way): tuple(sorted(way * (slot - first) % count for slot in keys))
        for first, way in ways
    }
    first, way = min(found, key=lambda one: found[one])
    return found[first, way], first, way < 0


def _as_most_lie(kinds: Kinds, frame: Frame) -> Kinds:
    """The same with each kind turned over of which most joints are, and those joints not."""
    shapes, over, slots = list(kinds.shapes), kinds.over.copy(), kinds.slots.copy()
    found = []
    for number, kind in enumerate(kinds.kinds):
        mine = kinds.kind_of == number
        if 2 * np.count_nonzero(over[mine]) <= np.count_nonzero(mine):
            found.append(kind)
            continue
        shape = kinds.shape(number).turned_over()
        count = shape.symmetry.count
        keys, caps = (
            tuple(sorted(-slot % count for slot in some)) for some in (kind.keys, kind.caps)
        )
        found.append(Kind(len(shapes), keys, caps))
        shapes.append(shape)
        over[mine] = ~over[mine]
        ends = mine[frame.edges]
        slots[ends] = -slots[ends] % count
    return Kinds(tuple(shapes), tuple(found), kinds.kind_of, over, kinds.turn, slots)
