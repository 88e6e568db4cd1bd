"""The pieces of a kind of joint as meshes where they stand, for the proofs."""

from __future__ import annotations

from collections.abc import Mapping

from scadgen.check.geometry import placed, standing
from scadgen.element.ends import flat_end, key_end, part
from scadgen.interlock.contacts import Mesh
from scadgen.kit.model import Joint, Kit
from scadgen.solid.affine import AffineSolid

__all__ = ["key_tubes", "pieces", "tubes"]


def pieces(kit: Kit, joint: Joint, values: Mapping[str, float]) -> list[Mesh]:
    """The mesh of each piece of a joint; a fixed peg is the end of its tube."""
    fixed, long = _tube(joint, socket=True), _with_room(joint, values)
    return [
        standing(fixed, place.pose, long)
        if place.role == "peg" and kit.key == "fixed"
        else placed(kit, place, values)
        for place in joint.pieces
    ]


def key_tubes(joint: Joint, values: Mapping[str, float]) -> dict[int, Mesh]:
    """The tube on each key's edge that has one, by the number of the key's half A."""
    tube, values = _tube(joint, socket=True), _with_room(joint, values)
    return {
        number: standing(tube, place.pose, values)
        for number, place in enumerate(joint.pieces)
        if place.role == "half_a" and not joint.is_cap(place)
    }


def tubes(joint: Joint, values: Mapping[str, float]) -> dict[int, Mesh]:
    """The tube of each connector that has one, by its number in the joint."""
    tube, values = _tube(joint, socket=False), _with_room(joint, values)
    return {
        number: standing(tube, place.pose, values)
        for number, place in enumerate(joint.pieces)
        if place.role == "cap" and not joint.is_cap(place)
    }


def _with_room(joint: Joint, values: Mapping[str, float]) -> dict[str, float]:
    """The live parameters with an edge on which two such joints have room.

    The shortest edge of a frame may be between joints that are smaller.
    """
    need = 2 * (joint.key.tube_start * values["side"] + values["peg_length"])
    return {**values, "edge_length": max(values["edge_length"], need)}


def _tube(joint: Joint, *, socket: bool) -> AffineSolid:
    """A tube on an edge, with key ends or with flat ones."""
    key = joint.key
    end = key_end(key) if socket else flat_end(key, {"side": key.tube_start, "clearance": 1.0})
    return part("tube", end, end, {"edge_length": 1.0})
