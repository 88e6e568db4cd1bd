"""What parts are called in a bill: elements with their length, and what their ends are."""

from __future__ import annotations

import numpy as np

from scadgen.emit.scad_parameters import label
from scadgen.emit.scad_text import literal
from scadgen.kit.model import Kit
from scadgen.solid.affine import AffineSolid, Floats

__all__ = ["lopsided", "words"]

#: Decimals to which points are compared, in mm: those of one shape differ by rounding alone.
_DECIMALS = 5

#: Elements of any frame are called by their ends; others by their name.
_NUMBERED = "edge_"


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
    key_end = "peg end" if kit.key == "fixed" else "socket end"
    found = {name: label(name).replace("peg end", key_end) for name in kit.parts}
    connectors = _connectors(kit)
    for name in _elements(kit):
        times = float(kit.parts[name].coefficients["edge_length"][:, 0].max())
        length = f"{literal(round(times * kit.values['edge_length'], 1))} mm"
        if name.startswith(_NUMBERED):
            near, far = (connectors.get(_arms(end), "socket") for end in _ends(kit, name))
            found[name] = f"Edge element, {length}, {near} to {far}"
        else:
            found[name] += f", {length}"
    return found


def lopsided(kit: Kit) -> set[str]:
    """Edge elements whose ends differ, so that they fit one way round only.

    Parameters
    ----------
    kit
        The kit.
    """
    return {name for name in _elements(kit) if len({_shape(end) for end in _ends(kit, name)}) > 1}


def _elements(kit: Kit) -> list[str]:
    """The edge elements, all of which are as long as edges in kits that scadgen made."""
    return [name for name in kit.elements if "edge_length" in kit.parts[name].coefficients]


def _connectors(kit: Kit) -> dict[bytes, str]:
    """Connectors by the shape of their arms; each is turned over only where that differs."""
    names = sorted({name for one in kit.joints for name in one.connectors} & kit.parts.keys())
    found: dict[bytes, str] = {}
    for how, over in (("", 1.0), (" turned over", -1.0)):
        for name in names:
            points = kit.parts[name].points(kit.values) * (1.0, over, over)
            found.setdefault(_arms(points), name.replace("_", " ") + how)
    return found


def _ends(kit: Kit, name: str) -> tuple[Floats, Floats]:
    """Points of an element's near end and of its far one, each as if it were the near one."""
    solid: AffineSolid = kit.parts[name]
    points = solid.points({**kit.values, "edge_length": 0.0})
    far = solid.coefficients["edge_length"][:, 0] > 0
    return points[~far], points[far] * (-1.0, -1.0, 1.0)


def _arms(points: Floats) -> bytes:
    """The shape of what is before a connector's tube; a bored one has a mouth where that starts."""
    return _shape(points[points[:, 0] < points[:, 0].max() - 10.0**-_DECIMALS])


def _shape(points: Floats) -> bytes:
    """The same for the same points in whatever order."""
    rounded = points.round(_DECIMALS) + 0.0
    return rounded[np.lexsort(rounded.T)].tobytes()
