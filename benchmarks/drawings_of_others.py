"""How many drawings of others are read: benchmarks/drawings_of_others.py FOLDER... --kind .dxf.

Prints the share that is read, the reasons of those that are refused with how many each has, and
every traceback.  With --each it prints a line a file.  Each file has a limited time.
"""

from __future__ import annotations

import argparse
import re
import signal
import sys
import traceback
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

from report import heading, line

from scadgen.errors import InputError
from scadgen.readers.read import READERS, read
from scadgen.readers.reading import Reading

__all__: list[str] = []

#: Parts of a reason that differ from file to file.
_OWN = re.compile(r"'[^']*'|\"[^\"]*\"|#?-?\d[\d.,e+-]*|\([^()]*\)")


class _TooLongError(Exception):
    pass


def _stop(_: int, __: FrameType | None) -> None:
    raise _TooLongError


@contextmanager
def _within(seconds: int) -> Iterator[None]:
    signal.signal(signal.SIGALRM, _stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)


def _outcome(path: Path, seconds: int) -> tuple[str, str]:
    """What comes of a file, in a word, and why."""
    try:
        with _within(seconds):
            found = read(path, Reading(components=True))
    except InputError as error:
        return "refused", str(error).removeprefix(f"{path}: ")
    except _TooLongError:
        return "too long", f"more than {seconds} s"
    except Exception:  # noqa: BLE001 -- what is looked for
        return "traceback", traceback.format_exc()
    return "read", f"{len(found.frame.edges)} edges; {'; '.join(found.notes)}"


def main() -> int:
    """Read all drawings below some folders; exit status 1 if one gives a traceback."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--kind", action="append", choices=[*READERS], help="endings of names")
    parser.add_argument("--seconds", type=int, default=60, help="for each file")
    parser.add_argument("--most", type=int, default=10**9, help="files at most, spread evenly")
    parser.add_argument("--each", action="store_true", help="a line a file")
    wanted = parser.parse_args()
    kinds = wanted.kind or [*READERS]
    files = sorted(
        path
        for folder in wanted.folders
        for path in folder.rglob("*")
        if path.suffix.lower() in kinds and path.is_file()
    )
    files = files[:: max(1, -(-len(files) // wanted.most))]
    outcomes: Counter[str] = Counter()
    reasons: Counter[str] = Counter()
    for path in files:
        word, why = _outcome(path, wanted.seconds)
        outcomes[word] += 1
        if word != "read":
            reasons[_OWN.sub("...", why.splitlines()[-1])] += 1
        if word == "traceback":
            sys.stderr.write(f"{path}\n{why}")
        if wanted.each:
            line(str(path), f"{word}: {why.splitlines()[-1]}")
    heading(f"{len(files)} drawings")
    for word, count in outcomes.most_common():
        line(word, f"{count}, {count / len(files):.1%}")
    for reason, count in reasons.most_common():
        line(f"{count} times", reason)
    return int(outcomes["traceback"] > 0)


if __name__ == "__main__":
    sys.exit(main())
