"""Dask clusters on this machine: a scheduler and its workers, in processes of their own."""

import os
import re
import subprocess
import sys
import time
from contextlib import contextmanager

__all__ = ["cluster"]

#: Seconds in which a scheduler starts.
_STARTS = 60.0


class Cluster:
    """A scheduler that listens on a free port, and workers of one thread each.

    Nothing listens but on this machine, and no page of status is served.
    """

    def __init__(self, folder):
        self._folder, self._processes = folder, []
        self.scheduler = self._start("scheduler", "--port", "0", "--no-show")
        self.address = self._address()
        self.workers = []

    def hire(self, count):
        """Start workers."""
        self.workers += [
            self._start(
                "worker", self.address, "--nthreads", "1", "--no-nanny", "--worker-port", "0"
            )
            for _ in range(count)
        ]

    def close(self):
        """End all that was started."""
        for process in reversed(self._processes):
            process.kill()
            process.wait()

    def _start(self, what, *arguments):
        name = f"{what}-{len(self._processes)}"
        with (self._folder / f"{name}.log").open("wb") as log:
            process = subprocess.Popen(
                [
                    *(sys.executable, "-m", "distributed.cli.dask_" + what, *arguments),
                    *("--host", "127.0.0.1", "--no-dashboard"),
                ],
                stderr=log,
                stdout=log,
                cwd=self._folder,
                env=os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
            )
        self._processes.append(process)
        return process

    def _address(self):
        end = time.monotonic() + _STARTS
        while time.monotonic() < end and self.scheduler.poll() is None:
            log = (self._folder / "scheduler-0.log").read_text()
            found = re.search(r"Scheduler at:\s+(tcp://127\.0\.0\.1:\d+)", log)
            if found:
                return found[1]
            time.sleep(0.1)
        raise AssertionError(log)


@contextmanager
def cluster(folder, workers):
    """A cluster with some workers, as long as it is needed."""
    started = Cluster(folder)
    try:
        started.hire(workers)
        yield started
    finally:
        started.close()
