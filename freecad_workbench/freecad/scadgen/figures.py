"""Volumes and masses: exact for a mesh, about right for a kit that is not made yet."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

__all__ = ["RING_RATIOS", "edge_sides", "estimate", "mass", "volume"]

#: Ring ratio of the weave that each frame and key style has unless another is given.
RING_RATIOS = {
    ("hexagonal", "fixed"): 1.79,
    ("hexagonal", "loose"): 1.79,
    ("square", "fixed"): 2.241,
    ("square", "loose"): 2.241,
}


def volume(
    points: Sequence[tuple[float, float, float]], triangles: Iterable[tuple[int, int, int]]
) -> float:
    """Volume of a closed mesh, in mm3 for points in mm."""
    total = 0.0
    for i, j, k in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[i], points[j], points[k]
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


def mass(cubic_mm: float, density: float) -> float:
    """Mass in g of a volume in mm3, of a density in g/cm3."""
    return cubic_mm / 1000 * density


def edge_sides(ring_ratio: float, key: str) -> int:
    """About the edge length, in sides, that a kit has unless another is given."""
    # Two rings, their necks, the tube between them and, loose pegs, room for both in it.
    return max(6, math.ceil(2 * ring_ratio + (2.3 if key == "fixed" else 3.05)))


def estimate(
    placements: Iterable[Mapping[str, Any]], side: float, edge_length: float, ring_ratio: float
) -> float:
    """Volume of a frame, before its parts are known, in mm3.

    Rings of square cross-section, and tubes from ring to ring; what clearance, chamfers and
    bores take away is left out.
    """
    roles = [p["role"] for p in placements]
    rings, tubes = roles.count("half_a"), roles.count("row") + roles.count("cross")
    tube = max(0.0, edge_length / side - 2 * ring_ratio - 1)
    return side**3 * (rings * math.tau * ring_ratio + tubes * tube)
