"""Words as people type them: lengths with units, and names that are nearly right."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from types import MappingProxyType

__all__ = ["length", "meant"]

#: What some frames are called elsewhere.
_ELSEWHERE: Mapping[str, str] = MappingProxyType(
    {
        "comb": "hexagonal",
        "grid": "square",
        "honeycomb": "hexagonal",
        "isogrid": "triangular",
        "lattice": "square",
        "octagonal": "4.8.8",
        "orthogrid": "square",
        "polygon": "ring",
        "quadratic": "square",
        "truss": "strip",
    }
)


def meant(word: str, known: Iterable[str]) -> str:
    """What a word that is not among some may have meant: `` (did you mean ring?)``, or nothing."""
    names = {name.lower(): name for name in known}
    plain = word.lower()
    elsewhere = _ELSEWHERE.get(plain, "")
    near = [elsewhere] if elsewhere in names else get_close_matches(plain, names, n=1)
    return f" (did you mean {names[near[0]]}?)" if near else ""


def length(text: str) -> float:
    """A length in mm: a number, or one with a unit, as in ``8mm``, ``0.8 cm`` and ``1in``.

    Raises
    ------
    InputError
        It is none.
    """
    from scadgen.readers.units import millimetres

    try:
        return float(text)
    except ValueError:
        return millimetres(text)
