"""Frames from tilings: whole tiles, so that no edge dangles at the rim.

With rows and columns a frame has that many whole cells.  Within an outline it has every
tile that lies inside, and of these the largest group that hangs together by edges: tiles
that touch the others in a corner only would swing there.
"""

from __future__ import annotations

import math
from typing import TypedDict, Unpack

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scadgen.errors import InputError
from scadgen.frame.cells import LAVES, LEFT_OUT, UNIFORM, Cell, dual, rhombic_cell, uniform_cell
from scadgen.frame.graph import Frame, make_frame
from scadgen.solid.affine import Floats, Ints

__all__ = ["MOST_TILES", "Area", "laves", "rectangular", "rhombic", "uniform"]

#: A frame of tiles has at most this many before it is clipped; more is a slip of the keyboard.
MOST_TILES = 100_000

#: How far a tile may stick out of an outline, in shortest edges: a tile that just fits, fits.
_STICK_OUT = 1e-6


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


def uniform(configuration: str, edge_length: float = 40.0, **area: Unpack[Area]) -> Frame:
    """A tiling by regular polygons with the same faces around every vertex.

    Parameters
    ----------
    configuration
        The faces around a vertex, one of `UNIFORM`; the first of its cell is the tile with
        the most sides, and the cells of a row stand side by side along x.
    edge_length
        In mm.
    **area
        `Area`.

    Raises
    ------
    InputError
        A name, length or area that is not one of those above, or too small for one tile.
    """
    if configuration not in UNIFORM:
        msg = f"uniform tiling {configuration!r}: must be one of {', '.join(UNIFORM)}"
        raise InputError(msg)
    return _fill(configuration, uniform_cell(configuration), edge_length, area)


def laves(configuration: str, edge_length: float = 40.0, **area: Unpack[Area]) -> Frame:
    """The dual of a uniform tiling, where its edges are even enough.

    Parameters
    ----------
    configuration
        The faces around a vertex of the uniform tiling, one of `LAVES`; a cell has one tile
        for each vertex of the uniform cell.
    edge_length
        Length of its shortest edges, in mm; the longest are up to sqrt(3) times that.
    **area
        `Area`.

    Raises
    ------
    InputError
        As `uniform`; a dual that is left out says why.
    """
    if configuration not in LAVES:
        why = LEFT_OUT.get(configuration)
        msg = f"dual of {configuration!r}: {f'{why}; ' if why else ''}must be one of " + ", ".join(
            LAVES
        )
        raise InputError(msg)
    return _fill(f"V{configuration}", dual(uniform_cell(configuration)), edge_length, area)


def rectangular(width: float = 60.0, height: float = 40.0, **area: Unpack[Area]) -> Frame:
    """Rectangles in rows and columns; sides in mm.

    Raises
    ------
    InputError
        As `uniform`.
    """
    for name, value in (("width", width), ("height", height)):
        _positive(name, value)
    return _fill("rectangular", rhombic_cell(width, height, math.pi / 2), min(width, height), area)


def rhombic(angle: float = 60.0, edge_length: float = 40.0, **area: Unpack[Area]) -> Frame:
    """Rhombs in rows that lean.

    Parameters
    ----------
    angle
        Angle of a rhomb at its lower left, in degrees, between 0 and 180.
    edge_length
        In mm.
    **area
        `Area`; rows are not moved back.

    Raises
    ------
    InputError
        As `uniform`.
    """
    if not 0 < angle < 180:
        msg = f"angle = {angle!r}: must be between 0 and 180 degrees"
        raise InputError(msg)
    cell = rhombic_cell(1.0, 1.0, math.radians(angle))
    return _fill("rhombic", cell, edge_length, area, lean=True)


def _fill(name: str, cell: Cell, edge_length: float, area: Area, *, lean: bool = False) -> Frame:
    """Put cells down, keep tiles, and take their corners and sides."""
    _positive("edge_length", edge_length)
    across = cell.moves[0] @ cell.basis
    turn = np.array([[across[0], -across[1]], [across[1], across[0]]]) / np.hypot(*across)
    basis = edge_length * cell.basis @ turn
    shape, middle = _shape(area)
    if shape is None:
        places = _block(cell, area.get("rows", 3), area.get("columns", 3), lean=lean)
        origin = np.zeros(2)
    else:
        origin = middle - (cell.tiles[0] @ basis).mean(axis=0)
        places = _cover(cell, basis, origin, shape)
    moved = places @ cell.moves
    tiles = [tile + moved[:, None] for tile in cell.tiles]
    if shape is not None:
        kept = [_inside(t @ basis + origin, shape, _STICK_OUT * edge_length) for t in tiles]
        tiles = [t[inside] for t, inside in zip(tiles, kept, strict=True)]
        if not any(map(len, tiles)):
            msg = (
                f"{name}: no tile with edges of {edge_length:g} mm fits inside the outline; "
                "a larger one or shorter edges work"
            )
            raise InputError(msg)
    points, edges, tile_of = _outlines(tiles)
    if shape is not None:
        edges = _largest_group(edges, tile_of)
    used, numbers = np.unique(edges, return_inverse=True)
    edges = np.unique(np.sort(numbers.reshape(-1, 2), axis=1), axis=0)
    return make_frame(name, points[used] @ basis + origin, edges)


