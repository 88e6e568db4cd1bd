"""Whether a frame can be built: the rings of its joints, and room for them on its edges."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scadgen.errors import InputError
from scadgen.frame.classes import Classes, joint_name
from scadgen.frame.graph import Frame
from scadgen.frame.joints import least_gap, least_ring_ratio, tube_start
from scadgen.frame.kinds import choose_kinds
from scadgen.frame.words import more
from scadgen.joint.weave import LIMITS, any_joint
from scadgen.kit.room import Room, reaches, room
from scadgen.solid.affine import Floats

__all__ = ["Build", "rings"]

#: Angles as near as this are the same, in radians: rounding.
_SAME = 1e-9


@dataclass(frozen=True, eq=False)
class Build:
    """A frame with a ring for each kind of joint.

    Parameters
    ----------
    frame
        The frame.
    same
        Its kinds.
    least, rings
        Of each kind of joint, ``(k,) float``: the ring ratio at which its tubes touch, and
        the one that it is built with.
    refused
        Of each kind of joint, why it cannot be made; None for one that can, or that is made
        like another.
    room
        What joints need of the edges.
    """

    frame: Frame
    same: Classes
    least: Floats
    rings: Floats
    refused: tuple[str | None, ...]
    room: Room

    @cached_property
    def unfit(self) -> tuple[str, ...]:
        """Kinds of joints that cannot be made, whatever the side, a line each."""
        return tuple(
            f"joint {joint_name(kind)}, {self._place(kind)}: {reason}"
            for kind, reason in enumerate(self.refused)
            if reason
        )

    @cached_property
    def largest_side(self) -> float | None:
        """Largest side with which there is room, in mm; None with unfit joints."""
        return None if self.unfit else max(self.room.largest_side(), 0.0)

    def missing(self, side: float) -> Floats:
        """What each edge is too short by at this side: ``(m,) float``, at least 0, in mm."""
        return self.room.missing(side)

    def too_short(self, side: float) -> Iterator[str]:
        """Kinds of edges that are too short at this side, a line each, the worst first."""
        missing = self.missing(side)
        worst = np.array([missing[edge.edges].max() for edge in self.same.edges])
        for kind in np.argsort(-worst, kind="stable")[: np.count_nonzero(worst)]:
            edges = self.same.edges[kind].edges
            at = edges[missing[edges].argmax()]
            yield (
                f"{self.frame.called_edge(at)}, of kind {kind + 1} and "
                f"{self.frame.lengths[at]:.4g} mm long, is {worst[kind]:.4g} mm too short for its "
                f"two joints{more(int(np.count_nonzero(missing[edges])))}"
            )

    def places(self, side: float | None) -> Floats:
        """Where something is in the way: ``(k, 2) float``, in mm.

        Parameters
        ----------
        side
            Side of the tubes, in mm, if it is to be built.
        """
        points = self.frame.plan
        narrow = [self._narrowest(kind) for kind, reason in enumerate(self.refused) if reason]
        short = np.flatnonzero(self.missing(side) if side else [])
        middles = points[self.frame.edges[short]].mean(axis=1)
        return np.concatenate([points[narrow].reshape(-1, 2), middles.reshape(-1, 2)])

    def too_near(self, side: float) -> Iterator[str]:
        """The joint that is nearest to what passes by, if it is too near at this side."""
        fault = self.room.apart.fault(side)
        if fault:
            yield fault

    def _place(self, kind: int) -> str:
        """Where the narrowest joint of a kind stands."""
        called = self.frame.called_vertex(self._narrowest(kind))
        return called + more(len(self.same.joints[kind].vertices))

    def _narrowest(self, kind: int) -> int:
        vertices = self.same.joints[kind].vertices.tolist()
        return int(min(vertices, key=lambda v: float(self.frame.gaps(v).min())))


def rings(
    frame: Frame, same: Classes, ring_ratio: float | None = None, *, fixed: bool = False
) -> Build:
    """Give each kind of joint a ring, as a kit of the frame does.

    Parameters
    ----------
    frame
        The frame.
    same
        Its kinds.
    ring_ratio
        Of all joints; without one each has that of the weave for its angles, those to caps
        included.
    fixed
        Whether pegs are fixed, which need no room on edges; else they are loose.
    """
    kinds = choose_kinds(frame, same)
    shapes = [kinds.shape(number) for number in range(len(kinds.kinds))]
    found = [_ring(float(shape.gaps.min()), ring_ratio) for shape in shapes]
    reach = [
        (float(tube_start(ring)), ring - 0.5) if reason else reaches(shape.directions, ring)
        for shape, (ring, reason) in zip(shapes, found, strict=True)
    ]
    ratios = np.array([ring for ring, _ in found])
    needed = room(frame, kinds, np.array(reach), ratios, {}, fixed=fixed)
    kind_of = [int(kinds.kind_of[joint.vertices[0]]) for joint in same.joints]
    least_own = [np.diff(joint.directions, append=2 * np.pi).min() for joint in same.joints]
    return Build(
        frame,
        same,
        np.array([least_ring_ratio(shapes[kind].gaps) for kind in kind_of]),
        np.array([found[kind][0] for kind in kind_of]),
        tuple(
            # Edges that only caps are so near to are told with those that the caps stand for.
            found[kind][1] if own < shapes[kind].gaps.min() + _SAME else None
            for kind, own in zip(kind_of, least_own, strict=True)
        ),
        needed,
    )


def _ring(gap: float, ring_ratio: float | None) -> tuple[float, str | None]:
    """The ring of a joint with this smallest gap, and why it cannot be made, if it cannot."""
    if ring_ratio is None:
        try:
            return any_joint(gap).ring_ratio, None
        except InputError as error:
            return LIMITS["ring_ratio"][1], str(error)
    least = least_ring_ratio([gap])
    if least < ring_ratio:
        return ring_ratio, None
    return ring_ratio, (
        f"edges {math.degrees(gap):.4g} degrees apart need a ring ratio over {least:.4g}; at most "
        f"{ring_ratio:g} works, for {math.degrees(least_gap(ring_ratio)):.4g} degrees and more"
    )
