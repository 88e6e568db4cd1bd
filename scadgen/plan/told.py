"""What a plan says, as JSON values and as text."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from scadgen import __version__
from scadgen.frame.layout import bill
from scadgen.plan.model import Move, Plan, Step
from scadgen.plan.pegs import Pegs, count_pegs
from scadgen.plan.whole import Whole

__all__ = ["FORMAT", "VERSION", "dumps", "finished", "plan_entry", "plan_text", "sentence"]

FORMAT = "scadgen-plan"
VERSION = 1

#: Decimals of lengths in mm and of angles in degrees.
_DECIMALS = 6

#: Joints that a sentence names at most.
_NAMED = 12


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
        "frame": kit.frame,
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
                "at_mm": _rounded(unit * np.array(p.at)),
                "turn_deg": round(p.turn, _DECIMALS),
                "flip": p.flip,
                "role": p.role,
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
                "moves": [_move(move, unit) for move in step.moves],
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
        },
        "ways": [
            {"middle_mm": _rounded(way.middle), "steps": [_rounded(s) for s in way.steps()]}
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
            "at_mm": _rounded(unit * np.array(site.at)),
            "keys": [
                {
                    "turn_deg": round(float(np.degrees(site.direction(half))) % 360, _DECIMALS),
                    "element": element,
                }
                for half, element in plan.standing.keys(site).items()
            ],
        }


def _move(move: Move, unit: float) -> dict[str, Any]:
    return {
        "parts": list(move.parts),
        "joint": move.joint + 1,
        "order": move.order,
        "way": move.way,
        "at_mm": _rounded(unit * np.array(move.at)),
        "turn_deg": round(move.turn, _DECIMALS),
        "gap_mm": round(move.gap, _DECIMALS) if math.isfinite(move.gap) else None,
        "reason": move.reason,
    }


def _rounded(values: Iterable[float]) -> list[float]:
    return [round(float(v), _DECIMALS) + 0.0 for v in values]


def plan_text(plan: Plan, whole: Whole) -> str:
    """A plan as lines for people.

    Parameters
    ----------
    plan
        The plan.
    whole
        What was found of the finished frame.
    """
    kit, pegs = plan.standing.kit, count_pegs(plan.standing)
    kinds = len(bill(kit.placements, kit.parts))
    good = "each proved" if plan.proved else "NOT ALL PROVED"
    parts = f"{len(kit.placements)} parts of {kinds} kinds, {len(plan.standing.sites)} joints"
    lines = [f"{kit.frame}: {parts}; {_count(len(plan.steps), 'step')}, {good}", _pegs(pegs)]
    for number, step in enumerate(plan.steps, 1):
        lines.append(f"{number:3d}. {sentence(plan, number)}")
        lines += [
            f"     not proved: joint {move.joint + 1}: {move.reason}"
            for move in step.moves
            if not move.proved
        ]
    if plan.left:
        lines.append(f"     not proved: no way is known to join {_bill(plan, plan.left)}")
    lines.append(f"finished: {finished(plan, whole)}")
    return "\n".join(lines) + "\n"


def finished(plan: Plan, whole: Whole) -> str:
    """What can still move in the finished frame, and what holds it.

    Parameters
    ----------
    plan
        The plan.
    whole
        What was found of the frame.
    """
    sets = [one.parts for one in whole.loose if len(one.parts) > 1]
    pegs = sum(len(one.parts) == 1 for one in whole.loose)
    if not whole.held:
        moving = whole.loose[-1].parts
        return f"NOT HELD: {_bill(plan, moving) or 'no proof is found that nothing'} can move"
    proof = f"proved by {whole.forces} contacts in balance"
    fit = "only the fit of the pegs holds in what went in last"
    able = [f"{_count(pegs, 'peg')} along {'its edge' if pegs == 1 else 'their edges'}"] * (
        pegs > 0
    )
    if whole.moves == "pegs":
        return f"nothing moves but {able[0] if able else 'the pegs'}, {proof}; {fit}"
    able += [f"{len(parts)} parts as one off their pegs" for parts in sets]
    return f"nothing moves unless a peg slides, {proof}; what can: {', '.join(able)}; {fit}"


def _pegs(pegs: Pegs) -> str:
    """How many pegs there are, and how many there have to be."""
    if pegs.fixed:
        rim = f"; {_count(pegs.rim, 'peg')} at the rim, where a key has no edge" if pegs.rim else ""
        return f"pegs: {pegs.fixed} on elements, no loose one{rim}"
    return f"pegs: {pegs.loose} loose ones; a frame like this needs at least {pegs.least}"


def sentence(plan: Plan, number: int) -> str:
    """What to do in a step.

    Parameters
    ----------
    plan
        The plan.
    number
        The step's number, from 1.
    """
    step = plan.steps[number - 1]
    gap = min(move.gap for move in step.moves)
    told = {"connectors": _joined, "rows": _rows, "pegs": _pieces, "halves": _pieces}
    kept = f" ({gap:.2f} mm from all else)" if step.proved else ""
    return f"{told[step.what](plan, step)}{kept}"


def _joined(plan: Plan, step: Step) -> str:
    first = sorted(plan.first())
    rounds = max(move.order for move in step.moves)
    order = f", in {rounds} rounds as numbered" if rounds > 1 else ""
    sets = sum(len(move.parts) > 1 for move in step.moves)
    several = f"; what is joined by then goes in as one {_count(sets, 'time')}" if sets else ""
    moved = [part for move in step.moves if len(move.parts) == 1 for part in move.parts]
    return f"Lay out {_bill(plan, first)}; join {_bill(plan, moved)} to them{order}{several}"


def _pieces(plan: Plan, step: Step) -> str:
    parts = [part for move in step.moves for part in move.parts]
    roles = {plan.standing.kit.placements[part].role for part in parts}
    which = {"half_a": " (half A)", "half_b": " (half B)"}.get(min(roles), "")
    return f"Put in {_bill(plan, parts)}{which if len(roles) == 1 else ''}: {_at(plan, step.moves)}"


def _rows(plan: Plan, step: Step) -> str:
    alone = [part for move in step.moves if len(move.parts) == 1 for part in move.parts]
    rows = [move for move in step.moves if len(move.parts) > 1]
    if not rows:
        return f"Push in the pegs of {_bill(plan, alone)}: {_at(plan, step.moves)}"
    if alone or len(rows) > 1:
        begin = f"push in the pegs of {_bill(plan, alone)}, and " if alone else ""
        pushed = f"push {_count(len(rows), 'row')} onto their pegs, each as one"
        return f"Row by row, as numbered: {begin}{pushed}"
    held = sorted({n for part in rows[0].parts for n in plan.standing.sites_of[part]})
    return f"Push a row of {len(rows[0].parts)} parts onto its pegs as one: {_numbers(plan, held)}"


def _at(plan: Plan, moves: Iterable[Move]) -> str:
    return _numbers(plan, sorted({move.joint for move in moves}))


def _numbers(plan: Plan, joints: list[int]) -> str:
    """Joints by their numbers from 1."""
    if len(joints) == len(plan.standing.sites):
        return "all joints"
    if len(joints) > _NAMED:
        return f"{len(joints)} joints"
    words = ", ".join(str(n + 1) for n in joints)
    return f"joint{'s' if len(joints) > 1 else ''} {words}"


def _bill(plan: Plan, parts: Iterable[int]) -> str:
    kit = plan.standing.kit
    counts = bill((kit.placements[n] for n in parts), kit.parts)
    return ", ".join(f"{count} x {name}" for name, count in counts.items())


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def dumps(entry: Mapping[str, Any]) -> str:
    """JSON text of a plan, the same for the same plan."""
    return json.dumps(entry, indent=1, allow_nan=False) + "\n"
