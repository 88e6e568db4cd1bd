"""Which parts of a frame slide off pegs together, to first order: rows, mostly.

Parts at a joint hang together but for the tubes on its keys, which slide along their pegs: out
of the joint, not into it.  So to move along a direction, some take others along, and what takes
along nothing but itself slides off.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.plan.standing import Standing
from scadgen.solid.affine import Floats

__all__ = ["ALONG", "KeyedTube", "clusters", "sliding", "tubes_of"]

#: Cosine of the angle up to which directions are the same.
ALONG = 1 - 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class KeyedTube:
    """A tube on a key.

    Parameters
    ----------
    element, half
        Numbers of its part and of the key's half A.
    out
        ``(3,) float``: unit vector along which it slides out of the joint.
    """

    element: int
    half: int
    out: Floats


def tubes_of(standing: Standing) -> list[KeyedTube]:
    """All tubes on keys."""
    found = []
    for site in standing.sites:
        for half, element in standing.keys(site).items():
            if element is not None:
                found.append(KeyedTube(element, site.parts[half], site.direction(half)))
    return found


def clusters(standing: Standing) -> list[frozenset[int]]:
    """Parts that hang together but for tubes on keys."""
    pairs = []
    for site in standing.sites:
        keyed = {element for element in standing.keys(site).values() if element is not None}
        own = [part for part in site.parts.values() if part not in keyed]
        pairs += [(own[0], part) for part in own]
    size = len(standing.kit.placements)
    rows, columns = np.array(pairs).T
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(size, size))
    count, label = connected_components(graph, directed=False)
    return _members(label, count)


def sliding(standing: Standing) -> Iterator[tuple[frozenset[int], Floats]]:
    """Sets of parts that slide off as one, each with its direction, as small as they can be."""
    groups, tubes = clusters(standing), tubes_of(standing)
    every = frozenset(range(len(standing.kit.placements)))
    of_part = {part: number for number, group in enumerate(groups) for part in group}
    ends = [(of_part[tube.element], of_part[tube.half], tube.out) for tube in tubes]
    ways = np.unique(np.round([sign * out for *_, out in ends for sign in (1, -1)], 6), axis=0)
    for way in ways + 0.0:
        pairs = []
        for element, joint, out in ends:
            along = float(out @ way)
            pairs += [(joint, element)] * (along > -ALONG) + [(element, joint)] * (along < ALONG)
        rows, columns = np.array(pairs).T
        size = len(groups)
        graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(size, size))
        count, label = connected_components(graph, directed=True, connection="strong")
        takes = {int(a) for a, b in zip(label[rows], label[columns], strict=True) if a != b}
        for number in sorted(set(range(count)) - takes):
            members = np.flatnonzero(label == number)
            parts = frozenset().union(*(groups[n] for n in members))
            # A component of the frame that goes as a whole slides off nothing.
            if standing.meeting(parts, every - parts):
                yield parts, way


def _members(label: NDArray[np.integer], count: int) -> list[frozenset[int]]:
    order = np.argsort(label, kind="stable")
    ends = np.searchsorted(label[order], np.arange(1, count))
    return [frozenset(group.tolist()) for group in np.split(order, ends)]
