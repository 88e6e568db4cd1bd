"""Which joints and which edges of a frame are the same part.

Two joints are the same if one can be turned onto the other, about its axis or by turning it over.
Two edges are the same if they are equally long, twist alike and end in the same places of the same
joints, one way round or the other, one side up or the other.
"""

from __future__ import annotations

import math
import string
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scadgen.errors import InputError
from scadgen.frame.element_classes import ElementEnds, Slots
from scadgen.frame.graph import Frame
from scadgen.frame.joint_classes import JointClass, classify_joints
from scadgen.frame.numbering import where
from scadgen.solid.affine import Floats, Ints

__all__ = [
    "Classes",
    "EdgeClass",
    "Snapped",
    "classify",
    "group_values",
    "joint_name",
    "snap",
]

#: Joints are the same within this, in radians: what three decimals do to edges of 10 mm.
_ANGLE = 1e-4

#: Lengths are the same within this, in mm: what printing does not resolve.
_LENGTH = 0.01


@dataclass(frozen=True, slots=True, eq=False)
class EdgeClass:
    """Edges that are the same.

    Parameters
    ----------
    length, twist
        In mm, and in radians: how far they turn about themselves from one end to the other.
    joints
        Class of the joint at its first and second end.
    slots
        Its slot in that class there, the lowest of those that are alike.
    over
        Whether the joint at its second end is turned over, as seen from that at its first.
    edges
        ``(n,) int``: which edges, ascending.
    """

    length: float
    twist: float
    joints: tuple[int, int]
    slots: tuple[int, int]
    over: bool
    edges: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Classes:
    """What of a frame is the same.

    Parameters
    ----------
    joints
        Classes of joints, by number of edges, then by gaps.
    joint_of
        ``(n,) int``: class of each vertex.
    over
        ``(n,) bool``: whether the class is turned over to be the vertex's joint.
    turn
        ``(n,) float``: direction of the class's first edge there, from 0 to before a full turn
        by the number of ways it can be turned onto itself; less than 0 by the tolerance at most.
    shift
        ``(n,) int``: the vertex's slot that this edge takes.
    edges
        Classes of edges, by joints, slots and length.
    edge_of
        ``(m,) int``: class of each edge.
    swapped
        ``(m,) bool``: whether the first end of the class is at the edge's second vertex.
    angle_errors
        ``(n,) float``: largest difference of a direction from its class's, in radians.
    length_errors
        ``(m,) float``: difference of a length from its class's, in mm.
    """

    joints: tuple[JointClass, ...]
    joint_of: Ints
    over: NDArray[np.bool_]
    turn: Floats
    shift: Ints
    edges: tuple[EdgeClass, ...]
    edge_of: Ints
    swapped: NDArray[np.bool_]
    angle_errors: Floats
    length_errors: Floats

    @property
    def lengths(self) -> Floats:
        """``(m,) float``: the length of each edge's class, in mm."""
        return np.array([edge.length for edge in self.edges])[self.edge_of]

    @property
    def twists(self) -> Floats:
        """``(m,) float``: the twist of each edge's class, in radians."""
        return np.array([edge.twist for edge in self.edges])[self.edge_of]


@dataclass(frozen=True, slots=True, eq=False)
class Snapped:
    """What is the same after angles and lengths are rounded together, and what that costs.

    Parameters
    ----------
    same
        The classes.
    angle_error, length_error
        Largest change of a direction, in radians, and of a length, in mm.
    miss
        Largest distance, in mm, between where an edge's part would end and its other vertex.
    notes
        The same in words, with the places.
    """

    same: Classes
    angle_error: float
    length_error: float
    miss: float
    notes: tuple[str, ...]


