"""The tree as it is beside an older one, in one run: time, memory, instructions.

python benchmarks/against.py [REVISION] [--instructions]

REVISION is what `git archive` takes, by default HEAD, for what is not committed yet.  Both trees
make the same joints one after the other, old and new in turn, each time in a process of its own.
Instructions are those that callgrind counts, less those of starting and importing; they do not
depend on what else the machine does, and take minutes.
"""

from __future__ import annotations

import io
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

from report import heading, line, progress

__all__ = ["compare"]

_ROOT = Path(__file__).resolve().parent.parent

#: Aims: how many times less CPU time a whole net takes, and CPU seconds a joint before and with
#: proofs.
_TIMES, _JOINT, _PROVED = 3.0, 0.15, 0.5

#: Rounds, of which the best counts; joints of a round; and those whose instructions are counted.
_ROUNDS, _JOINTS, _COUNTED = 3, 10, 3

#: Joints of the net that is made with proofs and plan, and how it is made.
_KINDS = 44
_NET = ["examples/frames/net.json", "--scale", "2", "--side", "6", "--detail", "draft"]

#: What a process does: joints of 2 to 6 edges; none warms nothing up, for callgrind to subtract.
_MAKE = """
import json, resource, sys, time
import numpy as np
from scadgen.joint.weave import any_joint
from scadgen.kit.compute import JointSpec, compute_joint
rng, joints = np.random.default_rng(3), []
while len(joints) < int(sys.argv[1]):
    turns = np.sort(rng.uniform(0, 2 * np.pi, 2 + len(joints) % 5))
    turns -= turns[0]
    least = float(np.diff(np.append(turns, 2 * np.pi)).min())
    if least > np.radians(32):
        weave, wider = any_joint(least), (0.0, 0.1, 0.2, 0.3)
        joints.append(JointSpec(tuple(turns.tolist()), weave, "loose", "draft", wider=wider))
if sys.argv[2:] == ["warm"]:
    compute_joint(joints[0])
start = time.process_time()
for joint in joints:
    compute_joint(joint)
cpu = time.process_time() - start
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
json.dump({"cpu": cpu, "peak": peak}, sys.stdout)
"""

_KIT = """
import json, resource, sys
from scadgen.cli.main import main
try:
    main(["kit", *sys.argv[1:], "--jobs", "1", "--no-cache"])
except SystemExit as end:
    assert not end.code, end.code
used = resource.getrusage(resource.RUSAGE_SELF)
print(json.dumps({"cpu": used.ru_utime + used.ru_stime, "peak": used.ru_maxrss / 1024}))
"""


def compare(revision: str, *, instructions: bool) -> None:
    """Report all figures of both trees."""
    heading(f"This tree beside {revision}: {_JOINTS} joints at draft, then a net of {_KINDS}")
    with tempfile.TemporaryDirectory() as name:
        old = Path(name) / "old"
        _export(revision, old)
        trees = {"old": old, "new": _ROOT}
        _joints(trees)
        if instructions:
            _instructions(trees)
        _net(trees)


def _export(revision: str, folder: Path) -> None:
    """Write a revision's files."""
    folder.mkdir()
    command = [_found("git"), "-C", str(_ROOT), "archive", revision]
    packed = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    with tarfile.open(fileobj=io.BytesIO(packed.stdout)) as files:
        files.extractall(folder, filter="data")


def _found(program: str) -> str:
    """Where a program is."""
    place = shutil.which(program)
    if place is None:
        sys.exit(f"{program} is not installed")
    return place


def _joints(trees: dict[str, Path]) -> None:
    """Report joints before proofs."""
    runs: dict[str, list[dict[str, float]]] = {which: [] for which in trees}
    for number in range(_ROUNDS):
        for which, tree in trees.items():
            progress(f"joints of the {which} tree, round {number + 1} of {_ROUNDS}")
            runs[which].append(json.loads(_run(tree, [_MAKE, str(_JOINTS), "warm"]).stdout))
    cpu, peak = (
        {which: min(run[key] for run in found) for which, found in runs.items()}
        for key in ("cpu", "peak")
    )
    each = {which: seconds / _JOINTS for which, seconds in cpu.items()}
    _line("a joint before proofs, CPU s", each, f"at most {_JOINT} s", met=each["new"] <= _JOINT)
    _line("peak memory, MB", peak, "no more", met=peak["new"] <= 1.02 * peak["old"])


def _net(trees: dict[str, Path]) -> None:
    """Report the net with proofs, plan and files, and a joint's share of that."""
    cpu, peak = {}, {}
    with tempfile.TemporaryDirectory() as name:
        for which, tree in trees.items():
            progress(f"the net of the {which} tree, minutes")
            told = _run(tree, [_KIT, *_NET, "-o", f"{name}/{which}"]).stdout
            found = json.loads(told.strip().splitlines()[-1])
            cpu[which], peak[which] = found["cpu"], found["peak"]
    met = cpu["old"] >= _TIMES * cpu["new"]
    _line(f"net of {_KINDS} joints, CPU s", cpu, f"{_TIMES:g} times less", met=met)
    each = {which: seconds / _KINDS for which, seconds in cpu.items()}
    aim = f"at most {_PROVED} s"
    _line("  for each joint, files too", each, aim, met=each["new"] <= _PROVED)
    _line("  peak memory, MB", peak, "no more", met=peak["new"] <= 1.02 * peak["old"])


def _instructions(trees: dict[str, Path]) -> None:
    """Report instructions of a joint, by callgrind."""
    if not shutil.which("valgrind"):
        line("instructions of a joint", "valgrind is not installed")
        return
    found = {}
    for which, tree in trees.items():
        counts = []
        for count in (1, 1 + _COUNTED):
            progress(f"callgrind: {count} joints of the {which} tree, minutes")
            counts.append(_counted(tree, count))
        found[which] = (counts[1] - counts[0]) / _COUNTED / 1e6
    _line("instructions of a joint, millions", found, "fewer", met=found["new"] < found["old"])


def _counted(tree: Path, count: int) -> int:
    """Instructions of a process that makes so many joints."""
    valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    told = _run(tree, [_MAKE, str(count)], valgrind).stderr
    return int(re.findall(r"Collected\s*:\s*(\d+)", told)[-1])


def _run(
    tree: Path, words: list[str], before: list[str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run Python on one tree, with one thread."""
    environ = os.environ | {
        "PYTHONPATH": str(tree),
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "PYTHONHASHSEED": "0",
    }
    command = [*(before or []), sys.executable, "-c", *words]
    return subprocess.run(
        command,
        cwd=tree,
        env=environ,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if before else None,
        text=True,
        check=True,
    )


def _line(what: str, found: dict[str, float], aim: str, *, met: bool) -> None:
    ratio = found["old"] / found["new"]
    line(what, f"{found['old']:.3g}, now {found['new']:.3g}: {ratio:.2f} times", aim, met=met)


if __name__ == "__main__":
    asked = [word for word in sys.argv[1:] if word != "--instructions"]
    compare((asked or ["HEAD"])[0], instructions="--instructions" in sys.argv)
