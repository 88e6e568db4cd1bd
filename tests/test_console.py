"""How far a command is, as programs read it."""

import os
import subprocess
import sys

import pytest

from scadgen.cli.console import progress


@pytest.fixture
def lines(capsys, monkeypatch):
    """What `SCADGEN_PROGRESS=lines` gives on stderr, line by line."""
    monkeypatch.setenv("SCADGEN_PROGRESS", "lines")

    def said():
        return capsys.readouterr().err.splitlines()

    return said


def test_each_line_is_a_percentage_and_what_runs(lines):
    with progress("making a kit") as bar:
        bar.reach(0.0)
        bar.say("computing")
        bar.reach(0.123, "proving")
        bar.reach(0.5)
        bar.reach(7.0, "done")
    assert lines() == ["0% making a kit", "0% computing", "12% proving", "50% proving", "100% done"]


def test_steps_go_from_share_to_share_and_no_further(lines):
    with progress("making a kit") as bar:
        for step in (bar.steps(0.2, 0.9, 2), bar.steps(0.9, 1.0, 1)):
            for words in "abc":
                step(words)
    assert lines() == ["55% a", "90% b", "90% c", "100% a", "100% b", "100% c"]


@pytest.mark.parametrize("wanted", ["", "yes", "none"])
def test_what_is_soon_done_says_nothing(wanted, capsys, monkeypatch):
    monkeypatch.setenv("SCADGEN_PROGRESS", wanted)
    with progress("making a kit") as bar:
        bar.reach(0.5, "proving")
    assert capsys.readouterr() == ("", "")


#: Some work: two stages, of which the second says the same again and again.
WORK = """
import time
from scadgen.cli import console

console._EVERY = 0.5
with console.progress("making a kit") as bar:
    bar.reach(0.0, "computing")
    time.sleep(0.8)
    for n in range(100):
        bar.reach(0.25, "proving")
        time.sleep(0.02)
    bar.reach(1.0, "writing")
"""


@pytest.mark.parametrize(
    ("wanted", "said"),
    [("", ["making a kit: 0% computing", "making a kit: 25% proving"]), ("none", [])],
)
def test_a_pipe_gets_a_line_from_time_to_time(wanted, said):
    environment = os.environ | {"SCADGEN_PROGRESS": wanted}
    command = [sys.executable, "-c", WORK]
    done = subprocess.run(
        command, check=False, capture_output=True, text=True, env=environment, timeout=60
    )
    assert (done.returncode, done.stdout) == (0, "")
    assert done.stderr.splitlines() == said


def test_a_pipe_that_nobody_reads_stops_nothing():
    environment = os.environ | {"SCADGEN_PROGRESS": ""}
    read, write = os.pipe()
    os.close(read)
    try:
        command = [sys.executable, "-c", WORK]
        subprocess.run(command, check=True, stderr=write, env=environment, timeout=60)
    finally:
        os.close(write)
