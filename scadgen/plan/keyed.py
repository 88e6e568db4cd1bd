"""Kits whose joints are all proved: where one is not, its key goes elsewhere.

Whether a joint locks and comes apart, and whether the frame holds, depends on which connector is
split.  Which one makes the fewest parts is chosen without a proof; so what a proof refuses is
chosen anew without it.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from scadgen.check.proof import proved
from scadgen.errors import JointError
from scadgen.frame.keys import Refused
from scadgen.frame.planarity import where
from scadgen.kit.build import Request, build
from scadgen.kit.model import Joint, Kit
from scadgen.plan.standing import stand
from scadgen.plan.whole import parting_joints
from scadgen.work.cache import Cache
from scadgen.work.each import Means

__all__ = ["proved_kit"]


def proved_kit(
    request: Request,
    means: Means | None = None,
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
    with _kept(means or Means()) as kept:
        if request.graph is None:
            return proved(build(request, kept, done), kept, say)
        return _keyed(request, kept, done, say)


def _keyed(
    request: Request, means: Means, done: Callable[[int, int], None], say: Callable[[str], None]
) -> Kit:
    """The kit of a graph: first its joints are to be proved, then the frame is to hold."""
    refused: list[Refused] = []
    parting: list[Refused] = []
    pegs, settled = 0, False
    while True:
        kit = build(replace(request, refused=(*refused, *parting)), means, done)
        if parting and _pegs(kit) > pegs:
            parting, settled = [], True
            continue
        try:
            found = proved(kit, means, say)
        except JointError as error:
            joint = next(joint for joint in kit.joints if joint.name == error.joint)
            say(f"{joint.title}: {error.fault}; another key there")
            if not _is_among(refused, joint):
                refused.append(_refused(joint))
            elif parting:
                parting, settled = [], True  # rather a frame that may come apart than none
            else:
                raise _nowhere(kit, joint, error) from error
            continue
        names = () if settled else {site.kind.name for site in parting_joints(stand(found))}
        joints = [joint for joint in kit.joints if joint.name in names]
        # Several keys at a joint are there for a regular frame: alike, they make fewer parts.
        loose = [
            joint for joint in joints if len(joint.keys) == 1 and not _is_among(parting, joint)
        ]
        if not loose:
            return found
        say(f"{loose[0].title}: the frame may come apart there; another key there")
        pegs = pegs if parting else _pegs(kit)
        parting += map(_refused, loose)


def _pegs(kit: Kit) -> int:
    """How many pegs a kit takes: what is only preferred is not worth more of them."""
    return sum(place.role == "peg" for place in kit.placements)


def _refused(joint: Joint) -> Refused:
    return Refused(joint.turns, joint.keys)


def _is_among(refused: Sequence[Refused], joint: Joint) -> bool:
    """Whether a joint was refused before, so that it cannot be kept out."""
    return any(one.is_like(np.radians(joint.turns), joint.keys) for one in refused)


@contextmanager
def _kept(means: Means) -> Iterator[Means]:
    """The same, with a place to keep what is not to be done twice."""
    if means.cache:
        yield means
        return
    with tempfile.TemporaryDirectory() as folder:
        yield replace(means, cache=Cache(Path(folder)))


def _nowhere(kit: Kit, joint: Joint, error: JointError) -> JointError:
    """The error that tells where such a joint stands, and what would help."""
    graph = kit.graph
    if graph is None:
        return error
    half = joint.pieces[0].part
    at = next(np.array(place.at) for place in kit.placements if place.part == half)
    off = np.linalg.norm(graph.vertices - at * kit.values["edge_length"], axis=1)
    vertex = int(off.argmin())
    angles = ", ".join(f"{gap:.4g}" for gap in np.diff([*joint.turns, 360.0]))
    msg = (
        f"vertex {vertex} at {where(graph.vertices[vertex])}, angles {angles}: {error.fault}; "
        "with other keys it is refused as well; other angles help, or --unchecked makes the kit "
        "all the same"
    )
    return JointError(msg, error.joint, error.fault)
