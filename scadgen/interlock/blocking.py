"""Which parts have to move together: for a direction, who pushes whom, and so on to the end.

Parts that a contact pushes move along, and what they push too.  For each direction this gives
the least groups that can begin to move that way as one (Wilson and Latombe, Geometric reasoning
about mechanical assembly, 1994: the blocking graph of a direction).  It changes only where a
direction crosses the plane of a contact, so these directions do: normals, lines in which two
such planes meet, and some all round for what is between them.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from scadgen.interlock.contacts import Contacts
from scadgen.interlock.scene import all_round
from scadgen.solid.affine import Floats, Ints

__all__ = ["movable_groups"]

#: Normals that planes are crossed of at most: those of most contacts.
_NORMALS = 18

#: Cosine above which a contact pushes.
_PUSHES = 1e-3

#: Decimals by which directions are told apart.
_DECIMALS = 4


def movable_groups(
    contacts: Contacts, present: Collection[int], stays: Collection[int]
) -> dict[tuple[int, ...], Floats]:
    """Groups of parts that can begin to move straight as one while the others stand still.

    Parameters
    ----------
    contacts
        Where parts touch.
    present
        Numbers of the parts that are there.
    stays
        Those of them that do not move.

    Returns
    -------
    groups
        For each, ascending, the directions in which it is the least group of one of its parts,
        ``(k, 3) float``; the smallest groups first.
    """
    parts = sorted(present)
    place = np.full(max(parts) + 1, -1)
    place[parts] = np.arange(len(parts))
    there = np.isin(contacts.first, parts) & np.isin(contacts.second, parts)
    mine = contacts.some(np.flatnonzero(there))
    normals, pairs = _distinct(mine, place)
    directions = _directions(normals)
    pushed = _closed(_pushes(normals, pairs, directions, len(parts)))
    free = ~pushed[:, :, place[sorted(stays)]].any(axis=2)
    found: dict[tuple[int, ...], list[int]] = {}
    for way, part in np.argwhere(free).tolist():
        group = tuple(parts[n] for n in np.flatnonzero(pushed[way, part]))
        ways = found.setdefault(group, [])
        if not ways or ways[-1] != way:
            ways.append(way)
    order = sorted(found, key=lambda group: (len(group), group))
    return {group: directions[found[group]] for group in order}


def _distinct(contacts: Contacts, place: Ints) -> tuple[Floats, Ints]:
    """Normals of contacts, each once for two parts, and these parts' places; most used first."""
    if not len(contacts):
        return np.empty((0, 3)), np.empty((0, 2), dtype=np.int64)
    table = np.column_stack(
        [
            place[contacts.first],
            place[contacts.second],
            contacts.normals.round(_DECIMALS) + 0.0,
        ]
    )
    unique, first, count = np.unique(table, axis=0, return_index=True, return_counts=True)
    order = np.argsort(-count, kind="stable")
    return contacts.normals[first[order]], unique[order, :2].astype(np.int64)


def _directions(normals: Floats) -> Floats:
    """Unit vectors at which the groups are looked for."""
    some = _lines(normals)[:_NORMALS]
    one, other = np.triu_indices(len(some), 1)
    crossed = _lines(np.cross(some[one], some[other]))
    lines = np.concatenate([np.eye(3), some, crossed])
    return _unique(np.concatenate([lines, -lines, all_round()]))


def _lines(vectors: Floats) -> Floats:
    """Vectors of length 1, those that are on one line once."""
    length = np.linalg.norm(vectors, axis=1)
    sound = length > _PUSHES
    unit = vectors[sound] / length[sound, None]
    rounded = unit.round(_DECIMALS)
    sign = np.sign(rounded[np.arange(len(unit)), (rounded != 0).argmax(axis=1)])
    return _unique(unit * sign[:, None])


def _unique(vectors: Floats) -> Floats:
    """Those that no earlier one is much like."""
    _, first = np.unique(vectors.round(_DECIMALS) + 0.0, axis=0, return_index=True)
    return vectors[np.sort(first)]


def _pushes(normals: Floats, pairs: Ints, directions: Floats, count: int) -> np.ndarray:
    """Whether a part that moves in a direction pushes another, ``(k, count, count)``."""
    pushes = np.zeros((len(directions), count, count), dtype=bool)
    along = directions @ normals.T
    for sign, (one, other) in ((1, pairs.T), (-1, pairs.T[::-1])):
        way, contact = np.nonzero(sign * along > _PUSHES)
        pushes[way, one[contact], other[contact]] = True
    return pushes


def _closed(pushes: np.ndarray) -> np.ndarray:
    """Whether a part pushes another by way of others, or is it."""
    reached = pushes | np.eye(pushes.shape[1], dtype=bool)
    while True:
        further = np.matmul(reached.astype(np.float32), reached.astype(np.float32)) > 0
        if (further == reached).all():
            return reached
        reached = further
