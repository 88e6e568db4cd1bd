"""The outlines of DXF's shapes, as polylines in space."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from scadgen.readers.curves import arc, check_count
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from ezdxf.entities.dxfgfx import DXFGraphic
    from ezdxf.entities.polyline import Polyline
    from ezdxf.math import BSpline, ConstructionEllipse

__all__ = ["SHAPES", "is_curved", "outlines"]

#: What has an outline.
SHAPES = frozenset(
    {
        *("LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"),
        *("HATCH", "MPOLYGON", "3DFACE", "SOLID", "TRACE", "MESH"),
    }
)

#: Shares of the distance that chords may have from a curve: of points taken on it one after the
#: other, and of those of them that stay.
_FINE, _KEPT = 0.1, 0.85


def is_curved(entity: DXFGraphic) -> bool:
    """Whether an entity has curves."""
    kind = entity.dxftype()
    if kind in ("HATCH", "MPOLYGON"):
        paths = getattr(entity, "paths", ())
        return any(_is_bulged(p) if hasattr(p, "vertices") else _has_curves(p) for p in paths)
    return kind in ("ARC", "CIRCLE", "ELLIPSE", "SPLINE") or bool(getattr(entity, "has_arc", False))


def outlines(entity: Any, within: float, most: int) -> Iterator[Floats]:  # noqa: ANN401 -- of many types
    """The outlines of an entity, each ``(k, 3) float`` with two points or more.

    Parameters
    ----------
    entity
        One of the `SHAPES`.
    within
        How far a chord may be from its curve, in units of the drawing.
    most
        Chords of a curve at most.

    Raises
    ------
    InputError
        More chords than that.
    """
    for line in _lines(entity, within, most):
        if len(line) > 1:
            yield line


def _lines(entity: Any, within: float, most: int) -> Iterator[Floats]:  # noqa: ANN401 -- as above
    kind = entity.dxftype()
    if kind == "LINE":
        yield _array([entity.dxf.start, entity.dxf.end])
    elif kind in ("ARC", "CIRCLE"):
        yield _round(entity, within, most)
    elif kind == "ELLIPSE":
        yield _ellipse(entity.construction_tool(), within, most)
    elif kind == "SPLINE":
        yield _spline(entity.construction_tool(), within, most)
    elif kind == "LWPOLYLINE":
        rows = np.array(entity.get_points("xyb"), dtype=float).reshape(-1, 3)
        flat = _bulged(_closed(rows, closed=entity.closed), within, most)
        yield _placed(entity, flat, float(entity.dxf.elevation))
    elif kind == "POLYLINE" and (entity.is_2d_polyline or entity.is_3d_polyline):
        yield _polyline(entity, within, most)
    elif kind in ("POLYLINE", "MESH"):
        yield from _mesh(entity)
    elif kind in ("HATCH", "MPOLYGON"):
        yield from _hatch(entity, within, most)
    else:
        yield from _sides(entity)


def _round(entity: Any, within: float, most: int) -> Floats:  # noqa: ANN401 -- as above
    """An arc or a circle."""
    whole = entity.dxftype() == "CIRCLE"
    x, y, height = entity.dxf.center
    start, end = (0, 360) if whole else (entity.dxf.start_angle, entity.dxf.end_angle)
    around = _arc(float(entity.dxf.radius), start, end, within, most)
    return _placed(entity, around + np.array([x, y]), height)


def _arc(radius: float, start: float, end: float, within: float, most: int) -> Floats:
    """Points of an arc around 0 between two angles, in degrees; a circle closes."""
    sweep = math.radians((end - start) % 360 or 360)
    around = arc(radius, math.radians(start), sweep, within, most)
    if (end - start) % 360 == 0:
        around[-1] = around[0]
    return around


def _ellipse(ellipse: ConstructionEllipse, within: float, most: int) -> Floats:
    """An ellipse or an arc of one, in the space that its centre is in."""
    start, end = ellipse.start_param, ellipse.end_param
    sweep = (end - start) % (2 * math.pi)
    whole = min(sweep, 2 * math.pi - sweep) < 1e-9
    axes = _array([ellipse.major_axis, ellipse.minor_axis])
    size = float(np.linalg.norm(axes, axis=1).max())
    if not size:
        return np.zeros((0, 3))
    # A chord of the unit circle is as much farther from it as the longer axis is longer.
    around = arc(1.0, start, 2 * math.pi if whole else sweep, within / size, most)
    if whole:
        around[-1] = around[0]
    return np.asarray(_array([ellipse.center]) + around @ axes)


def _spline(spline: BSpline, within: float, most: int) -> Floats:
    """A spline by the fewest of many points on it."""
    from shapely import LineString

    on = _array(itertools.islice(spline.flattening(_FINE * within), most + 2))
    check_count(most + 1 - len(on))
    kept = LineString(on).simplify(_KEPT * within, preserve_topology=False)
    return np.asarray(kept.coords, dtype=float).reshape(-1, 3)


def _polyline(entity: Polyline, within: float, most: int) -> Floats:
    """A polyline of vertices."""
    from ezdxf.entities.polyline import DXFVertex

    # The points that a spline was drawn with stand among those that are on it.
    drawn = [v for v in entity.vertices if not v.dxf.flags & DXFVertex.SPLINE_FRAME_CONTROL_POINT]
    corners = [(*v.dxf.location, v.dxf.get("bulge", 0.0)) for v in drawn]
    rows = np.array(corners, dtype=float).reshape(-1, 4)
    rows = _closed(rows, closed=entity.is_closed)
    if entity.is_3d_polyline:
        return rows[:, :3]
    height = float(rows[0, 2]) if len(rows) else 0.0
    return _placed(entity, _bulged(rows[:, [0, 1, 3]], within, most), height)


def _mesh(entity: DXFGraphic) -> Iterator[Floats]:
    """The sides of a mesh's faces."""
    from ezdxf.disassemble import make_primitive

    mesh = make_primitive(entity).mesh
    if mesh is None:
        return
    points = _array(mesh.vertices)
    for face in mesh.faces:
        corners = list(face)
        yield points[corners + corners[:1]]


