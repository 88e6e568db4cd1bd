"""What ``scadgen frame`` says of a frame, as data and as tables."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from scadgen.cli.console import counted, table

if TYPE_CHECKING:
    from scadgen.check.frame import Build
    from scadgen.frame.classes import Snapped

__all__ = ["SIDES", "report", "show"]

#: Smallest and largest side of a kit, in mm.
SIDES = (5.0, 100.0)

#: Rows of a table and lines of a list that are printed; JSON has all.
_SHOWN = 40

#: Reasons that are printed: tables have what each edge is too short by.
_REASONS = 5

#: Decimals of what is computed, in JSON.
_DECIMALS = 6


def report(
    build: Build, notes: Sequence[str], snapped: Snapped | None, side: float | None
) -> dict[str, Any]:
    """All that is said, as JSON has it; lengths in mm, angles in degrees.

    Parameters
    ----------
    build
        The frame with its rings.
    notes
        What was changed on reading it.
    snapped
        What it costs to have fewer kinds, if that was asked for.
    side
        Side of the tubes, in mm, if it is to be built.
    """
    frame, largest = build.frame, build.largest_side
    parts = int(frame.components.max()) + 1
    in_the_way = [*build.unfit]
    if side:
        in_the_way += [*build.too_short(side), *build.too_near(side)]
    too_small = largest is not None and (in_the_way or largest < SIDES[0])
    return {
        "name": frame.name,
        "vertices": len(frame.vertices),
        "edges": len(frame.edges),
        "parts": parts,
        # Euler's formula, without the one around them all.
        "faces": len(frame.edges) - len(frame.vertices) + parts,
        "bounds": frame.bounds.tolist(),
        "notes": list(notes),
        "snap": snapped and _snap(snapped),
        "kinds_of_joints": _joints(build, side),
        "kinds_of_edges": _edges(build, side),
        "side": side,
        "largest_side": largest and math.floor(largest * 10**_DECIMALS) / 10**_DECIMALS,
        "in_the_way": in_the_way,
        "would_do": build.room.works(side or SIDES[0]) if too_small else None,
    }


def _snap(snapped: Snapped) -> dict[str, Any]:
    return {
        "angle_error": _rounded(math.degrees(snapped.angle_error)),
        "length_error": _rounded(snapped.length_error),
        "miss": _rounded(snapped.miss),
        "notes": list(snapped.notes),
    }


def _joints(build: Build, side: float | None) -> list[dict[str, Any]]:
    import numpy as np

    from scadgen.frame.classes import joint_name

    kinds = zip(build.same.joints, build.least, build.rings, strict=True)
    return [
        {
            "name": joint_name(kind),
            "count": len(joint.vertices),
            "edges": len(joint.directions),
            "angles": [
                _rounded(math.degrees(gap)) for gap in np.diff(joint.directions, append=2 * math.pi)
            ],
            "symmetry": joint.symmetry.turns,
            "least_ring_ratio": _rounded(least),
            "ring_ratio": _rounded(ring),
            "across": side and _rounded((2 * ring + 1) * side),
            "vertices": build.frame.called.numbers("vertices", joint.vertices),
        }
        for kind, (joint, least, ring) in enumerate(kinds)
    ]


def _edges(build: Build, side: float | None) -> list[dict[str, Any]]:
    from scadgen.frame.classes import joint_name

    missing = build.missing(side or 0.0)
    return [
        {
            "name": str(kind),
            "count": len(edge.edges),
            "length": _rounded(edge.length),
            "ends": [
                {"joint": joint_name(joint), "edge": slot + 1, "over": over}
                for joint, slot, over in zip(
                    edge.joints, edge.slots, (False, edge.over), strict=True
                )
            ],
            "missing": _rounded(missing[edge.edges].max()),
            "edges": build.frame.called.numbers("edges", edge.edges),
        }
        for kind, edge in enumerate(build.same.edges, 1)
    ]


def show(said: dict[str, Any]) -> None:
    """Print what `report` gives."""
    (left, low), (right, high) = said["bounds"]
    parts = f" in {said['parts']} parts" if said["parts"] > 1 else ""
    faces = f" around {counted(said['faces'], 'face')}" if said["faces"] else ""
    click.echo(
        f"{said['name']}: {said['vertices']} vertices, {counted(said['edges'], 'edge')}{faces}"
        f"{parts}, {right - left:.6g} x {high - low:.6g} mm from ({left:.6g}, {low:.6g})"
    )
    _lines(said["notes"])
    joints, edges = said["kinds_of_joints"], said["kinds_of_edges"]
    click.echo(f"\nkinds of joints: {len(joints)}")
    _table(
        (
            *("joint", "count", "edges", "smallest ring", "ring"),
            *(("across",) if said["side"] else ()),
            "angles",
        ),
        [
            (
                joint["name"],
                str(joint["count"]),
                str(joint["edges"]),
                f"{joint['least_ring_ratio']:.3f}",
                f"{joint['ring_ratio']:.3f}",
                *((f"{joint['across']:.4g}",) if said["side"] else ()),
                " ".join(f"{angle:.4g}" for angle in joint["angles"]),
            )
            for joint in joints
        ],
    )
    click.echo(f"\nkinds of edges: {len(edges)}")
    _table(
        ("kind", "count", "length", "ends", "too short by" if said["side"] else ""),
        [
            (
                edge["name"],
                str(edge["count"]),
                f"{edge['length']:.6g}",
                " - ".join(
                    f"{end['joint']}.{end['edge']}{' over' * end['over']}" for end in edge["ends"]
                ),
                f"{edge['missing']:.4g}" if edge["missing"] else "",
            )
            for edge in edges
        ],
    )
    click.echo()
    if said["snap"]:
        _lines(said["snap"]["notes"], "snapped: ")
    _lines(said["in_the_way"], most=_REASONS)
    click.echo(_verdict(said))


def _verdict(said: Mapping[str, Any]) -> str:
    """Which sides fit, or what would help."""
    largest = said["largest_side"]
    if largest is None:
        return "cannot be built at any side"
    if said["would_do"]:
        return f"too small for sides of {said['side'] or SIDES[0]:g} mm; {said['would_do']}"
    within = math.floor(min(largest, SIDES[1]) * 1000) / 1000
    return f"sides up to {within:g} mm fit"


def _rounded(value: float) -> float:
    return round(float(value), _DECIMALS)


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    table(header, rows[:_SHOWN])
    _more(len(rows))


def _lines(lines: Sequence[str], before: str = "", most: int = _SHOWN) -> None:
    for line in lines[:most]:
        click.echo(before + line)
    _more(len(lines), most)


def _more(count: int, most: int = _SHOWN) -> None:
    if count > most:
        click.echo(f"and {count - most} more; --json has all")
