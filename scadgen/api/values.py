"""Options as Python gives them, refused in the words of the command line."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from scadgen.api.drawing import shown
from scadgen.api.options import FAMILY, READING
from scadgen.api.words import length, meant
from scadgen.errors import InputError
from scadgen.kit.live import PARAMETERS

__all__ = ["as_given", "as_length", "known_options"]

#: Options that are words, and how often something is there.
_WORDS, _COUNTS = ("key", "rim", "detail", "weave", "material", "name"), ("rows", "columns", "jobs")


def known_options() -> tuple[str, ...]:
    """Names of all options of frames and of kits that are no arguments of their own."""
    return tuple(dict.fromkeys([*PARAMETERS, *FAMILY, *READING, "snap"]))


def as_given(options: Mapping[str, Any]) -> dict[str, Any]:
    """The options that are given, each as its kind of value.

    Parameters
    ----------
    options
        By name; None where they are not given.

    Raises
    ------
    InputError
        There is no such option, or its value is of another kind.
    """
    return {name: _value(name, value) for name, value in options.items() if value is not None}


def as_length(name: str, value: object) -> float:
    """A length in mm: a number, or a text with a unit.

    Raises
    ------
    InputError
        It is none.
    """
    if isinstance(value, str):
        try:
            return length(value)
        except InputError as error:
            msg = f"{name}: {error}"
            raise InputError(msg) from None
    return _number(name, value, "a number of mm, or a text with a unit, as '8mm' or '1in'")


def _value(name: str, value: object) -> Any:  # noqa: ANN401  of any kind of option
    kind = _kind(name)
    if kind == "length":
        return as_length(name, value)
    if kind == "number":
        return _number(name, value, "a number")
    if kind == "whole":
        return _whole(name, value)
    if kind == "flag":
        if not isinstance(value, bool | np.bool_):
            raise _refusal(name, value, "True or False")
        return bool(value)
    if name == "outline" and not isinstance(value, str):
        return _corners(name, value)
    if not isinstance(value, str):
        raise _refusal(name, value, "a text")
    return value


def _kind(name: str) -> str:
    """What an option's values are."""
    if name in PARAMETERS or name == "snap":
        return "length"
    if name in _WORDS:
        return "text"
    if name in _COUNTS:
        return "whole"
    known = FAMILY.get(name) or READING.get(name)
    if known is None:
        near = meant(name, [*known_options(), *_WORDS, *_COUNTS])
        msg = f"{name}: no option of frames or kits{near}"
        raise InputError(msg)
    return known.kind


def _number(name: str, value: Any, must_be: str) -> float:  # noqa: ANN401  whatever is given
    if not isinstance(value, bool | np.bool_ | str):
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            pass
    raise _refusal(name, value, must_be)


def _whole(name: str, value: Any) -> int:  # noqa: ANN401  likewise
    if not isinstance(value, bool | np.bool_):
        try:
            return operator.index(value)
        except TypeError:
            pass
    raise _refusal(name, value, "a whole number")


def _corners(name: str, value: object) -> str:
    """Corners of an outline, as they are typed on the command line."""
    try:
        corners: Iterable[Iterable[float]] = np.asarray(value, dtype=float).tolist()
        return " ".join(",".join(map(repr, corner)) for corner in corners)
    except (TypeError, ValueError):
        raise _refusal(name, value, "3 or more corners, an x and a y each, in mm") from None


def _refusal(name: str, value: object, must_be: str) -> InputError:
    return InputError(f"{name} = {shown(value)}: must be {must_be}")
