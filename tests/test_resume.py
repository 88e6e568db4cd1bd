"""Kits whose joints and proofs are kept: the same bytes, and no work lost by an interrupt."""

import json
import os
import signal
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from kits import grid, kit

from scadgen.check import proof
from scadgen.errors import InvariantError
from scadgen.kit import compute
from scadgen.kit.build import build
from scadgen.kit.store import dumps
from scadgen.work.cache import Cache
from scadgen.work.mapping import Execution

#: Three edges at unequal angles, and a chain that hangs on one of them and bends more at each
#: vertex: eight kinds of joints, so that the first is there long before the last.
BENDS = np.cumsum([*range(6, 70, 6)]) * (-1) ** np.arange(11)
CHAIN = np.cumsum(100 * np.exp(1j * np.radians(np.append(30, 30 + BENDS % 50))))
FORK = {
    "vertices": [
        *([0, 0], [100, 0], [-30, 110], [-60, -90]),
        *([100 + z.real, z.imag] for z in CHAIN.tolist()),
    ],
    "edges": [[0, 1], [0, 2], [0, 3], [1, 4], *([n, n + 1] for n in range(4, 3 + len(CHAIN)))],
}


def started(folder, *words):
    return subprocess.Popen(
        [
            *(sys.executable, "-c", "from scadgen.cli.main import main; main()", "kit"),
            *("fork.json", "--detail", "draft", "--unchecked", *words),
        ],
        cwd=folder,
        env=os.environ | {"SCADGEN_CACHE": str(folder / "cache"), "SCADGEN_PROGRESS": "lines"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # so that an interrupt reaches its processes, as from a keyboard
    )


def kept(folder):
    return sorted((folder / "cache").rglob("*.npz"))


def test_what_was_done_before_an_interrupt_is_kept_and_gone_on_with(tmp_path):
    (tmp_path / "fork.json").write_text(json.dumps(FORK))
    first = started(tmp_path, "--jobs", "2", "-o", "kit")
    said = []
    for line in iter(first.stderr.readline, ""):
        said.append(line)
        if "computing the joints, 1 of" in line:
            os.killpg(first.pid, signal.SIGINT)
    assert said[-1] == "scadgen: interrupted\n"
    assert not any("Traceback" in line for line in said), "".join(said)
    assert first.wait(60) == 130
    assert not (tmp_path / "kit").exists()
    first.stdout.close()
    first.stderr.close()
    before = {path: path.read_bytes() for path in kept(tmp_path)}
    assert before
    for words in (("--jobs", "1", "-o", "kit"), ("-o", "again"), ("--no-cache", "-o", "anew")):
        run = started(tmp_path, *words)
        _, error = run.communicate(timeout=200)
        assert run.returncode == 0, error
    assert {path: path.read_bytes() for path in before} == before
    texts = {(tmp_path / name / "kit.json").read_bytes() for name in ("kit", "again", "anew")}
    assert len(texts) == 1


def test_joints_that_are_kept_are_not_computed_again(tmp_path, monkeypatch):
    request, means = grid("hexagonal", detail="draft"), Execution(cache=Cache(tmp_path))
    first = dumps(build(request, means))
    assert first == dumps(kit("hexagonal"))
    monkeypatch.setattr(compute, "best_pieces", _refuse)
    assert dumps(build(request, means)) == first
    with pytest.raises(InvariantError):
        build(grid("hexagonal", "loose", detail="draft"), means)


def test_a_proof_that_is_kept_is_not_made_again(tmp_path, monkeypatch):
    means = Execution(cache=Cache(tmp_path))
    first = proof.proved(kit("hexagonal"), means)
    assert first.proved
    monkeypatch.setattr(proof, "proofs", _refuse)
    renamed = _renamed(kit("hexagonal"))
    assert [one.verdicts for one in proof.proved(renamed, means).joints] == [
        one.verdicts for one in first.joints
    ]
    assert dumps(proof.proved(kit("hexagonal"), means)) == dumps(first)
    with pytest.raises(InvariantError):
        proof.proved(kit("hexagonal", "loose"), means)


def _renamed(made):
    """The same kit with other names of its parts and its joint."""
    (joint,) = made.joints
    joint = replace(
        joint,
        name="Z",
        connectors=tuple(f"{name}_Z" for name in joint.connectors),
        pieces=tuple(replace(place, part=f"{place.part}_Z") for place in joint.pieces),
    )
    parts = {f"{name}_Z": replace(part, name=f"{name}_Z") for name, part in made.parts.items()}
    return replace(made, joints=(joint,), parts=parts)


def _refuse(*_, **__):
    msg = "this was kept"
    raise InvariantError(msg)


@pytest.mark.parametrize("jobs", ["0", "-1"])
def test_a_number_of_processes_below_one_is_refused(tmp_path, jobs):
    (tmp_path / "fork.json").write_text(json.dumps(FORK))
    run = started(tmp_path, "--jobs", jobs)
    _, error = run.communicate(timeout=60)
    assert (run.returncode, error) == (2, f"scadgen: jobs = {jobs}: must be at least 1\n")
