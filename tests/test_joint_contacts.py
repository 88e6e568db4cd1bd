"""Contacts from the construction say what contacts found between the meshes say."""

import numpy as np
import pytest
from kits import joint

from scadgen.check.joint_contacts import joint_contacts, whole_contacts
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.certificate import check_certificate
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.verdict import Certificate, Motion, verdict

FRAMES = ["hexagonal", "square"]


@pytest.mark.parametrize("frame", FRAMES)
def test_whole_connectors_lock_on_their_exact_walls(frame):
    made = joint(frame)
    meshes, contacts = whole_contacts(made.lattice, made.curves)
    found = verdict(make_assembly(meshes, contacts, (0,)))
    assert isinstance(found, Certificate)
    assert check_certificate(contacts, (0,), len(meshes), found) < 1e-8


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
    meshes, _ = joint_contacts(made, 0.4, 0.6)
    found = find_contacts(meshes[:-1], 1e-5)
    # In the split joint both halves come first.
    pairs = {
        (max(a - 1, 0), b - 1) for a, b in zip(found.first, found.second, strict=True) if b > 1
    }
    assert {*zip(direct.first.tolist(), direct.second.tolist(), strict=True)} == pairs


@pytest.mark.parametrize("frame", FRAMES)
def test_in_the_split_joint_only_the_peg_moves(frame):
    meshes, contacts = joint_contacts(joint(frame), 0.4, 0.6)
    peg = len(meshes) - 1
    found = verdict(make_assembly(meshes, contacts, (2,)))
    assert isinstance(found, Motion)
    assert found.parts == (peg,)
    assert found.translations == pytest.approx(np.array([[1, 0, 0]]), abs=1e-9)
    assert found.rotations == pytest.approx(0, abs=1e-9)
    assert isinstance(verdict(make_assembly(meshes, contacts, (2, peg))), Certificate)


def test_without_the_peg_half_a_starts_to_move():
    meshes, contacts = joint_contacts(joint("hexagonal"), 0.4, 0.6)
    peg = len(meshes) - 1
    gone = np.flatnonzero((contacts.first != peg) & (contacts.second != peg))
    found = verdict(make_assembly(meshes[:peg], contacts.some(gone), range(1, peg)))
    assert isinstance(found, Motion)
