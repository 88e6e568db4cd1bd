"""The template of a joint: where its connectors point, caps' included."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from scadgen.frame.joint_classes import JointClass
from scadgen.joint.symmetry import Symmetry
from scadgen.solid.affine import Floats

__all__ = ["Template"]


@dataclass(frozen=True, slots=True, eq=False)
class Template:
    """Where a joint has connectors.

    Parameters
    ----------
    directions
        ``(k,) float``: ascending from 0, in radians, caps' included.
    slopes
        ``(k,) float``: how far each points below the plane of its ring, in radians.
    symmetry
        Which of them are alike.
    """

    directions: Floats
    slopes: Floats
    symmetry: Symmetry

    @classmethod
    def of(cls, joint: JointClass) -> Self:
        """That of a class; a lone end gets two caps, a third of a turn from it."""
        if len(joint.directions) > 1:
            return cls(joint.directions, joint.slopes, joint.symmetry)
        level = joint.symmetry.mirror is not None
        directions = np.array([0.0, 2 * np.pi / 3, 4 * np.pi / 3])
        symmetry = Symmetry(3, 1, 0) if level else Symmetry(3, 3, None)
        return cls(directions, np.append(joint.slopes, [0.0, 0.0]), symmetry)

    @classmethod
    def level(cls, directions: Floats, symmetry: Symmetry) -> Self:
        """One in the plane of its ring."""
        return cls(directions, np.zeros_like(directions), symmetry)

    @property
    def gaps(self) -> Floats:
        """``(k,) float``: angle from each direction to the next."""
        return np.diff(np.append(self.directions, 2 * np.pi))

    def turned_over(self) -> Template:
        """The same turned over: slot s where ``-s`` was, up what was down."""
        back = -np.arange(len(self.directions)) % len(self.directions)
        directions = -self.directions[back] % (2 * np.pi)
        return Template(directions, -self.slopes[back] + 0.0, self.symmetry.turned_over())
