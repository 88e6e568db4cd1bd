"""Frames from plane meshes: OBJ and OFF, the sides of their faces and OBJ's lines."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from scadgen.errors import InputError
from scadgen.frame.numbering import Numbering
from scadgen.readers.reading import Read, Reading, checked_scale, from_graph, load, unknown
from scadgen.solid.affine import Floats, Ints

__all__ = ["read_obj", "read_off"]

#: OBJ's statements that say nothing of the shape.
_SILENT = {"g", "mg", "mtllib", "o", "s", "usemtl", "vn", "vp", "vt"}

#: A plane whose normal rises by no more than this stands upright, in radians: rounded decimals.
_UPRIGHT = 1e-6


def read_obj(path: Path, reading: Reading) -> Read:
    """Read a frame from a Wavefront OBJ file: sides of `f` and pieces of `l`, in mm.

    Raises
    ------
    InputError
        Another kind of file, statements that cannot be part of a frame, not plane; or no
        frame.
    """
    vertices: list[list[float]] = []
    chains: list[tuple[list[int], bool]] = []
    strange: Counter[str] = Counter()
    for number, (word, *rest) in _lines(load(path, reading)):
        if word == "v":
            vertices.append(_floats(number, rest[:3], 3))
            _check_count(len(vertices), reading)
        elif word in ("f", "l"):
            corners = [_index(number, part, len(vertices)) for part in rest]
            _check_corners(number, corners, 3 if word == "f" else 2)
            chains.append((corners, word == "f"))
        elif word not in _SILENT:
            strange[word] += 1
    if not vertices:
        msg = "is not OBJ: it has no line that begins with v"
        raise InputError(msg)
    notes = unknown(strange, reading)
    read = _graph(path.stem, vertices, chains, reading, first=1)
    return Read(read.frame, (*notes, *read.notes), read.places)


def read_off(path: Path, reading: Reading) -> Read:
    """Read a frame from an OFF file: the sides of its faces, in mm.

    Raises
    ------
    InputError
        Another kind of file, not plane; or no frame.
    """
    lines = _lines(load(path, reading))
    number, (head, *counts) = next(lines, (1, [""]))
    if head not in ("OFF", "COFF", "NOFF"):
        msg = "is not OFF: it does not begin with OFF"
        raise InputError(msg)
    if not counts:
        number, counts = next(lines, (number, []))
    if len(counts) < 2 or not all(c.isascii() and c.isdigit() and len(c) < 10 for c in counts[:2]):
        msg = f"line {number}: must be the numbers of vertices, faces and edges"
        raise InputError(msg)
    size, faces = int(counts[0]), int(counts[1])
    _check_count(max(size, faces), reading)
    rows = list(lines)
    if len(rows) < size + faces:
        msg = f"ends after {len(rows)} of {size} vertices and {faces} faces"
        raise InputError(msg)
    vertices = [_floats(number, row[:3], 3) for number, row in rows[:size]]
    chains = []
    for number, (count, *rest) in rows[size : size + faces]:
        sides = int(count) if count.isascii() and count.isdigit() and len(count) < 10 else 0
        corners = [_index(number, part, size, first=0) for part in rest[:sides]]
        _check_corners(number, corners if len(corners) == sides else [], 3)
        chains.append((corners, True))
    return _graph(path.stem, vertices, chains, reading, first=0)


def _lines(data: bytes) -> Iterator[tuple[int, list[str]]]:
    """Number and words of each line that has any."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        msg = "is not text"
        raise InputError(msg) from None
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split("#", 1)[0].split()
        if words:
            yield number, words


def _graph(
    name: str,
    vertices: list[list[float]],
    chains: list[tuple[list[int], bool]],
    reading: Reading,
    first: int,
) -> Read:
    """Edges of all chains, each once, on the vertices that they use, counted from the first."""
    pairs = [
        pair
        for corners, closed in chains
        for pair in zip(corners, corners[1:] + corners[: int(closed)], strict=False)
    ]
    if not pairs:
        msg = "has no faces and no lines"
        raise InputError(msg)
    edges: Ints = np.unique(np.sort(np.array(pairs), axis=1), axis=0)
    used, numbers = np.unique(edges, return_inverse=True)
    points = np.array(vertices)[used] * checked_scale(reading, 1.0)
    flat = _flat(points, reading.tolerance)
    return from_graph(name, flat, numbers.reshape(-1, 2), reading, Numbering(used + first))


def _flat(points: Floats, tolerance: float) -> Floats:
    """Points of a plane in that plane, turned to the horizontal the shortest way."""
    if np.ptp(points[:, 2]) <= tolerance:
        return points[:, :2]
    from_middle = points - points.mean(axis=0)
    # The triangle of a QR decomposition has the same axes, and three rows at most.
    normal = np.linalg.svd(np.linalg.qr(from_middle, mode="r"))[2][2]
    up = 2 if abs(normal[2]) > _UPRIGHT else np.abs(normal).argmax()
    normal = normal * (1.0 if normal[up] > 0 else -1.0)
    off = np.abs(from_middle @ normal)
    if not off.max() <= tolerance:
        msg = (
            f"is not plane: a vertex is {off.max():.4g} mm off the plane of best fit, at most "
            f"{tolerance:g} mm are allowed"
        )
        raise InputError(msg)
    axis = np.array([normal[1], -normal[0], 0.0])
    cross = np.array([[0.0, 0.0, axis[1]], [0.0, 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    turn = np.eye(3) + cross + cross @ cross / (1 + normal[2])
    return np.asarray((points @ turn.T)[:, :2])


def _floats(number: int, words: list[str], count: int) -> list[float]:
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) != count or not np.isfinite(values).all():
        msg = f"line {number}: must have {count} numbers"
        raise InputError(msg)
    return values


def _index(number: int, word: str, size: int, first: int = 1) -> int:
    """A vertex from 0; OBJ counts from 1, or from the last one back with a minus."""
    text = word.split("/", 1)[0]
    try:
        value = int(text) if len(text) < 12 else size + first
    except ValueError:
        value = size + first
    index = size + value if first and value < 0 else value - first
    if not 0 <= index < size:
        msg = f"line {number}: {word[:20]!r} is none of the {size} vertices before it"
        raise InputError(msg)
    return index


def _check_corners(number: int, corners: list[int], least: int) -> None:
    if len(corners) < least:
        msg = f"line {number}: must have {least} vertices or more"
        raise InputError(msg)
    closing = corners[:1] if least == 3 else []
    if any(a == b for a, b in zip(corners, corners[1:] + closing, strict=False)):
        msg = f"line {number}: an edge from a vertex to itself"
        raise InputError(msg)


def _check_count(count: int, reading: Reading) -> None:
    if count > reading.most:
        msg = f"{count} vertices or more: at most {reading.most}, unless more are allowed (--most)"
        raise InputError(msg)
