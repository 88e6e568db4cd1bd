"""Verdicts on puzzles whose answer a person can reason out, placed anyhow."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import puzzles
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kits import VALENCE, WEAVES, grid, kit, mesh, regular

from scadgen.check.geometry import placed
from scadgen.errors import InputError, ToolError
from scadgen.interlock.assembly import largest_part, make_assembly
from scadgen.interlock.certificate import BALANCED, check_certificate
from scadgen.interlock.contacts import Contacts, default_tolerance, find_contacts
from scadgen.interlock.follow import moved
from scadgen.interlock.keys import alone
from scadgen.interlock.program import farthest
from scadgen.interlock.verdict import Certificate, Motion, verdict
from scadgen.joint.joint import DETAILS, make_joint
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import Weave
from scadgen.kit.build import build
from scadgen.solid.gap import overlap_volume

#: Puzzle, held parts, and what moves: nothing, or parts and the directions (rows) in whose
#: cone they go.
CASES = {
    "corner": (puzzles.corner, (0,), (1,), np.eye(3)),
    "peg in tube": (puzzles.peg_in_tube, (0,), (1,), [[0, 0, 1], [0, 0, -1]]),
    "tube on peg": (puzzles.peg_in_tube, (1,), (0,), [[0, 0, 1], [0, 0, -1]]),
    "two hooks": (puzzles.two_hooks, (0,), (1,), [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1]]),
    "dovetail": (lambda: puzzles.dovetail(stopped=False), (0,), (1,), [[1, 0, 0], [-1, 0, 0]]),
    "stopped dovetail": (lambda: puzzles.dovetail(stopped=True), (0,), (1,), [[1, 0, 0]]),
    "ball": (lambda: puzzles.ball_in_socket(0.5), (0,), (), []),
    "three pieces": (puzzles.three_piece_burr, (0,), (2,), [[0, 0, 1], [0, 0, -1]]),
    "three pieces, key held": (puzzles.three_piece_burr, (0, 2), (), []),
    "six pieces": (puzzles.six_piece_burr, (1,), (0,), [[1, 0, 0], [-1, 0, 0]]),
    "six pieces, key held": (puzzles.six_piece_burr, (0, 1), (), []),
    "three rods": (puzzles.three_rods, (0,), (), []),
    "box": (lambda: puzzles.cube_in_box(1e-4), (0,), (), []),
}


def judged(meshes, held, tolerance=None):
    contacts = find_contacts(meshes, tolerance or default_tolerance(meshes))
    assembly = make_assembly(meshes, contacts, held)
    found = verdict(assembly)
    if isinstance(found, Certificate):
        assert check_certificate(contacts, held, len(meshes), found) < BALANCED
    else:
        assert not set(found.parts) & set(held)
    return contacts, found


def entered(meshes, motion, share):
    """Volume that parts enter each other by a little along a motion, less what they do before."""
    step = share * puzzles.diagonal(meshes)
    after = list(meshes)
    for n, part in enumerate(motion.parts):
        way = motion.translations[n], motion.rotations[n]
        after[part] = moved(meshes[part][0], *way, step), meshes[part][1]
    pairs = [(a, b) for a in motion.parts for b in range(len(meshes)) if a != b]
    return sum(
        overlap_volume(*after[a], *after[b]) - overlap_volume(*meshes[a], *meshes[b])
        for a, b in pairs
    )


@pytest.mark.parametrize("name", CASES)
@given(seed=st.integers(0, 2**32 - 1), rounded=st.booleans())
@settings(max_examples=8)
def test_puzzles_have_the_verdict_that_reason_gives(name, seed, rounded):
    make, held, moving, cone = CASES[name]
    meshes, turn = puzzles.placed(make(), np.random.default_rng(seed))
    if rounded:
        meshes = [(points.astype(np.float32).astype(float), t) for points, t in meshes]
    _, found = judged(meshes, held)
    if not moving:
        assert isinstance(found, Certificate)
        assert found.rank == 6 * (len(meshes) - len(held))
        return
    assert isinstance(found, Motion)
    assert found.parts == moving
    assert found.rotations == pytest.approx(0, abs=1e-4 / puzzles.diagonal(meshes))
    way = found.translations[0] @ turn
    # In the cone: a sum of its directions, none of them backwards.
    inside = np.clip(np.asarray(cone) @ way, 0, None) @ np.asarray(cone, dtype=float)
    assert inside == pytest.approx(way, abs=1e-4)
    if not rounded:
        # To first order nothing is entered; an entering contact would take 1e-4 of the size.
        size = puzzles.diagonal(meshes)
        assert entered(meshes, found, 1e-4) < 1e-3 * 1e-4 * size**3


def test_a_ball_in_less_than_half_a_socket_lifts_out():
    meshes = puzzles.ball_in_socket(-0.2)
    _, found = judged(meshes, (0,))
    assert isinstance(found, Motion)
    assert found.translations[0] == pytest.approx([0, 0, 1], abs=1e-6)
    assert not found.slides
    assert entered(meshes, found, 1e-4) < 1e-6


def test_a_part_that_turns_is_seen_to_turn():
    # A round plug of 64 sides, drawn smaller than its hole's facets would allow to lock.
    angle = 2 * np.pi * np.arange(64) / 64
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    plug = puzzles.hull([(x, y, z) for z in (0.0, 1.0) for x, y in ring])
    shelf = puzzles.voxels(puzzles.cells((-2, 2), (-2, 2), (-1, 0)))
    lid = puzzles.voxels(puzzles.cells((-2, 2), (-2, 2), (1, 2)))
    _, found = judged([shelf, plug, lid], (0, 2))
    assert isinstance(found, Motion)
    assert found.parts == (1,)
    assert found.slides


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=40)
def test_no_shift_that_cells_allow_is_missed(seed):
    """Whatever set of parts one can shift along an axis without hitting a cell can move."""
    parts = puzzles.grown(3, 4, seed)
    owner = {cell: n for n, part in enumerate(parts) for cell in part}
    meshes = [puzzles.voxels(part) for part in parts]
    held = largest_part(meshes)
    free = [n for n in range(len(parts)) if n != held]
    shifts = False
    for axis, way in product(range(3), (1, -1)):
        pushes = set()
        for cell, n in owner.items():
            beside = tuple(np.add(cell, way * np.eye(3, dtype=int)[axis]).tolist())
            pushes.add((n, owner.get(beside, n)))
        for chosen in product((False, True), repeat=len(free)):
            moving = {n for n, c in zip(free, chosen, strict=True) if c}
            shifts |= bool(moving) and all(b in moving for a, b in pushes if a in moving)
    _, found = judged(meshes, (held,))
    if shifts:
        assert isinstance(found, Motion)


def test_tampered_certificates_are_refused():
    meshes = puzzles.three_piece_burr()
    held = (0, 2)
    contacts, found = judged(meshes, held)
    rows, forces = found.rows, found.forces

    def residual(**changes):
        return check_certificate(contacts, held, 3, replace(found, **changes))

    assert residual() < BALANCED
    tampered = {
        "one force changed by a hundredth": {"forces": forces * (1 + 0.01 * (rows == rows[0]))},
        "all forces halved": {"forces": forces / 2},
        "a force that pulls": {"forces": np.where(rows == rows[0], -forces, forces)},
        "a force that is no number": {"forces": np.where(rows == rows[0], np.nan, forces)},
        "a contact left out": {"rows": rows[1:], "forces": forces[1:]},
        "a contact twice": {"rows": np.append(rows, rows), "forces": np.append(forces, forces)},
        "forces of other contacts": {"forces": np.roll(forces, 1)},
        "a contact that is not there": {"rows": rows + len(contacts)},
        "a lower rank": {"rank": found.rank - 1},
        "nothing": {"rows": rows[:0], "forces": forces[:0]},
    }
    for what, changes in tampered.items():
        assert residual(**changes) > BALANCED, what
    # The key let go: its forces balance, but it slides.
    assert check_certificate(contacts, (0,), 3, replace(found, rank=12)) > BALANCED


def test_a_balanced_certificate_without_the_rank_is_refused():
    meshes = puzzles.peg_in_tube()
    contacts = find_contacts(meshes, 0.01)
    rows = np.arange(len(contacts))
    # The same push at all corners of all four walls balances, but the peg slides.
    claimed = Certificate(rows, np.ones(len(rows)), 6)
    corners = np.unique(np.column_stack([contacts.points, contacts.normals]).round(6), axis=0)
    first = [
        int(
            np.flatnonzero(
                (np.column_stack([contacts.points, contacts.normals]).round(6) == c).all(axis=1)
            )[0]
        )
        for c in corners
    ]
    claimed = replace(claimed, rows=np.array(first), forces=np.ones(len(first)))
    assert check_certificate(contacts, (0,), 2, claimed) == np.inf


@pytest.mark.parametrize("strong", [1.0, 1e3, 1e9])
def test_strong_forces_do_not_hide_what_they_leave_over(strong):
    """A cube in a box without a lid lifts out, however hard the walls push."""
    normals = np.repeat(np.concatenate([np.eye(3), -np.eye(3)]), 4, axis=0)
    corners = [c for n in normals[::4] for c in product((1, -1), repeat=3) if np.dot(n, c) < 0]
    none = np.zeros(24, dtype=int)
    contacts = Contacts(np.array(corners, dtype=float), normals, none, none + 1)
    forces = np.where(normals[:, 2] == 0, strong, 1.0)
    closed = Certificate(np.arange(24), forces, 6)
    assert check_certificate(contacts, (0,), 2, closed) < BALANCED
    without = np.flatnonzero(normals[:, 2] >= 0)
    opened = Certificate(without, forces[without], 6)
    assert check_certificate(contacts, (0,), 2, opened) > 1


def test_only_the_key_of_a_burr_can_move_alone():
    meshes = puzzles.six_piece_burr()
    contacts = find_contacts(meshes, 0.01)
    assert [isinstance(found, Motion) for found in alone(meshes, contacts)] == [True] + 5 * [False]


def test_parts_that_nothing_holds_drift_off():
    meshes = [*puzzles.three_rods(), puzzles.voxels([(9, 9, 9)])]
    _, found = judged(meshes, (0,))
    assert isinstance(found, Motion)
    assert found.parts == (3,)
    assert found.slides


def test_what_cannot_be_held_is_refused():
    meshes = puzzles.corner()
    contacts = find_contacts(meshes, 0.01)
    for held in ((), (0, 1), (2,), (-1,)):
        with pytest.raises(InputError, match="held"):
            make_assembly(meshes, contacts, held)


def test_a_solver_without_an_answer_is_an_error_and_no_verdict():
    meshes = puzzles.corner()
    rows = make_assembly(meshes, find_contacts(meshes, 0.01), (0,)).rows
    with pytest.raises(ToolError, match="status 2"):
        farthest(np.ones(6), rows, -1.0, 1e-9)
    with pytest.raises(ToolError, match="not finite"):
        farthest(np.ones(6), rows * np.nan, 0.0, 1.0)


@pytest.mark.parametrize("cut", ["whole", "halves"])
def test_many_parts_in_a_box(cut):
    """Parts that fill a closed box are locked; with the lid off, something lifts out."""
    parts = puzzles.grown(5, 25, 1)
    wall = puzzles.cells((-1, 6), (-1, 6), (-1, 6)) - puzzles.cells((0, 5), (0, 5), (0, 5))
    if cut == "halves":
        wall = {cell for cell in wall if cell[2] < 5}
    meshes = [*(puzzles.voxels(part) for part in parts), puzzles.voxels(wall)]
    _, found = judged(meshes, (len(parts),))
    assert isinstance(found, Certificate) == (cut == "whole")


# ------------------------------------------------------------------------------- kits


def joint_of(frame, **changes):
    made = build(grid(frame, **changes))
    values = {**made.values, "clearance": 0.0, "peg_clearance": 0.0}
    return [placed(made, p, values) for p in made.joints[0].pieces], [
        p.part for p in made.joints[0].pieces
    ]


def whole_connectors(weave, count, detail):
    made = make_joint(Spokes.flat(regular(count)), weave, detail)
    found = []
    for angle, surface in zip(made.spokes.azimuths, made.connectors, strict=True):
        points, triangles = mesh(surface)
        c, s = math.cos(angle), math.sin(angle)
        found.append((points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), triangles))
    return found


@pytest.mark.parametrize("frame", ["hexagonal", "square"])
def test_a_kits_joint_is_locked_but_for_the_peg(frame):
    meshes, names = joint_of(frame)
    peg = names.index("peg")
    _, found = judged(meshes, (names.index("connector"),), 0.01)
    assert isinstance(found, Motion)
    assert found.parts == (peg,)
    assert found.translations == pytest.approx(np.array([[1, 0, 0]]), abs=1e-6)
    assert found.rotations == pytest.approx(0, abs=1e-6)
    _, found = judged(meshes, (names.index("connector"), peg), 0.01)
    assert isinstance(found, Certificate)


def test_a_kits_joint_is_locked_with_its_clearance_too():
    made = kit("hexagonal")
    meshes = [placed(made, p, made.values) for p in made.joints[0].pieces]
    names = [p.part for p in made.joints[0].pieces]
    _, found = judged(meshes, (names.index("peg"), names.index("connector")))
    assert isinstance(found, Certificate)


@pytest.mark.parametrize("frame", ["hexagonal", "square"])
@pytest.mark.parametrize("times", [1, 2])
def test_whole_connectors_lock_and_still_do_at_twice_the_samples(frame, times):
    weave, draft = WEAVES[frame], DETAILS["draft"]
    detail = replace(draft, samples=times * draft.samples)
    _, found = judged(whole_connectors(weave, VALENCE[frame], detail), (0,), 1e-3)
    assert isinstance(found, Certificate)


def test_connectors_that_follow_the_ring_do_not_lock():
    weave = Weave(1.6, 0.6, 0.2, 1.0, 1.0)
    _, found = judged(whole_connectors(weave, 3, DETAILS["draft"]), (0,), 1e-3)
    assert isinstance(found, Motion)
