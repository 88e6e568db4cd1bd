"""Kits whose joints are all proved: keys go where joints lock and the frame holds."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from kits import drawn

from scadgen.check.geometry import same
from scadgen.check.proof import proved
from scadgen.cli.main import main
from scadgen.errors import GeometryError, JointError
from scadgen.kit.build import build
from scadgen.kit.store import dumps, loads
from scadgen.plan.keyed import proved_kit
from scadgen.plan.standing import stand
from scadgen.plan.whole import parting_joints, whole_frame
from scadgen.plane.drawn import make_frame


def request(name, points, edges):
    frame = make_frame(name, points, edges)
    return drawn(name, frame, resizable=True)


def towards(*degrees):
    turn = np.radians(degrees)
    return (200 * np.column_stack([np.cos(turn), np.sin(turn)])).tolist()


DRAFT = ("--detail", "draft", "--no-cache")

#: A triangle with two tails.
TAILS = (
    [[141, 26], [78, 54], [200, 99], [17, 107], [138, 119]],
    [[0, 2], [0, 4], [1, 3], [1, 4], [3, 4]],
)


def gaps_from_key(kit):
    """The gaps of each joint, from its key on, in whole degrees."""
    return {tuple(np.diff([*joint.turns, 360]).round().tolist()) for joint in kit.joints}


def test_a_joint_that_does_not_lock_gets_another_key():
    # The key that closes the triangle's loop is beside a narrow gap, and beyond that is a wide one.
    wish = request("tails", *TAILS)
    with pytest.raises(JointError, match="with the peg held the joint locks") as found:
        proved(build(wish))
    said = []
    kit = proved_kit(wish, say=said.append)
    assert any(found.value.fault in line and "another key" in line for line in said)
    assert all(joint.verdicts and joint.ways for joint in kit.joints)
    assert gaps_from_key(kit) != gaps_from_key(build(wish))
    # What was refused is kept with the kit, which is made again from it.
    assert kit.refused
    assert loads(dumps(kit)).refused == kit.refused
    assert same(kit).good
    assert not same(replace(kit, refused=())).good


def test_that_keys_were_chosen_anew_is_told(tmp_path, capsys):
    file = tmp_path / "tails.json"
    file.write_text(json.dumps(dict(zip(("vertices", "edges"), TAILS, strict=True))))
    with pytest.raises(SystemExit) as ended:
        main(["kit", str(file), "--scale", "2", *DRAFT, "-o", str(tmp_path / "kit")])
    assert ended.value.code in (0, None)
    assert re.search(r"note: \d+ choices? of a key not proved", capsys.readouterr().out)


def test_keys_go_where_a_frame_holds_that_else_parts_at_a_lone_edge():
    # A triangle with a tail: a key on the tail would hold on to nothing but its own halves.
    wish = request("kite", [[0, 0], *towards(131.2, 224.2, 90.0)], [[0, 1], [0, 2], [1, 2], [0, 3]])
    (site,) = parting_joints(stand(proved(build(wish))))
    assert site.pose.at == (0.0, 0.0, 0.0)
    kit = proved_kit(wish)
    assert not parting_joints(stand(kit))
    assert whole_frame(stand(kit)).held


def test_a_frame_that_may_come_apart_is_made_where_other_keys_make_none(monkeypatch):
    wish = request("kite", [[0, 0], *towards(131.2, 224.2, 90.0)], [[0, 1], [0, 2], [1, 2], [0, 3]])
    calls = []

    def once(*words):
        calls.append(words)
        if len(calls) > 1:
            message = "edge 0: too short"
            raise GeometryError(message)
        return build(*words)

    monkeypatch.setattr("scadgen.plan.keyed.build", once)
    kit = proved_kit(wish)
    assert len(calls) == 2
    assert all(joint.verdicts for joint in kit.joints)


def test_of_components_each_is_held_by_itself():
    corners = [[0, 0], [150, 0], [75, 130]]
    points = [*corners, *([x + 400, y] for x, y in corners)]
    kit = proved_kit(request("two", points, [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3]]))
    standing = stand(kit)
    whole = whole_frame(standing)
    assert whole.held
    assert len(standing.anchors) == 2
    # Nothing is said to move that is a component by itself, and touches nothing else.
    assert all(set(one.parts) < set(range(len(kit.placements))) for one in whole.loose)
    assert max(len(one.parts) for one in whole.loose) < len(kit.placements) / 2


def test_a_joint_that_no_key_makes_lock_is_refused_with_its_vertex(monkeypatch):
    wish = request("kite", [[0, 0], *towards(0.0, 100.0, 200.0)], [[0, 1], [0, 2], [0, 3]])

    def never(kit, *_):
        message = "joint A: it locks: no"
        raise JointError(message, kit.joints[-1].name, "it locks: no")

    monkeypatch.setattr("scadgen.plan.keyed.proved", never)
    where = r"vertex \d at \(-?\d.*\), angles \d.*"
    message = f"{where}: it locks: no; with other keys it is refused as well"
    with pytest.raises(JointError, match=message):
        proved_kit(wish)


def test_the_vertex_of_a_refused_joint_is_one_of_its_own(monkeypatch):
    # Three joints with different angles that have the same halves: these do not tell which it is.
    middles = np.array([[0.0, 0.0], [200.0, -90.0], [390.0, -30.0]])
    points, edges = middles.tolist(), [[0, 1], [1, 2]]
    for start, turns in ((0, (115, 225)), (1, (270,)), (2, (75, 315))):
        for arm in towards(*turns):
            edges.append([start, len(points)])
            points.append((middles[start] + arm).tolist())
    wish = request("spiders", points, edges)
    kit = build(wish)
    assert len({p.part for one in kit.joints for p in one.pieces if p.role == "half_a"}) == 1

    made = []

    def never(kit, *_):
        made.append(kit)
        message = "it locks: no"
        raise JointError(message, kit.joints[-1].name, "it locks: no")

    monkeypatch.setattr("scadgen.plan.keyed.proved", never)
    with pytest.raises(JointError) as caught:
        proved_kit(wish)
    found = re.search(r"vertex (\d) at .*, angles ([\d., ]+):", str(caught.value))
    kit = made[-1]
    assert kit.vertices[int(found[1])].joint == kit.joints[-1].name
    gaps = np.diff([*kit.joints[-1].turns, 360.0])
    assert [float(n) for n in found[2].split(",")] == pytest.approx(gaps, abs=0.1)
