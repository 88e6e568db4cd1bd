"""Checks of a kit's solids that need no CAD tool."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from scadgen.check.result import Result
from scadgen.errors import ScadgenError
from scadgen.frame.placement import Placement
from scadgen.joint.joint import (
    DETAILS,
    Detail,
    Joint,
    check_footprint,
    make_joint,
    site_curves,
)
from scadgen.joint.lattice import Lattice, make_lattice, without_corners
from scadgen.joint.tidy import corners_in_the_way
from scadgen.joint.weave import SiteCurve, Weave
from scadgen.kit.build import Request, build
from scadgen.kit.model import Kit
from scadgen.kit.store import dumps
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.gap import overlap_volume, smallest_gap
from scadgen.solid.mesh import solid_faults, volume

__all__ = [
    "CLEARANCES",
    "closed",
    "footprint",
    "gaps",
    "joint_of",
    "lattice_of",
    "partition",
    "placed",
    "same",
    "sampling",
]

#: Clearances at which the gaps are measured, in sides: 0.05, 0.1, 0.2 and 0.4 mm at side 10 mm;
#: proportionally less in a kit whose range ends earlier.
CLEARANCES = (0.005, 0.01, 0.02, 0.04)

#: How far a gap may be from the clearance, as a share of it.
_GAP = 0.1

#: Relative difference of volumes that should be the same.
_VOLUME = 1e-9

#: How far a wall may move when samples and cells double, in sides.
_WALL = {"draft": 0.008, "standard": 0.002, "fine": 0.0007}


def placed(kit: Kit, placement: Placement, values: Mapping[str, float]) -> tuple[Floats, Ints]:
    """A part's mesh where it stands."""
    solid = kit.parts[placement.part]
    points = solid.points(values) * ([1.0, -1.0, -1.0] if placement.flip else [1.0, 1.0, 1.0])
    angle = math.radians(placement.turn)
    c, s = math.cos(angle), math.sin(angle)
    points = points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return points + values["edge_length"] * np.array([*placement.at, 0.0]), solid.triangles


def same(kit: Kit) -> Result:
    """Whether the kit is what its own parameters make."""
    request = Request(
        kit.frame,
        kit.key,
        kit.rows,
        kit.columns,
        kit.detail,
        _weave(kit),
        {**kit.values},
        kit.command,
    )
    equal = dumps(replace(build(request), verdicts=kit.verdicts, ways=kit.ways)) == dumps(kit)
    return Result(
        "the parameters make this kit",
        equal,
        "same bytes" if equal else "other bytes",
        "same bytes",
    )


def closed(kit: Kit) -> Iterator[Result]:
    """Whether each part is one sound solid, at its values and at the ends of its ranges."""
    settings = [dict(kit.values), *_extremes(kit)]
    for name, solid in kit.parts.items():
        faults = [
            fault
            for values in settings
            for fault in solid_faults(solid.points(values), solid.triangles)
        ]
        figure = faults[0] if faults else f"{len(solid.triangles)} triangles"
        yield Result(
            f"{name} is one sound solid", not faults, figure, f"at {len(settings)} settings"
        )


def _extremes(kit: Kit) -> Iterator[dict[str, float]]:
    """Settings with one parameter at an end of its range, where the others' ranges allow it."""
    for name in kit.values:
        limits = [r for r in kit.ranges if r.parameter == name]
        low = max(r.low(kit.values) for r in limits)
        high = min(r.high(kit.values) for r in limits)
        for end in (low, high):
            values = {**kit.values, name: end}
            if all(
                r.low(values) - 1e-9 <= values[r.parameter] <= r.high(values) + 1e-9
                for r in kit.ranges
            ):
                yield values


def partition(kit: Kit) -> Iterator[Result]:
    """Whether the connectors make up the domain, and the halves their connector."""
    values = {**kit.values, "side": 1.0, "clearance": 0.0, "peg_clearance": 0.0}
    values |= {"peg_width": 0.3, "peg_length": 0.4, "bore": 0.1 if "bore" in kit.values else 0.0}
    start, pad = kit.figures["tube_start_sides"], kit.figures["pad_sides"]
    bore = values["bore"] ** 2 * (start - pad)
    whole, half = (
        volume(kit.parts[n].points(values), kit.parts[n].triangles) for n in ("connector", "half")
    )
    count = kit.valence
    domain = kit.figures["domain_volume_sides3"]
    off = abs(count * (whole + bore) / domain - 1)
    yield Result("connectors make up the domain", off < _VOLUME, f"{off:.1e} off", f"{_VOLUME:g}")
    deep = start - pad if kit.key == "loose" else values["peg_length"]
    socket = values["peg_width"] ** 2 * deep + values["bore"] ** 2 * (start - pad - deep)
    off = abs((2 * half + socket) / (whole + bore) - 1)
    yield Result("halves make up a connector", off < _VOLUME, f"{off:.1e} off", f"{_VOLUME:g}")


