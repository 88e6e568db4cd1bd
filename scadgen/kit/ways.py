"""Ways on which pieces come apart, as JSON values."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from scadgen.interlock.path import Path
from scadgen.kit.model import Way

__all__ = ["WAY_DECIMALS", "read_way", "way_entry"]

#: Decimals of a way's numbers, in sides and radians.
WAY_DECIMALS = 6


def way_entry(way: Way) -> dict[str, Any]:
    """A way as JSON values, to a millionth of a side."""
    return {
        "name": way.name,
        "moving": list(way.moving),
        "middle": (np.round(way.path.middle, WAY_DECIMALS) + 0.0).tolist(),
        "steps": (np.round(way.path.steps(), WAY_DECIMALS) + 0.0).tolist(),
    }


def read_way(entry: Mapping[str, Any]) -> Way:
    """A way from JSON values.

    Raises
    ------
    ValueError
        Its numbers are not a motion.
    """
    steps, middle = (np.array(entry[name], dtype=np.float64) for name in ("steps", "middle"))
    finite = np.isfinite(steps).all() and np.isfinite(middle).all()
    if steps.ndim != 2 or steps.shape[1] != 6 or middle.shape != (3,) or not finite:
        msg = f"way {entry['name']!r}: not a list of six numbers each"
        raise ValueError(msg)
    return Way(entry["name"], tuple(entry["moving"]), Path.through(steps, middle))
