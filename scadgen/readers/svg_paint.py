"""Whether shapes are painted."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from scadgen.readers.svg_elements import HREF, kind_of
from scadgen.readers.svg_properties import alpha, share
from scadgen.readers.svg_style import Cascade, Style
from scadgen.readers.svg_text import Measure

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["MARKERS", "Paints", "linked"]

MARKERS = ("marker-start", "marker-mid", "marker-end")

_URL = re.compile(r"url\(\s*[\"']?#([^\"')]*)[\"']?\s*\)\s*(.*)", re.DOTALL)

_GRADIENTS = {"linearGradient", "radialGradient"}

#: Gradients that refer to each other, at most.
_DEEPEST = 8


def linked(text: str | None) -> tuple[str, str] | None:
    """The id that a value refers to, and what comes after; None if it refers to none."""
    found = _URL.match(text or "")
    return (found[1], found[2].strip()) if found else None


class Paints:
    """What fills and strokes of a document paint.

    Parameters
    ----------
    by_id
        Its elements.
    cascade
        Its styles.
    """

    def __init__(self, by_id: Mapping[str, Element], cascade: Cascade) -> None:
        self._by_id = by_id
        self._cascade = cascade
        self._known: dict[Element, bool] = {}

    def fills(self, style: Style) -> bool:
        """Whether a shape with this style is filled, if it has an inside."""
        return self._seen(style, "fill", "black")

    def strokes(self, style: Style, measure: Measure) -> bool:
        """Whether a shape with this style is stroked."""
        if not self._seen(style, "stroke", "none"):
            return False
        width = style.get("stroke-width", "1")
        return width.startswith("calc(") or measure.length("stroke-width", width) > 0

    def has_pattern(self, style: Style) -> bool:
        """Whether it is painted with a pattern, of which nothing is read."""
        found = (self._target(style.get(name)) for name in ("fill", "stroke"))
        return any(target is not None and kind_of(target) == "pattern" for target in found)

    def _target(self, paint: str | None) -> Element | None:
        link = linked(paint)
        return self._by_id.get(link[0]) if link else None

    def _seen(self, style: Style, name: str, default: str) -> bool:
        paint = style.get(name, default)
        if share(style.get(f"{name}-opacity", "1")) <= 0:
            return False
        link = linked(paint)
        if link is not None:
            target = self._by_id.get(link[0])
            if target is not None and kind_of(target) in {*_GRADIENTS, "pattern"}:
                if target not in self._known:
                    self._known[target] = self._shows(target)
                return self._known[target]
            paint = link[1] or "none"
        if paint.lower() == "none":
            return False
        if paint.lower() == "currentcolor":
            paint = style.get("color", "black")
        return alpha(paint) != 0

    def _shows(self, server: Element) -> bool:
        """Whether a gradient or a pattern paints anything."""
        for target in self._chain(server):
            children = [child for child in target if kind_of(child) is not None]
            if kind_of(server) == "pattern" and children:
                return True
            stops = [child for child in children if kind_of(child) == "stop"]
            if stops:
                return any(self._opaque(stop) for stop in stops)
        return False

    def _chain(self, server: Element) -> Iterator[Element]:
        target: Element | None = server
        for _ in range(_DEEPEST):
            if target is None:
                return
            yield target
            link = target.get("href") or target.get(HREF) or ""
            target = self._by_id.get(link.removeprefix("#"))

    def _opaque(self, stop: Element) -> bool:
        style = self._cascade.style(stop, {})
        color = style.get("stop-color", "black")
        return share(style.get("stop-opacity", "1")) > 0 and alpha(color) != 0
