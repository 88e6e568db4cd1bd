"""The checks of locking can fail, and say what moves."""

import pytest
from kits import kit

from scadgen.check.locking import connectors_lock, joint_locks, largest_play, only_the_peg_moves
from scadgen.check.proof import proved
from scadgen.errors import GeometryError
from scadgen.joint.weave import Weave
from scadgen.kit.build import Request, build, build_joint

#: Arms that hardly weave.
LOOSE = Weave(1.54, 0.67, 0.23, 0.26, 0.81, name="loose")


@pytest.mark.parametrize("key", ["fixed", "loose"])
@pytest.mark.parametrize("frame", ["hexagonal", "square"])
def test_built_in_joints_lock_but_for_the_peg(frame, key):
    results = {r.check: r for r in joint_locks(kit(frame, key, bore=0.0, detail="draft"))}
    assert all(result.good for result in results.values())
    assert results["in the joint only the peg moves"].figure == "the peg, along its axis"
    assert len(results) == 7


def test_a_joint_that_hardly_weaves_is_not_locked():
    made = build(Request("square", detail="draft", weave=LOOSE))
    result = connectors_lock(made)
    assert not result.good
    assert "can move" in result.figure
    assert not all(found.good for found in only_the_peg_moves(made))
    assert largest_play(made) == float("inf")
    with pytest.raises(GeometryError, match="whole connectors lock: 3 parts can move"):
        proved(made)


def test_tighter_weaves_have_less_play():
    tight, loose = (
        largest_play(build_joint(3, Weave(*shape), "fixed", "draft"))
        for shape in ((1.555, 0.817, 0.43, 0.691, 1.516), (1.504, 0.848, 0.336, 0.604, 1.409))
    )
    assert tight < loose < 40


def test_play_is_what_pieces_really_have():
    *_, result = joint_locks(kit("hexagonal", detail="standard"))
    assert result.check == "play measured on the pieces"
    assert result.good
    assert "1.00 of it at 0.02 mm" in result.figure
