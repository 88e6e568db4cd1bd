"""Checks that a kit's joint locks, by contacts and forces."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from scadgen.check.geometry import joint_of, placed
from scadgen.check.result import Result
from scadgen.element.ends import connector
from scadgen.element.pieces import Piece
from scadgen.element.squares import Key
from scadgen.errors import GeometryError
from scadgen.frame.placement import Placement
from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.certificate import check_certificate
from scadgen.interlock.contacts import Contacts, Mesh, find_contacts
from scadgen.interlock.play import play
from scadgen.interlock.verdict import Certificate, Motion, verdict
from scadgen.joint.joint import DETAILS, Detail
from scadgen.kit.build import VALENCE
from scadgen.kit.model import Kit

__all__ = [
    "TIP",
    "connectors_lock",
    "finer_connectors_lock",
    "only_the_peg_moves",
    "prove",
    "tightness",
    "without_the_peg",
]

#: Faces closer than this, in sides, touch; without clearance they coincide.
_TOUCH = 1e-5

#: Force left on a part, as a share of all on it, that is rounding.
_BALANCED = 1e-8

#: Sine of the angle that a peg's way out may have to its edge.
_STRAIGHT = 1e-3

#: Where play is measured: at a tube's tip, this far from the ring's axis, in sides.
TIP = 3.0


def _whole(kit: Kit) -> list[Mesh]:
    """All connectors of a joint, none of them split, without clearance."""
    count = VALENCE[kit.frame]
    values = {**kit.values, "clearance": 0.0}
    places = [
        Placement("connector", (0, 0), 360 / count * n, flip=False, role="") for n in range(count)
    ]
    return [placed(kit, place, values) for place in places]


def connectors_lock(kit: Kit) -> Result:
    """Whether the whole connectors of a joint lock each other."""
    meshes = _whole(kit)
    return _locked("whole connectors lock", meshes, _contacts(kit, meshes), held=(0,))


def finer_connectors_lock(kit: Kit) -> Result:
    """Whether they do at twice the samples and cells, so that it is not the facets that lock."""
    detail = DETAILS[kit.detail]
    made = joint_of(kit, Detail(2 * detail.samples, 2 * detail.cells - 1))
    surface = made.connectors[0]
    key = Key(
        style="fixed",
        bored=False,
        tube_start=made.lattice.tube_start,
        pad=made.lattice.pad,
        window=0.0,
        depth=0.0,
    )
    solid = connector(key, Piece(surface, np.zeros_like(surface.points), 0.0))
    points = solid.points({**kit.values, "clearance": 0.0})
    count = VALENCE[kit.frame]
    turns = [2 * np.pi / count * n for n in range(count)]
    turned = [
        points @ np.array([[np.cos(t), np.sin(t), 0], [-np.sin(t), np.cos(t), 0], [0, 0, 1]])
        for t in turns
    ]
    meshes = [(place, solid.triangles) for place in turned]
    name = "so they do at twice the samples"
    return _locked(name, meshes, _contacts(kit, meshes), held=(0,))


def only_the_peg_moves(kit: Kit) -> Iterator[Result]:
    """Whether in the assembled joint nothing moves but the peg, along its axis."""
    values = {**kit.values, "clearance": 0.0, "peg_clearance": 0.0}
    meshes = [placed(kit, place, values) for place in kit.joint]
    names = [place.part for place in kit.joint]
    peg, held = names.index("peg"), names.index("connector")
    contacts = _contacts(kit, meshes)
    found = verdict(make_assembly(meshes, contacts, (held,)))
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
    yield _locked("with the peg held the joint locks", meshes, contacts, held=(held, peg))


def without_the_peg(kit: Kit) -> Iterator[Result]:
    """Whether, once the peg is out, the pieces come loose in turn: half A, half B, the rest.

    To first order: what starts to move may still get stuck, what does not start is stuck.
    """
    values = {**kit.values, "clearance": 0.0, "peg_clearance": 0.0}
    meshes = [placed(kit, place, values) for place in kit.joint if place.part != "peg"]
    names = [place.part for place in kit.joint if place.part != "peg"]
    first, second = (n for n, name in enumerate(names) if name == "half")
    rest = [n for n, name in enumerate(names) if name == "connector"]
    for name, moving, still in (
        ("peg out: half A comes loose", [first], [second, *rest]),
        ("then half B comes loose", [second], rest),
    ):
        chosen = [meshes[n] for n in (*moving, *still)]
        held = range(len(moving), len(chosen))
        found = verdict(make_assembly(chosen, _contacts(kit, chosen), held))
        loose = isinstance(found, Motion)
        yield Result(name, loose, "it does" if loose else "locked without clearance", "loose")
    loose = _falls_apart(kit, [meshes[n] for n in rest])
    figure = "they do" if loose else "locked without clearance"
    yield Result("then the connectors come loose", loose, figure, "loose")


def _falls_apart(kit: Kit, meshes: Sequence[Mesh]) -> bool:
    """Whether parts come loose in groups, and each group does so again, down to single parts."""
    if len(meshes) < 2:
        return True
    found = verdict(make_assembly(meshes, _contacts(kit, meshes), (0,)))
    if not isinstance(found, Motion):
        return False
    moving = [meshes[n] for n in found.parts]
    still = [mesh for n, mesh in enumerate(meshes) if n not in found.parts]
    return _falls_apart(kit, moving) and _falls_apart(kit, still)


def prove(kit: Kit) -> dict[str, str]:
    """What is proved of a kit before it is written.

    Raises
    ------
    GeometryError
        It does not lock, or the locked pieces do not come loose without the peg.
    """
    results = [connectors_lock(kit), *only_the_peg_moves(kit), *without_the_peg(kit)]
    for result in results:
        if not result.good:
            msg = (
                f"weave {kit.weave['name']}: {result.check}: {result.figure}, must be "
                f"{result.bound}; another weave helps, or --unchecked makes the kit all the same"
            )
            raise GeometryError(msg)
    return {result.check: result.figure for result in results}


def tightness(kit: Kit) -> Result:
    """How far a tube's tip moves for each mm of clearance, in the worst direction."""
    meshes = _whole(kit)
    assembly = make_assembly(meshes, _contacts(kit, meshes), (0,))
    worst = 0.0
    for number in assembly.free:
        turn = 2 * np.pi / VALENCE[kit.frame] * number
        tip = TIP * kit.values["side"] * np.array([np.cos(turn), np.sin(turn), 0.0])
        worst = max(worst, float(play(assembly, number, tip).max()))
    figure = f"{worst:.1f} mm a mm, {TIP:g} sides from the axis"
    return Result("play of a tube's tip", bool(np.isfinite(worst)), figure, "finite")


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
