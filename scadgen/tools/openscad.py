"""Runs OpenSCAD and believes it only when everything it says is good.

OpenSCAD leaves with status 0 after many errors, so a render is good only if the status
is 0, no line of its log begins with ``ERROR``, ``WARNING`` or ``EXPORT-``, and the file
is there.  `scadgen.tools.stl.check_stl` then reads the mesh back.
"""

from __future__ import annotations

import math
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from scadgen.errors import InputError, ToolError

__all__ = ["PICTURE", "Render", "Setting", "define", "render"]

Setting = str | bool | float | int | Sequence[str | bool | float | int]

#: Options for a picture of everything, from the usual corner.
PICTURE = ("--viewall", "--autocenter", "--imgsize=1200,900", "--colorscheme=Tomorrow")

#: What a log line begins with when the render is bad, the most telling first.
_BAD = ("ERROR", "WARNING", "EXPORT-")

_SUFFIXES = (".stl", ".3mf", ".off", ".amf", ".png", ".csg", ".echo")

_NAME = re.compile(r"\$?[A-Za-z_][A-Za-z0-9_]*")

#: Seconds between two looks at whether to stop.
_TICK = 0.2

#: Seconds that a process has between being asked to stop and being made to.
_GRACE = 0.5


@dataclass(frozen=True, slots=True)
class Render:
    """A good render.

    Parameters
    ----------
    output
        The file that was written.
    log
        What OpenSCAD said, line by line.
    seconds
        Wall time.
    """

    output: Path
    log: tuple[str, ...]
    seconds: float

    @property
    def echoes(self) -> tuple[str, ...]:
        """What the file itself said through `echo`."""
        return tuple(line.removeprefix("ECHO: ") for line in self.log if line.startswith("ECHO: "))


def render(
    scad: Path,
    output: Path,
    settings: Mapping[str, Setting],
    *,
    timeout: float,
    options: Sequence[str] = (),
    stop: threading.Event | None = None,
) -> Render:
    """Render a ``.scad`` file; the output appears whole or not at all.

    Parameters
    ----------
    scad
        The file to render.
    output
        What to write; its suffix chooses the format (STL is binary, PNG needs Xvfb).
    settings
        Values for variables that the file sets at its top level.
    timeout
        Seconds until OpenSCAD and all that it started are stopped.
    options
        Further options, such as `PICTURE` or ``--camera=...``.
    stop
        Once it is set, OpenSCAD is stopped before its time.

    Returns
    -------
    render
        The log and the time it took.

    Raises
    ------
    InputError
        If the file, the folder or a variable does not exist, or the format is unknown.
    ToolError
        If OpenSCAD is missing, too slow, or anything it says is bad.
    """
    _check(scad, output, settings)
    program = _program()
    with tempfile.TemporaryDirectory(dir=output.parent, prefix=".scadgen-") as folder:
        drawn = Path(folder) / f"drawn{output.suffix}"
        command = [*_wrapper(output), program, "-o", str(drawn)]
        if output.suffix == ".stl":
            command += ["--export-format", "binstl"]
        for name, value in settings.items():
            command += ["-D", f"{name}={define(value)}"]
        start = time.monotonic()
        status, log = _run([*command, *options, str(scad)], timeout, folder, scad, stop)
        seconds = time.monotonic() - start
        _judge(scad, drawn, status, log)
        drawn.replace(output)
    return Render(output, log, seconds)


