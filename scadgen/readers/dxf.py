"""Frames from DXF: what lies in its model space."""

from __future__ import annotations

import itertools
import logging
import math
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from scadgen.errors import InputError
from scadgen.readers.curves import arc, check_count, flattened
from scadgen.readers.reading import Read, Reading, checked_scale, from_segments, load, unknown
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.dxfgfx import DXFGraphic
    from ezdxf.math import Vec3

__all__ = ["read_dxf"]

_KNOWN = ("ARC", "CIRCLE", "LINE", "LWPOLYLINE", "POLYLINE")

#: Heights that differ by less than this are one, in units of the drawing: rounded decimals.
_FLAT = 1e-6


def read_dxf(path: Path, reading: Reading) -> Read:
    """Read a frame from the lines, polylines, arcs and circles of a DXF file.

    Without units in its header, a unit is a millimetre.

    Raises
    ------
    InputError
        Another kind of file, entities that cannot be part of a frame, points at different
        heights; or no frame.
    """
    has_unit = b"$INSUNITS" in load(path, reading)
    complaints = _Complaints()
    document = _open(path, complaints)
    if complaints.lines and not reading.skip_unknown:
        msg = f"is broken: {next(iter(complaints.lines))}; --skip-unknown skips what is unknown"
        raise InputError(msg)
    scale = checked_scale(reading, _unit(document) if has_unit else 1.0)
    strange: Counter[str] = Counter()
    lines: list[Floats] = []
    most, curved = reading.most, []
    shown = _shown(document)
    for entity in shown:
        kind = entity.dxftype()
        if kind not in _KNOWN or _is_mesh(entity):
            strange[kind] += 1
            continue
        points = _checked_points(entity, reading.flatten / scale, most)
        most -= max(len(points) - 1, 0)
        check_count(most)
        lines.append(points * [scale, scale, 1.0])
        if kind in ("ARC", "CIRCLE") or getattr(entity, "has_arc", False):
            curved.append(len(points) - 1)
    notes = (
        *complaints.lines,
        *unknown(strange, reading),
        *_unseen(document, len(shown)),
        *flattened(len(curved), sum(curved), reading.flatten),
    )
    _check_flat(lines)
    segments = [np.stack([line[:-1, :2], line[1:, :2]], axis=1) for line in lines]
    return from_segments(path.stem, segments, reading, notes)


