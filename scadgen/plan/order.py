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

Moves of a step with one number are proved with all there that is there before any of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from scadgen.errors import InputError
from scadgen.interlock.path import Path
from scadgen.kit.model import Kit, Way
from scadgen.plan.model import Move, Plan, Step
from scadgen.plan.proof import Found, Prover
from scadgen.plan.slides import clusters as clusters_of
from scadgen.plan.slides import tubes_of
from scadgen.plan.standing import Site, Standing, stand
from scadgen.solid.affine import Floats

__all__ = ["make_plan"]

#: Sine of the angle up to which ways are parallel.
_PARALLEL = 1e-3

#: Shares of a way after which a part may be lifted out: ways of a joint may end far aside.
_SHARES = (1.0, 0.5, 0.75, 0.875, 0.625, 0.375, 0.25)

#: Steps beyond which those of rows are told as one.
_MANY = 8


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
            "the kit is unchecked: no ways out of its joints are known; make it again without "
            "--unchecked"
        )
        raise InputError(msg)
    return _Planner(stand(kit), say).plan()


@dataclass(frozen=True, slots=True, eq=False)
class _Choice:
    """Something that may come out.

    Parameters
    ----------
    parts
        What moves as one.
    joint
        Number of the joint.
    path
        A way, in mm, its origin at the joint.
    at, turn
        Where that is.
    """

    parts: frozenset[int]
    joint: int
    path: Path
    at: tuple[float, float]
    turn: float


