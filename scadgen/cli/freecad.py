"""``scadgen freecad``: install the FreeCAD workbench."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click

__all__ = ["freecad"]

#: The oldest FreeCAD that the workbench runs in.
_OLDEST = (0, 20)

_mod_option = click.option(
    "--mod",
    type=click.Path(path_type=Path),
    metavar="FOLDER",
    help="FreeCAD's folder of addons.  [default: the one that FreeCAD uses]",
)


@click.group(short_help="Install the FreeCAD workbench.")
def freecad() -> None:
    """Install the workbench into FreeCAD, remove it, or say what is installed."""


@freecad.command("install", short_help="Put the workbench where FreeCAD looks for it.")
@_mod_option
@click.option("--copy", is_flag=True, help="Copy it.  Else it is linked, and changes with scadgen.")
def _install(mod: Path | None, copy: bool) -> None:  # noqa: FBT001  click passes flags so
    """Install the workbench; restart FreeCAD to see it.

    What scadgen did not put there is not overwritten.
    """
    from scadgen.tools.workbench import install

    place, found = _place(mod)
    done = install(place, copy=copy)
    _say_freecad(found)
    kind = "copied to" if copy else "linked at"
    click.echo(f"workbench {done.version} {kind} {click.format_filename(done.where)}")
    click.echo("next: start FreeCAD, or start it again, and choose the workbench Scadgen")


@freecad.command("uninstall", short_help="Remove the workbench.")
@_mod_option
def _uninstall(mod: Path | None) -> None:
    """Remove the workbench, if scadgen installed it and nobody changed it."""
    from scadgen.tools.workbench import uninstall

    place, _ = _place(mod)
    gone = uninstall(place)
    click.echo(f"{gone.kind} removed: {click.format_filename(gone.where)}")


@freecad.command("status", short_help="Say what is installed.")
@_mod_option
@click.option("--json", "as_json", is_flag=True, help="Say it as JSON.")
def _status(mod: Path | None, as_json: bool) -> int:  # noqa: FBT001
    """Say which FreeCAD there is, where it looks, and whether the workbench is there.

    Exit status 0 if the workbench of this scadgen is installed, 1 if not.
    """
    from scadgen.emit.macro import workbench
    from scadgen.tools.workbench import inspect

    place, found = _place(mod)
    state = inspect(place)
    if as_json:
        facts = {**asdict(state), "where": str(state.where), "source": str(workbench())}
        facts["freecad"] = None
        if found is not None:
            facts["freecad"] = {**asdict(found), "data": str(found.data)}
        click.echo(json.dumps(facts, indent=1))
    else:
        _say_freecad(found)
        words: dict[str, str] = {
            "none": "not installed; scadgen freecad install does it",
            "other": f"not ours: {state.why}",
            "link": f"workbench {state.version}, linked",
            "copy": f"workbench {state.version}, copied"
            + ("" if state.current else ", not the present one; install --copy again"),
        }
        click.echo(f"{click.format_filename(state.where)}: {words[state.kind]}")
    return 0 if state.current else 1


def _place(mod: Path | None) -> tuple[Path, Any]:
    """FreeCAD's folder of addons, and the FreeCAD that was found."""
    from scadgen.tools.freecad import find, mod_folder

    found = find()
    return mod or mod_folder(found), found


def _say_freecad(found: Any) -> None:  # noqa: ANN401  imported late
    if found is None:
        click.echo("FreeCAD: not found on the path; SCADGEN_FREECAD may name freecadcmd")
        return
    numbers = tuple(int(n) for n in found.version.split(".")[:2])
    old = "" if numbers >= _OLDEST else ": too old, the workbench needs 0.20"
    click.echo(f"FreeCAD {found.version}, {found.program}{old}")
