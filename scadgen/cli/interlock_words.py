"""What ``scadgen interlock`` says."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from scadgen.cli.console import counted, table

if TYPE_CHECKING:
    from scadgen.interlock.contacts import Mesh
    from scadgen.interlock.taken import Left, TakenApart
    from scadgen.interlock.verdict import Motion
    from scadgen.solid.affine import Floats

__all__ = ["apart_as_json", "motion_as_json", "print_report"]

#: Pairs of parts whose gaps are told.
_PAIRS = 6


def print_report(
    names: Sequence[str],
    meshes: Sequence[Mesh],
    report: dict[str, Any],
    motion: Motion | None,
    motions: Sequence[Motion | None],
    *,
    defaulted: bool,
) -> None:
    """Print the answer for a person.

    Parameters
    ----------
    names, meshes
        The parts.
    report
        The answer as JSON has it.
    motion
        What moves, or nothing.
    motions
        How each part moves alone, or nothing.
    defaulted
        Whether nobody said what is held.
    """
    held = ", ".join(report["held"]) + (", the largest part" if defaulted else "")
    click.echo("locked" if motion is None else "movable")
    click.echo(f"  held         {held}")
    click.echo(f"  contacts     {report['contacts']} within {report['tolerance']:.4g} mm")
    if facts := report["certificate"]:
        click.echo(
            f"  certificate  {facts['contacts']} contacts push, rank {facts['rank']}, largest "
            f"force {facts['largest_force']:.4g}, residual {facts['residual']:.1e}"
        )
    if motion:
        slides = ", contacts only slide" if motion.slides else ""
        click.echo(f"  motion       {', '.join(names[n] for n in motion.parts)}{slides}")
        if way := report["motion"]["way"]:
            click.echo(f"  way          {_way(motion, way)}")
    if report["gaps"] and motion is None:
        click.echo(f"  gaps         {_gaps(report['gaps'])} count as closed")
    click.echo(f"  keys         {', '.join(report['keys']) or _no_keys(report)}")
    if apart := report["apart"]:
        click.echo(f"  apart        {_apart(apart)}")
    click.echo("")
    rows: list[tuple[str, ...]] = [
        (name, "held" if name in report["held"] else "", _how(meshes, m, n) if m else "locked")
        for n, (name, m) in enumerate(zip(names, motions, strict=True))
    ]
    if motion and len(motion.parts) > 1:
        together = {part: _how(meshes, motion, part) for part in motion.parts}
        rows = [(*row, together.get(n, "")) for n, row in enumerate(rows)]
        table(("part", "", "alone", "in the motion"), rows)
    else:
        table(("part", "", "alone"), rows)


def _way(motion: Motion, way: dict[str, Any]) -> str:
    """Say how far a motion goes."""
    turns = motion.rotations.any() and way["mm"] < 1e-3
    far = f"turns {way['degrees']:.3g} degrees" if turns else f"moves {way['mm']:.3g} mm"
    return f"{far}, then touches {way['touches']}" if way["touches"] else f"{far}, touching nothing"


def _how(meshes: Sequence[Mesh], motion: Motion, part: int) -> str:
    """Say how one part of a motion moves."""
    n = motion.parts.index(part)
    t, w = motion.translations[n], motion.rotations[n]
    points = meshes[part][0]
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    half = np.linalg.norm(np.ptp(points, axis=0)) / 2
    speed, spin = float(np.linalg.norm(t)), float(np.linalg.norm(w))
    if spin * half < 1e-3 * speed:
        return f"moves along {_direction(t / speed)}"
    along = abs(float(t @ w)) / spin
    where = middle + np.cross(w, t) / spin**2
    text = f"turns about {_direction(w / spin)} through {_vector(where)}"
    text += " and moves along it" if along > 1e-3 * spin * half else ""
    return text + (" (round faces)" if motion.rounded else "")


def _direction(unit: Floats) -> str:
    """A unit vector, by its axis if it is along one."""
    axis = int(abs(unit).argmax())
    if abs(unit[axis]) > 1 - 1e-6:
        return f"{'+' if unit[axis] > 0 else '-'}{'xyz'[axis]}"
    return _vector(unit)


def _vector(values: Floats) -> str:
    return "(" + ", ".join(f"{x:.3g}" for x in (values.round(4) + 0.0).tolist()) + ")"


def _no_keys(report: dict[str, Any]) -> str:
    """Say that nothing was taken out, and how far that was tried."""
    return "none" if report["apart"] else "none that leaves straight; --apart searches other ways"


def _gaps(gaps: Sequence[dict[str, Any]]) -> str:
    """Say which gaps there are."""
    ordered = sorted(gaps, key=lambda gap: -float(gap["largest"]))
    told = [
        f"{_span(gap['smallest'], gap['largest'])} between {' and '.join(gap['parts'])}"
        for gap in ordered[:_PAIRS]
    ]
    more = len(gaps) - len(told)
    return ", ".join(told) + (f", {counted(more, 'pair')} more" if more else "")


def _span(smallest: float, largest: float) -> str:
    """Say a range of lengths."""
    low, high = f"{smallest:.3g}", f"{largest:.3g}"
    return f"{high} mm" if low == high else f"{low} to {high} mm"


def _apart(apart: dict[str, Any]) -> str:
    """Say what comes apart and what does not."""
    if apart["answer"] == "apart":
        return "comes apart"
    left = "; ".join(_left(one) for one in apart["left"])
    out = apart["order"]
    return f"{counted(len(out), 'step')}, then {left}" if out else left


def _left(one: dict[str, Any]) -> str:
    """Say what does not come apart."""
    parts = ", ".join(one["parts"])
    if one["answer"] == "locked":
        return f"{parts}: locked"
    far = f"moves {one['mm']:.3g} mm and turns {one['degrees']:.3g} degrees at most in the search"
    ways = counted(one["tries"], "way")
    if one["answer"] == "captive":
        return f"{parts}: captive, {far}, no way out in {ways}"
    return f"{parts}: not settled, no way out in {ways}"


def apart_as_json(names: Sequence[str], apart: TakenApart) -> dict[str, Any]:
    """What becomes of an assembly as JSON.

    Parameters
    ----------
    names
        The parts.
    apart
        What becomes of them.
    """
    return {
        "answer": apart.answer,
        "order": [
            {
                "parts": [names[n] for n in removal.parts],
                "middle": removal.path.middle.tolist(),
                "steps": removal.path.steps().tolist(),
            }
            for removal in apart.removals
        ],
        "left": [_left_as_json(names, left) for left in apart.left],
    }


def _left_as_json(names: Sequence[str], left: Left) -> dict[str, Any]:
    return {
        "parts": [names[n] for n in left.parts],
        "answer": left.answer,
        "mm": left.shift,
        "degrees": math.degrees(left.turn),
        "tries": left.tries,
    }


def motion_as_json(names: Sequence[str], motion: Motion) -> dict[str, Any]:
    """A motion as JSON.

    Parameters
    ----------
    names
        The parts.
    motion
        The motion.
    """
    steps = zip(motion.parts, motion.translations, motion.rotations, strict=True)
    return {
        "slides": motion.slides,
        "round_faces": motion.rounded,
        "parts": [
            {"part": names[n], "translation": t.tolist(), "rotation": w.tolist()}
            for n, t, w in steps
        ],
    }
