"""``scadgen bill``: what a kit's parts weigh, and how long they print."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from scadgen.api.command import remade
from scadgen.cli.console import force_option, kit_files, progress, table, timeout_option
from scadgen.errors import InputError, ToolError

if TYPE_CHECKING:
    from scadgen.kit.bill import Line
    from scadgen.kit.model import Kit, Slicing

__all__ = ["bill"]

_FILE = click.Path(path_type=Path)

#: Slicers that run at once: each has threads of its own.
_AT_ONCE = 2


@click.command(short_help="Say what to print: how many, how heavy, how long.")
@click.argument("folder", metavar="KIT", type=_FILE)
@click.option(
    "--material", metavar="NAME", help="PLA, PETG, ABS, ASA, PC or PA.  [default: the kit's]"
)
@click.option(
    "--profile", type=_FILE, metavar="FILE", help="Settings exported from PrusaSlicer (.ini)."
)
@click.option("--keep", is_flag=True, help="Write it into the kit's files.")
@click.option("-o", "--output", type=_FILE, metavar="FILE", help="Write it as CSV.")
@force_option
@click.option("--json", "as_json", is_flag=True, help="Say it as JSON.")
@timeout_option
def bill(
    folder: Path,
    material: str | None,
    profile: Path | None,
    keep: bool,  # noqa: FBT001  click passes flags so
    output: Path | None,
    force: bool,  # noqa: FBT001
    as_json: bool,  # noqa: FBT001
    timeout: float,
) -> None:
    """Say what a kit's frame needs: parts by number, how many, spares, volume and mass.

    Where PrusaSlicer is installed, each part is sliced, with supports, for its print time and its
    filament.  Without --profile, layers are 0.2 mm high and supports stand on the bed; all other
    settings are PrusaSlicer's own.

    \b
    scadgen bill out/hexagonal
    scadgen bill out/hexagonal --material PETG --profile mine.ini --keep
    """  # noqa: D301  click wants the character
    from scadgen.emit.folder import check_bill, update_bill
    from scadgen.emit.parts_csv import parts_csv
    from scadgen.emit.target import target
    from scadgen.kit.bill import as_json as bill_of
    from scadgen.kit.bill import check_material
    from scadgen.kit.store import load
    from scadgen.tools import slicer

    read = [*kit_files(folder), *([profile] if profile else [])]
    place_of_bill = target(output, read, force=force) if output else None
    if profile is not None and not profile.is_file():
        msg = f"profile {str(profile)!r}: no such file; PrusaSlicer exports one (File > Export)"
        raise InputError(msg)
    kit = load(folder)
    if material is not None:
        material = check_material(material)
        kit = replace(kit, material=material, command=remade(kit.command, "material", material))
    place = check_bill(kit, folder) if keep else folder
    program = slicer.find()
    if program is not None and kit.placements:
        kit = replace(kit, slicing=_sliced(kit, program, profile, timeout))
    elif profile is not None:
        msg = f"profile {str(profile)!r}: {_missing()}"
        raise ToolError(msg)
    if keep:
        update_bill(kit, place)
    if place_of_bill is not None:
        place_of_bill.put(parts_csv(kit).encode(), "csv")
    if as_json:
        click.echo(json.dumps(bill_of(kit), indent=1))
        return
    _show(kit)
    if kit.slicing is None and program is None:
        click.echo(f"no print times: {_missing()}")


def _missing() -> str:
    from scadgen.tools.slicer import NAMES

    return (
        f"{NAMES[0]} is not found; install it (Debian: apt install prusa-slicer), or name it in "
        "SCADGEN_PRUSA_SLICER"
    )


def _sliced(kit: Kit, program: str, profile: Path | None, timeout: float) -> Slicing:
    """What the slicer says of every part that the frame needs."""
    from scadgen.emit.mesh import mesh_bytes
    from scadgen.kit.bill import lines
    from scadgen.kit.model import Slicing
    from scadgen.tools.slicer import Sliced, slice_mesh

    parts = [line.part for line in lines(kit)]

    def one(part: str) -> Sliced:
        solid = kit.parts[part]
        mesh = mesh_bytes(solid.points(kit.values), solid.triangles, "stl")
        try:
            return slice_mesh(program, mesh, profile, timeout)
        except ToolError as error:
            msg = f"part {part}: {error}"
            raise ToolError(msg) from error

    found: dict[str, Sliced] = {}
    with progress("slicing") as bar, ThreadPoolExecutor(_AT_ONCE) as pool:
        step = bar.steps(0.0, 1.0, len(parts))
        try:
            for part, said in zip(parts, pool.map(one, parts), strict=True):
                found[part] = said
                step(part)
        except BaseException:  # an interrupt as well: what has not begun is left
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return Slicing(
        found[parts[0]].how,
        {part: said.seconds for part, said in found.items()},
        {part: said.filament for part, said in found.items()},
    )


def _show(kit: Kit) -> None:
    """The bill as a table, and the whole in a line."""
    from scadgen.kit.bill import in_words, lines
    from scadgen.kit.model import DENSITIES

    needed, density = lines(kit), DENSITIES[kit.material]
    rows = [
        (
            str(line.number),
            line.part,
            str(line.count),
            str(line.spares or ""),
            f"{line.volume / 1000:.2f}",
            f"{line.mass:.2f}",
            f"{line.count * line.mass:.1f}",
            *(_sliced_words(line, density) if kit.slicing else ()),
        )
        for line in needed
    ]
    header = ("no.", "part", "count", "spares", "cm3 each", "g each", "g all")
    table((*header, *(("time each", "time all", "filament g each") if kit.slicing else ())), rows)
    solid = sum(line.count * line.mass for line in needed)
    pieces = sum(line.count for line in needed)
    click.echo(f"{pieces} pieces, without spares: {solid:.0f} g of {kit.material} printed solid")
    if kit.slicing is not None:
        seconds = sum(line.count * (line.seconds or 0) for line in needed)
        spun = sum(line.count * (line.filament or 0.0) for line in needed) / 1000 * density
        click.echo(f"sliced one by one: {in_words(seconds)}, {spun:.0f} g; {kit.slicing.how}")


def _sliced_words(line: Line, density: float) -> tuple[str, str, str]:
    """Print time of one piece and of all, and filament for one; nothing where it is not known."""
    from scadgen.kit.bill import in_words

    each = whole = spun = ""
    if line.seconds is not None:
        each, whole = in_words(line.seconds), in_words(line.count * line.seconds)
    if line.filament is not None:
        spun = f"{line.filament / 1000 * density:.2f}"
    return each, whole, spun
