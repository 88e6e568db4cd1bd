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
from scadgen.joint.curve import SiteCurve
from scadgen.joint.joint import (
    DETAILS,
    Decomposition,
    Detail,
    check_footprint,
    fitted,
    make_joint,
)
from scadgen.joint.lattice import Lattice
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import Weave
from scadgen.kit.build import Request, build
from scadgen.kit.model import Joint, Kit
from scadgen.kit.store import dumps
from scadgen.solid.affine import AffineSolid, Floats, Ints
from scadgen.solid.gap import overlap_volume, smallest_gap
from scadgen.solid.mesh import solid_faults, volume
from scadgen.solid.pose import Pose

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
    "standing",
    "weave_of",
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
    return standing(kit.parts[placement.part], placement.pose, values)


def standing(solid: AffineSolid, pose: Pose, values: Mapping[str, float]) -> tuple[Floats, Ints]:
    """A solid's mesh where a pose, in edge lengths, puts it."""
    return pose.scaled(values["edge_length"]).apply(solid.points(values)), solid.triangles


def same(kit: Kit) -> Result:
    """Whether the kit is what its own parameters make."""
    regular = kit.tiling is not None and kit.tiling.regular
    request = Request(
        kit.name,
        frame=None if kit.tiling else kit.frame,
        tiling=kit.tiling,
        rows=kit.rows,
        columns=kit.columns,
        key=kit.key,
        detail=kit.detail,
        weave=weave_of(kit.joints[0]) if regular else None,
        regular=regular,
        values={**kit.values},
        command=kit.command,
        rim=kit.rim,
        refused=kit.refused,
    )
    made = build(request)
    pairs = zip(made.joints, kit.joints, strict=False)
    joints = tuple(replace(a, verdicts=b.verdicts, ways=b.ways) for a, b in pairs)
    made = replace(made, joints=joints, material=kit.material, slicing=kit.slicing)
    equal = dumps(made) == dumps(kit)
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


def partition(kit: Kit, joint: Joint) -> Iterator[Result]:
    """Whether the connectors make up the domain, and the halves their connector."""
    values = {**kit.values, "side": 1.0, "clearance": 0.0, "peg_clearance": 0.0}
    values |= {"peg_width": 0.3, "peg_length": 0.4, "bore": 0.1 if "bore" in kit.values else 0.0}
    start, pad = joint.key.tube_start, joint.key.pad
    bore = values["bore"] ** 2 * (start - pad)
    content = {
        name: volume(kit.parts[name].points(values), kit.parts[name].triangles)
        for name in {*joint.connectors, *joint.half_parts}
    }
    domain = joint.figures["domain_volume_sides3"]
    off = abs(sum(content[name] + bore for name in joint.connectors) / domain - 1)
    yield Result("connectors make up the domain", off < _VOLUME, f"{off:.1e} off", f"{_VOLUME:g}")
    deep = start - pad if kit.key == "loose" else values["peg_length"]
    socket = values["peg_width"] ** 2 * deep + values["bore"] ** 2 * (start - pad - deep)
    parts = [p.part for p in joint.pieces if p.role in ("half_a", "half_b")]
    pairs = zip(joint.keys, parts[::2], parts[1::2], strict=True)
    off = max(
        abs((content[a] + content[b] + socket) / (content[joint.connectors[edge]] + bore) - 1)
        for edge, a, b in pairs
    )
    yield Result("halves make up a connector", off < _VOLUME, f"{off:.1e} off", f"{_VOLUME:g}")


def footprint(kit: Kit, joint: Joint) -> Result:
    """Whether each tube's face belongs to its connector alone, proven from the curves."""
    lattice, curves = lattice_of(joint, DETAILS[kit.detail])
    try:
        for edge in range(len(joint.turns)):
            check_footprint(lattice, curves, edge)
    except ScadgenError as error:
        return Result(
            "a tube's face is its connector's", good=False, figure=str(error), bound="100 %"
        )
    return Result("a tube's face is its connector's", good=True, figure="proven", bound="100 %")


