"""What a person at a terminal sees while something takes long."""

from __future__ import annotations

import itertools
import math
import os
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import click

__all__ = [
    "Bar",
    "counted",
    "force_option",
    "kit_files",
    "progress",
    "status",
    "table",
    "timeout_option",
]

#: Seconds from one line of a log to the next, and to the first.
_EVERY = 5.0


def _seconds(_: click.Context, __: click.Parameter, value: float) -> float:
    """Refuse what is no length of time."""
    if not 0 < value < math.inf:
        msg = f"{value:g} s: must be a finite number above 0"
        raise click.BadParameter(msg)
    return value


def timeout_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the option of how long an outside program may take for one part."""
    option = click.option(
        "--timeout",
        default=300.0,
        show_default=True,
        metavar="S",
        callback=_seconds,
        help="Limit what OpenSCAD or PrusaSlicer takes for one part.",
    )
    return option(command)


def force_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the option to write over files that it would not write over otherwise."""
    option = click.option(
        "--force",
        is_flag=True,
        help="Write over any file.  Else only files that scadgen made, and that nobody changed "
        "since, are written over, and none that this command reads.",
    )
    return option(command)


def kit_files(kit: Path) -> list[Path]:
    """What a command reads of a kit that is named by its folder or by its file."""
    return [kit / "kit.json" if kit.is_dir() else kit]


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
    """How far something is, and what runs now.

    Parameters
    ----------
    show
        Told the share of all that is done, None where it is not known, and what runs.
    """

    def __init__(self, show: Callable[[float | None, str], None]) -> None:
        self._show = show
        self._share: float | None = None
        self._words = ""

    def say(self, words: str) -> None:
        """Say what runs now."""
        self._words = words
        self._show(self._share, words)

    def reach(self, share: float, words: str | None = None) -> None:
        """Show what share of all is done, and what runs now unless that is the same."""
        self._share = min(share, 1.0)
        self.say(self._words if words is None else words)

    def steps(self, start: float, stop: float, about: int) -> Callable[[str], None]:
        """What says one step after the other, and takes the bar from one share to another.

        Parameters
        ----------
        start, stop
            Shares of all.
        about
            About as many steps as there will be; those beyond move the bar no further.
        """
        number = itertools.count(1)

        def step(words: str) -> None:
            self.reach(start + (stop - start) * min(next(number) / about, 1.0), words)

        return step


@contextmanager
def progress(text: str) -> Iterator[Bar]:
    """Show on stderr how far something is that runs.

    On a terminal it is a bar; elsewhere, as in the log of a build, it is a line every few
    seconds.  For programs it is a line at every step, if ``SCADGEN_PROGRESS`` is ``lines``: a
    percentage, a space and what runs now, as in ``12% proving the joint``.  If it is ``none``
    there is nothing.
    """
    wanted = os.environ.get("SCADGEN_PROGRESS")
    if wanted == "lines":
        yield Bar(lambda share, words: click.echo(f"{share or 0:.0%} {words or text}", err=True))
    elif wanted == "none":
        yield Bar(lambda *_: None)
    elif sys.stderr.isatty():
        with _drawn(text) as bar:
            yield bar
    else:
        with _logged(text) as bar:
            yield bar


@contextmanager
def _drawn(text: str) -> Iterator[Bar]:
    """A bar on a terminal."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        task = shown.add_task(text, total=None)

        def show(share: float | None, words: str) -> None:
            total = None if share is None else 1.0
            description = f"{text}: {words}" if words else text
            shown.update(task, description=description, total=total, completed=share or 0.0)

        yield Bar(show)


@contextmanager
def _logged(text: str) -> Iterator[Bar]:
    """A line every few seconds, while there is something new to say."""
    latest, over = text, threading.Event()

    def show(share: float | None, words: str) -> None:
        nonlocal latest
        part = "" if share is None else f" {share:.0%}"
        latest = f"{text}:{part} {words}" if words else f"{text}{part}"

    def tell() -> None:
        told = ""
        while not over.wait(_EVERY):
            if latest != told:
                told = latest
                with suppress(OSError):  # a reader that has gone is no reason to stop
                    click.echo(told, err=True)

    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield Bar(show)
    finally:
        over.set()
        teller.join()


def counted(number: int, what: str) -> str:
    """So many of something: ``1 edge``, ``2 edges``."""
    return f"{number} {what}{'' if number == 1 else 's'}"


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print aligned columns on stdout."""
    lines = [tuple(header), *(tuple(row) for row in rows)]
    width = [max(len(line[n]) for line in lines) for n in range(len(header))]
    for line in lines:
        text = "  ".join(cell.ljust(w) for cell, w in zip(line, width, strict=True))
        click.echo(text.rstrip())
