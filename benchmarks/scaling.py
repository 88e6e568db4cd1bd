"""Kits of many different joints, and a large one of equal joints: time, memory, speed-up.

python benchmarks/scaling.py [COUNT...]     joints, at least two counts; 1000 and 10000 take long
"""

from __future__ import annotations

import json
import math
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

import numpy as np
from report import heading, line, progress

__all__ = ["run"]

#: Numbers of different joints that are measured unless others are asked for.
_COUNTS = (10, 40)

#: Aims: CPU seconds a joint; how CPU time grows with the number of joints; MB; seconds for the
#: large kit; and its cells up and across.
_JOINT, _GROWTH, _MEGABYTES, _LARGE, _CELLS = 0.15, 1.1, 2000.0, 10.0, 100

#: Joints for the speed-up.
_SHARED = 100


def run(counts: Sequence[int] = _COUNTS) -> None:
    """Report all of it."""
    heading("Different joints of three edges at draft, not proved, each run a process of its own")
    taken = [(count, _joints(count)) for count in counts]
    for (few, first), (many, second) in pairwise(taken):
        growth = math.log(second / first) / math.log(many / few)
        aim = f"at most {_GROWTH}"
        line(f"growth from {few} to {many}", f"power {growth:.2f}", aim, met=growth <= _GROWTH)
    _speed_up()
    _large()


def _joints(count: int) -> float:
    """Report some joints; their CPU seconds."""
    progress(f"{count} joints")
    found = _child("count", str(count))
    line(
        f"{count} joints, CPU time each",
        f"{found['cpu'] / count:.2f} s",
        f"at most {_JOINT} s",
        met=found["cpu"] <= _JOINT * count,
    )
    _memory(f"{count} joints, peak memory", found["peak"])
    return found["cpu"]


def _memory(what: str, peak: float) -> None:
    aim = f"at most {_MEGABYTES:.0f} MB"
    line(what, f"{peak:.0f} MB", aim, met=peak <= _MEGABYTES)


def _speed_up() -> None:
    """Report the same joints on one core, two, and two Dask workers, and when they are kept."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        progress(f"{_SHARED} joints on one core")
        alone = _child("shared", "1")["wall"]
        line(f"{_SHARED} joints on one core", f"{alone:.1f} s")
        progress(f"{_SHARED} joints on two cores")
        both = _child("shared", "2", cache=folder)["wall"]
        line("on two cores", f"{both:.1f} s, {alone / both:.2f} times as fast")
        progress(f"{_SHARED} joints that are kept")
        kept = _child("shared", "2", cache=folder)["wall"]
        line("again, from the cache", f"{kept:.2f} s, {alone / kept:.0f} times as fast")
        progress(f"{_SHARED} joints on two Dask workers")
        with _cluster(folder) as address:
            there = _child("shared", address)["wall"]
        line("on two Dask workers", f"{there:.1f} s, {alone / there:.2f} times as fast")


def _large() -> None:
    """Report a large kit whose joints are the same, once with an empty cache, and again."""
    command = [*_scadgen(), "kit", "hexagonal", "--rows", str(_CELLS), "--columns", str(_CELLS)]
    heading(f"scadgen kit hexagonal of {_CELLS} x {_CELLS} cells at standard, with all proofs")
    with tempfile.TemporaryDirectory() as name:
        for what in ("for the first time", "again"):
            progress(f"large kit, {what}")
            before, start = _children(), time.monotonic()
            subprocess.run(
                [*command, "-o", f"{name}/kit"],
                env=os.environ | {"SCADGEN_CACHE": f"{name}/cache"},
                stdout=subprocess.DEVNULL,
                check=True,
            )
            wall, cpu = time.monotonic() - start, _children() - before
            aim = f"at most {_LARGE:g} s"
            line(what, f"{wall:.1f} s, {cpu:.1f} s of CPU time", aim, met=wall <= _LARGE)


def _scadgen() -> list[str]:
    return [sys.executable, "-c", "from scadgen.cli.main import main; main()"]


def _children() -> float:
    """CPU seconds of the processes that were waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _child(*words: str, cache: Path | None = None) -> dict[str, float]:
    """What a process of its own measures."""
    # One thread each: what is compared is processes.
    environ = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    environ["BENCH_CACHE"] = str(cache or "")
    done = subprocess.run(
        [sys.executable, __file__, *words], stdout=subprocess.PIPE, check=True, env=environ
    )
    found: dict[str, float] = json.loads(done.stdout)
    return found


def _measure(what: str, how: str) -> dict[str, float]:
    """Make joints; what that takes."""
    from scadgen.joint.weave import any_joint
    from scadgen.kit.compute import JointSpec, compute_joints
    from scadgen.work.cache import Cache
    from scadgen.work.executor import open_executor
    from scadgen.work.mapping import Execution

    count = int(how) if what == "count" else _SHARED
    rng, wanted = np.random.default_rng(7), []
    for _ in range(count):
        turns = np.radians(np.array([0.0, 120.0, 240.0]) + rng.uniform(-8, 8, 3) * [0, 1, 1])
        gaps = np.diff(np.append(turns, 2 * np.pi))
        weave = any_joint(float(gaps.min()))
        wanted.append(
            JointSpec(tuple(turns.tolist()), weave, "loose", "draft", wider=(0.0, 0.1, 0.2, 0.3))
        )
    compute_joints(wanted[:1], Execution())  # what is imported late is not counted
    jobs = 1 if what == "count" else int(how) if how.isdigit() else None
    address = None if how.isdigit() else how
    cache = Cache(Path(os.environ["BENCH_CACHE"])) if os.environ["BENCH_CACHE"] else None
    with open_executor(jobs, address, progress) as crew:
        cpu, start = time.process_time(), time.monotonic()
        # A hundred at a time, as whoever has no use for all of them at once does.
        for first in range(0, count, 100):
            compute_joints(wanted[first : first + 100], Execution(crew, cache))
        cpu, wall = time.process_time() - cpu, time.monotonic() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return {"cpu": cpu, "wall": wall, "peak": peak}


@contextmanager
def _cluster(folder: Path) -> Iterator[str]:
    """The address of a Dask scheduler with two workers on this machine."""
    dask = [sys.executable, "-m", "distributed.cli.dask_"]
    local = ["--host", "127.0.0.1", "--no-dashboard"]
    log = folder / "scheduler.log"
    started: list[subprocess.Popen[bytes]] = []

    def start(what: str, *words: str) -> None:
        command = [*dask[:-1], dask[-1] + what, *words, *local]
        environ = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        with log.open("ab") as file:
            started.append(subprocess.Popen(command, stdout=file, stderr=file, env=environ))

    try:
        start("scheduler", "--port", "0", "--no-show")
        address = None
        for _ in range(600):
            address = re.search(r"Scheduler at:\s+(tcp://\S+)", log.read_text())
            if address:
                break
            time.sleep(0.1)
        assert address, log.read_text()
        for _ in range(2):
            start("worker", address[1], "--nthreads", "1", "--no-nanny")
        yield address[1]
    finally:
        for process in reversed(started):
            process.kill()
            process.wait()


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] in ("count", "shared"):
        json.dump(_measure(*sys.argv[1:]), sys.stdout)
    else:
        run([int(count) for count in sys.argv[1:]] or _COUNTS)
