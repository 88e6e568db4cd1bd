"""Transforms as attributes and style sheets write them, as matrices."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np

from scadgen.errors import InputError
from scadgen.readers.svg_text import LARGEST, Measure, numbers
from scadgen.solid.affine import Floats

__all__ = ["css_transform", "moved", "origin", "transform"]

_TRANSFORM = re.compile(r"\s*(\w+)\s*\(([^()]*)\)[\s,]*")
_ANGLE = re.compile(r"([-+.\deE]+?)(deg|grad|rad|turn|)", re.IGNORECASE)

#: Degrees in each unit of an angle.
_DEGREES = {"": 1.0, "deg": 1.0, "grad": 0.9, "rad": 180 / math.pi, "turn": 360.0}

#: How many numbers each transform takes.
_ARGUMENTS = {
    "matrix": (6,),
    "translate": (1, 2),
    "scale": (1, 2),
    "rotate": (1, 3),
    "skewX": (1,),
    "skewY": (1,),
}
_CSS_ONLY = {"translateX": (1,), "translateY": (1,), "scaleX": (1,), "scaleY": (1,), "skew": (1, 2)}

#: Where words put the origin of a transform.
_PLACES = {"left": 0.0, "top": 0.0, "center": 0.5, "right": 1.0, "bottom": 1.0}


def transform(text: str) -> Floats:
    """An SVG transform list as a matrix, ``(3, 3) float``.

    Raises
    ------
    InputError
        It is none.
    """
    return _product(text, _ARGUMENTS, lambda _, values: numbers("transform", values))


def css_transform(text: str, measure: Measure) -> Floats:
    """The property `transform` as a matrix, ``(3, 3) float``.

    Parameters
    ----------
    text
        Its value.
    measure
        How long lengths are; its page is what percentages are of.

    Raises
    ------
    InputError
        It is none, or one of three dimensions.
    """
    if text.strip().lower() == "none":
        return np.eye(3)
    known = _ARGUMENTS | _CSS_ONLY | {"rotate": (1,)}

    def values(name: str, text: str) -> list[float]:
        words = text.replace(",", " ").split()
        if name.startswith("translate"):
            sides = ("height",) if name == "translateY" else ("width", "height")
            return [
                measure.length(side, word) for side, word in zip(sides, words, strict=False)
            ] + [0.0] * (len(words) - len(sides))
        if name.startswith(("rotate", "skew")):
            return [_angle(word) for word in words]
        return numbers("transform", text)

    return _product(text, known, values)


def origin(text: str, measure: Measure) -> tuple[float, float]:
    """Where a transform has its origin, from the corner of what percentages are of.

    Raises
    ------
    InputError
        It is no place.
    """
    words = text.lower().split()[:2]
    if len(words) == 1:
        words = ["center", *words] if words[0] in {"top", "bottom"} else [*words, "center"]
    elif words and (words[0] in {"top", "bottom"} or words[1] in {"left", "right"}):
        words.reverse()
    if len(words) != 2:
        msg = f"transform-origin {text[:60]!r}: must be a place across and one down"
        raise InputError(msg)
    x, y = (
        _PLACES[word] * measure.side(side) if word in _PLACES else measure.length(side, word)
        for side, word in zip(("width", "height"), words, strict=True)
    )
    return x, y


def moved(x: float, y: float) -> Floats:
    """The matrix of a movement, ``(3, 3) float``."""
    return np.array([[1.0, 0.0, x], [0.0, 1.0, y], [0.0, 0.0, 1.0]])


def _product(
    text: str,
    known: dict[str, tuple[int, ...]],
    values: Callable[[str, str], list[float]],
) -> Floats:
    matrix, at = np.eye(3), 0
    while at < len(text):
        found = _TRANSFORM.match(text, at)
        given = values(found[1], found[2]) if found and found[1] in known else []
        if not found or len(given) not in known.get(found[1], ()):
            msg = f"transform {text[:60]!r}: must be {', '.join(known)} with their numbers"
            raise InputError(msg)
        matrix = matrix @ _matrix(found[1], given)
        at = found.end()
    return matrix


def _matrix(name: str, values: list[float]) -> Floats:
    if name == "matrix":
        a, b, c, d, e, f = values
        return np.array([[a, c, e], [b, d, f], [0.0, 0.0, 1.0]])
    if name == "rotate":
        cos, sin = _turn(values[0])
        turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
        x, y = values[1:] or (0.0, 0.0)
        return np.asarray(moved(x, y) @ turn @ moved(-x, -y))
    # What is said of one axis only leaves the other as it is, but for scales of both.
    usual = values[0] if name == "scale" else 1.0 if name.startswith("scale") else 0.0
    x, y = [usual, values[0]] if name.endswith("Y") else [*values, usual][:2]
    if name.startswith("scale"):
        return np.diag([x, y, 1.0])
    if name.startswith("skew"):
        x, y = (math.tan(math.radians(value)) for value in (x, y))
        return np.array([[1.0, x, 0.0], [y, 1.0, 0.0], [0.0, 0.0, 1.0]])
    return moved(x, y)


def _turn(degrees: float) -> tuple[float, float]:
    """Cosine and sine, exact for right angles."""
    quarter, rest = divmod(degrees, 90)
    if rest == 0:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarter % 4)]
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


def _angle(text: str) -> float:
    found = _ANGLE.fullmatch(text)
    value = numbers("transform", found[1]) if found else []
    if found is None or len(value) != 1 or not abs(value[0]) <= LARGEST:
        msg = f"transform: {text[:60]!r} must be an angle, with or without deg, rad, grad, turn"
        raise InputError(msg)
    return value[0] * _DEGREES[found[2].lower()]
