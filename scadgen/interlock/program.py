"""Linear programs over motions, put to HiGHS; what it does not answer is an error."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csr_array

from scadgen.errors import ToolError
from scadgen.solid.affine import Floats

__all__ = ["Farthest", "Solution", "farthest"]

#: Unknowns above which the interior point method is faster than the simplex method.
_MANY = 1200

#: HiGHS's statuses.
_SOLVED, _UNBOUNDED = 0, 3

#: HiGHS's numbers of the dual and the primal simplex method.
_DUAL, _PRIMAL = 1, 4


@dataclass(frozen=True, slots=True, eq=False)
class Solution:
    """What a linear program found.

    Parameters
    ----------
    x
        ``(n,) float``: the best motion.
    prices
        ``(k,) float``: how much a unit more of gap at each contact gains, at least 0.
    """

    x: Floats
    prices: Floats


def farthest(goal: Floats, rows: csr_array, gap: float, bound: float) -> Solution | None:
    """Maximise goal . x with rows x >= -gap and |x| <= bound.

    Parameters
    ----------
    goal
        ``(n,) float``.
    rows
        ``(k, n)``.
    gap
        How far parts may close in on each other at each contact.
    bound
        How far each unknown may go; may be infinite.

    Returns
    -------
    solution
        None where nothing bounds the motion.

    Raises
    ------
    ToolError
        The solver gives no answer: its status.
    """
    if not (np.isfinite(rows.data).all() and np.isfinite(goal).all()):
        msg = "the solver gives no answer: the contacts' coordinates are not finite numbers"
        raise ToolError(msg)
    method: Literal["highs-ipm", "highs-ds"] = "highs-ipm" if rows.shape[1] > _MANY else "highs-ds"
    found = linprog(  # type: ignore[call-overload]  # the stubs know no sparse A_ub
        -goal,
        A_ub=-rows,
        b_ub=np.full(rows.shape[0], gap),
        bounds=(-bound, bound),
        method=method,
    )
    if found.status == _UNBOUNDED and np.isinf(bound):
        return None
    if found.status != _SOLVED:
        text = " ".join(str(found.message).split())
        msg = f"the solver gives no answer: status {found.status}, {text}"
        raise ToolError(msg)
    return Solution(found.x, np.maximum(-found.ineqlin.marginals, 0.0))


class Farthest:
    """Programs that differ in their goals alone: maximise goal . x with rows x >= -1.

    Each starts from the basis where the one before ended, so that few steps are left: those of
    the primal simplex method after another goal, of the dual one after more rows.

    Parameters
    ----------
    rows
        ``(k, n)``: those to begin with.
    """

    def __init__(self, rows: csr_array) -> None:
        import highspy  # slow to import

        if not np.isfinite(rows.data).all():
            msg = "the solver gives no answer: the contacts' coordinates are not finite numbers"
            raise ToolError(msg)
        self._unknowns = rows.shape[1]
        self._status = highspy.HighsModelStatus
        self._solver = highspy.Highs()
        for name, value in (("output_flag", False), ("threads", 1), ("presolve", "off")):
            self._solver.setOptionValue(name, value)
        free = np.full(self._unknowns, np.inf)
        self._solver.addVars(self._unknowns, -free, free)
        self._solver.changeObjectiveSense(highspy.ObjSense.kMaximize)
        self.add(rows)

    def add(self, rows: csr_array) -> None:
        """Add rows, ``(k, n)``."""
        count = rows.shape[0]
        least, most = np.full(count, -1.0), np.full(count, np.inf)
        starts, which = rows.indptr[:-1].astype(np.int32), rows.indices.astype(np.int32)
        self._solver.addRows(count, least, most, rows.nnz, starts, which, rows.data)
        self._solver.setOptionValue("simplex_strategy", _DUAL)

    def aim(self, goal: Floats) -> None:
        """Take another goal, ``(n,) float``."""
        self._solver.changeColsCost(
            self._unknowns, np.arange(self._unknowns, dtype=np.int32), np.asarray(goal, dtype=float)
        )
        self._solver.setOptionValue("simplex_strategy", _PRIMAL)

    def solve(self) -> Floats | None:
        """The best motion, ``(n,) float``; None where nothing bounds it.

        Raises
        ------
        ToolError
            The solver gives no answer: its status.
        """
        self._solver.run()
        status = self._solver.getModelStatus()
        # No motion at all meets every row, so that none of these means that there is none.
        if status in (self._status.kUnbounded, self._status.kUnboundedOrInfeasible):
            return None
        if status != self._status.kOptimal:
            text = self._solver.modelStatusToString(status)
            msg = f"the solver gives no answer: {text}"
            raise ToolError(msg)
        return np.array(self._solver.getSolution().col_value)
