"""Kinds of elements of SVG: what each is for, and for whom."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["GROUPS", "HREF", "NAMESPACE", "UNSEEN", "VIEWPORTS", "kind_of", "wanted"]

NAMESPACE = "{http://www.w3.org/2000/svg}"

HREF = "{http://www.w3.org/1999/xlink}href"

GROUPS = {"svg", "g", "a", "symbol"}

#: Groups that are viewports: what is beyond them is not shown.
VIEWPORTS = {"svg", "symbol"}

#: Never drawn where they stand.
UNSEEN = {
    "animate",
    "animateMotion",
    "animateTransform",
    "clipPath",
    "color-profile",
    "defs",
    "desc",
    "filter",
    "font",
    "font-face",
    "linearGradient",
    "marker",
    "mask",
    "metadata",
    "pattern",
    "radialGradient",
    "script",
    "set",
    "style",
    "symbol",
    "title",
    "view",
}


def kind_of(element: Element) -> str | None:
    """Name of an SVG element; None for what belongs to an editor."""
    tag = element.tag
    if tag.startswith("{") and not tag.startswith(NAMESPACE):
        return None
    return tag.removeprefix(NAMESPACE)


def wanted(element: Element) -> bool:
    """Whether an element is for who reads it: someone who knows no extensions, in English."""
    if element.get("requiredExtensions") is not None:
        return False
    tongues = element.get("systemLanguage")
    return tongues is None or any(
        tongue.strip().lower().split("-")[0] == "en" for tongue in tongues.split(",")
    )
