"""Keys such that a frame is rows that slide onto parallel pegs, each peg part of a tube.

Parts hang together by whole connectors, in rows.  Two rows are joined by tubes of the one on keys
of the other.  A row comes off if all pegs between it and what is left are parallel, and point the
same way as seen from it; the frame can be put together if all rows come off, one after the other.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.errors import InputError
from scadgen.frame.keys import turned_alike
from scadgen.frame.slots import ANGLE, Keys, Places
from scadgen.solid.affine import Floats, Ints

__all__ = ["choose_keys_in_rows"]

#: Choices of keys for joints that are turned alike that are looked at.
_CHOICES = 20_000

#: Decimals of sums of sines that are compared.
_DECIMALS = 6


def choose_keys_in_rows(places: Places, parts: Callable[[Keys], int]) -> Keys:
    """One slot at each vertex, alike in joints that are turned alike, for rows that slide.

    Of all such choices that with the fewest parts; of these the one whose pegs are most upright,
    so that rows lie along x; and of these the one whose keys are below their joints.

    Parameters
    ----------
    places
        The joints.
    parts
        How many parts a choice needs.

    Raises
    ------
    InputError
        There is no such choice.
    """
    best: tuple[tuple[float, ...], Keys] | None = None
    slots, group = _alike(places)
    number = math.prod(len(some) for some in slots)
    for keys in _choices(places, slots, group, every=number <= _CHOICES):
        sines = np.sin([places.direction(v, slot) for v, (slot,) in enumerate(keys)])
        if not _Rows(places, keys).slide_apart():
            continue
        upright, below = (round(float(s.sum()), _DECIMALS) for s in (-np.abs(sines), sines))
        rank = (parts(keys), upright, below)
        if best is None or rank < best[0]:
            best = rank, keys
    if best is None:
        msg = (
            "key = 'fixed': with pegs that are part of tubes a frame must be rows that slide onto "
            f"parallel pegs, and {_tried(number)} makes this one so; loose pegs fit every frame"
        )
        raise InputError(msg)
    return best[1]


def _tried(number: int) -> str:
    """What was looked at, in words."""
    if number <= _CHOICES:
        return "no choice of keys"
    return f"none of those looked at, of {number} choices of keys,"


def _alike(places: Places) -> tuple[list[list[int]], Ints]:
    """The slots that joints may have keys in which are turned alike, and which these are."""
    *_, group = turned_alike(places)
    first = np.unique(group, return_index=True)[1].tolist()
    counts = [places.counts[places.shape_of[v]][0] for v in first]
    return [
        [slot for slot in range(count) if not places.refuse(v, {slot})]
        for v, count in zip(first, counts, strict=True)
    ], group


def _choices(
    places: Places, slots: list[list[int]], group: Ints, *, every: bool
) -> Iterator[list[tuple[int]]]:
    """One slot for each joint: the most upright ones, below and above; then every choice."""
    first = np.unique(group, return_index=True)[1].tolist()
    if all(slots):
        for sign in (1, -1):
            upright = [
                min(some, key=partial(_height, places, v, sign))
                for v, some in zip(first, slots, strict=True)
            ]
            yield [(upright[n],) for n in group]
    if every:
        for choice in itertools.product(*slots):
            yield [(choice[n],) for n in group]


def _height(places: Places, vertex: int, sign: int, slot: int) -> float:
    """How far up a slot points, or down."""
    return sign * math.sin(places.direction(vertex, slot))


@dataclass(frozen=True, slots=True, eq=False)
class _Peg:
    """A tube of one row on a key of another, and the direction in which it comes off."""

    tube: int
    joint: int
    out: Floats


class _Rows:
    """A frame as rows.

    Parameters
    ----------
    places
        The joints.
    keys
        The slots that have keys, of each vertex.
    """

    def __init__(self, places: Places, keys: Sequence[Sequence[int]]) -> None:
        edges = places.frame.edges
        keyed = np.array(
            [
                [slot in keys[v] for v, slot in zip(*pair, strict=True)]
                for pair in zip(edges.tolist(), places.slots.tolist(), strict=True)
            ]
        )
        whole = edges[~keyed.any(axis=1)]
        size = len(places.frame.vertices)
        graph = coo_array((np.ones(len(whole)), whole.T), shape=(size, size))
        count, row_of = connected_components(graph, directed=False)
        #: Whether whole connectors close a loop, which no element could.
        self.closed = count != size - len(whole)
        self.pegs: list[_Peg] = []
        self.left = set(range(count))
        for pair, ends, slots in zip(
            edges.tolist(), keyed.tolist(), places.slots.tolist(), strict=True
        ):
            if not any(ends):
                continue
            # A tube with two key ends is a row by itself.
            tube = int(row_of[pair[ends.index(False)]]) if not all(ends) else count
            if tube == count:
                self.left.add(count)
                count += 1
            for vertex, slot, has_key in zip(pair, slots, ends, strict=True):
                if has_key:
                    angle = places.direction(vertex, slot)
                    out = np.array([np.cos(angle), np.sin(angle)])
                    self.pegs.append(_Peg(tube, int(row_of[vertex]), out))

    def slide_apart(self) -> bool:
        """Whether all rows come off, one after the other."""
        if self.closed or any(peg.tube == peg.joint for peg in self.pegs):
            return False
        pegs, left = self.pegs, set(self.left)
        while pegs:
            free = {row for row in left if self._is_free(row, pegs)}
            held = [peg for peg in pegs if not free & {peg.tube, peg.joint}]
            if len(held) == len(pegs):
                return False
            pegs, left = held, left - free
        return True

    def _is_free(self, row: int, pegs: Sequence[_Peg]) -> bool:
        """Whether all pegs of a row are parallel and point the same way."""
        ways = [
            peg.out if peg.tube == row else -peg.out for peg in pegs if row in (peg.tube, peg.joint)
        ]
        return all(float(way @ ways[0]) > np.cos(ANGLE) for way in ways)
