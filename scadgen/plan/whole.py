"""The finished frame as one assembly: what of it can still move, and what holds it.

Pegs can slide along their edges, by which everything comes apart again.  The proof says what
moves besides.  First every peg is stopped in one of its halves (`interlock.stops`): if nothing
can move now, nothing moves but pegs that are parts of their own.  If something can, tubes may
slide off their pegs, a row of them at once.  Then pegs are stopped in their tubes as well: if
nothing moves now, nothing ever does unless a peg slides.

What locks is proved on the extreme contacts, for what some contacts lock, all of them do.  What
can move is shown on all of them: a straight motion on every direction in which two parts touch;
any other, if the extreme ones do not lock, by a motion of parts with pegs stopped as above and
no contact left out.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.check.geometry import placed
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.certificate import BALANCED, check_certificate
from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.interlock.forces import equilibrium, unfelt
from scadgen.interlock.stops import SLIDES, Stop, stopped
from scadgen.interlock.verdict import Certificate, Motion, verdict
from scadgen.plan.slides import sliding
from scadgen.plan.standing import Standing, StandingJoint
from scadgen.plan.touching import Touching
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Vector

__all__ = ["Loose", "Whole", "opens", "parting_joints", "whole_frame"]

#: How far normals may be tilted without unlocking the frame, where joints are proved for those of
#: an STL.  A kit's own are within 4e-8, and as much as this counts as sliding; along a large frame
#: forces grow apart as levers do.
_TILTED = SLIDES


@dataclass(frozen=True, slots=True)
class Loose:
    """Parts that can move as one, straight.

    Parameters
    ----------
    parts
        Their numbers.
    way
        The direction, a unit vector.
    """

    parts: tuple[int, ...]
    way: Vector

    @property
    def degrees(self) -> float:
        """The direction as it is seen from above, as an angle."""
        return math.degrees(math.atan2(self.way[1], self.way[0]))


@dataclass(frozen=True, slots=True)
class Whole:
    """What was found of a finished frame.

    Parameters
    ----------
    parts, contacts
        How many there are.
    loose
        What can move: each peg that is a part of its own, what slides off pegs as one, and
        whatever else was found.
    forces
        How many forces in balance are the proof, checked; 0 if there is none.
    moves
        What can move at most: ``pegs``, those that are parts; ``rows``, what makes a peg slide
        in its halves or in its tube; ``more``, other things as well.
    """

    parts: int
    contacts: int
    loose: tuple[Loose, ...]
    forces: int
    moves: str

    @property
    def held(self) -> bool:
        """Whether nothing moves unless a peg slides."""
        return self.moves != "more"


@dataclass(frozen=True, slots=True, eq=False)
class _Peg:
    """A peg: its part, its half A and tube, a point on it, its axis, whether it is a part."""

    part: int
    half: int
    tube: int | None
    at: Floats
    axis: Floats
    alone: bool


def whole_frame(standing: Standing) -> Whole:
    """Find out what of a finished frame can move.

    Parameters
    ----------
    standing
        The frame.
    """
    touching, boxes, pegs = Touching(standing), _boxes(standing), list(_pegs(standing))
    few, held = touching.extreme(), standing.anchors
    directions = touching.directions()
    loose = tuple(motion for motion in _motions(standing, pegs) if opens(directions, motion))
    if forces := _locked(boxes, stopped(few, _stops(pegs, tubes=False)), held):
        moves = "pegs" if all(peg.alone for peg in pegs) else "rows"
        return Whole(len(boxes), len(few), loose, forces, moves)
    stops = _stops(pegs, tubes=True)
    if forces := _locked(boxes, stopped(few, stops), held):
        return Whole(len(boxes), len(few), loose, forces, "rows")
    every = stopped(touching.all(), stops)
    found = verdict(make_assembly(boxes, every, held))
    moving: tuple[int, ...] = ()
    if isinstance(found, Motion):
        moving = found.parts
    elif check_certificate(every, held, len(boxes), found) < BALANCED:
        return Whole(len(boxes), len(every), loose, len(found.rows), "rows")
    return Whole(len(boxes), len(every), (*loose, Loose(moving, (0.0, 0.0, 0.0))), 0, "more")


def parting_joints(standing: Standing) -> tuple[StandingJoint, ...]:
    """Where a finished frame may come apart though no peg slides.

    A joint may lock only because its tubes are held by joints at their other ends, where a loop
    leads back to it; at the end of a lone edge nothing holds them.

    Parameters
    ----------
    standing
        The frame.

    Returns
    -------
    joints
        Those at which something moves and something stays; none if the frame is held.
    """
    boxes, held = _boxes(standing), standing.anchors
    contacts = stopped(Touching(standing).extreme(), _stops(list(_pegs(standing)), tubes=True))
    if _locked(boxes, contacts, held):
        return ()
    found = verdict(make_assembly(boxes, contacts, held))
    if not isinstance(found, Motion):
        return ()
    moving, staying = set(found.parts), set(range(len(boxes))) - set(found.parts)
    return tuple(standing.sites[n] for n in standing.meeting(moving, staying))


def opens(contacts: Contacts, motion: Loose) -> bool:
    """Whether no contact is in the way of parts that move straight, to first order.

    Parameters
    ----------
    contacts
        One for each direction in which two parts touch, or all contacts.
    motion
        What moves, and where to.
    """
    inside = np.isin(contacts.first, motion.parts), np.isin(contacts.second, motion.parts)
    speed = inside[1].astype(float) - inside[0]
    along = contacts.normals @ np.array(motion.way)
    return bool((speed * along > -SLIDES).all())


def _locked(boxes: Sequence[Mesh], contacts: Contacts, held: tuple[int, ...]) -> int:
    """How many forces in balance lock parts, their certificate checked; 0 if none are found.

    All contacts are taken at once, for they are few already.
    """
    assembly = make_assembly(boxes, contacts, held)
    forces = equilibrium(assembly.rows, _TILTED)
    if forces is None or unfelt(assembly.rows) is not None:
        return 0
    found = Certificate(np.arange(len(forces)), forces, assembly.rows.shape[1])
    good = check_certificate(contacts, held, len(boxes), found) < BALANCED
    return len(forces) if good else 0


def _boxes(standing: Standing) -> list[Mesh]:
    """Two corners of each part's box where it stands, which say all that is asked of it."""
    found: list[Mesh] = []
    for place in standing.kit.placements:
        points, _ = placed(standing.kit, place, standing.kit.values)
        corners = np.stack([points.min(axis=0), points.max(axis=0)])
        found.append((corners, np.empty((0, 3), dtype=np.int64)))
    return found


