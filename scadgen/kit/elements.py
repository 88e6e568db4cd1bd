"""Which edge element is on each edge of a frame, and which way it lies there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from scadgen.frame.element_classes import Slots
from scadgen.frame.kinds import Kinds
from scadgen.solid.affine import Floats, Ints

__all__ = ["Element", "ElementEnd", "Elements", "Laid", "edge_elements"]


@dataclass(frozen=True, slots=True)
class ElementEnd:
    """An end of an element.

    Parameters
    ----------
    number
        Of a kind of joint that has it.
    slot
        Whose connector it is; None if it is a socket.
    over
        Whether the connector is turned over.
    """

    number: int
    slot: int | None
    over: bool


@dataclass(frozen=True, slots=True)
class Element:
    """A kind of edge element.

    Parameters
    ----------
    ends
        What is at its near end and at its far one.
    length
        In edge lengths.
    """

    ends: tuple[ElementEnd, ElementEnd]
    length: float


@dataclass(frozen=True, slots=True)
class Laid:
    """The element on an edge: its name, whether it is turned about, and over."""

    name: str
    swapped: bool
    flipped: bool


@dataclass(frozen=True, slots=True)
class Elements:
    """A frame's edge elements.

    Parameters
    ----------
    kinds
        By name.
    laid
        That on each edge.
    """

    kinds: Mapping[str, Element]
    laid: Sequence[Laid]

    def by_keys(self, known: Mapping[str, Element]) -> Elements:
        """The same with the names, and the near ends, of elements that are told by their keys.

        Parameters
        ----------
        known
            Those elements by name; no two have a key at as many ends.
        """
        names = {sum(_keyed(one)): name for name, one in known.items()}
        laid = []
        for one in self.laid:
            own = _keyed(self.kinds[one.name])
            name = names[sum(own)]
            turned = own != _keyed(known[name])
            laid.append(Laid(name, one.swapped != turned, one.flipped))
        return Elements({one.name: known[one.name] for one in laid}, laid)


def edge_elements(
    kinds: Kinds, edges: Ints, lengths: Floats, sockets: Sequence[int], slots: Slots
) -> Elements:
    """The fewest elements for a frame's edges.

    Parameters
    ----------
    kinds
        What stands at its vertices.
    edges
        ``(m, 2) int``: the frame's.
    lengths
        ``(m,) float``: theirs, in edge lengths; the same for those that may be the same part.
    sockets
        For each kind of joint, the first whose sockets are the same.
    slots
        Which connectors are the same.
    """
    alike = kinds.ends(edges, lengths, sockets, slots).alike()
    found: dict[str, Element] = {}
    table = zip(alike.what.tolist(), alike.over.tolist(), alike.length.tolist(), strict=True)
    for what, over, length in table:
        near, far = (
            _end(len(kinds.kinds), slots.most, *end) for end in zip(what, over, strict=True)
        )
        found[f"edge_{len(found) + 1}"] = Element((near, far), length)
    names = list(found)
    laid = zip(alike.which.tolist(), alike.swapped.tolist(), alike.flipped.tolist(), strict=True)
    return Elements(found, [Laid(names[n], swapped, flipped) for n, swapped, flipped in laid])


def _keyed(element: Element) -> list[bool]:
    """Whether there is a key at each of an element's ends."""
    return [end.slot is None for end in element.ends]


def _end(kinds: int, most: int, what: int, over: bool) -> ElementEnd:  # noqa: FBT001
    """What `Kinds.ends` has a number for."""
    if what < kinds:
        return ElementEnd(what, None, over=False)
    return ElementEnd(*divmod(what - kinds, most), over)
