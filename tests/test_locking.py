"""The checks of locking can fail, and say what moves."""

import pytest
from kits import kit

from scadgen.check.locking import (
    connectors_lock,
    only_the_peg_moves,
    prove,
    tightness,
    without_the_peg,
)
from scadgen.errors import GeometryError
from scadgen.joint.weave import Weave
from scadgen.kit.build import Request, build

#: Arms that hardly weave; and a joint in which no half starts to move without clearance.
LOOSE = Weave(1.54, 0.67, 0.23, 0.26, 0.81, name="loose")
STUCK = Weave(1.555, 0.817, 0.43, 0.691, 1.516, name="stuck")


@pytest.mark.parametrize("key", ["fixed", "loose"])
@pytest.mark.parametrize("frame", ["hexagonal", "square"])
def test_built_in_joints_lock_and_come_apart_without_the_peg(frame, key):
    made = kit(frame, key, bore=0.0, detail="draft")
    proved = prove(made)
    assert len(proved) == 6
    assert proved["in the joint only the peg moves"] == "the peg, along its axis"


def test_a_joint_that_hardly_weaves_is_not_locked():
    made = build(Request("square", detail="draft", weave=LOOSE))
    result = connectors_lock(made)
    assert not result.good
    assert "can move" in result.figure
    assert not all(found.good for found in only_the_peg_moves(made))
    assert tightness(made).figure.startswith("inf")
    with pytest.raises(GeometryError, match="whole connectors lock"):
        prove(made)


def test_a_joint_that_is_stuck_without_its_peg_is_refused():
    made = build(Request("hexagonal", detail="draft", weave=STUCK))
    assert connectors_lock(made).good
    first, *_ = without_the_peg(made)
    assert not first.good
    with pytest.raises(GeometryError, match="half A comes loose"):
        prove(made)


def test_tighter_weaves_have_less_play():
    play = [
        float(tightness(build(Request("hexagonal", detail="draft", weave=weave))).figure.split()[0])
        for weave in (STUCK, Weave(1.504, 0.848, 0.336, 0.604, 1.409))
    ]
    assert play[0] < play[1] < 40
