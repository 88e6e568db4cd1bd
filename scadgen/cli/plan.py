"""``scadgen plan``: in which order a frame goes together."""

from __future__ import annotations

from pathlib import Path

import click

from scadgen.cli.console import progress

__all__ = ["plan"]


@click.command(short_help="Plan in which order a frame goes together.")
@click.argument("folder", metavar="KIT", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    help="Folder of the plan; a plan that is there is replaced.  [default: plan in the kit's]",
)
@click.option("--json", "as_json", is_flag=True, help="Print the plan as JSON.")
def plan(folder: Path, output: Path | None, as_json: bool) -> int:  # noqa: FBT001
    """Plan in which order a frame goes together, and prove every step.

    For each part there is a way in that is proved to touch nothing that is there already.  Rows on
    parallel pegs go in as one.  Writes the steps as plan.txt, as a picture each, and as plan.json.

    Exit status 0 if every step is proved and nothing in the finished frame can move unless a peg
    slides, 1 if not.

    \b
    scadgen plan out/hexagonal
    scadgen plan out/hexagonal -o steps --json
    """  # noqa: D301  click wants the character
    from scadgen.api.planned import planned
    from scadgen.kit.store import load
    from scadgen.plan.folder import check_plan_folder, write_plan

    kit = load(folder)
    target = output or (folder if folder.is_dir() else folder.parent) / "plan"
    check_plan_folder(target)
    with progress(f"planning {folder}") as bar:
        made = planned(kit, bar.reach)
        files = made.files()
        write_plan(files, target)
    click.echo(files["plan.json"] if as_json else files["plan.txt"], nl=False)
    if not as_json:
        click.echo(f"next: the pictures in {click.format_filename(target)}")
    return 0 if made.good else 1
