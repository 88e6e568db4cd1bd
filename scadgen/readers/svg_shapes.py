"""Shapes as polylines in their own units."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from scadgen.errors import InputError
from scadgen.readers.curves import is_curved, polyline
from scadgen.readers.svg_path import path_of
from scadgen.readers.svg_text import Measure, numbers
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["SHAPES", "length", "outline"]

SHAPES = frozenset({"line", "polyline", "polygon", "path", "rect", "circle", "ellipse"})

#: Path data in a style sheet.
_CSS_PATH = re.compile(r"path\(\s*(?:\w+\s*,)?\s*([\"'])(.*)\1\s*\)", re.DOTALL)


def outline(
    kind: str,
    element: Element,
    style: Mapping[str, str],
    measure: Measure,
    within: float,
    most: int,
) -> tuple[list[Floats], bool]:
    """Polylines of a shape, each ``(k, 2) float``, and whether they were curves.

    Parameters
    ----------
    kind
        One of `SHAPES`.
    element, style, measure
        The shape.
    within
        How far a chord may be from its curve, in user units.
    most
        Chords at most.

    Raises
    ------
    InputError
        Numbers or path data that are none, too large, or too many chords.
    """
    if kind in {"polyline", "polygon"}:
        flat = numbers("points", element.get("points") or "")
        if len(flat) % 2:
            msg = f"{kind}: its points are {len(flat)} numbers, an odd count"
            raise InputError(msg)
        points = np.array(flat).reshape(-1, 2)
        closed = kind == "polygon" and len(points) > 0
        return [np.concatenate([points, points[:1]]) if closed else points], False
    if kind == "line":
        ends = [length(name, element, {}, measure) for name in ("x1", "y1", "x2", "y2")]
        return [np.array(ends).reshape(2, 2)], False
    path = _path(element, style) if kind == "path" else _round(kind, element, style, measure)
    curved = is_curved(path)
    lines = polyline(path, within, most)
    return [_moving(line) for line in lines] if curved else lines, curved


def _moving(line: Floats) -> Floats:
    """A line without the steps of no length that closing it or rounding a corner makes."""
    return np.asarray(line[np.r_[True, (np.diff(line, axis=0) != 0).any(axis=1)]])


def length(
    name: str, element: Element, style: Mapping[str, str], measure: Measure, default: str = "0"
) -> float:
    """A length that is a property or an attribute, in user units.

    Raises
    ------
    InputError
        It is none.
    """
    text = style.get(name) or element.get(name) or default
    return measure.length(name, default if text.strip() == "auto" else text)


def _path(element: Element, style: Mapping[str, str]) -> Any:  # noqa: ANN401 -- svgelements has no types
    data = element.get("d") or ""
    styled = style.get("d")
    if styled is not None:
        found = _CSS_PATH.fullmatch(styled)
        data = found[2] if found else "" if styled == "none" else data
    return path_of("" if data.strip() == "none" else data)


def _round(kind: str, element: Element, style: Mapping[str, str], measure: Measure) -> Any:  # noqa: ANN401 -- as above
    """A rectangle, circle or ellipse as svgelements' path."""
    import svgelements

    def of(*names: str) -> list[float]:
        return [length(name, element, style, measure) for name in names]

    if kind == "circle":
        x, y, radius = of("cx", "cy", "r")
        return svgelements.Path(svgelements.Circle(x, y, radius) if radius > 0 else ())
    radii = _radii(element, style, measure)
    if kind == "ellipse":
        x, y = of("cx", "cy")
        return svgelements.Path(svgelements.Ellipse(x, y, *radii) if min(radii) > 0 else ())
    x, y, width, height = of("x", "y", "width", "height")
    if min(width, height) <= 0:
        return svgelements.Path()
    right, down = min(radii[0], width / 2), min(radii[1], height / 2)
    if min(right, down) <= 0:
        right = down = 0.0
    return svgelements.Path(svgelements.Rect(x, y, width, height, right, down))


def _radii(element: Element, style: Mapping[str, str], measure: Measure) -> list[float]:
    """The radii of a rectangle or an ellipse: one that is not said is as the other."""
    said = []
    for name in ("rx", "ry"):
        text = (style.get(name) or element.get(name) or "auto").strip()
        size = None if text == "auto" else measure.length(name, text)
        said.append(size if size is not None and size >= 0 else None)
    known = [size for size in said if size is not None]
    return [(known[0] if known else 0.0) if size is None else size for size in said]