def _sides(entity: Any) -> Iterator[Floats]:  # noqa: ANN401 -- as above
    """The sides of a face of three or four corners, but those that it hides."""
    corners = _array(entity.wcs_vertices())
    hidden = entity.get_edges_visibility() if entity.dxftype() == "3DFACE" else []
    for number, side in enumerate(_pairs(corners)):
        if number >= len(hidden) or hidden[number]:
            yield side


def _pairs(corners: Floats) -> Iterator[Floats]:
    for k in range(len(corners)):
        yield corners[[k, (k + 1) % len(corners)]]


def _hatch(entity: Any, within: float, most: int) -> Iterator[Floats]:  # noqa: ANN401 -- as above
    """The boundaries of a hatch."""
    height = float(entity.dxf.elevation.z)
    moved = entity.dxf.is_supported("offset_vector") and entity.dxf.hasattr("offset_vector")
    offset = _array([entity.dxf.offset_vector if moved else (0, 0)])[0, :2]
    for path in entity.paths:
        if hasattr(path, "vertices"):
            rows = np.array(path.vertices, dtype=float).reshape(-1, 3)
            # A boundary is closed, whatever it says.
            lines = [_bulged(_closed(rows, closed=True), within, most)]
        else:
            lines = [_edge(edge, within, most) for edge in path.edges]
        for line in lines:
            yield _placed(entity, line + offset, height)


def _edge(edge: Any, within: float, most: int) -> Floats:  # noqa: ANN401 -- as above
    """One edge of a hatch's boundary, in its plane."""
    kind = edge.type.name
    if kind == "LINE":
        return _array([edge.start, edge.end])[:, :2]
    if kind == "ARC":
        around = _arc(float(edge.radius), edge.start_angle, edge.end_angle, within, most)
        return np.asarray(around + _array([edge.center])[:, :2])
    if kind == "ELLIPSE":
        return _ellipse(edge.construction_tool(), within, most)[:, :2]
    if edge.control_points:
        return _spline(edge.construction_tool(), within, most)[:, :2]
    from ezdxf.math import fit_points_to_cad_cv

    return _spline(fit_points_to_cad_cv(edge.fit_points), within, most)[:, :2]


def _is_bulged(path: Any) -> bool:  # noqa: ANN401 -- as above
    return any(bulge for *_, bulge in path.vertices)


def _has_curves(path: Any) -> bool:  # noqa: ANN401 -- as above
    return any(edge.type.name != "LINE" for edge in path.edges)


def _placed(entity: Any, points: Floats, height: float) -> Floats:  # noqa: ANN401 -- as above
    """Points of an entity's own plane in space."""
    from ezdxf.math import Vec3

    lifted = np.column_stack([points, np.full(len(points), height)])
    return _array(entity.ocs().points_to_wcs(Vec3(*p) for p in lifted.tolist()))


def _array(points: Iterable[Any]) -> Floats:
    """Points of ezdxf in space."""
    rows = [(p[0], p[1], p[2] if len(p) > 2 else 0.0) for p in points]
    return np.array(rows, dtype=float).reshape(-1, 3)


def _closed(rows: Floats, *, closed: bool) -> Floats:
    return np.concatenate([rows, rows[:1]]) if closed else rows


def _bulged(rows: Floats, within: float, most: int) -> Floats:
    """Corners with a bulge each: the tangent of a quarter of the arc to the next one."""
    parts = [rows[:1, :2]]
    for (x, y, bulge), end in itertools.pairwise(rows):
        start, chord = np.array([x, y]), end[:2] - [x, y]
        length = float(np.hypot(*chord))
        if bulge and length:
            sweep = 4 * math.atan(bulge)
            # A radius below 0 goes with a sweep below 0: the centre is on the other side.
            radius = length / 2 / math.sin(sweep / 2)
            first = math.atan2(chord[1], chord[0]) - (sweep + math.pi) / 2
            points = arc(radius, first, sweep, within, most)
            parts.append(start + points[1:-1] - points[0])
        parts.append(end[None, :2])
    return np.concatenate(parts)
