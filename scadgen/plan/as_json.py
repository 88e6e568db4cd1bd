"""A plan as JSON: everything that it says, for programs."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from scadgen import __version__
from scadgen.frame.placement import bill
from scadgen.kit.ways import WAY_DECIMALS
from scadgen.plan.model import Move, Plan
from scadgen.plan.motion import joints_of, motion_of
from scadgen.plan.pegs import count_pegs
from scadgen.plan.text import finished, movable, sentence
from scadgen.plan.whole import Whole
from scadgen.solid.pose import Pose

__all__ = ["FORMAT", "VERSION", "dumps", "plan_entry"]

FORMAT = "scadgen-plan"
VERSION = 4

#: Decimals of lengths in mm and of angles in degrees.
_DECIMALS = 6


def plan_entry(plan: Plan, whole: Whole, pictures: Sequence[str] = ()) -> dict[str, Any]:
    """A plan as JSON values; its schema is ``plan.schema.json`` beside this module.

    Parameters
    ----------
    plan
        The plan.
    whole
        What was found of the finished frame.
    pictures
        Names of the files with the pictures of the steps, if there are any.
    """
    kit, pegs = plan.standing.kit, count_pegs(plan.standing)
    unit = kit.values["edge_length"]
    names = pictures or [""] * len(plan.steps)
    return {
        "format": FORMAT,
        "version": VERSION,
        "generator": f"scadgen {__version__}",
        "frame": kit.name,
        "key": kit.key,
        "proved": plan.proved,
        "pegs": {
            "loose": pegs.loose,
            "least": pegs.least,
            "rim": pegs.rim,
            "fixed": pegs.fixed,
        },
        "bill": bill(kit.placements, kit.parts),
        "parts": [
            {
                "part": p.part,
                "role": p.role,
                **_pose(p.pose, unit),
                "ends": [[end.vertex + 1, end.slot] for end in p.ends],
            }
            for p in kit.placements
        ],
        "joints": list(_joints(plan)),
        "steps": [
            {
                "step": number,
                "what": step.what,
                "text": sentence(plan, number),
                "proved": step.proved,
                "picture": picture,
                "moves": [_move(plan, number, move) for move in step.moves],
            }
            for number, (step, picture) in enumerate(zip(plan.steps, names, strict=True), 1)
        ],
        "finished": {
            "parts": whole.parts,
            "contacts": whole.contacts,
            "forces": whole.forces,
            "held": whole.held,
            "moves": whole.moves,
            "loose": [{"parts": list(one.parts), "way": _rounded(one.way)} for one in whole.loose],
            "text": finished(plan, whole),
            "movable": movable(plan, whole),
        },
        "ways": [
            {
                "middle_mm": _rounded(way.middle, WAY_DECIMALS),
                "steps": [_rounded(step, WAY_DECIMALS) for step in way.steps()],
            }
            for way in plan.ways
        ],
    }


def _joints(plan: Plan) -> Iterable[dict[str, Any]]:
    """Where each joint is, and which of its edges have keys."""
    kit = plan.standing.kit
    unit = kit.values["edge_length"]
    for number, site in enumerate(plan.standing.sites, 1):
        yield {
            "joint": number,
            "kind": site.kind.name,
            **_pose(site.pose, unit),
            "keys": [
                {
                    "way": _rounded(site.direction(half)),
                    "element": element,
                }
                for half, element in plan.standing.keys(site).items()
            ],
        }


def _move(plan: Plan, number: int, move: Move) -> dict[str, Any]:
    unit, motion = plan.standing.kit.values["edge_length"], motion_of(plan, move)
    towards = motion.towards
    return {
        "parts": list(move.parts),
        "joint": move.joint + 1,
        "joints": [joint + 1 for joint in joints_of(plan, number, move)],
        "from": ("plane", "above", "below")[motion.above],
        "towards_deg": None if towards is None else round(towards, _DECIMALS) % 360,
        "tilted": motion.tilted,
        "way": move.way,
        **_pose(move.origin, unit),
        "gap_mm": round(move.gap, _DECIMALS) if math.isfinite(move.gap) else None,
        "reason": move.reason,
    }


def _pose(pose: Pose, unit: float) -> dict[str, Any]:
    """A pose in mm."""
    at = [unit * v for v in pose.at]
    return {"at_mm": _rounded(at), "x": _rounded(pose.x), "z": _rounded(pose.z)}


def _rounded(values: Iterable[float], decimals: int = _DECIMALS) -> list[float]:
    return [round(float(v), decimals) + 0.0 for v in values]


def dumps(entry: Mapping[str, Any]) -> str:
    """JSON text of a plan, the same for the same plan."""
    return json.dumps(entry, indent=1, allow_nan=False) + "\n"
