"""Frames from SVG: the outlines of what a browser shows of it.

y goes up in a frame and down in SVG, so a frame looks as the drawing does.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from scadgen.readers.curves import flattened
from scadgen.readers.reading import Read, Reading, from_segments, load, unknown
from scadgen.readers.svg_clip import Paint, clipped, covered
from scadgen.readers.svg_elements import kind_of
from scadgen.readers.svg_paint import MARKERS, Paints
from scadgen.readers.svg_place import outermost
from scadgen.readers.svg_style import Cascade
from scadgen.readers.svg_viewport import Page, page_of
from scadgen.readers.svg_walk import Shape, Walk
from scadgen.readers.svg_xml import parse_svg
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["read_svg"]

#: A rectangle that covers the page is its background, if it is this near to its edges or
#: beyond them, in shares of its longer side.
_NEAR_EDGE = 0.01

#: A line whose width is more than this share of its length encloses something.
_WIDE = 1e-9

#: What is told of what is not done.
_UNDONE = {
    "clip-path": "clip paths that are text or said by a style alone",
    "filter": "filters",
    "marker": "markers",
    "mask": "masks",
    "pattern": "patterns",
}

#: What is told of what was left out or changed, each with a count.
_TOLD = {
    "background": "filled rectangle as large as the page left out, as background",
    "background read": "filled rectangle as large as the page, with nothing else in it",
    "beyond": "shapes beyond the page left out, as browsers do (a larger page shows them)",
    "cut": "shapes cut at the edge of the page, as browsers do (a larger page shows them whole)",
    "clipped": "shapes that clip paths or viewports hide or cut",
    "closed": "filled outlines closed by a straight line",
    "bare": "shapes without fill and stroke left out",
    "bare read": "nothing in it is painted; shapes without fill and stroke read all the same",
    "hidden": "elements hidden by their style",
    "symbol": "symbols, which are shown where they are used",
}


@dataclass(slots=True)
class _Outlines:
    """What is read of the shapes of a drawing."""

    page: Page
    paints: Paints
    walk: Walk
    tolerance: float
    #: What is shown of the page; None for everything.
    shown: BaseGeometry | None
    lines: list[Floats] = field(default_factory=list)
    #: Outlines of shapes that are not painted, and of backgrounds.
    bare: list[Floats] = field(default_factory=list)
    background: list[Floats] = field(default_factory=list)
    told: Counter[str] = field(default_factory=Counter)
    undone: Counter[str] = field(default_factory=Counter)
    #: Shapes with curves, and their segments.
    curved: int = 0
    chords: int = 0

    def add(self, shape: Shape) -> None:
        """Add what a browser shows of a shape."""
        style = shape.place.style
        filled = shape.kind != "line" and self.paints.fills(style)
        stroked = self.paints.strokes(style, shape.place.measure)
        lines = [self._closed(line) for line in shape.lines] if filled else shape.lines
        if not stroked:
            lines = [line for line in lines if filled and _is_wide(line)]
        if not lines:
            self.told["bare"] += bool(shape.lines)
            self.bare += shape.lines
            return
        self.undone["pattern"] += self.paints.has_pattern(style)
        self.undone["marker"] += any(style.get(name, "none") != "none" for name in MARKERS)
        paint = Paint(filled, stroked, style.get("fill-rule", "nonzero"))
        lines = self._shown(lines, shape.place.clip, paint)
        rimmed = stroked and style.get("stroke") != style.get("fill")
        if not rimmed and not self.lines and self._covers(lines):
            self.told["background"] += 1
            self.background += lines
            return
        self.lines += lines
        if shape.curved:
            self.curved += 1
            self.chords += sum(len(line) - 1 for line in lines)

    def _shown(self, lines: list[Floats], clip: BaseGeometry | None, paint: Paint) -> list[Floats]:
        """What clipping leaves of lines."""
        if clip is None or covered(lines, clip):
            return lines
        self.walk.count_clipping(clip)
        left = clipped(lines, clip, paint, self.tolerance)
        if left is not lines:
            off_page = self.shown is not None and not covered(lines, self.shown)
            self.told[("cut" if left else "beyond") if off_page else "clipped"] += 1
        return left

    def _closed(self, line: Floats) -> Floats:
        """A line around what is filled: that goes on straight to where it began."""
        if not _is_wide(line) or np.linalg.norm(line[0] - line[-1]) <= self.tolerance:
            return line
        self.told["closed"] += 1
        return np.concatenate([line, line[:1]])

    def _covers(self, lines: list[Floats]) -> bool:
        """Whether lines are a rectangle as large as the page, or larger."""
        sheet = self.page.sheet
        if sheet is None or len(lines) != 1:
            return False
        near = _NEAR_EDGE * float((sheet[1] - sheet[0]).max())
        low, high = lines[0].min(axis=0), lines[0].max(axis=0)
        (x, y), (next_x, next_y) = lines[0].T, np.roll(lines[0], -1, axis=0).T
        area = abs(float((x * next_y - next_x * y).sum())) / 2
        full = area >= (1 - _NEAR_EDGE) * float(np.prod(high - low))
        return full and bool((low <= sheet[0] + near).all() and (high >= sheet[1] - near).all())


def read_svg(path: Path, reading: Reading) -> Read:
    """Read a frame from what an SVG file shows in a browser.

    Raises
    ------
    InputError
        Another kind of file, links to other files, elements that cannot be part of a frame,
        numbers that are none; or no frame.
    """
    root, sheets = parse_svg(load(path, reading))
    cascade = Cascade(root)
    by_id = {key: e for e in reversed([*root.iter()]) if (key := e.get("id")) is not None}
    style = cascade.style(root, {})
    page = page_of(root, style, reading)
    place = outermost(root, page, style)
    walk = Walk(cascade, by_id, reading.flatten, reading.most)
    found = _Outlines(page, Paints(by_id, cascade), walk, reading.tolerance, place.clip)
    for shape in walk.shapes([root], place):
        found.add(shape)
    notes = [*page.notes, *_undone(walk.undone + found.undone, sheets + cascade.outside)]
    lines, told = found.lines, found.told
    if not lines:
        # A background alone is what is drawn; so are bare lines, unless something is painted.
        for read, instead in (("background", found.background), ("bare", found.bare)):
            if instead and not lines and not (told["beyond"] or told["clipped"]):
                lines, told[f"{read} read"] = instead, told.pop(read)
        told["hidden"] = walk.hidden
        told["symbol"] = sum(kind_of(element) == "symbol" for element in root.iter())
    notes += [f"{words}: {told[kind]}" for kind, words in _TOLD.items() if told[kind]]
    notes += unknown(walk.strange, reading)
    notes += flattened(found.curved, found.chords, reading.flatten)
    segments = [np.stack([line[:-1], line[1:]], axis=1) for line in lines]
    return from_segments(path.stem, segments, reading, notes)


def _undone(kinds: Counter[str], sheets: int) -> list[str]:
    """Note what is not as it is shown."""
    missed = [f"{_UNDONE[name]}: {kinds[name]}" for name in sorted(kinds) if kinds[name]]
    if sheets:
        missed.append(f"style sheets outside the file: {sheets}")
    return [f"not done, shapes are read without it: {', '.join(missed)}"] if missed else []


def _is_wide(line: Floats) -> bool:
    """Whether a line, closed, encloses anything."""
    away = line - line[0]
    far = away[np.abs(away).sum(axis=1).argmax()]
    off = away @ np.array([-far[1], far[0]])
    return bool(np.abs(off).max() > _WIDE * (far @ far))
