"""What stands where: key styles, roles, and placements of parts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from scadgen.solid.pose import Pose

__all__ = ["ELEMENTS", "KEYS", "ROLES", "Place", "Placement", "bill"]

#: Roles of edge elements: between two whole connectors, and with a key end.
ELEMENTS = ("row", "cross")

#: All that a placed piece is to the viewer: one colour each.
ROLES = (*ELEMENTS, "half_a", "half_b", "cap", "peg")

#: Key styles: the peg is part of the tube, or a piece of its own.
KEYS = ("fixed", "loose")


class Place(NamedTuple):
    """Where an end of something is in a frame.

    Parameters
    ----------
    vertex
        Number of the vertex.
    slot
        Which of the connectors of the joint there, counted from its first key.
    """

    vertex: int
    slot: int


@dataclass(frozen=True, slots=True)
class Placement:
    """Where one part stands, and what it is there.

    A part is modelled with its (first) joint at the origin and its edge along +x.

    Parameters
    ----------
    part
        Name of the part.
    role
        What it is there; one of `ROLES`.
    pose
        Where it stands; its position in edge lengths.
    ends
        Where its ends are: one of a piece, near and far one of an edge element.
    edge
        Number of the frame's edge that an element is on; None for other pieces.
    """

    part: str
    role: str
    pose: Pose
    ends: tuple[Place, ...]
    edge: int | None = None

    @property
    def vertex(self) -> int:
        """Number of the vertex at which it stands; of an element, its near end."""
        return self.ends[0].vertex

    @property
    def slot(self) -> int:
        """The slot in which it stands there."""
        return self.ends[0].slot

    @property
    def is_element(self) -> bool:
        """Whether it is an edge element."""
        return self.edge is not None

    @property
    def other_way_up(self) -> bool:
        """Whether it lies the other way up than most: turned over, or as half B not so.

        A peg is alike on all sides.
        """
        return self.role != "peg" and self.pose.over != (self.role == "half_b")

    def marked(self, name: str) -> str:
        """A name for it in a picture, with a star if it lies the other way up."""
        return f"{name}*" if self.other_way_up else name


def bill(placements: Iterable[Placement], parts: Iterable[str]) -> dict[str, int]:
    """Count the pieces of each part, in the order of `parts`."""
    counts = Counter(p.part for p in placements)
    return {part: counts[part] for part in parts if part in counts}
