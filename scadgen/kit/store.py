"""The kit as JSON, and back: the interchange format ``kit.json``.

Its schema is ``kit.schema.json`` beside this module.  Numbers keep the decimals that a kit's
solids are rounded to, so a kit read back is the kit that was written.
"""

from __future__ import annotations

import json
import math
import pathlib
from dataclasses import replace
from importlib import resources
from typing import Any, NoReturn

from scadgen import __version__
from scadgen.errors import InputError, InvariantError, KitError
from scadgen.frame.placement import bill
from scadgen.frame.slots import Refused
from scadgen.kit.bill import as_json, with_bill
from scadgen.kit.build import laid_out
from scadgen.kit.entries import (
    cells_entry,
    joint_entry,
    linear_entry,
    part_entry,
    placement_entry,
    pose_entry,
    read_cells,
    read_joint,
    read_part,
    read_placement,
    read_pose,
)
from scadgen.kit.live import PARAMETERS
from scadgen.kit.model import Kit, Vertex
from scadgen.kit.ranges import check_values
from scadgen.kit.validate import validate
from scadgen.plane.catalogue import NamedTiling
from scadgen.plane.drawn import make_frame
from scadgen.solid.affine import Linear, Range

__all__ = ["FORMAT", "VERSION", "dumps", "load", "loads", "summary"]

FORMAT = "scadgen-kit"
VERSION = 5


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
                "low": linear_entry(r.low),
                "high": linear_entry(r.high),
                "reason": r.reason,
            }
            for r in kit.ranges
        ],
    }
    if kit.cells is not None and kit.tiling is not None:
        document["tiling"] = {"name": kit.tiling.name, "options": dict(kit.tiling.options)}
        document["cells"] = cells_entry(kit.cells)
    elif kit.frame is not None:
        document["frame"] = {
            "name": kit.frame.name,
            "vertices": kit.frame.plan.tolist(),
            "edges": kit.frame.edges.tolist(),
        }
        document["vertices"] = [{"joint": v.joint} | pose_entry(v.pose) for v in kit.vertices]
        document["placements"] = [placement_entry(p) for p in kit.placements]
    head = json.dumps(document, indent=1, allow_nan=False).removesuffix("\n}")
    parts = ",\n".join(
        f'  "{name}": {json.dumps(part_entry(part), separators=(",", ":"), allow_nan=False)}'
        for name, part in kit.parts.items()
    )
    return f'{head},\n "parts": {{\n{parts}\n }}\n}}\n'


def summary(kit: Kit) -> dict[str, Any]:
    """What a kit is, without its solids and its ways, as JSON values."""
    return _summary(kit, ways=False)


def _summary(kit: Kit, *, ways: bool) -> dict[str, Any]:
    return {
        "name": kit.name,
        "key": kit.key,
        "rim": kit.rim,
        "refused": [{"turns": list(one.turns), "keys": list(one.keys)} for one in kit.refused],
        "rows": kit.rows,
        "columns": kit.columns,
        "detail": kit.detail,
        "values": dict(kit.values),
        "bill": bill(kit.placements, kit.parts),
        "bill_of_materials": as_json(kit),
        "proved": kit.proved,
        "joints": [joint_entry(joint, ways=ways) for joint in kit.joints],
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
        validate(kit, document)
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
        command = document.get("command")
        known = isinstance(command, str) and command and command.isprintable()
        again = f": {command}" if known else " with scadgen kit"
        msg = (
            f"kit version {document.get('version')!r}: this scadgen {__version__} reads version "
            f"{VERSION}; make it again{again}"
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
    from jsonschema import Draft202012Validator, validators
    from jsonschema.exceptions import best_match

    schema = json.loads(resources.files(__package__).joinpath("kit.schema.json").read_text("utf-8"))
    # A number such as 2.0 is no count here.
    types = Draft202012Validator.TYPE_CHECKER.redefine("integer", lambda _, one: type(one) is int)
    validator = validators.extend(  # type: ignore[no-untyped-call]
        Draft202012Validator, type_checker=types
    )
    error = best_match(validator(schema).iter_errors(document))
    if error is not None:
        where = "/".join(map(str, error.absolute_path)) or "top"
        _refuse(f"at {where}: {error.message[:120]}")


def _kit(document: dict[str, Any]) -> Kit:
    kit = Kit(
        name=document["name"],
        key=document["key"],
        detail=document["detail"],
        command=document["command"],
        values={p: document["values"][p] for p in PARAMETERS if p in document["values"]},
        ranges=tuple(
            Range(r["parameter"], Linear(**r["low"]), Linear(**r["high"]), r["reason"])
            for r in document["ranges"]
        ),
        parts={name: read_part(name, entry) for name, entry in document["parts"].items()},
        joints=tuple(map(read_joint, document["joints"])),
        frame=None,
        vertices=(),
        placements=(),
        rim=document["rim"],
        refused=tuple(
            Refused(tuple(one["turns"]), tuple(one["keys"])) for one in document["refused"]
        ),
    )
    if "cells" in document:
        tiling = NamedTiling(document["tiling"]["name"], document["tiling"]["options"])
        tiling.made()
        kit = replace(kit, tiling=tiling, cells=read_cells(document["cells"]))
        return laid_out(kit, document["rows"], document["columns"])
    drawn = document["frame"]
    return replace(
        kit,
        frame=make_frame(drawn["name"], drawn["vertices"], drawn["edges"]),
        vertices=tuple(Vertex(v["joint"], read_pose(v)) for v in document["vertices"]),
        placements=tuple(map(read_placement, document["placements"])),
    )
