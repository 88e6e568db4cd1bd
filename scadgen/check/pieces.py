"""The pieces of a kit's joint as meshes where they stand, for the proofs."""

from __future__ import annotations

from collections.abc import Mapping

from scadgen.check.geometry import placed
from scadgen.frame.placement import Placement
from scadgen.interlock.contacts import Mesh
from scadgen.kit.model import Kit

__all__ = ["key_tube", "pieces", "tubes"]


def pieces(kit: Kit, values: Mapping[str, float]) -> list[Mesh]:
    """The mesh of each piece of the joint; a fixed peg is the end of its tube."""
    return [
        key_tube(kit, values)
        if place.part == "peg" and kit.key == "fixed"
        else placed(kit, place, values)
        for place in kit.joint
    ]


def key_tube(kit: Kit, values: Mapping[str, float]) -> Mesh:
    """The tube on the key's edge."""
    return placed(kit, _along("two_sided", 0.0), values)


def tubes(kit: Kit, values: Mapping[str, float]) -> dict[int, Mesh]:
    """The tube of each connector, by its number in the joint."""
    return {
        number: placed(kit, _along("tube", place.turn), values)
        for number, place in enumerate(kit.joint)
        if place.part == "connector"
    }


def _along(part: str, turn: float) -> Placement:
    return Placement(part, (0.0, 0.0), turn, flip=False, role="")
