"""Places and counts as messages give them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from scadgen.solid.affine import Floats

__all__ = ["corner", "more", "where"]


def where(point: Floats) -> str:
    """A point of two or three coordinates as text: ``(12.5, 40)``, in mm."""
    return f"({', '.join(f'{number + 0.0:.6g}' for number in point)})"


def corner(vertex: int, point: Floats, gaps: Sequence[float]) -> str:
    """A vertex and the angles between its edges, in degrees, as text."""
    return f"vertex {vertex} at {where(point)}, angles {', '.join(f'{gap:.4g}' for gap in gaps)}"


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
