"""Corners and counts as messages give them."""

from __future__ import annotations

import math
from collections.abc import Sequence

__all__ = ["corner", "more"]


def corner(vertex: str, gaps: Sequence[float]) -> str:
    """A vertex, as it is called, and the angles between its edges, in degrees, as text."""
    return f"{vertex}, angles {', '.join(f'{gap:.4g}' for gap in gaps)}"


def more(count: int, most: float = math.inf) -> str:
    """What is said after the first of several: `` (and 3 more)``; nothing after a lone one.

    Parameters
    ----------
    count
        How many there are.
    most
        More than this were not counted.
    """
    least = "at least " if count > most else ""
    return f" (and {least}{count - 1} more)" if count > 1 else ""
