"""Frames from plane meshes: OBJ and OFF, the sides of their faces and OBJ's lines."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from scadgen.errors import InputError
from scadgen.frame.numbering import Numbering
from scadgen.readers.reading import Read, Reading, checked_scale, from_graph, load, unknown
from scadgen.solid.affine import Floats, Ints

__all__ = ["read_obj", "read_off"]

#: OBJ's statements that say nothing of the shape.
_SILENT = {"g", "mg", "mtllib", "o", "s", "usemtl", "vn", "vp", "vt"}

#: Lines listed of those that are told.
_SHOWN = 5

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
    chains: list[_Chain] = []
    strange: Counter[str] = Counter()
    for number, (word, *rest) in _lines(load(path, reading), joined="\\"):
        if word == "v":
            vertices.append(_floats(number, rest[:3], 3))
            _check_count(len(vertices), reading)
        elif word in ("f", "l"):
            corners = [_index(number, part, len(vertices)) for part in rest]
            _check_corners(number, corners, 3 if word == "f" else 2)
            chains.append(_Chain(number, corners, closed=word == "f"))
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
    words = _Words(_lines(load(path, reading)))
    number, head = words.take(1, "is not OFF: it does not begin with OFF")
    if head[0] not in ("OFF", "COFF", "NOFF", "CNOFF"):
        msg = "is not OFF: it does not begin with OFF"
        raise InputError(msg)
    number, counts = words.take(2, "ends before the numbers of vertices and faces")
    if not all(map(_is_count, counts)):
        msg = f"line {number}: must be the numbers of vertices, faces and edges"
        raise InputError(msg)
    size, faces = int(counts[0]), int(counts[1])
    _check_count(max(size, faces), reading)
    words.skip_count()
    # Colours and normals follow on the same line, which has a vertex then.
    lone = head[0] != "OFF" or words.lines_have(3, size)
    vertices: list[list[float]] = []
    for done in range(size):
        number, row = words.take(3, f"ends after {done} of {size} vertices")
        vertices.append(_floats(number, row, 3))
        if lone:
            words.skip_line()
    chains = []
    for done in range(faces):
        ending = f"ends after {size} of {size} vertices and {done} of {faces} faces"
        number, (count,) = words.take(1, ending)
        number, rest = words.take(int(count) if _is_count(count) else 0, ending)
        corners = [_index(number, part, size, first=0) for part in rest]
        _check_corners(number, corners, 3)
        chains.append(_Chain(number, corners, closed=True))
        # The rest of its line is its colour.
        words.skip_line()
    return _graph(path.stem, vertices, chains, reading, first=0)


@dataclass(frozen=True, slots=True)
class _Chain:
    """Vertices with an edge from each to the next, as a line of the file lists them."""

    line: int
    corners: list[int]
    closed: bool

    def pairs(self) -> list[tuple[int, int]]:
        """Its edges; none from a vertex to itself."""
        ends = self.corners[1:] + self.corners[: int(self.closed)]
        return [(a, b) for a, b in zip(self.corners, ends, strict=False) if a != b]


class _Words:
    """The words of a text, wherever its lines end."""

    def __init__(self, lines: Iterator[tuple[int, list[str]]]) -> None:
        self._lines = list(lines)
        self._line = self._word = 0

    def take(self, count: int, ending: str) -> tuple[int, list[str]]:
        """The next so many words, and the number of the line in which the last one stands.

        Raises
        ------
        InputError
            The text ends before: with this message.
        """
        taken: list[str] = []
        number = self._lines[min(self._line, len(self._lines) - 1)][0] if self._lines else 1
        while len(taken) < count:
            if self._line >= len(self._lines):
                raise InputError(ending)
            number, words = self._lines[self._line]
            some = words[self._word : self._word + count - len(taken)]
            taken += some
            self._word += len(some)
            if self._word == len(words) and len(taken) < count:
                self._line, self._word = self._line + 1, 0
        return number, taken

    def skip_line(self) -> None:
        """Leave out what is left of the line in which the last word stands."""
        self._line, self._word = self._line + 1, 0

    def skip_count(self) -> None:
        """Leave out one more word of the line, or of the next one if it has no other."""
        if self._line >= len(self._lines):
            return
        if self._word < len(self._lines[self._line][1]):
            self._word += 1
        elif self._next() == 1:
            self._line, self._word = self._line + 1, 1
        if self._word >= len(self._lines[self._line][1]):
            self.skip_line()

    def _next(self) -> int:
        """How many words the next line has."""
        return sum(len(words) for _, words in self._lines[self._line + 1 : self._line + 2])

    def lines_have(self, least: int, count: int) -> bool:
        """Whether a line begins here, and the next so many have so many words or more."""
        if self._word:
            return False
        rows = self._lines[self._line : self._line + count]
        return len(rows) == count and all(len(words) >= least for _, words in rows)


def _is_count(word: str) -> bool:
    return word.isascii() and word.isdigit() and len(word) < 10


def _lines(data: bytes, joined: str | None = None) -> Iterator[tuple[int, list[str]]]:
    """Number and words of each line that has any.

    Parameters
    ----------
    data
        The text.
    joined
        What a line ends with that goes on in the next one.
    """
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        msg = "is not text"
        raise InputError(msg) from None
    before: list[str] = []
    for number, line in enumerate(text.splitlines(), 1):
        said = line.split("#", 1)[0].rstrip()
        goes_on = joined is not None and said.endswith(joined)
        before += said.removesuffix(joined or "").split()
        if before and not goes_on:
            yield number, before
            before = []
    if before:
        yield number, before


def _graph(
    name: str,
    vertices: list[list[float]],
    chains: list[_Chain],
    reading: Reading,
    first: int,
) -> Read:
    """Edges of all chains, each once, on the vertices that they use, counted from the first."""
    pairs = [pair for chain in chains for pair in chain.pairs()]
    repeated = [
        chain.line
        for chain in chains
        if len(chain.pairs()) < len(chain.corners) - (not chain.closed)
    ]
    if not pairs:
        msg = "has no faces and no lines"
        raise InputError(msg)
    edges: Ints = np.unique(np.sort(np.array(pairs), axis=1), axis=0)
    used, numbers = np.unique(edges, return_inverse=True)
    points = np.array(vertices)[used] * checked_scale(reading, 1.0)
    flat = _flat(points, reading.tolerance)
    read = from_graph(name, flat, numbers.reshape(-1, 2), reading, Numbering(used + first))
    return Read(read.frame, (*_told(repeated), *read.notes), read.places)


def _told(repeated: list[int]) -> tuple[str, ...]:
    """Note the lines that name a vertex twice in a row."""
    if not repeated:
        return ()
    shown = ", ".join(map(str, repeated[:_SHOWN])) + ", ..." * (len(repeated) > _SHOWN)
    many = "s" if len(repeated) > 1 else ""
    return (f"line{many} {shown}: a vertex twice in a row, taken once",)


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


def _check_count(count: int, reading: Reading) -> None:
    if count > reading.most:
        msg = f"{count} vertices or more: at most {reading.most}, unless more are allowed (--most)"
        raise InputError(msg)
