"""Who works: this process alone, processes on several cores, or a Dask cluster."""

from __future__ import annotations

import signal
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

from scadgen.errors import InputError, ToolError
from scadgen.work.attempt import Outcome, attempt

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["ALONE", "Executor", "open_executor"]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


class Executor:
    """Who works.

    Parameters
    ----------
    jobs
        Processes that work at once on this machine; None for one a core.
    client
        A Dask cluster that works instead, while it is there.
    note
        Told in a line when the cluster is lost and this machine goes on.

    Raises
    ------
    InputError
        Fewer than one process.
    """

    def __init__(
        self,
        jobs: int | None = None,
        client: Client | None = None,
        note: Callable[[str], None] = lambda _: None,
    ) -> None:
        if jobs is not None and jobs < 1:
            msg = f"jobs = {jobs}: must be at least 1"
            raise InputError(msg)
        self._jobs, self._client, self._note = jobs, client, note

    def outcomes(
        self, function: Callable[[_Item], _Result], items: Sequence[_Item]
    ) -> Generator[Outcome[_Result], None, None]:
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
        left = list(range(len(items)))
        if self._client and len(items) > 1:
            for outcome in self._of_cluster(self._client, function, items):
                left.remove(outcome[0])
                yield outcome
        for place, result in self._of_machine(function, [items[number] for number in left]):
            yield left[place], result

    def _of_cluster(
        self, client: Client, function: Callable[[_Item], _Result], items: Sequence[_Item]
    ) -> Generator[Outcome[_Result], None, None]:
        """Outcomes of the cluster, as long as it is there."""
        from scadgen.work.cluster import ClusterLostError, outcomes

        try:
            yield from outcomes(client, function, items)
        except ClusterLostError as error:
            self._client = None
            self._note(f"{error}; this machine went on alone")

    def _of_machine(
        self, function: Callable[[_Item], _Result], items: Sequence[_Item]
    ) -> Generator[Outcome[_Result], None, None]:
        """Outcomes of this process, or of others on this machine where there are enough items."""
        from joblib import cpu_count

        jobs = min(self._jobs or cpu_count(), len(items))
        if jobs <= 1:
            for number, item in enumerate(items):
                yield attempt(function, number, item)
            return
        try:
            yield from _in_processes(function, items, jobs)
        except BrokenProcessPool as error:
            msg = f"one of {jobs} processes was ended, for want of memory perhaps: try --jobs 1"
            raise ToolError(msg) from error


#: Nobody but this process.
ALONE = Executor(1)


@contextmanager
def open_executor(
    jobs: int | None, address: str | None, note: Callable[[str], None]
) -> Iterator[Executor]:
    """A crew for as long as it is needed.

    Parameters
    ----------
    jobs, note
        As for `Executor`.
    address
        Of a Dask scheduler; None for this machine.

    Raises
    ------
    InputError
        Fewer than one process, or no cluster that can work at the address.
    """
    crew = Executor(jobs)
    if address is None:
        yield crew
        return
    from scadgen.work.cluster import cluster

    with cluster(address) as client:
        yield Executor(jobs, client, note)


def _in_processes(
    function: Callable[[_Item], _Result], items: Sequence[_Item], jobs: int
) -> Generator[Outcome[_Result], None, None]:
    """Outcomes of processes on this machine, as they come."""
    from joblib import Parallel, delayed, parallel_config

    # The matrices are small: threads of their own would only be in each other's way.
    with parallel_config("loky", n_jobs=jobs, inner_max_num_threads=1):
        pool = Parallel(return_as="generator_unordered")
    work = (delayed(attempt)(function, number, item) for number, item in enumerate(items))
    with _uninterrupted():
        found: Any = pool(work)
    with closing(found):
        yield from found


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Let no interrupt through: processes that are started meanwhile never get any.

    An interrupt is for the one who waits, and ends who works.
    """
    from multiprocessing import resource_tracker

    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    # Where it is not there yet, its start would let interrupts through again.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
