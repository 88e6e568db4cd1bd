"""How loose an assembly is: how far a point of a part can move per unit of gap.

With a gap g at every contact the parts may close it: A x >= -g.  The farthest that a point of
a part then moves in a direction is a linear program.  To first order it is proportional to g.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from scadgen.interlock.assembly import Assembly, extreme_rows
from scadgen.interlock.contacts import Mesh
from scadgen.interlock.path import united
from scadgen.interlock.program import Farthest
from scadgen.solid.affine import Floats, Ints

__all__ = ["Loosest", "loosest", "measured"]

#: Directions in which a point may go: along the axes, both ways.
_DIRECTIONS = np.vstack([np.eye(3), -np.eye(3)])

#: Rows to add at most in a round, for each unknown.
_ADD = 5

#: How far a row may be violated, in gaps.
_TOLERANCE = 1e-6

#: Share of a motion up to which it is followed, and how finely its end is found.
_MOST, _FINE = 2.0, 2e-3

#: Shared volume, in cubes of the gap, that is rounding.
_NONE = 1e-6


class Loosest(NamedTuple):
    """The farthest that a point moves, per unit of gap.

    Parameters
    ----------
    travel
        How far; infinite where a part is free to go.
    steps
        ``(parts, 6) float``: each part's translation and rotation vector about its middle;
        zeros where the travel is infinite.
    tip
        Whose point it is and where it goes: the part, and the number of the direction.
    """

    travel: float
    steps: Floats
    tip: tuple[int, int]


def loosest(
    assembly: Assembly, points: Floats, tips: Iterable[tuple[int, int]] | None = None
) -> Loosest:
    """Farthest that a point of any free part moves along an axis, per unit of gap, and how.

    Parameters
    ----------
    assembly
        The assembly; it should be locked.
    points
        ``(parts, 3) float``: a point that moves with each part.
    tips
        Parts and numbers of directions among which it is sought; by default all.

    Raises
    ------
    ToolError
        The solver gives no answer: its status.
    """
    none = np.zeros((len(assembly.middles), 6))
    best = Loosest(0.0, none, (assembly.free[0], 0))
    plays = _Plays(assembly)
    for part, number in tips or itertools.product(assembly.free, range(len(_DIRECTIONS))):
        goal = _goal(assembly, part, points[part], _DIRECTIONS[number])
        x = plays.farthest(goal)
        if x is None:
            return Loosest(np.inf, none, (part, number))
        if goal @ x > best.travel:
            steps = none.copy()
            steps[list(assembly.free)] = x.reshape(-1, 6)
            steps[:, 3:] /= assembly.sizes[:, None]
            best = Loosest(float(goal @ x), steps, (part, number))
    return best


def _goal(assembly: Assembly, part: int, point: Floats, direction: Floats) -> Floats:
    """How fast a point of a part moves in a direction, by the assembly's unknowns."""
    arm = (point - assembly.middles[part]) / assembly.sizes[part]
    first = 6 * assembly.free.index(part)
    goal = np.zeros(assembly.rows.shape[1])
    goal[first : first + 6] = [*direction, *np.cross(arm, direction)]
    return goal


def measured(meshes: Sequence[Mesh], middles: Floats, steps: Floats, gap: float) -> float:
    """How far parts that have a gap really go along a motion before two of them overlap.

    Parameters
    ----------
    meshes
        The parts as they are with that gap.
    middles
        ``(parts, 3) float``: what they turn about.
    steps
        ``(parts, 6) float``: a motion per unit of gap, as `loosest` gives it.
    gap
        The gap, in mm.

    Returns
    -------
    share
        Of the motion for that gap: 1 where the first order tells all; at most `_MOST`.
    """
    solids = [united([mesh]) for mesh in meshes]
    low, high = 0.0, _MOST
    while high - low > _FINE:
        share = (low + high) / 2
        moved = [
            solid.transform(_pose(middle, share * gap * step))
            for solid, middle, step in zip(solids, middles, steps, strict=True)
        ]
        pairs = itertools.combinations(moved, 2)
        clear = all((a ^ b).volume() <= _NONE * gap**3 for a, b in pairs)
        low, high = (share, high) if clear else (low, share)
    return low


def _pose(middle: Floats, step: Floats) -> Floats:
    """The pose after a translation and a rotation about a point, ``(3, 4)``."""
    turn = Rotation.from_rotvec(step[3:]).as_matrix()
    return np.column_stack([turn, middle + step[:3] - turn @ middle])


class _Plays:
    """The x with A x >= -1 that a goal . x is largest for, for one goal after the other.

    Few rows are taken to begin with; others where a motion violates them.
    """

    def __init__(self, assembly: Assembly) -> None:
        self._rows = assembly.rows
        self._left = np.ones(self._rows.shape[0], dtype=np.bool_)
        chosen = extreme_rows(assembly)
        self._left[chosen] = False
        self._program = Farthest(self._rows[chosen])

    def farthest(self, goal: Floats) -> Floats | None:
        """The motion; None where it has no end."""
        self._program.aim(goal)
        while True:
            x = self._program.solve()
            if x is None:
                missing = np.flatnonzero(self._left)
                if not len(missing):
                    return None
                taken = len(self._left) - len(missing)
                self._add(missing[:: max(1, len(missing) // max(taken, 1))])
                continue
            separation = self._rows @ x
            violated = np.flatnonzero((separation < -1 - _TOLERANCE) & self._left)
            if not len(violated):
                return x
            worst = violated[np.argsort(separation[violated], kind="stable")]
            self._add(worst[: _ADD * len(goal)])

    def _add(self, rows: Ints) -> None:
        self._left[rows] = False
        self._program.add(self._rows[rows])