def gaps(kit: Kit, joint: Joint) -> Iterator[Result]:
    """Whether all pieces at a joint that mate are one clearance apart, and none overlap."""
    side = kit.values["side"]
    touching = {pair for pair, gap in _gaps(kit, joint, 1e-3 * side).items() if gap < 2e-3 * side}
    limit = min(r.high(kit.values) for r in kit.ranges if r.parameter == "clearance")
    scale = min(side, limit / max(CLEARANCES))
    for share in CLEARANCES:
        clearance = share * scale
        name = f"gap at clearance {clearance:g} mm"
        found = _gaps(kit, joint, clearance)
        ratios = [found[pair] / clearance for pair in touching]
        good = min(ratios) > 1 - _GAP and max(ratios) < 1 + _GAP and min(found.values()) > 0
        figure = f"{min(ratios):.3f} to {max(ratios):.3f} of it, {len(touching)} mating pairs"
        yield Result(name, good, figure, f"{1 - _GAP:g} to {1 + _GAP:g}")
        common = max(_overlaps(kit, joint, clearance))
        yield Result(
            f"overlap at clearance {clearance:g} mm", common <= 0, f"{common:g} mm3", "none"
        )


def _at(kit: Kit, clearance: float) -> dict[str, float]:
    return {**kit.values, "clearance": clearance, "peg_clearance": clearance}


def _gaps(kit: Kit, joint: Joint, clearance: float) -> dict[tuple[int, int], float]:
    """Smallest gap between each two pieces of the joint, in mm; 2 sides if they are farther."""
    meshes = [placed(kit, p, _at(kit, clearance)) for p in joint.pieces]
    pairs = itertools.combinations(range(len(meshes)), 2)
    far = 2 * kit.values["side"]
    return {(a, b): smallest_gap(*meshes[a], *meshes[b], far) for a, b in pairs}


def _overlaps(kit: Kit, joint: Joint, clearance: float) -> Iterator[float]:
    """Volume that each two pieces of the joint share, in cubic mm."""
    meshes = [placed(kit, p, _at(kit, clearance)) for p in joint.pieces]
    for a, b in itertools.combinations(meshes, 2):
        yield overlap_volume(*a, *b)


def sampling(kit: Kit, joint: Joint) -> Iterator[Result]:
    """How far walls and volumes move when samples double, and what the lattice leaves out."""
    detail, bound = DETAILS[kit.detail], _WALL[kit.detail]
    once = joint_of(joint, detail)
    twice = joint_of(joint, Detail(2 * detail.samples, detail.cells))
    pairs = list(zip(once.connectors, twice.connectors, strict=True))
    same_walls = all(np.array_equal(first.walls, second.walls) for first, second in pairs)
    moved = (
        max(float(np.abs(first.points - second.points).max()) for first, second in pairs)
        if same_walls
        else math.inf
    )
    figure = f"{moved:.1e} sides" if same_walls else "other walls"
    yield Result("walls move when samples double", moved < bound, figure, f"{bound:g} sides")
    off = np.concatenate([_off_wall(once, edge) for edge in range(len(once.connectors))])
    figure = f"{off.mean():.5f} sides on average, {off.max():.4f} at most"
    yield Result(
        "faces' distance from the exact walls",
        bool(off.mean() < bound),
        figure,
        f"{bound:g} on average",
    )


def _off_wall(made: Decomposition, edge: int) -> Floats:
    """Distance of a connector's walls' faces from the exact walls, at middles and sides'."""
    connector = made.connectors[edge]
    weights = np.array([[1, 1, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]]) / [[3], [2], [2], [2]]
    points = np.einsum("qk,tkx->tqx", weights, connector.points[connector.walls]).reshape(-1, 3)
    found = [curve.distance(points @ made.curves[edge].turn) for curve in made.curves]
    far, slope = np.stack([d for d, _ in found]), np.stack([g for _, g in found])
    near, next_ = np.argsort(far, axis=0)[:2]
    row = np.arange(len(points))
    steep = np.linalg.norm(slope[next_, row] - slope[near, row], axis=1)
    return np.asarray((far[next_, row] - far[near, row]) / steep)


def weave_of(joint: Joint) -> Weave:
    """The weave of a kind of joint."""
    return Weave.from_dict(dict(joint.weave), str(joint.weave["name"]))


def joint_of(joint: Joint, detail: Detail) -> Decomposition:
    """A kind of joint made anew at some detail, on its own lattice."""
    extra = int(joint.figures["lattice_extra"])
    return make_joint(Spokes.flat(joint.directions), weave_of(joint), detail, extra, joint.keys)


def lattice_of(joint: Joint, detail: Detail) -> tuple[Lattice, tuple[SiteCurve, ...]]:
    """Its lattice, with all corners, and its site curves alone."""
    weave, extra = weave_of(joint), int(joint.figures["lattice_extra"])
    lattice, curves, _ = fitted(Spokes.flat(joint.directions), weave, detail, extra, joint.keys)
    return lattice, curves
