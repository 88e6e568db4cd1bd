"""What readers share: how to read, what was read, and what no frame may be."""

from __future__ import annotations

import math
import os
import stat
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import ArrayLike

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.frame.numbering import Numbering, counted, where
from scadgen.frame.words import more
from scadgen.plane.drawn import LARGEST, make_frame, vertex_pairs
from scadgen.plane.repair import MOST_SEGMENTS, TOLERANCE, repair
from scadgen.solid.affine import Floats

__all__ = [
    "Read",
    "Reading",
    "checked_scale",
    "from_graph",
    "from_segments",
    "load",
    "read_regular",
    "unknown",
]

#: A file has at most this many bytes for each segment that is allowed: a DXF line with all
#: its attributes has some 300.
_BYTES_EACH = 512

#: Bytes that are read at once.
_CHUNK = 1 << 20

#: Shortest names first in a list; more than this many kinds are not listed.
_KINDS_SHOWN = 8

#: Frames this many times as far from 0 as they are large are said to be far from it.
_FAR = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """How to read a drawing.

    Parameters
    ----------
    scale
        Millimetres per unit, instead of what the file says.
    tolerance
        Ends nearer than this are one, in mm, where they are repaired.  Meshes may be this far
        from plane.
    flatten
        Curves become segments that are at most this far off, in mm.
    split
        Whether segments that cross get a vertex there, where they are repaired.
    repair
        Whether the edges that a file lists by their vertices are repaired, as drawings always
        are.
    strict
        Whether to refuse what cannot be part of a frame, instead of leaving it out.
    centre
        Whether to move the middle of the frame to 0.
    components
        Whether the frame may have several parts that are not connected.
    shortest
        Edges must be at least this long, in mm.
    most
        Vertices, segments or edges, at most.
    """

    scale: float | None = None
    tolerance: float = TOLERANCE
    flatten: float = 0.05
    split: bool = True
    repair: bool = False
    strict: bool = False
    centre: bool = False
    components: bool = False
    shortest: float = 0.0
    most: int = MOST_SEGMENTS

    def __post_init__(self) -> None:
        """Refuse numbers that make no sense."""
        for name in ("tolerance", "flatten"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 1e-6):
                msg = f"{name} = {value!r}: must be at least 1e-06 mm"
                raise InputError(msg)
        if self.scale is not None and not (math.isfinite(self.scale) and self.scale > 0):
            msg = f"scale = {self.scale!r}: must be a positive number of mm per unit"
            raise InputError(msg)
        if not (math.isfinite(self.shortest) and self.shortest >= 0):
            msg = f"shortest = {self.shortest!r}: must be at least 0 mm"
            raise InputError(msg)
        if not self.most >= 1:
            msg = f"most = {self.most!r}: must be at least 1"
            raise InputError(msg)


@dataclass(frozen=True, slots=True, eq=False)
class Read:
    """What was read.

    Parameters
    ----------
    frame
        The frame.
    notes
        What was changed or left out on the way, one line each.
    places
        ``(p, 2) float``: where it was changed, in mm.
    """

    frame: Frame
    notes: tuple[str, ...] = ()
    places: Floats = field(default_factory=lambda: np.zeros((0, 2)))


def load(path: Path, reading: Reading) -> bytes:
    """The bytes of a file.

    Raises
    ------
    InputError
        It cannot be read, is no regular file, is empty, or longer than anything of the allowed
        size would be.
    """
    limit = _BYTES_EACH * reading.most
    try:
        data = read_regular(path, limit, f" for {reading.most} segments; allow more of them")
    except OSError as error:
        msg = f"cannot be read: {error.strerror or error}"
        raise InputError(msg) from None
    if not data.strip():
        msg = "is empty"
        raise InputError(msg)
    return data


def read_regular(path: Path, limit: int, why: str = "") -> bytes:
    """The bytes of a regular file, or of one that a link leads to.

    Parameters
    ----------
    path
        The file.
    limit
        Most bytes that it may have.
    why
        What is said of the limit.

    Raises
    ------
    OSError
        It cannot be read, or is a folder.
    InputError
        It has more bytes, or is a device or a pipe.
    """
    mode = path.stat().st_mode
    # A pipe may never begin, and a device never end.  Opening a folder says what it is.
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        msg = "is a device or a pipe: must be a regular file"
        raise InputError(msg)
    with path.open("rb") as file:
        size = os.fstat(file.fileno()).st_size
        # Some files have more in them than they say.
        data = _start(file, limit + 1) if size <= limit else b""
    size = max(size, len(data))
    if size > limit:
        msg = f"{size} bytes: at most {limit}{why}"
        raise InputError(msg)
    return data


def _start(file: BinaryIO, most: int) -> bytes:
    """The first bytes of a file, read bit by bit: it may be much shorter than that."""
    found = bytearray()
    while len(found) < most and (more_of_it := file.read(min(_CHUNK, most - len(found)))):
        found += more_of_it
    return bytes(found)


