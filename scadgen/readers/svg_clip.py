"""What is inside of outlines, and what clipping leaves of shapes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from scadgen.errors import InputError
from scadgen.plane.planarity import crossings
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["Paint", "clipped", "covered", "region"]

#: Outlines that clip or are clipped cross themselves this often, at most.
_MOST_CROSSINGS = 20_000

#: Faces times segments of such an outline, at most.
_MOST_STEPS = 50_000_000

#: Lines that go along the edge of what is shown, this near to it, are shown, in mm.
_NEAR = 1e-6


class Paint(NamedTuple):
    """How a shape is painted: whether it is filled, by which rule, and whether it is stroked."""

    filled: bool
    stroked: bool
    rule: str


def region(lines: Sequence[Floats], rule: str) -> BaseGeometry:
    """What polylines enclose, each closed by a straight line, by SVG's rule for filling.

    Parameters
    ----------
    lines
        Each ``(k, 2) float``.
    rule
        `nonzero` or `evenodd`.

    Raises
    ------
    InputError
        They cross themselves too often.
    """
    rings = [ring for line in lines if (ring := _ring(line)) is not None]
    if len(rings) == 1 and (whole := shapely.Polygon(rings[0])).is_valid:
        return whole
    if not rings:
        return shapely.Polygon()
    ends = np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings])
    points, number = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    pairs = number.reshape(-1, 2)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    if len(crossings(points, pairs, _MOST_CROSSINGS)) > _MOST_CROSSINGS:
        msg = (
            f"an outline that clips or is clipped crosses itself more than {_MOST_CROSSINGS} times"
        )
        raise InputError(msg)
    faces = shapely.get_parts(
        shapely.polygonize([shapely.union_all(shapely.linestrings(points[pairs]))])
    )
    if len(faces) * len(pairs) > _MOST_STEPS:
        msg = f"an outline that clips or is clipped has more than {len(faces)} parts"
        raise InputError(msg)
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    turns = np.array([_turns(point, ends) for point in inside], dtype=int)
    kept = turns % 2 == 1 if rule == "evenodd" else turns != 0
    return shapely.union_all(faces[kept])


def covered(lines: Sequence[Floats], clip: BaseGeometry) -> bool:
    """Whether all of some lines is shown; quick where much is clipped by the same."""
    shapely.prepare(clip)
    return bool(clip.covers(shapely.MultiLineString([shapely.LineString(x) for x in lines])))


def clipped(
    lines: list[Floats], clip: BaseGeometry, paint: Paint, tolerance: float
) -> list[Floats]:
    """What clipping leaves of the outlines of a shape; they themselves if it leaves all.

    Of a shape that is filled these are the outlines of what is still filled, with pieces of
    the edge of what clips it.

    Parameters
    ----------
    lines
        Outlines of the shape, each ``(k, 2) float``, in mm.
    clip
        What is shown.
    paint
        How the shape is painted.
    tolerance
        Lines that are no further outside are left as they are; shorter ones are left out.
    """
    drawn = shapely.MultiLineString([shapely.LineString(line) for line in lines])
    if clip.distance(drawn.envelope) > tolerance:
        return []
    if clip.buffer(tolerance, join_style="mitre").covers(drawn):
        return lines
    kept: list[BaseGeometry] = []
    if paint.filled:
        kept.append(region(lines, paint.rule).intersection(clip).boundary)
    if paint.stroked:
        strokes = drawn.intersection(clip)
        along = drawn.intersection(clip.buffer(_NEAR, join_style="mitre"))
        if along.length > strokes.length + tolerance:
            strokes = along
        kept.append(strokes.difference(kept[0].buffer(2 * _NEAR)) if paint.filled else strokes)
    parts = [part for whole in kept for part in _lines_of(whole) if part.length > tolerance]
    return [shapely.get_coordinates(part) for part in parts]


def _ring(line: Floats) -> Floats | None:
    """A polyline, closed; None if it encloses nothing."""
    ring = np.concatenate([line, line[:1]])
    moved = (ring[1:] != ring[:-1]).any(axis=1)
    ring = np.concatenate([ring[:1], ring[1:][moved]])
    return ring if len(ring) > 3 else None


def _lines_of(geometry: BaseGeometry) -> list[BaseGeometry]:
    parts = shapely.get_parts(geometry)
    if any(part.geom_type == "GeometryCollection" for part in parts):
        return [line for part in parts for line in _lines_of(part)]
    lines = [part for part in parts if part.geom_type in {"LineString", "LinearRing"}]
    if not lines:
        return []
    return list(shapely.get_parts(shapely.line_merge(shapely.multilinestrings(lines))))


def _turns(point: Floats, ends: Floats) -> int:
    """How often segments go round a point, counter-clockwise."""
    start, end = ends[:, 0] - point, ends[:, 1] - point
    left = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]
    up = (start[:, 1] <= 0) & (end[:, 1] > 0) & (left > 0)
    down = (start[:, 1] > 0) & (end[:, 1] <= 0) & (left < 0)
    return int(np.count_nonzero(up)) - int(np.count_nonzero(down))
