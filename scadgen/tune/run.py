"""Run a search on all cores."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Iterable, Iterator

from scadgen.frame.placement import KEYS
from scadgen.joint.weave import BUILT_IN, Weave
from scadgen.tune.search import WeaveSearch

__all__ = ["rounds", "start"]


def start(valence: int) -> list[Weave]:
    """Weaves to begin with: the built-in ones for so many edges."""
    names = [f"{valence}-{key}" for key in KEYS]
    return list(dict.fromkeys(BUILT_IN[name] for name in names if name in BUILT_IN))


def rounds(
    search: WeaveSearch, begin: Iterable[Weave], count: int, jobs: int | None = None
) -> Iterator[float]:
    """WeaveSearch for some rounds.

    Parameters
    ----------
    search
        The search.
    begin
        Weaves to begin with.
    count
        Number of rounds.
    jobs
        Processes that work; None for one a core.

    Yields
    ------
    share
        Of all rounds, gone after each half of one.
    """
    context = multiprocessing.get_context("forkserver")
    # An interrupt is for the one who waits; leaving the block ends who works.
    with context.Pool(jobs, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as workers:
        for half, _ in enumerate(search.rounds(workers, begin, count), start=1):
            yield half / (2 * count)