def classify(
    frame: Frame, angle_tolerance: float | None = None, length_tolerance: float = _LENGTH
) -> Classes:
    """Group joints by congruence and edges by what they connect.

    Parameters
    ----------
    frame
        The frame.
    angle_tolerance
        In radians: a joint is put to a class if one turn brings every direction, and every slope,
        within this of the class's first joint; edges of a class twist alike within it.  None: what
        three decimals do to edges of 10 mm, or less where two edges are so near each other that
        they would be one.
    length_tolerance
        In mm: a length is put to a class if it is within this of the class's.

    Raises
    ------
    InputError
        A tolerance that is not positive, or angles so coarse that two edges would be one.
    """
    smallest = float(frame.ends.gap.min())
    if angle_tolerance is None:
        angle_tolerance = min(_ANGLE, smallest / 8)
    if not 0 < angle_tolerance < smallest / 4:
        msg = (
            f"angle_tolerance = {angle_tolerance!r}: must be positive and under "
            f"{smallest / 4:.4g}, a quarter of the smallest gap"
        )
        raise InputError(msg)
    joints, (joint_of, over, shift), (turn, errors) = classify_joints(frame, angle_tolerance)
    lengths, length_of = group_values(frame.lengths, length_tolerance)
    twists, twist_of = group_values(frame.twists, angle_tolerance)
    kind, way = joint_of[frame.edges], 1 - 2 * over
    slot = way[frame.edges] * (frame.slots - shift[frame.edges]) % frame.degree[frame.edges]
    alike = Slots.of([joint.symmetry for joint in joints])
    turned = alike.over[kind, slot] ^ over[frame.edges].astype(bool)
    ends = ElementEnds(
        alike.what[kind, slot],
        turned,
        alike.either[kind, slot],
        lengths[length_of],
        twists[twist_of],
    )
    found, most = ends.alike(), alike.most
    members = _members(found.which, len(found.what))
    sizes = zip(found.length.tolist(), found.twist.tolist(), strict=True)
    parts = zip(found.what.tolist(), found.over.tolist(), sizes, members, strict=True)
    edges = tuple(
        EdgeClass(*size, (a // most, b // most), (a % most, b % most), one != other, which)
        for (a, b), (one, other), size, which in parts
    )
    off = np.abs(frame.lengths - lengths[length_of])
    return Classes(
        *(joints, joint_of, over.astype(bool), turn, shift),
        *(edges, found.which, found.swapped, errors, off),
    )


def snap(frame: Frame, angle: float | None, length: float) -> Snapped:
    """Round angles and lengths together, so that fewer kinds of parts are needed.

    The frame stays as it is; parts are made for the classes, and the joints' play has to
    take up what is said here.

    Parameters
    ----------
    frame
        The frame.
    angle
        How far a direction may be off, in radians; None: as `sameness` has it.
    length
        How far a length may be off, in mm.

    Raises
    ------
    InputError
        As `classify`.
    """
    same = classify(frame, angle, length)
    aside = frame.lengths[:, None] * np.sin(same.angle_errors[frame.edges])
    miss = np.hypot(aside.max(axis=1), same.length_errors)
    vertex, edge = int(same.angle_errors.argmax()), int(same.length_errors.argmax())
    middle = frame.places[frame.edges].mean(axis=1)
    worst = math.degrees(same.angle_errors[vertex])
    notes = (
        f"{len(same.joints)} kinds of joints, {len(same.edges)} kinds of edges",
        f"angles change by up to {worst:.3g} degrees, at {where(frame.places[vertex])}",
        f"lengths change by up to {same.length_errors[edge]:.3g} mm, at {where(middle[edge])}",
        f"ends miss by up to {miss.max():.3g} mm, at {where(middle[miss.argmax()])}",
    )
    return Snapped(
        same,
        float(same.angle_errors.max()),
        float(same.length_errors.max()),
        float(miss.max()),
        notes,
    )


def joint_name(kind: int) -> str:
    """Name of a kind of joint: A to Z, then AA, AB, ...

    Parameters
    ----------
    kind
        Its number, from 0.

    Examples
    --------
    >>> joint_name(0), joint_name(25), joint_name(26)
    ('A', 'Z', 'AA')
    """
    more, letter = divmod(kind, 26)
    return (joint_name(more - 1) if more else "") + string.ascii_uppercase[letter]


def group_values(values: Floats, tolerance: float) -> tuple[Floats, Ints]:
    """Round numbers together with as few results as can be.

    Parameters
    ----------
    values
        ``(n,) float``.
    tolerance
        How far a number may be moved.

    Returns
    -------
    results
        ``(k,) float``, ascending.
    group
        ``(n,) int``: the result of each number.

    Raises
    ------
    InputError
        A tolerance that is not positive.
    """
    if not tolerance > 0:
        msg = f"tolerance = {tolerance!r}: must be positive"
        raise InputError(msg)
    ascending = np.sort(values)
    starts = [0]
    while starts[-1] < len(values):
        reach = ascending[starts[-1]] + 2 * tolerance
        starts.append(int(np.searchsorted(ascending, reach, side="right")))
    *starts, end = starts
    stops = np.array([*starts[1:], end]) - 1
    results = (ascending[starts] + ascending[stops]) / 2
    return results, np.searchsorted(ascending[starts], values, side="right") - 1


def _members(group: Ints, count: int) -> list[Ints]:
    """Which elements are in each group."""
    order = np.argsort(group, kind="stable")
    return np.split(order, np.cumsum(np.bincount(group, minlength=count))[:-1])
