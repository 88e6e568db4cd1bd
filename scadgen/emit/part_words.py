"""What parts are called in a bill: elements with their length, and what their ends are."""

from __future__ import annotations

from scadgen.emit.scad_parameters import label
from scadgen.emit.scad_text import literal
from scadgen.kit.model import Kit, Part, PartEnd
from scadgen.kit.solids import REGULAR

__all__ = ["words"]


def words(kit: Kit) -> dict[str, str]:
    """What each part is, in a few words.

    Parameters
    ----------
    kit
        The kit; lengths are those at its values, between the centres of joints.

    Returns
    -------
    words
        By part; those of an edge element name its near end first.
    """
    return {name: _words(kit, part) for name, part in kit.parts.items()}


def _words(kit: Kit, part: Part) -> str:
    said = label(part)
    if part.name in REGULAR and kit.key == "loose":
        said = said.replace("peg end", "socket end")
    if not part.length:
        return said
    length = f"{literal(round(part.length * kit.values['edge_length'], 1))} mm"
    if part.name in REGULAR or not part.is_element:
        return f"{said}, {length}"
    near, far = (_end(kit, end) for end in part.ends)
    return f"Edge element, {length}, {near} to {far}"


def _end(kit: Kit, end: PartEnd) -> str:
    """What an element ends in: a connector by its name, and if it is turned over."""
    if end.slot is None:
        return "socket" if kit.key == "loose" else "peg"
    joint = kit.joint(end.joint)
    turned = (end.slot in joint.over) != end.over
    name = joint.connectors[end.slot].replace("_", " ")
    return f"{name} turned over" if turned else name
