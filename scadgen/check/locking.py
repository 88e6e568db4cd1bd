"""Checks that a kit's joint locks, by contacts and forces, and how tightly.

What counts is proved on the faces of the pieces themselves.  Whether the weave or its facets do
it, and how much play it leaves, is found on the exact walls (`joint_contacts.whole_contacts`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

import numpy as np

from scadgen.check.geometry import lattice_of, standing
from scadgen.check.joint_contacts import whole_contacts
from scadgen.check.pieces import key_tubes, pieces
from scadgen.check.result import Result
from scadgen.interlock.assembly import Assembly, make_assembly
from scadgen.interlock.certificate import BALANCED, check_certificate
from scadgen.interlock.contacts import Contacts, Mesh, find_contacts
from scadgen.interlock.play import Loosest, loosest, measured
from scadgen.interlock.stops import SLIDES, Stop, stopped
from scadgen.interlock.verdict import Certificate, Motion, verdict
from scadgen.joint.joint import DETAILS, Detail
from scadgen.kit.model import Joint, Kit
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Pose

__all__ = [
    "TIP",
    "TOUCH",
    "connectors_lock",
    "joint_locks",
    "largest_play",
    "only_the_peg_moves",
    "only_these_move",
]

#: Faces closer than this, in sides, touch; without clearance they coincide.
TOUCH = 1e-5

#: Sine of the angle that a peg's way out may have to its edge.
_STRAIGHT = 1e-3

#: Where play is measured: at a tube's tip, this far from the ring's axis, in sides.
TIP = 3.0

#: How much play may change when the samples double.
_CHANGE = 0.1

#: How many times the samples a play may take until it changes no more than that.
_FINEST = 2

#: Clearance at which play has to be as the first order says, in sides, and how nearly.
_SMALL, _FIRST_ORDER = 0.0005, 0.1


def _whole(kit: Kit, joint: Joint, clearance: float = 0.0) -> list[Mesh]:
    """All connectors of a joint, none of them split."""
    values = {**kit.values, "clearance": clearance}
    return [
        standing(kit.parts[name], Pose.flat((0, 0), turn, over=edge in joint.over), values)
        for edge, (name, turn) in enumerate(zip(joint.connectors, joint.turns, strict=True))
    ]


def joint_locks(kit: Kit, joint: Joint) -> Iterator[Result]:
    """Whether a joint locks but for its pegs, and how much play it leaves."""
    meshes = _whole(kit, joint)
    contacts = _contacts(kit, meshes)
    yield _locked("whole connectors lock", meshes, contacts, held=(0,))
    yield from only_the_peg_moves(kit, joint)
    play, results = _play(kit, joint)
    yield from results
    yield _measured_play(kit, joint, meshes, contacts, play)


def connectors_lock(kit: Kit, joint: Joint) -> Result:
    """Whether the whole connectors of a joint lock each other on their exact walls."""
    exact = whole_contacts(*lattice_of(joint, DETAILS[kit.detail]))
    return _locked("whole connectors lock", *exact, held=(0,))


def only_the_peg_moves(kit: Kit, joint: Joint) -> Iterator[Result]:
    """Whether in the assembled joint nothing moves but the pegs, each along its axis.

    The tubes that loose pegs hold are held, as they are by the joints at their other ends.
    """
    values = {**kit.values, "clearance": 0.0, "peg_clearance": 0.0}
    meshes = pieces(kit, joint, values)
    axes = {n: np.array(p.pose.x) for n, p in enumerate(joint.pieces) if p.role == "peg"}
    roles = [place.role for place in joint.pieces]
    held = [roles.index("cap") if "cap" in roles else 0]
    if kit.key == "loose":
        for tube in key_tubes(joint, values).values():
            held.append(len(meshes))
            meshes.append(tube)
    names = [place.part for place in joint.pieces]
    yield from only_these_move(meshes, _contacts(kit, meshes), held, axes, names)


def only_these_move(
    meshes: Sequence[Mesh],
    contacts: Contacts,
    held: Sequence[int],
    axes: Mapping[int, Floats],
    names: Sequence[str],
) -> Iterator[Result]:
    """Whether nothing moves but some parts, each along its axis.

    Parameters
    ----------
    meshes, contacts
        The parts, and where they touch.
    held
        Numbers of the parts that are held.
    axes
        The direction of each peg, by its number.
    names
        What to call the parts that are not held.
    """
    one = len(axes) == 1
    assembly = make_assembly(meshes, contacts, held)
    found = verdict(assembly)
    wanted = "the peg, along its axis" if one else "the pegs, along their axes"
    good, figure = False, "not even the peg" if one else "not all pegs"
    if isinstance(found, Motion):
        straight = set(found.parts) <= set(axes) and _along(found, axes)
        good = straight and all(_slides(contacts, peg, axis) for peg, axis in axes.items())
        if not straight:
            figure = f"parts {', '.join(names[n] for n in found.parts)}"
    name = "in the joint only the peg moves" if one else "only the pegs move"
    yield Result(name, good, wanted if good else figure, wanted)
    what = "the peg" if one else "the pegs"
    yield _locked(f"with {what} held the joint locks", meshes, contacts, held=(*held, *axes))
    # Pegs and other parts may still move together, which neither of these shows.
    name = "no part moves but the peg" if one else "no part moves but the pegs"
    stops = [Stop(n, (held[0],), assembly.middles[n], axis) for n, axis in axes.items()]
    yield _locked(name, meshes, stopped(contacts, stops), held)


def _slides(contacts: Contacts, part: int, axis: Floats) -> bool:
    """Whether no contact of a part is in its way along an axis, at least to one side."""
    along = contacts.normals @ axis
    away = np.concatenate([along[contacts.second == part], -along[contacts.first == part]])
    return bool((away > -SLIDES).all() or (away < SLIDES).all())


def _along(found: Motion, axes: Mapping[int, Floats]) -> bool:
    """Whether each part that moves goes straight along its axis, and does not turn."""
    for part, way, turning in zip(found.parts, found.translations, found.rotations, strict=True):
        aside = np.linalg.norm(np.cross(axes[part], way))
        if aside >= _STRAIGHT * np.linalg.norm(way) or turning.any():
            return False
    return True


def largest_play(kit: Kit, joint: Joint) -> float:
    """How far a tube's tip moves for each mm of clearance, in the worst direction; mm a mm."""
    return _loosest(joint, make_assembly(*_exact(kit, joint, 1), (0,)), TIP).travel