def define(value: Setting) -> str:
    r"""Value as OpenSCAD text, for ``-D name=...``.

    Examples
    --------
    >>> define('5" peg'), define(True), define([220, 0.5])
    ('"5\\" peg"', 'true', '[220, 0.5]')
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escapes = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
        return '"' + "".join(escapes.get(c, c) for c in value) + '"'
    if isinstance(value, Sequence):
        return "[" + ", ".join(define(v) for v in value) + "]"
    if math.isnan(value):
        return "(0/0)"
    if math.isinf(value):
        return "(1/0)" if value > 0 else "(-1/0)"
    return repr(value)


def _check(scad: Path, output: Path, settings: Mapping[str, Setting]) -> None:
    """Refuse what OpenSCAD would pass over in silence."""
    if not scad.is_file():
        msg = f"{scad}: no such file"
        raise InputError(msg)
    if output.suffix not in _SUFFIXES:
        msg = f"{output}: format must be one of {', '.join(_SUFFIXES)}"
        raise InputError(msg)
    if not output.parent.is_dir():
        msg = f"{output.parent}: no such folder"
        raise InputError(msg)
    text = scad.read_text(encoding="utf-8", errors="replace")
    for name in settings:
        known = _NAME.fullmatch(name) and re.search(rf"^{re.escape(name)}\s*=", text, re.MULTILINE)
        if not known and not name.startswith("$"):
            msg = f"setting {name!r}: {scad.name} has no such variable"
            raise InputError(msg)


def _program() -> str:
    """Where OpenSCAD is."""
    named = os.environ.get("SCADGEN_OPENSCAD")
    found = shutil.which(named or "openscad")
    if found is None:
        where = f"SCADGEN_OPENSCAD = {named}" if named else "openscad"
        msg = (
            f"{where}: not found; install OpenSCAD 2021.01 or newer (Debian: apt install openscad)"
        )
        raise ToolError(msg)
    return found


def _wrapper(output: Path) -> list[str]:
    """Give a picture the display that OpenSCAD crashes without."""
    if output.suffix != ".png" or os.environ.get("DISPLAY"):
        return []
    found = shutil.which("xvfb-run")
    if found is None:
        msg = "xvfb-run: not found; a picture needs it (Debian: apt install xvfb xauth)"
        raise ToolError(msg)
    return [found, "-a"]


def _run(
    command: list[str], timeout: float, folder: str, scad: Path, stop: threading.Event | None
) -> tuple[int, tuple[str, ...]]:
    """Run in a group of its own, so that the time limit ends all of it and nothing else."""
    with subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env={**os.environ, "TMPDIR": folder},
        start_new_session=True,
    ) as process:
        try:
            said = _output(process, timeout, scad, stop)
        finally:
            _end(process)
    return process.returncode, tuple(said.decode("utf-8", "replace").splitlines())


def _output(
    process: subprocess.Popen[bytes], timeout: float, scad: Path, stop: threading.Event | None
) -> bytes:
    """All that a program says until it ends, is told to stop, or takes too long."""
    deadline = time.monotonic() + timeout
    while True:
        left = deadline - time.monotonic()
        try:
            return process.communicate(timeout=max(0.0, min(_TICK, left)))[0]
        except subprocess.TimeoutExpired:
            if stop is not None and stop.is_set():
                msg = f"openscad: {scad.name}: stopped"
                raise ToolError(msg) from None
            if left <= 0:
                msg = f"openscad: {scad.name}: stopped after {timeout:g} s; give it more time"
                raise ToolError(msg) from None


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the whole group if its leader was not waited for: first asked, so Xvfb tidies up.

    A leader that nobody has waited for keeps its number, so no stranger is ended.
    """
    if process.returncode is None:
        os.killpg(process.pid, signal.SIGTERM)
        time.sleep(_GRACE)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _judge(scad: Path, drawn: Path, status: int, log: tuple[str, ...]) -> None:
    """Raise unless status, log and file are all good."""
    bad = [line for start in _BAD for line in log if line.startswith(start)]
    if bad:
        msg = f"openscad: {scad.name}: {bad[0]}"
        raise ToolError(msg)
    if status != 0:
        last = next((line for line in reversed(log) if line.strip()), "it said nothing")
        msg = f"openscad: {scad.name}: left with status {status}: {last}"
        raise ToolError(msg)
    if not drawn.is_file() or not drawn.stat().st_size:
        msg = f"openscad: {scad.name}: wrote nothing"
        raise ToolError(msg)
