"""The finished frame as one assembly: what of it can still move, and what holds it.

Contacts are found once for each kind of joint, on its pieces without clearance, and placed at
every joint that is of that kind.  So that nothing is lost in a large frame, only the extreme
contacts of each two pieces are taken: what some contacts lock, all of them lock.

Pegs can slide along their edges, by which everything comes apart again.  The proof says what
moves besides.  First every peg is stopped in one of its halves, by two contacts that face each
other.  Of a peg that is a part of its own, contacts that are not along its way are left out,
and on all others it only slides: so any motion that the contacts allow, less the sliding of
such pegs, is one that the stops allow as well.  If there is none, nothing moves but these pegs.
If there is one, tubes may slide off their pegs, a row of them at once.  Then pegs are stopped
in their tubes as well: if nothing moves now, nothing ever does unless a peg slides.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from scadgen.check.geometry import placed
from scadgen.check.pieces import key_tubes, pieces
from scadgen.interlock.assembly import extreme_rows, make_assembly
from scadgen.interlock.certificate import BALANCED, check_certificate
from scadgen.interlock.contacts import Contacts, Mesh, find_contacts
from scadgen.interlock.forces import balanced, equilibrium, unfelt
from scadgen.interlock.verdict import Certificate, contacts_by_part, verdict
from scadgen.kit.model import Joint
from scadgen.plan.slides import sliding
from scadgen.plan.standing import Standing
from scadgen.solid.affine import Floats

__all__ = ["Loose", "Whole", "frame_contacts", "opens", "whole_frame"]

#: Faces closer than this, in sides, touch; without clearance they coincide.
_TOUCH = 1e-5

#: Cosine of the angle between a contact's normal and a peg's way up to which it only slides.
_SLIDES = 1e-6


@dataclass(frozen=True, slots=True)
class Loose:
    """Parts that can move as one, straight.

    Parameters
    ----------
    parts
        Their numbers.
    way
        The direction, a unit vector in the plane.
    """

    parts: tuple[int, ...]
    way: tuple[float, float]


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


def whole_frame(standing: Standing, gone: Collection[int] = ()) -> Whole:
    """Find out what of a finished frame can move.

    Parameters
    ----------
    standing
        The frame.
    gone
        Numbers of parts that are not there.
    """
    contacts, boxes = frame_contacts(standing), _boxes(standing)
    contacts = contacts.some(np.flatnonzero(~_of(contacts, gone)))
    pegs = [peg for peg in _pegs(standing) if not {peg.part, peg.half} & {*gone}]
    loose = tuple(m for m in _motions(standing, pegs) if opens(contacts, m))
    held = (max(standing.elements - {*gone}), *gone)
    parts, count = len(boxes) - len(gone), len(contacts)
    if forces := _locked(boxes, _stopped(contacts, pegs), held):
        moves = "pegs" if all(peg.alone for peg in pegs) else "rows"
        return Whole(parts, count, loose, forces, moves)
    stopped = _stopped(contacts, pegs, tubes=True)
    if forces := _locked(boxes, stopped, held):
        return Whole(parts, count, loose, forces, "rows")
    found = verdict(make_assembly(boxes, stopped, held))
    if isinstance(found, Certificate):
        if check_certificate(stopped, held, len(boxes), found) < BALANCED:
            return Whole(parts, count, loose, len(found.rows), "rows")
        moving: tuple[int, ...] = ()
    else:
        moving = found.parts
    return Whole(parts, count, (*loose, Loose(moving, (0.0, 0.0))), 0, "more")


def _of(contacts: Contacts, parts: Collection[int]) -> NDArray[np.bool_]:
    """Which contacts are of some parts."""
    some = list(parts)
    return np.isin(contacts.first, some) | np.isin(contacts.second, some)


def opens(contacts: Contacts, motion: Loose) -> bool:
    """Whether no contact is in the way of parts that move straight.

    Parameters
    ----------
    contacts
        All contacts.
    motion
        What moves, and where to.
    """
    inside = np.isin(contacts.first, motion.parts), np.isin(contacts.second, motion.parts)
    speed = inside[1].astype(float) - inside[0]
    along = contacts.normals @ np.array([*motion.way, 0.0])
    return bool((speed * along > -_SLIDES).all())


def _locked(boxes: Sequence[Mesh], contacts: Contacts, held: tuple[int, ...]) -> int:
    """How many forces in balance lock parts, their certificate checked; 0 if none are found.

    All contacts are taken at once, for they are few already.
    """
    assembly = make_assembly(boxes, contacts, held)
    forces = equilibrium(assembly.rows)
    if forces is None or unfelt(assembly.rows) is not None:
        return 0
    # In a large frame little stiffness is left, so that what is off balance counts for more.
    forces = balanced(assembly.rows, forces)
    if forces is None:
        return 0
    found = Certificate(np.arange(len(forces)), forces, assembly.rows.shape[1])
    good = check_certificate(contacts, held, len(boxes), found) < BALANCED
    return len(forces) if good else 0


def frame_contacts(standing: Standing) -> Contacts:
    """The extreme contacts between all parts of a frame without clearance, in mm.

    Parameters
    ----------
    standing
        The frame.
    """
    unit = standing.kit.values["edge_length"]
    kinds = {id(site.kind): site.kind for site in standing.sites}
    touching = {key: _touching(standing, kind) for key, kind in kinds.items()}
    found = []
    for site in standing.sites:
        contacts, tubes = touching[id(site.kind)]
        count = len(site.kind.pieces)
        parts = np.array(
            [site.parts[n] for n in range(count)] + [site.tubes.get(n, -1) for n in tubes]
        )
        first, second = parts[contacts.first], parts[contacts.second]
        kept = np.flatnonzero((first >= 0) & (second >= 0) & (first != second))
        turning = Rotation.from_euler("z", site.turn, degrees=True).as_matrix()
        found.append(
            (
                contacts.points[kept] @ turning.T + unit * np.array([*site.at, 0.0]),
                contacts.normals[kept] @ turning.T,
                first[kept],
                second[kept],
            )
        )
    return Contacts(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _touching(standing: Standing, kind: Joint) -> tuple[Contacts, tuple[int, ...]]:
    """The extreme contacts of a kind of joint, in mm, and the half A of each tube after them."""
    kit = standing.kit
    values = {**kit.values, "clearance": 0.0, "peg_clearance": 0.0}
    tubes = key_tubes(kit, kind, values) if kit.key == "loose" else {}
    meshes = [*pieces(kit, kind, values), *tubes.values()]
    contacts = find_contacts(meshes, _TOUCH * values["side"])
    return contacts.some(extreme_rows(make_assembly(meshes, contacts, (0,)))), tuple(tubes)


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
            turn = site.direction(peg)
            axis = np.array([math.cos(turn), math.sin(turn), 0.0])
            at = unit * np.array([*site.at, 0.0]) + side * site.kind.figures["pad_sides"] * axis
            part = site.parts[peg]
            alone = part not in standing.elements
            yield _Peg(part, site.parts[half], site.tubes.get(half), at, axis, alone)


def _stopped(contacts: Contacts, pegs: Sequence[_Peg], *, tubes: bool = False) -> Contacts:
    """The contacts with each peg stopped in its half, and in its tube; see the module's text."""
    stay = np.ones(len(contacts), dtype=np.bool_)
    of_part = contacts_by_part(contacts, int(max(contacts.second.max(), contacts.first.max())) + 1)
    stops = []
    for peg in pegs:
        stops.append((peg, peg.half))
        if peg.tube is not None and tubes:
            stops.append((peg, peg.tube))
        elif peg.alone:
            mine = of_part[peg.part]
            stay[mine] &= np.abs(contacts.normals[mine] @ peg.axis) < _SLIDES
    left = contacts.some(np.flatnonzero(stay))
    both = [(peg, other, sign) for peg, other in stops for sign in (1, -1)]
    return Contacts(
        np.vstack([left.points, *(peg.at for peg, _, _ in both)]),
        np.vstack([left.normals, *(sign * peg.axis for peg, _, sign in both)]),
        np.append(left.first, [other for _, other, _ in both]),
        np.append(left.second, [peg.part for peg, _, _ in both]),
    )


def _motions(standing: Standing, pegs: Sequence[_Peg]) -> Iterator[Loose]:
    """What may be able to move: each peg that is a part, and what slides off pegs."""
    inward = -1.0 if standing.kit.key == "loose" else 1.0
    for peg in pegs:
        if peg.alone:
            x, y, _ = inward * peg.axis
            yield Loose((peg.part,), (float(x), float(y)))
    for parts, way in sliding(standing):
        yield Loose(tuple(sorted(parts)), (float(way[0]), float(way[1])))
