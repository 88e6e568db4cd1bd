"""``scadgen plan``: in which order a frame goes together."""

from __future__ import annotations

from pathlib import Path

import click

from scadgen.cli.console import progress

__all__ = ["plan"]

#: Shares of the time after which the order is proved, and the whole frame.
_ORDERED, _HELD = 0.8, 0.95


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
    from scadgen.kit.store import load
    from scadgen.plan.as_json import dumps, plan_entry
    from scadgen.plan.folder import check_plan_folder, write_plan
    from scadgen.plan.order import make_plan
    from scadgen.plan.picture import step_pictures
    from scadgen.plan.text import plan_text
    from scadgen.plan.whole import whole_frame

    kit = load(folder)
    target = output or (folder if folder.is_dir() else folder.parent) / "plan"
    check_plan_folder(target)
    with progress(f"planning {folder}") as bar:
        made = make_plan(kit, lambda share, words: bar.reach(_ORDERED * share, words))
        bar.reach(_ORDERED, "proving that the finished frame holds")
        whole = whole_frame(made.standing)
        bar.reach(_HELD, "drawing the steps")
        pictures = step_pictures(made)
        text, entry = plan_text(made, whole), plan_entry(made, whole, list(pictures))
        write_plan({"plan.json": dumps(entry), "plan.txt": text, **pictures}, target)
    click.echo(dumps(entry) if as_json else text, nl=False)
    if not as_json:
        click.echo(f"next: the pictures in {click.format_filename(target)}")
    return 0 if made.proved and whole.held else 1