class _Complaints(logging.Handler):
    """What ezdxf says of a file while it reads it; it would go to stderr otherwise."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: Counter[str] = Counter()

    def emit(self, record: logging.LogRecord) -> None:
        self.lines[_one_line(record.getMessage())] += 1


def _open(path: Path, complaints: _Complaints) -> Drawing:
    from ezdxf.filemanagement import readfile

    logger = logging.getLogger("ezdxf")
    logger.addHandler(complaints)
    try:
        return readfile(path)
    except Exception as error:  # noqa: BLE001 -- its parsers let out whatever broken files cause
        msg = f"is not DXF: {_one_line(str(error)) or type(error).__name__}"
        raise InputError(msg) from None
    finally:
        logger.removeHandler(complaints)


def _one_line(text: str) -> str:
    return " ".join(text.split())[:120]


def _unit(document: Drawing) -> float:
    """Millimetres per unit."""
    from ezdxf.enums import InsertUnits
    from ezdxf.units import conversion_factor

    try:
        unit = InsertUnits(document.header.get("$INSUNITS", 0))
        return conversion_factor(unit, InsertUnits.Millimeters)
    except (ValueError, TypeError):
        return 1.0


def _shown(document: Drawing) -> list[DXFGraphic]:
    """What is seen of the model space: on layers that are neither off nor frozen."""
    layers = document.layers
    hidden = {layers.key(one.dxf.name) for one in layers if one.is_off() or one.is_frozen()}
    return [
        entity
        for entity in document.modelspace()
        # What ezdxf does not know has no such attribute, and may have a layer all the same.
        if not (entity.dxf.hasattr("invisible") and entity.dxf.invisible)
        and layers.key(entity.graphic_properties().get("layer", "0")) not in hidden
    ]


def _unseen(document: Drawing, shown: int) -> tuple[str, ...]:
    count = len(document.modelspace()) - shown
    what = "entities that are invisible, or on layers that are off or frozen, left out"
    return (f"{what}: {count}",) if count else ()


def _is_mesh(entity: DXFGraphic) -> bool:
    """Whether a POLYLINE is none, but the faces of a mesh."""
    from ezdxf.entities.polyline import Polyline

    return isinstance(entity, Polyline) and not (entity.is_2d_polyline or entity.is_3d_polyline)


def _checked_points(entity: DXFGraphic, within: float, most: int) -> Floats:
    try:
        return _points(entity, within, most)
    except InputError:
        raise
    except (ValueError, TypeError, OverflowError, AttributeError):
        msg = f"{entity.dxftype()} {entity.dxf.handle}: its numbers are broken"
        raise InputError(msg) from None


def _points(entity: DXFGraphic, within: float, most: int) -> Floats:
    """An entity as a polyline, ``(k, 3) float``."""
    from ezdxf.entities.lwpolyline import LWPolyline
    from ezdxf.entities.polyline import DXFVertex, Polyline

    kind = entity.dxftype()
    if kind == "LINE":
        return np.array([tuple(entity.dxf.start), tuple(entity.dxf.end)])
    if isinstance(entity, LWPolyline):
        rows = np.array(entity.get_points("xyb"), dtype=float).reshape(-1, 3)
        height = float(entity.dxf.elevation)
        return _placed(entity, _bulged(_closed(rows, entity.closed), within, most), height)
    if isinstance(entity, Polyline):
        # The points that a spline was drawn with stand among those that are on it.
        drawn = [
            v for v in entity.vertices if not v.dxf.flags & DXFVertex.SPLINE_FRAME_CONTROL_POINT
        ]
        corners = [(*v.dxf.location, v.dxf.get("bulge", 0.0)) for v in drawn]
        rows = _closed(np.array(corners, dtype=float).reshape(-1, 4), entity.is_closed)
        if entity.is_3d_polyline:
            return rows[:, :3]
        height = float(rows[0, 2]) if len(rows) else 0.0
        return _placed(entity, _bulged(rows[:, [0, 1, 3]], within, most), height)
    x, y, height = entity.dxf.center
    start, end = (entity.dxf.start_angle, entity.dxf.end_angle) if kind == "ARC" else (0, 360)
    sweep = math.radians((end - start) % 360 or 360)
    around = arc(float(entity.dxf.radius), math.radians(start), sweep, within, most)
    if kind == "CIRCLE":
        around[-1] = around[0]
    return _placed(entity, around + np.array([x, y]), height)


def _placed(entity: DXFGraphic, points: Floats, height: float) -> Floats:
    """Points of an entity's own plane in space."""
    lifted = np.column_stack([points, np.full(len(points), height)])
    placed = [tuple(p) for p in entity.ocs().points_to_wcs(map(_vector, lifted))]
    return np.array(placed, dtype=float).reshape(-1, 3)


def _vector(point: Floats) -> Vec3:
    from ezdxf.math import Vec3

    return Vec3(*point.tolist())


def _closed(rows: Floats, closed: bool) -> Floats:  # noqa: FBT001 -- a property of a polyline
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


def _check_flat(lines: list[Floats]) -> None:
    heights = np.concatenate([line[:, 2] for line in lines]) if lines else np.zeros(1)
    if not np.ptp(heights) <= _FLAT * max(1.0, float(np.abs(heights).max())):
        low, high = heights.min(), heights.max()
        msg = f"is not plane: its points are at heights from {low:.6g} to {high:.6g}"
        raise InputError(msg)
