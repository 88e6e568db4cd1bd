"""Work done for many items: by whom, in which order, and what is kept of it."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from scadgen.errors import GeometryError, InputError
from scadgen.work.cache import Cache, Entry, default_folder
from scadgen.work.executor import Executor
from scadgen.work.fingerprint import key_of
from scadgen.work.mapping import Execution, Task, map_cached


def square(item):
    """What is computed here; slow for the first, refused above 100."""
    if item > 100:
        msg = f"{item} is too much"
        raise GeometryError(msg)
    time.sleep(0.3 if item == 0 else 0.0)
    return item * item, os.getpid()


TASK = Task(
    square,
    lambda item: key_of("square", of=item),
    lambda result: Entry({"pid": result[1]}, {"square": np.array(result[0])}),
    lambda entry, _: (int(entry.arrays["square"]), entry.values["pid"]),
)


def run(items, jobs=1, cache=None):
    return dict(map_cached(TASK, items, Execution(Executor(jobs), cache)))


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_are_those_of_the_function_by_the_number_of_the_item(jobs):
    found = run([0, 1, 2, 3], jobs)
    assert {n: value for n, (value, _) in found.items()} == {0: 0, 1: 1, 2: 4, 3: 9}


def test_many_items_are_done_by_other_processes_and_a_lone_one_by_this():
    assert os.getpid() not in {pid for _, pid in run([0, 1, 2, 3], 2).values()}
    assert run([5], 2) == {0: (25, os.getpid())}
    assert run([]) == {}


@pytest.mark.parametrize("jobs", [1, 2])
def test_of_several_refusals_the_first_in_order_is_told(jobs, tmp_path):
    with pytest.raises(GeometryError, match="200 is too much"):
        run([0, 200, 300, 1, 400], jobs, Cache(tmp_path))
    # What was done is kept.
    assert Cache(tmp_path).find(key_of("square", of=0))


def test_fewer_than_one_process_are_refused():
    with pytest.raises(InputError, match="jobs = 0: must be at least 1"):
        Executor(0)


def test_what_is_kept_is_not_computed_again(tmp_path):
    first = run([1, 2, 3], cache=Cache(tmp_path))
    kept = Task(_refuse, TASK.key, TASK.packed, TASK.unpacked)
    assert dict(map_cached(kept, [3, 2, 1], Execution(cache=Cache(tmp_path)))) == {
        0: first[2],
        1: first[1],
        2: first[0],
    }


def _refuse(_):
    raise AssertionError


def test_who_stops_half_way_goes_on_where_it_was(tmp_path):
    work = map_cached(TASK, [1, 2, 3, 4], Execution(cache=Cache(tmp_path)))
    assert [next(work)[0], next(work)[0]] == [0, 1]
    work.close()
    assert len(list(tmp_path.rglob("*.npz"))) == 2
    assert [value for value, _ in run([1, 2, 3, 4], cache=Cache(tmp_path)).values()] == [
        1,
        4,
        9,
        16,
    ]


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: data[: len(data) // 2],
        lambda _: b"",
        lambda _: b"no archive at all",
        lambda data: data.replace(b"PK", b"KP"),
    ],
)
def test_what_is_damaged_is_computed_and_written_again(tmp_path, damage):
    cache = Cache(tmp_path)
    run([7], cache=cache)
    (path,) = tmp_path.rglob("*.npz")
    path.write_bytes(damage(path.read_bytes()))
    assert cache.find(key_of("square", of=7)) is None
    assert run([7], cache=cache)[0][0] == 49
    assert cache.find(key_of("square", of=7))


@pytest.mark.parametrize("flipped", [0x01, 0xFF])
def test_a_byte_that_is_damaged_costs_the_result_at_most(tmp_path, flipped):
    cache = Cache(tmp_path)
    run([7], cache=cache)
    (path,) = tmp_path.rglob("*.npz")
    data = path.read_bytes()
    lost = 0
    for at in range(0, len(data), 3):
        path.write_bytes(data[:at] + bytes([data[at] ^ flipped]) + data[at + 1 :])
        found = cache.find(key_of("square", of=7))
        lost += found is None
        # Some bytes say nothing of what is kept, such as when it was.
        assert found is None or int(found.arrays["square"]) == 49
    assert lost > len(data) / 6


def test_what_another_key_was_kept_under_is_not_taken(tmp_path):
    cache = Cache(tmp_path)
    run([7], cache=cache)
    (path,) = tmp_path.rglob("*.npz")
    other = key_of("square", of=8)
    (tmp_path / other[:2]).mkdir(exist_ok=True)
    path.rename(tmp_path / other[:2] / f"{other[2:]}.npz")
    assert cache.find(other) is None


def test_what_is_written_by_others_is_not_run(tmp_path):
    key = key_of("square", of=7)
    path = tmp_path / key[:2] / f"{key[2:]}.npz"
    path.parent.mkdir()
    with path.open("wb") as file:
        np.savez(file, square=np.array([{}], dtype=object))
    assert Cache(tmp_path).find(key) is None


def test_a_folder_that_cannot_be_written_costs_no_result(tmp_path):
    (tmp_path / "file").write_text("")
    assert run([3], cache=Cache(tmp_path / "file" / "cache"))[0][0] == 9


def test_an_interrupt_waits_until_a_result_is_kept(tmp_path, monkeypatch):
    writing = np.savez_compressed

    def interrupted(*content, **arrays):
        signal.raise_signal(signal.SIGINT)
        writing(*content, **arrays)

    monkeypatch.setattr(np, "savez_compressed", interrupted)
    cache = Cache(tmp_path)
    with pytest.raises(KeyboardInterrupt):
        cache.keep("key", Entry({"n": 1}))
    assert cache.find("key").values == {"n": 1}
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_what_was_not_used_for_longest_goes_first(tmp_path):
    cache, noise = Cache(tmp_path), np.random.default_rng(1)
    for n in range(6):
        cache.keep(key_of("noise", n=n), Entry({}, {"noise": noise.random(2500)}))
        for path in tmp_path.rglob("*.npz"):
            os.utime(path, (path.stat().st_mtime - 10,) * 2)
    assert cache.find(key_of("noise", n=1))
    Cache(tmp_path, 100_000).trim()
    # Each is about 19 kB, and what is left at most 90 of 100.
    assert [n for n in range(6) if cache.find(key_of("noise", n=n))] == [1, 3, 4, 5]
    assert sum(p.stat().st_size for p in tmp_path.rglob("*.npz")) <= 100_000


def test_files_of_others_in_the_folder_are_not_touched(tmp_path):
    key = key_of("noise", n=0)
    others = ("go/thesis.doc", "ab/thesis.doc", f"ab/{key}.npz", f"go/{key[2:]}.npz", "ab/x.part")
    for name in others:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(b"x" * 9000)
    left = tmp_path / key[:2] / f"{key[2:]}.{'x' * 8}.part"
    left.parent.mkdir(exist_ok=True)
    left.write_bytes(b"x" * 9000)
    Cache(tmp_path, limit=4000).keep(key, Entry({}, {"noise": np.zeros(9)}))
    assert all((tmp_path / name).stat().st_size == 9000 for name in others)
    assert not left.exists()


def test_a_file_that_was_not_written_whole_is_known_by_its_name(tmp_path, monkeypatch):
    def killed(*_):
        raise KeyboardInterrupt

    cache = Cache(tmp_path, limit=100)
    with monkeypatch.context() as patched:
        patched.setattr(Path, "replace", killed)
        patched.setattr(Path, "unlink", lambda *_: None)
        with pytest.raises(KeyboardInterrupt):
            cache.keep(key_of("noise", n=0), Entry({}, {"noise": np.zeros(9)}))
    assert len(list(tmp_path.rglob("*.part"))) == 1
    cache.trim()
    assert not list(tmp_path.rglob("*.part"))


def _keep(folder, start):
    for n in range(60):
        run([(start + n) % 40], cache=Cache(folder))


def test_two_processes_share_a_folder(tmp_path):
    context = multiprocessing.get_context("spawn")
    both = [context.Process(target=_keep, args=(tmp_path, start)) for start in (0, 20)]
    for process in both:
        process.start()
    for process in both:
        process.join(60)
        assert process.exitcode == 0
    assert len(list(tmp_path.rglob("*"))) == len(list(tmp_path.glob("??"))) + 40
    assert all(Cache(tmp_path).find(key_of("square", of=n)) for n in range(40))


def test_keys_tell_all_values_and_arrays_apart():
    numbers = np.arange(6.0)
    given = [
        {"of": 1.0},
        {"of": 1.0 + 2**-52},
        {"of": numbers},
        {"of": numbers.reshape(2, 3)},
        {"of": numbers.astype(np.float32)},
        {"to": numbers},
    ]
    assert len({key_of("it", **one) for one in given}) == len(given)
    assert key_of("it", of=numbers) == key_of("it", of=numbers[::-1][::-1])
    assert key_of("it", of=1) != key_of("that", of=1)
    with pytest.raises(TypeError):
        key_of("it", of=object())


def test_the_folder_is_the_one_named_or_the_users(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("SCADGEN_CACHE", raising=False)
    assert default_folder() == tmp_path / "scadgen"
    monkeypatch.setenv("SCADGEN_CACHE", str(tmp_path / "own"))
    assert default_folder() == tmp_path / "own"


SPAWNS = """
import signal
from scadgen.work.executor import Executor

def blocked(_):
    return signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ())

print([result for _, result in Executor(2).outcomes(blocked, [1, 2, 3])], blocked(0))
"""


def test_no_interrupt_reaches_processes_that_a_fresh_one_starts():
    command = [sys.executable, "-c", SPAWNS]
    run = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (run.stdout, run.stderr) == ("[True, True, True] False\n", "")
