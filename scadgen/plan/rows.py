"""Rows that parallel pegs hold, each of them part of a tube: what of a frame slides off next."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np

from scadgen.interlock.path import Path
from scadgen.plan.choice import Choice
from scadgen.plan.slides import ALONG, clusters, tubes_of
from scadgen.plan.standing import Standing
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Pose

__all__ = ["Rows"]


class Rows:
    """The rows of a frame with fixed pegs.

    Parameters
    ----------
    standing
        The frame.
    """

    def __init__(self, standing: Standing) -> None:
        self._standing = standing
        self._tubes = tubes_of(standing)
        self.left = clusters(standing)

    def choices(self) -> Iterator[list[Choice]]:
        """What may slide off next: single elements, any of them; else one row, the upper first."""
        free = [(row, way) for row in self.left if (way := self._way(row)) is not None]
        alone = [(row, way) for row, way in free if len(row) == 1]
        rows = sorted((one for one in free if len(one[0]) > 1), key=lambda one: -self._up(one[0]))
        for chosen in ([alone] if alone else []) + [[one] for one in rows]:
            yield [self._choice(row, way) for row, way in chosen]

    def take(self, parts: Collection[int]) -> None:
        """Let a row be gone."""
        self.left.remove(frozenset(parts))

    def _up(self, row: Collection[int]) -> float:
        return float(np.mean([self._standing.kit.placements[n].pose.at[1] for n in row]))

    def _way(self, row: frozenset[int]) -> Floats | None:
        """The direction in which a row slides off all pegs, if there is one."""
        there = frozenset().union(*self.left)
        found: Floats | None = None
        for tube in self._tubes:
            inside = tube.element in row
            if inside == (tube.half in row) or not {tube.element, tube.half} <= there:
                continue
            way = tube.out if inside else -tube.out
            if found is not None and float(way @ found) < ALONG:
                return None
            found = way
        return found

    def _choice(self, row: frozenset[int], way: Floats) -> Choice:
        """A row on its way, until a plane across it is between the row and all that is left."""
        standing = self._standing
        side = standing.kit.values["side"]
        joint = min(n for part in row for n in standing.sites_of[part])
        rest = frozenset().union(*self.left) - row
        (_, ahead), (behind, _) = (self._span(group, way) for group in (rest, row))
        far = ahead - behind + side
        steps = np.zeros((2, 6))
        steps[1, 0] = side * np.ceil(far / side)
        path = Path.through(steps, np.zeros(3))
        x, y, z = way.tolist()
        return Choice(row, joint, path, Pose(standing.sites[joint].pose.at, (x, y, z)))

    def _span(self, parts: Collection[int], way: Floats) -> tuple[float, float]:
        """Between what planes across a way some parts are, in mm."""
        kit = self._standing.kit
        some = sorted(parts)
        at = kit.values["edge_length"] * np.array([kit.placements[n].pose.at for n in some]) @ way
        reach = np.array([self._standing.reach(n) for n in some])
        return float((at - reach).min()), float((at + reach).max())
