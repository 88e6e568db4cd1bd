"""Whether every frame with a name makes a kit that passes all checks.

usage: benchmarks/named_frames.py [NAME ...]
Kits are of default size, at detail `draft`, nothing kept from before.  One line a frame.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from scadgen.plane.catalogue import NAMES

SCADGEN = [str(Path(sys.executable).with_name("scadgen"))]


def run(*words: str) -> tuple[int, str, float]:
    """Exit status of a command, the last line that it says, and how long it took."""
    start = time.monotonic()
    done = subprocess.run([*SCADGEN, *words], capture_output=True, text=True, check=False)
    lines = (done.stdout if done.returncode == 0 else done.stdout + done.stderr).splitlines()
    return done.returncode, lines[-1] if lines else "", time.monotonic() - start


def main(names: Sequence[str]) -> None:
    """Make and check the kits."""
    good = 0
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            kit = str(Path(folder, name))
            status, said, making = run("kit", name, "--detail", "draft", "--no-cache", "-o", kit)
            if status == 0:
                status, said, checking = run("check", kit)
                said = f"{said.rpartition(': ')[2]}, {checking:.0f} s"
            good += status == 0
            print(f"{name:12s} {making:4.0f} s: {said}", flush=True)
    print(f"{good} of {len(names)} kits pass all checks")


if __name__ == "__main__":
    main(sys.argv[1:] or list(NAMES))
