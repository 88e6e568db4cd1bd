"""Curves as polylines that are within a distance of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from scadgen.errors import InputError
from scadgen.solid.affine import Floats

__all__ = ["CURVED", "arc", "check_count", "flattened", "is_curved", "polyline"]

#: Coordinates of curves go up to this, in the units of the drawing: their squares are numbers.
_LARGEST = 1e12

#: What is said of curves begins so.
CURVED = "shapes with curves"

#: The curves of svgelements.
_CURVES = ("Arc", "CubicBezier", "QuadraticBezier")


def arc(radius: float, first: float, sweep: float, within: float, most: int) -> Floats:
    """Points of an arc around 0, ``(k, 2) float``.

    Parameters
    ----------
    radius
        Its radius.
    first, sweep
        Angles, in radians: of its first point, and from there to the last.
    within
        How far a chord may be from the arc.
    most
        Chords at most.

    Raises
    ------
    InputError
        More chords than that.
    """
    count = _arc_chords(abs(radius), abs(sweep), within)
    check_count(most - count)
    angles = first + sweep * np.linspace(0, 1, int(count) + 1)
    return np.asarray(radius * np.stack([np.cos(angles), np.sin(angles)], axis=1))


def polyline(path: Any, within: float, most: int) -> list[Floats]:  # noqa: ANN401 -- svgelements has no types
    """The parts of a path, each ``(k, 2) float``.

    Parameters
    ----------
    path
        A path of svgelements.
    within
        How far a chord may be from its curve, in the path's units.
    most
        Chords at most, in all.

    Raises
    ------
    InputError
        More chords than that, or numbers that are too large.
    """
    lines: list[list[Floats]] = []
    left: float = most
    for piece in path:
        kind = type(piece).__name__
        if piece.end is None:
            continue
        _check_size(piece)
        end = np.array([[piece.end.x, piece.end.y]])
        if kind == "Move" or not lines:
            lines.append([end])
            continue
        count = _chords(kind, piece, within)
        left -= count
        check_count(left)
        if count > 1:
            shares = np.linspace(0, 1, int(count) + 1)[1:-1]
            lines[-1].append(np.asarray(piece.npoint(shares)))
        lines[-1].append(end)
    return [np.concatenate(line) for line in lines]


def is_curved(path: Any) -> bool:  # noqa: ANN401 -- as above
    """Whether a path of svgelements has curves."""
    return any(type(piece).__name__ in _CURVES for piece in path)


def flattened(shapes: int, segments: int, within: float) -> tuple[str, ...]:
    """Note how many shapes with curves became how many segments, if any did.

    These are as short as their distance from the curves asks for, in mm, however large the drawing.
    """
    if not shapes:
        return ()
    note = (
        f"{CURVED}: {shapes}, now {segments} segments within {within:g} mm of them; "
        "a larger --flatten makes fewer and longer ones"
    )
    return (note,)


def check_count(left: float) -> None:
    """Refuse a drawing when no more segments are left of those allowed.

    Raises
    ------
    InputError
        Fewer than none are left.
    """
    if not left >= 0:
        msg = "its curves have more segments than are allowed; allow more, or flatten less finely"
        raise InputError(msg)


def _chords(kind: str, piece: Any, within: float) -> float:  # noqa: ANN401 -- as above
    """How many chords of equal parameter a piece needs.

    A Bezier curve of degree d is within d (d - 1) / 8 of the largest second difference of its
    control points, over the square of the number of chords.
    """
    if kind == "Arc":
        radius = max(piece.rx, piece.ry)
        return _arc_chords(radius, abs(piece.sweep), within) if min(piece.rx, piece.ry) > 0 else 1
    if kind == "QuadraticBezier":
        controls = [piece.start, piece.control, piece.end]
    elif kind == "CubicBezier":
        controls = [piece.start, piece.control1, piece.control2, piece.end]
    else:
        return 1
    bend = np.diff([[c.x, c.y] for c in controls], 2, axis=0)
    degree = len(controls) - 1
    need = degree * (degree - 1) / 8 * float(np.linalg.norm(bend, axis=1).max()) / within
    return max(1, math.ceil(math.sqrt(need)))


def _arc_chords(radius: float, sweep: float, within: float) -> float:
    """How many chords an arc needs; at least 4 go round."""
    step = 2 * math.acos(max(1 - within / radius, 0.0)) if radius else math.pi / 2
    return max(1, math.ceil(sweep / min(step, math.pi / 2) - 1e-9)) if step else math.inf


def _check_size(piece: Any) -> None:  # noqa: ANN401 -- as above
    points = [piece.start, piece.end]
    points += [getattr(piece, name, None) for name in ("control", "control1", "control2", "center")]
    if not all(max(abs(p.x), abs(p.y)) <= _LARGEST for p in points if p is not None):
        msg = "path: has a number that is too large"
        raise InputError(msg)
