"""Path data as pieces of paths.

svgelements reads them too, but takes the wrong point where smooth curves follow others.
"""

from __future__ import annotations

import re
from typing import Any

from scadgen.errors import InputError
from scadgen.readers.svg_text import LARGEST

__all__ = ["path_of"]

#: How many numbers each command takes.
_COUNTS = {"m": 2, "l": 2, "h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "t": 2, "a": 7, "z": 0}

_NUMBER = re.compile(r"[\s,]*([-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?)")
_FLAG = re.compile(r"[\s,]*([01])")
_LETTER = re.compile(r"[\s,]*([MmZzLlHhVvCcSsQqTtAa])")

#: Those of the numbers of an arc that are one digit, with nothing in between.
_FLAGS = (3, 4)


def path_of(data: str) -> list[Any]:
    """The pieces of a path, as svgelements has them.

    Raises
    ------
    InputError
        The data are none, or have a number that is too large.
    """
    pen, at, command = _Pen(), 0, ""
    end = len(data.rstrip(", \t\r\n"))
    while at < end:
        letter = _LETTER.match(data, at)
        if letter is not None:
            command, at = letter[1], letter.end()
        elif command in {"", "z", "Z"}:
            raise _refusal(data)
        values, at = _values(data, at, command.lower())
        if not pen.draw(command, values):
            raise _refusal(data)
        # More places after the first are lines.
        command = {"m": "l", "M": "L"}.get(command, command)
    return pen.pieces


def _values(data: str, at: int, command: str) -> tuple[list[float], int]:
    """The numbers of a command, and where they end."""
    values: list[float] = []
    for number in range(_COUNTS[command]):
        pattern = _FLAG if command == "a" and number in _FLAGS else _NUMBER
        found = pattern.match(data, at)
        if found is None:
            raise _refusal(data)
        values.append(float(found[1]))
        at = found.end()
    if not max(map(abs, values), default=0.0) <= LARGEST:
        msg = f"path {data[:60]!r}: has a number that is too large"
        raise InputError(msg)
    return values, at


class _Pen:
    """Draws commands one after the other."""

    def __init__(self) -> None:
        # No path of svgelements: that goes through all of itself whenever a part is closed.
        self.pieces: list[Any] = []
        self._at = self._start = 0j
        #: The last control point, and the degree of the curve that it is of.
        self._control, self._degree = 0j, 0

    def draw(self, command: str, values: list[float]) -> bool:
        """Draw a command; whether that can be done here."""
        kind, base = command.lower(), self._at if command.islower() else 0j
        if kind != "m" and not self.pieces:
            return False
        if kind == "z":
            places = [self._start]
        elif kind == "h":
            places = [complex(base.real + values[0], self._at.imag)]
        elif kind == "v":
            places = [complex(self._at.real, base.imag + values[0])]
        else:
            # Of an arc only its end is a place.
            pairs = values[5:] if kind == "a" else values
            places = [base + complex(x, y) for x, y in zip(pairs[::2], pairs[1::2], strict=True)]
        degree = {"c": 3, "s": 3, "q": 2, "t": 2}.get(kind, 0)
        if kind in "st":
            # It goes on as smoothly as a curve of its own degree left off.
            smooth = 2 * self._at - self._control if degree == self._degree else self._at
            places.insert(0, smooth)
        self.pieces.append(self._piece(kind, degree, values, places))
        if degree:
            self._control = places[-2]
        self._degree, self._at = degree, places[-1]
        self._start = self._at if kind == "m" else self._start
        return True

    def _piece(self, kind: str, degree: int, values: list[float], places: list[complex]) -> Any:  # noqa: ANN401 -- svgelements has no types
        import svgelements

        start, *rest = map(_pair, [self._at, *places])
        if degree:
            curve = svgelements.CubicBezier if degree == 3 else svgelements.QuadraticBezier
            return curve(start, *rest)
        if kind == "m":
            return svgelements.Move(*rest)
        if kind == "a":
            radii, turn = map(abs, values[:2]), values[2]
            return svgelements.Arc(start, *radii, turn, *map(bool, values[3:5]), *rest)
        return (svgelements.Close if kind == "z" else svgelements.Line)(start, *rest)


def _pair(place: complex) -> tuple[float, float]:
    return place.real, place.imag


def _refusal(data: str) -> InputError:
    return InputError(f"path {data[:60]!r}: is no path data")
