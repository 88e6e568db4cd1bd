"""Runs the ``scadgen`` program beside FreeCAD, which stays responsive meanwhile."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import FreeCAD as App
from PySide import QtCore

from freecad.scadgen import __version__
from freecad.scadgen.preferences import engine_path

__all__ = ["Engine", "EngineError", "Outcome", "find"]

#: Milliseconds between asking the program to stop and making it.
_GRACE = 3000

#: What ``scadgen freecad install --copy`` leaves in a copy of the workbench.
_COPIED = ".scadgen-copy.json"

#: A line in which the program says how far it is, and what it does.
_PROGRESS = re.compile(r"(\d{1,3})% (.*)")

#: Exit status for an answer, be it yes or no; any other comes with a message.
_ANSWERS = (0, 1)

translate = App.Qt.translate


class EngineError(RuntimeError):
    """The program cannot be run, or failed; the text is one line that says what to do."""


class Outcome(NamedTuple):
    """How a run ended.

    Parameters
    ----------
    good
        Whether the program gave an answer.
    output
        What it said on stdout.
    message
        What went wrong, in one line; empty after a good run and after a stop.
    """

    good: bool
    output: str
    message: str


def find() -> str:
    """Where the program is: as chosen, beside this workbench, or on the path.

    Raises
    ------
    EngineError
        It is not there.
    """
    chosen = engine_path()
    if chosen:
        found = shutil.which(chosen)
        if found:
            return found
        text = translate("Scadgen", "{}: no such program; {}")
        raise EngineError(text.format(chosen, _where()))
    for program in (*_beside(), "scadgen", Path.home() / ".local/bin/scadgen"):
        found = shutil.which(str(program))
        if found:
            return found
    text = translate(
        "Scadgen", "scadgen: not found; install it as this workbench's README says, or {}"
    )
    raise EngineError(text.format(_where()))


def _beside() -> list[str | Path]:
    """Where the program may be that the workbench was installed by."""
    here = Path(__file__).resolve()
    names = ("bin/scadgen", "Scripts/scadgen.exe", ".venv/bin/scadgen")
    found: list[str | Path] = [folder / name for folder in here.parents for name in names]
    try:
        copied = json.loads((here.parents[2] / _COPIED).read_text(encoding="utf-8"))
        return [str(copied["engine"]), *found]
    except (OSError, ValueError, KeyError, TypeError):
        return found


def _where() -> str:
    return str(translate("Scadgen", "say where it is under Edit > Preferences > Scadgen"))


class Engine(QtCore.QObject):
    """One run of the program at a time.

    `went` is emitted with a percentage and what runs now, `ended` once with an `Outcome`.
    """

    went = QtCore.Signal(int, str)
    ended = QtCore.Signal(object)

    def __init__(self, parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._process: Any = None
        self._stopping = False
        self._lines: list[str] = []
        self._rest = ""

    @property
    def running(self) -> bool:
        """Whether the program runs."""
        return self._process is not None

    def start(self, arguments: Sequence[str]) -> None:
        """Start the program, after a look at its version.

        Raises
        ------
        EngineError
            It is not there.
        """
        self._program, self._arguments = find(), [*arguments]
        self._stopping, self._known = False, False
        self._run(["--version"])

    def stop(self) -> None:
        """Ask the program to end, and make it end if it does not."""
        process = self._process
        if process is not None:
            self._stopping = True
            process.terminate()
            # It may not have heard; killing one that has ended does nothing.
            QtCore.QTimer.singleShot(_GRACE, process.kill)

    def _run(self, arguments: Sequence[str]) -> None:
        process = QtCore.QProcess(self)
        environment = QtCore.QProcessEnvironment.systemEnvironment()
        for name in ("PYTHONHOME", "PYTHONPATH"):  # FreeCAD's own Python, in an AppImage
            environment.remove(name)
        environment.insert("SCADGEN_PROGRESS", "lines")
        process.setProcessEnvironment(environment)
        self._process, self._rest = process, ""
        self._lines.clear()
        process.readyReadStandardError.connect(self._read)
        process.errorOccurred.connect(self._failed)
        process.finished.connect(self._finished)
        process.start(self._program, [*arguments])
        process.closeWriteChannel()

    def _read(self) -> None:
        text = self._rest + bytes(self._process.readAllStandardError().data()).decode(
            "utf-8", "replace"
        )
        *lines, self._rest = re.split(r"[\r\n]+", text)
        for line in lines:
            self._hear(line.strip())

    def _hear(self, line: str) -> None:
        found = _PROGRESS.fullmatch(line)
        if found and not self._stopping:
            self.went.emit(int(found[1]), found[2])
        elif line and not found:
            self._lines.append(line)

    def _failed(self, error: QtCore.QProcess.ProcessError) -> None:
        if error == QtCore.QProcess.FailedToStart:
            text = translate("Scadgen", "{}: cannot be started; {}")
            self._process.deleteLater()
            self._end(Outcome(False, "", text.format(self._program, _where())))

    def _finished(self, status: int, how: QtCore.QProcess.ExitStatus) -> None:
        self._read()
        self._hear(self._rest.strip())
        output = bytes(self._process.readAllStandardOutput().data()).decode("utf-8", "replace")
        self._process.deleteLater()
        if self._stopping:
            self._end(Outcome(False, "", ""))
        elif how == QtCore.QProcess.CrashExit:
            text = translate(
                "Scadgen", "scadgen was killed or crashed midway; nothing was made: try again"
            )
            self._end(Outcome(False, "", text))
        elif status not in _ANSWERS:
            self._end(Outcome(False, "", self._complaint(status)))
        else:
            self._answer(output)

    def _complaint(self, status: int) -> str:
        """The line in which the program says what is wrong."""
        own = [line for line in self._lines if line.startswith("scadgen: ")]
        if own or self._lines:
            return (own or self._lines)[-1]
        text = translate("Scadgen", "{} left with status {} and said nothing; {}")
        return str(text.format(self._program, status, _where()))

    def _answer(self, output: str) -> None:
        """Give the answer, or go on to what was asked for if the program is the right one."""
        if self._known:
            self._end(Outcome(True, output, ""))
            return
        said = output.strip().partition("\n")[0]
        version = re.fullmatch(r"scadgen, version ((\d+\.\d+)\S*)", said)
        needed = __version__.rpartition(".")[0]
        if version is None:
            text = translate("Scadgen", "{} is not scadgen (it said {!r}); {}")
            self._end(Outcome(False, "", text.format(self._program, said[:60], _where())))
        elif version[2] != needed:
            text = translate(
                "Scadgen", "{} is scadgen {}, this workbench needs {}: install that one, or {}"
            )
            message = text.format(self._program, version[1], needed, _where())
            self._end(Outcome(False, "", message))
        else:
            self._known = True
            self._run(self._arguments)

    def _end(self, outcome: Outcome) -> None:
        self._process = None
        self.ended.emit(outcome)
