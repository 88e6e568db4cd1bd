"""``scadgen frame``: look at a frame, named or drawn."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from scadgen.api.curves import share_of_room
from scadgen.api.options import about_file, about_named, option
from scadgen.api.source import has_cells, load_frame
from scadgen.cli.console import force_option, status, table
from scadgen.cli.frame_report import SIDES, report, show
from scadgen.cli.length import LENGTH
from scadgen.cli.source_options import source_options
from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.emit.target import Target
    from scadgen.frame.classes import Classes, Snapped
    from scadgen.frame.graph import Frame

__all__ = ["frame"]

#: The side of a kit's tubes where none is given, in mm.
_USUAL_SIDE = 10.0

_FILE = click.Path(path_type=Path)


@click.command(short_help="Look at a frame, named or drawn.")
@click.argument("name", metavar="FRAME", required=False)
@click.option(
    "--list",
    "listing",
    is_flag=True,
    help="List the named frames, with their options; as JSON also those of files.",
)
@click.option("--side", type=LENGTH, metavar="MM", help="Say whether it can be built at this side.")
@click.option(
    "--ring-ratio",
    type=float,
    metavar="R",
    help="Radius of all rings, in sides.  [default: as in a kit, by each joint's angles]",
)
@click.option(
    "--snap-angle",
    type=float,
    metavar="DEG",
    help="Count angles that differ by up to this as the same.  Nothing moves; it says how many "
    "kinds are left, and how far ends then miss.",
)
@click.option(
    "--snap-length",
    type=LENGTH,
    metavar="MM",
    help="Count lengths that differ by up to this as the same, likewise.",
)
@source_options()
@click.option("-o", "--output", type=_FILE, help="Write the frame as JSON.")
@click.option(
    "--picture",
    type=_FILE,
    metavar="FILE",
    help="Draw it as SVG, in colours by kind; what was repaired or cannot be built is circled.",
)
@force_option
@click.option("--json", "as_json", is_flag=True, help="Say it as JSON.")
def frame(  # noqa: PLR0913, PLR0917  one argument an option
    name: str | None,
    listing: bool,  # noqa: FBT001  click passes flags so
    side: float | None,
    ring_ratio: float | None,
    snap_angle: float | None,
    snap_length: float | None,
    output: Path | None,
    picture: Path | None,
    force: bool,  # noqa: FBT001
    as_json: bool,  # noqa: FBT001
    **options: Any,  # noqa: ANN401  of families and files
) -> int:
    """Look at a frame: its joints and edges, and what stands in the way of building it.

    FRAME is a name (see --list) or a file: JSON, SVG, DXF, OBJ or OFF.

    The tables call kinds of joints by letters.  A.2 is the second edge of joint A, counted
    counter-clockwise, and its angles are those between its edges in that order.  Ring ratios are
    radii of rings, in sides of the tubes.

    Exit status 1 if --side was given and the frame cannot be built with it.

    \b
    scadgen frame 3.4.6.4 --edge-length 60 --side 10 --picture tiling.svg
    scadgen frame drawing.svg --tolerance 0.1 -o frame.json
    """  # noqa: D301  click wants the character
    if listing:
        if name is not None:
            msg = f"--list with FRAME {name!r}: give one of them"
            raise InputError(msg)
        _list(as_json=as_json)
        return 0
    if name is None:
        msg = "FRAME: is missing; name a file, or one of those that scadgen frame --list shows"
        raise InputError(msg)
    targets = _targets(Path(name), output, picture, force=force)
    _check_range("side", side, "mm", SIDES)
    from scadgen.check.frame import rings
    from scadgen.emit.frame_picture import frame_svg
    from scadgen.frame.classes import Snapped
    from scadgen.joint.weave import LIMITS, built_in
    from scadgen.plane.catalogue import ALIASES, NAMES
    from scadgen.readers.json_frame import dumps

    _check_range("ring-ratio", ring_ratio, "sides", LIMITS["ring_ratio"])
    given = [n for n, v in options.items() if v is not None and v is not False]
    family = NAMES.get(ALIASES.get(name, name))
    regular = family is not None and family.regular and has_cells(name, given)
    with status("looking at the frame"):
        wanted = _USUAL_SIDE if side is None else side
        read = load_frame(name, options, lambda drawn: share_of_room(drawn, wanted))
        if regular and ring_ratio is None:
            ring_ratio = built_in(int(read.frame.degree.max()), "fixed").ring_ratio
        kinds = _kinds(read.frame, snap_angle, snap_length)
        snapped, same = (kinds, kinds.same) if isinstance(kinds, Snapped) else (None, kinds)
        build = rings(read.frame, same, ring_ratio, fixed=regular)
        said = report(build, read.notes, snapped, side)
        if "json" in targets:
            targets["json"].put(dumps(read.frame).encode(), "json")
        if "svg" in targets:
            drawn = frame_svg(read.frame, same, read.places, build.places(side))
            targets["svg"].put(drawn.encode(), "svg")
    if as_json:
        click.echo(json.dumps(said, indent=1))
    else:
        show(said)
    return int(side is not None and bool(said["in_the_way"]))


def _kinds(frame: Frame, angle: float | None, length: float | None) -> Classes | Snapped:
    """What is the same; snapped if an angle, in degrees, or a length is given for that."""
    import inspect

    from scadgen.frame.classes import classify, snap

    known = inspect.signature(classify).parameters
    most = float(frame.ends.gap.min()) / 4
    if angle is not None and not 0 < angle < math.degrees(most):
        msg = (
            f"snap-angle = {angle:g} degrees: must be above 0 and under {math.degrees(most):.4g}, "
            "a quarter of the smallest angle between two edges"
        )
        raise InputError(msg)
    if length is not None and not 0 < length < math.inf:
        msg = f"snap-length = {length:g} mm: must be a positive number of mm"
        raise InputError(msg)
    turn = None if angle is None else math.radians(angle)
    within = known["length_tolerance"].default if length is None else length
    if angle is None and length is None:
        return classify(frame, turn, within)
    return snap(frame, turn, within)


def _check_range(what: str, value: float | None, unit: str, limits: tuple[float, float]) -> None:
    if value is not None and not limits[0] <= value <= limits[1]:
        msg = f"{what} = {value:g} {unit}: must be from {limits[0]:g} to {limits[1]:g}"
        raise InputError(msg)


def _targets(
    source: Path, output: Path | None, picture: Path | None, *, force: bool
) -> dict[str, Target]:
    """Where to write, by kind; refused before any work if it may not be, or not be read again."""
    from scadgen.emit.target import target

    targets = {}
    for path, kind in ((output, "json"), (picture, "svg")):
        if path is None:
            continue
        targets[kind] = target(path, [source], force=force)
        if path.suffix.lower() != f".{kind}":
            msg = f"{str(path)!r}: must end in .{kind}"
            raise InputError(msg)
    return targets


def _list(*, as_json: bool) -> None:
    """Print the named frames; those with the same options together."""
    from scadgen.plane.catalogue import ALIASES, NAMES
    from scadgen.readers.read import READERS

    others = {n: [alias for alias, of in ALIASES.items() if of == n] for n in NAMES}
    if as_json:
        named = [
            {"name": n, "other_names": others[n], "text": f.text, "options": f.defaults}
            | {"about": about_named(f.options)}
            for n, f in NAMES.items()
        ]
        files = [{"ending": ending, "about": about_file(ending)} for ending in READERS]
        click.echo(json.dumps({"named": named, "files": files}, indent=1))
        return
    groups: dict[str, list[tuple[str, str, str]]] = {}
    for name, family in NAMES.items():
        known = ", ".join(
            option(n) + ("" if default is None else f" {default}")
            for n, default in family.defaults.items()
        )
        groups.setdefault(known, []).append((f"  {name}", family.text, ", ".join(others[name])))
    for known, lines in groups.items():
        click.echo(known)
        table(lines[0], lines[1:])
        click.echo()
    click.echo(
        "Numbers are defaults; without rows, columns, radius or outline there are 3 x 3 cells."
    )
