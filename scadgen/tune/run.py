"""Run a search on all cores for a time."""

from __future__ import annotations

import multiprocessing
import signal
import time
from collections.abc import Iterable, Iterator

from scadgen.frame.placement import KEYS
from scadgen.joint.weave import BUILT_IN, Weave
from scadgen.tune.search import Search

__all__ = ["rounds", "start"]


def start(valence: int) -> list[Weave]:
    """Weaves to begin with: the built-in ones for so many edges."""
    names = [f"{valence}-{key}" for key in KEYS]
    return list(dict.fromkeys(BUILT_IN[name] for name in names if name in BUILT_IN))


def rounds(
    search: Search, begin: Iterable[Weave], seconds: float, jobs: int | None = None
) -> Iterator[float]:
    """Search for a time.

    Parameters
    ----------
    search
        The search.
    begin
        Weaves to begin with.
    seconds
        Time after which it stops.
    jobs
        Processes that work; None for one a core.

    Yields
    ------
    seconds
        Time gone, after each step.
    """
    began = time.monotonic()
    context = multiprocessing.get_context("forkserver")
    # An interrupt is for the one who waits; leaving the block ends who works.
    with context.Pool(jobs, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as workers:
        for _ in search.rounds(workers, begin, seconds):
            yield time.monotonic() - began
