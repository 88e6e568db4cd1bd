"""The kit as JSON, and back: the interchange format ``kit.json``.

Its schema is ``kit.schema.json`` beside this module.  Numbers keep the decimals that a kit's
solids are rounded to, so a kit read back is the kit that was written.
"""

from __future__ import annotations

import json
import math
import pathlib
from collections.abc import Mapping
from importlib import resources
from typing import Any, NoReturn

import numpy as np

from scadgen import __version__
from scadgen.errors import InputError, InvariantError, KitError
from scadgen.frame.graph import make_frame
from scadgen.frame.keys import Refused
from scadgen.frame.layout import LAYOUTS, bill
from scadgen.frame.placement import Placement
from scadgen.kit.bill import as_json, with_bill
from scadgen.kit.model import Joint, Kit
from scadgen.kit.ranges import check_values
from scadgen.kit.sense import check_sense
from scadgen.kit.ways import read_way, way_entry
from scadgen.solid.affine import PARAMETERS, AffineSolid, Linear, Range
from scadgen.solid.mesh import edge_faults

__all__ = ["FORMAT", "VERSION", "dumps", "load", "loads", "summary"]

FORMAT = "scadgen-kit"
VERSION = 4


def dumps(kit: Kit) -> str:
    """The kit as the text of ``kit.json``; the same kit gives the same text."""
    document = {
        "format": FORMAT,
        "version": VERSION,
        "generator": f"scadgen {__version__}",
        "command": kit.command,
        **_summary(kit, ways=True),
        "ranges": [
            {
                "parameter": r.parameter,
                "low": _linear(r.low),
                "high": _linear(r.high),
                "reason": r.reason,
            }
            for r in kit.ranges
        ],
    }
    if kit.graph is not None:
        vertices, edges = kit.graph.vertices.tolist(), kit.graph.edges.tolist()
        document["graph"] = {"name": kit.graph.name, "vertices": vertices, "edges": edges}
        document["rim"] = kit.rim
        document["refused"] = [
            {"turns": list(one.turns), "keys": list(one.keys)} for one in kit.refused
        ]
        document["placements"] = [_placement(p) for p in kit.placements]
    head = json.dumps(document, indent=1, allow_nan=False).removesuffix("\n}")
    parts = ",\n".join(
        f'  "{name}": {json.dumps(_solid(solid), separators=(",", ":"), allow_nan=False)}'
        for name, solid in kit.parts.items()
    )
    return f'{head},\n "parts": {{\n{parts}\n }}\n}}\n'


def summary(kit: Kit) -> dict[str, Any]:
    """What a kit is, without its solids and its ways, as JSON values."""
    return _summary(kit, ways=False)


def _summary(kit: Kit, *, ways: bool) -> dict[str, Any]:
    return {
        "frame": kit.frame,
        "key": kit.key,
        "rows": kit.rows,
        "columns": kit.columns,
        "detail": kit.detail,
        "values": dict(kit.values),
        "bill": bill(kit.placements, kit.parts),
        "bill_of_materials": as_json(kit),
        "proved": kit.proved,
        "joints": [_joint_entry(joint, ways=ways) for joint in kit.joints],
    }


def _joint_entry(joint: Joint, *, ways: bool) -> dict[str, Any]:
    """A kind of joint as JSON values."""
    entry: dict[str, Any] = {
        "name": joint.name,
        "turns": list(joint.turns),
        "keys": list(joint.keys),
        "caps": list(joint.caps),
        "connectors": list(joint.connectors),
        "over": list(joint.over),
        "weave": dict(joint.weave),
        "pieces": [_placement(p) for p in joint.pieces],
        "figures": dict(joint.figures),
        "verdicts": dict(joint.verdicts),
    }
    return entry | ({"ways": [way_entry(way) for way in joint.ways]} if ways else {})


def _placement(p: Placement) -> dict[str, Any]:
    found = {"part": p.part, "at": list(p.at), "turn": p.turn, "flip": p.flip, "role": p.role}
    return found | ({"joint": p.joint} if p.joint else {})


def _linear(linear: Linear) -> dict[str, Any]:
    return {"terms": dict(linear.terms), "constant": linear.constant}


def _solid(solid: AffineSolid) -> dict[str, Any]:
    points = {name: (factors + 0.0).tolist() for name, factors in solid.coefficients.items()}
    return {
        "points": points,
        "triangles": solid.triangles.tolist(),
        "facets": solid.facets.tolist(),
    }


