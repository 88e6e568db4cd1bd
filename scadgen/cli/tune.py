"""``scadgen tune``: search a better weave."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from scadgen.cli.console import force_option, progress, table
from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.tune.search import WeaveSearch

__all__ = ["tune"]

_FILE = click.Path(path_type=Path)


@click.command(short_help="WeaveSearch a better weave.")
@click.option("--valence", default=3, show_default=True, metavar="N", help="Edges at the joint.")
@click.option("--key", default="fixed", show_default=True, metavar="fixed|loose", help="Key style.")
@click.option(
    "--arm",
    default=0.2,
    show_default=True,
    metavar="SIDES",
    help="Thinnest section that the connectors' arms may have.",
)
@click.option(
    "--rounds",
    "count",
    default=24,
    show_default=True,
    metavar="N",
    help="Rounds of the search: each looks at 32 weaves and proves the best two.",
)
@click.option("--seed", default=1, show_default=True, help="The same finds the same.")
@click.option("--jobs", type=int, metavar="N", help="Processes.  [default: one a core]")
@click.option(
    "--record",
    type=_FILE,
    metavar="FILE",
    help="Write down all that is found; one that is there is gone on with.",
)
@click.option(
    "-o", "--output", type=_FILE, help="Write the tightest weave for scadgen kit --weave."
)
@force_option
@click.option("--json", "as_json", is_flag=True, help="Print the weaves as JSON.")
def tune(  # noqa: PLR0913, PLR0917  one argument an option
    valence: int,
    key: str,
    arm: float,
    count: int,
    seed: int,
    jobs: int | None,
    record: Path | None,
    output: Path | None,
    force: bool,  # noqa: FBT001
    as_json: bool,  # noqa: FBT001  click passes flags so
) -> int:
    """WeaveSearch the weaves of a regular joint for the least play.

    Prints those that no other beats both in play and in thickness of the arms.  Each of them
    is proved as scadgen kit proves a joint: it locks, also at twice the samples, comes apart
    in this key style, and its connectors own all of their tubes' faces.

    Exit status 0 if one was found, 1 if none.

    \b
    scadgen tune --valence 5 --rounds 48 --record five.jsonl -o five.json
    scadgen kit hexagonal --weave tight.json
    """  # noqa: D301  click wants the character
    from scadgen.emit.target import target
    from scadgen.joint.weave import Weave
    from scadgen.tune.judge import Wish
    from scadgen.tune.record import Record
    from scadgen.tune.run import rounds, start
    from scadgen.tune.search import WeaveSearch

    if jobs is not None and jobs < 1:
        msg = f"jobs = {jobs}: must be at least 1"
        raise InputError(msg)
    if count < 1:
        msg = f"rounds = {count}: must be at least 1"
        raise InputError(msg)
    if seed < 0:
        msg = f"seed = {seed}: must be at least 0"
        raise InputError(msg)
    place = target(output, [record] if record else [], force=force) if output else None
    wish = Wish(valence, key, arm)
    search = WeaveSearch(wish, seed, Record(record, wish, seed))
    with progress("tuning") as bar:
        for gone in rounds(search, start(valence), count, jobs):
            bar.reach(gone)
            bar.say(_state(search))
    found = [(Weave(*shape, name=f"tuned-{valence}-{key}"), f) for shape, f in search.front]
    if place and found:
        place.put((json.dumps(found[0][0].as_dict(), indent=1) + "\n").encode(), "json")
    if as_json:
        rows = [{**w.as_dict(), "play": f.play, "arm": f.arm} for w, f in found]
        click.echo(json.dumps(rows, indent=1))
    else:
        lines = [(f"{f.play:.1f}", f"{f.arm:.2f}", *map(str, w.shape)) for w, f in found]
        if lines:
            table(("play", "arm", "ring ratio", "span", "amplitude", "bend", "periods"), lines)
        click.echo(_state(search))
    return 0 if found else 1


def _state(search: WeaveSearch) -> str:
    """How far a search has come, in a line."""
    lock = sum(not found.refused for found in search.looked.values())
    best = f", play {search.front[0][1].play:.1f}" if search.front else ""
    return f"{len(search.looked)} looked at, {lock} lock{best}"
