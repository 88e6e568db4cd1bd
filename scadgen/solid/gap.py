"""How far apart two solids are, and how much they overlap.

Both are asked of manifold3d, in double precision: its gap of two boxes 100 mm long is
within 1e-13 mm of the truth.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from scadgen.errors import InputError, InvariantError
from scadgen.solid.affine import Floats, Ints

if TYPE_CHECKING:
    from manifold3d import Manifold

__all__ = ["overlap_volume", "smallest_gap", "solid", "thickness"]


def solid(points: Floats, triangles: Ints) -> Manifold:
    """A mesh as manifold3d takes it.

    Parameters
    ----------
    points
        ``(v, 3) float``, mm.
    triangles
        ``(m, 3) int``, closed and oriented.

    Raises
    ------
    InvariantError
        If manifold3d refuses the mesh or finds it inside out, which is a bug here.
    """
    from manifold3d import Error, Manifold, Mesh64  # slow to import

    mesh = Mesh64(
        vert_properties=np.ascontiguousarray(points, dtype=np.float64),
        tri_verts=np.ascontiguousarray(triangles, dtype=np.uint64),
    )
    found = Manifold(mesh)
    if found.status() != Error.NoError:
        msg = f"oriented 2-manifold: manifold3d refuses the mesh, {found.status().name}"
        raise InvariantError(msg)
    if not found.volume() > 0:
        msg = f"positive volume: manifold3d finds {found.volume():.6g} mm3"
        raise InvariantError(msg)
    return found


def smallest_gap(
    points_a: Floats, triangles_a: Ints, points_b: Floats, triangles_b: Ints, limit: float
) -> float:
    """Smallest distance between two solids.

    Parameters
    ----------
    points_a, points_b
        ``(v, 3) float``, mm.
    triangles_a, triangles_b
        ``(m, 3) int``, closed and oriented.
    limit
        Distance in mm beyond which it need not be known, above 0; a tight one is fast.

    Returns
    -------
    gap
        In mm: 0 where the solids touch or overlap, `limit` where they are farther apart.

    Raises
    ------
    InputError
        If `limit` is not a finite number above 0.
    InvariantError
        If one of the meshes is not a solid.
    """
    if not 0 < limit < np.inf:
        msg = f"limit of the gap is {limit} mm; it must be above 0 and finite"
        raise InputError(msg)
    one, other = solid(points_a, triangles_a), solid(points_b, triangles_b)
    return float(one.min_gap(other, limit))


def thickness(common: Manifold) -> float:
    """Mean thickness of the thickest piece of what two solids share.

    Of a film it is how deep they are in each other, whatever its shape: twice the volume over
    the surface.

    Parameters
    ----------
    common
        What they share, in any number of pieces.

    Returns
    -------
    depth
        In mm; 0 where they share nothing.
    """
    pieces = (piece for piece in common.decompose() if piece.volume() > 0)
    return max((float(2 * p.volume() / p.surface_area()) for p in pieces), default=0.0)


def overlap_volume(
    points_a: Floats, triangles_a: Ints, points_b: Floats, triangles_b: Ints
) -> float:
    """Volume that two solids have in common, in mm3.

    Parameters
    ----------
    points_a, points_b
        ``(v, 3) float``, mm.
    triangles_a, triangles_b
        ``(m, 3) int``, closed and oriented.

    Returns
    -------
    volume
        In mm3; 0 where they only touch.

    Raises
    ------
    InvariantError
        If one of the meshes is not a solid.
    """
    common = solid(points_a, triangles_a) ^ solid(points_b, triangles_b)
    return float(common.volume())
