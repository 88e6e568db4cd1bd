"""The search for weaves: seeded, taken up again from its record, its winners proved."""

import json
import multiprocessing
from dataclasses import asdict

import pytest

from scadgen.cli.main import main
from scadgen.errors import InputError
from scadgen.joint.weave import BUILT_IN, SHAPE, Weave
from scadgen.tune.judge import Figures, Wish, figures
from scadgen.tune.record import Record
from scadgen.tune.run import rounds, start
from scadgen.tune.search import WeaveSearch

PAIR = Wish(2, "fixed", 0.2)


@pytest.fixture
def run(capsys):
    def run(*words):
        with pytest.raises(SystemExit) as done:
            main(["tune", *map(str, words)])
        out, err = capsys.readouterr()
        return done.value.code, out, err

    return run


def test_the_built_in_weave_is_found_again_and_written(run, tmp_path):
    record, output = tmp_path / "record.jsonl", tmp_path / "weave.json"
    words = ("--valence", 3, "--rounds", 1, "--record", record, "-o", output, "--json")
    search = WeaveSearch(Wish(3, "fixed", 0.2), 1, Record(record, Wish(3, "fixed", 0.2), 1))
    for _ in rounds(search, start(3), 1):
        if search.front:
            break
    (shape, found), *_ = search.front
    assert shape == BUILT_IN["3-fixed"].shape
    assert found.arm >= 0.2
    # Taken up again, what is on record needs no time.
    code, out, _ = run(*words)
    assert code == 0
    best = json.loads(out)[0]
    assert best["play"] <= found.play
    assert Weave.from_dict(json.loads(output.read_text()), "again").shape == tuple(
        best[name] for name in SHAPE
    )


def test_the_same_seed_looks_at_the_same_weaves_on_any_number_of_cores():
    def looked(jobs, seed=1):
        search = WeaveSearch(PAIR, seed, Record(None, PAIR, seed))
        next(iter(rounds(search, [], 1, jobs)))
        return search.looked

    one = looked(1)
    assert len(one) == 32
    assert looked(2) == one
    assert not looked(2, seed=2).keys() & one.keys()
    assert not multiprocessing.active_children()


def test_figures_tell_what_is_wrong():
    def refused(arm, shape):
        return figures(Wish(3, "fixed", arm), Weave(*shape)).refused

    assert refused(0.2, (1.54, 0.67, 0.23, 0.26, 0.81)) == "loose"
    assert "arms of 0.1" in refused(0.3, (1.555, 0.817, 0.43, 0.691, 1.516))
    assert "a tube's face" in refused(0.1, (1.694, 0.961, 0.25, 0.695, 1.53))
    assert not refused(0.2, BUILT_IN["3-fixed"].shape)


def test_what_beats_what():
    assert Figures(10, 0.3).beats(Figures(10, 0.2))
    assert not Figures(10, 0.3).beats(Figures(9, 0.2))
    assert not Figures(10, 0.3).beats(Figures(10, 0.3))


def written(tmp_path):
    path = tmp_path / "record.jsonl"
    record = Record(path, PAIR, 1)
    record.add("look", (1.5, 0.9, 0.3, 0.6, 1.2), Figures(12.5, 0.25))
    record.add("proof", (1.5, 0.9, 0.3, 0.6, 1.2), Figures(refused="half A is stuck"))
    return path


def test_a_record_is_read_back_but_for_a_line_cut_short(tmp_path):
    path = written(tmp_path)
    path.write_text(path.read_text() + '["look", [1.5, 0.')
    for _ in range(2):
        again = Record(path, PAIR, 1)
        assert len(again) == 2
        assert again.get("look", (1.5, 0.9, 0.3, 0.6, 1.2)) == Figures(12.5, 0.25)
        assert again.get("proof", (1.5, 0.9, 0.3, 0.6, 1.2)).refused == "half A is stuck"
        assert again.get("look", (1.6, 0.9, 0.3, 0.6, 1.2)) is None


def test_the_record_of_another_search_is_refused_and_kept(tmp_path):
    path = written(tmp_path)
    before = path.read_bytes()
    for wish, seed in ((Wish(2, "loose", 0.2), 1), (PAIR, 2)):
        with pytest.raises(InputError, match="not the record of this search"):
            Record(path, wish, seed)
    path.write_text(path.read_text() + "nonsense\n")
    with pytest.raises(InputError, match="not a line of a search: 'nonsense'"):
        Record(path, PAIR, 1)
    assert path.read_bytes().startswith(before)


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("--valence", 1), "valence = 1: must be a whole number from 2 to 12"),
        (("--valence", "few"), "few"),
        (("--key", "glue"), "key = 'glue': must be one of fixed, loose"),
        (("--arm", 1.5), "arm = 1.5 sides: must be from 0 to 1"),
        (("--arm", "nan"), "arm = nan sides: must be from 0 to 1"),
        (("--rounds", 0), "rounds = 0: must be at least 1"),
        (("--jobs", 0), "jobs = 0: must be at least 1"),
        (("--record", "."), "name another file"),
        (("--output", "."), "it is not a file; name one that is"),
        (("--output", "nowhere/x.json"), "No such file or directory; name one in a"),
        (("--seed", -1), "seed = -1: must be at least 0"),
    ],
)
def test_bad_requests_are_refused_in_a_line(words, reason, run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert reason in err
    assert err.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_wishes_are_on_record(tmp_path):
    head = json.loads(written(tmp_path).read_text().splitlines()[0])
    assert asdict(PAIR).items() <= head.items()
