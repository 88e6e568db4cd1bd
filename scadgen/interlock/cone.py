"""Which motions the walls near a body allow, at one pose: a cone, and what is nearest in it.

Points of either surface are held against the other's distance field.  Each one near has a
row as contacts have: how fast it recedes under a translation and a rotation times the size.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import linprog, nnls

from scadgen.interlock.contacts import Mesh
from scadgen.interlock.field import Field
from scadgen.interlock.scene import Scene, Stance
from scadgen.solid.affine import Floats, Ints

__all__ = ["Walls", "nearest", "widest"]

#: Distance of the grids' nodes and of the points, in sizes of the body.
_CELL, _SPACING = 0.035, 0.07

#: Distance of the points for a closer look.
_CLOSE_SPACING = 0.04

#: Nodes of a grid at most; beyond, its cells are wider.
_NODES = 1.5e6

#: How near a point has to be to count, how far points are kept in sight, and how fast one
#: that is too near is made to recede, in sizes.
_BAND, _SIGHT, _RECEDE = 0.075, 0.25, 0.008

#: Rows taken in at once, rounds of that, and how far one may be violated, in sizes.
_ADD, _ROUNDS, _VIOLATED = 40, 6, 2e-4

#: Sine of the angle up to which faces are one.
_FLAT = 0.02

#: Residual below which walls contradict each other.
_SOLVABLE = 1e-9


class Walls:
    """Distances between the surfaces of a body and of what is around it.

    Parameters
    ----------
    scene
        The body among the others.
    close
        Whether to look closely: at more points, and by exact distances, which takes longer.
    """

    def __init__(self, scene: Scene, *, close: bool = False) -> None:
        self.size, self._close = scene.size, close
        spacing = (_CLOSE_SPACING if close else _SPACING) * self.size
        self._points = _points(*scene.body, spacing) - scene.middle
        self._others = _points(*scene.rest, spacing)
        body = scene.body[0] - scene.middle, scene.body[1]
        self._own = _field(body, _CELL * self.size)
        self._around = _field(scene.rest, _CELL * self.size)
        self._seen: tuple[Ints, Ints] = (np.arange(0), np.arange(0))
        self._from: Stance | None = None
        self._reach = float(np.linalg.norm(self._points, axis=1).max())

    def gap(self, pose: Stance) -> float:
        """Smallest distance, in mm: about; at most `_SIGHT`."""
        values, others = self._values(pose)[:2]
        return float(min(values.min(initial=self._far), others.min(initial=self._far)))

    def rows(self, pose: Stance, gap: float) -> tuple[Floats, Floats]:
        """What the walls demand of a step.

        Parameters
        ----------
        pose
            Where the body is.
        gap
            Distance to keep, in mm.

        Returns
        -------
        rows, least
            ``(k, 6)`` and ``(k,) float``: rows @ step >= least.
        """
        rows, gaps = self.near(pose)
        return rows, np.minimum(gap - gaps, _RECEDE * self.size)

    def near(self, pose: Stance) -> tuple[Floats, Floats]:
        """Near points: how fast each recedes under a step, and its distance.

        Parameters
        ----------
        pose
            Where the body is.

        Returns
        -------
        rows, gaps
            ``(k, 6)`` and ``(k,) float``, mm: after a step they are gaps + rows @ step.
        """
        values, others, points, back = self._values(pose)
        near, close = values < self._band, others < self._band
        points, back = points[near], back[close]
        gaps, normals = self._felt(self._around, points, values[near])
        back_gaps, back_normals = self._felt(self._own, back, others[close])
        arms = np.concatenate([points - pose.centre, back @ pose.turn.T])
        normals = np.concatenate([normals, -back_normals @ pose.turn.T])
        rows = np.concatenate([normals, np.cross(arms, normals) / self.size], axis=1)
        return rows, np.concatenate([gaps, back_gaps])

    def _felt(self, field: Field, points: Floats, values: Floats) -> tuple[Floats, Floats]:
        """Distances of near points from a solid, and the unit vectors away from it."""
        return field.exact(points) if self._close else (values, field.normal(points))

    @property
    def _band(self) -> float:
        return _BAND * self.size

    @property
    def _far(self) -> float:
        return _SIGHT * self.size / 2

    def _values(self, pose: Stance) -> tuple[Floats, Floats, Floats, Floats]:
        """Distances of the body's and the others' points in sight, and the points themselves.

        The body's are given in space, the others' as the body sees them.
        """
        if self._from is None or self._moved(pose) > self._far:
            points, back = self._placed(pose, slice(None), slice(None))
            sight = _SIGHT * self.size
            self._seen = (
                np.flatnonzero(self._around.value(points) < sight),
                np.flatnonzero(self._own.value(back) < sight),
            )
            self._from = pose
        points, back = self._placed(pose, *self._seen)
        return self._around.value(points), self._own.value(back), points, back

    def _placed(
        self, pose: Stance, own: Ints | slice, others: Ints | slice
    ) -> tuple[Floats, Floats]:
        points = self._points[own] @ pose.turn.T + pose.centre
        return points, (self._others[others] - pose.centre) @ pose.turn

    def _moved(self, pose: Stance) -> float:
        """How far any point has moved at most since those in sight were chosen."""
        if self._from is None:
            return np.inf
        turn = np.linalg.norm(pose.turn - self._from.turn) / np.sqrt(2)
        return float(np.linalg.norm(pose.centre - self._from.centre) + turn * self._reach)


def nearest(wanted: Floats, rows: Floats, least: Floats, size: float) -> Floats:
    """The step nearest to a wanted one that the walls allow.

    Parameters
    ----------
    wanted
        ``(6,) float``: a translation, and a rotation times `size`.
    rows, least
        ``(k, 6)`` and ``(k,) float``: rows @ step >= least is to hold.
    size
        Of the body, in mm.

    Returns
    -------
    step
        ``(6,) float``; zero where nothing is allowed.
    """
    step, chosen = wanted, np.arange(0)
    for _ in range(_ROUNDS):
        short = least - rows @ step
        short[chosen] = 0
        violated = np.flatnonzero(short > _VIOLATED * size)
        if not len(violated):
            break
        worst = violated[np.argsort(-short[violated], kind="stable")[:_ADD]]
        chosen = np.concatenate([chosen, worst])
        lack = (least - rows @ wanted)[chosen]
        found = _shortest(rows[chosen], lack)
        if found is None:  # walls on both sides are too near: stay as near as now
            found = _shortest(rows[chosen], np.minimum(least, 0)[chosen] - rows[chosen] @ wanted)
        if found is None:
            return np.zeros(6)
        step = wanted + found
    return step


def widest(rows: Floats, gaps: Floats, most: float) -> float:
    """The largest smallest gap that a step may make, in mm.

    Parameters
    ----------
    rows, gaps
        As `Walls.near` tells them; at least one.
    most
        How far each of the step's six entries may go, in mm.
    """
    found = linprog(
        [0.0] * 6 + [-1.0],
        A_ub=np.column_stack([-rows, np.ones(len(rows))]),
        b_ub=gaps,
        bounds=[(-most, most)] * 6 + [(None, None)],
    )
    return float(gaps.min() if found.x is None else found.x[6])


def _shortest(rows: Floats, least: Floats) -> Floats | None:
    """The shortest x with rows @ x >= least, by its dual."""
    scale = float(least.max(initial=0.0))
    if not scale > 0:
        return np.zeros(6)
    system = np.vstack([rows.T, least / scale])
    try:
        forces, _ = nnls(system, np.append(np.zeros(6), 1.0))
    except RuntimeError:  # it does not settle
        return None
    residual = system @ forces - np.append(np.zeros(6), 1.0)
    if -residual[6] < _SOLVABLE:
        return None
    return np.asarray(-residual[:6] / residual[6] * scale)


def _field(mesh: Mesh, cell: float) -> Field:
    """A mesh's field, its cells as fine as wanted or as its box allows."""
    box = np.ptp(mesh[0], axis=0)
    return Field(*mesh, max(cell, float((box.prod() / _NODES) ** (1 / 3))))


def _points(points: Floats, triangles: Ints, spacing: float) -> Floats:
    """Where a solid can touch another one first: its vertices, and all along its ridges."""
    tail, head = triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)
    apex = np.roll(triangles, -2, axis=1).reshape(-1)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    # Half edges in the order of their edge, there and back.
    there = np.lexsort((head, tail))
    back = np.lexsort((tail, head))
    arm = points[apex[back]] - points[tail[there]]
    under = -(arm * np.repeat(normals, 3, axis=0)[there]).sum(axis=1)
    ridge = (under > _FLAT * np.linalg.norm(arm, axis=1)) & (tail < head)[there]
    a, b = points[tail[there[ridge]]], points[head[there[ridge]]]
    count = np.ceil(np.linalg.norm(b - a, axis=1) / spacing).astype(np.int64)
    which = np.repeat(np.arange(len(count)), count - 1)
    number = np.arange(len(which)) - np.repeat(np.cumsum(count - 1) - count + 1, count - 1) + 1
    between = a[which] + (number / count[which])[:, None] * (b - a)[which]
    return np.concatenate([points[np.unique(triangles)], between])
