"""Measure scadgen: python benchmarks/bench.py.

Prints each figure with its aim and whether it is met; what is going on goes to stderr.
Always ends with status 0: figures depend on the machine, so the reader judges.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import drawing
import generating
import in_freecad
import locking
import planning
import proving
import refining
import scaling
from report import heading, line, progress

from scadgen.errors import ScadgenError

__all__: list[str] = []


def _try(measure: Callable[[str], None], frame: str) -> None:
    """Measure one frame; what scadgen refuses is a figure as well."""
    try:
        measure(frame)
    except ScadgenError as error:
        line(frame, str(error), met=False)


def main() -> None:
    """Measure everything."""
    start = time.monotonic()
    frames = ("hexagonal", "square")
    generating.measure(frames)
    _try(refining.growth, frames[0])
    for measure in (refining.accuracy, drawing.measure):
        for frame in frames:
            _try(measure, frame)
    locking.run()
    proving.run()
    planning.run()
    in_freecad.run()
    scaling.run()
    heading("This run")
    line("wall time", f"{time.monotonic() - start:.0f} s", "at most 300 s")
    progress("done")


if __name__ == "__main__":
    main()
