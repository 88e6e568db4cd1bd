"""The order: a frame taken apart step by step, which backwards puts it together.

What has come out cannot be in the way of anything later, so that whatever is proved to come
out may be taken out at once: no choice leads astray.

1. Where pegs are part of tubes, rows: all pegs between a row and the rest are parallel, and
   the row slides off them as one.
2. The pegs that are parts of their own, each on its joint's proved way.
3. The halves, likewise.
4. The elements and whole connectors.  Those that hold each other form trees, for elements with
   whole connectors at both ends close no loop.  So there always is a joint where all that
   hangs on all its connectors but one are single parts: one of them comes out on its joint's
   way, or all of them together do, as the last one would out of them.

Moves of a step are proved with all there that is there before any of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from scadgen.errors import InputError
from scadgen.interlock.path import Path
from scadgen.kit.model import Kit, Way
from scadgen.plan.choice import Choice, cut_ways, reflected
from scadgen.plan.model import Move, Plan, Step
from scadgen.plan.proof import Found, Prover
from scadgen.plan.rows import Rows
from scadgen.plan.search import WaySearch
from scadgen.plan.standing import Standing, StandingJoint, stand
from scadgen.plan.trees import Trees

__all__ = ["make_plan"]

#: Choices for which a way is searched, where no known one is proved for any.
_SEARCHED = 4


def make_plan(kit: Kit, say: Callable[[float, str], None] = lambda *_: None) -> Plan:
    """Plan how a kit's frame is put together.

    Parameters
    ----------
    kit
        The kit, with ways out of its joints.
    say
        Told what share of the parts is done, and what is being looked at.

    Raises
    ------
    InputError
        It has no frame, or no ways.
    """
    if not kit.proved:
        msg = (
            "the kit is unchecked, so that no ways out of its joints are known; make it again "
            "without --unchecked"
        )
        raise InputError(msg)
    return _Planner(stand(kit), say).plan()


class _Planner:
    """Takes a frame apart."""

    def __init__(self, standing: Standing, say: Callable[[float, str], None]) -> None:
        self._standing, self._say = standing, say
        self._side, self._unit = standing.kit.values["side"], standing.kit.values["edge_length"]
        self._prover = Prover(standing)
        self._search = WaySearch(standing, self._prover)
        self._tables: list[set[int]] = [set(range(len(standing.kit.placements)))]
        self._steps: list[Step] = []
        self._done = self._told = 0

    def plan(self) -> Plan:
        """The plan: what comes out last goes in first."""
        if self._standing.kit.key == "fixed":
            self._rows()
        self._pieces("pegs", ("peg",))
        self._pieces("halves", ("half_a", "half_b"))
        self._connectors()
        steps = tuple(
            Step(step.what, tuple(sorted(step.moves, key=lambda move: (move.joint, move.parts))))
            for step in reversed(self._steps)
        )
        left = sorted(set().union(*(table for table in self._tables if len(table) > 1)))
        ways, known = tuple(self._prover.ways), len(self._prover.known)
        return Plan(self._standing, steps, ways, known, tuple(left))

    def _rows(self) -> None:
        """Take rows apart that parallel pegs hold."""
        rows = Rows(self._standing)
        while len(rows.left) > 1:
            wave: list[Move] = []
            for choices in rows.choices():
                wave = [self._tried(choice, [choice.path]) for choice in choices]
                if all(move.proved for move in wave):
                    break
            if not wave:
                break
            self._take(wave, "rows apart")
            for move in wave:
                rows.take(move.parts)
            self._steps.append(Step("rows", tuple(wave)))

    def _pieces(self, what: str, roles: tuple[str, ...]) -> None:
        """Take pieces of all joints out that are parts of their own, in the order of the ways."""
        queues = {
            number: [way for way in site.kind.ways if self._own(site, way, roles)]
            for number, site in enumerate(self._standing.sites)
        }
        while any(queues.values()):
            wave = []
            for number, queue in queues.items():
                if queue:
                    site, way = self._standing.sites[number], queue.pop(0)
                    parts = frozenset(site.parts[n] for n in way.moving)
                    path = way.path.scaled(self._side)
                    wave.append(self._out(Choice(parts, number, path, site.pose)))
            self._take(wave, f"{what} out")
            self._steps.append(Step(what, tuple(wave)))

    def _out(self, choice: Choice) -> Move:
        """The move of pieces out of a joint; a peg's goes up where its joint is turned over too."""
        parts = [self._standing.kit.placements[part] for part in choice.parts]
        if choice.origin.over and all(place.role == "peg" for place in parts):
            move = self._lifted(replace(choice, path=reflected(choice.path)))
            if move.proved:
                return move
        return self._lifted(choice, search=True)

    def _own(self, site: StandingJoint, way: Way, roles: tuple[str, ...]) -> bool:
        """Whether a way is of pieces with these roles, all of them parts of their own."""
        pieces = site.kind.pieces
        parts = {site.parts[n] for n in way.moving}
        return all(pieces[n].role in roles for n in way.moving) and not (
            parts & self._standing.elements
        )

    def _connectors(self) -> None:
        """Take elements and whole connectors apart."""
        while wave := self._connector_wave():
            self._take(wave, "elements apart")
            self._steps.append(Step("connectors", tuple(wave)))

    def _connector_wave(self) -> list[Move]:
        """All that comes out next, each whatever the others do; unproved only if nothing is."""
        wave: list[Move] = []
        left: list[Choice] = []
        for table in self._tables:
            if len(table) > 1:
                trees, gone = Trees(self._standing, table), list[Move]()
                for group in trees.groups:
                    choices = [c for c in trees.choices(group) if c.parts < table]
                    found = self._chosen(choices)
                    gone += found
                    left += [] if found else choices
                if sum(len(move.parts) for move in gone) == len(table):
                    gone.pop()  # the last stays: the others go in beside it
                wave += gone
        if wave or not left:
            return wave
        left.sort(key=lambda choice: len(choice.parts))
        for choice in left[:_SEARCHED]:
            move = self._lifted(choice, search=True)
            if move.proved:
                return [move]
        return [self._lifted(left[0])]

    def _chosen(self, choices: Iterable[Choice]) -> list[Move]:
        """All single parts of a tree that are proved to come out, or else one set of parts."""
        found: list[Move] = []
        taken: set[int] = set()
        for choice in sorted(choices, key=lambda c: (len(c.parts), c.joint)):
            if taken and (len(choice.parts) > 1 or choice.joint in taken):
                continue
            move = self._lifted(choice)
            if move.proved:
                found.append(move)
                taken.add(choice.joint)
                if len(choice.parts) > 1:
                    break
        return found

    def _lifted(self, choice: Choice, *, search: bool = False) -> Move:
        """The move on the choice's way, or some of it, and then out of the plane."""
        moving = sorted(choice.parts)

        def ways(path: Path) -> Iterator[Path]:
            for cut, up in cut_ways(path, choice.origin.z[2]):
                yield self._prover.lifted(cut, moving, choice.origin, up)

        move = self._tried(choice, ways(choice.path))
        if search and not move.proved:
            self._say(self._share, f"searching a way at joint {choice.joint + 1}")
            found = self._search.way(choice, self._table(choice.parts))
            other = None if found is None else self._tried(choice, ways(found))
            move = other if other is not None and other.proved else move
        return move

    def _tried(self, choice: Choice, ways: Iterable[Path]) -> Move:
        """The move on the first of some ways that is proved, else on the first."""
        rest, moving = self._table(choice.parts), sorted(choice.parts)
        if len(self._prover.known) > self._told:  # what is known already is quick
            self._told = len(self._prover.known)
            self._say(self._share, f"proving joint {choice.joint + 1}")
        tried: list[Found] = []
        for way in ways:
            found = self._prover.proved(way, moving, rest, choice.origin)
            if found.blocking is None:
                return self._move(choice, found)
            tried.append(found)
        return self._move(choice, tried[0])

    def _move(self, choice: Choice, found: Found) -> Move:
        reason = ""
        if found.blocking is not None:
            place = self._standing.kit.placements[found.blocking]
            x, y, _ = self._unit * np.array(place.pose.at)
            reason = f"no way is proved past {place.part} at {x:.4g}, {y:.4g}"
        parts = tuple(sorted(choice.parts))
        return Move(parts, choice.joint, found.way, choice.origin, found.gap, reason)

    def _table(self, parts: Iterable[int]) -> set[int]:
        """All that these parts are with."""
        one = next(iter(parts))
        return next(table for table in self._tables if one in table)

    def _take(self, wave: Sequence[Move], words: str) -> None:
        """Let parts be gone from where they are; several make a table of their own."""
        for move in wave:
            self._table(move.parts).difference_update(move.parts)
            if len(move.parts) > 1:
                self._tables.append(set(move.parts))
            self._done += len(move.parts)
        self._tables = [table for table in self._tables if table]
        self._say(self._share, f"taking {words}")

    @property
    def _share(self) -> float:
        """About how much is done: parts in rows move twice."""
        twice = 2 if self._standing.kit.key == "fixed" else 1
        return min(self._done / (twice * len(self._standing.kit.placements)), 1.0)
