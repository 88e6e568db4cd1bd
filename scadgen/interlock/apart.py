"""Does an assembly come apart?  Parts and groups are taken out for real, round by round.

1. What a direction lets move as one is tried straight: single parts first, then groups.
2. What turns is tried along its own screw.
3. Then a way is searched for, in six degrees of freedom, with a limit of steps.

What is out is in nobody's way any more; a group that is out is taken apart by itself.  Where
nothing comes out, parts are locked, or captive: they move, and a search that ended by itself
found no way for two bodies that nothing else stands between; else it is not settled.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.interlock.assembly import largest_part, make_assembly
from scadgen.interlock.blocking import movable_groups
from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.interlock.escape import STEPS, Attempts, escape
from scadgen.interlock.path import Path
from scadgen.interlock.round import round_depth, round_motions
from scadgen.interlock.scene import Scene
from scadgen.interlock.taken import Left, Removal, TakenApart
from scadgen.interlock.verdict import Motion, verdict
from scadgen.interlock.wayout import followed, screwed, straight, united_mesh

__all__ = ["BUDGET", "take_apart"]

#: Steps of all searches together, unless told.
BUDGET = 60_000

#: Depth of an overlap, as a share of all parts' size, that is rounding: a float32's is 1e-7.
_ROUNDING = 2e-6

#: Groups that are tried in a round at most, the smallest.
_GROUPS = 40

#: Seed of the searches.
_SEED = 1


def take_apart(
    meshes: Sequence[Mesh],
    contacts: Contacts,
    near: float,
    held: Collection[int] = (),
    *,
    steps: int = BUDGET,
    interference: float = 0.0,
    say: Callable[[str], None] = lambda _: None,
) -> TakenApart:
    """Take an assembly apart.

    Parameters
    ----------
    meshes
        The parts, closed and oriented.
    contacts
        Where they touch.
    near
        The distance up to which they do.
    held
        Numbers of the parts that are held fast, and so stay together.
    steps
        Steps of all searches together; with 0 only straight ways are tried.
    interference
        How deep parts may be in each other, in mm, and count as touching.
    say
        Told what is tried.

    Returns
    -------
    apart
        The same for the same input.

    Raises
    ------
    InvariantError
        If one of the meshes is not a solid.
    ToolError
        The solver gives no answer: its status.
    """
    return _Taking(meshes, contacts, near, frozenset(held), steps, interference).apart(say)


@dataclass(slots=True, eq=False)
class _Body:
    """Parts that may go as one, and what they would leave."""

    parts: tuple[int, ...]
    left: tuple[int, ...]
    moving: list[Mesh]
    fixed: list[Mesh]
    motion: Motion | None = None
    allowed: float = 0.0


class _Taking:
    """An assembly being taken apart."""

    def __init__(
        self,
        meshes: Sequence[Mesh],
        contacts: Contacts,
        near: float,
        held: frozenset[int],
        steps: int,
        interference: float,
    ) -> None:
        self._meshes, self._contacts, self._near, self._held = meshes, contacts, near, held
        self._budget, self._searching = steps, steps > 0
        corners = np.concatenate([points for points, _ in meshes])
        size = float(np.linalg.norm(np.ptp(corners, axis=0)))
        self._allowed = interference + _ROUNDING * size

    def apart(self, say: Callable[[str], None]) -> TakenApart:
        """All that comes out, and what is left."""
        removals: list[Removal] = []
        left: list[Left] = []
        tables = [frozenset(range(len(self._meshes)))]
        while tables:
            table = tables.pop()
            if len(table) < 2 or table <= self._held:
                continue
            say(f"taking apart {len(table)} parts, {len(removals)} taken out")
            found = self._next(table)
            if isinstance(found, Left):
                left.append(found)
                continue
            removals.append(found)
            tables += [frozenset(found.parts), frozenset(found.left)]
        return TakenApart(tuple(removals), tuple(left))

    def _next(self, table: frozenset[int]) -> Removal | Left:
        """What comes out of some parts next; else what keeps them."""
        stays = self._stays(table)
        groups = movable_groups(self._contacts, table, stays)
        for parts in [*groups][:_GROUPS]:
            body = self._body(parts, table)
            ways = groups[parts] if body.parts == parts else -groups[parts]
            path = straight(Scene(body.moving, body.fixed, self._allowed), ways)
            if path is not None:
                return Removal(body.parts, body.left, path)
        if not self._searching:
            return Left(tuple(sorted(table)), "not settled")
        alone = [(part,) for part in sorted(table - stays)]
        together = [parts for parts in groups if len(parts) > 1]
        bodies = [*self._movable([*alone, *together, *self._in_motion(table, stays)], table)]
        for body in bodies:
            if (path := self._screwed(body)) is not None:
                return Removal(body.parts, body.left, path)
        return self._searched(table, bodies)

    def _stays(self, table: frozenset[int]) -> frozenset[int]:
        """What does not move of some parts: those held, else the largest."""
        numbers = sorted(table)
        largest = numbers[largest_part([self._meshes[n] for n in numbers])]
        return table & self._held or frozenset([largest])

    def _body(self, parts: tuple[int, ...], table: frozenset[int]) -> _Body:
        """Parts that may go as one; what they would leave, if that is less and not held."""
        left = tuple(sorted(table - set(parts)))
        if len(left) < len(parts) and not self._held & table:
            parts, left = left, parts
        moving, fixed = ([self._meshes[n] for n in group] for group in (parts, left))
        return _Body(parts, left, moving, fixed, allowed=self._allowed)

    def _movable(self, groups: Sequence[tuple[int, ...]], table: frozenset[int]) -> Iterator[_Body]:
        """Those of some groups that can begin to move as one."""
        for body in [self._body(parts, table) for parts in dict.fromkeys(groups)]:
            pair = [united_mesh(body.fixed), united_mesh(body.moving)]
            contacts = self._between(body)
            found = verdict(make_assembly(pair, contacts, (0,)))
            if isinstance(found, Motion):
                body.motion = found
            elif turning := round_motions(pair, contacts, self._near, [(1,)])[0]:
                body.motion, body.allowed = turning, round_depth(pair, self._near) + self._allowed
            if body.motion is not None:
                yield body

    def _between(self, body: _Body) -> Contacts:
        """Contacts of a body with what it leaves, as those of two parts: 0 is left, 1 moves."""
        side = np.full(len(self._meshes), -1)
        side[list(body.left)], side[list(body.parts)] = 0, 1
        first, second = side[self._contacts.first], side[self._contacts.second]
        mine = np.flatnonzero((first >= 0) & (second >= 0) & (first != second))
        some = self._contacts.some(mine)
        return Contacts(some.points, some.normals, first[mine], second[mine])

    def _in_motion(self, table: frozenset[int], stays: frozenset[int]) -> list[tuple[int, ...]]:
        """What moves together in a motion of all."""
        found = self._verdict(table, stays)
        return [found] if found else []

    def _verdict(self, table: frozenset[int], stays: frozenset[int]) -> tuple[int, ...]:
        """The parts that can begin to move; none where they are locked."""
        numbers = sorted(table)
        place = np.full(len(self._meshes), -1)
        place[numbers] = np.arange(len(numbers))
        first, second = place[self._contacts.first], place[self._contacts.second]
        mine = np.flatnonzero((first >= 0) & (second >= 0))
        some = self._contacts.some(mine)
        contacts = Contacts(some.points, some.normals, first[mine], second[mine])
        held = [int(place[n]) for n in sorted(stays)]
        found = verdict(make_assembly([self._meshes[n] for n in numbers], contacts, held))
        return tuple(numbers[n] for n in found.parts) if isinstance(found, Motion) else ()

    def _screwed(self, body: _Body) -> Path | None:
        if body.motion is None or not body.motion.rotations.any():
            return None
        scene = Scene(body.moving, body.fixed, body.allowed)
        return screwed(scene, united_mesh(body.moving), body.motion)

    def _searched(self, table: frozenset[int], bodies: Sequence[_Body]) -> Removal | Left:
        """What a search takes out; else the answer for these parts."""
        numbers = tuple(sorted(table))
        attempts: dict[tuple[int, ...], Attempts] = {}
        for body in bodies:
            found = self._search(body)
            if isinstance(found, Path):
                return Removal(body.parts, body.left, found)
            attempts[body.parts] = found
        if not bodies and not self._verdict(table, self._stays(table)):
            return Left(numbers, "locked")
        if len(table - self._stays(table)) == 1:
            captive = bool(bodies) and all(found.finished for found in attempts.values())
        else:
            captive = self._linked(numbers)
        reached = [(found.shift, found.turn) for found in attempts.values()]
        reached += [self._followed(body) for body in bodies]
        return Left(
            numbers,
            "captive" if captive else "not settled",
            max((shift for shift, _ in reached), default=0.0),
            max((turn for _, turn in reached), default=0.0),
            sum(found.tries for found in attempts.values()),
        )

    def _followed(self, body: _Body) -> tuple[float, float]:
        """How far a body can go on as it begins, in mm and in radians."""
        if body.motion is None:
            return 0.0, 0.0
        scene = Scene(body.moving, body.fixed, body.allowed)
        return followed(scene, united_mesh(body.moving), body.motion)

    def _search(self, body: _Body) -> Path | Attempts:
        """A way searched for, within what is left of the steps."""
        steps = min(self._budget, STEPS)
        found = escape(body.moving, body.fixed, seed=_SEED, steps=steps, allowed=body.allowed)
        if isinstance(found, Attempts):
            self._budget = max(self._budget - found.steps, 0)
        return found

    def _linked(self, numbers: Sequence[int]) -> bool:
        """Whether all hang together by pairs that do not come apart even with all others gone."""
        joined = []
        for one, other in combinations(numbers, 2):
            if {one, other} <= self._held:
                joined.append((one, other))
                continue
            found = self._next(frozenset([one, other]))
            if isinstance(found, Left) and found.answer != "not settled":
                joined.append((one, other))
        graph = coo_array(
            (np.ones(len(joined)), tuple(np.array(joined, dtype=np.int64).reshape(-1, 2).T)),
            shape=(len(self._meshes),) * 2,
        )
        label = connected_components(graph, directed=False)[1]
        return len(set(label[list(numbers)].tolist())) == 1
