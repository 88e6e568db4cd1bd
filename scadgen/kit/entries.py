"""The values of a kit as JSON, and back: poses, placements, cells, joints, parts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from scadgen.element.squares import Key
from scadgen.frame.placement import Place, Placement
from scadgen.kit.cells import CellEnd, CellPiece, Cells, CellVertex
from scadgen.kit.model import Joint, Part, PartEnd
from scadgen.kit.ways import read_way, way_entry
from scadgen.solid.affine import AffineSolid, Linear
from scadgen.solid.mesh import edge_faults
from scadgen.solid.pose import Pose, Vector

__all__ = [
    "cells_entry",
    "joint_entry",
    "linear_entry",
    "part_entry",
    "placement_entry",
    "pose_entry",
    "read_cells",
    "read_joint",
    "read_part",
    "read_placement",
    "read_pose",
]

#: How far axes may be from square, and from one long: rounding.
_SQUARE = 1e-9


def pose_entry(pose: Pose) -> dict[str, Any]:
    """A pose as JSON values."""
    return {"at": list(pose.at), "x": list(pose.x), "z": list(pose.z)}


def placement_entry(p: Placement) -> dict[str, Any]:
    """A placement as JSON values."""
    found = {
        "part": p.part,
        "role": p.role,
        **pose_entry(p.pose),
        "ends": [list(end) for end in p.ends],
    }
    return found | ({} if p.edge is None else {"edge": p.edge})


def cells_entry(cells: Cells) -> dict[str, Any]:
    """What stands in a cell as JSON values."""
    return {
        "across": list(cells.across),
        "up": list(cells.up),
        "drift": cells.drift,
        "vertices": [
            {"joint": v.joint, **pose_entry(v.pose), "any_of": [list(c) for c in v.any_of]}
            for v in cells.vertices
        ],
        "pieces": [
            {
                "part": p.part,
                "role": p.role,
                **pose_entry(p.pose),
                "ends": [[end.vertex, *end.cell, end.slot] for end in p.ends],
                "any_of": [list(c) for c in p.any_of],
                "none_of": [list(c) for c in p.none_of],
            }
            for p in cells.pieces
        ],
    }


def joint_entry(joint: Joint, *, ways: bool) -> dict[str, Any]:
    """A kind of joint as JSON values."""
    entry: dict[str, Any] = {
        "name": joint.name,
        "turns": list(joint.turns),
        "keys": list(joint.keys),
        "caps": list(joint.caps),
        "connectors": list(joint.connectors),
        "over": list(joint.over),
        "weave": dict(joint.weave),
        "key": asdict(joint.key),
        "pieces": [placement_entry(p) for p in joint.pieces],
        "figures": dict(joint.figures),
        "verdicts": dict(joint.verdicts),
    }
    return entry | ({"ways": [way_entry(way) for way in joint.ways]} if ways else {})


def linear_entry(linear: Linear) -> dict[str, Any]:
    """A linear expression as JSON values."""
    return {"terms": dict(linear.terms), "constant": linear.constant}


def part_entry(part: Part) -> dict[str, Any]:
    """A part as JSON values."""
    points = {name: (factors + 0.0).tolist() for name, factors in part.coefficients.items()}
    return {
        "role": part.role,
        "ends": [asdict(end) for end in part.ends],
        "length": part.length,
        "points": points,
        "triangles": part.triangles.tolist(),
        "facets": part.facets.tolist(),
    }


def read_pose(entry: Mapping[str, Any]) -> Pose:
    """A pose from JSON values.

    Raises
    ------
    ValueError
        Its axes are not unit vectors square to each other.
    """
    at, x, z = (_vector(entry[name]) for name in ("at", "x", "z"))
    pose = Pose(at, x, z)
    if not np.allclose(pose.axes @ pose.axes.T, np.eye(3), rtol=0, atol=_SQUARE):
        msg = f"a pose with axes x = {list(x)}, z = {list(z)}: must be unit vectors, square"
        raise ValueError(msg)
    return pose


def _vector(entry: Sequence[float]) -> Vector:
    x, y, z = map(float, entry)
    return x, y, z


def read_placement(p: Mapping[str, Any]) -> Placement:
    """A placement from JSON values."""
    ends = tuple(Place(*end) for end in p["ends"])
    return Placement(p["part"], p["role"], read_pose(p), ends, p.get("edge"))


def read_cells(entry: Mapping[str, Any]) -> Cells:
    """What stands in a cell, from JSON values."""
    return Cells(
        across=(entry["across"][0], entry["across"][1]),
        up=(entry["up"][0], entry["up"][1]),
        drift=entry["drift"],
        vertices=tuple(
            CellVertex(v["joint"], read_pose(v), _read_places(v["any_of"]))
            for v in entry["vertices"]
        ),
        pieces=tuple(
            CellPiece(
                p["part"],
                p["role"],
                read_pose(p),
                tuple(CellEnd(vertex, (i, j), slot) for vertex, i, j, slot in p["ends"]),
                _read_places(p["any_of"]),
                _read_places(p["none_of"]),
            )
            for p in entry["pieces"]
        ),
    )


def _read_places(entry: Sequence[Sequence[int]]) -> tuple[tuple[int, int], ...]:
    return tuple((i, j) for i, j in entry)


def read_joint(entry: Mapping[str, Any]) -> Joint:
    """A kind of joint from JSON values."""
    return Joint(
        name=entry["name"],
        turns=tuple(entry["turns"]),
        keys=tuple(entry["keys"]),
        caps=tuple(entry["caps"]),
        connectors=tuple(entry["connectors"]),
        over=tuple(entry["over"]),
        weave=entry["weave"],
        key=Key(**entry["key"]),
        pieces=tuple(map(read_placement, entry["pieces"])),
        figures=entry["figures"],
        verdicts=entry["verdicts"],
        ways=tuple(read_way(way) for way in entry["ways"]),
    )


def read_part(name: str, entry: Mapping[str, Any]) -> Part:
    """A part from JSON values.

    Raises
    ------
    ValueError
        Its tables are not finite numbers of the right shape, or not a closed surface.
    """
    ends = tuple(PartEnd(**end) for end in entry["ends"])
    return Part.of(_read_solid(name, entry), entry["role"], ends, entry["length"])


def _read_solid(name: str, entry: Mapping[str, Any]) -> AffineSolid:
    """A solid from its tables.

    Raises
    ------
    ValueError
        They are not finite numbers of the right shape, or not a closed surface.
    """
    points = {p: np.array(rows, dtype=np.float64) for p, rows in entry["points"].items()}
    triangles = np.array(entry["triangles"])
    facets = np.array(entry["facets"])
    count = {table.shape for table in points.values()}
    shapes = len(count) == 1 and all(len(shape) == 2 and shape[1] == 3 for shape in count)
    whole = triangles.dtype.kind == "i" and facets.dtype.kind == "i"
    if (
        not shapes
        or not whole
        or triangles.shape[1:] != (3,)
        or facets.shape != triangles.shape[:1]
    ):
        msg = f"part {name}: tables of the wrong shape"
        raise ValueError(msg)
    if triangles.min() < 0 or triangles.max() >= count.pop()[0] or len(edge_faults(triangles)):
        msg = f"part {name}: its triangles are not a closed surface"
        raise ValueError(msg)
    if not all(math.isfinite(table.sum()) for table in points.values()):
        msg = f"part {name}: a coordinate is not a finite number"
        raise ValueError(msg)
    return AffineSolid(name, points, triangles.astype(np.int64), facets.astype(np.int64))
