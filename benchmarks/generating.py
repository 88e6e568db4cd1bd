"""CPU time and peak memory of generating a kit, each in a process of its own."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from report import heading, line, progress

__all__ = ["measure"]

#: Aims: CPU seconds beyond importing the libraries, and peak memory.
_SECONDS, _MEGABYTES = 1.5, 400.0

_REPEATS = 3


def measure(frames: tuple[str, ...]) -> None:
    """Report generating the default kit of each frame."""
    heading(f"Generating a kit at standard: build and write, best of {_REPEATS} processes")
    for frame in frames:
        progress(f"generating {frame} {_REPEATS} times")
        runs = [_in_child(frame) for _ in range(_REPEATS)]
        if "error" in runs[0]:
            line(frame, str(runs[0]["error"]), met=False)
            continue
        build, write, loading, peak = (
            min(float(run[key]) for run in runs) for key in ("build", "write", "load", "peak")
        )
        line(
            f"{frame}, CPU time",
            f"{build + write:.2f} s = {build:.2f} + {write:.2f}",
            f"at most {_SECONDS} s",
            met=build + write <= _SECONDS,
        )
        line(f"{frame}, importing", f"{loading:.2f} s", "not counted")
        line(
            f"{frame}, peak memory",
            f"{peak:.0f} MB",
            f"at most {_MEGABYTES:.0f} MB",
            met=peak <= _MEGABYTES,
        )


def _in_child(frame: str) -> dict[str, float | str]:
    done = subprocess.run(
        [sys.executable, __file__, frame], stdout=subprocess.PIPE, check=True, timeout=120
    )
    found: dict[str, float | str] = json.loads(done.stdout)
    return found


def _generate(frame: str) -> dict[str, float | str]:
    """Import everything first, then make and write the kit."""
    start = time.process_time()
    import shapely  # noqa: F401  imported late by what is measured

    from scadgen.emit.folder import write_kit
    from scadgen.errors import ScadgenError
    from scadgen.kit.build import Request, build
    from scadgen.plane.catalogue import NamedTiling

    load = time.process_time()
    try:
        kit = build(Request.tiled(NamedTiling(frame), command=f"scadgen kit {frame}"))
    except ScadgenError as error:
        return {"error": str(error)}
    built = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        write_kit(kit, Path(folder) / frame)
    written = time.process_time()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return {"load": load - start, "build": built - load, "write": written - built, "peak": peak}


if __name__ == "__main__":
    json.dump(_generate(sys.argv[1]), sys.stdout)
