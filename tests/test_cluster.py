"""Work done by a Dask cluster: a real scheduler and two workers on this machine."""

import json
import math
import os
import socket
import subprocess
import sys
import time

import pytest
from clusters import cluster

from scadgen.errors import InputError
from scadgen.work import cluster as module
from scadgen.work.executor import open_executor

#: Three edges at unequal angles, and a fourth that hangs on one of them: several kinds of joints.
FORK = {
    "vertices": [[0, 0], [100, 0], [-30, 110], [-60, -90], [190, 60]],
    "edges": [[0, 1], [0, 2], [0, 3], [1, 4]],
}


def scadgen(*words, folder):
    return subprocess.run(
        [sys.executable, "-c", "from scadgen.cli.main import main; main()", *map(str, words)],
        cwd=folder,
        env=os.environ,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def test_two_workers_do_what_this_machine_does(tmp_path):
    (tmp_path / "fork.json").write_text(json.dumps(FORK))
    words = ("kit", "fork.json", "--detail", "draft", "--unchecked", "--no-cache", "-o")
    here = scadgen(*words, "here", folder=tmp_path)
    assert here.returncode == 0, here.stderr
    with cluster(tmp_path, 2) as started:
        there = scadgen(*words, "there", "--dask", started.address, folder=tmp_path)
        logs = [path.read_text() for path in tmp_path.glob("worker-*.log")]
    assert (there.returncode, there.stderr) == (0, "")
    assert "note" not in there.stdout
    names = sorted(path.name for path in (tmp_path / "here").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "there").iterdir())
    for name in names:
        assert (tmp_path / "here" / name).read_bytes() == (tmp_path / "there" / name).read_bytes()
    # Each was asked whether it has this scadgen.
    assert ["fingerprint" in log for log in logs] == [True, True]


@pytest.mark.parametrize("lost", ["scheduler", "workers"])
def test_what_a_cluster_leaves_undone_is_done_here(tmp_path, monkeypatch, lost):
    monkeypatch.setattr(module, "_IDLE", 1.0)
    notes, seen = [], []
    with (
        cluster(tmp_path, 2) as started,
        open_executor(2, started.address, notes.append) as crew,
    ):
        start = time.monotonic()
        for number, outcome in crew.outcomes(time.sleep, [0.2] * 30):
            assert outcome is None
            seen.append(number)
            if len(seen) == 3:
                for process in [started.scheduler] if lost == "scheduler" else started.workers:
                    process.kill()
        assert time.monotonic() - start < 60
        # Nobody asks for the cluster again.
        assert dict(crew.outcomes(math.sqrt, [4.0, 9.0])) == {0: 2.0, 1: 3.0}
    assert sorted(seen) == list(range(30))
    (note,) = notes
    assert note.endswith("; this machine went on alone")


def test_a_scheduler_without_workers_is_refused(tmp_path):
    refused = pytest.raises(InputError, match="has no workers; dask")
    with cluster(tmp_path, 0) as started, refused, open_executor(None, started.address, print):
        pass


def test_workers_of_another_scadgen_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_mark", lambda: "another")
    refused = pytest.raises(InputError, match="has another scadgen")
    with cluster(tmp_path, 1) as started, refused, open_executor(None, started.address, print):
        pass


@pytest.mark.parametrize(
    ("address", "words"),
    [
        (None, "no Dask scheduler answers there within 3 s; dask scheduler starts one"),
        ("nowhere", "must be the address of a Dask scheduler, as tcp://HOST:PORT"),
        ("nonsense://here:80", "must be the address of a Dask scheduler, as tcp://HOST:PORT"),
    ],
)
def test_no_scheduler_is_told_in_a_line_and_nothing_is_written(tmp_path, address, words):
    address = address or f"tcp://127.0.0.1:{free_port()}"
    done = scadgen("kit", "hexagonal", "--dask", address, "-o", "kit", folder=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith(f"scadgen: --dask {address}: ")
    assert words in done.stderr
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "kit").exists()
