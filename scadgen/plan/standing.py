"""A kit's frame as parts and joints: which part is which piece of which joint."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.errors import InputError, InvariantError
from scadgen.frame.placement import bill
from scadgen.kit.model import Joint, Kit
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Pose

__all__ = ["Standing", "StandingJoint", "stand"]


@dataclass(frozen=True, slots=True, eq=False)
class StandingJoint:
    """A joint of the frame.

    Parameters
    ----------
    kind
        What kind of joint stands there.
    pose
        Where, and how: its first key along x, its position in edge lengths.
    parts
        The part that each of the kind's pieces is or belongs to.  A fixed peg is its element.
    tubes
        The element whose end a loose peg goes into, by the number of its half A.
    """

    kind: Joint
    pose: Pose
    parts: Mapping[int, int]
    tubes: Mapping[int, int]

    def pieces(self, *roles: str) -> list[int]:
        """Numbers of the pieces that have one of some roles."""
        return [n for n, place in enumerate(self.kind.pieces) if place.role in roles]

    @property
    def connectors(self) -> dict[int, int]:
        """The part of each whole connector, by its piece."""
        return {n: self.parts[n] for n in self.pieces("cap")}

    def direction(self, piece: int) -> Floats:
        """Direction of a piece's edge in the frame, a unit vector, ``(3,) float``."""
        return self.pose.turn(self.kind.pieces[piece].pose.x)


@dataclass(frozen=True, eq=False)
class Standing:
    """A kit's frame.

    Parameters
    ----------
    kit
        The kit; its placements are the parts, and their numbers those of the parts.
    sites
        The joints, ascending by y, then x.
    """

    kit: Kit
    sites: tuple[StandingJoint, ...]

    @cached_property
    def elements(self) -> frozenset[int]:
        """Numbers of the edge elements."""
        return frozenset(n for n, p in enumerate(self.kit.placements) if p.is_element)

    @cached_property
    def sites_of(self) -> list[list[int]]:
        """Numbers of the joints of each part."""
        found: list[list[int]] = [[] for _ in self.kit.placements]
        for number, site in enumerate(self.sites):
            for part in sorted({*site.parts.values(), *site.tubes.values()}):
                found[part].append(number)
        return found

    @cached_property
    def anchors(self) -> tuple[int, ...]:
        """The last element of each component of the frame: what is held to see what moves."""
        size = len(self.kit.placements)
        of_site = [[*site.parts.values(), *site.tubes.values()] for site in self.sites]
        rows, columns = np.array([(own[0], part) for own in of_site for part in own]).T
        graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(size, size))
        label = connected_components(graph, directed=False)[1]
        return tuple(sorted({label[n]: n for n in sorted(self.elements)}.values()))

    def meeting(self, parts: Collection[int], others: Collection[int]) -> list[int]:
        """Numbers of the joints at which some parts meet others."""
        near = {number for part in parts for number in self.sites_of[part]}
        return sorted(near & {number for part in others for number in self.sites_of[part]})

    def keys(self, site: StandingJoint) -> dict[int, int | None]:
        """The element on the edge of each of a joint's keys, if there is one, by its half A."""
        pegs = zip(site.pieces("half_a"), site.pieces("peg"), strict=True)
        fixed = {half: part for half, peg in pegs if (part := site.parts[peg]) in self.elements}
        return {half: fixed.get(half, site.tubes.get(half)) for half in site.pieces("half_a")}

    @cached_property
    def _reaches(self) -> dict[str, float]:
        """How far each kind of part reaches from its origin, in the plane, in mm."""
        kit = self.kit
        points = {
            name: kit.parts[name].points(kit.values) for name in bill(kit.placements, kit.parts)
        }
        return {name: float(np.hypot(p[:, 0], p[:, 1]).max()) for name, p in points.items()}

    def reach(self, part: int) -> float:
        """How far a part reaches from where it is placed, in the plane, in mm."""
        return self._reaches[self.kit.placements[part].part]

    def length(self, part: int) -> float:
        """Length of an element, in edge lengths."""
        return self.kit.parts[self.kit.placements[part].part].length


def stand(kit: Kit) -> Standing:
    """Look up which part is which piece of the joint at each vertex.

    Parameters
    ----------
    kit
        The kit.

    Raises
    ------
    InputError
        It is the kit of a single joint, without a frame.
    InvariantError
        A joint of the frame lacks a piece.
    """
    if not kit.placements:
        msg = f"{kit.name}: a kit without a frame has nothing to plan; name one of a frame"
        raise InputError(msg)
    kinds = {kind.name: kind for kind in kit.joints}
    there: dict[tuple[int, int, str], int] = {}
    for number, placement in enumerate(kit.placements):
        for end in placement.ends:
            role = "element" if placement.is_element else placement.role
            there[end.vertex, end.slot, role] = number
    sites = (
        _site(kit, number, kinds[vertex.joint], vertex.pose, there)
        for number, vertex in enumerate(kit.vertices)
    )
    return Standing(kit, tuple(sites))


def _site(
    kit: Kit, number: int, kind: Joint, pose: Pose, there: Mapping[tuple[int, int, str], int]
) -> StandingJoint:
    """The joint at a vertex."""
    parts: dict[int, int] = {}
    tubes: dict[int, int] = {}
    for n, piece in enumerate(kind.pieces):
        part = there.get((number, piece.slot, piece.role))
        element = there.get((number, piece.slot, "element"))
        if part is None and (piece.role == "cap" or (piece.role == "peg" and kit.key == "fixed")):
            part = element
        if part is None:
            msg = f"joint {number + 1} has all pieces of {kind.title}: {piece.part} is missing"
            raise InvariantError(msg)
        parts[n] = part
        if piece.role == "half_a" and kit.key == "loose" and element is not None:
            tubes[n] = element
    return StandingJoint(kind, pose, parts, tubes)
