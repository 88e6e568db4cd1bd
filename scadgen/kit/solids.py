"""The parts of a frame as solids, and what their live parameters may be.

Where joints differ they have letters.  A connector is named by the first joint and edge that has
it, ``connector_A1``, and so are the halves it may be split into: ``half_A1``, and ``half_A1_over``
for half B where that is another part; either may be a half of other joints too.  Edge elements are
numbered.  Where all joints are one regular joint, elements are named by their ends, and all of
them are there, whether the frame needs them or not.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from scadgen.element.ends import End, connector, connector_end, flat_end, key_end, part, peg
from scadgen.element.pieces import half
from scadgen.frame.kinds import Kinds
from scadgen.kit.elements import Element, ElementEnd, Elements, edge_elements
from scadgen.kit.live import limits
from scadgen.kit.model import Part, PartEnd
from scadgen.kit.named import Named
from scadgen.kit.parameter import Tightest
from scadgen.kit.pieces import Pieces
from scadgen.solid.affine import Floats, Ints, Range

__all__ = ["REGULAR", "Solids"]

#: The edge elements of regular joints, by how many of their ends are keys.
REGULAR = ("basic", "one_sided", "two_sided")


@dataclass(frozen=True, eq=False)
class Solids:
    """What a frame's parts are made from.

    Parameters
    ----------
    kinds
        The kinds of joints, and what stands where.
    edges
        ``(m, 2) int``: the frame's.
    lengths
        ``(m,) float``: lengths of the edges, in edge lengths; equal for edges that may have the
        same part.
    pieces
        Of each kind of joint.
    regular
        Whether all joints are one regular joint.
    """

    kinds: Kinds
    edges: Ints
    lengths: Floats
    pieces: tuple[Pieces, ...]
    regular: bool

    @cached_property
    def named(self) -> Named:
        """The parts of its joints."""
        return Named(self.pieces, self.kinds.symmetries, plain=self.regular)

    @cached_property
    def elements(self) -> Elements:
        """Its edge elements."""
        named = self.named
        found = edge_elements(self.kinds, self.edges, self.lengths, named.sockets, named.slots)
        return found.by_keys(self._made) if self.regular else found

    @cached_property
    def _made(self) -> dict[str, Element]:
        """The elements that are made."""
        if not self.regular:
            return dict(self.elements.kinds)
        whole, key = ElementEnd(0, 0, over=False), ElementEnd(0, None, over=False)
        ends = ((whole, whole), (whole, key), (key, key))
        return {name: Element(pair, 1.0) for name, pair in zip(REGULAR, ends, strict=True)}

    def limits(self) -> tuple[Range, ...]:
        """What the live parameters may be, so that all joints and elements are sound."""
        keys = [one.key for one in self.pieces]
        elements = tuple(
            (tuple((keys[end.number], self._has_socket(end)) for end in one.ends), one.length)
            for one in self._made.values()
        )
        return limits(Tightest.of(self.pieces, elements))

    def _has_socket(self, end: ElementEnd) -> bool:
        """Whether an element's tube has a socket at an end: for a loose peg."""
        return end.slot is None and self.pieces[0].key.style == "loose"

    def parts(self) -> dict[str, Part]:
        """Every part: the elements, the connectors, the halves, the pegs, the tube."""
        return {one.name: one for one in [*self._elements(), *self._pieces(), *self._tubes()]}

    def _elements(self) -> list[Part]:
        return [
            Part.of(
                part(name, near, far, {"edge_length": one.length}),
                "element",
                tuple(map(self._end, one.ends)),
                one.length,
            )
            for name, one in self._made.items()
            for near, far in [map(self._surface, one.ends)]
        ]

    def _pieces(self) -> list[Part]:
        named, found = self.named, []
        for make, role, pieces in (
            (connector, "connector", named.connectors),
            (half, "half", named.halves),
        ):
            for name, one in pieces.items():
                solid = replace(make(one.key, one.piece), name=name)
                end = self._part_end(one.number, one.slot, over=one.second)
                found.append(Part.of(solid, role, (end,)))
        for name, number in named.pegs.items():
            solid = replace(peg(self.pieces[number].key), name=name)
            found.append(Part.of(solid, "peg", (self._part_end(number, None),)))
        return found

    def _tubes(self) -> list[Part]:
        """A plain tube, where all tubes are alike."""
        if not self.regular:
            return []
        key = self.pieces[0].key
        flat = flat_end(key, {"side": key.tube_start, "clearance": 1.0})
        return [Part.of(part("tube", flat, flat, {"edge_length": 1.0}), "tube", length=1.0)]

    def _surface(self, end: ElementEnd) -> End:
        one = self.pieces[end.number]
        if end.slot is None:
            return key_end(one.key)
        whole = one.connectors[end.slot]
        return connector_end(one.key, whole.turned_over() if end.over else whole)

    def _end(self, end: ElementEnd) -> PartEnd:
        return self._part_end(end.number, end.slot, over=end.over)

    def _part_end(self, number: int, slot: int | None, *, over: bool = False) -> PartEnd:
        own = None if slot is None else self.kinds.from_first_key(number, slot)
        return PartEnd(self.kinds.name(number), own, over)
