"""How far a command is, as programs read it."""

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


@pytest.mark.parametrize("wanted", ["", "yes"])
def test_nothing_is_said_where_nobody_asks(wanted, capsys, monkeypatch):
    monkeypatch.setenv("SCADGEN_PROGRESS", wanted)
    with progress("making a kit") as bar:
        bar.reach(0.5, "proving")
    assert capsys.readouterr() == ("", "")
