"""The contacts of a joint from its construction, where no touching faces need be looked for.

Whole connectors touch on the exact walls, where two curves are nearest and equally far: there
are no facets that could lock by themselves.  In a split joint a wall's triangle is a contact of
its connector with the one whose curve is the next nearest there; halves touch along their cut; a
peg touches its socket with four sides, and its tube stands on the halves' face.  Lengths are in
sides, without clearance.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.joint.joint import Joint
from scadgen.joint.lattice import Lattice
from scadgen.joint.pieces import SPLIT
from scadgen.joint.place import distances, place
from scadgen.joint.surface import Surface
from scadgen.joint.walls import Key
from scadgen.joint.weave import SiteCurve
from scadgen.solid.affine import Floats, Ints

__all__ = ["joint_contacts", "whole_contacts"]

#: How much farther than the nearest curve one may be at a wall, in sides: Newton's steps end
#: nearer than that, and where a third curve is nearer there is no wall.
_ON_WALL = 1e-7

#: Difference of two distances' slopes below which a wall's normal is unknown.
_STEEP = 1e-6

#: Contacts: points, normals, numbers of the parts that these go from and to.
_Found = tuple[Floats, Floats, Ints, Ints]


def whole_contacts(lattice: Lattice, curves: Sequence[SiteCurve]) -> tuple[list[Mesh], Contacts]:
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
    far = distances(curves, lattice.nodes)
    keys, pairs = _crossed(far.argmin(axis=0))
    points = place(lattice, curves, far, keys)
    found = [curve.distance(points) for curve in curves]
    away, slope = np.stack([d for d, _ in found]), np.stack([g for _, g in found])
    row, (first, second) = np.arange(len(points)), pairs.T
    normals = slope[first, row] - slope[second, row]
    length = np.linalg.norm(normals, axis=1)
    farther = np.maximum(away[first, row], away[second, row])
    sound = np.flatnonzero((farther < away.min(axis=0) + _ON_WALL) & (length > _STEEP))
    contacts = Contacts(points, normals / np.maximum(length, _STEEP)[:, None], first, second)
    contacts = contacts.some(sound)
    nothing = np.empty((0, 3), dtype=np.int64)
    meshes = [
        (contacts.points[(contacts.first == n) | (contacts.second == n)], nothing)
        for n in range(len(curves))
    ]
    return meshes, contacts


def _crossed(labels: Ints) -> tuple[list[Key], Ints]:
    """The lattice's edges between two labels, and these, the lower first."""
    keys: list[Key] = []
    pairs = []
    for axis in range(3):
        after = np.roll(labels, -1, axis)
        crossed = labels != after
        if axis:  # only the angle closes on itself
            np.moveaxis(crossed, axis, 0)[-1] = False
        keys += [("edge", axis, i, j, k) for i, j, k in np.argwhere(crossed).tolist()]
        pairs.append(np.column_stack([labels[crossed], after[crossed]]))
    return keys, np.sort(np.concatenate(pairs), axis=1)


def joint_contacts(made: Joint, width: float, length: float) -> tuple[list[Mesh], Contacts]:
    """Contacts of a joint whose first connector is split, with a fixed peg in it.

    Parameters
    ----------
    made
        The joint.
    width, length
        The peg's, in sides.

    Returns
    -------
    meshes
        Half A, half B, the other connectors counter-clockwise, the peg: their walls and, for
        the peg, its corners where they stand.
    contacts
        Between these.
    """
    count = len(made.edges)
    halves = [_standing(made, 0, half) for half in made.halves[0]]
    others = [_standing(made, edge, made.connectors[edge]) for edge in range(1, count)]
    meshes = [*halves, *others]
    number = np.arange(1, count + 1)
    found = [_at_walls(made, 0, half, n, number) for n, half in enumerate(halves)]
    found += [_at_walls(made, n, meshes[n + 1], n + 1, number) for n in range(1, count)]
    start = made.lattice.tube_start
    found += [_at_peg(start, width, length, half, count + 1) for half in (0, 1)]
    corners = list(itertools.product((start - length, start), *[(-width / 2, width / 2)] * 2))
    peg = np.array(corners), np.empty((0, 3), dtype=np.int64)
    return [*meshes, peg], _united([*found, _at_cut(made.halves[0][0])])


def _standing(made: Joint, edge: int, surface: Surface) -> Mesh:
    """A surface's walls at its edge."""
    c, s = math.cos(made.edges[edge]), math.sin(made.edges[edge])
    return surface.points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), surface.walls


def _at_walls(made: Joint, edge: int, mesh: Mesh, part: int, parts: Ints) -> _Found:
    """Contacts of a part with those after it: at the walls that face a later connector.

    Parameters
    ----------
    edge
        The part's edge.
    mesh
        Its walls, where they stand.
    part
        Its number.
    parts
        The number of each edge's connector.
    """
    corners = mesh[0][mesh[1]]
    middles = corners.mean(axis=1)
    far = np.stack([curve.distance(middles)[0] for curve in made.curves])
    far[edge] = np.inf
    other = far.argmin(axis=0)
    later = other > edge
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[later]
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    second = np.repeat(parts[other[later]], 3)
    points = corners[later].reshape(-1, 3)
    return points, np.repeat(normals, 3, axis=0), np.full(len(points), part), second


def _at_cut(half: Surface) -> _Found:
    """Contacts of half A with half B, all along the outline of the cut."""
    points = half.points[np.unique(half.outlines[SPLIT])]
    normals = np.tile([0.0, -1.0, 0.0], (len(points), 1))
    return points, normals, np.zeros(len(points), np.int64), np.ones(len(points), np.int64)


def _at_peg(start: float, width: float, length: float, half: int, peg: int) -> _Found:
    """Contacts of a half with the peg and its tube: the faces' corners on its side of y = 0."""
    side = (1, -1)[half]
    x, w = (start - length, start), width / 2
    faces = (
        ((x, (side * w,), (-w, w)), (0, -side, 0)),
        ((x, (0, side * w), (w,)), (0, 0, -1)),
        ((x, (0, side * w), (-w,)), (0, 0, 1)),
        ((x[:1], (0, side * w), (-w, w)), (1, 0, 0)),
        ((x[1:], (0, side / 2), (-0.5, 0.5)), (1, 0, 0)),
    )
    points = np.array([point for corners, _ in faces for point in itertools.product(*corners)])
    normals = np.repeat(np.array([normal for _, normal in faces], dtype=np.float64), 4, axis=0)
    return points, normals, np.full(len(points), half), np.full(len(points), peg)


def _united(found: Sequence[_Found]) -> Contacts:
    return Contacts(*(np.concatenate(column) for column in zip(*found, strict=True)))
