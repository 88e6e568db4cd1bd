"""``kit.json``: what is written is what is read, and nonsense is refused in one line."""

import copy
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kits import KINDS, kit, named, proved_kit

from scadgen.errors import InputError, KitError
from scadgen.kit.store import FORMAT, VERSION, dumps, load, loads, summary

kinds = pytest.mark.parametrize("kind", KINDS, ids=named)


def document():
    return json.loads(dumps(kit("hexagonal")))


def changed(*path, to):
    """A kit's JSON with one value changed; `path` leads to it."""
    whole = document()
    place = whole
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = to
    return whole


def without(*path):
    whole = document()
    place = whole
    for step in path[:-1]:
        place = place[step]
    del place[path[-1]]
    return whole


@kinds
def test_a_kit_read_back_is_the_kit_that_was_written(kind):
    made = kit(*kind)
    read = loads(dumps(made))
    assert list(read.parts) == list(made.parts)
    for name, solid in made.parts.items():
        again = read.parts[name]
        assert list(again.coefficients) == list(solid.coefficients)
        for parameter, factors in solid.coefficients.items():
            assert np.array_equal(again.coefficients[parameter], factors)
        assert np.array_equal(again.triangles, solid.triangles)
        assert np.array_equal(again.facets, solid.facets)
    assert read.ranges == made.ranges
    assert read.joints[0].pieces == made.joints[0].pieces
    assert summary(read) == summary(made)
    assert dumps(read) == dumps(made)


def test_the_text_says_what_it_is_and_has_no_time_in_it():
    whole = document()
    assert (whole["format"], whole["version"]) == (FORMAT, VERSION)
    assert whole["generator"].startswith("scadgen ")
    assert dumps(kit("hexagonal")) == dumps(kit("hexagonal"))
    assert dumps(kit("hexagonal")).isascii()


def test_a_kit_is_found_by_its_folder_or_its_file(tmp_path):
    (tmp_path / "kit.json").write_text(dumps(kit("square")))
    assert load(tmp_path).name == "square"
    assert load(tmp_path).frame == load(tmp_path / "kit.json").frame


def test_no_kit_is_a_wrong_request(tmp_path):
    for path in (tmp_path, tmp_path / "nothing"):
        with pytest.raises(InputError, match=r"no kit can be read there .*scadgen kit -o FOLDER"):
            load(path)
    drawing = tmp_path / "drawing.svg"
    drawing.write_text("<svg/>")
    with pytest.raises(InputError, match=r"drawing\.svg: must be a kit's folder"):
        load(drawing)


def test_what_is_not_text_is_not_a_kit(tmp_path):
    (tmp_path / "kit.json").write_bytes(b'{"format": "\xff"}')
    with pytest.raises(KitError, match="not a kit: byte 12 is not UTF-8"):
        load(tmp_path)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.9, 0.999])
def test_a_truncated_kit_is_refused(share, tmp_path):
    text = dumps(kit("hexagonal"))
    (tmp_path / "kit.json").write_text(text[: int(share * len(text))])
    with pytest.raises(KitError, match="truncated or not JSON") as error:
        load(tmp_path)
    assert "\n" not in str(error.value)
    assert str(tmp_path) in str(error.value)


@pytest.mark.parametrize("version", [0, 1, 2, 3, 4, "5", None, 1.5, [5]])
@pytest.mark.parametrize("command", ["scadgen kit hexagonal --rows 4", "", "a\nb", 3])
def test_another_version_is_refused_with_what_makes_the_kit_again(version, command):
    whole = changed("version", to=version) | {"command": command}
    with pytest.raises(KitError, match=r"kit version .*: this scadgen .* reads version 5") as error:
        loads(json.dumps(whole))
    again = (
        ": scadgen kit hexagonal --rows 4"
        if command == "scadgen kit hexagonal --rows 4"
        else (" with scadgen kit")
    )
    assert str(error.value).endswith(f"make it again{again}")
    assert repr(version) in str(error.value)
    assert "\n" not in str(error.value)


