"""The plan as a value: steps that put a frame together, each of them proved backwards."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from scadgen.interlock.path import Path
from scadgen.plan.standing import Standing
from scadgen.solid.pose import Pose

__all__ = ["Move", "Plan", "Step"]


@dataclass(frozen=True, slots=True)
class Move:
    """What goes in as one.

    Parameters
    ----------
    parts
        Numbers of the parts, in the kit's placements, ascending.
    joint
        Number of the joint at which it goes in.
    way
        Number of its way out in the plan's ways; backwards it is the way in.
    origin
        Where that way's coordinates are in the frame, in edge lengths.
    gap
        Smallest gap on the way, in mm; 0 if it is not proved.
    reason
        What it comes too near to, if it is not proved; else empty.
    """

    parts: tuple[int, ...]
    joint: int
    way: int
    origin: Pose
    gap: float
    reason: str

    @property
    def proved(self) -> bool:
        """Whether its way is proved."""
        return not self.reason


@dataclass(frozen=True, slots=True)
class Step:
    """Moves of one sort, in any order among each other.

    Parameters
    ----------
    what
        One of ``connectors``, ``halves``, ``pegs``, ``rows``.
    moves
        Each is proved past all that is there before any of them.
    """

    what: str
    moves: tuple[Move, ...]

    @property
    def proved(self) -> bool:
        """Whether the ways of all moves are proved."""
        return all(move.proved for move in self.moves)


@dataclass(frozen=True, eq=False)
class Plan:
    """How a frame is put together.

    Parameters
    ----------
    standing
        The frame.
    steps
        In order.
    ways
        The ways out, in mm, each with its joint at the origin; as they are written.
    proofs
        How many different pairs of parts were looked at, one moving past the other.
    left
        Parts that hang together, and of which no way apart is known.
    """

    standing: Standing
    steps: tuple[Step, ...]
    ways: tuple[Path, ...]
    proofs: int
    left: tuple[int, ...] = ()

    @property
    def proved(self) -> bool:
        """Whether every step is proved, and they take all parts apart."""
        return not self.left and all(step.proved for step in self.steps)

    def first(self) -> frozenset[int]:
        """Parts that are there before all moves: none of them goes in alone."""
        return frozenset().union(*self.tables[0])

    @cached_property
    def tables(self) -> list[list[frozenset[int]]]:
        """What is joined before each step, and at the end: all that is there, in sets."""
        joined = [frozenset(range(len(self.standing.kit.placements)))]
        found = [joined]
        for step in reversed(self.steps):
            gone = frozenset().union(*(move.parts for move in step.moves))
            apart = [frozenset(move.parts) for move in step.moves if len(move.parts) > 1]
            joined = [rest for table in joined if (rest := table - gone)] + apart
            found.append(joined)
        return found[::-1]

    def onto(self, number: int, move: Move) -> frozenset[int]:
        """What a move of a step joins: all that is joined to it after the step but what moves."""
        moving = frozenset().union(*(one.parts for one in self.steps[number - 1].moves))
        table = next(table for table in self.tables[number] if move.parts[0] in table)
        return table - moving
