"""Which connectors and halves of a frame's joints are one part, and what parts are called.

By angles and keys it is known which edges of one kind of joint are alike.  Shapes have more in
common: the walls beside a key stand alike in wide gaps, so that joints whose rings are equally
large often have the same halves.  What is one shape is one part, named by the first joint and
edge, of those that are not alike by angles and keys, that has it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import astuple, dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from scadgen.element.pieces import Piece
from scadgen.element.squares import Key
from scadgen.errors import InvariantError
from scadgen.frame.classes import joint_name
from scadgen.frame.element_classes import Slots
from scadgen.joint.symmetry import Symmetry
from scadgen.kit.pieces import Pieces
from scadgen.solid.affine import Floats

__all__ = ["Named", "NamedPiece", "alike_pieces"]

#: Decimals to which keys are compared, in sides.
_DECIMALS = 9

#: Means over the points of one shape differ by less, in sides and their squares: points may be off
#: by a millionth of a side, and are at most a dozen sides away.
_NEAR = 1e-4

#: A kind of joint by its number, and one of its slots.
_Place = tuple[int, int]


def _firsts(values: Sequence[Hashable]) -> list[int]:
    """For each value, which is the first that is the same."""
    first: dict[Hashable, int] = {}
    return [first.setdefault(value, n) for n, value in enumerate(values)]


def _alike_keys(keys: Sequence[Key]) -> list[int]:
    """For each key, which is the first that is the same but for rounding."""
    return _firsts(
        [
            tuple(round(v, _DECIMALS) if isinstance(v, float) else v for v in astuple(key))
            for key in keys
        ]
    )


def alike_pieces(
    pieces: Sequence[Piece], groups: Sequence[Hashable], *, turned: bool
) -> list[tuple[int, bool]]:
    """For each piece, which is the first that is the same part, and if that is turned over for it.

    Parameters
    ----------
    pieces
        Connectors, or halves.
    groups
        For each something that is the same in those that may be the same part.
    turned
        Whether they may be turned over about their edges for it.
    """
    found = [(number, False) for number in range(len(pieces))]
    for numbers in _sizes(pieces, groups).values():
        means = np.array([_means(pieces[number]) for number in numbers])
        near = cKDTree(means).query_ball_point(means, _NEAR)
        for own, others in zip(numbers, near, strict=True):
            before = (numbers[n] for n in sorted(others) if numbers[n] < own)
            for other in (n for n in before if found[n] == (n, False)):
                over = _turn(pieces[own], pieces[other], turned=turned)
                if over is not None:
                    found[own] = other, over
                    break
    return found


def _sizes(pieces: Sequence[Piece], groups: Sequence[Hashable]) -> Mapping[Hashable, Sequence[int]]:
    """Numbers of the pieces that are equally large tables, by group."""
    found: dict[Hashable, list[int]] = defaultdict(list)
    for number, (piece, group) in enumerate(zip(pieces, groups, strict=True)):
        found[group, len(piece.surface.points), len(piece.surface.walls)].append(number)
    return found


def _means(piece: Piece) -> Floats:
    """What is the same in shapes that are the same, one of them turned over or not."""
    x, y, z = piece.surface.points.T
    return np.array([v.mean() for v in (x, x * x, y * y, z * z, y * z)])


def _turn(piece: Piece, other: Piece, *, turned: bool) -> bool | None:
    """Whether a piece is another one turned over, or is that itself; None if it is neither."""
    if piece.is_like(other):
        return False
    return True if turned and piece.is_like(other.turned_over()) else None


@dataclass(frozen=True, slots=True, eq=False)
class NamedPiece:
    """A connector or a half that is a part, with the first place that has it.

    Parameters
    ----------
    number, slot
        The kind of joint, and the slot.
    key
        What the keys of that joint are like.
    piece
        Its shape.
    second
        Whether it is half B turned over, where that is another shape than half A.
    """

    number: int
    slot: int
    key: Key
    piece: Piece
    second: bool = False


@dataclass(frozen=True, eq=False)
class Named:
    """The parts of a frame's joints.

    Parameters
    ----------
    pieces
        Of each kind of joint.
    symmetries
        Which slots of each are alike by angles and keys.
    plain
        Whether there is but one connector and one half, so that names need no letters.
    """

    pieces: Sequence[Pieces]
    symmetries: Sequence[Symmetry]
    plain: bool = False

    @cached_property
    def sockets(self) -> list[int]:
        """For each kind of joint, the first whose keys are the same."""
        return _alike_keys([one.key for one in self.pieces])

    @cached_property
    def _connectors(self) -> dict[_Place, tuple[_Place, bool]]:
        """For each connector, the first that is the same part, and if it is turned over for it."""
        places = [(n, slot) for n, one in enumerate(self.symmetries) for slot in one.firsts]
        shapes = [self.pieces[n].connectors[slot] for n, slot in places]
        found = alike_pieces(shapes, [self.sockets[n] for n, _ in places], turned=True)
        return {
            place: (places[first], over) for place, (first, over) in zip(places, found, strict=True)
        }

    @property
    def _different(self) -> list[_Place]:
        """The connectors that are different parts."""
        return list(dict.fromkeys(first for first, _ in self._connectors.values()))

    @cached_property
    def slots(self) -> Slots:
        """What is alike, by the kind of joint and the slot.

        Raises
        ------
        InvariantError
            What is alike by angles and keys is not one shape.
        """
        slots = Slots.of(self.symmetries)
        count = slots.most
        what, over, either = slots.what.copy(), slots.over.copy(), slots.either.copy()
        for number, one in enumerate(self.pieces):
            _check_alike(one, self.symmetries[number])
            for slot in range(len(one.connectors)):
                own, turned = self.symmetries[number].alike(slot)
                first, flip = self._connectors[number, own]
                what[number, slot] = first[0] * count + first[1]
                over[number, slot] = turned != flip
        for number, slot in self._different:
            mine = what == number * count + slot
            either[mine] = either[mine].any() or _is_even(self.pieces[number].connectors[slot])
        return Slots(what, over & ~either, either)

    def connector(self, number: int, slot: int) -> tuple[str, bool]:
        """The part that is a slot's connector, and whether it is turned over."""
        what, over = self.slots.what[number, slot], self.slots.over[number, slot]
        return self._name("connector", *divmod(int(what), self.slots.most)), bool(over)

    @property
    def connectors(self) -> dict[str, NamedPiece]:
        """The connectors that are different parts, by name."""
        return {
            self._name("connector", *place): self._named(place, self._connector_at(place))
            for place in self._different
        }

    def _connector_at(self, place: _Place) -> Piece:
        number, slot = place
        return self.pieces[number].connectors[slot]

    def _named(self, place: _Place, piece: Piece) -> NamedPiece:
        return NamedPiece(*place, self.pieces[place[0]].key, piece)

    def _name(self, what: str, number: int, slot: int) -> str:
        return what if self.plain else f"{what}_{joint_name(number)}{slot + 1}"

    @cached_property
    def _own_halves(self) -> dict[tuple[_Place, str], Piece]:
        """Halves A, and halves B turned over, of the first of all slots that are alike."""
        return {
            ((number, slot), which): piece
            for number, one in enumerate(self.pieces)
            for slot in sorted({self.symmetries[number].alike(slot)[0] for slot in one.halves})
            for which, piece in zip(("", "_over"), one.halves[slot], strict=True)
        }

    @cached_property
    def _half_names(self) -> dict[tuple[_Place, str], str]:
        """What they are called."""
        groups = [self.sockets[number] for (number, _), _ in self._own_halves]
        found = alike_pieces([*self._own_halves.values()], groups, turned=False)
        names = [self._name("half", *place) + which for place, which in self._own_halves]
        return {own: names[n] for own, (n, _) in zip(self._own_halves, found, strict=True)}

    def half_names(self, number: int, slot: int) -> tuple[str, str]:
        """Names of half A and half B of a slot, the same where they are the same part."""
        first, over = self.symmetries[number].alike(slot)
        half_a, half_b = (self._half_names[(number, first), which] for which in ("", "_over"))
        return (half_b, half_a) if over else (half_a, half_b)

    @property
    def halves(self) -> dict[str, NamedPiece]:
        """The halves that are different parts, by name."""
        found: dict[str, NamedPiece] = {}
        for own, name in self._half_names.items():
            place, which = own
            first = self._named(place, self._own_halves[own])
            found.setdefault(name, replace(first, second=bool(which)))
        return found

    @cached_property
    def _pegs(self) -> list[int]:
        """For each kind of joint, the first whose pegs start in the same place."""
        return _firsts([round(one.key.pad, _DECIMALS) for one in self.pieces])

    def peg(self, number: int) -> str:
        """Name of a joint's peg."""
        return f"peg_{joint_name(self._pegs[number])}" if any(self._pegs) else "peg"

    @property
    def pegs(self) -> dict[str, int]:
        """The pegs that are different parts, by name: the kind of joint that each is of."""
        return {self.peg(number): number for number in dict.fromkeys(self._pegs)}


def _is_even(piece: Piece) -> bool:
    """Whether a connector is itself turned over."""
    _, y, z = piece.surface.points.mean(axis=0)
    return max(abs(y), abs(z)) < _NEAR and piece.is_like(piece.turned_over())


def _check_alike(pieces: Pieces, symmetry: Symmetry) -> None:
    """See to it that what is alike by angles and keys is one part."""
    for slot, piece in enumerate(pieces.connectors):
        first, over = symmetry.alike(slot)
        other = pieces.connectors[first]
        if piece is not other and not piece.is_like(other.turned_over() if over else other):
            msg = f"connectors of edges that are alike are the same: {slot} and {first} are not"
            raise InvariantError(msg)
