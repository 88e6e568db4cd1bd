"""A kit read from ``kit.json``, and its ranges checked, with the standard library alone."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from freecad.scadgen.affine import read_solid
from freecad.scadgen.cells import laid
from freecad.scadgen.sense import nonsense

__all__ = ["KitData", "KitError", "parse_kit", "read_kit"]

#: Format and version of ``kit.json`` that is read here.
_FORMAT, _VERSION = "scadgen-kit", 5

#: What rounding of decimal input may take a value past its bound, in mm.
_SLACK = 1e-9


class KitError(ValueError):
    """A kit cannot be read; its text is one line."""


class KitData:
    """A kit: what ``kit.json`` holds, with its solids ready to be evaluated."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        self.name: str = document["name"]
        self.key: str = document["key"]
        self.detail: str = document["detail"]
        self.rows: int = document["rows"]
        self.columns: int = document["columns"]
        self.command: str = document["command"]
        self.values: dict[str, float] = {n: float(v) for n, v in document["values"].items()}
        self.joints: list[dict[str, Any]] = document["joints"]
        self.rim: str = document["rim"]
        self.tiling: dict[str, Any] | None = document.get("tiling")
        self.frame: dict[str, Any] | None = document.get("frame")
        self.has_refused: bool = bool(document["refused"])
        self._cells: dict[str, Any] | None = document.get("cells")
        self._placements: list[dict[str, Any]] = document.get("placements", [])
        self.ranges: list[dict[str, Any]] = document["ranges"]
        self.parts = {
            name: read_solid(name, entry, self.values) for name, entry in document["parts"].items()
        }

    @property
    def is_regular(self) -> bool:
        """Whether all joints are one regular joint, whose weave can be chosen."""
        return "basic" in self.parts

    @property
    def has_cells(self) -> bool:
        """Whether its rows and columns can be set."""
        return self._cells is not None

    @property
    def frame_pieces(self) -> list[tuple[str, str]]:
        """Role and part of whatever stands in the frame, at some rows and columns at least."""
        places = self._placements if self._cells is None else self._cells["pieces"]
        return list(dict.fromkeys((p["role"], p["part"]) for p in places))

    def placements(self, rows: int, columns: int) -> list[dict[str, Any]]:
        """Where every part of the frame stands, in edge lengths.

        Parameters
        ----------
        rows, columns
            Cells up and across; a frame without cells is as it is.
        """
        if self._cells is None:
            return self._placements
        return [*laid(self._cells, rows, columns)]

    def pieces(self, joint: str) -> list[dict[str, Any]]:
        """The pieces of a kind of joint, assembled, in edge lengths.

        Raises
        ------
        KitError
            There is no such kind.
        """
        for kind in self.joints:
            if kind["name"] == joint:
                found: list[dict[str, Any]] = kind["pieces"]
                return found
        known = ", ".join(repr(kind["name"]) for kind in self.joints)
        msg = f"joint = {joint!r}: must be one of {known}"
        raise KitError(msg)

    def limits(self, name: str, values: Mapping[str, float]) -> tuple[float, float]:
        """Lowest and highest value of a live parameter at the others' values, in mm."""
        own = [r for r in self.ranges if r["parameter"] == name]
        return max(_at(r["low"], values) for r in own), min(_at(r["high"], values) for r in own)

    def check(self, values: Mapping[str, float]) -> list[str]:
        """Say in one line each which live parameters are out of their ranges.

        Parameters
        ----------
        values
            All live parameters of the kit, in mm.
        """
        wrong = [n for n in self.values if not math.isfinite(values[n])]
        if wrong:
            return [f"{n} = {values[n]:g}: must be a finite number of mm" for n in wrong]
        return [said for limit in self.ranges if (said := _breach(limit, values))]


def read_kit(path: str | Path) -> KitData:
    """Read a ``kit.json``, or the one in a folder.

    Raises
    ------
    KitError
        It is missing, broken, or of another version: says what.
    """
    path = Path(path)
    path = path / "kit.json" if path.is_dir() else path
    try:
        return parse_kit(path.read_text(encoding="utf-8"))
    except OSError as error:
        msg = f"{path}: no kit can be read there ({error.strerror}); scadgen kit makes one"
        raise KitError(msg) from error
    except UnicodeDecodeError as error:
        msg = f"{path}: not a kit: byte {error.start} is not UTF-8"
        raise KitError(msg) from error
    except KitError as error:
        msg = f"{path}: {error}"
        raise KitError(msg) from error


def parse_kit(text: str) -> KitData:
    """Read the text of a ``kit.json``.

    Raises
    ------
    KitError
        It is broken, or of another version: says what.
    """
    again = "make it again with scadgen kit"
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        msg = f"not a sound kit: truncated or not JSON ({error}); {again}"
        raise KitError(msg) from error
    if not isinstance(document, dict) or document.get("format") != _FORMAT:
        msg = f"not a kit: format is not {_FORMAT}; choose the kit.json that scadgen kit wrote"
        raise KitError(msg)
    if document.get("version") != _VERSION:
        command = document.get("command")
        known = isinstance(command, str) and command and command.isprintable()
        how = f": {command}" if known else " with scadgen kit"
        msg = (
            f"kit version {document.get('version')!r:.60}: this reads version {_VERSION}; "
            f"make it again{how}"
        )
        raise KitError(msg)
    try:
        return _sound(document)
    except KeyError as error:
        msg = f"not a sound kit: {error} is missing; {again}"
        raise KitError(msg) from error
    except (AttributeError, TypeError, ValueError, IndexError, OverflowError) as error:
        msg = f"not a sound kit: {error}; {again}"
        raise KitError(msg) from error


def _sound(document: Mapping[str, Any]) -> KitData:
    """A kit whose names and numbers make sense, and whose live parameters are in their ranges.

    Raises
    ------
    ValueError
        They are not: says which.
    """
    for said in nonsense(document):
        raise ValueError(said)
    kit = KitData(document)
    ranged = {r["parameter"] for r in kit.ranges}
    for name in kit.values:
        if name not in ranged:
            msg = f"no range for {name}"
            raise ValueError(msg)
    for said in kit.check(kit.values):
        raise ValueError(said)
    return kit


def _at(linear: Mapping[str, Any], values: Mapping[str, float]) -> float:
    """A linear expression's value, in mm."""
    terms: Mapping[str, float] = linear["terms"]
    constant: float = linear["constant"]
    return constant + sum(factor * values[name] for name, factor in terms.items())


def _breach(limit: Mapping[str, Any], values: Mapping[str, float]) -> str:
    """What is out of a range, in one line; nothing if all is well."""
    name = limit["parameter"]
    low, high, value = _at(limit["low"], values), _at(limit["high"], values), values[name]
    if low - _SLACK <= value <= high + _SLACK:
        return ""
    others = sorted({*limit["low"]["terms"], *limit["high"]["terms"]})
    given = ", ".join(f"{other} = {values[other]:g}" for other in others)
    span = f"{low:.4g} to {high:.4g}" if low <= high else "less than is possible"
    where = f" for {given}" if given else ""
    return f"{name} = {value:g} mm: must be {span} mm{where} ({limit['reason']})"
