"""Where a part's number goes on its tube, for the OpenSCAD file.

The top of a tube is two triangles on four corners.  The file leaves them out where numbers are
asked for, and puts a grid of squares in their place, some of them higher or lower: digits.  So
a part with its number is one polyhedron still, and no boolean is left for OpenSCAD.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scadgen.kit.bill import numbers
from scadgen.kit.model import Kit
from scadgen.solid.affine import AffineSolid, Linear, Range

__all__ = ["HEIGHT", "HIGHEST", "TubeTop", "tubes"]

#: Numbers rise or sink by this at most, in mm; the wall above a bore is 1.9 mm or more.
HIGHEST = 1

#: What may be set for numbers, which only OpenSCAD draws.
HEIGHT = Range(
    "number_height",
    Linear({}, -HIGHEST),
    Linear({}, HIGHEST),
    "deeper ones could meet a bore, and higher ones stand off",
)


@dataclass(frozen=True, slots=True)
class TubeTop:
    """The top of one part's tube.

    Parameters
    ----------
    part, number
        The part's name and number.
    faces
        Numbers of its two triangles.
    corners
        Its vertices, counter-clockwise from above, from the near one on the right of the edge.
    """

    part: str
    number: int
    faces: tuple[int, int]
    corners: tuple[int, int, int, int]


def tubes(kit: Kit) -> tuple[TubeTop, ...]:
    """The tops of the tubes of all edge elements, in the order of the kit.

    Parameters
    ----------
    kit
        The kit; an edge element whose tube has no top of two triangles is left out.
    """
    number = numbers(kit)
    found = (_tube(kit.parts[name], number[name]) for name in kit.elements)
    return tuple(tube for tube in found if tube is not None)


def _tube(solid: AffineSolid, number: int) -> TubeTop | None:
    """The triangles on top that reach from one end of the edge to the other."""
    tables = solid.coefficients
    if "side" not in tables or "edge_length" not in tables:
        return None
    top = tables["side"][:, 2] == 0.5
    for name, table in tables.items():
        top &= (name == "side") | (table[:, 2] == 0.0)
    far = tables["edge_length"][:, 0] > 0
    reach = far[solid.triangles].any(axis=1) & ~far[solid.triangles].all(axis=1)
    faces = np.flatnonzero(reach & top[solid.triangles].all(axis=1))
    found = np.unique(solid.triangles[faces])
    left = tables["side"][found, 1] > 0
    if len(faces) != 2 or len(found) != 4 or np.count_nonzero(left) != 2:
        return None
    # From the near right one: right ones away from the joint, then left ones back.
    a, b, c, d = found[np.lexsort((left != far[found], left))].tolist()
    return TubeTop(solid.name, number, (int(faces[0]), int(faces[1])), (a, b, c, d))
