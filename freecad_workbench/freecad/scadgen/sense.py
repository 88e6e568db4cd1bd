"""What makes no sense in a kit: its names and numbers, before anything is made of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from freecad.scadgen.layout import KEYS, LAYOUTS, MOST_CELLS, PARAMETERS, PARTS, ROLES

__all__ = ["nonsense"]

#: The numbers of a weave; it may have a stretch as well.
_WEAVE = ("ring_ratio", "span", "amplitude", "bend", "periods")


def nonsense(document: Mapping[str, Any]) -> Iterator[str]:
    """Say in one line each which names and numbers of a ``kit.json`` make no sense.

    Parameters
    ----------
    document
        The kit.  What is missing from it, or of another form, may raise instead.
    """
    is_grid = "graph" not in document
    for name in ("frame", "key", "detail", "command"):
        if not isinstance(document[name], str):
            yield _wrong(name, document[name], "text")
    if document["key"] not in KEYS:
        yield _wrong("key", document["key"], f"one of {', '.join(KEYS)}")
    if is_grid and document["frame"] not in LAYOUTS:
        yield _wrong("frame", document["frame"], f"one of {', '.join(LAYOUTS)}")
    yield from _of_cells(document, 1 if is_grid else 0, MOST_CELLS if is_grid else 0)
    yield from _of_lengths(document)
    parts = document["parts"]
    for part in PARTS if is_grid else ():
        if part not in parts:
            yield f"part {part} is missing"
    if not document["joints"]:
        yield _wrong("joints", document["joints"], "at least one")
    for joint in document["joints"]:
        yield from _of_joint(joint, parts)
    if not is_grid:
        yield from _of_places(document["placements"], parts)


def _of_cells(document: Mapping[str, Any], least: int, most: int) -> Iterator[str]:
    """What is wrong with the rows and columns."""
    for name in ("rows", "columns"):
        count = document[name]
        if type(count) is not int or not least <= count <= most:
            span = f"a whole number from {least} to {most}" if most else "0"
            yield _wrong(name, count, span)


def _of_lengths(document: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with the live parameters and their ranges."""
    values = document["values"]
    for name in (*values, *(r["parameter"] for r in document["ranges"])):
        if name not in PARAMETERS:
            yield _wrong("live parameter", name, f"one of {', '.join(PARAMETERS)}")
    for name in PARAMETERS[:-1]:
        if name not in values:
            yield f"live parameter {name} is missing"
    for name, value in values.items():
        if not _is_number(value):
            yield _wrong(name, value, "a finite number of mm")
    for limit in document["ranges"]:
        if not isinstance(limit["reason"], str):
            yield _wrong("reason", limit["reason"], "text")


def _of_joint(joint: Mapping[str, Any], parts: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with a kind of joint."""
    weave = joint["weave"]
    for what, text in (("joint", joint["name"]), ("weave", weave["name"])):
        if not isinstance(text, str):
            yield _wrong(f"name of a {what}", text, "text")
    for name in (*_WEAVE, *({"stretch"} & {*weave})):
        if not _is_number(weave[name]):
            yield _wrong(f"{name} of a weave", weave[name], "a finite number")
    if not joint["connectors"]:
        yield _wrong("connectors of a joint", joint["connectors"], "at least one")
    for part in joint["connectors"]:
        if part not in parts:
            yield f"there is no part {part!r:.60}"
    yield from _of_places(joint["pieces"], parts)


def _of_places(places: Any, parts: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with where pieces stand."""
    if not places:
        yield "placements: must be at least one"
    for place in places:
        if place["part"] not in parts:
            yield f"there is no part {place['part']!r:.60}"
        at = place["at"]
        if not isinstance(at, list) or len(at) != 2 or not all(map(_is_number, at)):
            yield _wrong("at", at, "two finite numbers")
        if not _is_number(place["turn"]):
            yield _wrong("turn", place["turn"], "a finite number of degrees")
        if not isinstance(place["flip"], bool):
            yield _wrong("flip", place["flip"], "true or false")
        if place["role"] not in ROLES:
            yield _wrong("role", place["role"], f"one of {', '.join(ROLES)}")


def _is_number(value: Any) -> bool:
    return type(value) in {int, float} and math.isfinite(value)


def _wrong(what: str, value: object, wanted: str) -> str:
    return f"{what} = {value!r:.60}: must be {wanted}"
