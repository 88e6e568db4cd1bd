"""``scadgen render``: draw a kit's parts with OpenSCAD."""

from __future__ import annotations

import os
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import click

from scadgen.api.words import meant
from scadgen.cli.console import status, table, timeout_option
from scadgen.errors import InputError

__all__ = ["render"]


@click.command(short_help="Draw a kit's parts with OpenSCAD.")
@click.argument("folder", metavar="KIT", type=click.Path(path_type=Path))
@click.option("--part", "parts", multiple=True, help="Which part; several times for several.")
@click.option(
    "--format",
    "kind",
    default="stl",
    show_default=True,
    metavar="stl|3mf|png",
    help="Kind of file; its folder in the kit has the same name.",
)
@click.option(
    "--set",
    "changes",
    multiple=True,
    metavar="NAME=MM",
    help="Another value for a live parameter, or for number_height, the height of the numbers on "
    "tubes; several times for several.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    default=os.cpu_count() or 1,
    help="How many parts are drawn at once.",
)
@timeout_option
def render(
    folder: Path,
    parts: tuple[str, ...],
    kind: str,
    changes: tuple[str, ...],
    jobs: int,
    timeout: float,
) -> None:
    """Draw a kit's parts with OpenSCAD into its folder stl, 3mf or png.

    An STL is read back and must be watertight, and OpenSCAD must not have complained.
    """
    from scadgen.cli.export import settings
    from scadgen.emit.scad_numbers import HEIGHT
    from scadgen.emit.scad_parameters import views
    from scadgen.kit.store import load
    from scadgen.tools import openscad
    from scadgen.tools.stl import check_stl
    from scadgen.tools.threemf import name_object

    kit = load(folder)
    if kind not in ("stl", "3mf", "png"):
        msg = f"--format {kind}: must be stl, 3mf or png"
        raise InputError(msg)
    known = (*kit.parts, *views(kit))
    for part in parts:
        if part not in known:
            msg = f"part = {part!r}: must be one of {', '.join(known)}{meant(part, known)}"
            raise InputError(msg)
    values = settings(kit, changes, (HEIGHT,))
    target = folder / kind
    try:
        target.mkdir(exist_ok=True)
    except OSError as error:
        msg = f"cannot write to {str(target)!r}: {error.strerror}"
        raise InputError(msg) from error

    stop = threading.Event()

    def draw(part: str) -> tuple[str, str, str]:
        output = target / f"{part}.{kind}"
        options = openscad.PICTURE if kind == "png" else ()
        scad = folder / f"{kit.name}.scad"
        setting: dict[str, str | float] = {"part": part, **values}
        done = openscad.render(scad, output, setting, timeout=timeout, options=options, stop=stop)
        if kind == "3mf":
            name_object(output, part)
        content = f"{check_stl(output) / 1000:.2f} cm3, watertight" if kind == "stl" else ""
        return click.format_filename(output), f"{done.seconds:.1f} s", content

    try:
        with status(f"drawing {folder}"), ThreadPoolExecutor(jobs) as pool:
            try:
                rows = list(pool.map(draw, parts or tuple(kit.parts)))
            except BaseException:  # an interrupt as well: nothing is left running
                stop.set()
                pool.shutdown(wait=False, cancel_futures=True)
                raise
    finally:
        if not any(target.iterdir()):
            target.rmdir()
    table(("file", "time", ""), rows)
