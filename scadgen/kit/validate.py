"""Whether a kit that was read makes sense: its tables and numbers belong together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from scadgen.frame.placement import ELEMENTS, Placement, bill
from scadgen.kit.model import Joint, Kit
from scadgen.solid.mesh import volume

__all__ = ["validate"]


def validate(kit: Kit, document: Mapping[str, Any]) -> None:
    """Refuse a kit whose tables and numbers do not belong together.

    Raises
    ------
    ValueError
        They do not: says which.
    """
    if document["bill"] != bill(kit.placements, kit.parts):
        msg = "the bill is not the frame's"
        raise ValueError(msg)
    if document["proved"] != kit.proved:
        msg = "it says that it is proved, or not, and the verdicts say otherwise"
        raise ValueError(msg)
    for one in kit.joints:
        _check_joint(one)
    _check_names(kit)
    for name, solid in kit.parts.items():
        if not {*solid.coefficients} <= {*kit.values}:
            msg = f"part {name}: moved by a parameter that the kit lacks"
            raise ValueError(msg)
        if not volume(solid.points(kit.values), solid.triangles) > 0:
            msg = f"part {name}: inside out"
            raise ValueError(msg)


def _check_names(kit: Kit) -> None:
    """Refuse a kit whose parts are not those that its frame and its joints need."""
    _check_places(kit)
    used = {p.part for p in kit.placements}
    used.update(*({p.part for p in one.pieces} | {*one.connectors} for one in kit.joints))
    if missing := used - set(kit.parts):
        msg = f"part {min(missing)}: is needed and is not there"
        raise ValueError(msg)


def _check_places(kit: Kit) -> None:
    """Refuse placements that do not belong to the vertices and edges of the frame."""
    joints = {one.name: one for one in kit.joints}
    if len(joints) < len(kit.joints):
        names = [one.name for one in kit.joints]
        msg = f"joints: two are called {next(n for n in names if names.count(n) > 1)!r}"
        raise ValueError(msg)
    if kit.frame is None or len(kit.vertices) != len(kit.frame.vertices):
        msg = "vertices: as many as the frame has must be there"
        raise ValueError(msg)
    if strange := {v.joint for v in kit.vertices} - joints.keys():
        msg = f"vertices: there is no joint {min(strange)!r}"
        raise ValueError(msg)
    edges = kit.frame.edges.tolist()
    if [p.edge for p in kit.placements if p.is_element] != [*range(len(edges))]:
        msg = "placements: each edge must have one element, in order"
        raise ValueError(msg)
    for place in kit.placements:
        if not _is_sensible(kit, joints, place):
            msg = f"placements: {place.part} as {place.role} does not belong where it is"
            raise ValueError(msg)


def _is_sensible(kit: Kit, joints: Mapping[str, Joint], place: Placement) -> bool:
    """Whether a placement is on its edge, or is a piece of the joint at its vertex."""
    for end in place.ends:
        if end.vertex >= len(kit.vertices):
            return False
        if end.slot >= len(joints[kit.vertices[end.vertex].joint].turns):
            return False
    if place.edge is not None and kit.frame is not None:
        ends = sorted(end.vertex for end in place.ends)
        return place.role in ELEMENTS and ends == kit.frame.edges[place.edge].tolist()
    joint = joints[kit.vertices[place.vertex].joint]
    pieces = {(p.role, p.part, p.slot) for p in joint.pieces}
    return len(place.ends) == 1 and (place.role, place.part, place.slot) in pieces


def _check_joint(one: Joint) -> None:
    """Refuse a kind of joint whose lists do not belong together."""
    count = len(one.turns)
    slots = {piece.slot for piece in one.pieces}
    if (
        len(one.connectors) != count
        or not slots <= {*range(count)}
        or not {*one.keys, *one.caps, *one.over} <= {*range(count)}
    ):
        msg = f"{one.title}: its lists do not belong together"
        raise ValueError(msg)
    _check_ways(one)


def _check_ways(one: Joint) -> None:
    """Refuse ways that do not take a joint apart, or not all of one that is proved."""
    there = {*range(len(one.pieces))}
    for way in one.ways:
        if not {*way.moving} <= there:
            msg = f"{one.title}: ways: {way.name!r} moves pieces that are not there then"
            raise ValueError(msg)
        there -= {*way.moving}
    if one.verdicts and len(there) > 1:
        left = ", ".join(one.pieces[n].part for n in sorted(there))
        msg = f"{one.title}: ways: there is none by which {left} come apart"
        raise ValueError(msg)
