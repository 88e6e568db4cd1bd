"""``scadgen kit``: make a kit."""

from __future__ import annotations

import json
import shlex
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from scadgen.api.request import kit_request
from scadgen.cli.console import Bar, counted, force_option, progress
from scadgen.cli.length import LENGTH
from scadgen.cli.source_options import source_options
from scadgen.errors import GeometryError, JointError
from scadgen.kit.live import LIVE, PARAMETERS

if TYPE_CHECKING:
    from scadgen.kit.build import Request
    from scadgen.kit.model import Kit
    from scadgen.work.each import Means

__all__ = ["kit"]

#: Shares of the time after which a joint is computed, and proved.
_COMPUTED, _PROVED = 0.2, 0.9

#: About as many proofs as a joint has, and files as a kit.
_PROOFS, _FILES = 12, 9


#: What has no say in what is made.
_NOT_MADE = ("frame", "output", "jobs", "dask", "no_cache", "force", "as_json")


def _lengths(function: Any) -> Any:  # noqa: ANN401  click's decorators are typed so
    """Add an option for each live parameter."""
    for live in reversed(LIVE):
        add = click.option(live.option, live.name, type=LENGTH, metavar="MM", help=live.help)
        function = add(function)
    return function


@click.command(short_help="Make a kit: everything to print a frame.")
@click.argument("frame", metavar="FRAME")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    help="Folder for the kit; one that is there is replaced.  [default: the frame's name]",
)
@click.option("--rows", type=int, help="Cells of the frame up.  [default: 2; others 3]")
@click.option("--columns", type=int, help="Cells of the frame across.  [default: 2; others 3]")
@click.option(
    "--key",
    metavar="fixed|loose",
    help="Pegs that are part of the tubes, or pegs put in from the ring's hole.  "
    "[default: fixed; other frames have loose ones only]",
)
@click.option(
    "--rim",
    default="caps",
    show_default=True,
    metavar="caps|open",
    help="Other frames: what joints at the rim have where they lack edges of inner ones.  With "
    "open, hexagonal and square frames are as others: loose pegs, no rows and columns to set.",
)
@click.option(
    "--detail",
    default="standard",
    show_default=True,
    metavar="draft|standard|fine",
    help="How finely.",
)
@click.option(
    "--weave",
    metavar="NAME|FILE",
    help="A built-in weave, or a JSON file with ring_ratio, span, amplitude, bend, periods and, if "
    "wanted, stretch.  [default: the one for the joint's edges and the key; other frames: by each "
    "joint's angles]",
)
@_lengths
@source_options(without=("rows", "columns", "edge_length"))
@click.option(
    "--material",
    default="PLA",
    show_default=True,
    metavar="NAME",
    help="For the bill of materials: PLA, PETG, ABS, ASA, PC or PA.",
)
@click.option(
    "--unchecked", is_flag=True, help="Make the kit even if its joints are not proved to lock."
)
@click.option("--jobs", type=int, metavar="N", help="Processes.  [default: one a core]")
@click.option(
    "--dask",
    metavar="ADDRESS",
    help="Compute on a Dask cluster: its scheduler, as tcp://HOST:PORT.",
)
@click.option(
    "--no-cache",
    is_flag=True,
    help="Neither use nor keep the joints and proofs of other kits in SCADGEN_CACHE, by default "
    "~/.cache/scadgen.",
)
@force_option
@click.option("--json", "as_json", is_flag=True, help="Say what was made as JSON.")
def kit(  # noqa: PLR0913, PLR0917  one argument an option
    frame: str,
    output: Path | None,
    material: str,
    unchecked: bool,  # noqa: FBT001  click passes flags so
    jobs: int | None,
    dask: str | None,
    no_cache: bool,  # noqa: FBT001
    force: bool,  # noqa: FBT001
    as_json: bool,  # noqa: FBT001
    **options: Any,  # noqa: ANN401  of the kit, its live parameters, and the frame
) -> None:
    """Make a kit for a frame.

    FRAME is hexagonal or square, another name that scadgen frame --list shows, or a file:
    JSON, SVG, DXF, OBJ or OFF.  Hexagonal and square frames have rows and columns that can be
    set later; all others, and these with a radius or an outline, are as they are.

    Writes kit.json, an OpenSCAD file with sliders, a Makefile, a README and a preview, all or
    nothing, once it is proved that every joint locks and comes apart without its pegs.  Lengths
    are in mm, or have a unit: 8, 8mm, 0.8cm or 0.3in.

    \b
    scadgen kit hexagonal -o out/hexagonal
    scadgen kit square --rows 3 --columns 4 --side 8 --clearance 0.15 -o shelf
    scadgen kit 4.8.8 --detail draft -o octagons
    scadgen kit drawing.svg --side 6
    """  # noqa: D301  click wants the character
    from scadgen.emit.folder import check_folder, write_kit
    from scadgen.kit.bill import check_material
    from scadgen.kit.store import summary
    from scadgen.work.cache import Cache, default_folder
    from scadgen.work.crew import hired
    from scadgen.work.each import Means

    material = check_material(material)
    request, notes = kit_request(frame, options, PARAMETERS, _command())
    folder = output or Path(request.name)
    read = [Path(frame), *([Path(options["weave"])] if options["weave"] else [])]
    check_folder(folder, request.name, read, force=force)
    told: list[str] = []
    with (
        _told_of_curves(notes),
        hired(jobs, dask, told.append) as crew,
        progress(f"making {folder}") as bar,
    ):
        means = Means(crew, None if no_cache else Cache(default_folder()))
        made, done = _made(request, means, bar, unchecked=unchecked)
        write = bar.steps(done, 1.0, _FILES)
        made = replace(made, material=material)
        write_kit(
            made,
            folder,
            read=read,
            force=force,
            progress=lambda file: write(f"writing {file}"),
        )
    if made.refused:
        choices = counted(len(made.refused), "choice")
        told.append(f"{choices} of a key not proved, or the frame loose with it: another is used")
    notes = (*notes, *told)
    if as_json:
        said = {"folder": str(folder), "notes": notes, **summary(made)}
        click.echo(json.dumps(said, indent=1))
    else:
        _say(made, folder, notes)


