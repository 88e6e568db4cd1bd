"""Lengths and angles that are to be one, as equations in the places of vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csc_array

from scadgen.frame.graph import Frame
from scadgen.solid.affine import Floats, Ints

__all__ = ["Alike", "Angles", "Equations", "angle_sizes", "find_angles"]


@dataclass(frozen=True, slots=True, eq=False)
class Alike:
    """Which lengths, and which angles, are to be one.

    Parameters
    ----------
    length_of, angle_of
        Class of each edge, and of each angle of `Angles`.
    """

    length_of: Ints
    angle_of: Ints

    @property
    def counts(self) -> tuple[int, int]:
        """Number of classes of lengths and of angles."""
        return int(self.length_of.max()) + 1, int(self.angle_of.max(initial=-1)) + 1


@dataclass(frozen=True, slots=True, eq=False)
class Angles:
    """The angles between neighbouring edges, each by three vertices: ``(k,) int``."""

    middle: Ints
    first: Ints
    second: Ints


def find_angles(frame: Frame) -> Angles:
    """All angles, but those of loose ends."""
    ends, count = frame.ends, len(frame.ends.edge)
    after = np.arange(1, count + 1)
    after[ends.first[1:] - 1] = ends.first[:-1]
    middle = np.repeat(np.arange(len(frame.vertices)), frame.degree)
    some = frame.degree[middle] > 1
    return Angles(middle[some], ends.neighbour[some], ends.neighbour[after][some])


def angle_sizes(points: Floats, angles: Angles) -> Floats:
    """Size of each angle, in radians, above 0 and up to 2 pi."""
    to = [points[end] - points[angles.middle] for end in (angles.first, angles.second)]
    one, other = (np.arctan2(way[:, 1], way[:, 0]) for way in to)
    return np.asarray(2 * np.pi - (one - other) % (2 * np.pi))


class Equations:
    """That each length and each angle is its class's, in mm.

    Parameters
    ----------
    frame
        The frame.
    classes
        The classes.
    """

    def __init__(self, frame: Frame, classes: Alike) -> None:
        self._edges, self._angles = frame.edges, find_angles(frame)
        self._size = len(frame.vertices)
        #: What an angle is multiplied with, in mm: how far it moves the end of an edge.
        self._arm = float(np.median(frame.lengths))
        lengths, angles = classes.counts
        of = np.concatenate([classes.length_of, lengths + classes.angle_of])
        #: Which class is in which equation, ``(equations, classes)``.
        self.picks = csc_array(
            coo_array((np.ones(len(of)), (np.arange(len(of)), of)), (len(of), lengths + angles))
        )

    def guess(self, points: Floats) -> Floats:
        """The mean length or angle of each class."""
        _, values = self.at(points)
        return np.asarray(self.picks.T @ values / self.picks.sum(axis=0))

    def at(self, points: Floats) -> tuple[csc_array, Floats]:
        """All lengths, then all angles, and how vertices change them: ``(k, 2 n)``."""
        start, end = self._edges.T
        ways = points[end] - points[start]
        lengths = np.linalg.norm(ways, axis=1)
        along = ways / lengths[:, None]
        row = np.arange(len(lengths))
        entries = [(row, end, along), (row, start, -along)]
        angles = self._angles
        row = len(lengths) + np.arange(len(angles.middle))
        for tip, sign in ((angles.second, 1.0), (angles.first, -1.0)):
            way = points[tip] - points[angles.middle]
            # A direction turns by what its end moves aside, over its length.
            aside = way[:, ::-1] * (-1.0, 1.0) / (way**2).sum(axis=1)[:, None]
            aside *= sign * self._arm
            entries += [(row, tip, aside), (row, angles.middle, -aside)]
        values = np.concatenate([lengths, self._arm * angle_sizes(points, angles)])
        rows = np.concatenate([np.repeat(r, 2) for r, _, _ in entries])
        columns = np.concatenate([(2 * v[:, None] + (0, 1)).ravel() for _, v, _ in entries])
        data = np.concatenate([d.ravel() for _, _, d in entries])
        shape = (len(values), 2 * self._size)
        return csc_array(coo_array((data, (rows, columns)), shape)), values