def _play(kit: Kit, joint: Joint, times: int = 1) -> tuple[Loosest, list[Result]]:
    """The play of a tube's tip, and whether verdict and play are the same at twice the samples.

    Where the play is not, all is done once more with twice the samples.
    """
    once = _loosest(joint, make_assembly(*_exact(kit, joint, times), (0,)), TIP)
    finer = _exact(kit, joint, 2 * times)
    twice = _loosest(joint, make_assembly(*finer, (0,)), TIP, [once.tip]).travel
    change = twice / once.travel - 1 if np.isfinite(once.travel) else np.inf
    if _CHANGE <= abs(change) < np.inf and times < _FINEST:
        return _play(kit, joint, 2 * times)
    figure = f"{once.travel:.1f} mm a mm, {TIP:g} sides from the axis"
    changed, bound = f"{twice:.1f} mm a mm, {change:+.0%}", f"within {_CHANGE:.0%}"
    return once, [
        Result("play of a tube's tip", bool(np.isfinite(once.travel)), figure, "finite"),
        _locked("whole connectors lock at twice the samples", *finer, held=(0,)),
        Result("play at twice the samples", bool(abs(change) < _CHANGE), changed, bound),
    ]


def _measured_play(
    kit: Kit, joint: Joint, meshes: Sequence[Mesh], contacts: Contacts, exact: Loosest
) -> Result:
    """Whether pieces drawn back really have the play that their faces leave, at the same tip."""
    side, assembly = kit.values["side"], make_assembly(meshes, contacts, (0,))
    small = _SMALL * side
    name, bound = "play measured on the pieces", f"within {_FIRST_ORDER:.0%} at {small:g} mm"
    travel, steps, _ = _loosest(joint, assembly, TIP * side, [exact.tip])
    if not np.isfinite(travel):
        return Result(name, good=False, figure="no end", bound=bound)
    shares = {
        gap: measured(_whole(kit, joint, gap), assembly.middles, steps, gap)
        for gap in (small, kit.values["clearance"])
        if gap > 0
    }
    found = ", ".join(f"{share * travel:.1f} at {gap:g} mm" for gap, share in shares.items())
    # At the kit's own clearance it is told but not bounded: first order promises nothing there,
    # and a motion that is straight there may end where one that follows bent walls goes on.
    good = abs(shares[small] - 1) < _FIRST_ORDER
    return Result(name, good, f"{found}; by their faces {travel:.1f} mm a mm", bound)


def _loosest(
    joint: Joint,
    assembly: Assembly,
    reach: float,
    tips: Iterable[tuple[int, int]] | None = None,
) -> Loosest:
    """The largest play of any connector's tip along any axis, and the motion."""
    turns = np.array(joint.directions)
    points = reach * np.column_stack([np.cos(turns), np.sin(turns), 0 * turns])
    return loosest(assembly, points, tips)


def _exact(kit: Kit, joint: Joint, times: int) -> tuple[list[Mesh], Contacts]:
    """The whole connectors' contacts on their exact walls, at so many times the samples."""
    # At draft too few of the lattice's edges cross a wall to tell its play.
    detail = max(DETAILS[kit.detail], DETAILS["standard"], key=lambda one: one.cells)
    finer = Detail(times * detail.samples, times * (detail.cells - 1) + 1)
    return whole_contacts(*lattice_of(joint, finer))


def _contacts(kit: Kit, meshes: Sequence[Mesh]) -> Contacts:
    return find_contacts(meshes, TOUCH * kit.values["side"])


def _locked(name: str, meshes: Sequence[Mesh], contacts: Contacts, held: Collection[int]) -> Result:
    """Whether parts are locked, with the certificate checked anew."""
    found = verdict(make_assembly(meshes, contacts, held))
    if isinstance(found, Certificate):
        left = check_certificate(contacts, held, len(meshes), found)
        good = bool(left < BALANCED)
        figure = f"{len(found.rows)} contacts in balance" if good else f"{left:.0e} off balance"
        return Result(name, good, figure, "locked")
    figure = f"{len(found.parts)} parts can move"
    return Result(name, good=False, figure=figure, bound="locked")
