"""What part of the plane to fill with tiles, and which of them lie inside."""

from __future__ import annotations

import math
from typing import TypedDict

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from scadgen.errors import InputError
from scadgen.plane.cells import Cell
from scadgen.solid.affine import Floats, Ints

__all__ = [
    "MOST_TILES",
    "STICK_OUT",
    "Area",
    "check_count",
    "cover",
    "lies_inside",
    "outline_of",
    "positive",
]

#: A frame of tiles has at most this many before it is clipped; more is a slip of the keyboard.
MOST_TILES = 100_000

#: How far a tile may stick out of an outline, in shortest edges: a tile that just fits, fits.
STICK_OUT = 1e-6


class Area(TypedDict, total=False):
    """What part of the plane to fill; 3 rows and 3 columns if nothing is said.

    Parameters
    ----------
    rows, columns
        Cells up and across.  Uneven rows are moved back by whole cells, so that they stand
        above one another.
    radius
        Radius of a circle around the middle of a tile, in mm, instead of rows and columns.
    outline
        ``(k, 2) float``: corners of a polygon instead, in mm.  The middle of its bounding
        box is the middle of a tile.
    """

    rows: int
    columns: int
    radius: float
    outline: ArrayLike


def outline_of(area: Area) -> tuple[shapely.Polygon | float | None, Floats]:
    """The outline, or the circle's radius, and where its middle is.

    Raises
    ------
    InputError
        More is said than one way, a radius that is not positive, or no simple polygon.
    """
    given = [name for name in ("radius", "outline") if area.get(name) is not None]
    counts = [name for name in ("rows", "columns") if area.get(name) is not None]
    if len(given) + bool(counts) > 1:
        msg = f"{' and '.join(counts + given)}: give rows and columns, or one of radius, outline"
        raise InputError(msg)
    if "radius" in given:
        return positive("radius", area["radius"]), np.zeros(2)
    if not given:
        return None, np.zeros(2)
    corners = np.asarray(area["outline"], dtype=float)
    good = corners.ndim == 2 and corners.shape[1] == 2 and len(corners) > 2
    polygon = shapely.Polygon(corners) if good and np.isfinite(corners).all() else None
    if polygon is None or not polygon.is_valid or polygon.area <= 0:
        msg = f"outline of shape {corners.shape}: must be 3 or more corners of a simple polygon"
        raise InputError(msg)
    return polygon, (corners.min(axis=0) + corners.max(axis=0)) / 2


def cover(cell: Cell, basis: Floats, origin: Floats, shape: shapely.Polygon | float) -> Ints:
    """Cells that may have a tile inside a shape, and more: ``(n, 2) int``, counts of the moves.

    Parameters
    ----------
    cell
        The cell that repeats.
    basis
        ``(b, 2) float``: what its whole numbers count, in mm.
    origin
        ``(2,) float``: where the first cell is, in mm.
    shape
        The outline, or the radius of a circle around (0, 0), in mm.

    Raises
    ------
    InputError
        There are too many tiles.
    """
    box = np.array([-shape, -shape, shape, shape] if isinstance(shape, float) else shape.bounds)
    corners = np.array([box[[0, 1]], box[[2, 1]], box[[2, 3]], box[[0, 3]]]) - origin
    places = corners @ np.linalg.inv(cell.moves @ basis)
    low = np.floor(places.min(axis=0)) - 2
    high = np.ceil(places.max(axis=0)) + 2
    check_count(float(np.prod(high - low + 1)) * len(cell.tiles))
    i, j = (np.arange(a, b + 1, dtype=np.int64) for a, b in zip(low, high, strict=True))
    return np.stack(np.meshgrid(i, j, indexing="ij"), axis=-1).reshape(-1, 2)


def lies_inside(
    corners: Floats, shape: shapely.Polygon | float, margin: float
) -> NDArray[np.bool_]:
    """Which tiles, ``(n, k, 2)``, lie inside."""
    if isinstance(shape, float):
        return np.asarray((np.linalg.norm(corners, axis=2) <= shape + margin).all(axis=1))
    wide = shape.buffer(margin, join_style="mitre")
    shapely.prepare(wide)
    return np.asarray(shapely.covers(wide, shapely.polygons(corners)))


def positive(name: str, value: float) -> float:
    """A length in mm that must be positive.

    Raises
    ------
    InputError
        It is not.
    """
    if not (math.isfinite(value) and value > 0):
        msg = f"{name} = {value!r}: must be a positive number of mm"
        raise InputError(msg)
    return float(value)


def check_count(tiles: float) -> None:
    """Refuse more tiles than `MOST_TILES`.

    Raises
    ------
    InputError
        There are more.
    """
    if not tiles <= MOST_TILES:
        msg = f"{tiles:.0f} tiles: at most {MOST_TILES}; longer edges or a smaller area make fewer"
        raise InputError(msg)
