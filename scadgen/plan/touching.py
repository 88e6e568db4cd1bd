"""Contacts of a frame without clearance: found once for each kind of joint, placed at every one.

There are many.  A frame is locked if a few of them lock it, so that extreme ones are enough to
prove that; and whether something moves straight depends on their directions alone.  So all of
them together are only needed where these few do not lock.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from scadgen.check.locking import TOUCH
from scadgen.check.pieces import key_tubes, pieces
from scadgen.interlock.assembly import extreme_rows, make_assembly
from scadgen.interlock.contacts import Contacts, Mesh, find_contacts
from scadgen.kit.model import Joint
from scadgen.plan.standing import Standing
from scadgen.solid.affine import Ints

__all__ = ["Touching"]

#: Decimals of the directions that are the same.
_DECIMALS = 9


class Touching:
    """Contacts between all parts of a frame, in mm.

    Parameters
    ----------
    standing
        The frame.
    """

    def __init__(self, standing: Standing) -> None:
        self._standing = standing
        kinds = {id(site.kind): site.kind for site in standing.sites}
        self._kinds = {key: _Kind(standing, kind) for key, kind in kinds.items()}

    def all(self) -> Contacts:
        """All of them."""
        return self._placed(lambda kind: kind.contacts)

    def extreme(self) -> Contacts:
        """A few that stand for most: what these lock, all lock."""
        return self._placed(lambda kind: kind.extreme)

    def directions(self) -> Contacts:
        """One for each direction between two parts: what they let go straight, all let go."""
        return self._placed(lambda kind: kind.directions)

    def _placed(self, some: Callable[[_Kind], Contacts]) -> Contacts:
        """Some contacts of each kind at every joint of that kind."""
        unit = self._standing.kit.values["edge_length"]
        found = []
        for site in self._standing.sites:
            kind = self._kinds[id(site.kind)]
            contacts, count = some(kind), len(site.kind.pieces)
            own = [site.parts[n] for n in range(count)]
            parts = np.array(own + [site.tubes.get(n, -1) for n in kind.tubes])
            first, second = parts[contacts.first], parts[contacts.second]
            kept = np.flatnonzero((first >= 0) & (second >= 0) & (first != second))
            pose = site.pose.scaled(unit)
            points, normals = pose.apply(contacts.points[kept]), pose.turn(contacts.normals[kept])
            found.append((points, normals, first[kept], second[kept]))
        return Contacts(*(np.concatenate(column) for column in zip(*found, strict=True)))


class _Kind:
    """Contacts of a kind of joint: its pieces, and then the tubes that loose pegs go into."""

    def __init__(self, standing: Standing, kind: Joint) -> None:
        kit = standing.kit
        values = {**kit.values, "clearance": 0.0, "peg_clearance": 0.0}
        tubes = key_tubes(kind, values) if kit.key == "loose" else {}
        self.tubes = tuple(tubes)
        self._meshes: list[Mesh] = [*pieces(kit, kind, values), *tubes.values()]
        self.contacts = find_contacts(self._meshes, TOUCH * values["side"])

    @cached_property
    def extreme(self) -> Contacts:
        few: Ints = extreme_rows(make_assembly(self._meshes, self.contacts, (0,)))
        return self.contacts.some(few)

    @cached_property
    def directions(self) -> Contacts:
        pairs = np.column_stack([self.contacts.first, self.contacts.second])
        rows = np.hstack([pairs, self.contacts.normals.round(_DECIMALS)])
        _, one = np.unique(rows, axis=0, return_index=True)
        return self.contacts.some(np.sort(one))
