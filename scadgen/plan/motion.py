"""How something goes in, as a person sees it: from above or below, or along the frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scadgen.plan.model import Move, Plan
from scadgen.solid.affine import Floats

__all__ = ["Arrival", "joints_of", "motion_of", "towards"]

#: The last of a way in, and a rise that counts, in sides.
_LAST, _RISE = 0.5, 0.5

#: How many times farther along the frame than across it something goes that goes along it.
_FLAT = 1.5

#: Step with which a way is looked at, in sides.
_STEP = 0.05

#: Turning from which on a part goes in tilted, in degrees.
_TILT = 20.0


@dataclass(frozen=True, slots=True)
class Arrival:
    """How something goes in.

    Parameters
    ----------
    above
        1 if it comes from above, -1 from below, 0 if it stays in the frame's plane.
    towards
        Direction in which it goes along the frame at last, in degrees; None if it does not.
    tilted
        Whether it is tilted on its way.
    """

    above: int
    towards: float | None
    tilted: bool

    @property
    def slides(self) -> bool:
        """Whether it stays in the frame's plane."""
        return not self.above


def motion_of(plan: Plan, move: Move) -> Arrival:
    """How a move goes in: its way out, backwards.

    Parameters
    ----------
    plan
        The plan.
    move
        One of its moves.
    """
    way, side = plan.ways[move.way], plan.standing.kit.values["side"]
    poses = way.dense(0.0, _STEP * side)
    gone = poses[:, :3, :3] @ way.middle + poses[:, :3, 3] - way.middle
    far = np.linalg.norm(gone, axis=1)
    x, y, z = gone[int(np.argmax(far >= _LAST * side))] if far.max() >= _LAST * side else gone[-1]
    flat = np.hypot(x, y) > _FLAT * abs(z)
    rise = float(move.origin.turn(gone[-1])[2])
    spin = np.linalg.norm(way.steps()[:, 3:], axis=1).max()
    return Arrival(
        above=int(np.sign(rise)) if abs(rise) >= _RISE * side else 0,
        towards=_seen_from_above(move.origin.turn([-x, -y, 0.0])) if flat else None,
        tilted=bool(np.degrees(spin) >= _TILT),
    )


def _seen_from_above(way: Floats) -> float:
    """A direction as an angle, in degrees."""
    return float(np.degrees(np.arctan2(way[1], way[0]))) % 360


def joints_of(plan: Plan, number: int, move: Move) -> list[int]:
    """Joints at which a move goes in: of what slides in all at which it meets what is there.

    Parameters
    ----------
    plan
        The plan.
    number
        The step's number, from 1.
    move
        One of its moves.
    """
    if motion_of(plan, move).slides:
        return plan.standing.meeting(move.parts, plan.onto(number, move))
    return [move.joint]


def towards(degrees: float) -> str:
    """A direction in the plane in words, as it is seen from above."""
    sides = ("right", "top", "left", "bottom")
    quarter = round(degrees / 90) % 4
    near = abs((degrees - 90 * quarter + 180) % 360 - 180) < 1
    return f"towards the {sides[quarter]}" if near else f"towards {degrees % 360:.0f}°"
