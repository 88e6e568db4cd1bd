"""Volumes and masses of meshes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

__all__ = ["mass", "volume"]


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
