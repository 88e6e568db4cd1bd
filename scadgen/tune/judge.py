"""What a weave is worth: a quick look at its figures, and the whole proof."""

from __future__ import annotations

from dataclasses import dataclass

from scadgen.check.locking import connectors_lock, largest_play
from scadgen.check.proof import proved
from scadgen.errors import InputError, ScadgenError
from scadgen.frame.placement import KEYS
from scadgen.joint.weave import Weave
from scadgen.kit.build import build_joint
from scadgen.kit.model import Kit

__all__ = ["MOST_EDGES", "Figures", "Wish", "figures", "proof"]

#: Edges at a joint at most.
MOST_EDGES = 12

#: Clearance that pieces have to leave room for, in sides: 0.42 mm at side 10 mm.
_ROOM = 0.042


@dataclass(frozen=True, slots=True)
class Wish:
    """What a weave is wanted for.

    Parameters
    ----------
    valence
        Number of edges at the joint, at least 2.
    key
        One of `KEYS`.
    arm
        Thinnest section that the connectors' arms may have, in sides.

    Raises
    ------
    InputError
        There is no such joint.
    """

    valence: int
    key: str
    arm: float

    def __post_init__(self) -> None:
        """Refuse what no joint can be."""
        if not 2 <= self.valence <= MOST_EDGES:
            msg = f"valence = {self.valence}: must be a whole number from 2 to {MOST_EDGES}"
            raise InputError(msg)
        if self.key not in KEYS:
            msg = f"key = {self.key!r}: must be one of {', '.join(KEYS)}"
            raise InputError(msg)
        if not 0 <= self.arm < 1:
            msg = f"arm = {self.arm:g} sides: must be from 0 to 1"
            raise InputError(msg)


@dataclass(frozen=True, slots=True)
class Figures:
    """What was found of a weave.

    Parameters
    ----------
    play
        Of a tube's tip, in mm a mm.
    arm
        Thinnest section of the connectors' arms, in sides.
    refused
        Why the weave is no good; then the others are 0.
    """

    play: float = 0.0
    arm: float = 0.0
    refused: str = ""

    def beats(self, other: Figures) -> bool:
        """Whether it is no looser and no thinner, and not the same."""
        better = self.play <= other.play and self.arm >= other.arm
        return better and (self.play, self.arm) != (other.play, other.arm)


def figures(wish: Wish, weave: Weave) -> Figures:
    """Look at a weave quickly: its figures if whole connectors lock, at detail `draft`."""
    try:
        kit = build_joint(wish.valence, weave, wish.key, "draft")
        return (
            _measured(wish, kit)
            if connectors_lock(kit, kit.joints[0]).good
            else Figures(refused="loose")
        )
    except ScadgenError as error:
        return Figures(refused=str(error))


def proof(wish: Wish, weave: Weave) -> Figures:
    """Prove all that a kit promises, at detail `standard`, and measure there."""
    try:
        kit = build_joint(wish.valence, weave, wish.key, "standard")
        found = _measured(wish, kit)
        if not found.refused:
            proved(kit)
    except ScadgenError as error:
        return Figures(refused=str(error))
    return found


def _measured(wish: Wish, kit: Kit) -> Figures:
    (joint,) = kit.joints
    arm, room = joint.figures["thinnest_arm_sides"], joint.figures["clearance_limit_sides"]
    if arm < wish.arm:
        return Figures(refused=f"arms of {arm:.2f} sides")
    if room < _ROOM:
        return Figures(refused=f"room for a clearance of {room:g} sides only")
    return Figures(round(largest_play(kit, joint), 3), round(arm, 4))
