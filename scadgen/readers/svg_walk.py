"""The shapes of a document, in the order in which they are painted, each where it stands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np
import shapely

from scadgen.errors import InputError
from scadgen.readers.svg_clip import region
from scadgen.readers.svg_elements import GROUPS, HREF, UNSEEN, VIEWPORTS, kind_of, wanted
from scadgen.readers.svg_paint import linked
from scadgen.readers.svg_place import (
    Box,
    Viewport,
    measured,
    own_transform,
    viewport,
    visible,
    within,
)
from scadgen.readers.svg_properties import share
from scadgen.readers.svg_shapes import SHAPES, length, outline
from scadgen.readers.svg_style import Cascade
from scadgen.readers.svg_text import LARGEST
from scadgen.readers.svg_transform import moved
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from shapely.geometry.base import BaseGeometry

__all__ = ["Shape", "Walk"]

#: What is wanted: what is painted, what clips, or what an element's box is around.
Mode = Literal["paint", "clip", "box"]

#: Corners of what clips, each time that something is clipped, for each segment that is allowed.
_CLIPPING = 20

#: Uses of uses, and clip paths of clip paths, go this deep; deeper ones go in circles.
_DEEPEST = 8


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """A shape, and its outlines in mm, each ``(k, 2) float``."""

    kind: str
    place: Viewport
    lines: list[Floats]
    curved: bool


@dataclass(slots=True)
class Walk:
    """A walk through a document.

    Parameters
    ----------
    cascade
        Its styles.
    by_id
        Its elements.
    flatten
        How far chords may be from curves, in mm.
    most
        Segments, and elements, at most.
    """

    cascade: Cascade
    by_id: dict[str, Element]
    flatten: float
    most: int
    #: Elements that are shown and are no shapes, by kind.
    strange: Counter[str] = field(default_factory=Counter)
    #: What shapes have that is not done, by name.
    undone: Counter[str] = field(default_factory=Counter)
    #: How many elements are not shown because their style says so.
    hidden: int = 0
    _segments: int = 0
    _visited: int = 0
    _clipping: int = 0
    _clips: dict[tuple[Element, bytes], BaseGeometry] = field(default_factory=dict)

    def shapes(
        self, elements: Iterable[Element], place: Viewport, mode: Mode = "paint"
    ) -> Iterator[Shape]:
        """Shapes of elements and of all that is in them.

        Parameters
        ----------
        elements
            Where to begin.
        place
            Where these stand.
        mode
            What they are wanted for.

        Raises
        ------
        InputError
            Something in it makes no sense, or there is too much of it.
        """
        # With a stack, as files may nest deep.
        stack = [(element, place) for element in reversed([*elements])]
        while stack:
            element, outer = stack.pop()
            self.count(elements=1)
            kind = kind_of(element)
            if kind is None or (kind in UNSEEN and outer.use is None) or not wanted(element):
                continue
            here = self._enter(kind, element, outer, mode)
            if here is None:
                continue
            if kind in SHAPES:
                if mode == "box" or visible(here):
                    yield self._shape(kind, element, here)
                else:
                    self.hidden += mode == "paint"
            elif kind in GROUPS:
                stack.extend((child, here) for child in reversed(element))
            elif kind == "switch":
                first = [c for c in element if kind_of(c) is not None and wanted(c)][:1]
                stack.extend((child, here) for child in first)
            elif kind == "use":
                stack.extend(self._used(element, here))
            elif (
                mode == "paint"
                and visible(here)
                and (element.text or len(element) or element.attrib)
            ):
                self.strange[kind] += 1

    def count(self, *, segments: int = 0, elements: int = 0) -> None:
        """Stop before a drawing that repeats itself fills the memory."""
        self._segments += segments
        self._visited += elements
        if max(self._segments, self._visited) > self.most:
            msg = f"more than {self.most} segments, unless more are allowed (--most)"
            raise InputError(msg)

    def count_clipping(self, clip: BaseGeometry) -> None:
        """Stop before clipping takes all day."""
        self._clipping += int(shapely.count_coordinates(clip))
        if self._clipping > _CLIPPING * self.most:
            msg = (
                f"clip paths: more than {_CLIPPING * self.most} corners in all (--most allows more)"
            )
            raise InputError(msg)

    def _enter(self, kind: str, element: Element, outer: Viewport, mode: Mode) -> Viewport | None:
        """Where the inside of an element is; None if nothing of it is shown."""
        root = element is self.cascade.root and outer.use is None
        style = self.cascade.style(element, outer.style, outer.used)
        measure = measured(style, outer.measure, root=root)
        clear = mode == "paint" and share(style.get("opacity", "1")) <= 0
        if clear or (style.get("display") == "none" and kind != "symbol"):
            self.hidden += mode == "paint"
            return None
        here = replace(outer, style=style, measure=measure, use=None)
        matrix = (
            None if root else own_transform(element, here, lambda: self._box(kind, element, here))
        )
        if matrix is not None:
            here = replace(here, matrix=outer.matrix @ matrix)
            _check_size(here)
        if mode != "box":
            here = self._clipped(kind, element, here)
        if mode == "paint":
            self.undone.update(
                name for name in ("mask", "filter") if style.get(name, "none") != "none"
            )
        if kind in VIEWPORTS and not root:
            return viewport(element, here, outer.use)
        return here

    def _shape(self, kind: str, element: Element, here: Viewport) -> Shape:
        stretch = float(np.linalg.norm(here.matrix[:2, :2], 2))
        if not np.isfinite(stretch) or stretch == 0:
            msg = f"{kind}: a transform leaves nothing of it"
            raise InputError(msg)
        room = self.most - self._segments
        near = self.flatten / stretch
        lines, curved = outline(kind, element, here.style, here.measure, near, room)
        self.count(segments=sum(max(len(line) - 1, 0) for line in lines))
        turned = [
            line @ here.matrix[:2, :2].T + here.matrix[:2, 2] for line in lines if len(line) > 1
        ]
        return Shape(kind, here, turned, curved)

    def _used(self, element: Element, here: Viewport) -> list[tuple[Element, Viewport]]:
        """What a use shows, and where."""
        link = element.get("href") or element.get(HREF) or ""
        if not link.startswith("#"):
            msg = f"use of {link[:60]!r}: must be the id of an element in the same file"
            raise InputError(msg)
        _check_depth(here, f"use of {link[:60]!r}", "uses")
        target = self.by_id.get(link[1:])
        kind = "nothing" if target is None else kind_of(target) or "foreign element"
        if target is None or kind_of(target) is None or kind in UNSEEN - {"symbol"}:
            self.strange[f"used {kind}"] += 1
            return []
        x, y = (length(name, element, here.style, here.measure) for name in ("x", "y"))
        matrix = here.matrix @ moved(x, y)
        inside = replace(here, matrix=matrix, depth=here.depth + 1, use=element, used=target)
        return [(target, inside)]

    def _clipped(self, kind: str, element: Element, here: Viewport) -> Viewport:
        """The place with what the clip path of an element leaves of it."""
        said = here.style.get("clip-path", "none")
        link = linked(said)
        if link is None:
            self.undone["clip-path"] += said != "none"
            return here
        target = self.by_id.get(link[0])
        if target is None or kind_of(target) != "clipPath":
            return here
        if any(kind_of(child) == "text" for child in target):
            self.undone["clip-path"] += 1
            return here
        matrix = here.matrix
        if target.get("clipPathUnits") == "objectBoundingBox":
            (x, y), (width, height) = self._box(kind, element, here)
            matrix = matrix @ moved(x, y) @ np.diag([width, height, 1.0])
        key = (target, matrix.tobytes())
        if key not in self._clips:
            _check_depth(here, f"clip path {link[0][:60]!r}", "clip paths")
            self._clips[key] = self._region(target, replace(here, matrix=matrix))
        self.count_clipping(self._clips[key])
        return within(here, self._clips[key])

    def _region(self, path: Element, here: Viewport) -> BaseGeometry:
        """What a clip path shows, in mm."""
        parent = self.cascade.in_place(path)
        turn = own_transform(path, replace(here, style=parent), lambda: ((0.0, 0.0), (0.0, 0.0)))
        matrix = here.matrix if turn is None else here.matrix @ turn
        inside = replace(
            here, matrix=matrix, style=parent, clip=None, depth=here.depth + 1, used=None
        )
        # A group in it clips nothing, nor one that it uses.
        parts = [child for child in path if kind_of(child) in SHAPES | {"use"}]
        regions = []
        for shape in self.shapes(parts, inside, "clip"):
            whole = region(shape.lines, shape.place.style.get("clip-rule", "nonzero"))
            clip = shape.place.clip
            regions.append(whole if clip is None else whole.intersection(clip))
        whole = shapely.union_all(regions) if regions else shapely.Polygon()
        outer = self._clipped("clipPath", path, replace(inside, style=parent)).clip
        return whole if outer is None else whole.intersection(outer)

    def _box(self, kind: str, element: Element, here: Viewport) -> Box:
        """Corner and size of the box around an element, in its user units."""
        if not abs(np.linalg.det(here.matrix[:2, :2])) > 0:
            return (0.0, 0.0), (0.0, 0.0)
        if kind in SHAPES:
            shapes = [self._shape(kind, element, here)]
        else:
            _check_depth(here, f"box around {kind}", "boxes")
            here = replace(here, depth=here.depth + 1)
            inside = self._used(element, here) if kind == "use" else []
            inside = inside or [(child, here) for child in element]
            shapes = [s for child, place in inside for s in self.shapes([child], place, "box")]
        points = [line for shape in shapes for line in shape.lines]
        if not points:
            return (0.0, 0.0), (0.0, 0.0)
        back = np.linalg.inv(here.matrix)
        own = np.concatenate(points) @ back[:2, :2].T + back[:2, 2]
        low, high = own.min(axis=0).tolist(), own.max(axis=0).tolist()
        return (low[0], low[1]), (high[0] - low[0], high[1] - low[1])


def _check_depth(here: Viewport, what: str, kind: str) -> None:
    if here.depth == _DEEPEST:
        msg = f"{what}: more than {_DEEPEST} {kind} within each other"
        raise InputError(msg)


def _check_size(here: Viewport) -> None:
    if not (np.abs(here.matrix) <= LARGEST).all():
        msg = "transforms: make a number that is too large"
        raise InputError(msg)
