"""Work done by a Dask cluster, through joblib; what it leaves undone is told, not lost."""

from __future__ import annotations

import logging
import queue
import re
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, TypeVar

from scadgen.errors import InputError
from scadgen.work.attempt import Outcome, attempt
from scadgen.work.fingerprint import fingerprint

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["ClusterLostError", "cluster", "outcomes"]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")

#: Seconds within which a scheduler must answer, and have a worker.
_PATIENCE = 3.0

#: Addresses of schedulers.
_ADDRESS = re.compile(r"((tcp|tls|ucx|ws|wss)://)?[^/\s]+:\d{1,5}/?")

#: Seconds between looks at whether a cluster that is silent is still there, and for which it
#: may be without workers.
_LOOK, _IDLE = 1.0, 10.0


class ClusterLostError(Exception):
    """A cluster that was there is gone, or cannot go on; its text says which."""


@contextmanager
def cluster(address: str) -> Iterator[Client]:
    """A connection to a Dask scheduler.

    Raises
    ------
    InputError
        Dask is not installed; the address is none, or there is no scheduler; it has no workers,
        or one that has not this very scadgen.
    """
    if not _ADDRESS.fullmatch(address):
        msg = f"--dask {address}: must be the address of a Dask scheduler, as tcp://HOST:PORT"
        raise InputError(msg)
    try:
        from distributed import Client
    except ImportError as error:
        msg = f"--dask {address}: needs Dask: pip install 'scadgen-truss[dask]'"
        raise InputError(msg) from error
    # What goes wrong is told here, in a line.
    logging.getLogger("distributed").setLevel(logging.CRITICAL + 1)
    try:
        client = Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:  # a TimeoutError is an OSError
        msg = (
            f"--dask {address}: no Dask scheduler answers there within {_PATIENCE:g} s; "
            "dask scheduler starts one, and without --dask this machine's cores work"
        )
        raise InputError(msg) from error
    try:
        _check_workers(client, address)
        yield client
    finally:
        with suppress(Exception):  # it may be gone
            client.close(timeout=_PATIENCE)


def _check_workers(client: Client, address: str) -> None:
    """Refuse a cluster that cannot compute what this process would.

    Raises
    ------
    InputError
        It has no workers, or one without this very scadgen.
    """
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError as error:
        msg = f"--dask {address}: the scheduler has no workers; dask worker {address} starts one"
        raise InputError(msg) from error
    try:
        marks = client.run(fingerprint)
    except Exception as error:  # whatever an import there raises
        msg = f"--dask {address}: its workers cannot run this scadgen: {error}"
        raise InputError(msg) from error
    for worker, mark in marks.items():
        if mark != _mark():
            msg = (
                f"--dask {address}: worker {worker} has another scadgen, Python, numpy, scipy, "
                "shapely or manifold3d: all must be the same for the parts to be"
            )
            raise InputError(msg)


def _mark() -> str:
    """What tells this scadgen from all others."""
    return fingerprint()


def outcomes(
    client: Client, function: Callable[[_Item], _Result], items: Sequence[_Item]
) -> Generator[Outcome[_Result], None, None]:
    """Outcomes of a cluster's workers, as they come.

    Parameters
    ----------
    client
        The connection.
    function, items
        As `Crew.outcomes` takes them.

    Raises
    ------
    ClusterLostError
        The cluster is gone, or fails.
    """
    # Who waits for a cluster may wait forever; so another thread does, and this one looks
    # whether the cluster is still there.
    found: queue.SimpleQueue[Any] = queue.SimpleQueue()
    stop = threading.Event()
    arguments = client, function, items, found, stop
    threading.Thread(target=_gather, args=arguments, daemon=True).start()
    seen = time.monotonic()
    try:
        for _ in items:
            while True:
                try:
                    outcome = found.get(timeout=_LOOK)
                    break
                except queue.Empty:
                    seen = _look(client, seen)
            if isinstance(outcome, BaseException):
                _look(client, seen)
                msg = f"the Dask cluster failed: {outcome!r}".splitlines()[0]
                raise ClusterLostError(msg) from outcome
            seen = time.monotonic()
            yield outcome
    finally:
        stop.set()


def _look(client: Client, seen: float) -> float:
    """When a cluster was last seen with workers.

    Raises
    ------
    ClusterLostError
        It is gone, or has had none for long.
    """
    try:
        workers = client.sync(_workers, client, callback_timeout=_PATIENCE)
    except Exception as error:  # whatever a connection that is cut raises
        msg = "the Dask scheduler is gone"
        raise ClusterLostError(msg) from error
    if workers:
        return time.monotonic()
    if time.monotonic() - seen > _IDLE:
        msg = "the Dask cluster has no workers any more"
        raise ClusterLostError(msg)
    return seen


async def _workers(client: Client) -> int:
    """How many workers a scheduler has now."""
    if client.status != "running":
        raise ConnectionError
    return len((await client.scheduler.identity())["workers"])


def _gather(
    client: Client,
    function: Callable[[_Item], _Result],
    items: Sequence[_Item],
    found: queue.SimpleQueue[Any],
    stop: threading.Event,
) -> None:
    """Put outcomes into a queue, or what went wrong."""
    from joblib import Parallel, delayed, parallel_config

    try:
        with parallel_config("dask", client=client):
            pool = Parallel(return_as="generator_unordered")
        work = (delayed(attempt)(function, number, item) for number, item in enumerate(items))
        for outcome in pool(work):
            found.put(outcome)
            if stop.is_set():
                return
    except BaseException as error:  # noqa: BLE001  it is raised by the one who waits
        found.put(error)
