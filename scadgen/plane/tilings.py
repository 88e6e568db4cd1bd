"""Tilings by name: what their cell is, and how large."""

from __future__ import annotations

import math

from scadgen.errors import InputError
from scadgen.plane.area import positive
from scadgen.plane.cells import LAVES, LEFT_OUT, UNIFORM, dual, rhombic_cell, uniform_cell
from scadgen.plane.periodic import Tiling

__all__ = ["laves", "rectangular", "rhombic", "uniform"]


def uniform(configuration: str, edge_length: float = 40.0) -> Tiling:
    """A tiling by regular polygons with the same faces around every vertex.

    Parameters
    ----------
    configuration
        The faces around a vertex, one of `UNIFORM`; the first of its cell is the tile with
        the most sides, and the cells of a row stand side by side along x.
    edge_length
        In mm.

    Raises
    ------
    InputError
        A name or length that is not one of those above.
    """
    if configuration not in UNIFORM:
        msg = f"uniform tiling {configuration!r}: must be one of {', '.join(UNIFORM)}"
        raise InputError(msg)
    return Tiling(configuration, uniform_cell(configuration), edge_length)


def laves(configuration: str, edge_length: float = 40.0) -> Tiling:
    """The dual of a uniform tiling, where its edges are even enough.

    Parameters
    ----------
    configuration
        The faces around a vertex of the uniform tiling, one of `LAVES`; a cell has one tile
        for each vertex of the uniform cell.
    edge_length
        Length of its shortest edges, in mm; the longest are up to sqrt(3) times that.

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
    return Tiling(f"V{configuration}", dual(uniform_cell(configuration)), edge_length)


def rectangular(width: float = 60.0, height: float = 40.0) -> Tiling:
    """Rectangles in rows and columns; sides in mm.

    Raises
    ------
    InputError
        As `uniform`.
    """
    for name, value in (("width", width), ("height", height)):
        positive(name, value)
    cell = rhombic_cell(width, height, math.pi / 2)
    return Tiling("rectangular", cell, min(width, height))


def rhombic(angle: float = 60.0, edge_length: float = 40.0) -> Tiling:
    """Rhombs in rows that lean.

    Parameters
    ----------
    angle
        Angle of a rhomb at its lower left, in degrees, between 0 and 180.
    edge_length
        In mm.

    Raises
    ------
    InputError
        As `uniform`.
    """
    if not 0 < angle < 180:
        msg = f"angle = {angle!r}: must be between 0 and 180 degrees"
        raise InputError(msg)
    cell = rhombic_cell(1.0, 1.0, math.radians(angle))
    return Tiling("rhombic", cell, edge_length, lean=True)