BASIC = ("parts", "basic")
PIECE = ("joints", 0, "pieces", 0)
NONSENSE = {
    "a list": list,
    "a number": lambda: 3,
    "nothing": lambda: None,
    "another format": lambda: changed("format", to="gearbox"),
    "a frame beside cells": lambda: (
        document() | {"frame": {"name": "a", "vertices": [], "edges": []}}
    ),
    "no cells": lambda: without("cells"),
    "a cell of an unknown joint": lambda: changed("cells", "vertices", 0, "joint", to="Z"),
    "a cell without its vertices": lambda: changed("cells", "vertices", to=[]),
    "a cell at a vertex that is not there": lambda: changed(
        "cells", "pieces", 0, "ends", 0, to=[7, 0, 0, 0]
    ),
    "a cell in a slot that is not there": lambda: changed("cells", "pieces", 0, "ends", 0, 3, to=9),
    "a tiling that does not exist": lambda: changed("tiling", "name", to="gears"),
    "an end in a slot below zero": lambda: changed("cells", "pieces", 0, "ends", 0, 3, to=-1),
    "an end in a slot that is no whole number": lambda: changed(
        "cells", "pieces", 0, "ends", 0, 3, to=1.0
    ),
    "cells that are nowhere": lambda: changed("cells", "vertices", 0, "any_of", to=[]),
    "a piece beside its vertex": lambda: changed("cells", "pieces", 0, "at", to=[0.1, 0.7, 0.0]),
    "a name of two lines": lambda: changed("name", to="hexagonal\n"),
    "a half without its end": lambda: changed("parts", "half", "ends", to=[]),
    "an element without length": lambda: changed("parts", "basic", "length", to=0),
    "edges in no order": lambda: changed("joints", 0, "turns", to=[0, 240, 120]),
    "no key at the first edge": lambda: changed("joints", 0, "keys", to=[1]),
    "an edge without its element": lambda: changed("cells", "pieces", 0, "ends", to=[[0, 0, 0, 1]]),
    "no parts": lambda: without("parts"),
    "a part missing": lambda: without("parts", "half"),
    "a part for nothing": lambda: changed("parts", "peg", "role", to="gear"),
    "an unknown key": lambda: changed("gears", to=3),
    "rows below one": lambda: changed("rows", to=0),
    "rows in words": lambda: changed("rows", to="two"),
    "a value that is text": lambda: changed("values", "side", to="10"),
    "a value below zero": lambda: changed("values", "clearance", to=-0.2),
    "a value out of its range": lambda: changed("values", "clearance", to=3.0),
    "a value missing": lambda: without("values", "side"),
    "a bore that no part has": lambda: changed("values", "bore", to=1.0),
    "a range of an unknown length": lambda: changed("ranges", 0, "parameter", to="gear"),
    "a range without its end": lambda: without("ranges", 0, "high"),
    "no ranges": lambda: changed("ranges", to=[]),
    "a range that needs a bore": lambda: changed("ranges", 0, "high", "terms", to={"bore": 1.0}),
    "a range upside down": lambda: changed("ranges", 0, "low", "constant", to=1e6),
    "a triangle with a fourth corner": lambda: changed(*BASIC, "triangles", 0, to=[0, 1, 2, 3]),
    "a triangle with no such corner": lambda: changed(*BASIC, "triangles", 0, to=[0, 1, 10**6]),
    "a corner below zero": lambda: changed(*BASIC, "triangles", 0, 0, to=-1),
    "a corner between vertices": lambda: changed(*BASIC, "triangles", 0, 0, to=0.5),
    "a corner far beyond": lambda: changed(*BASIC, "triangles", 0, 0, to=10**30),
    "a triangle missing": lambda: without(*BASIC, "triangles", 0),
    "a triangle turned over": lambda: changed(
        *BASIC, "triangles", 0, to=document()["parts"]["basic"]["triangles"][0][::-1]
    ),
    "triangles in words": lambda: changed(*BASIC, "triangles", to=["a", "b", "c", "d"]),
    "a facet missing": lambda: without(*BASIC, "facets", 0),
    "a facet in words": lambda: changed(*BASIC, "facets", 0, to="top"),
    "a vertex missing": lambda: without(*BASIC, "points", "side", 0),
    "a coordinate missing": lambda: without(*BASIC, "points", "side", 0, 0),
    "a coordinate in words": lambda: changed(*BASIC, "points", "side", 0, 0, to="wide"),
    "a coordinate that is nothing": lambda: changed(*BASIC, "points", "side", 0, 0, to=None),
    "a coordinate too large": lambda: changed(*BASIC, "points", "side", 0, 0, to=float("inf")),
    "a coordinate that is no number": lambda: changed(
        *BASIC, "points", "side", 0, 0, to=float("nan")
    ),
    "points by an unknown length": lambda: changed(*BASIC, "points", "gear", to=[[0, 0, 0]] * 4),
    "a placement of an unknown part": lambda: changed(*PIECE, "part", to="gear"),
    "a placement without a height": lambda: changed(*PIECE, "at", to=[0, 0]),
    "a placement with long axes": lambda: changed(*PIECE, "x", to=[2, 0, 0]),
    "a placement with axes that lean": lambda: changed(*PIECE, "z", to=[0.6, 0, 0.8]),
    "a weave without a name": lambda: without("joints", 0, "weave", "name"),
}


