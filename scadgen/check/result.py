"""The result of one check."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Result"]


@dataclass(frozen=True, slots=True)
class Result:
    """What one check found.

    Parameters
    ----------
    check
        What was checked.
    good
        Whether it holds.
    figure
        What was measured.
    bound
        What it must be.
    """

    check: str
    good: bool
    figure: str
    bound: str
