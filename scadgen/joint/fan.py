"""Which way each polygon of a wall is cut into triangles: that which stays nearest to the wall."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from scadgen.joint.walls import Key, Wedge
from scadgen.joint.weave import SiteCurve
from scadgen.solid.affine import Floats, Ints

__all__ = ["fanned"]

#: Decimals, in sides, to which choices are compared, so that rounding does not decide.
_DECIMALS = 9


def fanned(
    walls: Sequence[Wedge], position: dict[Key, Floats], curves: Sequence[SiteCurve]
) -> list[Wedge]:
    """The polygons, each starting at the corner from which it is to be cut into a fan.

    That is the corner whose diagonals' middles are the nearest to the exact wall, or else
    the one with the shortest diagonals.  The choice depends on places alone, so polygons that
    a symmetry of the joint maps to each other are cut alike.
    """
    rows: list[tuple[int, int, Key, Key]] = []
    for number, wedge in enumerate(walls):
        corners = wedge.corners
        count = len(corners)
        for n in range(count if count > 3 else 0):
            rows += [
                (number, n, corners[n], corners[(n + step) % count]) for step in range(2, count - 1)
            ]
    if not rows:
        return list(walls)
    first = np.array([position[start] for _, _, start, _ in rows])
    second = np.array([position[stop] for _, _, _, stop in rows])
    low, high = (
        np.array([getattr(walls[row[0]], side) for row in rows]) for side in ("low", "high")
    )
    off = _distance_from_wall((first + second) / 2, low, high, curves)
    length = np.linalg.norm(first - second, axis=1)
    score = {(number, n): [0.0, 0.0] for number, n, _, _ in rows}
    for (number, n, _, _), near, far in zip(rows, off.tolist(), length.tolist(), strict=True):
        score[number, n][0] = max(score[number, n][0], near)
        score[number, n][1] += far
    return [
        _from_best(wedge, [score[number, n] for n in range(len(wedge.corners))])
        if len(wedge.corners) > 3
        else wedge
        for number, wedge in enumerate(walls)
    ]


def _distance_from_wall(
    points: Floats, low: Ints, high: Ints, curves: Sequence[SiteCurve]
) -> Floats:
    """Distance of points from the wall between two labels, to first order."""
    found = [curve.distance(points) for curve in curves]
    far, slope = np.stack([d for d, _ in found]), np.stack([g for _, g in found])
    row = np.arange(len(points))
    steep = np.linalg.norm(slope[low, row] - slope[high, row], axis=1)
    return np.asarray(np.abs(far[low, row] - far[high, row]) / np.maximum(steep, 1e-6))


def _from_best(wedge: Wedge, scores: list[list[float]]) -> Wedge:
    """The polygon starting at the corner with the best score."""
    corners = wedge.corners
    best = min(
        range(len(corners)), key=lambda n: (*(round(s, _DECIMALS) for s in scores[n]), corners[n])
    )
    return replace(wedge, corners=(*corners[best:], *corners[:best]))
