"""The contacts of a joint's whole connectors on their exact walls.

They are where the lattice crosses the walls, on which two curves are nearest and equally far: there
are no facets that could lock by themselves.  Lengths are in sides, without clearance.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.joint.lattice import Lattice
from scadgen.joint.place import beside_walls, place
from scadgen.joint.site import Site, distances, slopes
from scadgen.joint.walls import Feature
from scadgen.solid.affine import Ints

__all__ = ["whole_contacts"]

#: How much farther than the nearest curve one may be at a wall, in sides: Newton's steps end
#: nearer than that, and where a third curve is nearer there is no wall.
_ON_WALL = 1e-7

#: Difference of two distances' slopes below which a wall's normal is unknown.
_STEEP = 1e-6


def whole_contacts(lattice: Lattice, curves: Sequence[Site]) -> tuple[list[Mesh], Contacts]:
    """Contacts of a joint's whole connectors, where the lattice's edges cross the exact walls.

    Parameters
    ----------
    lattice, curves
        The joint's lattice and site curves.

    Returns
    -------
    meshes
        The points where each connector is touched, one mesh an edge, without faces.
    contacts
        Between these; normals are those of the exact walls.
    """
    beside = beside_walls(lattice, curves)
    keys, pairs = _crossed(beside.argmin(axis=0))
    points = place(lattice, curves, beside, keys)
    first, second = pairs.T
    (near, toward), (far, away) = (slopes(curves, points, which) for which in (first, second))
    normals = toward - away
    length = np.linalg.norm(normals, axis=1)
    nearest = distances(curves, points, _ON_WALL).min(axis=0)
    on_wall = np.maximum(near, far) < nearest + _ON_WALL
    sound = np.flatnonzero(on_wall & (length > _STEEP))
    contacts = Contacts(points, normals / np.maximum(length, _STEEP)[:, None], first, second)
    contacts = contacts.some(sound)
    nothing = np.empty((0, 3), dtype=np.int64)
    meshes = [
        (contacts.points[(contacts.first == n) | (contacts.second == n)], nothing)
        for n in range(len(curves))
    ]
    return meshes, contacts


def _crossed(labels: Ints) -> tuple[list[Feature], Ints]:
    """The lattice's edges between two labels, and these, the lower first."""
    keys: list[Feature] = []
    pairs = []
    for axis in range(3):
        after = np.roll(labels, -1, axis)
        crossed = labels != after
        if axis:  # only the angle closes on itself
            np.moveaxis(crossed, axis, 0)[-1] = False
        keys += [("edge", axis, i, j, k) for i, j, k in np.argwhere(crossed).tolist()]
        pairs.append(np.column_stack([labels[crossed], after[crossed]]))
    return keys, np.sort(np.concatenate(pairs), axis=1)