def _shape(area: Area) -> tuple[shapely.Polygon | float | None, Floats]:
    """The outline, or the circle's radius, and where its middle is."""
    given = [name for name in ("radius", "outline") if area.get(name) is not None]
    counts = [name for name in ("rows", "columns") if area.get(name) is not None]
    if len(given) + bool(counts) > 1:
        msg = f"{' and '.join(counts + given)}: give rows and columns, or one of radius, outline"
        raise InputError(msg)
    if "radius" in given:
        return _positive("radius", area["radius"]), np.zeros(2)
    if not given:
        return None, np.zeros(2)
    corners = np.asarray(area["outline"], dtype=float)
    good = corners.ndim == 2 and corners.shape[1] == 2 and len(corners) > 2
    polygon = shapely.Polygon(corners) if good and np.isfinite(corners).all() else None
    if polygon is None or not polygon.is_valid or polygon.area <= 0:
        msg = f"outline of shape {corners.shape}: must be 3 or more corners of a simple polygon"
        raise InputError(msg)
    return polygon, (corners.min(axis=0) + corners.max(axis=0)) / 2


def _block(cell: Cell, rows: int, columns: int, *, lean: bool) -> Ints:
    """Which cells stand in rows and columns, as ``(n, 2)`` counts of the two moves."""
    for name, value in (("rows", rows), ("columns", columns)):
        if not 1 <= value <= MOST_TILES or value % 1:
            msg = f"{name} = {value!r}: must be a whole number from 1 to {MOST_TILES}"
            raise InputError(msg)
    _check_count(rows * columns * len(cell.tiles))
    across, up = cell.moves @ cell.basis
    drift = 0.0 if lean else float(up @ across / (across @ across))
    row, column = np.divmod(np.arange(rows * columns), columns)
    return np.stack([column - np.floor(row * drift + 1e-9).astype(np.int64), row], axis=1)


def _cover(cell: Cell, basis: Floats, origin: Floats, shape: shapely.Polygon | float) -> Ints:
    """Cells that may have a tile inside a shape, and more."""
    box = np.array([-shape, -shape, shape, shape] if isinstance(shape, float) else shape.bounds)
    corners = np.array([box[[0, 1]], box[[2, 1]], box[[2, 3]], box[[0, 3]]]) - origin
    places = corners @ np.linalg.inv(cell.moves @ basis)
    low = np.floor(places.min(axis=0)) - 2
    high = np.ceil(places.max(axis=0)) + 2
    _check_count(float(np.prod(high - low + 1)) * len(cell.tiles))
    i, j = (np.arange(a, b + 1, dtype=np.int64) for a, b in zip(low, high, strict=True))
    return np.stack(np.meshgrid(i, j, indexing="ij"), axis=-1).reshape(-1, 2)


def _inside(corners: Floats, shape: shapely.Polygon | float, margin: float) -> NDArray[np.bool_]:
    """Which tiles, ``(n, k, 2)``, lie inside."""
    if isinstance(shape, float):
        return np.asarray((np.linalg.norm(corners, axis=2) <= shape + margin).all(axis=1))
    wide = shape.buffer(margin, join_style="mitre")
    shapely.prepare(wide)
    return np.asarray(shapely.covers(wide, shapely.polygons(corners)))


def _outlines(tiles: list[Ints]) -> tuple[Ints, Ints, Ints]:
    """All corners, each once; the sides of all tiles as pairs of them; whose side it is."""
    corners = np.concatenate([t.reshape(-1, t.shape[-1]) for t in tiles])
    points, number = np.unique(corners, axis=0, return_inverse=True)
    number = number.ravel()
    sides, tile_of, at, count = [], [], 0, 0
    for tile in tiles:
        ring = number[at : at + tile.shape[0] * tile.shape[1]].reshape(tile.shape[:2])
        sides.append(np.stack([ring, np.roll(ring, -1, axis=1)], axis=-1).reshape(-1, 2))
        tile_of.append(np.repeat(np.arange(count, count + len(tile)), tile.shape[1]))
        at, count = at + ring.size, count + len(tile)
    return points, np.sort(np.concatenate(sides), axis=1), np.concatenate(tile_of)


def _largest_group(sides: Ints, tile_of: Ints) -> Ints:
    """Sides of the largest group of tiles that hang together by sides; the first of equals."""
    _, edge = np.unique(sides, axis=0, return_inverse=True)
    tiles = int(tile_of.max()) + 1
    size = tiles + int(edge.max()) + 1
    graph = coo_array((np.ones(len(sides)), (tile_of, tiles + edge.ravel())), shape=(size, size))
    label = connected_components(graph, directed=False)[1][:tiles]
    return np.asarray(sides[label[tile_of] == np.bincount(label).argmax()])


def _positive(name: str, value: float) -> float:
    if not (math.isfinite(value) and value > 0):
        msg = f"{name} = {value!r}: must be a positive number of mm"
        raise InputError(msg)
    return float(value)


def _check_count(tiles: float) -> None:
    if not tiles <= MOST_TILES:
        msg = f"{tiles:.0f} tiles: at most {MOST_TILES}; longer edges or a smaller area make fewer"
        raise InputError(msg)
