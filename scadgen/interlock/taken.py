"""What becomes of an assembly that is taken apart."""

from __future__ import annotations

from dataclasses import dataclass

from scadgen.interlock.path import Path

__all__ = ["Left", "Removal", "TakenApart"]


@dataclass(frozen=True, slots=True, eq=False)
class Removal:
    """Something that was taken out.

    Parameters
    ----------
    parts
        Numbers of the parts that went, as one.
    left
        Those that they were taken from.
    path
        Their way.
    """

    parts: tuple[int, ...]
    left: tuple[int, ...]
    path: Path


@dataclass(frozen=True, slots=True)
class Left:
    """Parts that did not come apart.

    Parameters
    ----------
    parts
        Their numbers.
    answer
        ``locked``, ``captive`` or ``not settled``.
    shift, turn
        How far something moved in them at most: in mm, and in radians.
    tries
        Ways tried in vain.
    """

    parts: tuple[int, ...]
    answer: str
    shift: float = 0.0
    turn: float = 0.0
    tries: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class TakenApart:
    """What became of an assembly.

    Parameters
    ----------
    removals
        What was taken out, in that order.
    left
        What did not come apart.
    """

    removals: tuple[Removal, ...]
    left: tuple[Left, ...]

    @property
    def answer(self) -> str:
        """``apart`` if everything did, else the answer for what is left that says least."""
        answers = {left.answer for left in self.left}
        order = ("not settled", "captive", "locked", "apart")
        return next(answer for answer in order if answer in answers or answer == "apart")
