"""What a step's picture shows, and where: the frame from above, in mm."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from scadgen.plan.model import Move, Plan
from scadgen.plan.motion import joints_of, motion_of
from scadgen.plan.outlines import Outlines
from scadgen.solid.affine import Floats

__all__ = ["Shown", "ahead"]

#: How far a row that slides in is drawn from its place, in median edge elements.
_AWAY = 0.4

#: How far beyond a tube's start its mark is, in sides.
_BEYOND = 0.5


class Shown:
    """A step as it is shown.

    Parameters
    ----------
    plan
        The plan.
    outlines
        Outlines of its parts.
    number
        The step's number, from 1.
    tables
        Sets of parts that are joined after it.
    """

    def __init__(
        self, plan: Plan, outlines: Outlines, number: int, tables: Iterable[frozenset[int]]
    ) -> None:
        self._plan, self._outlines, self._number = plan, outlines, number
        kit = plan.standing.kit
        self._side, self._unit = kit.values["side"], kit.values["edge_length"]
        self.motions = {move: motion_of(plan, move) for move in plan.steps[number - 1].moves}
        self.moving = {part for move in self.motions for part in move.parts}
        near = set[int]().union(*(table for table in tables if table & self.moving))
        self.there = near - self.moving
        self.later = set[int]().union(*tables) - near
        lengths = [plan.standing.length(part) for part in plan.standing.elements]
        self._far = _AWAY * self._unit * float(np.median(lengths))
        self._away = {
            part: -self._far * ahead(motion.towards)
            for move, motion in self.motions.items()
            if motion.towards is not None and motion.slides
            for part in move.parts
        }
        if self._away:  # what is joined elsewhere would be where these are drawn
            self.later = set()

    def away(self, part: int) -> Floats:
        """How far from its place a part is drawn."""
        return self._away.get(part, np.zeros(2))

    def at(self, part: int) -> Floats:
        """Where a part's origin is drawn."""
        place = self._plan.standing.kit.placements[part]
        return self._unit * np.array(place.pose.at)[:2] + self.away(part)

    def box(self) -> tuple[Floats, Floats]:
        """Lower and upper corner of all that is drawn."""
        drawn = self.there | self.later | self.moving
        points = np.vstack([self._outlines.corners(part) + self.away(part) for part in drawn])
        return points.min(axis=0), points.max(axis=0)

    def middle(self, part: int) -> Floats:
        """The middle of an element's axis, or about that of another part."""
        standing = self._plan.standing
        if part in standing.elements:
            half = self._unit * standing.length(part) / 2
            return np.asarray(
                self.at(part) + half * np.array(standing.kit.placements[part].pose.x)[:2]
            )
        corners = self._outlines.corners(part)
        return np.asarray((corners.min(axis=0) + corners.max(axis=0)) / 2 + self.away(part))

    def joints(self) -> Iterator[tuple[int, Floats, bool]]:
        """Number and place of each joint that is there, and whether something goes in."""
        plan, step = self._plan, self._number
        busy = {joint for move in self.motions for joint in joints_of(plan, step, move)}
        there = self.there | self.later | self.moving
        for number, site in enumerate(plan.standing.sites):
            # A tube that stands on a peg of its own does not belong to the joint.
            own = site.pieces("half_a", "half_b", "cap")
            if there.intersection(site.parts[piece] for piece in own):
                away = self.away(site.parts[site.pieces("half_a")[0]])
                yield number, self._unit * np.array(site.pose.at)[:2] + away, number in busy

    def marks(self, move: Move) -> Iterator[Floats]:
        """Where it is marked how a move goes in: at its part, or before each of its pegs."""
        motion, sites = self.motions[move], self._plan.standing.sites
        if not motion.slides or motion.towards is None:
            own = {*sites[move.joint].parts.values(), *sites[move.joint].tubes.values()}
            yield self._end(next(part for part in move.parts if part in own), move.joint)
            return
        for number in joints_of(self._plan, self._number, move):
            site, moving = sites[number], set(move.parts)
            halves = {site.parts[n] for n in site.pieces("half_a")}
            side = 1.0 if halves & moving else -1.0
            start = side * self._side * site.kind.key.tube_start
            gap = (start - self._far / 2) * ahead(motion.towards)
            yield self._unit * np.array(site.pose.at)[:2] + gap

    def _end(self, part: int, joint: int) -> Floats:
        """The end of an element at a joint; of another part, where its tube would start."""
        standing = self._plan.standing
        site = standing.sites[joint]
        centre = self._unit * np.array(site.pose.at)[:2]
        if part not in standing.elements:
            start = self._side * site.kind.key.tube_start
            return np.asarray(centre + start * np.array(standing.kit.placements[part].pose.x)[:2])
        way = self.middle(part) - centre
        reach = self._side * (site.kind.key.tube_start + _BEYOND)
        return np.asarray(centre + way * min(reach / float(np.linalg.norm(way)), 1.0))


def ahead(degrees: float) -> Floats:
    """The unit vector in a direction."""
    return np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees))])
