"""Edge elements: volumes that a person can work out, symmetry, flat facets."""

import numpy as np
import pytest
from kits import KINDS, kit, named, random_inside

from scadgen.element.ends import CAP
from scadgen.kit.solids import REGULAR
from scadgen.solid.mesh import genus, normals, volume

kinds = pytest.mark.parametrize("kind", KINDS, ids=named)


def volumes(made, values):
    return {name: volume(s.points(values), s.triangles) for name, s in made.parts.items()}


def frustum(height, wide):
    """Lead-in of a peg: its width shrinks by its height on all sides."""
    narrow = wide - 2 * height
    return height / 3 * (wide**2 + wide * narrow + narrow**2)


@kinds
def test_a_kit_has_every_part_and_each_is_one_piece(kind):
    made = kit(*kind)
    assert list(made.parts) == [*REGULAR, "connector", "half", "peg", "tube"]
    bored = kind[2] > 0
    for name in ("basic", "one_sided", "two_sided", "tube", "peg", "connector"):
        assert genus(made.parts[name].triangles) == (1 if bored else 0), name
    assert genus(made.parts["half"].triangles) == 0


@kinds
def test_volumes_by_hand(kind):
    made = kit(*kind)
    for seed in range(3):
        v = random_inside(made, seed)
        found = volumes(made, v)
        side, gap, play = v["side"], v["clearance"], v["peg_clearance"]
        start = made.joints[0].key.tube_start * side
        pad = made.joints[0].key.pad * side
        bore = v.get("bore", 0.0) ** 2
        peg, length, tip = (
            v["peg_width"],
            v["peg_length"],
            frustum(v["peg_chamfer"], v["peg_width"]),
        )
        square, socket = side**2, (peg + 2 * play) ** 2
        if made.key == "fixed":
            # A peg stands on its tube, which starts a clearance beyond the connector.
            stub = peg**2 * (length + gap - v["peg_chamfer"]) + tip - bore * (length + gap)
            loose_peg = stub + (square - bore) * CAP * side
        else:
            deep = pad + length + play - start - gap
            stub = (bore - socket) * deep
            loose_peg = peg**2 * (length - 2 * v["peg_chamfer"]) + 2 * tip - bore * length
        tube = (square - bore) * (v["edge_length"] - 2 * start - 2 * gap)
        beside = (square - bore) * gap
        expected = {
            "tube": tube,
            "two_sided": tube + 2 * stub,
            "one_sided": found["connector"] + beside + tube + stub,
            "basic": 2 * (found["connector"] + beside) + tube,
            "peg": loose_peg,
        }
        for name, content in expected.items():
            assert found[name] == pytest.approx(content, rel=1e-7), name


@kinds
def test_two_halves_and_their_socket_are_a_connector_at_no_clearance(kind):
    made = kit(*kind)
    v = {**random_inside(made, 5), "clearance": 0.0, "peg_clearance": 0.0}
    found = volumes(made, v)
    through = (made.joints[0].key.tube_start - made.joints[0].key.pad) * v["side"]
    deep = v["peg_length"] if made.key == "fixed" else through
    bore = v.get("bore", 0.0) ** 2
    whole = found["connector"] + bore * through
    holes = v["peg_width"] ** 2 * deep + bore * (through - deep)
    assert 2 * found["half"] + holes == pytest.approx(whole, rel=1e-7)


@kinds
def test_elements_look_the_same_from_both_ends(kind):
    made = kit(*kind)
    v = random_inside(made, 6)
    for name in ("basic", "two_sided", "tube"):
        points = made.parts[name].points(v)
        turned = [v["edge_length"], 0, 0] + points * [-1, -1, 1]
        order = np.lexsort(points.round(5).T), np.lexsort(turned.round(5).T)
        assert np.allclose(points[order[0]], turned[order[1]], atol=1e-6)


@kinds
def test_parts_lie_level_and_within_the_tubes_height(kind):
    made = kit(*kind)
    v = random_inside(made, 7)
    for name, solid in made.parts.items():
        points = solid.points(v)
        assert np.abs(points[:, 2]).max() < v["side"] / 2 + 1e-6
        if name != "peg":
            assert np.abs(points[:, 2]).max() == pytest.approx(v["side"] / 2, abs=1e-6)


@kinds
def test_facets_stay_flat_whatever_the_settings(kind):
    made = kit(*kind)
    for seed in range(3):
        v = random_inside(made, seed)
        for solid in made.parts.values():
            points, corners = solid.points(v), solid.triangles
            normal = normals(points, corners)
            _, first, which = np.unique(solid.facets, return_index=True, return_inverse=True)
            model = first[which]
            offset = points[corners] - points[corners[model, 0]][:, None]
            off = np.abs(np.einsum("tkx,tx->tk", offset, normal[model]))
            assert off.max() < 1e-6 * v["side"]
            assert np.einsum("tx,tx->t", normal, normal[model]).min() > 1 - 1e-6


@kinds
def test_every_parameter_that_a_kit_has_moves_some_part(kind):
    made = kit(*kind)
    used = {name for solid in made.parts.values() for name in solid.coefficients}
    assert used == set(made.values)
