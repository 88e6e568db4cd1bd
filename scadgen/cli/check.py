"""``scadgen check``: check a kit."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import click

from scadgen.cli.console import progress, table, timeout_option

__all__ = ["check"]

#: About as many results as a group of checks has.
_RESULTS = 10

#: Checks that failed which the last line names.
_NAMED = 3


@click.command(short_help="Check everything about a kit.")
@click.argument("folder", metavar="KIT", type=click.Path(path_type=Path))
@timeout_option
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def check(folder: Path, timeout: float, as_json: bool) -> int:  # noqa: FBT001
    """Check a kit.

    The kit's files; each part as a solid; that the parts of a joint fill it, stay inside it, and
    keep their clearance; that curves are followed finely enough; that joints lock and come apart;
    and that OpenSCAD draws the same parts.

    Exit status 0 if all is good, 1 if anything is not.
    """
    from scadgen.check.run import checks
    from scadgen.kit.store import load

    kit = load(folder)
    results = []
    with progress(f"checking {folder}") as bar:
        groups = checks(kit, folder, timeout, bar.say)
        for number, (what, found) in enumerate(groups.items()):
            bar.reach(number / len(groups), what)
            step = bar.steps(number / len(groups), (number + 1) / len(groups), _RESULTS)
            for result in found:
                results.append(result)
                step(result.check)
    if as_json:
        click.echo(json.dumps([asdict(result) for result in results], indent=1))
    else:
        rows = [("ok" if r.good else "FAILED", r.check, r.figure, r.bound) for r in results]
        table(("", "check", "found", "must be"), rows)
        bad = [result.check for result in results if not result.good]
        said = f"{len(results) - len(bad)} of {len(results)} checks are good"
        if bad:
            said += f"; FAILED: {', '.join(bad[:_NAMED])}{', ...' if len(bad) > _NAMED else ''}"
        click.echo(f"{click.format_filename(folder)}: {said}")
    return 0 if all(result.good for result in results) else 1
