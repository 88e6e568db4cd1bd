"""``scadgen interlock``: say whether any set of parts locks."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from scadgen.cli.console import force_option, status
from scadgen.cli.length import LENGTH
from scadgen.errors import InputError, InvariantError

if TYPE_CHECKING:
    from scadgen.emit.target import Target
    from scadgen.interlock.contacts import Contacts, Mesh
    from scadgen.interlock.gaps import Gap
    from scadgen.interlock.taken import TakenApart
    from scadgen.interlock.verdict import Certificate, Motion

__all__ = ["interlock"]

_FILE = click.Path(path_type=Path)

#: Share of the tolerance up to which a gap is none.
_SHUT = 1e-3


@click.command(short_help="Say whether any set of parts locks.")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=_FILE)
@click.option(
    "--hold",
    multiple=True,
    metavar="NAMES",
    help="Parts, files or patterns (lid.*) that are held, with commas between; may be repeated.  "
    "[default: the largest]",
)
@click.option(
    "--tolerance",
    type=LENGTH,
    metavar="MM",
    help="Distance up to which faces touch.  [default: 1 % of the median part's diagonal]",
)
@click.option(
    "--interference",
    type=LENGTH,
    metavar="MM",
    help="How deep parts may be in each other and count as touching.  "
    "[default: 1 % of the tolerance]",
)
@click.option(
    "--apart",
    "taking_apart",
    is_flag=True,
    help="Take the parts apart, with a search for ways; the exit status answers that.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@click.option("--gif", type=_FILE, help="Film the motion, or with --apart the taking apart.")
@click.option("--png", type=_FILE, help="Draw the motion, or the parts at rest, into this file.")
@force_option
def interlock(  # noqa: PLR0913, PLR0917  one argument an option
    files: tuple[Path, ...],
    hold: tuple[str, ...],
    tolerance: float | None,
    interference: float | None,
    taking_apart: bool,  # noqa: FBT001  click passes flags so
    as_json: bool,  # noqa: FBT001  click passes flags so
    gif: Path | None,
    png: Path | None,
    force: bool,  # noqa: FBT001
) -> int:
    """Say whether parts, placed as assembled, hold each other: STL, 3MF, OBJ, PLY or OFF.

    A file with several bodies is several parts: name.1, name.2, ..., or as its objects are named.

    Locked means proved: from the faces that touch, no part can begin to move.  Movable means that a
    motion was found.  Keys are the parts that were taken out, in that order: straight, or with
    --apart on any way that was found.  Facets of round parts do not count as a lock if the parts
    can turn by ten tolerances without overlap.

    With --apart the answer is one of four.  Apart: all parts were taken out, alone or in groups.
    Captive: parts can move, but no way out was found.  Locked: nothing can begin to move.  Not
    settled: the search did not end, or several parts may have to move in turns.

    Exit status 0 if the parts are locked, 1 if something can move.  With --apart: 0 if they come
    apart, 1 if not.

    \b
    scadgen interlock burr/*.stl --hold piece1
    scadgen interlock burr/*.stl --apart --gif apart.gif
    scadgen interlock puzzle.3mf --tolerance 0.4 --gif motion.gif
    """  # noqa: D301  click wants the character
    from scadgen.cli.assembly import (
        checked_interference,
        checked_tolerance,
        held_parts,
        touching,
    )
    from scadgen.cli.interlock_words import apart_as_json, motion_as_json, print_report
    from scadgen.interlock.apart import BUDGET, take_apart
    from scadgen.interlock.verdict import Motion
    from scadgen.tools.read_mesh import read_parts

    pictures = _pictures(files, gif, png, force=force)
    with status("reading") as say:
        parts = read_parts(files)
        names, meshes = [part.name for part in parts], [part.mesh for part in parts]
        held = held_parts(parts, hold)
        near = checked_tolerance(names, meshes, tolerance)
        deep = checked_interference(names, meshes, interference, near)
        say("looking for contacts")
        contacts = touching(meshes, near)
        say("looking for a motion")
        answer, facts = _judge(meshes, contacts, held)
        say("looking for parts that move alone")
        motion = answer if isinstance(answer, Motion) else None
        motion, motions = _alone(meshes, contacts, near, held, motion)
        gaps = [] if isinstance(answer, Motion) else _gaps(meshes, contacts, answer, near)
        say("following the motion")
        until, way = _followed(names, meshes, motion)
        apart = take_apart(
            meshes,
            contacts,
            near,
            held if hold else (),
            steps=BUDGET if taking_apart else 0,
            interference=deep,
            say=say,
        )
    report = {
        "locked": motion is None,
        "held": [names[part] for part in held],
        "tolerance": near,
        "contacts": len(contacts),
        "certificate": facts if motion is None else None,
        "gaps": [{"parts": [names[gap.first], names[gap.second]], **_widths(gap)} for gap in gaps],
        "motion": {**motion_as_json(names, motion), "way": way} if motion else None,
        "alone": {
            n: motion_as_json(names, m) if m else None for n, m in zip(names, motions, strict=True)
        },
        "keys": ["+".join(names[n] for n in removal.parts) for removal in apart.removals],
        "apart": apart_as_json(names, apart) if taking_apart else None,
    }
    if as_json:
        click.echo(json.dumps(report, indent=1))
    else:
        print_report(names, meshes, report, motion, motions, defaulted=not hold)
    _draw(meshes, motion, until, pictures, apart if taking_apart else None)
    good = apart.answer == "apart" if taking_apart else motion is None
    return 0 if good else 1


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


def _gaps(meshes: list[Mesh], contacts: Contacts, answer: Certificate, near: float) -> list[Gap]:
    """The gaps that count as closed in a lock."""
    from scadgen.interlock.gaps import closed_gaps

    found = closed_gaps(meshes, contacts.some(answer.rows), near)
    return [gap for gap in found if gap.largest > _SHUT * near]


def _widths(gap: Gap) -> dict[str, float]:
    return {"smallest": gap.smallest, "largest": gap.largest}


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


def _draw(
    meshes: list[Mesh],
    motion: Motion | None,
    until: float,
    pictures: dict[str, Target],
    apart: TakenApart | None,
) -> None:
    """Write the pictures that were asked for."""
    from scadgen.emit.motion import apart_gif, motion_gif, motion_png

    if png := pictures.get("png"):
        png.put(motion_png(meshes, motion, until=until), "png")
    gif = pictures.get("gif")
    if gif and apart and apart.removals:
        gif.put(apart_gif(meshes, apart.removals), "gif")
    elif gif and motion:
        gif.put(motion_gif(meshes, motion, until=until), "gif")
    elif gif:
        click.echo(f"scadgen: nothing moves, {gif.path} is not written", err=True)
