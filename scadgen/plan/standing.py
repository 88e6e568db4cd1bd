"""A kit's frame as parts and joints: which part is which piece of which joint."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from scadgen.errors import InputError, InvariantError
from scadgen.frame.layout import bill
from scadgen.frame.placement import ELEMENTS, Placement
from scadgen.kit.model import Joint, Kit
from scadgen.solid.affine import Floats

__all__ = ["Origin", "Site", "Standing", "stand"]

#: Directions as near as this are the same, in degrees; edges are at least 25 degrees apart.
_ANGLE = 0.5

#: Decimals of degrees by which joints fit.
_DECIMALS = 6


@dataclass(frozen=True, slots=True)
class Origin:
    """Where in the frame the coordinates of a joint, or of a way, are.

    Parameters
    ----------
    at
        Where their origin is, in edge lengths.
    turn
        Direction of their x axis, in degrees.
    over
        Whether they are turned over about it, so that z is down.
    """

    at: tuple[float, float]
    turn: float
    over: bool = False

    @property
    def sign(self) -> int:
        """-1 if they are turned over, else 1."""
        return -1 if self.over else 1

    def direction(self, degrees: float) -> float:
        """The frame's direction for one in their plane, in degrees."""
        return self.turn + self.sign * degrees


@dataclass(frozen=True, slots=True, eq=False)
class Site:
    """A joint of the frame.

    Parameters
    ----------
    kind
        What kind of joint stands there.
    origin
        Where, and how.
    parts
        The part that each of the kind's pieces is or belongs to.  A fixed peg is its element.
    tubes
        The element whose end a loose peg goes into, by the number of its half A.
    """

    kind: Joint
    origin: Origin
    parts: Mapping[int, int]
    tubes: Mapping[int, int]

    @property
    def at(self) -> tuple[float, float]:
        """Where it is, in edge lengths."""
        return self.origin.at

    def pieces(self, *roles: str) -> list[int]:
        """Numbers of the pieces that have one of some roles."""
        return [n for n, place in enumerate(self.kind.pieces) if place.role in roles]

    @property
    def connectors(self) -> dict[int, int]:
        """The part of each whole connector, by its piece."""
        return {n: self.parts[n] for n in self.pieces("cap")}

    def direction(self, piece: int) -> float:
        """Direction of a piece's edge in the frame, in radians."""
        return math.radians(self.origin.direction(self.kind.pieces[piece].turn))


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
    sites: tuple[Site, ...]

    @cached_property
    def elements(self) -> frozenset[int]:
        """Numbers of the edge elements."""
        return frozenset(n for n, p in enumerate(self.kit.placements) if p.role in ELEMENTS)

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

    def keys(self, site: Site) -> dict[int, int | None]:
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
        return _length(self.kit, self.kit.placements[part])


def stand(kit: Kit) -> Standing:
    """Find out which kind of joint stands where, and what its pieces are.

    Parameters
    ----------
    kit
        The kit.

    Raises
    ------
    InputError
        It is the kit of a single joint, without a frame.
    InvariantError
        A joint of the frame is not as the kind that its pieces are of.
    """
    if not kit.placements:
        msg = f"{kit.frame}: a kit without a frame has nothing to plan; name one of a frame"
        raise InputError(msg)
    places = kit.vertices
    tree = cKDTree(np.array(places))
    at_vertex: list[list[_End]] = [[] for _ in places]
    for number, placement in enumerate(kit.placements):
        for point, turn in _ends(kit, placement):
            vertex = int(tree.query(point)[1])
            at_vertex[vertex].append(_End(number, placement, turn))
    kinds = {kind.name: kind for kind in kit.joints}
    sites = [_site(kit, kinds, at, ends) for at, ends in zip(places, at_vertex, strict=True)]
    return Standing(kit, tuple(sites))


@dataclass(frozen=True, slots=True)
class _End:
    """What stands at a joint: a part, or one of an element's ends, and where it points."""

    part: int
    placement: Placement
    turn: float

    @property
    def is_element(self) -> bool:
        return self.placement.role in ELEMENTS


def _ends(kit: Kit, placement: Placement) -> Iterator[tuple[Floats, float]]:
    """Where a part meets joints, and the direction that it has there."""
    at, turn = np.array(placement.at), placement.turn
    yield at, turn
    if placement.role in ELEMENTS:
        ahead = np.array([math.cos(math.radians(turn)), math.sin(math.radians(turn))])
        yield at + _length(kit, placement) * ahead, turn + 180.0


def _length(kit: Kit, placement: Placement) -> float:
    return float(kit.parts[placement.part].coefficients["edge_length"][:, 0].max())


def _site(
    kit: Kit, kinds: Mapping[str, Joint], at: tuple[float, float], ends: Sequence[_End]
) -> Site:
    """The joint that these ends make: as they fit best, for any of its keys may be the first."""
    fits = []
    for end in ends:
        if end.placement.role == "half_a":
            kind, over = kinds[end.placement.joint], end.placement.flip
            off = Origin(at, 0.0, over).direction(kind.pieces[0].turn)
            origin = Origin(at, (end.turn - off) % 360, over)
            found = _matched(kit, kind, origin, ends)
            if found is not None:
                fits.append((found[0], Site(kind, origin, *found[1:])))
    if not fits:
        letters = {end.placement.joint for end in ends} - {""}
        msg = f"the joint at {at} is as its kind{''.join(f' {letter}' for letter in letters)}"
        raise InvariantError(msg)
    return min(fits, key=lambda fit: fit[0])[1]


def _matched(
    kit: Kit, kind: Joint, origin: Origin, ends: Sequence[_End]
) -> tuple[float, dict[int, int], dict[int, int]] | None:
    """How far these ends are off a joint of a kind, and the part of each piece and key's tube.

    None if they are not such a joint.
    """
    left, worst = list(ends), 0.0

    def take(piece: Placement, role: str | None) -> int | None:
        nonlocal worst
        turn, wanted = origin.direction(piece.turn), (role, piece.part, piece.flip != origin.over)
        for end in left:
            place = end.placement
            off = (end.turn - turn + 180) % 360 - 180
            fits = (
                end.is_element if role is None else (place.role, place.part, place.flip) == wanted
            )
            if abs(off) < _ANGLE and fits:
                left.remove(end)
                worst = max(worst, round(abs(off), _DECIMALS))
                return end.part
        return None

    parts: dict[int, int] = {}
    tubes: dict[int, int] = {}
    for number, piece in enumerate(kind.pieces):
        part = take(piece, piece.role)
        if part is None and (piece.role == "cap" or (piece.role == "peg" and kit.key == "fixed")):
            part = take(piece, None)
        if part is None:
            return None
        parts[number] = part
    for number, piece in enumerate(kind.pieces):
        if piece.role == "half_a" and kit.key == "loose":
            part = take(piece, None)
            if part is not None:
                tubes[number] = part
    return None if left else (worst, parts, tubes)
