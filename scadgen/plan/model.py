"""The plan as a value: steps that put a frame together, each of them proved backwards."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from scadgen.interlock.path import Path
from scadgen.plan.standing import Standing

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
    at, turn
        Where that way's origin stands, in edge lengths, and how it is turned, in degrees.
    order
        Within the step: those with the same number go in in any order.
    gap
        Smallest gap on the way, in mm; 0 if it is not proved.
    reason
        What it comes too near to, if it is not proved; else empty.
    """

    parts: tuple[int, ...]
    joint: int
    way: int
    at: tuple[float, float]
    turn: float
    order: int
    gap: float
    reason: str

    @property
    def proved(self) -> bool:
        """Whether its way is proved."""
        return not self.reason


@dataclass(frozen=True, slots=True)
class Step:
    """Moves of one sort.

    Parameters
    ----------
    what
        One of ``connectors``, ``halves``, ``pegs``, ``rows``.
    moves
        In order.
    """

    what: str
    moves: tuple[Move, ...]

    @property
    def proved(self) -> bool:
        """Whether the ways of all moves are proved."""
        return all(move.proved for move in self.moves)


@dataclass(frozen=True, slots=True, eq=False)
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

    def moves(self) -> Iterator[Move]:
        """All moves in order."""
        for step in self.steps:
            yield from step.moves

    def first(self) -> frozenset[int]:
        """Parts that are there before all moves: none of them goes in alone."""
        alone = {move.parts[0] for move in self.moves() if len(move.parts) == 1}
        return frozenset(range(len(self.standing.kit.placements))) - alone
