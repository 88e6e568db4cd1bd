"""Which parts stand in each other's way already: they share more than rounding."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scadgen.interlock.contacts import Mesh
from scadgen.interlock.nearby import near_pairs
from scadgen.solid.gap import overlap_volume
from scadgen.solid.mesh import volume

__all__ = ["overlaps"]

#: Shared volume, as a share of the smaller part's, that counts as rounding.
_ROUNDING = 1e-4


def overlaps(meshes: Sequence[Mesh]) -> list[tuple[int, int, float]]:
    """Pairs of parts that overlap, and the volume that they share.

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
            shared = overlap_volume(*meshes[a], *meshes[b])
            if shared > _ROUNDING * min(sizes[a], sizes[b]):
                found.append((a, b, shared))
    return sorted(found)
