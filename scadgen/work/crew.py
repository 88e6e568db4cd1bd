"""Who works: this process alone, or processes on several cores."""

from __future__ import annotations

import signal
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager
from dataclasses import dataclass
from typing import Any, TypeVar

from scadgen.errors import InputError, ScadgenError, ToolError

__all__ = ["ALONE", "Crew"]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")

#: An item's number, and its result or why there is none.
_Outcome = tuple[int, _Result | ScadgenError]


@dataclass(frozen=True, slots=True)
class Crew:
    """Who works.

    Parameters
    ----------
    jobs
        Processes that work at once; None for one a core.

    Raises
    ------
    InputError
        Fewer than one.
    """

    jobs: int | None = None

    def __post_init__(self) -> None:
        """Refuse what is no number of processes."""
        if self.jobs is not None and self.jobs < 1:
            msg = f"jobs = {self.jobs}: must be at least 1"
            raise InputError(msg)

    def outcomes(
        self, function: Callable[[_Item], _Result], items: Sequence[_Item]
    ) -> Generator[_Outcome[_Result], None, None]:
        """Apply a function to items.

        Parameters
        ----------
        function
            A public function of a module, which depends on nothing but its argument.
        items
            Its arguments.

        Yields
        ------
        number, outcome
            An item's number, and its result or why it was refused; in any order.

        Raises
        ------
        ToolError
            A process was ended from outside.
        """
        from joblib import cpu_count

        jobs = min(self.jobs or cpu_count(), len(items))
        if jobs <= 1:
            yield from map(_attempt, [function] * len(items), range(len(items)), items)
            return
        try:
            yield from _in_processes(function, items, jobs)
        except BrokenProcessPool as error:
            msg = f"one of {jobs} processes was ended, for want of memory perhaps: try --jobs 1"
            raise ToolError(msg) from error


#: Nobody but this process.
ALONE = Crew(1)


def _attempt(function: Callable[[_Item], _Result], number: int, item: _Item) -> _Outcome[_Result]:
    """The outcome of one item."""
    try:
        return number, function(item)
    except ScadgenError as error:
        return number, error


def _in_processes(
    function: Callable[[_Item], _Result], items: Sequence[_Item], jobs: int
) -> Generator[_Outcome[_Result], None, None]:
    """Outcomes of processes on this machine, as they come."""
    from joblib import Parallel, delayed, parallel_config

    # The matrices are small: threads of their own would only be in each other's way.
    with parallel_config("loky", n_jobs=jobs, inner_max_num_threads=1):
        pool = Parallel(return_as="generator_unordered")
    work = (delayed(_attempt)(function, number, item) for number, item in enumerate(items))
    with _uninterrupted():
        found: Any = pool(work)
    with closing(found):
        yield from found


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Let no interrupt through: processes that are started meanwhile never get any.

    An interrupt is for the one who waits, and ends who works.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
