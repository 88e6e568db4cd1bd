"""What a person at a terminal sees while something takes long."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from rich.progress import Progress

__all__ = ["Bar", "progress", "status", "table", "timeout_option"]

T = TypeVar("T")


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


class Bar:
    """A progress bar on stderr, on a terminal only.

    Parameters
    ----------
    text
        What runs.
    shown
        What shows it; None where nobody looks.
    """

    def __init__(self, text: str, shown: Progress | None) -> None:
        self._text, self._shown = text, shown
        self._task = shown.add_task(text, total=None) if shown else None

    def say(self, words: str) -> None:
        """Say what runs now."""
        if self._shown and self._task is not None:
            self._shown.update(self._task, description=f"{self._text}: {words}")

    def reach(self, share: float) -> None:
        """Show what share of all is done."""
        if self._shown and self._task is not None:
            self._shown.update(self._task, total=1.0, completed=min(share, 1.0))

    def track(self, things: Collection[T]) -> Iterator[T]:
        """Give one thing after the other; the bar shows how many are done."""
        for number, thing in enumerate(things):
            self.reach(number / len(things))
            yield thing
        self.reach(1.0)


@contextmanager
def progress(text: str) -> Iterator[Bar]:
    """Show a progress bar while something runs."""
    if not sys.stderr.isatty():
        yield Bar(text, None)
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        yield Bar(text, shown)


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print aligned columns on stdout."""
    lines = [tuple(header), *(tuple(row) for row in rows)]
    width = [max(len(line[n]) for line in lines) for n in range(len(header))]
    for line in lines:
        text = "  ".join(cell.ljust(w) for cell, w in zip(line, width, strict=True))
        click.echo(text.rstrip())
