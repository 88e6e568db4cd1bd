"""Which parts stand in each other's way already: they share more than rounding."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from scadgen.interlock.contacts import Mesh
from scadgen.interlock.nearby import near_pairs
from scadgen.solid.gap import solid, thickness
from scadgen.solid.mesh import volume

__all__ = ["Overlap", "overlaps"]

#: Shared volume, as a share of the smaller part's, that counts as rounding.
_ROUNDING = 1e-4


class Overlap(NamedTuple):
    """Two parts that overlap.

    Parameters
    ----------
    first, second
        Their numbers.
    volume
        What they share, in cubes of their unit.
    depth
        Its mean thickness where it is thickest, in their unit.
    """

    first: int
    second: int
    volume: float
    depth: float


def overlaps(meshes: Sequence[Mesh]) -> list[Overlap]:
    """Pairs of parts that overlap by more than rounding.

    Parameters
    ----------
    meshes
        The parts, closed and oriented.

    Raises
    ------
    InvariantError
        If one of the meshes is not a solid.
    """
    low = np.array([points.min(axis=0) for points, _ in meshes])
    high = np.array([points.max(axis=0) for points, _ in meshes])
    sizes = [volume(*mesh) for mesh in meshes]
    found = []
    for one, other in near_pairs(low, high, np.arange(len(meshes))):
        for a, b in np.sort(np.column_stack([one, other]), axis=1).tolist():
            common = solid(*meshes[a]) ^ solid(*meshes[b])
            if common.volume() > _ROUNDING * min(sizes[a], sizes[b]):
                found.append(Overlap(a, b, float(common.volume()), thickness(common)))
    return sorted(found)
