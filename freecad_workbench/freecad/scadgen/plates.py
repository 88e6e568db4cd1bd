"""Lays out pieces on printer beds, in rows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Tuple

from freecad.scadgen.kit_data import KitError
from freecad.scadgen.mesh_files import Body, Matrix

__all__ = ["plates"]

#: Room between pieces, in mm.
_GAP = 5.0

Point = Tuple[float, float, float]


def plates(bodies: Sequence[Body], bed: tuple[float, float]) -> list[list[Body]]:
    """Pieces on as many beds as they need.

    Parameters
    ----------
    bodies
        What to print; the number of `places` says how many of each.
    bed
        Width and depth, in mm.

    Returns
    -------
    plates
        For each bed, the bodies on it; all pieces lie on z = 0 within the bed.

    Raises
    ------
    KitError
        A piece is larger than the bed.
    """
    flat = [(*_flat(body, bed), body) for body in bodies]
    flat.sort(key=lambda entry: -entry[1])
    found: list[dict[str, list[Matrix]]] = []
    x = y = deepest = 0.0
    for width, depth, place, body in flat:
        for _ in body.places:
            if x + width > bed[0]:
                x, y, deepest = 0.0, y + deepest + _GAP, 0.0
            if not found or y + depth > bed[1]:
                found.append({})
                x = y = deepest = 0.0
            there = (*place[:9], place[9] + x, place[10] + y, place[11])
            found[-1].setdefault(body.name, []).append(there)
            x, deepest = x + width + _GAP, max(deepest, depth)
    return [
        [b._replace(places=plate[b.name]) for b in bodies if b.name in plate] for plate in found
    ]


def _flat(body: Body, bed: tuple[float, float]) -> tuple[float, float, Matrix]:
    """Width, depth and placement of a body with a corner at the origin, turned if it must be."""
    low, high = _extent(body.points)
    width, depth = high[0] - low[0], high[1] - low[1]
    if width <= bed[0] and depth <= bed[1]:
        return width, depth, (1, 0, 0, 0, 1, 0, 0, 0, 1, -low[0], -low[1], -low[2])
    if depth <= bed[0] and width <= bed[1]:
        return depth, width, (0, 1, 0, -1, 0, 0, 0, 0, 1, high[1], -low[0], -low[2])
    msg = (
        f"{body.name} is {width:.0f} x {depth:.0f} mm: it must fit the bed of {bed[0]:g} x "
        f"{bed[1]:g} mm, which is set under Edit > Preferences > Scadgen"
    )
    raise KitError(msg)


def _extent(points: Sequence[Point]) -> tuple[Point, Point]:
    xs, ys, zs = zip(*points)
    return (min(xs), min(ys), min(zs)), (max(xs), max(ys), max(zs))
