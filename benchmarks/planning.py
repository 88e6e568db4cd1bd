"""CPU time and memory of a plan, and of the proof that a finished frame holds.

python benchmarks/planning.py
"""

from __future__ import annotations

import resource
import time

from report import heading, line, progress

from scadgen.check.proof import proved
from scadgen.kit.build import Request, build, laid_out
from scadgen.plan.order import make_plan
from scadgen.plan.standing import stand
from scadgen.plan.whole import whole_frame
from scadgen.plane.catalogue import NamedTiling

__all__ = ["run"]

#: Aims: CPU seconds for the proof of the whole frame; peak memory, in MB.
_WHOLE, _MEGABYTES = 60.0, 1000.0

#: Hexagons each way of the largest frame, and of the one that is planned.
_LARGE, _PLANNED = 10, 2


def run() -> None:
    """Report frames of hexagons at standard."""
    heading("Frames of hexagons at standard, CPU time")
    progress("proofs of a hexagonal kit")
    kit = proved(build(Request.tiled(NamedTiling("hexagonal"))))
    large = laid_out(kit, _LARGE, _LARGE)
    progress(f"the finished frame of {_LARGE} x {_LARGE} hexagons")
    start = time.process_time()
    whole = whole_frame(stand(large))
    took = time.process_time() - start
    line(
        f"{_LARGE} x {_LARGE}, {whole.parts} parts: {'held' if whole.held else 'NOT HELD'}",
        f"{took:.1f} s, {whole.contacts} contacts",
        f"at most {_WHOLE:g} s",
        met=took <= _WHOLE and whole.held,
    )
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    line("  peak memory", f"{peak:.0f} MB", f"at most {_MEGABYTES:g} MB", met=peak <= _MEGABYTES)
    small = laid_out(kit, _PLANNED, _PLANNED)
    progress(f"a plan of {_PLANNED} x {_PLANNED} hexagons")
    start = time.process_time()
    plan = make_plan(small)
    took = time.process_time() - start
    good = "proved" if plan.proved else "NOT PROVED"
    line(f"plan of {_PLANNED} x {_PLANNED}: {good}", f"{took:.1f} s, {plan.proofs} pairs")


if __name__ == "__main__":
    run()
