"""Where an element of a drawing stands: its transform, its viewport, what is shown of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from scadgen.readers.svg_clip import region
from scadgen.readers.svg_shapes import length
from scadgen.readers.svg_style import Style
from scadgen.readers.svg_text import Measure
from scadgen.readers.svg_transform import css_transform, moved, origin, transform
from scadgen.readers.svg_viewport import Page, fitted, view_box
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from shapely.geometry.base import BaseGeometry

__all__ = [
    "Box",
    "Viewport",
    "measured",
    "outermost",
    "own_transform",
    "viewport",
    "visible",
    "within",
]

#: Corner and size.
Box = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, slots=True, eq=False)
class Viewport:
    """Where an element stands.

    Parameters
    ----------
    matrix
        From its user units to mm, ``(3, 3) float``.
    style
        What it inherits.
    measure
        How long its lengths are.
    clip
        What is shown, in mm; None for everything.
    depth
        How many uses and clip paths it is in.
    use
        The use that shows it, if one does so directly.
    used
        What is used, if it is in that.
    """

    matrix: Floats
    style: Style
    measure: Measure
    clip: BaseGeometry | None = None
    depth: int = 0
    use: Element | None = None
    used: Element | None = None


def outermost(root: Element, page: Page, style: Style) -> Viewport:
    """Where the root of a document is: turned about its middle, if it is, as in a window.

    Raises
    ------
    InputError
        A transform that is none.
    """
    matrix, shown = page.to_mm, None
    middle = "0 0" if page.window is None else "50% 50%"
    style = {"transform-origin": middle, **style, "transform-box": "view-box"}
    window = Viewport(np.eye(3), style, Measure(page.window, dots=page.dots))
    turn = own_transform(root, window, lambda: ((0.0, 0.0), page.window or (0.0, 0.0)))
    if turn is not None:
        matrix = matrix @ np.linalg.inv(page.to_window) @ turn @ page.to_window
    if page.window is not None and page.sheet is not None:
        (left, low), (right, high) = page.sheet
        corners = np.array([[left, low], [right, low], [right, high], [left, high]])
        shown = region([corners], "nonzero")
        if turn is not None:
            moves = matrix @ np.linalg.inv(page.to_mm)
            shown = region([corners @ moves[:2, :2].T + moves[:2, 2]], "nonzero").intersection(
                shown
            )
    return Viewport(matrix, {}, Measure(page.size, dots=page.dots), shown)


def visible(place: Viewport) -> bool:
    """Whether shapes are seen there."""
    return place.style.get("visibility", "visible") == "visible"


def measured(style: dict[str, str], outer: Measure, *, root: bool) -> Measure:
    """How long lengths are in an element; the size of its letters is taken out of its style."""
    said = style.pop("font-size", None)
    if said is None:
        return outer
    size = outer.font_size(said, outer.font)
    return replace(outer, font=size, root_font=size if root else outer.root_font)


def within(here: Viewport, shown: BaseGeometry) -> Viewport:
    """The same place, of which less is shown."""
    return replace(here, clip=shown if here.clip is None else here.clip.intersection(shown))


def viewport(element: Element, here: Viewport, use: Element | None) -> Viewport | None:
    """What is in a viewport within the drawing; None if that has no size.

    Parameters
    ----------
    element
        The viewport: `svg` or `symbol`.
    here
        Where it stands.
    use
        The use that shows it, if one does: that may say another size.
    """
    x, y = (length(name, element, here.style, here.measure) for name in ("x", "y"))
    matrix = here.matrix @ moved(x, y)
    sizes = {"width": "100%", "height": "100%"}
    for name in sizes:
        asked = [None if use is None else use.get(name), here.style.get(name), element.get(name)]
        sizes[name] = next((text for text in asked if text and text.strip() != "auto"), "100%")
    clips = here.style.get("overflow", "hidden") in {"hidden", "scroll", "clip"}
    box = view_box(element)
    if here.measure.page is None and box is None and "100%" in sizes.values():
        return replace(here, matrix=matrix)
    width, height = (here.measure.length(name, text) for name, text in sizes.items())
    if min(width, height) <= 0:
        return None
    if clips:
        corners = np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
        here = within(here, region([corners @ matrix[:2, :2].T + matrix[:2, 2]], "nonzero"))
    page = (width, height)
    if box is not None:
        matrix = matrix @ fitted(box, element.get("preserveAspectRatio") or "", *page)
        page = box[2:]
    return replace(here, matrix=matrix, measure=replace(here.measure, page=page))


def own_transform(element: Element, here: Viewport, box: Callable[[], Box]) -> Floats | None:
    """What moves an element, in user units, ``(3, 3) float``; None if nothing does.

    Parameters
    ----------
    element
        The element.
    here
        Where it stands, with its own style.
    box
        Gives the box around it.

    Raises
    ------
    InputError
        A transform that is none.
    """
    style = here.style
    attribute = element.get("transform") if "transform" not in style else None
    moves = " ".join(
        f"{name}({','.join(style[name].split())})"
        for name in ("translate", "rotate", "scale")
        if style.get(name, "none") != "none"
    )
    styled = style.get("transform", "none")
    if not moves and not attribute and styled == "none":
        return None
    (left, top), measure = (0.0, 0.0), here.measure
    if style.get("transform-box", "view-box") != "view-box":
        (left, top), size = box()
        measure = replace(measure, page=size)
    matrix = css_transform(moves, measure)
    matrix = matrix @ (transform(attribute) if attribute else css_transform(styled, measure))
    about = style.get("transform-origin")
    if about is not None:
        x, y = origin(about, measure)
        left, top = left + x, top + y
    return np.asarray(moved(left, top) @ matrix @ moved(-left, -top))
