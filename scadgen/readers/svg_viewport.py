"""Viewports: the page in millimetres, and how what is drawn fits in its place."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from scadgen.errors import InputError
from scadgen.readers.reading import Reading
from scadgen.readers.svg_style import Style
from scadgen.readers.svg_text import DOTS, Measure, numbers
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["Page", "fitted", "page_of", "view_box"]

_INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}version"

#: Before this version a pixel of Inkscape was the 90th part of an inch.
_SINCE, _OLD_DOTS = (0, 92), 90.0

_ALIGN = re.compile(r"x(Min|Mid|Max)Y(Min|Mid|Max)")
_SHARES = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}

_Box = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Page:
    """The outermost viewport.

    Parameters
    ----------
    to_mm
        From user units to mm, y up, ``(3, 3) float``.
    to_window
        From user units to pixels of the window it is shown in, ``(3, 3) float``.
    window
        Width and height in those pixels; None if the file does not say both.
    size
        Width and height in user units, which percentages are of; None if the file says none.
    sheet
        Corners of the page in mm, ``(2, 2) float``; None if the file says none.
    dots
        User units in an inch.
    notes
        What is worth telling.
    """

    to_mm: Floats
    to_window: Floats
    window: tuple[float, float] | None
    size: tuple[float, float] | None
    sheet: Floats | None
    dots: float
    notes: tuple[str, ...]


def page_of(root: Element, style: Style, reading: Reading) -> Page:
    """How large a drawing is.

    Raises
    ------
    InputError
        A width, a height or a view box that is none.
    """
    dots, notes = _dots(root)
    sizes = [_size(name, style.get(name) or root.get(name), dots) for name in ("width", "height")]
    box = view_box(root)
    pixel = 25.4 / dots
    if reading.scale is not None:
        notes = ()
    window = None if sizes[0] is None or sizes[1] is None else (sizes[0], sizes[1])
    if box is None:
        scale = pixel if reading.scale is None else reading.scale
        to_mm = np.diag([scale, -scale, 1.0])
        sheet = None if window is None else _sheet(to_mm, 0.0, 0.0, *window)
        return Page(to_mm, np.eye(3), window, window, sheet, dots, notes)
    x, y, width, height = box
    matrix, view = np.eye(3), box
    units = [size / extent for size, extent in zip(sizes, (width, height), strict=True) if size]
    if units:
        full = (sizes[0] or units[0] * width, sizes[1] or units[-1] * height)
        matrix = fitted(box, root.get("preserveAspectRatio") or "", *full)
        across, down = matrix[0, 0], matrix[1, 1]
        view = (-matrix[0, 2] / across, -matrix[1, 2] / down, full[0] / across, full[1] / down)
    right, up = matrix[0, 0] * pixel, matrix[1, 1] * pixel
    if reading.scale is not None:
        right = up = reading.scale
    to_mm = np.array([[right, 0.0, -right * x], [0.0, -up, up * (y + height)], [0.0, 0.0, 1.0]])
    return Page(to_mm, matrix, window, (width, height), _sheet(to_mm, *view), dots, notes)


def view_box(element: Element) -> _Box | None:
    """The view box of an element that has one.

    Raises
    ------
    InputError
        It is none.
    """
    text = element.get("viewBox")
    if text is None:
        return None
    box = numbers("viewBox", text)
    if len(box) != 4 or not min(box[2:]) > 0:
        msg = f"viewBox {text[:60]!r}: must be x, y, a width and a height"
        raise InputError(msg)
    x, y, width, height = box
    return x, y, width, height


def fitted(box: _Box, fit: str, width: float, height: float) -> Floats:
    """From a view box to a viewport of this size at 0, ``(3, 3) float``.

    Parameters
    ----------
    box
        x, y, width, height.
    fit
        The attribute `preserveAspectRatio`; what nobody understands is as if it were not there.
    width, height
        Of the viewport.
    """
    words = [word for word in fit.split() if word != "defer"] or ["xMidYMid"]
    x, y, *extent = box
    right, down = width / extent[0], height / extent[1]
    align = _ALIGN.fullmatch(words[0])
    if words[0] != "none":
        right = down = max(right, down) if "slice" in words[1:] else min(right, down)
    shares = [_SHARES[word] for word in align.groups()] if align else [0.5, 0.5]
    return np.array(
        [
            [right, 0.0, shares[0] * (width - right * extent[0]) - right * x],
            [0.0, down, shares[1] * (height - down * extent[1]) - down * y],
            [0.0, 0.0, 1.0],
        ]
    )


def _dots(root: Element) -> tuple[float, tuple[str, ...]]:
    """Pixels of an inch, by the program that drew it."""
    version = re.match(r"(\d{1,4})\.(\d{1,4})", root.get(_INKSCAPE) or "")
    if version is None or not (0, 1) <= (int(version[1]), int(version[2])) < _SINCE:
        return DOTS, ()
    note = (
        f"drawn with Inkscape {version[0]}: pixels are taken as 1/{_OLD_DOTS:g} inch, as there; "
        "--scale says otherwise"
    )
    return _OLD_DOTS, (note,)


def _size(name: str, text: str | None, dots: float) -> float | None:
    """A width or height of the page in pixels; None if it is one of the window it is shown in."""
    if text is None or text.strip().endswith("%") or text.strip() in {"", "auto"}:
        return None
    size = Measure(dots=dots).length(name, text)
    if not size > 0:
        msg = f"{name} = {text[:60]!r}: must be above 0"
        raise InputError(msg)
    return size


def _sheet(to_mm: Floats, x: float, y: float, width: float, height: float) -> Floats:
    corners = np.array([[x, y, 1.0], [x + width, y + height, 1.0]]) @ to_mm.T
    return np.sort(corners[:, :2], axis=0)
