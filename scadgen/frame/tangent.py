"""Directions seen along a normal: azimuths in the tangent plane, and slopes below it."""

from __future__ import annotations

import numpy as np

from scadgen.solid.affine import Floats

__all__ = ["STRAIGHT_UP", "UP", "angle_about", "seen_along", "tangents"]

#: The normal of the plane.
UP = np.array([0.0, 0.0, 1.0])
UP.setflags(write=False)

#: A direction nearer than this to the normal has no azimuth, in radians.
STRAIGHT_UP = 1e-6

#: An azimuth this little short of a full turn is 0, in radians: what the last decimal does
#: to an edge of a tenth of a millimetre.
_NEARLY_ROUND = 1e-8


def tangents(normals: Floats) -> tuple[Floats, Floats]:
    """The axes from which azimuths count: x and y for a normal that is up.

    Parameters
    ----------
    normals
        ``(k, 3) float``, of length 1.

    Returns
    -------
    first, second
        ``(k, 3) float``: with the normal they are right-handed (Duff and others, Building an
        Orthonormal Basis, Revisited, 2017).
    """
    x, y, z = normals.T
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    first = np.stack([1.0 + sign * x * x * a, sign * b, -sign * x], axis=1)
    second = np.stack([b, sign + y * y * a, -y], axis=1)
    return first, second


def seen_along(normals: Floats, directions: Floats) -> tuple[Floats, Floats]:
    """Azimuth and slope of directions as seen along normals.

    Parameters
    ----------
    normals, directions
        ``(k, 3) float``; normals of length 1.

    Returns
    -------
    azimuth
        ``(k,) float``: in [0, 2 pi), counter-clockwise; not a number along the normal.
    slope
        ``(k,) float``: how far below the tangent plane, in radians; a direction that descends
        has a positive one.
    """
    first, second = tangents(normals)
    across = (directions * first).sum(axis=1)
    along = (directions * second).sum(axis=1)
    down = -(directions * normals).sum(axis=1)
    level = np.hypot(across, along)
    azimuth = np.arctan2(along, across) % (2 * np.pi)
    azimuth[azimuth > 2 * np.pi - _NEARLY_ROUND] = 0.0
    azimuth[level <= STRAIGHT_UP * np.abs(down)] = np.nan
    return azimuth, np.arctan2(down, level) + 0.0


def angle_about(axes: Floats, first: Floats, second: Floats) -> Floats:
    """Angle about axes from one direction to another, both made square to the axis.

    Parameters
    ----------
    axes, first, second
        ``(k, 3) float``; axes of length 1.

    Returns
    -------
    angles
        ``(k,) float``: in radians, -pi to pi.
    """
    flat = [way - (way * axes).sum(axis=1)[:, None] * axes for way in (first, second)]
    sine = (axes * np.cross(*flat)).sum(axis=1)
    return np.asarray(np.arctan2(sine, (flat[0] * flat[1]).sum(axis=1)) + 0.0)
