"""Frames that fill no plane: a ring, a ladder, a strip."""

from __future__ import annotations

import math

import numpy as np

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.plane.drawn import make_frame
from scadgen.solid.affine import Floats

__all__ = ["MOST_SIDES", "ladder", "ring", "strip"]

#: Sides of a ring, bays of a ladder, triangles of a strip: at most this many.
MOST_SIDES = 10_000


def ring(sides: int = 6, edge_length: float = 40.0) -> Frame:
    """One regular polygon around the origin, a side at the bottom.

    Parameters
    ----------
    sides
        3 to `MOST_SIDES`.
    edge_length
        In mm.

    Raises
    ------
    InputError
        A number that is not one of those.
    """
    _count("sides", sides, 3)
    _length("edge_length", edge_length)
    around = 2 * np.pi * (np.arange(sides) + 0.5) / sides - np.pi / 2
    radius = edge_length / 2 / math.sin(math.pi / sides)
    corner = np.arange(sides)
    points = radius * np.stack([np.cos(around), np.sin(around)], axis=1)
    return make_frame("ring", points, np.stack([corner, (corner + 1) % sides], axis=1))


def ladder(bays: int = 5, width: float = 40.0, bay_length: float = 40.0) -> Frame:
    """Two rails along x with rungs between them, one at each end.

    Parameters
    ----------
    bays
        Rectangles in a row, 1 to `MOST_SIDES`.
    width
        Length of the rungs, in mm.
    bay_length
        Distance of the rungs, in mm.

    Raises
    ------
    InputError
        A number that is not one of those.
    """
    _count("bays", bays, 1)
    _length("width", width)
    _length("bay_length", bay_length)
    rung = np.arange(bays + 1)
    points = np.concatenate(
        [np.stack([rung * bay_length, np.full(bays + 1, y)], axis=1) for y in (0.0, width)]
    )
    rails = [np.stack([rung[:-1], rung[1:]], axis=1) + side * (bays + 1) for side in range(2)]
    rungs = np.stack([rung, rung + bays + 1], axis=1)
    return make_frame("ladder", points, np.concatenate([*rails, rungs]))


def strip(triangles: int = 9, edge_length: float = 40.0) -> Frame:
    """Equilateral triangles in a row along x.

    Parameters
    ----------
    triangles
        1 to `MOST_SIDES`.
    edge_length
        In mm.

    Raises
    ------
    InputError
        A number that is not one of those.
    """
    _count("triangles", triangles, 1)
    _length("edge_length", edge_length)
    corner = np.arange(triangles + 2)
    points: Floats = edge_length * np.stack([corner / 2, corner % 2 * math.sqrt(0.75)], axis=1)
    edges = [np.stack([corner[:-k], corner[k:]], axis=1) for k in (1, 2)]
    return make_frame("strip", points, np.concatenate(edges))


def _count(name: str, value: int, least: int) -> None:
    if not least <= value <= MOST_SIDES or value % 1:
        msg = f"{name} = {value!r}: must be a whole number from {least} to {MOST_SIDES}"
        raise InputError(msg)


def _length(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0):
        msg = f"{name} = {value!r}: must be a positive number of mm"
        raise InputError(msg)
