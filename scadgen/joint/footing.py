"""The square on a sloped flat where a tube stands, and the ledge that it leaves around itself."""

from __future__ import annotations

import itertools
import math

import numpy as np
import shapely

from scadgen.errors import GeometryError, InvariantError
from scadgen.joint.surface import Surface
from scadgen.joint.walls import Facet
from scadgen.solid.affine import Floats, Ints

__all__ = ["LEDGE", "SPLIT", "TUBE", "with_footing"]

#: The facets where the tube stands, where the halves part, and of what is left of a sloped flat.
TUBE: Facet = ("outer", 0)
SPLIT: Facet = ("split", 0)
LEDGE: Facet = ("ledge", 0)


def with_footing(half: Surface, slope: float, middle: Floats, sign: float) -> Surface:
    """A half whose flat is divided into its part of the tube's square, and a ledge.

    Parameters
    ----------
    half
        Half of a connector, whose flat is one facet.
    slope
        Of its edge, in radians.
    middle
        ``(3,) float``: the square's, in sides.
    sign
        1 for half A, -1 for half B.

    Raises
    ------
    GeometryError
        A wall runs across the square.
    """
    up = np.array([math.sin(slope), 0.0, math.cos(slope)]) / 2
    aside = np.array([0.0, sign / 2, 0.0])
    square = np.array([middle + way for way in (up, up + aside, aside - up, -up)])
    flat, split = half.outlines[TUBE].tolist(), half.outlines[SPLIT].tolist()
    height, (low, high) = half.points[:, 2], (middle[2] - up[2], middle[2] + up[2])
    sides = [side for side in flat if side[::-1] in split]
    beside = [s for s in sides if min(height[s]) < low and max(height[s]) > high]
    around = [side for side in flat if side not in beside]
    inside = shapely.box(*np.sort([(0.0, low), (sign / 2, high)], axis=0).ravel())
    crossing = shapely.linestrings(half.points[np.array(around)][..., 1:])
    if len(beside) != 1 or shapely.intersects(crossing, inside).any():
        msg = (
            "a wall runs across the square where a tube stands; a smaller span or "
            "a smaller bend helps"
        )
        raise GeometryError(msg)
    (start, stop), first = beside[0], len(half.points)
    # The flat is on the left of its sides: of half A the split's goes down, of half B up.
    corners = [first + n for n in (range(4) if sign > 0 else range(3, -1, -1))]
    if (height[start] > height[stop]) != (sign > 0):
        msg = "half A is on the left of the plane through its edge, seen from outside"
        raise InvariantError(msg)
    way = [start, *corners, stop]
    split.remove([stop, start])
    line = [stop, corners[3], corners[0], start]
    outlines = {
        **half.outlines,
        TUBE: _sides([*corners[::-1], corners[3]]),
        LEDGE: np.array([*around, *_sides(way).tolist()]),
        SPLIT: np.array([*split, *_sides(line).tolist()]),
    }
    return Surface(np.concatenate([half.points, square]), half.walls, outlines)


def _sides(line: list[int]) -> Ints:
    return np.array(list(itertools.pairwise(line)), dtype=np.int64)
