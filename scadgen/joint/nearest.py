"""Nearest points of many small polyhedra at once.

Each is a least-distance program in space: the shortest x with A x >= b.  The dual method
(D. Goldfarb and A. Idnani, A numerically stable dual method for solving strictly convex quadratic
programs, 1983) starts at zero and takes in what is violated most, one row after the other; no
more than three rows limit a point.  All programs take their steps together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scadgen.solid.affine import Floats, Ints

__all__ = ["nearest_points"]

#: How exactly rows are met.
_EXACT = 1e-12

#: Squared size of what is left of a row across those that limit a point already, below which it
#: depends on them.
_DEPENDENT = 1e-12

#: Steps after which a program counts as one without a solution.
_MOST = 100


def nearest_points(rows: Floats, need: Floats) -> tuple[Ints, NDArray[np.bool_]]:
    """What limits the shortest x with rows . x >= need, of each program.

    Parameters
    ----------
    rows
        ``(k, w, 3) float``: unit vectors and shorter ones; zeros fill up.
    need
        ``(k, w) float``; what fills up needs no more than zero.

    Returns
    -------
    limiting
        ``(k, 3) int``: the rows that limit each point, -1 where there are fewer than three.
    found
        ``(k,) bool``: whether there is one.
    """
    steps = _Steps(rows, need)
    for _ in range(_MOST):
        if not len(steps.going):
            break
        steps.take()
    return steps.limiting, steps.found


class _Steps:
    """The programs between two steps.

    `going` are the numbers of those that go on; all else is by number.  `wanted` is the row that
    each is taking in, -1 if it has none.
    """

    def __init__(self, rows: Floats, need: Floats) -> None:
        count = len(rows)
        # A last row asks for nothing: number -1.
        self._rows = np.concatenate([rows, np.zeros((count, 1, 3))], axis=1)
        self._need = np.concatenate([need, np.zeros((count, 1))], axis=1)
        self.limiting = np.full((count, 3), -1)
        self.found = np.zeros(count, dtype=np.bool_)
        self.going = np.arange(count)
        self._x, self._weights = np.zeros((count, 3)), np.zeros((count, 3))
        self._wanted, self._own = np.full(count, -1), np.zeros(count)

    def take(self) -> None:
        """Take one step in each program that goes on."""
        self._choose()
        now = self.going
        wanted, limiting = self._wanted[now], self.limiting[now]
        row = self._rows[now, wanted]
        across, share = _across(self._rows[now[:, None], limiting], row)
        size = np.einsum("ij,ij->i", across, across)
        short = self._need[now, wanted] - np.einsum("ij,ij->i", row, self._x[now])
        free = size > _DEPENDENT
        full = np.where(free, short / np.where(free, size, 1.0), np.inf)
        eased = (limiting >= 0) & (share > _EXACT)
        ratio = np.where(eased, self._weights[now] / np.where(eased, share, 1.0), np.inf)
        place = ratio.argmin(axis=1)
        partial = ratio[np.arange(len(now)), place]
        step = np.minimum(full, partial)
        ends = np.isinf(step)
        step = np.where(ends, 0.0, step)[:, None]
        self._x[now] += np.where(free[:, None], step * across, 0.0)
        self._weights[now] -= step * share
        self._own[now] += step[:, 0]
        self._settle(now, place, full <= partial)
        self.going = now[~ends]

    def _choose(self) -> None:
        """Choose what is violated most where no row is being taken in; end where none is."""
        idle = self.going[self._wanted[self.going] < 0]
        short = self._need[idle] - np.einsum("kwi,ki->kw", self._rows[idle], self._x[idle])
        worst = short.argmax(axis=1)
        done = short[np.arange(len(idle)), worst] <= _EXACT
        self.found[idle[done]] = True
        self._wanted[idle], self._own[idle] = np.where(done, -1, worst), 0.0
        self.going = self.going[~self.found[self.going]]

    def _settle(self, now: Ints, place: Ints, whole: NDArray[np.bool_]) -> None:
        """After a whole step a row limits the point; after a partial one another does no more."""
        left, at = now[~whole], place[~whole]
        self.limiting[left, at], self._weights[left, at] = -1, 0.0
        taken = now[whole]
        free = (self.limiting[taken] < 0).argmax(axis=1)
        self.limiting[taken, free] = self._wanted[taken]
        self._weights[taken, free] = self._own[taken]
        self._wanted[taken] = -1


def _across(rows: Floats, vector: Floats) -> tuple[Floats, Floats]:
    """What is left of vectors across some rows, and how much of each row they hold.

    Rows are independent but for zeros, which fill up.
    """
    fill = np.where(rows.any(axis=2), 0.0, 1.0)
    products = rows @ rows.swapaxes(1, 2) + fill[:, None] * np.eye(3)
    along = np.einsum("kij,kj->ki", rows, vector)
    share = np.asarray(np.linalg.solve(products, along[..., None])[..., 0], dtype=np.float64)
    return vector - np.einsum("kij,ki->kj", rows, share), share
