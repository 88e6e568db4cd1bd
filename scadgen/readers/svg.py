"""Frames from SVG: the outlines of its shapes, whatever their style.

y goes up in a frame and down in SVG, so a frame looks as the drawing does.  The XML is read
by defusedxml, which refuses entities; nothing outside the file is ever opened.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from scadgen.errors import InputError
from scadgen.readers.curves import flattened, is_curved, polyline
from scadgen.readers.reading import Read, Reading, checked_scale, from_segments, load, unknown
from scadgen.readers.svg_text import PIXEL, length, lengths, numbers, transform
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["read_svg"]

_SVG = "{http://www.w3.org/2000/svg}"
_HREF = "{http://www.w3.org/1999/xlink}href"

#: What path data is made of.
_PATH = re.compile(r"\s*[Mm][MmZzLlHhVvCcSsQqTtAa0-9eE+\-.,\s]*")

_GROUPS = {"svg", "g", "a"}
_SHAPES = {"line", "polyline", "polygon", "path", "rect", "circle", "ellipse"}

#: Never drawn where they stand.
_UNSEEN = {
    "clipPath",
    "defs",
    "desc",
    "filter",
    "linearGradient",
    "marker",
    "mask",
    "metadata",
    "pattern",
    "radialGradient",
    "script",
    "style",
    "symbol",
    "title",
}

#: Attributes by which a symbol is fitted to where it is used, which is not done here.
_FITTED = {"viewBox", "refX", "refY"}

#: Uses of uses go this deep; deeper ones go in circles.
_DEEPEST_USE = 8


@dataclass(slots=True)
class _Drawing:
    reading: Reading
    by_id: dict[str, Element]
    segments: list[Floats] = field(default_factory=list)
    strange: Counter[str] = field(default_factory=Counter)
    count: int = 0
    visited: int = 0
    #: Shapes with curves, and their segments.
    curved: int = 0
    chords: int = 0

    def count_in(self, *, segments: int = 0, elements: int = 0) -> None:
        """Stop before a drawing that repeats itself fills the memory."""
        self.count += segments
        self.visited += elements
        if max(self.count, self.visited) > self.reading.most:
            msg = f"more than {self.reading.most} segments, unless more are allowed (--most)"
            raise InputError(msg)


def read_svg(path: Path, reading: Reading) -> Read:
    """Read a frame from the lines, polygons and paths of an SVG file.

    Raises
    ------
    InputError
        Another kind of file, entities, links to other files, elements that cannot be part of a
        frame, numbers that are none; or no frame.
    """
    root = _parse(load(path, reading))
    if root.tag not in (f"{_SVG}svg", "svg"):
        msg = f"is not SVG: its first element is {root.tag[:60]!r}"
        raise InputError(msg)
    by_id = {key: e for e in root.iter() if (key := e.get("id")) is not None}
    drawing = _Drawing(reading, by_id)
    _walk(root, _page(root, reading), drawing)
    curves = flattened(drawing.curved, drawing.chords, reading.flatten)
    notes = (*unknown(drawing.strange, reading), *curves)
    return from_segments(path.stem, drawing.segments, reading, notes)


def _parse(data: bytes) -> Element:
    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import ParseError, fromstring

    try:
        root: Element = fromstring(data, forbid_entities=True, forbid_external=True)
    except DefusedXmlException:
        msg = "defines XML entities or refers to other files, which no drawing needs"
    except (ParseError, ValueError, LookupError) as error:
        msg = f"is not XML: {error}"
    else:
        return root
    raise InputError(msg)


def _page(root: Element, reading: Reading) -> Floats:
    """From user units to mm, ``(3, 3) float``."""
    box = root.get("viewBox")
    if box is None:
        scale = checked_scale(reading, PIXEL)
        return np.diag([scale, -scale, 1.0])
    corner_and_size = numbers("viewBox", box)
    if len(corner_and_size) != 4 or not min(corner_and_size[2:]) > 0:
        msg = f"viewBox {box[:60]!r}: must be x, y, a width and a height"
        raise InputError(msg)
    x, y, width, height = corner_and_size
    sizes = [
        _size(name, root.get(name) or "") / extent
        for name, extent in (("width", width), ("height", height))
        if not (root.get(name) or "%").strip().endswith("%")
    ]
    if reading.scale is not None or not sizes:
        sizes = [checked_scale(reading, PIXEL)]
    fit = (root.get("preserveAspectRatio") or "").split()
    if "none" not in fit:
        sizes = [max(sizes) if "slice" in fit else min(sizes)]
    right, up = sizes[0], sizes[-1]
    return np.array([[right, 0.0, -right * x], [0.0, -up, up * (y + height)], [0.0, 0.0, 1.0]])


def _size(name: str, text: str) -> float:
    """A width or height of the page, in mm."""
    size = length(name, text, absolute=True)
    if not size > 0:
        msg = f"{name} = {text[:60]!r}: must be above 0"
        raise InputError(msg)
    return size


def _walk(root: Element, page: Floats, drawing: _Drawing) -> None:
    """Collect the segments of an element and all in it; with a stack, as files may nest deep."""
    stack = [(root, page, 0)]
    while stack:
        element, matrix, depth = stack.pop()
        drawing.count_in(elements=1)
        kind = _kind(element)
        if kind is None or kind in _UNSEEN or _hidden(element):
            continue
        if element.get("transform"):
            matrix = matrix @ transform(element.get("transform", ""))
        if kind in _GROUPS and (element is root or kind != "svg"):
            stack.extend((child, matrix, depth) for child in reversed(element))
        elif kind == "use":
            stack.extend(_used(element, matrix, depth, drawing))
        elif kind in _SHAPES:
            for points in _outline(kind, element, matrix, drawing):
                turned = points @ matrix[:2, :2].T + matrix[:2, 2]
                drawing.segments.append(np.stack([turned[:-1], turned[1:]], axis=1))
        else:
            drawing.strange[kind] += 1


def _kind(element: Element) -> str | None:
    """Name of an SVG element; None for what belongs to an editor."""
    tag = element.tag
    if tag.startswith("{") and not tag.startswith(_SVG):
        return None
    return tag.removeprefix(_SVG)


def _hidden(element: Element) -> bool:
    style = (element.get("style") or "").replace(" ", "")
    return element.get("display") == "none" or "display:none" in style


def _used(
    element: Element, matrix: Floats, depth: int, drawing: _Drawing
) -> list[tuple[Element, Floats, int]]:
    """What a use shows, and where; the last first."""
    link = element.get("href") or element.get(_HREF) or ""
    target = drawing.by_id.get(link.removeprefix("#"))
    if not link.startswith("#") or target is None:
        msg = f"use of {link[:60]!r}: must be the id of an element in the same file"
        raise InputError(msg)
    if depth == _DEEPEST_USE:
        msg = f"use of {link[:60]!r}: more than {_DEEPEST_USE} uses within each other"
        raise InputError(msg)
    move = np.eye(3)
    move[:2, 2] = [length(n, element.get(n) or "0") for n in ("x", "y")]
    matrix = matrix @ move
    kind = _kind(target)
    if kind is not None and kind not in _UNSEEN:
        return [(target, matrix, depth + 1)]
    fitted = sorted(_FITTED & set(target.attrib))
    if kind != "symbol" or fitted:
        drawing.strange[" with ".join([f"used {kind or 'foreign element'}", *fitted[-1:]])] += 1
        return []
    matrix = matrix @ transform(target.get("transform") or "")
    return [(child, matrix, depth + 1) for child in reversed(target)]


def _outline(kind: str, element: Element, matrix: Floats, drawing: _Drawing) -> list[Floats]:
    """Polylines of a shape in its own units."""
    if kind in ("polyline", "polygon"):
        flat = numbers("points", element.get("points") or "")
        if len(flat) % 2:
            msg = f"{kind}: its points are {len(flat)} numbers, an odd count"
            raise InputError(msg)
        points = np.array(flat).reshape(-1, 2)
        closed = kind == "polygon" and len(points) > 0
        lines = [np.concatenate([points, points[:1]]) if closed else points]
    elif kind == "line":
        lines = [np.array(lengths(element, "x1", "y1", "x2", "y2")).reshape(2, 2)]
    else:
        stretch = float(np.linalg.norm(matrix[:2, :2], 2))
        if not np.isfinite(stretch) or stretch == 0:
            msg = f"{kind}: a transform leaves nothing of it"
            raise InputError(msg)
        within = drawing.reading.flatten / stretch
        most = drawing.reading.most - drawing.count
        path = _curve(kind, element)
        lines = polyline(path, within, most)
        if is_curved(path):
            drawing.curved += 1
            drawing.chords += sum(len(line) - 1 for line in lines)
    drawing.count_in(segments=sum(max(len(line) - 1, 0) for line in lines))
    return [line for line in lines if len(line) > 1]


def _curve(kind: str, element: Element) -> Any:  # noqa: ANN401 -- svgelements has no types
    """A path, rectangle, circle or ellipse as svgelements' path."""
    import svgelements

    if kind == "path":
        data = element.get("d") or ""
        if not data.strip() or data.strip() == "none":
            return svgelements.Path()
        if not _PATH.fullmatch(data):
            msg = f"path {data[:60]!r}: is no path data"
            raise InputError(msg)
        try:
            return svgelements.Path(data)
        except (ValueError, IndexError, TypeError, ZeroDivisionError, AttributeError):
            msg = f"path {data[:60]!r}: is no path data"
            raise InputError(msg) from None
    names = {
        "rect": ("x", "y", "width", "height"),
        "circle": ("cx", "cy", "r"),
        "ellipse": ("cx", "cy", "rx", "ry"),
    }[kind]
    values = lengths(element, *names)
    if min(values[2:]) <= 0:
        return svgelements.Path()
    if kind == "rect":
        radii = [lengths(element, n)[0] if element.get(n) else None for n in ("rx", "ry")]
        given = [r for r in radii if r is not None]
        rounded = [r if r is not None else given[0] for r in radii] if given else [0.0, 0.0]
        return svgelements.Path(svgelements.Rect(*values, *rounded))
    round_shape = svgelements.Circle if kind == "circle" else svgelements.Ellipse
    return svgelements.Path(round_shape(*values))
