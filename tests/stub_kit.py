"""A small kit made by hand: boxes and square prisms, with the names of the real parts.

Nothing here locks; it is for tests of what comes after the geometry.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from kits import kit as real_kit

from scadgen.kit.build import laid_out
from scadgen.kit.live import PARAMETERS
from scadgen.kit.model import Kit, Part
from scadgen.solid.affine import AffineSolid, Linear, Range

Term = Mapping[str, float]
#: One square cross-section: its x, its half width, and its middle's y.
Section = tuple[Term, Term, Term]

DEFAULTS = {
    "side": 10.0,
    "edge_length": 80.0,
    "clearance": 0.2,
    "peg_width": 4.0,
    "peg_length": 7.5,
    "peg_clearance": 0.1,
    "peg_chamfer": 0.6,
    "bore": 5.0,
}
COMMAND = "scadgen kit hexagonal --rows 2 --columns 3 -o out/hexagonal"


def loft(name: str, sections: Sequence[Section]) -> AffineSolid:
    """Prism through square sections, first to last along +x, closed at both ends."""
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    rows: list[dict[str, tuple[float, float, float]]] = []
    for x, half, middle in sections:
        rows += [
            {
                p: (
                    x.get(p, 0.0),
                    middle.get(p, 0.0) + sy * half.get(p, 0.0),
                    sz * half.get(p, 0.0),
                )
                for p in PARAMETERS
            }
            for sy, sz in corners
        ]
    used = [p for p in PARAMETERS if any(any(row[p]) for row in rows)]
    coefficients = {p: np.array([row[p] for row in rows]) for p in used}
    quads = [(3, 2, 1, 0)]
    for ring in range(0, 4 * (len(sections) - 1), 4):
        quads += [
            (ring + i, ring + (i + 1) % 4, ring + 4 + (i + 1) % 4, ring + 4 + i) for i in range(4)
        ]
    last = 4 * (len(sections) - 1)
    quads.append((last, last + 1, last + 2, last + 3))
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    return AffineSolid(name, coefficients, triangles, np.arange(len(triangles)) // 2)


def _add(*terms: Term) -> dict[str, float]:
    total: dict[str, float] = {}
    for term in terms:
        for name, factor in term.items():
            total[name] = total.get(name, 0.0) + factor
    return total


def _times(factor: float, term: Term) -> dict[str, float]:
    return {name: factor * f for name, f in term.items()}


def _peg(base: Term, direction: int) -> list[Section]:
    """Sections of a peg standing on `base`, pointing along +x or -x, base first."""
    width, chamfer = {"peg_width": 0.5}, {"peg_chamfer": 1.0}
    tip = _add(base, {"peg_length": direction})
    shoulder = _add(tip, _times(-direction, chamfer))
    return [
        (base, width, {}),
        (shoulder, width, {}),
        (tip, _add(width, _times(-1, chamfer)), {}),
    ]


def _solids() -> dict[str, AffineSolid]:
    wide: Term = {"side": 0.5}
    start, stop = {"side": 2.0}, {"edge_length": 1.0, "side": -2.0}
    inner, outer = {"side": 0.7, "clearance": 0.5}, {"side": 2.0}
    far_inner = {"edge_length": 1.0, "side": -0.7, "clearance": -0.5}
    slim = {"side": 0.25, "clearance": -0.25}
    parts = {
        "basic": [(inner, wide, {}), (far_inner, wide, {})],
        "one_sided": [(inner, wide, {}), (stop, wide, {}), *_peg(stop, 1)],
        "two_sided": [*_peg(start, -1)[::-1], (start, wide, {}), (stop, wide, {}), *_peg(stop, 1)],
        "connector": [(inner, wide, {}), (outer, wide, {})],
        "half": [(inner, slim, {"side": 0.25}), (outer, slim, {"side": 0.25})],
        "peg": _peg(inner, 1),
    }
    return {name: loft(name, sections) for name, sections in parts.items()}


def ranges(values: Mapping[str, float]) -> tuple[Range, ...]:
    """Ranges of the stub's live parameters, some depending on others."""
    everything = (
        Range("side", Linear({}, 4.0), Linear({"edge_length": 0.2}), "the joints would meet"),
        Range("edge_length", Linear({"side": 5.0}), Linear({}, 400.0), "the joints would meet"),
        Range("clearance", Linear({}, 0.02), Linear({"side": 0.04}), "walls would fold over"),
        Range("peg_width", Linear({}, 1.2), Linear({"side": 0.6}), "no wall beside the socket"),
        Range("peg_length", Linear({"side": 0.2}), Linear({"side": 1.0}), "no room in the ring"),
        Range("peg_clearance", Linear({}, 0.0), Linear({}, 0.5), "the peg would rattle"),
        Range("peg_chamfer", Linear({}, 0.1), Linear({"peg_width": 0.25}), "no flat tip"),
        Range("bore", Linear({}, 0.4), Linear({"side": 1.0}, -1.6), "walls under two lines"),
    )
    return tuple(r for r in everything if r.parameter in values)


def stub_kit(
    frame: str = "hexagonal",
    *,
    key: str = "fixed",
    bore: bool = True,
    rows: int = 2,
    columns: int = 3,
    command: str = COMMAND,
) -> Kit:
    """Kit of hand-made parts."""
    values = {p: v for p, v in DEFAULTS.items() if bore or p != "bore"}
    cross = {"hexagonal": "two_sided", "square": "one_sided"}[frame]
    parts = _solids()
    if bore:
        parts["tube"] = loft("tube", [({}, {"bore": 0.5}, {}), ({"side": 2.0}, {"side": 0.5}, {})])
    names = ("basic", cross, "connector", "half", "peg", *(["tube"] if bore else []))
    real = real_kit(frame, key)
    stub = replace(
        real,
        detail="stub",
        command=command,
        values=values,
        ranges=ranges(values),
        parts={name: as_part(real.parts[name], parts[name]) for name in names},
        joints=(
            replace(
                real.joints[0],
                weave={"name": "stub", "ring_ratio": 1.5},
                figures={"play_mm_per_mm": 12.0},
            ),
        ),
    )
    return laid_out(stub, rows, columns)


def as_part(part: Part, solid: AffineSolid) -> Part:
    """Another solid in a part's place."""
    return Part.of(solid, part.role, part.ends, part.length)


def with_joint(kit: Kit, **changes: Any) -> Kit:
    """The kit with its first joint changed."""
    first, *others = kit.joints
    return replace(kit, joints=(replace(first, **changes), *others))
