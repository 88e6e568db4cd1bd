"""Whatever is asked for gives a sound kit or one clear refusal."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from kits import grid, kit

from scadgen.errors import InvariantError, ScadgenError
from scadgen.joint.weave import Weave
from scadgen.kit.build import build
from scadgen.kit.live import PARAMETERS
from scadgen.kit.ranges import check_values
from scadgen.kit.store import dumps, loads
from scadgen.solid.mesh import solid_faults

#: Weaves around those that work, and anything else: `Weave` refuses what is out of its limits.
near = st.tuples(
    st.floats(1.2, 2.6),
    st.floats(0.4, 0.9),
    st.floats(0.05, 0.5),
    st.floats(0.2, 0.8),
    st.floats(0.7, 1.7),
)
anywhere = st.tuples(
    st.floats(0, 9), st.floats(0, 2), st.floats(-0.1, 1.2), st.floats(-0.1, 2), st.floats(0, 5)
)
lengths = st.dictionaries(
    st.sampled_from(PARAMETERS),
    st.one_of(st.floats(0, 60), st.floats(), st.sampled_from([0.0, 1e-12, 1e12])),
    max_size=3,
)


def assert_sound(made):
    """Every part is a solid, at the kit's values and with each read back."""
    check_values(made.ranges, made.values)
    read = loads(dumps(made))
    for name, solid in made.parts.items():
        assert solid_faults(solid.points(made.values), solid.triangles) == [], name
        assert np.array_equal(read.parts[name].points(made.values), solid.points(made.values))


def refusal(error):
    """A refusal is for the user, on one line; an invariant that breaks is a bug."""
    assert not isinstance(error, InvariantError), error
    return "\n" not in str(error) and len(str(error)) > 20


@settings(max_examples=25)
@given(
    near | anywhere,
    st.sampled_from(["hexagonal", "square"]),
    st.sampled_from(["fixed", "loose"]),
    st.sampled_from([{}, {"bore": 1.5}, {"side": 25.0}]),
)
def test_any_weave_makes_a_sound_kit_or_is_refused(numbers, frame, key, values):
    try:
        weave = Weave(*numbers)
        made = build(grid(frame, key, detail="draft", weave=weave, values=values))
    except ScadgenError as error:
        assert refusal(error)  # noqa: PT017  both ends are good
    else:
        assert_sound(made)


@settings(max_examples=25)
@given(lengths, st.sampled_from(["hexagonal", "square"]), st.sampled_from(["fixed", "loose"]))
def test_any_lengths_make_a_sound_kit_or_are_refused(values, frame, key):
    try:
        made = build(grid(frame, key, detail="draft", values=values))
    except ScadgenError as error:
        assert refusal(error)  # noqa: PT017  both ends are good
    else:
        assert_sound(made)
        assert {n: v for n, v in values.items() if n != "bore" or v} == {
            n: made.values[n] for n in values if n in made.values
        }


@settings(max_examples=150)
@given(
    st.sampled_from([("hexagonal", "fixed", 1.5), ("square", "loose", 1.5)]),
    st.lists(st.floats(-2, 3), min_size=8, max_size=8),
)
def test_any_settings_of_a_kit_make_sound_parts_or_are_refused(kind, factors):
    made = kit(*kind)
    # Around the defaults, so that a good part of them lies inside all ranges.
    values = {n: v * (1 + 0.2 * f) for (n, v), f in zip(made.values.items(), factors, strict=True)}
    try:
        check_values(made.ranges, values)
    except ScadgenError as error:
        assert refusal(error)  # noqa: PT017  both ends are good
    else:
        for name, solid in made.parts.items():
            assert solid_faults(solid.points(values), solid.triangles) == [], name