@pytest.mark.parametrize("edit", NONSENSE.values(), ids=NONSENSE)
def test_a_kit_edited_into_nonsense_is_refused_in_one_line(edit):
    with pytest.raises(KitError, match="make it again with scadgen kit") as error:
        loads(json.dumps(edit()))
    assert "\n" not in str(error.value)
    assert len(str(error.value)) < 400


WAYS = {
    "no ways": (list.clear, "half, half, connector, connector, peg come apart"),
    "the last way missing": (list.pop, "ways: there is none by which connector, connector come"),
    "the first way missing": (lambda ways: ways.pop(0), "by which connector, peg come apart"),
    "a way twice": (lambda ways: ways.append(ways[0]), "'the peg comes out' moves pieces that"),
    "a way of no piece": (lambda ways: ways[0].update(moving=[99]), "moves pieces that are not"),
}


@pytest.mark.parametrize(("edit", "reason"), WAYS.values(), ids=WAYS)
def test_a_proved_kit_without_all_its_ways_is_refused(edit, reason):
    whole = json.loads(dumps(proved_kit("hexagonal")))
    assert loads(json.dumps(whole)).proved
    edit(whole["joints"][0]["ways"])
    with pytest.raises(KitError, match=reason) as error:
        loads(json.dumps(whole))
    assert "\n" not in str(error.value)


def test_endless_nesting_is_refused():
    with pytest.raises(KitError, match=r"not JSON|not scadgen-kit"):
        loads("[" * 100_000)


junk = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 10**12) | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner),
    max_leaves=4,
)


@settings(max_examples=60)
@given(st.data())
def test_any_edit_is_read_as_a_sound_kit_or_refused(data):
    whole = copy.deepcopy(document())
    place = whole
    while True:
        keys = list(place) if isinstance(place, dict) else range(len(place))
        key = data.draw(st.sampled_from(keys))
        deeper = place[key]
        if not isinstance(deeper, dict | list) or not deeper or data.draw(st.booleans()):
            break
        place = deeper
    place[key] = data.draw(junk)
    try:
        read = loads(json.dumps(whole))
    except KitError as error:
        assert "\n" not in str(error)  # noqa: PT017  both ends are good
    else:
        assert loads(dumps(read)).values == read.values
        for solid in read.parts.values():
            assert np.isfinite(solid.points(read.values)).all()
