"""CPU time and memory of contacts, verdicts and certificates.

python benchmarks/locking.py
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

from report import heading, line, progress

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

__all__ = ["run"]

#: Aims: CPU seconds for a joint's verdict, and for contacts and verdict of many parts; peak
#: memory at the largest.
_JOINT, _MANY, _MEGABYTES = 0.05, 1.0, 2000.0

#: Side of the cube that parts fill, in cells, and how many they are.
_SIZES = ((8, 85), (12, 300), (18, 1000))

#: Seconds after which the textbook program is given up.
_PATIENCE = 120.0

_REPEATS = 5


def run() -> None:
    """Report everything about verdicts."""
    heading(f"Verdict on a joint at standard, median of {_REPEATS}, after contacts")
    for frame in ("hexagonal", "square"):
        progress(f"verdict on a {frame} joint")
        _joint(frame)
    heading("Contacts and verdict of parts grown at random in a box, a process each")
    for closed in (True, False):
        side, count = _SIZES[0]
        progress(f"{count} parts, {'closed' if closed else 'open'}, and the textbook program")
        found = _in_child(side, count, closed=closed, slack=True)
        name = f"{count} parts, box {'closed' if closed else 'open'}"
        took = found["contacts"] + found["verdict"]
        line(
            f"{name}: {'locked' if found['locked'] else 'movable'}",
            f"{took:.2f} s = {found['contacts']:.2f} + {found['verdict']:.2f}",
            f"at most {_MANY} s",
            met=took <= _MANY and found["rows"] >= 5000,
        )
        line("  rows, unknowns", f"{found['rows']:.0f} x {found['unknowns']:.0f}")
        beyond = "over " if found["gave_up"] else ""
        line(
            "  textbook slack program",
            f"{beyond}{found['slack']:.1f} s for the verdict",
            f"{beyond}{found['slack'] / found['verdict']:.0f} times ours",
        )
    heading("Growth: a closed box, locked, its certificate checked")
    for side, count in _SIZES:
        progress(f"{count} parts")
        found = _in_child(side, count, closed=True, slack=False)
        line(
            f"{count} parts, {found['rows']:.0f} rows",
            f"{found['contacts']:.2f} + {found['verdict']:.2f} + {found['check']:.2f} s",
            "contacts, verdict, check",
        )
        line(
            "  peak memory",
            f"{found['peak']:.0f} MB",
            f"at most {_MEGABYTES:.0f} MB",
            met=found["peak"] <= _MEGABYTES and bool(found["locked"]),
        )


def _joint(frame: str) -> None:
    from scadgen.check.geometry import placed
    from scadgen.interlock.assembly import make_assembly
    from scadgen.interlock.contacts import find_contacts
    from scadgen.interlock.verdict import Certificate, verdict
    from scadgen.kit.build import Request, build
    from scadgen.plane.catalogue import NamedTiling

    kit = build(Request.tiled(NamedTiling(frame)))
    values = {**kit.values, "clearance": 0.0, "peg_clearance": 0.0}
    meshes = [placed(kit, placement, values) for placement in kit.joints[0].pieces]
    names = [placement.part for placement in kit.joints[0].pieces]
    start = time.process_time()
    contacts = find_contacts(meshes, 1e-3 * values["side"])
    looked = time.process_time() - start
    held = (names.index("connector"), names.index("peg"))
    took = []
    for _ in range(_REPEATS):
        start = time.process_time()
        found = verdict(make_assembly(meshes, contacts, held))
        took.append(time.process_time() - start)
    answer = "locked" if isinstance(found, Certificate) else "MOVABLE"
    line(
        f"{frame}, peg held: {answer}",
        f"{1000 * median(took):.0f} ms",
        f"at most {1000 * _JOINT:.0f} ms",
        met=median(took) <= _JOINT and isinstance(found, Certificate),
    )
    line("  contacts", f"{len(contacts)} in {looked:.2f} s", "not counted")


def _in_child(side: int, count: int, *, closed: bool, slack: bool) -> dict[str, float]:
    arguments = [str(side), str(count), str(int(closed)), str(int(slack))]
    done = subprocess.run(
        [sys.executable, __file__, *arguments], stdout=subprocess.PIPE, check=True, timeout=600
    )
    found: dict[str, float] = json.loads(done.stdout)
    return found


def _measure(side: int, count: int, *, closed: bool, slack: bool) -> dict[str, float]:
    """Contacts, verdict and check of parts that fill a box; then the textbook program."""
    import puzzles

    from scadgen.interlock.assembly import make_assembly
    from scadgen.interlock.certificate import BALANCED, check_certificate
    from scadgen.interlock.contacts import find_contacts
    from scadgen.interlock.verdict import Certificate, verdict

    inside = puzzles.cells(*[(0, side)] * 3)
    wall = puzzles.cells((-1, side + 1), (-1, side + 1), (-1, side + closed)) - inside
    meshes = [puzzles.voxels(cells) for cells in (*puzzles.grown(side, count, 1), wall)]
    started = time.process_time()
    contacts = find_contacts(meshes, 0.01)
    looked = time.process_time()
    assembly = make_assembly(meshes, contacts, (count,))
    found = verdict(assembly)
    judged = time.process_time()
    figures = {
        "rows": float(assembly.rows.shape[0]),
        "unknowns": float(assembly.rows.shape[1]),
        "locked": float(isinstance(found, Certificate)),
        "contacts": looked - started,
        "verdict": judged - looked,
    }
    if isinstance(found, Certificate):
        assert check_certificate(contacts, (count,), count + 1, found) < BALANCED
    figures["check"] = time.process_time() - judged
    figures["peak"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return {**figures, **(_slack(assembly.rows) if slack else {})}


def _slack(rows) -> dict[str, float]:  # noqa: ANN001
    """The textbook program: maximise the sum of t with A x >= t, 0 <= t <= 1, on all rows."""
    import numpy as np
    from scipy.optimize import linprog
    from scipy.sparse import eye_array, hstack

    count, unknowns = rows.shape
    started = time.process_time()
    found = linprog(
        np.concatenate([np.zeros(unknowns), -np.ones(count)]),
        A_ub=hstack([-rows, eye_array(count)]).tocsr(),
        b_ub=np.zeros(count),
        bounds=[(-1, 1)] * unknowns + [(0, 1)] * count,
        method="highs",
        options={"time_limit": _PATIENCE},
    )
    return {"slack": time.process_time() - started, "gave_up": float(found.status != 0)}


if __name__ == "__main__":
    if len(sys.argv) > 1:
        side, count, closed, slack = map(int, sys.argv[1:])
        json.dump(_measure(side, count, closed=bool(closed), slack=bool(slack)), sys.stdout)
    else:
        run()
