"""Sites: what connectors grow around, and how far points are from each of a joint's.

A joint's lattice, walls, territory and contacts ask no more of a site than `Site` and `Together`
say, so that they are the same for every family of sites.  Most points are so much nearer to one
site than to all others that a look at the cube around them tells which, for a distance changes
by no more than the way moved.  Lengths are in units of the side.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats, Ints

__all__ = ["Rough", "Site", "Together", "distances", "nearest_site", "slopes"]

#: Sides of the cubes that points are looked at in, one after the other, and how many points there
#: must be to a cube for that to save time.
_CUBES, _FEW = (0.3, 0.12), 5


class Rough(NamedTuple):
    """What is known of distances at a first look.

    Parameters
    ----------
    least, most
        ``(k,) float``: bounds of each, in sides.
    start
        ``(k,) float``: what `Together.away` starts from.
    """

    least: Floats
    most: Floats
    start: Floats


class Together(Protocol):
    """All sites of a joint, asked at once for points each of which has one of them.

    `which` is ``(k,) int``, the number of each point's site; points are ``(k, 3) float``.
    """

    def roughly(self, which: Ints, points: Floats) -> Rough:
        """Bounds of the points' distances."""
        ...

    def away(self, which: Ints, points: Floats, start: Floats) -> Floats:
        """The way to each point from the nearest one of its site, ``(k, 3)``."""
        ...


class Site(Protocol):
    """What one connector grows around: a set of points, with its edge in some direction."""

    @property
    def name(self) -> str:
        """What a message calls what it was made from."""
        ...

    @property
    def turn(self) -> Floats:
        """What turns rows ``(..., 3)`` from where its edge is +x to where it is, ``(3, 3)``."""
        ...

    def together(self, sites: Sequence[Any]) -> Together:
        """Sites of its own family as one."""
        ...


def distances(sites: Sequence[Site], points: Floats, beyond: float | Floats = np.inf) -> Floats:
    """Distance of points from each site.

    Parameters
    ----------
    sites
        A joint's, of one family.
    points
        ``(..., 3) float``, in sides.
    beyond
        How much farther than the nearest site another may be, in sides, for its distance to be
        wanted, of all points or of each.  Of those that are farther it is some number that is no
        less; so it is of the nearest where all others are farther, yet less than theirs.

    Returns
    -------
    distances
        ``(sites, ...) float``, in sides.
    """
    flat = points.reshape(-1, 3)
    most = np.broadcast_to(beyond, points.shape[:-1]).ravel()
    joined = _joined(tuple(sites))
    found, wanted = _by_cubes(joined, len(sites), flat, most)
    which, row = np.nonzero(wanted)
    rough = joined.roughly(which, flat.take(row, axis=0))
    found[which, row] = rough.most
    limit = found.min(axis=0) + most
    near = np.zeros(found.shape, dtype=np.bool_)
    near[which, row] = rough.least <= limit[row]
    near &= near.sum(axis=0) > (1 if len(sites) > 1 else 0)
    some = np.flatnonzero(near[which, row])
    which, row = which[some], row[some]
    away = joined.away(which, flat.take(row, axis=0), rough.start[some])
    found[which, row] = np.sqrt(np.einsum("ki,ki->k", away, away))
    return found.reshape(len(sites), *points.shape[:-1])


def nearest_site(sites: Sequence[Site], points: Floats) -> Ints:
    """Which site each point is nearest to, ``(...)``.

    Parameters
    ----------
    sites, points
        As for `distances`.
    """
    return np.asarray(distances(sites, points, 0.0).argmin(axis=0))


def slopes(sites: Sequence[Site], points: Floats, which: Ints) -> tuple[Floats, Floats]:
    """Distance of each point from a site of its own, and its gradient.

    Parameters
    ----------
    sites
        A joint's, of one family.
    points
        ``(k, 3) float``, in sides.
    which
        ``(k,) int``: the number of each point's site.

    Returns
    -------
    distance
        ``(k,) float``.
    gradient
        ``(k, 3) float``, unit vectors away from the nearest point.
    """
    joined = _joined(tuple(sites))
    away = joined.away(which, points, joined.roughly(which, points).start)
    distance = np.sqrt(np.einsum("ki,ki->k", away, away))
    return distance, away / np.maximum(distance, np.finfo(float).tiny)[:, None]


def _by_cubes(
    joined: Together, count: int, points: Floats, beyond: Floats
) -> tuple[Floats, NDArray[np.bool_]]:
    """Upper bounds of all distances, and which are to be looked at more closely.

    The distance anywhere in a cube differs from that of its middle by half its diagonal at most.
    """
    found = np.full((count, len(points)), np.inf)
    wanted = np.ones(found.shape, dtype=np.bool_)
    left = np.arange(len(points) if count > 1 else 0)
    for size in _CUBES:
        order, start = _cubes(points[left], size)
        if len(start) * _FEW > len(left):
            break
        left = left[order]
        held = np.diff(start, append=len(left))
        low, high = (
            bound.reduceat(points[left], start, axis=0) for bound in (np.minimum, np.maximum)
        )
        radius = np.linalg.norm(high - low, axis=1) / 2
        which = np.repeat(np.arange(count), len(start))
        rough = joined.roughly(which, np.tile((low + high) / 2, (count, 1)))
        least, most = (bound.reshape(count, -1) for bound in (rough.least, rough.most))
        further = np.maximum.reduceat(beyond[left], start) + 2 * radius
        near = least <= most.min(axis=0) + further
        near &= near.sum(axis=0) > 1
        found[:, left] = np.repeat(most + radius, held, axis=1)
        wanted[:, left] = np.repeat(near, held, axis=1)
        left = left[wanted[:, left].any(axis=0)]
    return found, wanted


def _cubes(points: Floats, size: float) -> tuple[Ints, Ints]:
    """An order in which points of one cube stand together, and where each cube's begin."""
    if not len(points):
        return np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp)
    cell = np.floor(points / size).astype(np.int64)
    cell -= cell.min(axis=0)
    number = np.ravel_multi_index(tuple(cell.T), tuple(cell.max(axis=0) + 1))
    order = np.argsort(number, kind="stable")
    return order, np.flatnonzero(np.diff(number[order], prepend=-1))


@lru_cache(maxsize=4)
def _joined(sites: tuple[Site, ...]) -> Together:
    """The same sites, which are asked for again and again."""
    return sites[0].together(sites)
