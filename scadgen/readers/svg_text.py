"""Numbers and lengths as SVG's attributes and style sheets write them."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from scadgen.errors import InputError

__all__ = ["DOTS", "LARGEST", "Measure", "numbers"]

#: Pixels of an inch.
DOTS = 96.0

#: Inches in each unit of length but those of pixels.
_UNITS = {"mm": 1 / 25.4, "cm": 10 / 25.4, "in": 1.0, "pt": 1 / 72, "pc": 1 / 6, "q": 1 / 101.6}

#: Patterns that any text is searched with in linear time.
_NUMBER = re.compile(r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?")
_LENGTH = re.compile(rf"({_NUMBER.pattern})\s?([a-zA-Z]*|%)")

#: Numbers go up to this: the squares of their products are numbers too.
LARGEST = 1e12

#: Sizes of letters by name, in pixels; each is larger than the one before by this.
_FONT_SIZES = {"xx-small": 9, "x-small": 10, "small": 13, "medium": 16, "large": 18, "x-large": 24}
_FONT_SIZES |= {"xx-large": 32, "xxx-large": 48}
_LARGER = 1.2


@dataclass(frozen=True, slots=True)
class Measure:
    """How long lengths are where they stand.

    Parameters
    ----------
    page
        Width and height of the nearest viewport in user units; None where it has no size.
    font
        Size of letters, in user units.
    root_font
        Size of letters of the root.
    dots
        User units in an inch.
    """

    page: tuple[float, float] | None = None
    font: float = 16.0
    root_font: float = 16.0
    dots: float = DOTS

    def length(self, name: str, text: str) -> float:
        """Length in user units; a percentage is one of the side of the page that the name is of.

        Raises
        ------
        InputError
            It is none.
        """
        found = _LENGTH.fullmatch(text.strip())
        unit = found[2].lower() if found else ""
        if not found or not abs(float(found[1])) <= LARGEST:
            unit = "?"
        each = self._unit(name, unit)
        if found is None or each is None:
            msg = (
                f"{name} = {text[:60]!r}: must be a number, with or without a unit such as mm or %"
            )
            raise InputError(msg)
        return float(found[1]) * each

    def font_size(self, text: str, parent: float) -> float:
        """Size of letters, in user units; the parent's where the text is none."""
        word = text.lower()
        if word in _FONT_SIZES:
            return float(_FONT_SIZES[word])
        if word in {"larger", "smaller"}:
            return parent * (_LARGER if word == "larger" else 1 / _LARGER)
        found = _LENGTH.fullmatch(word)
        if found is None or not abs(float(found[1])) <= LARGEST:
            return parent
        outer = Measure((100 * parent,) * 2, parent, self.root_font, self.dots)
        each = parent / 100 if found[2] == "%" else outer._unit("font-size", found[2])
        return parent if each is None else float(found[1]) * each

    def side(self, name: str) -> float:
        """What percentages of a length are of: width, height or, for radii, both.

        Raises
        ------
        InputError
            The page has no size.
        """
        if self.page is None:
            msg = f"{name}: is a share of a page whose size the file does not say"
            raise InputError(msg)
        width, height = self.page
        if name in {"x", "x1", "x2", "cx", "rx", "width"}:
            return width
        if name in {"y", "y1", "y2", "cy", "ry", "height"}:
            return height
        return math.hypot(width, height) / math.sqrt(2)

    def _unit(self, name: str, unit: str) -> float | None:
        """User units in a unit; None if there is no such unit."""
        if unit in {"", "px"}:
            return 1.0
        if unit == "%":
            return self.side(name) / 100
        if unit in _UNITS:
            return _UNITS[unit] * self.dots
        return {"em": self.font, "ex": self.font / 2, "ch": self.font / 2}.get(
            unit, self.root_font if unit == "rem" else None
        )


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
    if not max(map(abs, values), default=0) <= LARGEST:
        msg = f"{what} {text[:60]!r}: has a number that is too large"
        raise InputError(msg)
    return values