def load(folder: pathlib.Path) -> Kit:
    """Read the kit in a folder.

    Raises
    ------
    InputError
        There is none.
    KitError
        It is truncated, from another version, or not a sound kit.
    """
    path = folder / "kit.json" if folder.is_dir() else folder
    if path.exists() and path.suffix != ".json":
        msg = f"{path}: must be a kit's folder, which scadgen kit makes, or its kit.json"
        raise InputError(msg)
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        msg = f"{path}: not a kit: byte {error.start} is not UTF-8"
        raise KitError(msg) from error
    except OSError as error:
        msg = (
            f"{path}: no kit can be read there ({error.strerror}); scadgen kit -o FOLDER makes one"
        )
        raise InputError(msg) from error
    try:
        return loads(text)
    except KitError as error:
        msg = f"{path}: {error}"
        raise KitError(msg) from error


def loads(text: str) -> Kit:
    """Read a kit from the text of a ``kit.json``.

    Raises
    ------
    KitError
        It is truncated, from another version, or not a sound kit.
    """
    document = _parsed(text)
    _check_schema(document)
    try:
        kit = _kit(document)
        if missing := {*kit.values} - {r.parameter for r in kit.ranges}:
            _refuse(f"no range for {', '.join(sorted(missing))}")
        check_values(kit.ranges, kit.values)
        check_sense(kit, document)
        # Kits of earlier scadgens have none.
        if "bill_of_materials" in document:
            kit = with_bill(kit, document["bill_of_materials"])
    except (InputError, InvariantError, ValueError, KeyError, TypeError, OverflowError) as error:
        _refuse(str(error))
    return kit


def _refuse(reason: str) -> NoReturn:
    msg = f"not a sound kit: {reason}; make it again with scadgen kit"
    raise KitError(msg)


def _parsed(text: str) -> dict[str, Any]:
    """The JSON object, of our format and version."""
    try:
        document = json.loads(text, parse_constant=_no_constant, parse_float=_finite)
    except (ValueError, RecursionError) as error:
        _refuse(f"truncated or not JSON ({error})")
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        _refuse(f"format is not {FORMAT}")
    if document.get("version") != VERSION:
        msg = (
            f"kit version {document.get('version')!r}: this scadgen {__version__} reads version "
            f"{VERSION}; use the scadgen that made it, or make it again"
        )
        raise KitError(msg)
    return document


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        msg = f"{text} is not a finite number"
        raise ValueError(msg)
    return value


def _no_constant(name: str) -> float:
    msg = f"{name} is not a number"
    raise ValueError(msg)


def _check_schema(document: dict[str, Any]) -> None:
    from jsonschema import Draft202012Validator
    from jsonschema.exceptions import best_match

    schema = json.loads(resources.files(__package__).joinpath("kit.schema.json").read_text("utf-8"))
    error = best_match(Draft202012Validator(schema).iter_errors(document))
    if error is not None:
        where = "/".join(map(str, error.absolute_path)) or "top"
        _refuse(f"at {where}: {error.message[:120]}")


def _kit(document: dict[str, Any]) -> Kit:
    parts = {name: _read_solid(name, entry) for name, entry in document["parts"].items()}
    frame, key = document["frame"], document["key"]
    rows, columns = int(document["rows"]), int(document["columns"])
    graph = document.get("graph")
    if graph is None:
        if frame not in LAYOUTS:
            msg = f"frame {frame!r}: has no graph, and is not one of {', '.join(LAYOUTS)}"
            raise ValueError(msg)
        placements = LAYOUTS[frame](rows, columns, key)
    else:
        placements = tuple(map(_read_placement, document["placements"]))
    return Kit(
        frame=frame,
        key=key,
        rows=rows,
        columns=columns,
        detail=document["detail"],
        command=document["command"],
        values={p: document["values"][p] for p in PARAMETERS if p in document["values"]},
        ranges=tuple(
            Range(r["parameter"], Linear(**r["low"]), Linear(**r["high"]), r["reason"])
            for r in document["ranges"]
        ),
        parts=parts,
        joints=tuple(map(_read_joint, document["joints"])),
        placements=placements,
        graph=graph and make_frame(graph["name"], graph["vertices"], graph["edges"]),
        rim=document.get("rim", "caps"),
        refused=tuple(
            Refused(tuple(one["turns"]), tuple(one["keys"])) for one in document.get("refused", ())
        ),
    )


def _read_joint(entry: Mapping[str, Any]) -> Joint:
    return Joint(
        name=entry["name"],
        turns=tuple(entry["turns"]),
        keys=tuple(entry["keys"]),
        caps=tuple(entry["caps"]),
        connectors=tuple(entry["connectors"]),
        over=tuple(entry["over"]),
        weave=entry["weave"],
        pieces=tuple(map(_read_placement, entry["pieces"])),
        figures=entry["figures"],
        verdicts=entry["verdicts"],
        ways=tuple(read_way(way) for way in entry["ways"]),
    )


def _read_placement(p: Mapping[str, Any]) -> Placement:
    at = p["at"][0], p["at"][1]
    return Placement(p["part"], at, p["turn"], p["flip"], p["role"], p.get("joint", ""))


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
