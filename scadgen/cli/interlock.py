"""``scadgen interlock``: say whether any set of parts locks."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from scadgen.api.words import meant
from scadgen.cli.console import force_option, status, table
from scadgen.cli.length import LENGTH
from scadgen.errors import InputError, InvariantError

if TYPE_CHECKING:
    from scadgen.emit.target import Target
    from scadgen.interlock.contacts import Contacts, Mesh
    from scadgen.interlock.verdict import Certificate, Motion

__all__ = ["interlock"]

_FILE = click.Path(path_type=Path)


@click.command(short_help="Say whether any set of parts locks.")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=_FILE)
@click.option(
    "--hold",
    multiple=True,
    metavar="NAMES",
    help="Parts that are held fast, with commas between; adds up.  [default: the largest]",
)
@click.option(
    "--tolerance",
    type=LENGTH,
    metavar="MM",
    help="Distance up to which faces touch.  [default: 1 % of the median part's diagonal]",
)
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@click.option("--gif", type=_FILE, help="Film the motion into this file.")
@click.option("--png", type=_FILE, help="Draw the motion, or the parts at rest, into this file.")
@force_option
def interlock(
    files: tuple[Path, ...],
    hold: tuple[str, ...],
    tolerance: float | None,
    as_json: bool,  # noqa: FBT001  click passes flags so
    gif: Path | None,
    png: Path | None,
    force: bool,  # noqa: FBT001
) -> int:
    """Say whether parts, placed as assembled, hold each other: STL, 3MF, OBJ, PLY or OFF.

    A file with several bodies is several parts: name.1, name.2, or as its objects are named.
    To first order, from the faces that touch; locked means proven, with a certificate that is
    checked again.  Round faces that only their facets lock count as round if the parts as
    they are can turn ten tolerances without overlap.

    Exit status 0 if they are locked, 1 if something can move.

    \b
    scadgen interlock burr/*.stl --hold piece1
    scadgen interlock puzzle.3mf --tolerance 0.4 --gif motion.gif
    """  # noqa: D301  click wants the character
    from scadgen.interlock.keys import keys
    from scadgen.interlock.verdict import Motion
    from scadgen.tools.read_mesh import read_parts

    pictures = _pictures(files, gif, png, force=force)
    with status("reading") as say:
        parts = read_parts(files)
        names, meshes = list(parts), list(parts.values())
        held = _held(names, meshes, hold)
        _check_overlaps(names, meshes)
        say("looking for contacts")
        near, contacts = _touching(meshes, tolerance)
        say("looking for a motion")
        answer, facts = _judge(meshes, contacts, held)
        say("looking for parts that move alone")
        motion = answer if isinstance(answer, Motion) else None
        motion, motions = _alone(meshes, contacts, near, held, motion)
        order = keys(meshes, contacts, held)
        if not (order or hold):
            # The largest part may itself be the key; nobody asked to hold it.
            order = keys(meshes, contacts)
        say("following the motion")
        until, way = _followed(names, meshes, motion)
    report = {
        "locked": motion is None,
        "held": [names[part] for part in held],
        "tolerance": near,
        "contacts": len(contacts),
        "certificate": facts if motion is None else None,
        "motion": {**_as_json(names, motion), "way": way} if motion else None,
        "alone": {
            n: _as_json(names, m) if m else None for n, m in zip(names, motions, strict=True)
        },
        "keys": [names[part] for part, _ in order],
    }
    if as_json:
        click.echo(json.dumps(report, indent=1))
    else:
        _say(names, meshes, report, motion, motions, defaulted=not hold)
    _draw(meshes, motion, until, pictures)
    return 0 if motion is None else 1


def _pictures(
    files: tuple[Path, ...], gif: Path | None, png: Path | None, *, force: bool
) -> dict[str, Target]:
    """Where to draw, by kind; refused before any work if it may not be."""
    from scadgen.emit.target import target

    pictures = {}
    for kind, path in (("gif", gif), ("png", png)):
        if path is None:
            continue
        if path.suffix.lower() != f".{kind}":
            msg = f"--{kind} {str(path)!r}: must be a file of its own that ends in .{kind}"
            raise InputError(msg)
        pictures[kind] = target(path, files, force=force)
    return pictures


def _held(names: list[str], meshes: list[Mesh], hold: tuple[str, ...]) -> list[int]:
    """Numbers of the parts to hold."""
    from scadgen.interlock.assembly import largest_part

    if len(names) < 2:
        msg = f"{len(names)} part: must be at least two; name more files"
        raise InputError(msg)
    if not hold:
        return [largest_part(meshes)]
    # A name may have commas of its own.
    lists = ([text] if text in names else text.split(",") for text in hold)
    chosen = [name.strip() for name in itertools.chain(*lists)]
    for name in chosen:
        if name not in names:
            msg = f"--hold {name}: must be one of {', '.join(names)}{meant(name, names)}"
            raise InputError(msg)
    if len(set(chosen)) == len(names):
        msg = f"--hold {','.join(hold)}: holds all parts; leave at least one free"
        raise InputError(msg)
    return sorted(names.index(name) for name in set(chosen))


def _check_overlaps(names: list[str], meshes: list[Mesh]) -> None:
    from scadgen.interlock.overlap import overlaps

    if found := overlaps(meshes):
        a, b, shared = max(found, key=lambda pair: pair[2])
        others = f", {len(found)} pairs in all" if len(found) > 1 else ""
        msg = (
            f"{names[a]} and {names[b]} overlap by {shared:.6g} mm3{others}: "
            "parts must be placed as assembled"
        )
        raise InputError(msg)


def _touching(meshes: list[Mesh], tolerance: float | None) -> tuple[float, Contacts]:
    """The tolerance and the contacts."""
    from scadgen.interlock.contacts import default_tolerance, find_contacts

    near = default_tolerance(meshes) if tolerance is None else tolerance
    size = max(float((points.max(axis=0) - points.min(axis=0)).max()) for points, _ in meshes)
    if near > size:
        msg = f"--tolerance {near:.4g}: must be at most the largest part's size, {size:.4g} mm"
        raise InputError(msg)
    contacts = find_contacts(meshes, near)
    if not len(contacts):
        msg = (
            f"no two parts touch within {near:.4g} mm: "
            "place them as assembled, or give a larger --tolerance"
        )
        raise InputError(msg)
    return near, contacts


def _judge(
    meshes: list[Mesh], contacts: Contacts, held: list[int]
) -> tuple[Certificate | Motion, dict[str, float] | None]:
    """The verdict, and the facts of a certificate once it is checked."""
    from scadgen.interlock.assembly import make_assembly
    from scadgen.interlock.certificate import BALANCED, check_certificate
    from scadgen.interlock.verdict import Motion, verdict

    answer = verdict(make_assembly(meshes, contacts, held))
    if isinstance(answer, Motion):
        return answer, None
    residual = check_certificate(contacts, held, len(meshes), answer)
    if not residual < BALANCED:
        msg = f"a certificate balances every part: residual {residual:.3g}"
        raise InvariantError(msg)
    return answer, {
        "contacts": len(answer.rows),
        "rank": answer.rank,
        "largest_force": float(answer.forces.max()),
        "residual": residual,
    }


def _alone(
    meshes: list[Mesh], contacts: Contacts, near: float, held: list[int], motion: Motion | None
) -> tuple[Motion | None, list[Motion | None]]:
    """The motion, of round faces if there is no other, and that of each part alone."""
    from scadgen.interlock.keys import alone
    from scadgen.interlock.round import round_motions
    from scadgen.interlock.verdict import Motion

    motions = [m if isinstance(m, Motion) else None for m in alone(meshes, contacts)]
    stuck = [part for part, found in enumerate(motions) if found is None]
    free = [part for part in range(len(meshes)) if part not in held]
    together = [free] if motion is None and len(free) > 1 else []
    bodies = [[part] for part in stuck] + together
    turning = round_motions(meshes, contacts, near, bodies)
    for part, found in zip(stuck, turning, strict=False):
        motions[part] = found
    if motion is None:
        own = [motions[part] for part in free]
        motion = next((m for m in (*own, *turning[len(stuck) :]) if m), None)
    return motion, motions


def _followed(
    names: list[str], meshes: list[Mesh], motion: Motion | None
) -> tuple[float, dict[str, Any] | None]:
    """How long parts can follow a motion, and what to say of it."""
    import numpy as np

    from scadgen.interlock.follow import first_touch

    if motion is None or motion.rounded:
        # Facets that rub would seem to stop what turns.
        return math.inf, None
    until, touched = first_touch(meshes, motion)
    return until, {
        "mm": until * float(np.linalg.norm(motion.translations, axis=1).max()),
        "degrees": math.degrees(until * np.linalg.norm(motion.rotations, axis=1).max()),
        "touches": None if touched is None else names[touched],
    }


def _say(
    names: list[str],
    meshes: list[Mesh],
    report: dict[str, Any],
    motion: Motion | None,
    motions: list[Motion | None],
    *,
    defaulted: bool,
) -> None:
    """Print the answer for a person."""
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
    click.echo(f"  keys         {', '.join(report['keys']) or 'none: no part comes free alone'}")
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


def _how(meshes: list[Mesh], motion: Motion, part: int) -> str:
    """Say how one part of a motion moves."""
    import numpy as np

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


def _direction(unit: Any) -> str:  # noqa: ANN401  numpy is imported late
    """A unit vector, by its axis if it is along one."""
    axis = int(abs(unit).argmax())
    if abs(unit[axis]) > 1 - 1e-6:
        return f"{'+' if unit[axis] > 0 else '-'}{'xyz'[axis]}"
    return _vector(unit)


def _vector(values: Any) -> str:  # noqa: ANN401  numpy is imported late
    return "(" + ", ".join(f"{x:.3g}" for x in (values.round(4) + 0.0).tolist()) + ")"


def _as_json(names: list[str], motion: Motion) -> dict[str, Any]:
    steps = zip(motion.parts, motion.translations, motion.rotations, strict=True)
    return {
        "slides": motion.slides,
        "round_faces": motion.rounded,
        "parts": [
            {"part": names[n], "translation": t.tolist(), "rotation": w.tolist()}
            for n, t, w in steps
        ],
    }


def _draw(
    meshes: list[Mesh], motion: Motion | None, until: float, pictures: dict[str, Target]
) -> None:
    """Write the pictures that were asked for."""
    from scadgen.emit.motion import motion_gif, motion_png

    if png := pictures.get("png"):
        png.put(motion_png(meshes, motion, until=until), "png")
    gif = pictures.get("gif")
    if gif and motion:
        gif.put(motion_gif(meshes, motion, until=until), "gif")
    elif gif:
        click.echo(f"scadgen: nothing moves, {gif.path} is not written", err=True)
