"""``scadgen kit``: make a kit."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from scadgen.api.command import command_line
from scadgen.api.curves import told_of_curves
from scadgen.api.request import keys_note, kit_request
from scadgen.cli.console import Bar, counted, force_option, progress
from scadgen.cli.length import LENGTH
from scadgen.cli.source_options import source_options
from scadgen.kit.live import LIVE, PARAMETERS

if TYPE_CHECKING:
    from scadgen.kit.build import Request
    from scadgen.kit.model import Kit
    from scadgen.work.mapping import Execution

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
    help="Folder of the kit; a kit that is there is replaced.  [default: the frame's name]",
)
@click.option(
    "--rows", type=int, help="Cells, bottom to top.  [default: 3; hexagonal and square 2]"
)
@click.option(
    "--columns", type=int, help="Cells, left to right.  [default: 3; hexagonal and square 2]"
)
@click.option(
    "--key",
    metavar="fixed|loose",
    help="fixed: pegs are part of the tubes, for frames made of rows that slide onto parallel "
    "pegs.  loose: pegs are put in from the ring's hole, for any frame.  "
    "[default: loose; hexagonal and square fixed]",
)
@click.option(
    "--rim",
    default="caps",
    show_default=True,
    metavar="caps|open",
    help="What joints at the rim have in place of the edges that they lack: a connector without a "
    "tube, or nothing.  With open the kit has no sliders for rows and columns.",
)
@click.option(
    "--detail",
    default="standard",
    show_default=True,
    metavar="draft|standard|fine",
    help="How finely curved walls are cut into triangles.",
)
@click.option(
    "--weave",
    metavar="NAME|FILE",
    help="The curves that connectors grow around, for hexagonal and square: a built-in weave, or a "
    "JSON file with ring_ratio, span, amplitude, bend, periods and, if wanted, stretch.  "
    "[default: by each joint's angles]",
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
    "--unchecked", is_flag=True, help="Prove nothing: the joints may not lock, or not come apart."
)
@click.option(
    "--jobs", type=int, metavar="N", help="How many processes compute.  [default: one a core]"
)
@click.option(
    "--dask",
    metavar="ADDRESS",
    help="Compute on the Dask cluster with this scheduler: tcp://HOST:PORT.",
)
@click.option(
    "--no-cache",
    is_flag=True,
    help="Compute everything, and keep none of it.  Else joints and proofs are kept for other kits "
    "in the folder that SCADGEN_CACHE names, by default ~/.cache/scadgen.",
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

    FRAME is a name that scadgen frame --list shows, such as hexagonal, or a file: JSON, SVG, DXF,
    OBJ or OFF.  The rows and columns of a named tiling are sliders in the kit too, unless it
    fills a radius or an outline.

    It first proves that every joint locks, and comes apart without its pegs.  Then it writes the
    kit's folder: an OpenSCAD file with sliders, a FreeCAD macro, a Makefile, a README with what to
    print, pictures, and kit.json.  If anything fails, nothing is written.

    Lengths are in mm, or have a unit: 8, 8mm, 0.8cm or 0.3in.

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
    from scadgen.work.executor import open_executor
    from scadgen.work.mapping import Execution

    material = check_material(material)
    request, notes = kit_request(frame, options, PARAMETERS, _command())
    folder = output or Path(request.name)
    read = [Path(frame), *([Path(options["weave"])] if options["weave"] else [])]
    check_folder(folder, request.name, read, force=force)
    told: list[str] = []
    with (
        told_of_curves(notes),
        open_executor(jobs, dask, told.append) as crew,
        progress(f"making {folder}") as bar,
    ):
        means = Execution(crew, None if no_cache else Cache(default_folder()))
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
    notes = (*notes, *told, *keys_note(made))
    if as_json:
        said = {"folder": str(folder), "notes": notes, **summary(made)}
        click.echo(json.dumps(said, indent=1))
    else:
        _say(made, folder, notes)


def _made(request: Request, means: Execution, bar: Bar, *, unchecked: bool) -> tuple[Kit, float]:
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
    context = click.get_current_context()
    given = {
        name: context.params[name]
        for parameter in context.command.params
        if (name := parameter.name or "") not in _NOT_MADE
        and context.get_parameter_source(name) != click.core.ParameterSource.DEFAULT
    }
    return command_line(str(context.params["frame"]), given)
