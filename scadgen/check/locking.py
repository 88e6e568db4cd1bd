"""Checks that a kit's joint locks, by contacts and forces, and how tightly.

What counts is proved on the faces of the pieces themselves.  Whether the weave or its facets do
it, and how much play it leaves, is found on the exact walls (`joint_contacts.whole_contacts`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from scadgen.check.geometry import lattice_of, placed
from scadgen.check.joint_contacts import whole_contacts
from scadgen.check.pieces import key_tube, pieces
from scadgen.check.result import Result
from scadgen.frame.placement import Placement
from scadgen.interlock.assembly import Assembly, make_assembly
from scadgen.interlock.certificate import check_certificate
from scadgen.interlock.contacts import Contacts, Mesh, find_contacts
from scadgen.interlock.play import loosest, measured
from scadgen.interlock.verdict import Certificate, Motion, verdict
from scadgen.joint.joint import DETAILS, Detail
from scadgen.kit.model import Kit
from scadgen.solid.affine import Floats

__all__ = [
    "TIP",
    "connectors_lock",
    "joint_locks",
    "largest_play",
    "only_the_peg_moves",
]

#: Faces closer than this, in sides, touch; without clearance they coincide.
_TOUCH = 1e-5

#: Force left on a part, as a share of all on it, that is rounding.
_BALANCED = 1e-8

#: Sine of the angle that a peg's way out may have to its edge.
_STRAIGHT = 1e-3

#: Where play is measured: at a tube's tip, this far from the ring's axis, in sides.
TIP = 3.0

#: How much play may change when the samples double.
_CHANGE = 0.1

#: Clearance at which play has to be as the first order says, in sides, and how nearly.
_SMALL, _FIRST_ORDER = 0.002, 0.1


def _whole(kit: Kit, clearance: float = 0.0) -> list[Mesh]:
    """All connectors of a joint, none of them split."""
    count = kit.valence
    values = {**kit.values, "clearance": clearance}
    places = [
        Placement("connector", (0, 0), 360 / count * n, flip=False, role="") for n in range(count)
    ]
    return [placed(kit, place, values) for place in places]


def joint_locks(kit: Kit) -> Iterator[Result]:
    """Whether a joint locks but for its peg, and how much play it leaves."""
    meshes = _whole(kit)
    contacts = _contacts(kit, meshes)
    yield _locked("whole connectors lock", meshes, contacts, held=(0,))
    yield from only_the_peg_moves(kit)
    yield from _play(kit)
    yield _measured_play(kit, meshes, contacts)


def connectors_lock(kit: Kit) -> Result:
    """Whether the whole connectors of a joint lock each other on their exact walls."""
    return _locked("whole connectors lock", *_exact(kit, 1), held=(0,))


def only_the_peg_moves(kit: Kit) -> Iterator[Result]:
    """Whether in the assembled joint nothing moves but the peg, along its axis.

    The tube that a loose peg holds is held, as it is by the joint at its other end.
    """
    values = {**kit.values, "clearance": 0.0, "peg_clearance": 0.0}
    meshes, names = pieces(kit, values), [place.part for place in kit.joint]
    peg, held = names.index("peg"), [names.index("connector")]
    if kit.key == "loose":
        held.append(len(meshes))
        meshes.append(key_tube(kit, values))
    contacts = _contacts(kit, meshes)
    found = verdict(make_assembly(meshes, contacts, held))
    good, figure = False, "not even the peg"
    if isinstance(found, Motion):
        way = found.translations[0] / np.linalg.norm(found.translations[0])
        straight = np.linalg.norm(way[1:]) < _STRAIGHT and not found.rotations.any()
        good = found.parts == (peg,) and bool(straight)
        figure = (
            "the peg, along its axis"
            if good
            else f"parts {', '.join(names[n] for n in found.parts)}"
        )
    yield Result("in the joint only the peg moves", good, figure, "the peg, along its axis")
    yield _locked("with the peg held the joint locks", meshes, contacts, held=(*held, peg))


def largest_play(kit: Kit) -> float:
    """How far a tube's tip moves for each mm of clearance, in the worst direction; mm a mm."""
    return _loosest(make_assembly(*_exact(kit, 1), (0,)), TIP)[0]


def _play(kit: Kit) -> Iterator[Result]:
    """The play of a tube's tip, and whether verdict and play are the same at twice the samples."""
    once, finer = largest_play(kit), _exact(kit, 2)
    figure = f"{once:.1f} mm a mm, {TIP:g} sides from the axis"
    yield Result("play of a tube's tip", bool(np.isfinite(once)), figure, "finite")
    yield _locked("whole connectors lock at twice the samples", *finer, held=(0,))
    twice = _loosest(make_assembly(*finer, (0,)), TIP)[0]
    change = twice / once - 1 if np.isfinite(once) else np.inf
    figure, bound = f"{twice:.1f} mm a mm, {change:+.0%}", f"within {_CHANGE:.0%}"
    yield Result("play at twice the samples", bool(abs(change) < _CHANGE), figure, bound)


def _measured_play(kit: Kit, meshes: Sequence[Mesh], contacts: Contacts) -> Result:
    """Whether pieces drawn back really have the play that their faces leave."""
    name, bound = "play measured on the pieces", f"{1 - _FIRST_ORDER:g} to {1 + _FIRST_ORDER:g}"
    side, assembly = kit.values["side"], make_assembly(meshes, contacts, (0,))
    travel, steps = _loosest(assembly, TIP * side)
    if not np.isfinite(travel):
        return Result(name, good=False, figure="no end", bound=f"{bound} at first")
    shares = {
        gap: measured(_whole(kit, gap), assembly.middles, steps, gap)
        for gap in (_SMALL * side, kit.values["clearance"])
        if gap > 0
    }
    found = ", ".join(f"{share:.2f} of it at {gap:g} mm" for gap, share in shares.items())
    good = abs(next(iter(shares.values())) - 1) < _FIRST_ORDER
    return Result(name, good, f"{travel:.1f} mm a mm by their faces, {found}", f"{bound} at first")


def _loosest(assembly: Assembly, reach: float) -> tuple[float, Floats]:
    """The largest play of any connector's tip along any axis, and the motion."""
    count = len(assembly.middles)
    turns = 2 * np.pi / count * np.arange(count)
    tips = reach * np.column_stack([np.cos(turns), np.sin(turns), 0 * turns])
    return loosest(assembly, tips)


def _exact(kit: Kit, times: int) -> tuple[list[Mesh], Contacts]:
    """The whole connectors' contacts on their exact walls, at so many times the samples."""
    detail = DETAILS[kit.detail]
    finer = Detail(times * detail.samples, times * (detail.cells - 1) + 1)
    return whole_contacts(*lattice_of(kit, finer))


def _contacts(kit: Kit, meshes: Sequence[Mesh]) -> Contacts:
    return find_contacts(meshes, _TOUCH * kit.values["side"])


def _locked(name: str, meshes: Sequence[Mesh], contacts: Contacts, held: Collection[int]) -> Result:
    """Whether parts are locked, with the certificate checked anew."""
    found = verdict(make_assembly(meshes, contacts, held))
    if isinstance(found, Certificate):
        left = check_certificate(contacts, held, len(meshes), found)
        good = bool(left < _BALANCED)
        figure = f"{len(found.rows)} contacts in balance" if good else f"{left:.0e} off balance"
        return Result(name, good, figure, "locked")
    figure = f"{len(found.parts)} parts can move"
    return Result(name, good=False, figure=figure, bound="locked")
