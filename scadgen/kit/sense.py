"""Whether a kit that was read makes sense: its tables and numbers belong together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from scadgen.frame.layout import bill, joint
from scadgen.frame.placement import ELEMENTS, PARTS
from scadgen.kit.model import Joint, Kit
from scadgen.kit.request import VALENCE
from scadgen.solid.mesh import volume

__all__ = ["check_sense"]


def check_sense(kit: Kit, document: Mapping[str, Any]) -> None:
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
    if kit.graph is None:
        if len(kit.joints) != 1 or kit.joints[0].pieces != joint(VALENCE[kit.frame], kit.key):
            msg = "the joint is not the frame's"
            raise ValueError(msg)
        if set(kit.parts) != set(PARTS):
            msg = f"parts must be {', '.join(PARTS)}"
            raise ValueError(msg)
    _check_pieces(kit)
    used = {p.part for p in kit.placements}
    used.update(*({p.part for p in one.pieces} | {*one.connectors} for one in kit.joints))
    if missing := used - set(kit.parts):
        msg = f"part {min(missing)}: is needed and is not there"
        raise ValueError(msg)


def _check_pieces(kit: Kit) -> None:
    """Refuse placements that are not pieces of the kind of joint that they say they are of."""
    pieces = {one.name: {(p.role, p.part) for p in one.pieces} for one in kit.joints}
    if len(pieces) < len(kit.joints):
        names = [one.name for one in kit.joints]
        msg = f"joints: two are called {next(n for n in names if names.count(n) > 1)!r}"
        raise ValueError(msg)
    for place in kit.placements:
        if place.role in ELEMENTS:
            good = not place.joint
        else:
            good = (place.role, place.part) in pieces.get(place.joint, ())
        if not good:
            msg = f"placements: {place.part} as {place.role} is no piece of joint {place.joint!r}"
            raise ValueError(msg)


def _check_joint(one: Joint) -> None:
    """Refuse a kind of joint whose lists do not belong together."""
    count = len(one.turns)
    if len(one.connectors) != count or not {*one.keys, *one.caps, *one.over} <= {*range(count)}:
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
