"""FreeCAD's shapes and placements, out of affine solids and a kit's placements."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD
import Part

from freecad.scadgen.affine import Solid
from freecad.scadgen.brep import brep

__all__ = ["make_shape", "placed"]


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
    """Where a part stands: its half turn first, then its turn, then its place.

    Parameters
    ----------
    placement
        One of a kit's placements: ``at`` in edge lengths, ``turn`` in degrees, ``flip``.
    edge_length
        In mm.
    """
    x, y = placement["at"]
    flip = FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 180.0 if placement["flip"] else 0.0)
    turn = FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), placement["turn"])
    return FreeCAD.Placement(FreeCAD.Vector(x * edge_length, y * edge_length, 0), turn * flip)
