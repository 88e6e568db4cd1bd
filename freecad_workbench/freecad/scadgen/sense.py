"""What makes no sense in a kit: its names and numbers, before anything is made of them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from freecad.scadgen.cells import MOST_CELLS
from freecad.scadgen.tables import LENGTHS, OPTIONAL, PART_ROLES

__all__ = ["KEYS", "ROLES", "nonsense"]

#: Key styles.
KEYS = ("fixed", "loose")

#: What a placed piece is to the viewer.
ROLES = ("row", "cross", "half_a", "half_b", "cap", "peg")

#: What files are called, and what parts are.
_FILE, _PART = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}"), re.compile(r"[a-z][A-Za-z0-9_]*")

#: The numbers of a weave; it may have a stretch as well.
_WEAVE = ("ring_ratio", "span", "amplitude", "bend", "periods")

#: How far axes may be from square, and from one long: rounding.
_SQUARE = 1e-9


def nonsense(document: Mapping[str, Any]) -> Iterator[str]:
    """Say in one line each which names and numbers of a ``kit.json`` make no sense.

    Parameters
    ----------
    document
        The kit.  What is missing from it, or of another form, may raise instead.
    """
    has_cells = "cells" in document
    if not _is_name(_FILE, document["name"]):
        yield _wrong("name", document["name"], "a name for files: letters, digits, '.', '_', '-'")
    for name in ("key", "rim", "detail", "command"):
        if not isinstance(document[name], str):
            yield _wrong(name, document[name], "text")
    if document["key"] not in KEYS:
        yield _wrong("key", document["key"], f"one of {', '.join(KEYS)}")
    yield from _of_counts(document, 1 if has_cells else 0, MOST_CELLS if has_cells else 0)
    yield from _of_lengths(document)
    parts = document["parts"]
    for name, part in parts.items():
        yield from _of_part(name, part)
    if not document["joints"]:
        yield _wrong("joints", document["joints"], "at least one")
    for joint in document["joints"]:
        yield from _of_joint(joint, parts)
    if has_cells:
        yield from _of_tiling(document["tiling"])
        yield from _of_cells(document["cells"], parts)
    else:
        yield from _of_places(document["placements"], parts)


def _of_counts(document: Mapping[str, Any], least: int, most: int) -> Iterator[str]:
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
        if name not in LENGTHS:
            yield _wrong("live parameter", name, f"one of {', '.join(LENGTHS)}")
    for name in LENGTHS:
        if name not in values and name not in OPTIONAL:
            yield f"live parameter {name} is missing"
    for name, value in values.items():
        if not _is_number(value):
            yield _wrong(name, value, "a finite number of mm")
    for limit in document["ranges"]:
        if not isinstance(limit["reason"], str):
            yield _wrong("reason", limit["reason"], "text")


def _of_part(name: str, part: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with what a part is; its tables are read later."""
    if not _is_name(_PART, name):
        yield _wrong("name of a part", name, "letters, digits and '_', a small letter first")
    if part["role"] not in PART_ROLES:
        yield _wrong("role of a part", part["role"], f"one of {', '.join(PART_ROLES)}")
    if not _is_number(part["length"]):
        yield _wrong("length of a part", part["length"], "a finite number of edge lengths")
    for end in part["ends"]:
        if end["slot"] is not None and type(end["slot"]) is not int:
            yield _wrong("slot of an end", end["slot"], "a whole number, or null")
        if not isinstance(end["over"], bool):
            yield _wrong("over of an end", end["over"], "true or false")
    if len(part["ends"]) > 2 or (part["role"] == "half" and len(part["ends"]) != 1):
        yield _wrong("ends of a part", part["ends"], "at most two, and one of a half")


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


def _of_tiling(tiling: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with the tiling that the cells are of."""
    if not _is_name(_FILE, tiling["name"]):
        yield _wrong("name of a tiling", tiling["name"], "letters, digits, '.', '_' and '-'")
    for name, value in tiling["options"].items():
        if not _is_name(_PART, name) or not _is_number(value):
            yield _wrong(f"option {name!r:.60} of a tiling", value, "a finite number")


def _of_cells(cells: Mapping[str, Any], parts: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with what stands in a cell."""
    for name in ("across", "up"):
        if not _are_numbers(cells[name], 2):
            yield _wrong(name, cells[name], "two finite numbers")
    if not _is_number(cells["drift"]):
        yield _wrong("drift", cells["drift"], "a finite number of cells")
    yield from _of_places(cells["pieces"], parts)
    for piece in cells["pieces"]:
        for name in ("any_of", "none_of"):
            for cell in piece[name]:
                if not isinstance(cell, list) or [type(v) for v in cell] != [int, int]:
                    yield _wrong(f"cell in {name}", cell, "two whole numbers")


def _of_places(places: Any, parts: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with where pieces stand."""
    if not places:
        yield "placements: must be at least one"
    for place in places:
        if place["part"] not in parts:
            yield f"there is no part {place['part']!r:.60}"
        if place["role"] not in ROLES:
            yield _wrong("role", place["role"], f"one of {', '.join(ROLES)}")
        axes = [place[name] for name in ("x", "z")]
        for name, vector in zip(("at", "x", "z"), (place["at"], *axes)):
            if not _are_numbers(vector, 3):
                yield _wrong(name, vector, "three finite numbers")
        if all(_are_numbers(axis, 3) for axis in axes) and not _are_square(*axes):
            yield _wrong("axes x and z", axes, "unit vectors, square to each other")


def _are_square(x: Sequence[float], z: Sequence[float]) -> bool:
    """Whether two vectors are square to each other, and one long."""
    products = ((x, x, 1.0), (z, z, 1.0), (x, z, 0.0))
    return all(abs(sum(a * b for a, b in zip(u, v)) - one) < _SQUARE for u, v, one in products)


def _are_numbers(values: Any, count: int) -> bool:
    return isinstance(values, list) and len(values) == count and all(map(_is_number, values))


def _is_number(value: Any) -> bool:
    return type(value) in {int, float} and math.isfinite(value)


def _is_name(form: re.Pattern[str], name: Any) -> bool:
    return isinstance(name, str) and form.fullmatch(name) is not None


def _wrong(what: str, value: object, wanted: str) -> str:
    return f"{what} = {value!r:.60}: must be {wanted}"
