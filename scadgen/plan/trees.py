"""Elements and whole connectors that hold each other: trees, and what of them may come out."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from scadgen.interlock.path import Path
from scadgen.plan.choice import Choice, inverse
from scadgen.plan.standing import Standing

__all__ = ["Trees"]


class Trees:
    """What holds what by whole connectors, of some parts.

    Parameters
    ----------
    standing
        The frame.
    table
        Numbers of the parts that are there.
    """

    def __init__(self, standing: Standing, table: set[int]) -> None:
        self._standing = standing
        self._at: dict[int, dict[int, int]] = {}
        for number in sorted({n for part in table for n in standing.sites_of[part]}):
            connectors = standing.sites[number].connectors
            there = {n: part for n, part in connectors.items() if part in table}
            if there:
                self._at[number] = there
        self._joints_of: dict[int, list[int]] = {part: [] for part in table}
        for number, there in self._at.items():
            for part in there.values():
                self._joints_of[part].append(number)
        self.groups = self._grouped(table)

    def _grouped(self, table: set[int]) -> list[frozenset[int]]:
        """The trees."""
        left, found = set(table), []
        while left:
            group = self._beyond(min(left), -1)
            found.append(group)
            left -= group
        return found

    def _beyond(self, part: int, without: int) -> frozenset[int]:
        """A part and all that hangs on it, but for what does at one joint."""
        found, ends = {part}, [(part, without)]
        while ends:
            one, closed = ends.pop()
            for joint in self._joints_of[one]:
                if joint == closed:
                    continue
                new = set(self._at[joint].values()) - found
                found |= new
                ends += [(other, joint) for other in sorted(new)]
        return frozenset(found)

    def choices(self, group: frozenset[int]) -> Iterator[Choice]:
        """What of a tree may come out: what hangs on a connector, or all the rest of a tree.

        A joint's way is proved past all that comes out after it, so that it is tried once what
        comes before it is out.
        """
        side = self._standing.kit.values["side"]
        joints = sorted({joint for part in group for joint in self._joints_of[part]})
        busy = [joint for joint in joints if len(self._at[joint]) > 1]
        if not busy:
            yield self._free(group)
        for joint in busy:
            site, there = self._standing.sites[joint], self._at[joint]
            ways = [w for w in site.kind.ways if len(w.moving) == 1 and w.moving[0] in there]
            if ways:
                path = ways[0].path.scaled(side)
                branch = self._beyond(there[ways[0].moving[0]], joint)
                yield Choice(branch, joint, path, site.pose)
                yield Choice(group - branch, joint, inverse(path), site.pose)

    def _free(self, group: frozenset[int]) -> Choice:
        """What no other holds: straight up."""
        part = min(group)
        joint = (self._joints_of[part] or self._standing.sites_of[part])[0]
        site = self._standing.sites[joint]
        still = Path.through(np.zeros((1, 6)), np.zeros(3))
        return Choice(group, joint, still, site.pose)