class _Planner:
    """Takes a frame apart."""

    def __init__(self, standing: Standing, say: Callable[[float, str], None]) -> None:
        self._standing, self._say = standing, say
        self._side, self._unit = standing.kit.values["side"], standing.kit.values["edge_length"]
        self._prover = Prover(standing)
        self._tubes = tubes_of(standing)
        self._tables: list[set[int]] = [set(range(len(standing.kit.placements)))]
        self._steps: list[Step] = []
        self._out = 0

    def plan(self) -> Plan:
        """The plan: what comes out last goes in first."""
        if self._standing.kit.key == "fixed":
            self._rows()
        self._pieces("pegs", ("peg",))
        self._pieces("halves", ("half_a", "half_b"))
        self._connectors()
        steps = tuple(map(_backwards, reversed(self._steps)))
        return Plan(self._standing, steps, tuple(self._prover.ways), len(self._prover.known))

    # Rows.

    def _rows(self) -> None:
        """Take rows apart that parallel pegs hold."""
        clusters = clusters_of(self._standing)
        waves: list[list[Move]] = []
        left = self._tables.pop()
        while len(clusters) > 1:
            wave = self._row_wave(clusters, left)
            if wave is None:
                break
            waves.append(wave)
            for move in wave:
                gone = set(move.parts)
                left -= gone
                self._tables.append(gone)
                clusters.remove(frozenset(gone))
                self._done(gone, "taking rows apart")
        self._tables.append(left)
        if len(waves) > _MANY:
            moves = tuple(_numbered(waves))
            self._steps.append(Step("rows", moves))
        else:
            self._steps += [Step("rows", tuple(_numbered([wave]))) for wave in waves]

    def _row_wave(self, clusters: Sequence[frozenset[int]], left: set[int]) -> list[Move] | None:
        """The next row that slides off, or single elements that do; None if nothing does."""
        free = [(c, d) for c in clusters if (d := self._slides(c, clusters)) is not None]
        # Elements that stand on pegs alone all at once, else the upper row.
        alone = [(c, d) for c, d in free if len(c) == 1]
        rows = sorted(((c, d) for c, d in free if len(c) > 1), key=lambda f: -self._height(f[0]))
        tried: list[Move] = []
        for chosen in ([alone] if alone else []) + [[row] for row in rows]:
            tried = [self._slid(c, d, left) for c, d in chosen]
            if all(move.proved for move in tried):
                break
        return tried or None

    def _height(self, cluster: Iterable[int]) -> float:
        places = self._standing.kit.placements
        return float(np.mean([places[n].at[1] for n in cluster]))

    def _slides(self, cluster: frozenset[int], clusters: Sequence[frozenset[int]]) -> Floats | None:
        """The direction in which a row slides off all pegs, if there is one."""
        there = frozenset().union(*clusters)
        found: Floats | None = None
        for tube in self._tubes:
            inside = tube.element in cluster, tube.half in cluster
            if inside[0] == inside[1] or not {tube.element, tube.half} <= there:
                continue
            way = tube.out if inside[0] else -tube.out
            if found is not None and float(way @ found) < 1 - _PARALLEL:
                return None
            found = way
        return found

    def _slid(self, cluster: frozenset[int], way: Floats, left: set[int]) -> Move:
        """The move of a row along its pegs, until a plane across them is between it and all."""
        joint = next(
            n for n, site in enumerate(self._standing.sites) if cluster & {*site.parts.values()}
        )
        site = self._standing.sites[joint]
        at, turn = site.at, float(np.degrees(np.arctan2(way[1], way[0])))
        places = self._standing.kit.placements
        across = [
            [float(self._unit * (np.array(places[n].at) @ way)) for n in group]
            for group in (cluster, left - cluster)
        ]
        reach = self._unit * max(self._standing.length(n) for n in self._standing.elements)
        far = max(across[1]) - min(across[0]) + 2 * reach + 10 * self._side
        steps = np.zeros((2, 6))
        steps[1, 0] = self._side * np.ceil(far / self._side)
        path = Path.through(steps, np.zeros(3))
        found = self._prover.proved(path, sorted(cluster), left, at, turn)
        return self._move(_Choice(cluster, joint, path, at, turn), found)

    # Pegs and halves.

    def _pieces(self, what: str, roles: tuple[str, ...]) -> None:
        """Take pieces of all joints out that are parts of their own, in the order of the ways."""
        waves: list[list[Move]] = []
        queues = {
            number: [w for w in site.kind.ways if self._own(site, w, roles)]
            for number, site in enumerate(self._standing.sites)
        }
        while any(queues.values()):
            wave = []
            for number, queue in queues.items():
                if queue:
                    site, way = self._standing.sites[number], queue.pop(0)
                    parts = frozenset(site.parts[n] for n in way.moving)
                    path = way.path.scaled(self._side)
                    choice = _Choice(parts, number, path, site.at, site.turn)
                    wave.append(self._tried(choice))
                    self._done(parts, f"taking {what} out")
            self._take(wave)
            waves.append(wave)
        self._steps += [Step(what, tuple(_numbered([wave]))) for wave in waves]

    def _own(self, site: Site, way: Way, roles: tuple[str, ...]) -> bool:
        """Whether a way is of pieces with these roles, all of them parts of their own."""
        pieces = site.kind.pieces
        parts = {site.parts[n] for n in way.moving}
        return all(pieces[n].role in roles for n in way.moving) and not (
            parts & self._standing.elements
        )

    # Elements and whole connectors.

    def _connectors(self) -> None:
        """Take elements and whole connectors apart."""
        waves: list[list[Move]] = []
        while wave := self._connector_wave():
            self._take(wave)
            for move in wave:
                self._done(move.parts, "taking elements apart")
            waves.append(wave)
        if waves:
            self._steps.append(Step("connectors", tuple(_numbered(waves))))

    def _connector_wave(self) -> list[Move]:
        """All that comes out next, each whatever the others do; unproved only if nothing is."""
        wave: list[Move] = []
        refused: list[Move] = []
        for table in self._tables:
            if len(table) > 1:
                tree = _Trees(self._standing, table)
                for group in tree.groups:
                    found = self._chosen(tree.choices(group, self._side), table)
                    (wave if all(move.proved for move in found) else refused).extend(found)
        return wave or refused[:1]

    def _chosen(self, choices: Iterable[_Choice], table: set[int]) -> list[Move]:
        """All single parts of a tree that are proved to come out, or else one set of parts.

        The first that is not proved, if none is.
        """
        found: list[Move] = []
        refused: list[Move] = []
        taken: set[int] = set()
        for choice in sorted(choices, key=lambda c: (len(c.parts), c.joint)):
            if taken and (len(choice.parts) > 1 or choice.joint in taken):
                continue
            move = self._tried(choice, table)
            if move.proved:
                found.append(move)
                taken.add(choice.joint)
                if len(choice.parts) > 1:
                    break
            else:
                refused.append(move)
        return found or refused[:1]

    # All.

    def _tried(self, choice: _Choice, table: set[int] | None = None) -> Move:
        """The move on the first way that is proved, else on the first."""
        rest = table if table is not None else self._table(choice.parts)
        moving = sorted(choice.parts)
        tried = []
        for way in self._lifts(choice, moving):
            found = self._prover.proved(way, moving, rest, choice.at, choice.turn)
            if found.blocking is None:
                return self._move(choice, found)
            tried.append(found)
        return self._move(choice, tried[0])

    def _lifts(self, choice: _Choice, moving: Sequence[int]) -> Iterator[Path]:
        """A choice's way, lifted out of the plane at its end, or sooner."""
        poses = choice.path.poses
        ends = dict.fromkeys(max(1, round(share * len(poses))) for share in _SHARES)
        for end in ends:
            cut = Path(poses[:end], choice.path.middle)
            for up in _ups(cut):
                yield self._prover.lifted(cut, moving, choice.at, choice.turn, up)

    def _move(self, choice: _Choice, found: Found) -> Move:
        reason = ""
        if found.blocking is not None:
            place = self._standing.kit.placements[found.blocking]
            x, y = self._unit * np.array(place.at)
            reason = f"no way is proved past {place.part} at {x:.4g}, {y:.4g}"
        parts = tuple(sorted(choice.parts))
        return Move(parts, choice.joint, found.way, choice.at, choice.turn, 0, found.gap, reason)

    def _table(self, parts: Iterable[int]) -> set[int]:
        """All that these parts are with."""
        one = next(iter(parts))
        return next(table for table in self._tables if one in table)

    def _take(self, wave: Sequence[Move]) -> None:
        """Let parts be gone from where they are; several make a table of their own."""
        for move in wave:
            self._table(move.parts).difference_update(move.parts)
            if len(move.parts) > 1:
                self._tables.append(set(move.parts))
        self._tables = [table for table in self._tables if table]

    def _done(self, parts: Iterable[int], words: str) -> None:
        self._out += len(list(parts))
        total = len(self._standing.kit.placements)
        self._say(min(self._out / total, 1.0), words)


