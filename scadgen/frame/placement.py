"""What stands where: the names of the parts, and placements of them."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["ELEMENTS", "KEYS", "PARTS", "Placement"]

#: Every printed part, in the order in which files list them.
PARTS = ("basic", "one_sided", "two_sided", "connector", "half", "peg", "tube")

#: Roles of edge elements.
ELEMENTS = ("row", "cross")

#: Key styles: the peg is part of the tube, or a piece of its own.
KEYS = ("fixed", "loose")


@dataclass(frozen=True, slots=True)
class Placement:
    """Where one part stands.

    A part is modelled with its (first) joint at the origin and its edge along +x.
    It is first given a half turn about x where `flip` says so, then turned about z,
    then moved.

    Parameters
    ----------
    part
        Name of the part.
    at
        Position of the part's origin in the plane, in edge lengths.
    turn
        Angle about z, in degrees.
    flip
        Whether a half turn about the part's own x axis comes first (this makes half B
        of half A).
    role
        What it is to the viewer: one colour each.
    joint
        Letter of the kind of joint that it is a piece of; empty for edge elements, and where
        there is one kind.
    """

    part: str
    at: tuple[float, float]
    turn: float
    flip: bool
    role: str
    joint: str = ""

    @property
    def other_way_up(self) -> bool:
        """Whether it lies the other way up than most: turned over, or as half B not so.

        A peg is alike on all sides.
        """
        return self.role != "peg" and self.flip != (self.role == "half_b")

    def marked(self, name: str) -> str:
        """A name for it in a picture, with a star if it lies the other way up."""
        return f"{name}*" if self.other_way_up else name
