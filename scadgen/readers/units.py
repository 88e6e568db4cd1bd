"""Units of length, by the names that people give them and the numbers that DXF has."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from scadgen.errors import InputError

__all__ = ["DXF_UNITS", "UNITS", "millimetres", "unit"]

_INCH, _FOOT = 25.4, 304.8

#: The foot of surveys in the USA, in mm: a metre has 39.37 of its inches.
_SURVEY_FOOT = 12 * 1000 / 39.37

#: Millimetres in each unit that can be named.
UNITS: Mapping[str, float] = MappingProxyType(
    {
        "mm": 1.0,
        "cm": 10.0,
        "dm": 100.0,
        "m": 1000.0,
        "km": 1e6,
        "um": 1e-3,
        "inch": _INCH,
        "mil": _INCH / 1000,
        "foot": _FOOT,
        "yard": 3 * _FOOT,
        "point": _INCH / 72,
    }
)

#: Other names of the same.
_OTHERS = {
    "in": "inch",
    '"': "inch",
    "inches": "inch",
    "ft": "foot",
    "'": "foot",
    "feet": "foot",
    "yd": "yard",
    "pt": "point",
    "µm": "um",
    "millimetre": "mm",
    "millimeter": "mm",
    "centimetre": "cm",
    "centimeter": "cm",
    "metre": "m",
    "meter": "m",
}

#: Millimetres in each unit that a DXF file states as $INSUNITS.
DXF_UNITS: Mapping[int, float] = MappingProxyType(
    {
        1: _INCH,
        2: _FOOT,
        3: 5280 * _FOOT,
        4: 1.0,
        5: 10.0,
        6: 1000.0,
        7: 1e6,
        8: _INCH / 1e6,
        9: _INCH / 1000,
        10: 3 * _FOOT,
        11: 1e-7,
        12: 1e-6,
        13: 1e-3,
        14: 100.0,
        15: 1e4,
        16: 1e5,
        17: 1e12,
        18: 149_597_870_700e3,
        19: 9_460_730_472_580_800e3,
        20: 30_856_775_814_913_673e3,
        21: _SURVEY_FOOT,
        22: _SURVEY_FOOT / 12,
        23: 3 * _SURVEY_FOOT,
        24: 5280 * _SURVEY_FOOT,
    }
)

_LENGTH = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(\D*)")


def unit(name: str) -> float:
    """Millimetres in a unit.

    Raises
    ------
    InputError
        It is none that has a name here.
    """
    plain = name.strip().lower()
    size = UNITS.get(_OTHERS.get(plain, plain))
    if size is None:
        msg = f"unit {name[:30]!r}: must be one of {', '.join(UNITS)}"
        raise InputError(msg)
    return size


def millimetres(text: str) -> float:
    """A length as it is typed, in mm: ``8``, ``8mm``, ``0.8 cm`` or ``1in``.

    Raises
    ------
    InputError
        It is none.
    """
    found = _LENGTH.fullmatch(text.strip().lower())
    if found is None:
        msg = (
            f"{text[:30]!r} is not a length: must be a number of mm, or have a unit, as 8mm or 1in"
        )
        raise InputError(msg)
    return float(found[1]) * (unit(found[2]) if found[2] else 1.0)
