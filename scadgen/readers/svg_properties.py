"""Properties of SVG's elements: which are inherited, which values make sense."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import Any

__all__ = [
    "GEOMETRY",
    "INHERITED",
    "KNOWN",
    "alpha",
    "as_text",
    "custom",
    "plain",
    "share",
    "valid",
]

#: Properties that shapes and viewports have as attributes without units, too.
GEOMETRY = frozenset({"x", "y", "width", "height", "cx", "cy", "r", "rx", "ry"})

#: Those that are not negative.
_SIZES = ("width", "height", "r", "rx", "ry")

INHERITED = frozenset(
    {
        "clip-rule",
        "color",
        "fill",
        "fill-opacity",
        "fill-rule",
        "marker-end",
        "marker-mid",
        "marker-start",
        "stroke",
        "stroke-opacity",
        "stroke-width",
        "visibility",
    }
)

_NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
_SHARE = re.compile(rf"({_NUMBER})(%?)")
_LENGTH = re.compile(rf"{_NUMBER}(?:%|[a-zA-Z]+)|[-+]?0+(?:\.0*)?|auto")
_WORD = re.compile(r"[a-zA-Z-]+")
_URL = re.compile(r"url\(.*\)", re.DOTALL | re.IGNORECASE)
_PAINT_URL = re.compile(r"url\([^)]*\)\s*(.*)", re.DOTALL)


def custom(name: str) -> bool:
    """Whether a property is one that the document defines for itself."""
    return name.startswith("--")


def as_text(tokens: list[Any]) -> str:
    """Tokens of tinycss2 as text; nothing if they nest too deep for anybody."""
    from tinycss2 import serialize

    try:
        return str(serialize(tokens)).strip()
    except RecursionError:
        return ""


@cache
def alpha(color: str) -> float | None:
    """How opaque a colour is, 0 to 1; None if it is none.  The current colour is opaque here."""
    from tinycss2.color4 import parse_color

    try:
        found = parse_color(color)
    except RecursionError:
        return None
    if found is None:
        return None
    return 1.0 if isinstance(found, str) else float(found.alpha)


def plain(name: str, value: str) -> str:
    """A value as it is compared: words are the same in capitals."""
    return value.lower() if _WORD.fullmatch(value) and not custom(name) else value


def share(text: str) -> float:
    """A number or a percentage as a number."""
    found = _SHARE.fullmatch(text.strip())
    return 1.0 if found is None else float(found[1]) / (100 if found[2] else 1)


def valid(name: str, value: str) -> bool:
    """Whether a browser understands this value, so that it does not keep an earlier one."""
    if value in {"inherit", "initial", "unset", "revert"} or "var(" in value or custom(name):
        return True
    return KNOWN[name](value)


def _words(*words: str) -> Callable[[str], bool]:
    return lambda value: value.lower() in words


def _paint(value: str) -> bool:
    link = _PAINT_URL.fullmatch(value)
    rest = value if link is None else link[1].strip()
    if link is not None and not rest:
        return True
    return rest.lower() in {"none", "context-fill", "context-stroke"} or alpha(rest) is not None


def _reference(value: str) -> bool:
    return value == "none" or _URL.fullmatch(value) is not None


def _anything(value: str) -> bool:
    return bool(value)


def _length(value: str) -> bool:
    return _LENGTH.fullmatch(value) is not None or value.startswith("calc(")


#: What each property that matters here may be.
KNOWN: dict[str, Callable[[str], bool]] = {
    **dict.fromkeys(GEOMETRY, _length),
    **dict.fromkeys(_SIZES, lambda value: _length(value) and not value.startswith("-")),
    **dict.fromkeys(("fill", "stroke"), _paint),
    **dict.fromkeys(
        ("fill-opacity", "opacity", "stop-opacity", "stroke-opacity"),
        lambda value: _SHARE.fullmatch(value) is not None,
    ),
    **dict.fromkeys(("marker-end", "marker-mid", "marker-start"), _reference),
    **dict.fromkeys(("clip-rule", "fill-rule"), _words("nonzero", "evenodd")),
    **dict.fromkeys(("color", "stop-color"), lambda value: alpha(value) is not None),
    **dict.fromkeys(("clip-path", "d", "filter", "mask", "rotate", "scale"), _anything),
    **dict.fromkeys(("transform", "transform-origin", "translate"), _anything),
    "display": _words(
        *("none", "inline", "block", "contents", "flex", "grid", "inline-block", "inline-flex"),
        *("inline-grid", "inline-table", "list-item", "table", "flow-root"),
    ),
    "font-size": _anything,
    "overflow": _words("visible", "hidden", "scroll", "auto", "clip"),
    "stroke-width": lambda value: (
        (_length(value) or _SHARE.fullmatch(value) is not None) and not value.startswith("-")
    ),
    "transform-box": _words("view-box", "fill-box", "stroke-box", "content-box", "border-box"),
    "visibility": _words("visible", "hidden", "collapse"),
}