@contextmanager
def _told_of_curves(notes: Sequence[str]) -> Iterator[None]:
    """Say what helps if there is no room for joints in a drawing that has curves."""
    from scadgen.readers.curves import CURVED

    try:
        yield
    except GeometryError as error:
        # A joint that is not proved is no matter of room.
        if isinstance(error, JointError) or not any(note.startswith(CURVED) for note in notes):
            raise
        msg = f"{error}; a larger --flatten makes the segments of its curves longer"
        raise GeometryError(msg) from error


def _made(request: Request, means: Means, bar: Bar, *, unchecked: bool) -> tuple[Kit, float]:
    """The kit, proved unless that is not wanted, and the share of the time that is gone."""
    from scadgen.kit.build import build
    from scadgen.plan.keyed import proved_kit

    proving = bar.steps(_COMPUTED, _PROVED, _PROOFS)

    def computed(count: int, of: int) -> None:
        nonlocal proving
        proving = bar.steps(_COMPUTED, _PROVED, of if of > 1 else _PROOFS)
        bar.reach(_COMPUTED * count / of, f"computing the joints, {count} of {of}")

    bar.reach(0.0, "computing the joints")
    if unchecked:
        return build(request, means, computed), _COMPUTED
    return proved_kit(request, means, computed, lambda what: proving(f"proving {what}")), _PROVED


def _say(made: Kit, folder: Path, notes: Sequence[str]) -> None:
    """Say what was made, and what to do with it."""
    from scadgen.kit.store import summary

    for note in notes:
        click.echo(f"note: {note}")
    bill = summary(made)["bill"]
    edges = 0 if made.frame is None else len(made.frame.edges)
    size = f"{counted(edges, 'edge')} and {counted(len(made.vertices), 'joint')}"
    if made.cells is not None:
        size = f"{made.rows} x {made.columns} cells, {size}"
    click.echo(f"{click.format_filename(folder)}: {sum(bill.values())} pieces to print for {size}")
    for part, number in bill.items():
        click.echo(f"  {number:4d} {part}")
    place = shlex.quote(click.format_filename(folder))
    click.echo(f"next: scadgen render {place}, or make -C {place} -j2")


def _command() -> str:
    """The command line that makes the kit again: what was given, but where to."""
    from scadgen.emit.shell import shell_line

    context = click.get_current_context()
    frame = str(context.params["frame"])
    # A name that begins so would be an option.
    words = ["scadgen", "kit", f"./{frame}" if frame.startswith("-") else frame]
    for parameter in context.command.params:
        name = parameter.name or ""
        given = context.get_parameter_source(name) != click.core.ParameterSource.DEFAULT
        if given and name not in _NOT_MADE:
            value = context.params[name]
            words.append(parameter.opts[-1])
            if value is not True:  # a flag is its option alone
                words.append(repr(value) if isinstance(value, float) else str(value))
    return shell_line(words)
