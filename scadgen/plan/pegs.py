"""How many pegs a frame has, and how many it has to have."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.plan.standing import Standing

__all__ = ["Pegs", "count_pegs"]


@dataclass(frozen=True, slots=True)
class Pegs:
    """Numbers of pegs.

    Parameters
    ----------
    loose
        Parts of their own that hold elements, or would if there were one on their edge.
    least
        As many loose pegs a frame like this has to have: one a joint, or nothing gets into it;
        and one for each edge more than a forest has, for an element with whole connectors at
        both ends closes no loop.  0 where rows of fixed pegs close all loops.
    fixed
        Those that are part of elements.
    rim
        Of a kit of fixed pegs those that are parts of their own, where a key has no edge.
    """

    loose: int
    least: int
    fixed: int
    rim: int


def count_pegs(standing: Standing) -> Pegs:
    """Count the pegs of a frame."""
    alone = sum(place.role == "peg" for place in standing.kit.placements)
    if standing.kit.key == "fixed":
        keys = sum(len(site.kind.keys) for site in standing.sites)
        return Pegs(0, 0, keys - alone, alone)
    joints, edges = len(standing.sites), len(standing.elements)
    ends = [standing.sites_of[element] for element in sorted(standing.elements)]
    rows, columns = np.array(ends).T
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(joints, joints))
    components, _ = connected_components(graph, directed=False)
    return Pegs(alone, max(joints, edges - joints + int(components)), 0, 0)
