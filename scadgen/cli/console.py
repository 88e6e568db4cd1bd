"""What a person at a terminal sees while something takes long."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import click

__all__ = ["status", "table", "timeout_option"]


def _seconds(_: click.Context, __: click.Parameter, value: float) -> float:
    """Refuse what is no length of time."""
    if not 0 < value < math.inf:
        msg = f"{value:g} s: must be a finite number above 0"
        raise click.BadParameter(msg)
    return value


def timeout_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the option of how long OpenSCAD may take for one drawing."""
    option = click.option(
        "--timeout",
        default=300.0,
        show_default=True,
        metavar="S",
        callback=_seconds,
        help="Limit a drawing.",
    )
    return option(command)


@contextmanager
def status(text: str) -> Iterator[Callable[[str], None]]:
    """Show a spinner and a text on stderr while something runs, on a terminal only.

    Yields
    ------
    say
        Changes the text.
    """
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console

    with Console(stderr=True).status(text) as shown:
        yield shown.update


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print aligned columns on stdout."""
    lines = [tuple(header), *(tuple(row) for row in rows)]
    width = [max(len(line[n]) for line in lines) for n in range(len(header))]
    for line in lines:
        text = "  ".join(cell.ljust(w) for cell, w in zip(line, width, strict=True))
        click.echo(text.rstrip())
