"""A frame whose vertices are moved a little, so that it needs fewer kinds of parts.

Edges that are about equally long, and angles that are about equally wide, are put into classes.
Then the vertices are moved as little as can be so that a class has one length, or one angle,
exactly: Newton's method, each step the nearest solution of the linearised equations.  Classes
that cannot be met, or only by moving a vertex too far, are given up for finer ones.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import block_array, coo_array, csc_array, diags_array
from scipy.sparse.linalg import splu

from scadgen.errors import InputError
from scadgen.frame.classes import Classes, classify, group_values
from scadgen.frame.graph import Frame
from scadgen.frame.numbering import where
from scadgen.plane.drawn import make_frame
from scadgen.plane.equations import Alike, Equations, angle_sizes, find_angles
from scadgen.solid.affine import Floats

__all__ = ["Moved", "move_vertices"]

#: What share of an edge a vertex may move by, less than this.
_MOST = 0.25

#: Shares of the allowance by which lengths and angles are put together, the coarsest first.
_LEVELS = (1.0, 0.5, 0.25, 0.125, 0.0625)

#: Steps of Newton's method; it takes 4 to 8 where classes can be met.
_STEPS = 25

#: Lengths of a class are one within this, in mm, and so are angles where an edge ends: a
#: thousandth of what makes edges different.
_MET = 1e-5

#: Weight of a class's length or angle, and slack of an equation, for both are free but for this;
#: small beside 1, the weight of a vertex, and large beside the rounding of numbers.
_FREE, _SLACK = 1e-6, 1e-9

#: How often vertices that would move too far are held more firmly.
_ROUNDS = 6


@dataclass(frozen=True, slots=True, eq=False)
class Moved:
    """A frame with its vertices moved, and what that gains and costs.

    Parameters
    ----------
    frame
        The frame; the same if nothing is to be gained.
    before, after
        Kinds of joints and kinds of edges.
    largest, mean
        How far a vertex has moved, in mm.
    notes
        The same in words.
    """

    frame: Frame
    before: tuple[int, int]
    after: tuple[int, int]
    largest: float
    mean: float
    notes: tuple[str, ...]


def move_vertices(frame: Frame, within: float, shortest: float = 0.0) -> Moved:
    """Move vertices so that fewer kinds of joints and edges are left.

    Parameters
    ----------
    frame
        The frame.
    within
        How far a vertex may move, in mm.
    shortest
        Edges stay at least this long, in mm.

    Raises
    ------
    InputError
        A distance that is not positive, or so large that edges would lose their shape.
    """
    limit = _MOST * float(frame.lengths.min())
    if not 0 < within < limit:
        msg = (
            f"snap = {within:g} mm: must be above 0 and under {limit:.4g}, a quarter of the "
            "shortest edge"
        )
        raise InputError(msg)
    before = _kinds(classify(frame))
    for classes in _candidates(frame, within):
        points = _nearest(frame, classes, within)
        found = None if points is None else _checked(frame, points, shortest)
        if found is not None and points is not None and sum(found[1]) < sum(before):
            return _told(frame, points, found[0], (before, found[1]), within)
    note = f"snapped by {within:g} mm: nothing to gain, {_words(before)} as before"
    return Moved(frame, before, before, 0.0, 0.0, (note,))


def _told(
    old: Frame,
    points: Floats,
    new: Frame,
    kinds: tuple[tuple[int, int], tuple[int, int]],
    within: float,
) -> Moved:
    """The result, with its notes."""
    before, after = kinds
    moves = np.linalg.norm(points - old.plan, axis=1)
    largest, mean = float(moves.max()), float(moves.mean())
    lengths = np.linalg.norm(np.diff(points[old.edges], axis=1)[:, 0], axis=1)
    angles = find_angles(old)
    turns = np.degrees(np.abs(angle_sizes(points, angles) - angle_sizes(old.plan, angles)))
    turned = float(turns.max(initial=0.0))
    stretched = float(np.abs(lengths - old.lengths).max())
    furthest = where(old.plan[moves.argmax()])
    said = (
        f"{_words(after)} instead of {before[0]} and {before[1]}",
        f"vertices move by up to {largest:.3g} mm, at {furthest}, by {mean:.3g} mm in the mean",
        f"lengths change by up to {stretched:.3g} mm, angles by up to {turned:.3g} degrees",
    )
    notes = tuple(f"snapped by {within:g} mm: {words}" for words in said)
    return Moved(new, before, after, largest, mean, notes)


def _words(kinds: tuple[int, int]) -> str:
    joints, edges = kinds
    return f"{joints} kind{'s'[: joints != 1]} of joints, {edges} of edges"


def _kinds(same: Classes) -> tuple[int, int]:
    return len(same.joints), len(same.edges)


def _candidates(frame: Frame, within: float) -> Iterator[Alike]:
    """Classes to try, the fewest first; none twice."""
    angles = find_angles(frame)
    values = angle_sizes(frame.plan, angles)
    found: dict[bytes, Alike] = {}
    for one, other in itertools.product(_LEVELS, _LEVELS):
        # Both ends of an edge may move, and both edges of an angle turn.
        length_of = group_values(frame.lengths, 2 * within * one)[1]
        turn = 4 * within * other / float(frame.lengths.min())
        angle_of = group_values(values, turn)[1] if len(values) else np.zeros(0, np.int64)
        found.setdefault(length_of.tobytes() + angle_of.tobytes(), Alike(length_of, angle_of))
    return iter(sorted(found.values(), key=lambda classes: sum(classes.counts)))


def _checked(frame: Frame, points: Floats, shortest: float) -> tuple[Frame, tuple[int, int]] | None:
    """The moved frame and its kinds; None if its edges meet or one is too short."""
    try:
        moved = make_frame(frame.name, points, frame.edges, frame.numbering)
    except InputError:
        return None
    if moved.lengths.min() < shortest:
        return None
    return moved, _kinds(classify(moved))


def _nearest(frame: Frame, classes: Alike, within: float) -> Floats | None:
    """The nearest vertices that meet the classes; None if there are none within reach.

    The nearest in the sum of squares may move one vertex too far, where another solution
    would not; so vertices that do are given more weight, a few times.
    """
    weights = np.ones(len(frame.vertices))
    for _ in range(_ROUNDS):
        points = _met(frame, classes, weights, within)
        if points is None:
            return None
        moves = np.linalg.norm(points - frame.plan, axis=1)
        if moves.max() <= within:
            return points
        weights *= np.maximum(moves / within, 0.5) ** 2
    return None


def _met(frame: Frame, classes: Alike, weights: Floats, within: float) -> Floats | None:
    """Vertices that meet the classes, by Newton's method; None if it finds none near."""
    equations = Equations(frame, classes)
    given, points = frame.plan, frame.plan
    free = equations.guess(points)
    for _ in range(_STEPS):
        jacobian, values = equations.at(points)
        off = values - equations.picks @ free
        if np.abs(off).max() < _MET:
            return points
        matrix = csc_array(coo_array(block_array([[jacobian, -equations.picks]])))
        hold = np.concatenate([np.repeat(weights, 2), np.full(len(free), _FREE)])
        system = block_array(
            [
                [diags_array(hold), matrix.T],
                [matrix, diags_array(np.full(len(values), -_SLACK))],
            ],
            format="csc",
        )
        wanted = jacobian @ (points - given).ravel() - values
        start = np.concatenate([np.zeros(2 * len(given)), _FREE * free])
        step = splu(system).solve(np.concatenate([start, wanted]))
        points = given + step[: 2 * len(given)].reshape(-1, 2)
        free = step[2 * len(given) : len(hold)]
        if not np.linalg.norm(points - given, axis=1).max() < 4 * within:
            return None
    return None
