"""Joints whose edges slope: their pieces as solids, their tubes, and motions that open a half."""

import numpy as np
from kits import mesh
from scipy.optimize import linprog

from scadgen.check.joint_contacts import whole_contacts
from scadgen.errors import GeometryError, InvariantError
from scadgen.interlock.path import Path
from scadgen.joint.joint import DETAILS, FaceError, make_joint
from scadgen.joint.pieces import SPLIT, TUBE
from scadgen.joint.recede import recede
from scadgen.solid.mesh import solid_faults

__all__ = ["decomposed", "openings", "pieces", "standing", "touches", "tube"]

#: How far a piece goes before it only goes straight on, and in all, in sides.
ASIDE, FAR = 0.8, 8.0


def decomposed(spokes, weave, detail="draft", keys=(0,)):
    """The joint on the first lattice on which all its pieces are solids that may draw back."""
    error = None
    for extra in (0, 2, 4, 6, 8):
        try:
            made = make_joint(spokes, weave, DETAILS[detail], extra, keys)
            recede([(surface, (SPLIT,) * (SPLIT in surface.outlines)) for surface in _all(made)])
        except FaceError:
            raise
        except (GeometryError, InvariantError) as failed:
            error = failed
            continue
        faults = [solid_faults(10 * p, t) for p, t in map(mesh, _all(made))]
        if not any(faults):
            return made
        error = AssertionError(faults)
    raise error


def _all(made):
    return [*made.connectors, *(half for pair in made.halves for half in pair)]


def standing(made, edge, points):
    """Points of a connector, its edge at +x, where they are in the joint."""
    return points @ made.curves[edge].turn


def pieces(made, key, clearance):
    """Half A, half B and all other connectors where they stand, in sides."""
    surfaces = [(half, (SPLIT,)) for half in made.halves[key]]
    edges = [key, key, *(n for n in range(len(made.spokes)) if n != key)]
    surfaces += [(made.connectors[n], ()) for n in edges[2:]]
    found = []
    for edge, (surface, _), moved in zip(edges, surfaces, recede(surfaces), strict=True):
        points, triangles = mesh(surface)
        found.append((standing(made, edge, points + clearance / 2 * moved), triangles))
    return found


def tube(made, edge, clearance, length=1.5):
    """A piece of an edge's tube, the clearance away from its face."""
    face = made.lattice.domain.tube_face(edge)
    corners = np.array(
        [(x, y, z) for x in (clearance, length) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
    )
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return face.apply(corners), np.array(triangles)


def touches(made, key, which, *, twin):
    """Where a half touches its neighbour, its tube and its twin: points, and how it leaves them.

    Those at the neighbour are on the exact walls.
    """
    spokes, half = made.spokes, made.halves[key][which]
    _, contacts = whole_contacts(made.lattice, made.curves)
    azimuth = np.arctan2(contacts.points[:, 1], contacts.points[:, 0]) % (2 * np.pi)
    gap = (np.searchsorted(spokes.azimuths, azimuth, side="right") - 1) % len(spokes)
    mine = (gap == (key - which) % len(spokes)) & (
        (contacts.first == key) | (contacts.second == key)
    )
    sign = np.where(contacts.first == key, -1.0, 1.0)[mine, None]
    found = [(contacts.points[mine], sign * contacts.normals[mine])]
    face, side = made.lattice.domain.tube_face(key), 1 - 2 * which
    for facet, leaving in ((TUBE, -face.axes[0]), (SPLIT, side * face.axes[1])):
        if facet == TUBE or twin:
            points = half.points[np.unique(half.outlines[facet])]
            found.append((standing(made, key, points), np.tile(leaving, (len(points), 1))))
    return tuple(np.concatenate(each) for each in zip(*found, strict=True))


def openings(points, leaving, up):
    """Ways that take a body up or down from all that it touches, by linear programmes.

    How fast the slowest contact opens, and the way, if any.
    """
    middle = points.mean(axis=0)
    rows = np.hstack([leaving, np.cross(points - middle, leaving)])
    bounds = [(-1, 1)] * 2 + [(up, up)] + [(-1, 1)] * 3 + [(None, 1)]
    found = linprog(
        [0] * 6 + [-1],
        A_ub=np.column_stack([-rows, np.ones(len(rows))]),
        b_ub=np.zeros(len(rows)),
        bounds=bounds,
    )
    if found.x is None or found.x[6] <= 1e-6:
        return
    for share in (0.5, 0.9, 0.2, 0.05):
        twist = _least(rows, bounds, share * found.x[6])
        gone = np.concatenate([np.linspace(0, 1.6, 9), [FAR]])[:, None]
        steps = np.minimum(gone, ASIDE) * twist
        steps[:, 2:3] = gone * up
        yield float(found.x[6]), Path.through(steps, middle)


def _least(rows, bounds, opening):
    """The least motion that opens all contacts so fast."""
    size = np.eye(6)
    found = linprog(
        [0] * 6 + [1] * 6,
        A_ub=np.block([[-rows, 0 * rows], [size, -size], [-size, -size]]),
        b_ub=np.concatenate([np.full(len(rows), -opening), np.zeros(12)]),
        bounds=[*bounds[:6], *[(0, None)] * 6],
    )
    return found.x[:6]
