"""Frames as JSON: ``{"vertices": [[x, y], ...], "edges": [[i, j], ...]}``."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.readers.reading import Read, Reading, checked_scale, from_graph, load
from scadgen.solid.affine import Ints

__all__ = ["UNITS", "dumps", "read_json"]

#: Millimetres in each unit that ``"unit"`` may name.
UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}

_KEYS = {"comment", "name", "unit", "vertices", "edges"}


def read_json(path: Path, reading: Reading) -> Read:
    """Read a frame from JSON; beside vertices and edges it may have a name, a unit and a comment.

    Raises
    ------
    InputError
        Another kind of file, or no frame: what and where.
    """
    data = load(path, reading)
    try:
        document = json.loads(data, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        msg = f"is not JSON: {_one_line(error)}"
        raise InputError(msg) from None
    if not isinstance(document, dict) or not {"vertices", "edges"} <= set(document):
        msg = 'must be a JSON object with "vertices" and "edges"'
        raise InputError(msg)
    strange = sorted(set(document) - _KEYS)
    if strange:
        msg = f"unknown {_one_line(', '.join(strange))}; known are {', '.join(sorted(_KEYS))}"
        raise InputError(msg)
    unit, name = document.get("unit", "mm"), document.get("name", path.stem)
    if unit not in list(UNITS):
        msg = f"unit {_one_line(repr(unit))}: must be one of {', '.join(UNITS)}"
        raise InputError(msg)
    if not isinstance(name, str) or not re.fullmatch(r"[\w. -]{1,100}", name):
        msg = f"name {_one_line(repr(name))}: must be letters, digits, spaces, dots and dashes"
        raise InputError(msg)
    scale = checked_scale(reading, UNITS[unit])
    for key, kinds in (("vertices", (int, float)), ("edges", (int,))):
        _check_pairs(key, document[key], kinds, reading.most)
    vertices = [[float(x) * scale, float(y) * scale] for x, y in document["vertices"]]
    return from_graph(name, vertices, document["edges"], reading)


def dumps(frame: Frame) -> str:
    """A frame as JSON, in the order of the JSON it was read from; read back it equals the frame."""
    order, of_edges = (
        _order(numbers, count)
        for numbers, count in (
            (frame.called.vertices, len(frame.vertices)),
            (frame.called.edges, len(frame.edges)),
        )
    )
    vertices = ",\n  ".join(json.dumps(point) for point in frame.plan[order].tolist())
    pairs = np.argsort(order)[frame.edges[of_edges]]
    edges = ",\n  ".join(json.dumps(pair) for pair in pairs.tolist())
    return (
        f'{{\n "name": {json.dumps(frame.name)},\n "unit": "mm",\n'
        f' "vertices": [\n  {vertices}\n ],\n "edges": [\n  {edges}\n ]\n}}\n'
    )


def _order(numbers: Ints | None, count: int) -> Ints:
    """Which comes first, and so on, by numbers that are those of a list; else as they are."""
    whole = np.arange(count)
    if numbers is None or not np.array_equal(np.sort(numbers), whole):
        return whole
    return np.argsort(numbers)


def _refuse(constant: str) -> NoReturn:
    msg = f"{constant} is no number"
    raise ValueError(msg)


def _check_pairs(key: str, rows: Any, kinds: tuple[type, ...], most: int) -> None:  # noqa: ANN401 -- JSON
    if not isinstance(rows, list):
        msg = f"{key}: must be a list of pairs"
        raise InputError(msg)
    if len(rows) > most:
        msg = f"{len(rows)} {key}: at most {most}, unless more are allowed (--most)"
        raise InputError(msg)
    for number, row in enumerate(rows):
        good = isinstance(row, list) and len(row) == 2
        # bool is an int to Python, and whole numbers may be longer than any float.
        if not good or not all(type(n) in kinds and abs(n) < 1e300 for n in row):
            what = "whole numbers" if float not in kinds else "numbers"
            msg = f"{key}[{number}] = {_one_line(json.dumps(row))}: must be two {what}"
            raise InputError(msg)


def _one_line(text: object) -> str:
    line = " ".join(str(text).split())
    return line if len(line) <= 80 else f"{line[:77]}..."
