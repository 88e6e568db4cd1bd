"""``scadgen export``: evaluate a part without any CAD tool."""

from __future__ import annotations

from pathlib import Path

import click

from scadgen.api.words import length, meant
from scadgen.cli.console import force_option, kit_files
from scadgen.errors import InputError
from scadgen.kit.model import Kit
from scadgen.solid.affine import Range

__all__ = ["export", "settings"]


@click.command(short_help="Write one part as a mesh, without any CAD tool.")
@click.argument("folder", metavar="KIT", type=click.Path(path_type=Path))
@click.option("--part", required=True, help="Which part: basic, half, ...")
@click.option(
    "--format",
    "kind",
    metavar="stl|3mf|obj|glb",
    help="Kind of file.  [default: by the output's ending]",
)
@click.option(
    "--set",
    "changes",
    multiple=True,
    metavar="NAME=MM",
    help="Another value for a live parameter; several times for several.",
)
@click.option(
    "-o", "--output", required=True, type=click.Path(path_type=Path), help="File to write."
)
@force_option
def export(
    folder: Path,
    part: str,
    kind: str | None,
    changes: tuple[str, ...],
    output: Path,
    force: bool,  # noqa: FBT001  click passes flags so
) -> None:
    """Write one part of a kit as STL, 3MF, OBJ or GLB.

    \b
    scadgen export out/hexagonal --part half --set clearance=0.3 -o half.stl
    """  # noqa: D301  click wants the character
    from scadgen.emit.mesh import mesh_bytes
    from scadgen.emit.target import target
    from scadgen.kit.store import load

    kind = _kind(kind, output)
    kit = load(folder)
    if part not in kit.parts:
        msg = f"part = {part!r}: must be one of {', '.join(kit.parts)}{meant(part, kit.parts)}"
        raise InputError(msg)
    place = target(output, kit_files(folder), force=force)
    solid = kit.parts[part]
    points = solid.points(settings(kit, changes))
    place.put(mesh_bytes(points, solid.triangles, kind, part), kind)
    click.echo(f"{click.format_filename(output)}: {part}, {len(solid.triangles)} triangles")


def _kind(kind: str | None, output: Path) -> str:
    """The kind of file to write: what was asked for, or what the output's ending says.

    Raises
    ------
    InputError
        They are two kinds.
    """
    from scadgen.emit.mesh import FORMATS

    ending = output.suffix.lstrip(".").lower()
    wanted = (kind or ending).lower()
    if ending != wanted and {ending, wanted} <= {*FORMATS}:
        msg = (
            f"format = {kind!r}: {str(output)!r} is {ending} by its ending; leave --format out, "
            f"or name a file that ends in .{wanted}"
        )
        raise InputError(msg)
    return wanted


def settings(
    kit: Kit, changes: tuple[str, ...], others: tuple[Range, ...] = ()
) -> dict[str, float]:
    """A kit's live parameters with some changed, checked against their ranges.

    Parameters
    ----------
    kit
        The kit.
    changes
        What was typed.
    others
        Ranges of what can be set too, and is 0 if it is not.

    Raises
    ------
    InputError
        A change that is not NAME=MM, names no live parameter, or leaves its range.  One of what
        only OpenSCAD draws is told where it works.
    """
    from scadgen.emit.scad_numbers import HEIGHT
    from scadgen.kit.ranges import check_values

    values = dict(kit.values) | {other.parameter: 0.0 for other in others}
    for change in changes:
        name, equals, text = change.partition("=")
        if equals and name not in values and name == HEIGHT.parameter:
            msg = (
                f"--set {change}: only OpenSCAD draws numbers; scadgen render KIT --set {change} "
                f"works, and so does make SET='-D {change}'"
            )
            raise InputError(msg)
        if not equals or name not in values:
            msg = (
                f"--set {change}: must be NAME=MM with NAME one of {', '.join(values)}"
                f"{meant(name, values)}"
            )
            raise InputError(msg)
        try:
            values[name] = length(text)
        except InputError as error:
            msg = f"--set {change}: {error}"
            raise InputError(msg) from None
    check_values([*kit.ranges, *others], values)
    return values
