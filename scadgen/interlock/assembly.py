"""An assembly as a system of inequalities.

To first order a rigid part moves by a translation t and a rotation w about its middle o.  At
a contact c with normal n from part a to part b, the parts do not enter each other if

    n . [(t_b + w_b x (c - o_b)) - (t_a + w_a x (c - o_a))] >= 0.

Rotations are scaled by the parts' sizes, so that all unknowns are lengths of one order.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from scadgen.errors import InputError
from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.solid.affine import Floats, Ints

__all__ = ["Assembly", "extreme_rows", "largest_part", "make_assembly"]

#: Directions in which the extreme contacts of each two parts are looked for.
_DIRECTIONS = 48


@dataclass(frozen=True, slots=True, eq=False)
class Assembly:
    """Parts, some held fast, and their contacts.

    Parameters
    ----------
    contacts
        The contacts.
    middles
        ``(parts, 3) float``: where the parts turn about.
    sizes
        ``(parts,) float``: half diagonals of the parts' boxes.
    free
        Numbers of the parts that are not held, at least one, ascending.
    rows
        ``(k, 6 len(free))``: a row a contact; columns are a free part's translation and its
        rotation times its size.
    """

    contacts: Contacts
    middles: Floats
    sizes: Floats
    free: tuple[int, ...]
    rows: csr_array

    def only(self, part: int, which: Ints) -> Assembly:
        """The same with one part free and all others held, on some of the contacts."""
        contacts = self.contacts.some(which)
        rows = _rows(contacts, self.middles, self.sizes, (part,))
        return Assembly(contacts, self.middles, self.sizes, (part,), rows)


def largest_part(meshes: Sequence[Mesh]) -> int:
    """Number of the part with the largest box, which is held if nobody says which."""
    return int(np.argmax([np.ptp(points, axis=0).prod() for points, _ in meshes]))


def make_assembly(meshes: Sequence[Mesh], contacts: Contacts, held: Collection[int]) -> Assembly:
    """Set up the inequalities of an assembly.

    Parameters
    ----------
    meshes
        The parts.
    contacts
        Where they touch.
    held
        Numbers of the parts that are held: some, but not all.

    Raises
    ------
    InputError
        No part is held, or all are, or one that does not exist.
    """
    count = len(meshes)
    if not set(held) <= set(range(count)):
        msg = f"held = {sorted(held)}: must be numbers of parts, 0 to {count - 1}"
        raise InputError(msg)
    free = tuple(n for n in range(count) if n not in set(held))
    if not 0 < len(free) < count:
        msg = f"{count - len(free)} of {count} parts are held: must be some of them, not all"
        raise InputError(msg)
    low = np.array([points.min(axis=0) for points, _ in meshes])
    high = np.array([points.max(axis=0) for points, _ in meshes])
    middles, sizes = (low + high) / 2, np.linalg.norm(high - low, axis=1) / 2
    return Assembly(contacts, middles, sizes, free, _rows(contacts, middles, sizes, free))


def _rows(contacts: Contacts, middles: Floats, sizes: Floats, free: tuple[int, ...]) -> csr_array:
    """One inequality a contact."""
    column = np.full(len(middles), -1)
    column[list(free)] = np.arange(len(free))
    blocks = []
    for side, sign in ((contacts.second, 1.0), (contacts.first, -1.0)):
        mine = np.flatnonzero(column[side] >= 0)
        part, normal = side[mine], contacts.normals[mine]
        arm = np.cross(contacts.points[mine] - middles[part], normal) / sizes[part, None]
        values = sign * np.concatenate([normal, arm], axis=1)
        where = 6 * column[part][:, None] + np.arange(6)
        blocks.append((values.ravel(), np.repeat(mine, 6), where.ravel()))
    values, row, where = (np.concatenate(parts) for parts in zip(*blocks, strict=True))
    return csr_array((values, (row, where)), shape=(len(contacts), 6 * len(free)))


def extreme_rows(assembly: Assembly) -> Ints:
    """Numbers of a few contacts that stand for most: the extreme ones of each two parts.

    A contact that is a mean of others of the same parts says nothing new.  Those that are
    farthest in some direction, as six numbers, are no such means.
    """
    contacts = assembly.contacts
    pair = contacts.first * len(assembly.middles) + contacts.second
    order = np.argsort(pair, kind="stable")
    new = np.diff(pair[order], prepend=-1) != 0
    start, group = np.flatnonzero(new), np.cumsum(new) - 1
    points, normals = contacts.points[order], contacts.normals[order]
    count = np.bincount(group)
    arm = points - (np.add.reduceat(points, start) / count[:, None])[group]
    size = np.maximum.reduceat(np.linalg.norm(arm, axis=1), start)[group, None]
    row = np.column_stack([normals, np.cross(arm, normals) / np.maximum(size, 1e-300)])
    chosen = []
    for direction in np.random.default_rng(0).normal(size=(_DIRECTIONS, 6)):
        along = row @ direction
        top = np.flatnonzero(along >= np.maximum.reduceat(along, start)[group])
        chosen.append(top[np.diff(group[top], prepend=-1) != 0])
    return np.unique(order[np.concatenate(chosen)])
