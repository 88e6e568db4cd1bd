"""Kits whose joints are all proved: where one is not, its key goes elsewhere.

Whether a joint locks and comes apart, and whether the frame holds, depends on which connector is
split.  Which one makes the fewest parts is chosen without a proof; so what a proof refuses is
chosen anew without it.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from scadgen.check.proof import proved
from scadgen.errors import GeometryError, InputError, JointError
from scadgen.frame.slots import Refused
from scadgen.frame.words import corner
from scadgen.kit.build import Request, build
from scadgen.kit.model import Joint, Kit
from scadgen.plan.standing import stand
from scadgen.plan.whole import parting_joints
from scadgen.work.cache import Cache
from scadgen.work.mapping import Execution

__all__ = ["proved_kit"]


def proved_kit(
    request: Request,
    means: Execution | None = None,
    done: Callable[[int, int], None] = lambda *_: None,
    say: Callable[[str], None] = lambda _: None,
) -> Kit:
    """Make a kit and prove all that it promises of its joints.

    Parameters
    ----------
    request
        What kit to make.
    means
        Who works, and where joints and proofs are kept; by default this process alone, and
        nowhere once it is done.
    done
        Told how many of how many joints are computed, after each.
    say
        Told what is proved.

    Raises
    ------
    InputError, GeometryError
        As for `build`.
    JointError
        A joint is not proved, whichever of its connectors are split: says where.  That the
        frame holds is only preferred; its plan proves it.
    """
    with _kept(means or Execution()) as kept:
        if request.regular:
            return proved(build(request, kept, done), kept, say)
        return _Keyed(kept, done, say).held(request)


@dataclass(frozen=True, slots=True)
class _Keyed:
    """Who makes kits of frames, and who is told."""

    means: Execution
    done: Callable[[int, int], None]
    say: Callable[[str], None]

    def proved(self, request: Request, most: float = math.inf) -> Kit:
        """A kit of no more than so many pegs whose joints are all proved.

        Raises
        ------
        JointError
            A joint is refused though it was to be kept out.
        _MorePegsError
            It takes more pegs.
        """
        while True:
            kit = build(request, self.means, self.done)
            if _pegs(kit) > most:
                raise _MorePegsError
            try:
                return proved(kit, self.means, self.say)
            except JointError as error:
                joint = next(joint for joint in kit.joints if joint.name == error.joint)
                if _is_among(request.refused, joint):
                    raise _nowhere(kit, joint, error) from error
                self.say(f"{joint.title}: {error.fault}; another key there")
                request = replace(request, refused=(*request.refused, _refused(joint)))

    def held(self, request: Request) -> Kit:
        """A proved kit whose frame holds besides, if one is found that takes no more pegs."""
        kit = first = self.proved(request)
        while loose := _loose(kit):
            self.say(f"{loose[0].title}: the frame may come apart there; another key there")
            refused = (*kit.refused, *map(_refused, loose))
            try:
                kit = self.proved(replace(request, refused=refused), _pegs(first))
            except (GeometryError, InputError, _MorePegsError):
                return first  # rather a frame that may come apart than none, or many pegs
        return kit


class _MorePegsError(Exception):
    """What is only preferred would take more pegs."""


def _loose(kit: Kit) -> list[Joint]:
    """The joints at which a frame may come apart, but where another key may help.

    Several keys at a joint are there for a regular frame: alike, they make fewer parts.
    """
    names = {site.kind.name for site in parting_joints(stand(kit))}
    return [
        joint
        for joint in kit.joints
        if joint.name in names and len(joint.keys) == 1 and not _is_among(kit.refused, joint)
    ]


def _pegs(kit: Kit) -> int:
    """How many pegs a kit takes."""
    return sum(place.role == "peg" for place in kit.placements)


def _refused(joint: Joint) -> Refused:
    return Refused(joint.turns, joint.keys)


def _is_among(refused: Sequence[Refused], joint: Joint) -> bool:
    """Whether a joint was refused before, so that it cannot be kept out."""
    return any(one.is_like(np.radians(joint.turns), joint.keys) for one in refused)


@contextmanager
def _kept(means: Execution) -> Iterator[Execution]:
    """The same, with a place to keep what is not to be done twice."""
    if means.cache:
        yield means
        return
    with tempfile.TemporaryDirectory() as folder:
        yield replace(means, cache=Cache(Path(folder)))


def _nowhere(kit: Kit, joint: Joint, error: JointError) -> JointError:
    """The error that tells where such a joint stands, and what would help."""
    number = next(n for n, one in enumerate(kit.vertices) if one.joint == joint.name)
    x, y = kit.values["edge_length"] * np.array(kit.vertices[number].pose.at[:2])
    gaps = np.diff([*joint.turns, 360.0]).tolist()
    vertex = f"vertex {number} at ({x:.6g}, {y:.6g})"
    msg = (
        f"{corner(vertex, gaps)}: {error.fault}; with other keys it is refused as "
        "well; other angles help, or --unchecked makes the kit all the same"
    )
    return JointError(msg, error.joint, error.fault)