def footprint(kit: Kit) -> Result:
    """Whether a tube's face belongs to its connector alone, proven from the curves."""
    made = joint_of(kit, DETAILS[kit.detail])
    try:
        check_footprint(made.lattice, made.curves, 0)
    except ScadgenError as error:
        return Result(
            "a tube's face is its connector's", good=False, figure=str(error), bound="100 %"
        )
    return Result("a tube's face is its connector's", good=True, figure="proven", bound="100 %")


def gaps(kit: Kit) -> Iterator[Result]:
    """Whether all pieces at a joint that mate are one clearance apart, and none overlap."""
    side = kit.values["side"]
    touching = {pair for pair, gap in _gaps(kit, 1e-3 * side).items() if gap < 2e-3 * side}
    limit = min(r.high(kit.values) for r in kit.ranges if r.parameter == "clearance")
    scale = min(side, limit / max(CLEARANCES))
    for share in CLEARANCES:
        clearance = share * scale
        name = f"gap at clearance {clearance:g} mm"
        found = _gaps(kit, clearance)
        ratios = [found[pair] / clearance for pair in touching]
        good = min(ratios) > 1 - _GAP and max(ratios) < 1 + _GAP and min(found.values()) > 0
        figure = f"{min(ratios):.3f} to {max(ratios):.3f} of it, {len(touching)} mating pairs"
        yield Result(name, good, figure, f"{1 - _GAP:g} to {1 + _GAP:g}")
        common = max(_overlaps(kit, clearance))
        yield Result(
            f"overlap at clearance {clearance:g} mm", common <= 0, f"{common:g} mm3", "none"
        )


def _at(kit: Kit, clearance: float) -> dict[str, float]:
    return {**kit.values, "clearance": clearance, "peg_clearance": clearance}


def _gaps(kit: Kit, clearance: float) -> dict[tuple[int, int], float]:
    """Smallest gap between each two pieces of the joint, in mm; 2 sides if they are farther."""
    meshes = [placed(kit, p, _at(kit, clearance)) for p in kit.joint]
    pairs = itertools.combinations(range(len(meshes)), 2)
    far = 2 * kit.values["side"]
    return {(a, b): smallest_gap(*meshes[a], *meshes[b], far) for a, b in pairs}


def _overlaps(kit: Kit, clearance: float) -> Iterator[float]:
    """Volume that each two pieces of the joint share, in cubic mm."""
    meshes = [placed(kit, p, _at(kit, clearance)) for p in kit.joint]
    for a, b in itertools.combinations(meshes, 2):
        yield overlap_volume(*a, *b)


def sampling(kit: Kit) -> Iterator[Result]:
    """How far walls and volumes move when samples double, and what the lattice leaves out."""
    detail, bound = DETAILS[kit.detail], _WALL[kit.detail]
    once = joint_of(kit, detail)
    twice = joint_of(kit, Detail(2 * detail.samples, detail.cells))
    first, second = once.connectors[0], twice.connectors[0]
    same_walls = first.walls.shape == second.walls.shape and bool(
        (first.walls == second.walls).all()
    )
    moved = float(np.abs(first.points - second.points).max()) if same_walls else math.inf
    figure = f"{moved:.1e} sides" if same_walls else "other walls"
    yield Result("walls move when samples double", moved < bound, figure, f"{bound:g} sides")
    off = _off_wall(once)
    figure = f"{off.mean():.5f} sides on average, {off.max():.4f} at most"
    yield Result(
        "faces' distance from the exact walls",
        bool(off.mean() < bound),
        figure,
        f"{bound:g} on average",
    )


def _off_wall(made: Joint) -> Floats:
    """Distance of the walls' faces from the exact walls, at their middles and their sides'."""
    connector = made.connectors[0]
    weights = np.array([[1, 1, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]]) / [[3], [2], [2], [2]]
    points = np.einsum("qk,tkx->tqx", weights, connector.points[connector.walls]).reshape(-1, 3)
    found = [curve.distance(points) for curve in made.curves]
    far, slope = np.stack([d for d, _ in found]), np.stack([g for _, g in found])
    near, next_ = np.argsort(far, axis=0)[:2]
    row = np.arange(len(points))
    steep = np.linalg.norm(slope[next_, row] - slope[near, row], axis=1)
    return np.asarray((far[next_, row] - far[near, row]) / steep)


def _weave(kit: Kit) -> Weave:
    return Weave.from_dict(dict(kit.weave), str(kit.weave["name"]))


def joint_of(kit: Kit, detail: Detail) -> Joint:
    """The kit's joint at some detail, on the kit's own lattice."""
    return make_joint(_edges(kit), _weave(kit), detail, int(kit.figures["lattice_extra"]))


def lattice_of(kit: Kit, detail: Detail) -> tuple[Lattice, tuple[SiteCurve, ...]]:
    """Its lattice and its site curves alone."""
    weave, extra = _weave(kit), int(kit.figures["lattice_extra"])
    lattice = make_lattice(_edges(kit), weave.ring_ratio, detail.cells, extra)
    curves = site_curves(lattice.edges, weave, detail.samples)
    return without_corners(lattice, corners_in_the_way(lattice, curves)), curves


def _edges(kit: Kit) -> list[float]:
    return [2 * math.pi * n / kit.valence for n in range(kit.valence)]
