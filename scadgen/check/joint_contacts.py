"""The contacts of a joint from its construction, where no touching faces need be looked for.

A wall's triangle is a contact of its connector with the one whose curve is the next nearest
there; halves touch along their cut; a peg touches its socket with four sides, and its tube
stands on the halves' face.  Lengths are in sides, without clearance.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.joint.joint import Joint
from scadgen.joint.pieces import SPLIT
from scadgen.joint.surface import Surface
from scadgen.solid.affine import Floats, Ints

__all__ = ["joint_contacts", "whole_contacts"]

#: Contacts: points, normals, numbers of the parts that these go from and to.
_Found = tuple[Floats, Floats, Ints, Ints]


def whole_contacts(made: Joint) -> tuple[list[Mesh], Contacts]:
    """Contacts of a joint's whole connectors.

    Parameters
    ----------
    made
        The joint.

    Returns
    -------
    meshes
        Their walls where they stand, one an edge.
    contacts
        Between these.
    """
    count = len(made.edges)
    meshes = [_standing(made, edge, made.connectors[edge]) for edge in range(count)]
    found = [_at_walls(made, edge, meshes[edge], edge, np.arange(count)) for edge in range(count)]
    return meshes, _united(found)


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
