"""CPU time of what is proved of a kit's joint, and of its whole check.

python benchmarks/proving.py
"""

from __future__ import annotations

import os
import tempfile
from dataclasses import replace
from pathlib import Path

from report import heading, line, progress

from scadgen.check.proof import proofs, proved
from scadgen.check.run import checks
from scadgen.emit.folder import write_kit
from scadgen.kit.build import Request, build
from scadgen.kit.model import Kit
from scadgen.plane.catalogue import NamedTiling

__all__ = ["run"]

#: Aim: CPU seconds for the check of a kit, OpenSCAD's included.
_CHECK = 30.0


def run() -> None:
    """Report both frames."""
    for frame in ("hexagonal", "square"):
        heading(f"Proofs of the {frame} kit at standard, CPU time")
        kit = build(Request.tiled(NamedTiling(frame)))
        progress(f"{frame}: proofs on known ways")
        start = _cpu()
        made = proved(kit)
        line(
            "proved on known ways",
            f"{_cpu() - start:.1f} s",
            f"{len(made.joints[0].verdicts)} verdicts",
        )
        _searched(made)
        progress(f"{frame}: check")
        _checked(made)


def _searched(kit: Kit) -> None:
    """The same joint under a weave of another name, whose ways nobody knows."""
    (joint,) = kit.joints
    ring_ratio = float(joint.weave["ring_ratio"]) + 1e-4
    unknown = replace(joint, weave={**joint.weave, "ring_ratio": ring_ratio}, ways=())
    progress(f"{kit.name}: proofs with a search")
    start = _cpu()
    good = all(proof.result.good for proof in proofs(kit, unknown))
    line("ways searched for", f"{_cpu() - start:.1f} s", "found" if good else "not found")


def _checked(kit: Kit) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "kit"
        write_kit(kit, folder)
        start = _cpu()
        results = [r for found in checks(kit, folder, 300.0).values() for r in found]
        took = _cpu() - start
    bad = sum(not result.good for result in results)
    line(
        f"check, {len(results)} results, {bad} bad",
        f"{took:.1f} s",
        f"at most {_CHECK:g} s",
        met=took <= _CHECK and not bad,
    )


def _cpu() -> float:
    """CPU seconds of this process and of those that it has waited for."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


if __name__ == "__main__":
    run()