def _pegs(standing: Standing) -> Iterator[_Peg]:
    """All pegs."""
    unit, side = standing.kit.values["edge_length"], standing.kit.values["side"]
    for site in standing.sites:
        for half, peg in zip(site.pieces("half_a"), site.pieces("peg"), strict=True):
            axis = site.direction(peg)
            at = unit * np.array(site.pose.at) + side * site.kind.key.pad * axis
            part = site.parts[peg]
            alone = part not in standing.elements
            yield _Peg(part, site.parts[half], site.tubes.get(half), at, axis, alone)


def _stops(pegs: Sequence[_Peg], *, tubes: bool) -> list[Stop]:
    """Where pegs are stopped: in their halves; and in their tubes, where none may slide at all."""
    return [
        Stop(
            peg.part,
            (peg.half, peg.tube) if tubes and peg.tube is not None else (peg.half,),
            peg.at,
            peg.axis,
            alone=peg.alone and not tubes,
        )
        for peg in pegs
    ]


def _motions(standing: Standing, pegs: Sequence[_Peg]) -> Iterator[Loose]:
    """What may be able to move: each peg that is a part, and what slides off pegs."""
    inward = -1.0 if standing.kit.key == "loose" else 1.0
    for peg in pegs:
        if peg.alone:
            x, y, z = (inward * peg.axis).tolist()
            yield Loose((peg.part,), (x, y, z))
    for parts, way in sliding(standing):
        x, y, z = way.tolist()
        yield Loose(tuple(sorted(parts)), (x, y, z))
