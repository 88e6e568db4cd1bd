"""Which connectors of a frame's joints are split, so that it can be put together.

An element with whole connectors at both ends cannot close a loop of such elements: the edges
whose ends are both whole are a forest.  Every other edge has a key at one end at least, and
every vertex has one.  So n vertices and m edges take max(n, m - n + 1) keys or more.

The fewest parts come from joints that are alike.  In this order are tried: one key, the same in
all joints of a shape; one key, the same in all joints of a shape with the same side up; one key,
the same in those that are turned alike as well; what takes few keys, wherever they are; and
instead of that several keys, the same in all joints of a shape, where the frame is so dense that
it gives fewer parts.  Joints that were refused with their keys where they were are kept out of
all of these as far as that goes.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Iterator, Sequence

import numpy as np

from scadgen.frame.few_keys import FewKeys, forests
from scadgen.frame.slots import Keys, Places, is_forest, same_angles
from scadgen.solid.affine import Ints

__all__ = ["choose_keys", "turned_alike"]

#: Choices for alike joints that are looked at, and how many edges they may have in all.
_CHOICES, _EDGES = 5000, 2_000_000

#: Keys that alike joints may have: next to each other, for so they are known to lock.
_KEYS = 4


def choose_keys(places: Places, parts: Callable[[Keys], int]) -> Keys:
    """The slots that have keys at each vertex.

    Parameters
    ----------
    places
        The joints.
    parts
        How many parts a choice needs.
    """
    for group in (places.shape_of, *turned_alike(places)):
        alike = _alike(places, group, 1, parts)
        if alike is not None:
            return alike
    few = min((FewKeys(places, whole).chosen() for whole in forests(places.frame)), key=parts)
    several = _alike(places, places.shape_of, _KEYS, parts)
    return few if several is None or parts(few) <= parts(several) else several


def turned_alike(places: Places) -> Iterator[Ints]:
    """A number for each vertex, the same for joints of one shape with the same side up.

    Then the same for those that are turned alike as well.
    """
    columns = [places.shape_of, places.over, same_angles(places.turn)]
    for count in (2, 3):
        alike = np.column_stack(columns[:count])
        yield np.asarray(np.unique(alike, axis=0, return_inverse=True)[1]).ravel()


def _alike(places: Places, group: Ints, most: int, parts: Callable[[Keys], int]) -> Keys | None:
    """The choice with the fewest keys, and of these the fewest parts, alike in each group.

    None where none is enough, or there are too many to look at.
    """
    first = np.unique(group, return_index=True)[1]
    counts = [places.counts[n] for n in places.shape_of[first]]
    # Turned by a symmetry of all joints of a shape, a choice is the same.
    by_shape = len(first) == len(places.counts)
    runs = [
        [
            slots
            for slots in _runs(count, period if by_shape else count, most)
            if not places.refuse(vertex, slots)
        ]
        for vertex, (count, period) in zip(first.tolist(), counts, strict=True)
    ]
    number = math.prod(len(choices) for choices in runs)
    if number > min(_CHOICES, _EDGES // max(1, len(places.slots))):
        return None
    size = np.bincount(group)
    best: tuple[int, int] | None = None
    found: Keys | None = None
    for choice in sorted(itertools.product(*runs), key=lambda c: _keys(c, size)):
        pegs = _keys(choice, size)
        if best is not None and pegs > best[0]:
            break
        if _is_enough(places, group, choice):
            keys = [choice[n] for n in group]
            cost = pegs, parts(keys)
            if best is None or cost < best:
                best, found = cost, keys
    return found


def _keys(choice: Sequence[Collection[int]], size: Ints) -> int:
    """How many keys a choice for each group takes."""
    return int(size @ [len(slots) for slots in choice])


def _runs(count: int, period: int, most: int) -> Iterator[tuple[int, ...]]:
    """Slots next to each other, from one on."""
    for length, start in itertools.product(range(1, min(most, count) + 1), range(period)):
        yield tuple(sorted((start + n) % count for n in range(length)))


def _is_enough(places: Places, group: Ints, choice: Sequence[Collection[int]]) -> bool:
    """Whether the edges that no key is on close no loop."""
    split = np.zeros((len(choice), max(count for count, _ in places.counts)), dtype=bool)
    for n, slots in enumerate(choice):
        split[n, list(slots)] = True
    edges = places.frame.edges
    whole = ~split[group[edges], places.slots].any(axis=1)
    return is_forest(edges[whole], len(group))
