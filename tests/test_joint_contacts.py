"""Contacts from the construction say what contacts found between the meshes say."""

import math

import numpy as np
import pytest
from kits import joint, mesh

from scadgen.check.joint_contacts import whole_contacts
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.certificate import BALANCED, check_certificate
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.verdict import Certificate, verdict

FRAMES = ["hexagonal", "square"]


def standing(made, edge):
    """A whole connector at its edge."""
    points, triangles = mesh(made.connectors[edge])
    c, s = math.cos(angle := made.spokes.azimuths[edge]), math.sin(angle)
    return points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), triangles


@pytest.mark.parametrize("frame", FRAMES)
def test_whole_connectors_lock_on_their_exact_walls(frame):
    made = joint(frame)
    meshes, contacts = whole_contacts(made.lattice, made.curves)
    found = verdict(make_assembly(meshes, contacts, (0,)))
    assert isinstance(found, Certificate)
    assert check_certificate(contacts, (0,), len(meshes), found) < BALANCED


@pytest.mark.parametrize("frame", FRAMES)
def test_contacts_lie_half_way_between_two_curves_and_where_meshes_touch(frame):
    made = joint(frame)
    _, direct = whole_contacts(made.lattice, made.curves)
    away = np.stack([curve.distance(direct.points)[0] for curve in made.curves])
    row = np.arange(len(direct))
    assert away[direct.first, row] == pytest.approx(away[direct.second, row], abs=1e-7)
    assert np.linalg.norm(direct.normals, axis=1) == pytest.approx(1)
    step = 1e-5 * direct.normals
    there = np.stack([curve.distance(direct.points + step)[0] for curve in made.curves])
    assert (there[direct.second, row] < there[direct.first, row]).all()
    found = find_contacts([standing(made, n) for n in range(len(made.spokes))], 1e-5)
    pairs = {*zip(found.first.tolist(), found.second.tolist(), strict=True)}
    assert {*zip(direct.first.tolist(), direct.second.tolist(), strict=True)} == pairs