def from_graph(
    name: str,
    vertices: ArrayLike,
    edges: ArrayLike,
    reading: Reading,
    numbering: Numbering | None = None,
) -> Read:
    """A frame whose vertices and edges the file lists, and called as it does.

    Repaired ones are called by their places.

    Raises
    ------
    InputError
        It is no frame, too large, in several parts, or has edges that are too short.
    """
    points = np.asarray(vertices, dtype=float)
    pairs = vertex_pairs(edges, len(points))
    called = numbering or counted(len(points), len(pairs))
    if reading.repair:
        alone = len(points) - len(np.unique(pairs))
        notes = (f"vertices without an edge left out: {alone}",) if alone else ()
        return from_segments(name, [points[pairs]], reading, notes)
    points, moved = _centred(points, reading)
    try:
        frame = make_frame(name, points, pairs, called)
    except InputError as error:
        if not (np.abs(points) <= LARGEST).all():
            raise
        msg = f"{error}; --repair mends what it can"
        raise InputError(msg) from None
    _check(frame, reading)
    return Read(frame, moved)


def from_segments(
    name: str, segments: Sequence[Floats], reading: Reading, notes: Sequence[str] = ()
) -> Read:
    """A frame from drawn segments, each ``(k, 2, 2) float``, in mm.

    Raises
    ------
    InputError
        There are none; they make no frame, or one that is too large, in several parts, or has
        edges that are too short.
    """
    if not any(map(len, segments)):
        msg = "; ".join(["there is nothing in it that could be an edge", *notes])
        raise InputError(msg)
    joined, moved = _centred(np.concatenate(segments), reading)
    repaired = repair(name, joined, reading.tolerance, split=reading.split, most=reading.most)
    _check(repaired.frame, reading)
    return Read(repaired.frame, (*notes, *moved, *repaired.notes), repaired.places)


def unknown(kinds: Counter[str], reading: Reading) -> tuple[str, ...]:
    """Note what cannot be part of a frame, or refuse it.

    Raises
    ------
    InputError
        There is some, and it is not to be skipped.
    """
    if not kinds:
        return ()
    shown = [f"{kinds[kind]} {_printable(kind)}" for kind in sorted(kinds)[:_KINDS_SHOWN]]
    if len(kinds) > _KINDS_SHOWN:
        shown.append(f"{len(kinds) - _KINDS_SHOWN} more kinds")
    if reading.strict:
        msg = f"{', '.join(shown)}: cannot be part of a frame; without --strict it is left out"
        raise InputError(msg)
    return (f"left out: {', '.join(shown)}",)


def checked_scale(reading: Reading, stated: float) -> float:
    """Millimetres per unit: what the caller says, else what the file says."""
    return stated if reading.scale is None else reading.scale


def _printable(kind: str) -> str:
    """A word from a file, on one line and not too long."""
    return "".join(c if c.isprintable() else "?" for c in kind[:30])


def _centred(points: Floats, reading: Reading) -> tuple[Floats, tuple[str, ...]]:
    """Places around 0 if that is wanted, or if they are too far from it; and what was done.

    Parameters
    ----------
    points
        ``(..., 2) float``, in mm.
    """
    flat = points.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    far, size = float(np.abs([low, high]).max()), float((high - low).max())
    # What is no number is refused later, where it is.
    beyond = LARGEST < far < math.inf and size < LARGEST
    if not (reading.centre or beyond) or not math.isfinite(far):
        near = not size or far <= _FAR * size
        hint = f"its places are up to {far:.4g} mm from 0; --centre moves its middle there"
        return points, () if near else (hint,)
    middle = (low + high) / 2
    done = f"moved by {where(-middle)} mm, its middle to 0"
    why = f"{done}, as with --centre: its places were up to {far:.4g} mm from it"
    return points - middle, (why if beyond and not reading.centre else done,)


def _check(frame: Frame, reading: Reading) -> None:
    if len(frame.edges) > reading.most:
        msg = f"{len(frame.edges)} edges: at most {reading.most}, unless more are allowed (--most)"
        raise InputError(msg)
    if not reading.components:
        _check_connected(frame)
    short = np.flatnonzero(frame.lengths < reading.shortest)
    if len(short):
        worst = int(frame.lengths.argmin())
        msg = (
            f"{frame.called_edge(worst)} is {frame.lengths[worst]:.4g} mm long: at least "
            f"{reading.shortest:g} mm, {reading.shortest - frame.lengths[worst]:.4g} mm are "
            f"missing{more(len(short))}"
        )
        raise InputError(msg)


def _check_connected(frame: Frame) -> None:
    part = frame.components[frame.edges[:, 0]]
    lengths = np.bincount(part, frame.lengths)
    if len(lengths) == 1:
        return
    # A curve has many edges and may be small; of equally small parts the last is told.
    smallest = len(lengths) - 1 - int(lengths[::-1].argmin())
    points = frame.plan[frame.components == smallest]
    count = np.count_nonzero(part == smallest)
    msg = (
        f"{len(lengths)} parts that are not connected, the smallest of {count} "
        f"edge{'s' if count > 1 else ''} between "
        f"{where(points.min(axis=0))} and {where(points.max(axis=0))}; connect them, by a larger "
        "--tolerance where ends nearly meet, or allow it with --components"
    )
    raise InputError(msg)
