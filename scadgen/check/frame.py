"""Whether a frame can be built: the rings of its joints, and room for them on its edges."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scadgen.frame.graph import Frame
from scadgen.frame.joints import least_gap, least_scale, ring_ratios, tube_start
from scadgen.frame.planarity import where
from scadgen.frame.sameness import Sameness, joint_name
from scadgen.joint.weave import BUILT_IN, LIMITS
from scadgen.solid.affine import Floats

__all__ = ["Build", "rings"]

#: Shortest tube between two joints, in sides; as in a kit.
_TUBE = 0.5

#: An edge is too short if more than this is missing, in mm: rounding, far below a vertex's.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Build:
    """A frame with a ring for each kind of joint; clearance is not counted.

    Parameters
    ----------
    frame
        The frame.
    same
        Its kinds.
    least, rings
        Of each kind of joint, ``(k,) float``: the ring ratio at which its tubes touch, and
        the one that it is built with.
    most
        Largest ring ratio that it may be built with.
    """

    frame: Frame
    same: Sameness
    least: Floats
    rings: Floats
    most: float

    @cached_property
    def unfit(self) -> tuple[str, ...]:
        """Kinds of joints that cannot be made, whatever the side, a line each."""
        return tuple(self._unfit())

    @cached_property
    def largest_side(self) -> float | None:
        """Largest side with which all edges are long enough, in mm; None with unfit joints."""
        ring = self.rings[self.same.joint_of]
        return None if self.unfit else 1 / least_scale(self.frame, 1.0, ring, _TUBE)

    def missing(self, side: float) -> Floats:
        """What each edge is too short by at this side: ``(m,) float``, at least 0, in mm."""
        start = tube_start(self.rings[self.same.joint_of])[self.frame.edges].sum(axis=1)
        missing = side * (start + _TUBE) - self.frame.lengths
        return np.where(missing > _ROUNDING, missing, 0.0)

    def too_short(self, side: float) -> Iterator[str]:
        """Kinds of edges that are too short at this side, a line each, the worst first."""
        missing = self.missing(side)
        worst = np.array([missing[edge.edges].max() for edge in self.same.edges])
        for kind in np.argsort(-worst, kind="stable")[: np.count_nonzero(worst)]:
            edges = self.same.edges[kind].edges
            at = edges[missing[edges].argmax()]
            first, second = (where(self.frame.vertices[v]) for v in self.frame.edges[at])
            yield (
                f"edge {kind + 1}: {self.frame.lengths[at]:.4g} mm is {worst[kind]:.4g} mm too "
                f"short for its two joints, from {first} to {second}"
                f"{_more(int(np.count_nonzero(missing[edges])))}"
            )

    def _unfit(self) -> Iterator[str]:
        for kind, (joint, least) in enumerate(zip(self.same.joints, self.least, strict=True)):
            if len(joint.directions) > 1 and least < self.most:
                continue
            narrowest = min(joint.vertices, key=lambda v: self.frame.gaps(v).min())
            at = where(self.frame.vertices[narrowest]) + _more(len(joint.vertices))
            if len(joint.directions) < 2:
                yield f"joint {joint_name(kind)}: has one edge, at {at}; a joint needs two"
            else:
                gap = float(self.frame.gaps(narrowest).min())
                yield (
                    f"joint {joint_name(kind)}: edges {math.degrees(gap):.4g} degrees apart, at "
                    f"{at}, need a ring ratio over {least:.4g}; at most {self.most:g} works, for "
                    f"{math.degrees(least_gap(self.most)):.4g} degrees and more"
                )


def rings(frame: Frame, same: Sameness, ring_ratio: float | None = None) -> Build:
    """Give each kind of joint a ring.

    Parameters
    ----------
    frame
        The frame.
    same
        Its kinds.
    ring_ratio
        Of all joints; without one each has that of the built-in weave for its number of
        edges, or as much more as its angles need.
    """
    need = ring_ratios(frame)
    least = np.array([need[joint.vertices].max() for joint in same.joints])
    if ring_ratio is not None:
        return Build(frame, same, least, np.full(len(least), ring_ratio), ring_ratio)
    known = [int(name.removesuffix("-fixed")) for name in BUILT_IN if name.endswith("-fixed")]
    counts = np.clip([len(joint.directions) for joint in same.joints], min(known), max(known))
    usual = np.array([BUILT_IN[f"{count}-fixed"].ring_ratio for count in counts])
    most = LIMITS["ring_ratio"][1]
    return Build(frame, same, least, np.minimum(np.maximum(least, usual), most), most)


def _more(count: int) -> str:
    return f" (and {count - 1} more)" if count > 1 else ""
