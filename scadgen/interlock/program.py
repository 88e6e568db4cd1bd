"""Linear programs over motions, put to HiGHS; what it does not answer is an error."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csr_array

from scadgen.errors import ToolError
from scadgen.solid.affine import Floats

__all__ = ["Solution", "farthest"]

#: Unknowns above which the interior point method is faster than the simplex method.
_MANY = 1200

#: HiGHS's statuses.
_SOLVED, _UNBOUNDED = 0, 3


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
