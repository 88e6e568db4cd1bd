"""Numbers, lengths and transforms as SVG's attributes write them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from scadgen.errors import InputError
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["PIXEL", "length", "lengths", "numbers", "transform"]

#: A pixel, the 96th part of an inch, in mm.
PIXEL = 25.4 / 96

#: Millimetres in each unit of length.
_UNITS = {"": PIXEL, "px": PIXEL, "mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72}
_UNITS["pc"] = 12 * _UNITS["pt"]

#: Patterns that any text is searched with in linear time.
_NUMBER = re.compile(r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?")
_LENGTH = re.compile(rf"({_NUMBER.pattern})\s?([a-z]*)")
_TRANSFORM = re.compile(r"\s*(\w+)\s*\(([^()]*)\)[\s,]*")

#: Numbers go up to this: the squares of their products are numbers too.
_LARGEST = 1e12

#: How many numbers each transform takes.
_ARGUMENTS = {
    "matrix": (6,),
    "translate": (1, 2),
    "scale": (1, 2),
    "rotate": (1, 3),
    "skewX": (1,),
    "skewY": (1,),
}


def transform(text: str) -> Floats:
    """An SVG transform list as a matrix, ``(3, 3) float``.

    Raises
    ------
    InputError
        It is none.
    """
    import svgelements

    matrix, at = np.eye(3), 0
    while at < len(text):
        found = _TRANSFORM.match(text, at)
        values = numbers("transform", found[2]) if found else []
        if not found or len(values) not in _ARGUMENTS.get(found[1], ()):
            msg = f"transform {text[:60]!r}: must be {', '.join(_ARGUMENTS)} with their numbers"
            raise InputError(msg)
        m = svgelements.Matrix(f"{found[1]}({','.join(map(repr, values))})")
        matrix = matrix @ np.array([[m.a, m.c, m.e], [m.b, m.d, m.f], [0.0, 0.0, 1.0]])
        at = found.end()
    return matrix


def numbers(what: str, text: str) -> list[float]:
    """Numbers with spaces or commas between them.

    Raises
    ------
    InputError
        There is something else, or a number beyond all numbers.
    """
    if _NUMBER.sub(" ", text).strip(" ,\t\r\n"):
        msg = f"{what} {text[:60]!r}: must be numbers"
        raise InputError(msg)
    values = [float(number) for number in _NUMBER.findall(text)]
    if not max(map(abs, values), default=0) <= _LARGEST:
        msg = f"{what} {text[:60]!r}: has a number that is too large"
        raise InputError(msg)
    return values


def lengths(element: Element, *names: str) -> list[float]:
    """Attributes of an element that are lengths, in user units; 0 where they are missing.

    Raises
    ------
    InputError
        As `length`.
    """
    return [length(name, element.get(name) or "0") for name in names]


def length(name: str, text: str, *, absolute: bool = False) -> float:
    """A length in user units, or in mm.

    Raises
    ------
    InputError
        It is none, or relative to something else.
    """
    found = _LENGTH.fullmatch(text.strip())
    if not found or found[2] not in _UNITS or not abs(float(found[1])) <= _LARGEST:
        units = ", ".join(filter(None, _UNITS))
        msg = f"{name} = {text[:60]!r}: must be a number, with or without {units}"
        raise InputError(msg)
    size = float(found[1]) * _UNITS[found[2]]
    return size if absolute else size / PIXEL
