"""Contacts from the construction say what contacts found between the meshes say."""

import numpy as np
import pytest
from kits import joint, kit

from scadgen.check.joint_contacts import joint_contacts, whole_contacts
from scadgen.check.locking import TIP, finer_joint_locks, largest_play
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.certificate import check_certificate
from scadgen.interlock.contacts import find_contacts
from scadgen.interlock.play import play
from scadgen.interlock.verdict import Certificate, Motion, verdict

FRAMES = ["hexagonal", "square"]


@pytest.mark.parametrize("frame", FRAMES)
def test_whole_connectors_lock_with_the_same_play(frame):
    meshes, contacts = whole_contacts(joint(frame))
    found = verdict(make_assembly(meshes, contacts, (0,)))
    assert isinstance(found, Certificate)
    assert check_certificate(contacts, (0,), len(meshes), found) < 1e-8
    assembly = make_assembly(meshes, contacts, (0,))
    worst = 0.0
    for number, angle in enumerate(joint(frame).edges[1:], start=1):
        tip = TIP * np.array([np.cos(angle), np.sin(angle), 0])
        worst = max(worst, play(assembly, number, tip).max())
    assert worst == pytest.approx(largest_play(kit(frame)), rel=1e-5)


@pytest.mark.parametrize("frame", FRAMES)
def test_contacts_at_walls_lie_where_meshes_touch(frame):
    meshes, direct = whole_contacts(joint(frame))
    found = find_contacts(meshes, 1e-5)
    assert {*zip(direct.first.tolist(), direct.second.tolist(), strict=True)} == {
        *zip(found.first.tolist(), found.second.tolist(), strict=True)
    }
    for contacts in (direct, found):
        assert np.linalg.norm(contacts.normals, axis=1) == pytest.approx(1)
    both = np.concatenate([direct.points, found.points])
    low, high = both.min(axis=0), both.max(axis=0)
    assert direct.points.min(axis=0) == pytest.approx(low, abs=1e-5)
    assert direct.points.max(axis=0) == pytest.approx(high, abs=1e-5)


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


def test_the_verdict_holds_at_twice_the_samples():
    locked, same = finer_joint_locks(kit("hexagonal", detail="standard"))
    assert locked.good
    assert same.good
