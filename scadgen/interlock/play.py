"""How loose an assembly is: how far a point of a part can move per unit of gap.

With a gap g at every contact the parts may close it: A x >= -g.  The farthest that a point of
a part then moves in a direction is a linear program.  To first order it is proportional to g.
"""

from __future__ import annotations

import numpy as np

from scadgen.errors import InputError
from scadgen.interlock.assembly import Assembly, extreme_rows
from scadgen.interlock.program import farthest
from scadgen.solid.affine import Floats, Ints

__all__ = ["play"]

#: Rows to add at most in a round, for each unknown.
_ADD = 5

#: How far a row may be violated, in gaps.
_TOLERANCE = 1e-6


def play(assembly: Assembly, part: int, point: Floats) -> Floats:
    """Farthest a point of a part moves along each axis, per unit of gap.

    Parameters
    ----------
    assembly
        The assembly; it should be locked.
    part
        Number of a free part.
    point
        ``(3,) float``: a point that moves with the part.

    Returns
    -------
    travel
        ``(2, 3) float``: along -x, -y, -z and along +x, +y, +z; infinite where the part is
        free to go.

    Raises
    ------
    InputError
        The part is held, or there is none of that number.
    ToolError
        The solver gives no answer: its status.
    """
    if part not in assembly.free:
        msg = f"part = {part}: must be one that is not held: {list(assembly.free)}"
        raise InputError(msg)
    arm = (point - assembly.middles[part]) / assembly.sizes[part]
    first = 6 * assembly.free.index(part)
    travel = np.empty((2, 3))
    chosen = extreme_rows(assembly)
    for axis in range(3):
        for side in range(2):
            direction = (2 * side - 1) * np.eye(3)[axis]
            goal = np.zeros(assembly.rows.shape[1])
            goal[first : first + 6] = [*direction, *np.cross(arm, direction)]
            travel[side, axis], chosen = _farthest(assembly, goal, chosen)
    return travel


def _farthest(assembly: Assembly, goal: Floats, chosen: Ints) -> tuple[float, Ints]:
    """The largest goal . x with A x >= -1, and the rows that it took."""
    count = assembly.rows.shape[0]
    while True:
        found = farthest(goal, assembly.rows[chosen], 1.0, np.inf)
        if found is None:
            missing = np.setdiff1d(np.arange(count), chosen)
            if not len(missing):
                return np.inf, chosen
            chosen = np.union1d(chosen, missing[:: max(1, len(missing) // max(len(chosen), 1))])
            continue
        separation = assembly.rows @ found.x
        violated = np.flatnonzero(separation < -1 - _TOLERANCE)
        if not len(violated):
            return float(goal @ found.x), chosen
        worst = violated[np.argsort(separation[violated], kind="stable")][: _ADD * len(goal)]
        chosen = np.union1d(chosen, worst)
