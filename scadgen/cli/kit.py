"""``scadgen kit``: make a kit."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import Any

import click

from scadgen.cli.console import progress
from scadgen.errors import InputError

__all__ = ["kit"]

#: Shares of the time after which a joint is computed, and proved.
_COMPUTED, _PROVED = 0.2, 0.9

#: About as many proofs as a joint has, and files as a kit.
_PROOFS, _FILES = 12, 9

#: The live parameters: option, what it sets, the words about its default.
_LENGTHS = (
    ("side", "side of the square tubes", "10"),
    ("edge_length", "distance between two vertices", "6 sides; more for a wide ring"),
    ("clearance", "gap between mating faces", "0.2"),
    ("peg_width", "width of the square pegs", "0.4 sides"),
    ("peg_length", "length of the pegs", "0.6 sides; loose: as far as it must reach"),
    ("peg_clearance", "gap around the pegs", "the clearance"),
    ("peg_chamfer", "lead-in of the pegs' tips", "0.05 sides"),
    ("bore", "width of a bore along all edges; 0 for solid ones", "0"),
)


def _lengths(function: Any) -> Any:  # noqa: ANN401  click's decorators are typed so
    """Add an option for each live parameter."""
    for name, what, default in reversed(_LENGTHS):
        option = f"--{name.replace('_', '-')}"
        function = click.option(
            option,
            name,
            type=float,
            metavar="MM",
            help=f"{what.capitalize()}.  [default: {default}]",
        )(function)
    return function


@click.command(short_help="Make a kit: everything to print a frame.")
@click.argument("frame", metavar="hexagonal|square")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    help="Folder for the kit; one that is there is replaced.  [default: the frame's name]",
)
@click.option("--rows", type=int, default=2, show_default=True, help="Cells of the frame up.")
@click.option(
    "--columns", type=int, default=2, show_default=True, help="Cells of the frame across."
)
@click.option(
    "--key",
    default="fixed",
    show_default=True,
    metavar="fixed|loose",
    help="Pegs that are part of the tubes, or pegs put in from the ring's hole.",
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
    help="A built-in weave, or a JSON file with ring_ratio, span, amplitude, bend and periods."
    "  [default: the one for the joint's edges and the key]",
)
@_lengths
@click.option(
    "--unchecked", is_flag=True, help="Make the kit even if its joint is not proved to lock."
)
@click.option("--json", "as_json", is_flag=True, help="Say what was made as JSON.")
def kit(  # noqa: PLR0913, PLR0917  one argument an option
    frame: str,
    output: Path | None,
    rows: int,
    columns: int,
    key: str,
    detail: str,
    weave: str | None,
    unchecked: bool,  # noqa: FBT001  click passes flags so
    as_json: bool,  # noqa: FBT001
    **lengths: float | None,
) -> None:
    """Make a kit for a hexagonal or square frame.

    Writes kit.json, an OpenSCAD file with sliders, a Makefile, a README and a preview, all or
    nothing, once it is proved that the joint locks and comes apart without its peg.  Lengths
    are in mm.

    \b
    scadgen kit hexagonal -o out/hexagonal
    scadgen kit square --rows 3 --columns 4 --side 8 --clearance 0.15 -o shelf
    """  # noqa: D301  click wants the character
    from scadgen.check.proof import proved
    from scadgen.emit.folder import check_folder, write_kit
    from scadgen.kit.build import Request, build
    from scadgen.kit.store import summary

    values = {name: value for name, value in lengths.items() if value is not None}
    chosen = _weave(weave) if weave is not None else None
    folder = output or Path(frame)
    request = Request(frame, key, rows, columns, detail, chosen, values, _command())
    check_folder(folder)
    with progress(f"making {folder}") as bar:
        bar.reach(0.0, "computing the joint")
        made = build(request)
        done = _COMPUTED
        if not unchecked:
            step, done = bar.steps(_COMPUTED, _PROVED, _PROOFS), _PROVED
            made = proved(made, lambda what: step(f"proving the joint: {what}"))
        write = bar.steps(done, 1.0, _FILES)
        write_kit(made, folder, progress=lambda file: write(f"writing {file}"))
    if as_json:
        click.echo(json.dumps({"folder": str(folder), **summary(made)}, indent=1))
        return
    bill = summary(made)["bill"]
    count = sum(bill.values())
    click.echo(
        f"{click.format_filename(folder)}: {count} pieces to print for {rows} x {columns} cells"
    )
    for part, number in bill.items():
        click.echo(f"  {number:4d} {part}")
    place = shlex.quote(click.format_filename(folder))
    click.echo(f"next: scadgen render {place}, or make -C {place} -j2")


def _weave(name: str) -> Any:  # noqa: ANN401  imported late: the import takes a while
    """The built-in weave of a name, or the one in a file."""
    from scadgen.joint.weave import BUILT_IN, Weave

    if name in BUILT_IN:
        return BUILT_IN[name]
    path = Path(name)
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        msg = f"weave {name!r}: neither a file nor one of {', '.join(BUILT_IN)} ({error.strerror})"
        raise InputError(msg) from error
    except (ValueError, RecursionError) as error:
        msg = f"weave {name!r}: not a JSON file ({error})"
        raise InputError(msg) from error
    return Weave.from_dict(entries, path.stem)


def _command() -> str:
    """The command line that makes the kit again: what was given, but where to."""
    context = click.get_current_context()
    words = ["scadgen", "kit", str(context.params["frame"])]
    for parameter in context.command.params:
        name = parameter.name or ""
        given = context.get_parameter_source(name) != click.core.ParameterSource.DEFAULT
        if given and name not in ("frame", "output", "as_json"):
            value = context.params[name]
            words += [parameter.opts[-1], repr(value) if isinstance(value, float) else str(value)]
    return shlex.join(words)
