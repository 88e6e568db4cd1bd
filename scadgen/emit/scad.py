"""The kit as one self-contained OpenSCAD file.

No boolean is left for OpenSCAD: every part is one polyhedron whose vertices it only
evaluates, and every plate or assembly is one polyhedron of many shells.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from scadgen import __version__
from scadgen.emit.scad_numbers import HIGHEST, tubes
from scadgen.emit.scad_parameters import parameter_sets, sections
from scadgen.emit.scad_text import comment, expression, faces, number, quoted, table
from scadgen.emit.shell import in_ascii
from scadgen.emit.templates import environment
from scadgen.errors import InvariantError
from scadgen.frame.placement import Placement
from scadgen.kit.cells import MOST_CELLS, CellPiece, Cells
from scadgen.kit.live import LIVE, PARAMETERS
from scadgen.kit.model import Joint, Kit
from scadgen.kit.roles import COLOURS
from scadgen.solid.affine import AffineSolid

__all__ = ["parameter_sets", "scad"]


def scad(kit: Kit) -> str:
    """Write the kit as an OpenSCAD file, for 2021.01 and newer.

    Parameters
    ----------
    kit
        The kit; nothing in it is trusted to be harmless as text.

    Returns
    -------
    text
        The file, ASCII.

    Raises
    ------
    InvariantError
        If the kit lacks a parameter, a range or a part that its own frame needs.
    """
    _check(kit)
    live = [p for p in PARAMETERS if p in kit.values]
    template_engine = environment()
    template_engine.filters["quoted"] = quoted
    text = template_engine.get_template("kit.scad.j2").render(
        title=f"{comment(kit.name).capitalize()} frame of interlocking edge elements",
        purpose="Parts of a planar truss, a joint, print plates, the whole frame, and a coupon.",
        version=__version__,
        command=comment(in_ascii(kit.command)),
        key=kit.key,
        joints=[_joint(one) for one in kit.joints],
        proved=kit.proved,
        detail=comment(kit.detail),
        file=f"{kit.name}.scad",
        sections=sections(kit),
        live=live,
        index={name: i for i, name in enumerate(live)},
        ranges=[
            {
                "parameter": r.parameter,
                "low": expression(r.low),
                "high": expression(r.high),
                "reason": quoted(r.reason),
            }
            for r in kit.ranges
        ],
        parts=[_part(solid, live) for solid in kit.parts.values()],
        colours=COLOURS,
        elements=kit.elements,
        tubes=tubes(kit),
        highest=HIGHEST,
        first_element=next(iter(kit.parts)),
        regular={"half", "connector"} <= kit.parts.keys(),
        cells=kit.cells and _cells(kit.cells),
        placements=[] if kit.cells else [_placement(p) for p in kit.placements],
        half_side=_half_side(kit),
        most_cells=MOST_CELLS,
    )
    if not text.isascii():
        msg = "an OpenSCAD file is ASCII: this kit's is not"
        raise InvariantError(msg)
    return text


def _check(kit: Kit) -> None:
    """Check what the template counts on."""
    for live in LIVE:
        if not (live.optional or live.name in kit.values):
            msg = f"every kit has the live parameter {live.name}: this one has not"
            raise InvariantError(msg)
    placed = [*kit.placements, *(p for one in kit.joints for p in one.pieces)]
    for name in sorted({p.part for p in placed} - set(kit.parts)):
        msg = f"a kit has every part of its frame: {name} is missing"
        raise InvariantError(msg)
    for name, solid in kit.parts.items():
        for parameter in sorted(set(solid.coefficients) - set(kit.values)):
            msg = f"a part moves with the kit's live parameters only: {name} with {parameter}"
            raise InvariantError(msg)


def _joint(one: Joint) -> Mapping[str, Any]:
    """One kind of joint, as the template writes it."""
    return {
        "name": one.name,
        "title": one.title,
        "view": one.view,
        "weave": comment(", ".join(f"{k} = {v}" for k, v in one.weave.items())),
        "verdicts": {comment(name): comment(found) for name, found in one.verdicts.items()},
        "pieces": [_placement(p) for p in one.pieces],
    }


def _part(solid: AffineSolid, live: list[str]) -> Mapping[str, Any]:
    """One part's tables, as the template writes them; tables without effect left out."""
    tables = [
        {"index": live.index(name), "text": table(factors)}
        for name, factors in solid.coefficients.items()
        if np.any(factors)
    ]
    return {"name": solid.name, "tables": tables, "faces": faces(solid)}


def _placement(p: Placement) -> str:
    return f"[{_piece(p)}]"


def _piece(p: Placement | CellPiece) -> str:
    """What is placed, as what, and how."""
    pose = ", ".join(_vector(v) for v in (p.pose.at, p.pose.x, p.pose.z))
    return f"{quoted(p.part)}, {quoted(p.role)}, {pose}"


def _vector(values: Iterable[float]) -> str:
    return f"[{', '.join(map(number, values))}]"


def _cells(cells: Cells) -> Mapping[str, Any]:
    """What stands in a cell, as the template writes it."""
    offsets = [c for p in cells.pieces for c in p.any_of]
    return {
        "pieces": [
            f"[{_piece(p)}, {[list(c) for c in p.any_of]}, {[list(c) for c in p.none_of]}]"
            for p in cells.pieces
        ],
        "across": _vector((*cells.across, 0.0)),
        "up": _vector((*cells.up, 0.0)),
        "drift": number(cells.drift),
        # A row farther off may be moved back by one cell more.
        "reach": 1 + max(abs(n) for c in offsets for n in c),
    }


def _half_side(kit: Kit) -> int:
    """Tell the side of its edge that half A is on: 1 for y above zero, -1 for below."""
    half = kit.parts[kit.joints[0].pieces[0].part]
    return 1 if half.points(kit.values)[:, 1].mean() > 0 else -1
