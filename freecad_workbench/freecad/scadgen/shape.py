"""FreeCAD's shapes and placements, out of affine solids and a kit's placements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import FreeCAD
import Part

from freecad.scadgen.affine import Solid
from freecad.scadgen.brep import brep

__all__ = ["make_shape", "placed", "put"]


def make_shape(solid: Solid, values: Mapping[str, float]) -> Part.Solid:
    """Solid of FreeCAD: closed, valid, its faces outwards.

    Parameters
    ----------
    solid
        The affine solid.
    values
        All live parameters, in mm, inside their ranges.
    """
    shape = Part.Shape()
    shape.importBrepFromString(brep(solid, values))
    return shape.Solids[0]


def placed(placement: Mapping[str, Any], edge_length: float) -> FreeCAD.Placement:
    """Where a part stands.

    Parameters
    ----------
    placement
        One of a kit's placements: ``at`` in edge lengths; ``x`` and ``z`` are where these axes
        of the part point.
    edge_length
        In mm.
    """
    x, z = (FreeCAD.Vector(*placement[name]) for name in ("x", "z"))
    y, at = z.cross(x), FreeCAD.Vector(*placement["at"]) * edge_length
    rows = zip(x, y, z, at)
    return FreeCAD.Placement(FreeCAD.Matrix(*(v for row in rows for v in row), 0, 0, 0, 1))


def put(link: Any, places: Sequence[FreeCAD.Placement]) -> None:
    """Let a link show what it links to at these places, and nowhere else.

    Parameters
    ----------
    link
        A link whose elements are not shown in the tree.
    places
        Where; a link without elements would show one, so that there is a hidden one if there
        are none.
    """
    link.ElementCount = max(1, len(places))
    link.setElementVisible("0", bool(places))
    link.PlacementList = [*places] or [FreeCAD.Placement()]
