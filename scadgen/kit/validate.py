"""Whether a kit that was read makes sense: its tables and numbers belong together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from scadgen.frame.placement import ELEMENTS, Placement, bill
from scadgen.kit.model import Joint, Kit
from scadgen.kit.roles import PART_ROLES
from scadgen.solid.mesh import volume

__all__ = ["validate"]

#: How far places that are the same may be apart, in edge lengths: rounding.
_AT = 1e-6


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
        if len(solid.ends) != PART_ROLES[solid.role].ends or (
            solid.is_element and not solid.length > 0
        ):
            msg = f"part {name}: its ends or its length are not those of its role, {solid.role}"
            raise ValueError(msg)
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
    taken: set[tuple[int, int, str]] = set()
    for place in kit.placements:
        here = {(*end, "" if place.is_element else place.role) for end in place.ends}
        if not _is_sensible(kit, joints, place) or taken & here:
            msg = f"placements: {place.part} as {place.role} does not belong where it is"
            raise ValueError(msg)
        taken |= here
    unit = kit.values["edge_length"]
    at = np.array([vertex.pose.at for vertex in kit.vertices])
    if not np.allclose(unit * at, kit.frame.vertices, rtol=0, atol=_AT * unit):
        msg = "vertices: must be where those of the frame are"
        raise ValueError(msg)


def _is_sensible(kit: Kit, joints: Mapping[str, Joint], place: Placement) -> bool:
    """Whether a placement is on its edge, or is a piece of the joint at its vertex."""
    for end in place.ends:
        if end.vertex >= len(kit.vertices):
            return False
        if end.slot >= len(joints[kit.vertices[end.vertex].joint].turns):
            return False
    near = kit.vertices[place.vertex].pose.at
    if not np.allclose(place.pose.at, near, rtol=0, atol=_AT):
        return False
    part = kit.parts.get(place.part)
    if place.edge is not None and kit.frame is not None:
        ends = sorted(end.vertex for end in place.ends)
        is_one = part is not None and part.is_element
        return is_one and place.role in ELEMENTS and ends == kit.frame.edges[place.edge].tolist()
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
        or list(one.turns) != sorted({*one.turns})
        or not 0 == one.turns[0] <= one.turns[-1] < 360
        or 0 not in one.keys
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