class _Trees:
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
            there = {
                n: part for n, part in standing.sites[number].connectors.items() if part in table
            }
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
        found, open_ends = {part}, [(part, without)]
        while open_ends:
            one, closed = open_ends.pop()
            for joint in self._joints_of[one]:
                if joint == closed:
                    continue
                for other in self._at[joint].values():
                    if other not in found:
                        found.add(other)
                        open_ends.append((other, joint))
        return frozenset(found)

    def choices(self, group: frozenset[int], side: float) -> Iterator[_Choice]:
        """What of a tree may come out: single parts, and all of a joint but the largest."""
        joints = sorted({joint for part in group for joint in self._joints_of[part]})
        busy = [joint for joint in joints if len(self._at[joint]) > 1]
        if not busy:
            yield self._free(group)
        for joint in busy:
            site, there = self._standing.sites[joint], self._at[joint]
            ways = [w for w in site.kind.ways if len(w.moving) == 1 and w.moving[0] in there]
            # A way is proved past what has not come out before it.
            if not ways:
                continue
            way = ways[0]
            branch = self._beyond(there[way.moving[0]], joint)
            path = way.path.scaled(side)
            yield _Choice(branch, joint, path, site.at, site.turn)
            yield _Choice(group - branch, joint, _inverse(path), site.at, site.turn)

    def _free(self, group: frozenset[int]) -> _Choice:
        """A part that no other holds: straight up."""
        part = min(group)
        joint = self._standing.sites_of[part][0]
        site = self._standing.sites[joint]
        still = Path.through(np.zeros((1, 6)), np.zeros(3))
        return _Choice(group, joint, still, site.at, site.turn)


def _inverse(path: Path) -> Path:
    """How the others move, as seen from what moves."""
    poses = np.asarray(np.linalg.inv(path.poses), dtype=np.float64)
    return Path(poses, path.middle)


def _ups(path: Path) -> tuple[float, float]:
    """Up and down, first the one that the way ends on."""
    high = float((path.poses[-1, :3, :3] @ path.middle + path.poses[-1, :3, 3])[2])
    return (1.0, -1.0) if high >= 0 else (-1.0, 1.0)


def _numbered(waves: Sequence[Sequence[Move]]) -> Iterator[Move]:
    """Moves of waves, each with its wave's number from 1."""
    for number, wave in enumerate(waves, 1):
        for move in wave:
            yield replace(move, order=number)


def _backwards(step: Step) -> Step:
    """A step the other way round."""
    last = max(move.order for move in step.moves)
    moves = [replace(move, order=last + 1 - move.order) for move in reversed(step.moves)]
    return Step(step.what, tuple(sorted(moves, key=lambda move: move.order)))
