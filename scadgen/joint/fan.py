"""Which way each polygon of a wall is cut into triangles: that which stays nearest to the wall."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from scadgen.joint.domain import OUTSIDE, Domain
from scadgen.joint.site import Site, slopes
from scadgen.joint.walls import Feature, Wedge
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.vectors import cross

__all__ = ["fanned"]

#: A triangle with less than this share of its polygon's area, seen along its normal, folds back.
_FOLD = 0.02

#: Decimals, in sides, to which choices are compared, so that rounding does not decide.
_DECIMALS = 9


def fanned(
    walls: Sequence[Wedge],
    position: dict[Feature, Floats],
    curves: Sequence[Site],
    domain: Domain,
) -> list[Wedge]:
    """The polygons, each starting at the corner from which it is to be cut into a fan.

    That is a corner from which no triangle folds back or leaves the domain where its outside leans
    inwards, and whose diagonals' middles are the nearest to the exact wall.  The choice depends on
    places alone, so polygons that a symmetry of the joint maps to each other are cut alike.
    """
    result = list(walls)
    for count in sorted({len(wedge.corners) for wedge in walls} - {3}):
        numbers = [n for n, wedge in enumerate(walls) if len(wedge.corners) == count]
        corners = np.array([[position[c] for c in walls[n].corners] for n in numbers])
        labels = np.array([(walls[n].low, walls[n].high) for n in numbers])
        scores = np.stack(_scores(corners, labels, curves, domain), axis=2).tolist()
        for row, number in enumerate(numbers):
            wedge = walls[number]
            best = min(range(count), key=lambda n: (*scores[row][n], wedge.corners[n]))
            turned = (*wedge.corners[best:], *wedge.corners[:best])
            result[number] = wedge._replace(corners=turned)
    return result


def _scores(corners: Floats, labels: Ints, curves: Sequence[Site], domain: Domain) -> list[Floats]:
    """How bad it is to cut ``(p, k, 3)`` polygons from each corner, ``(p, k)``; compared in order.

    Whether a triangle folds back or leaves the domain, how far the diagonals' middles are from the
    wall, and how long the diagonals are.
    """
    count = corners.shape[1]
    pairs = itertools.combinations(range(count), 2)
    ends = np.array([(a, b) for a, b in pairs if 1 < b - a < count - 1])
    start, stop = (corners[:, side] for side in ends.T)
    middles = ((start + stop) / 2).reshape(-1, 3)
    low, high = (np.repeat(labels[:, side], len(ends)) for side in (0, 1))
    off = _distance_from_wall(middles, low, high, curves).reshape(len(corners), -1)
    length = np.linalg.norm(stop - start, axis=2)
    out = np.zeros(off.shape, dtype=np.bool_)
    if domain.leans:
        out = (domain.beyond(middles) > OUTSIDE).reshape(off.shape)
    mine = [(ends == corner).any(axis=1) for corner in range(count)]
    return [
        np.stack([_folds(np.roll(corners, -turn, axis=1)) for turn in range(count)], axis=1)
        + np.stack([out[:, own].sum(axis=1) for own in mine], axis=1),
        np.stack([off[:, own].max(axis=1) for own in mine], axis=1).round(_DECIMALS),
        np.stack([length[:, own].sum(axis=1) for own in mine], axis=1).round(_DECIMALS),
    ]


def _folds(corners: Floats) -> Floats:
    """Whether a triangle of polygons that are cut from their first corners folds back."""
    arms = corners[:, 1:] - corners[:, :1]
    normals = cross(arms[:, :-1], arms[:, 1:])
    total = normals.sum(axis=1)
    upright = np.einsum("pkx,px->pk", normals, total) / np.einsum("px,px->p", total, total)[:, None]
    return np.asarray((upright.min(axis=1) < _FOLD) * 1.0)


def _distance_from_wall(points: Floats, low: Ints, high: Ints, curves: Sequence[Site]) -> Floats:
    """Distance of points from the wall between two labels, to first order."""
    (near, toward), (far, away) = (slopes(curves, points, which) for which in (low, high))
    steep = np.linalg.norm(toward - away, axis=1)
    return np.asarray(np.abs(near - far) / np.maximum(steep, 1e-6))
