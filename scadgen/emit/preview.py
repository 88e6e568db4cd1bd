"""Pictures of shells, drawn in Python: a flat-shaded, orthographic z-buffer.

The stages: project the points; list the rows that each front-facing triangle covers;
expand rows to samples and keep the nearest triangle of each; shade; darken the samples
where a feature edge or a silhouette runs; average 2 x 2 samples to a pixel; write PNG.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scadgen.errors import InputError
from scadgen.solid.affine import Floats, Ints

__all__ = ["LARGEST", "Colour", "Shell", "render"]

#: Red, green, blue, each 0 to 255.
Colour = tuple[int, int, int]

#: Points ``(v, 3) float``, triangles ``(m, 3) int`` and one colour.
Shell = tuple[Floats, Ints, Colour]

_Bytes = NDArray[np.uint8]

#: Samples a pixel in each direction.
_OVERSAMPLE = 2
#: Largest width or height, in pixels: the sample buffer then takes half a gigabyte.
LARGEST = 4096
#: Free border, as a fraction of the picture's width and height.
_MARGIN = 0.04
#: Steps that depth is rounded to; with a triangle's number below, it fits 63 bits.
_DEPTH_STEPS = 1 << 30
#: Samples handled at once: large enough for numpy, small enough for the cache.
_BATCH = 1 << 18
#: Faces that meet at more than 30 degrees get a line.
_CREASE = np.cos(np.radians(30.0))
#: Steps in depth larger than this fraction of the scene get a line.
_STEP = 0.006
#: How much of a sample's light is left on a line.
_LINE = 0.3
#: Light that comes from everywhere, then (right, up, towards the viewer) and strength.
_AMBIENT = 0.5
_LIGHTS = (((-0.35, 0.75, 0.6), 0.5), ((0.8, 0.0, 0.6), 0.25))
#: Triangle number of the background.
_NOTHING = np.iinfo(np.int64).max


@dataclass(frozen=True, slots=True)
class _Scene:
    """Front-facing triangles on the sample grid.

    Parameters
    ----------
    corners
        ``(m, 3, 3) float``: x, y (downwards) in samples, and depth (0 near, 1 far).
    normals
        ``(m, 3) float``, unit, as (right, up, towards the viewer).
    slopes
        ``(m, 2) float``: change of depth per sample in x and in y.
    shell
        ``(m,) int``: which shell each is from.
    """

    corners: Floats
    normals: Floats
    slopes: Floats
    shell: Ints


def render(
    shells: Sequence[Shell],
    *,
    size: tuple[int, int] = (1200, 900),
    view: tuple[float, float] = (-60.0, 35.0),
    background: Colour = (250, 250, 248),
) -> bytes:
    """Draw closed shells as a PNG picture that they fill.

    Faces are lit by two lights that move with the viewer; dark lines mark outlines,
    steps in depth and edges of more than 30 degrees.  Only faces whose corners run
    counter-clockwise towards the viewer are drawn.

    Parameters
    ----------
    shells
        ``(points, triangles, colour)`` each: ``(v, 3) float`` in any unit, the same for
        all, ``(m, 3) int`` and red, green, blue from 0 to 255.
    size
        Width and height in pixels, 1 to 4096.
    view
        Where the viewer stands, in degrees: azimuth from +x towards +y, elevation
        above the xy plane.
    background
        Colour where nothing is.

    Returns
    -------
    png
        The file's bytes: 8-bit RGB; the same for the same input.

    Raises
    ------
    InputError
        The size is out of range, a point is not finite, or there is no triangle.
    """
    if not all(1 <= extent <= LARGEST for extent in size):
        msg = f"preview size {size[0]} x {size[1]}: must be 1 to {LARGEST} pixels each way"
        raise InputError(msg)
    width, height = (extent * _OVERSAMPLE for extent in size)
    scene = _project(shells, (width, height), view)
    nearest, owner = _rasterise(scene, width, height)
    lit = _shade(scene, [colour for _, _, colour in shells])
    image = np.vstack([lit, np.array([background], dtype=np.uint8)])[owner]
    lines = _lines(scene, nearest, owner)
    image[lines] = np.rint(image[lines] * _LINE).astype(np.uint8)
    return _png(_average(image))


def _axes(view: tuple[float, float]) -> Floats:
    """Rows: right, up, towards the viewer."""
    azimuth, elevation = np.radians(view)
    ca, sa, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    return np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]])


def _project(
    shells: Sequence[Shell], samples: tuple[int, int], view: tuple[float, float]
) -> _Scene:
    """Turn the shells towards the viewer, fit them, and keep what faces the viewer."""
    count = [len(triangles) for _, triangles, _ in shells]
    if not sum(count):
        msg = "preview of 0 triangles: needs at least one"
        raise InputError(msg)
    axes = _axes(view)
    seen = np.concatenate([(points @ axes.T)[triangles] for points, triangles, _ in shells])
    if not np.isfinite(seen).all():
        msg = "preview of points that are not finite: all coordinates must be numbers"
        raise InputError(msg)
    low, high = seen.min(axis=(0, 1)), seen.max(axis=(0, 1))
    extent = np.maximum(high - low, np.finfo(float).tiny)
    scale = (1 - 2 * _MARGIN) * min(samples[0] / extent[0], samples[1] / extent[1])
    corners = (seen - (low + high) / 2) * (scale, -scale, 1.0)
    corners[..., :2] += np.array(samples) / 2
    corners[..., 2] = (high[2] - seen[..., 2]) / np.max(extent)

    across = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    length = np.linalg.norm(across, axis=1)
    front = across[:, 2] > 1e-9 * length
    across, corners = across[front], corners[front]
    normals = across / length[front, None]
    # The plane's depth per sample, from its normal: y points down on the screen.
    slopes = normals[:, :2] * (1.0, -1.0) / normals[:, 2:] / (scale * np.max(extent))
    shell = np.repeat(np.arange(len(shells)), count)[front]
    return _Scene(corners, normals, slopes, shell)


def _rows(scene: _Scene) -> tuple[Ints, Ints, Ints, Ints]:
    """List the sample rows that triangles cover: triangle, row, first x, end x.

    A sample is covered when its centre is; an edge's crossing is computed from its upper
    end by both its triangles, so that neighbours share no sample and leave none out.
    """
    corners = scene.corners
    rank = np.lexsort((corners[..., 0], corners[..., 1]), axis=-1)
    x = np.take_along_axis(corners[..., 0], rank, axis=1).T
    y = np.take_along_axis(corners[..., 1], rank, axis=1).T
    first, end = (np.ceil(y[i] - 0.5).astype(np.int64) for i in (0, 2))
    triangle, step = _expand(end - first)
    row = first[triangle] + step
    centre = row + 0.5

    def crossing(upper: int, lower: int) -> Floats:
        run, rise = x[lower] - x[upper], y[lower] - y[upper]
        slope = np.divide(run, rise, out=np.zeros_like(rise), where=rise > 0)
        at: Floats = x[upper][triangle] + (centre - y[upper][triangle]) * slope[triangle]
        return at

    long = crossing(0, 2)
    short = np.where(centre < y[1][triangle], crossing(0, 1), crossing(1, 2))
    left = np.ceil(np.minimum(long, short) - 0.5).astype(np.int64)
    right = np.ceil(np.maximum(long, short) - 0.5).astype(np.int64)
    some = right > left
    return triangle[some], row[some], left[some], right[some]


def _expand(counts: Ints) -> tuple[Ints, Ints]:
    """For ``counts[i]`` entries each: the number ``i``, and 0, 1, ... within it."""
    owner = np.repeat(np.arange(len(counts)), counts)
    return owner, np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)


def _rasterise(scene: _Scene, width: int, height: int) -> tuple[Floats, Ints]:
    """Find what each sample shows.

    Returns
    -------
    nearest
        ``(height, width) float``: depth of the nearest triangle, 0 near to 1 far.
    owner
        ``(height, width) int``: its number; -1 where there is none.
    """
    triangle, row, left, right = _rows(scene)
    start = scene.corners[triangle, 0]
    slope = scene.slopes[triangle]
    offset = np.stack([left + 0.5, row + 0.5], axis=1) - start[:, :2]
    depth = (start[:, 2] + (offset * slope).sum(axis=1)) * _DEPTH_STEPS
    step = slope[:, 0] * _DEPTH_STEPS
    place = row * width + left
    count = right - left

    buffer = np.full(width * height, _NOTHING, dtype=np.int64)
    total = np.cumsum(count)
    cuts = np.searchsorted(total, np.arange(_BATCH, total[-1] if len(total) else 0, _BATCH))
    for part in np.split(np.arange(len(count)), cuts):
        span, along = _expand(count[part])
        key = (depth[part][span] + step[part][span] * along).astype(np.int64)
        key = (key << 32) | triangle[part][span]
        np.minimum.at(buffer, place[part][span] + along, key)

    keys = buffer.reshape(height, width)
    nearest = (keys >> 32) / _DEPTH_STEPS
    return nearest, np.where(keys == _NOTHING, -1, keys & 0xFFFFFFFF)


def _shade(scene: _Scene, colours: Sequence[Colour]) -> _Bytes:
    """Colour of each triangle under the lights, ``(m, 3) uint8``."""
    light = np.full(len(scene.normals), _AMBIENT)
    for direction, strength in _LIGHTS:
        towards = np.array(direction) / np.linalg.norm(direction)
        light += strength * np.maximum(scene.normals @ towards, 0.0)
    colour = np.array(colours, dtype=float).reshape(-1, 3)[scene.shell]
    shaded: _Bytes = np.rint(np.clip(colour * light[:, None], 0, 255)).astype(np.uint8)
    return shaded


def _lines(scene: _Scene, nearest: Floats, owner: Ints) -> NDArray[np.bool_]:
    """Mark the samples on a line: both sides of every edge to be drawn."""
    marked = np.zeros(owner.shape, dtype=bool)
    for axis in (0, 1):
        here = tuple(slice(None, -1) if axis == 1 - a else slice(None) for a in (0, 1))
        there = tuple(slice(1, None) if axis == 1 - a else slice(None) for a in (0, 1))
        at = np.nonzero(owner[here] != owner[there])
        one, two = owner[here][at], owner[there][at]
        jump = np.abs(nearest[there][at] - nearest[here][at] - scene.slopes[one, axis])
        back = np.abs(nearest[here][at] - nearest[there][at] + scene.slopes[two, axis])
        line = (
            (one < 0)
            | (two < 0)
            | (scene.shell[one] != scene.shell[two])
            | ((scene.normals[one] * scene.normals[two]).sum(axis=1) < _CREASE)
            | (np.minimum(jump, back) > _STEP)
        )
        at = tuple(index[line] for index in at)
        marked[here][at] = True
        marked[there][at] = True
    return marked


def _average(image: _Bytes) -> _Bytes:
    """Average the samples of each pixel, rounding to nearest."""
    n = _OVERSAMPLE
    total = sum(image[i::n, j::n].astype(np.uint16) for i in range(n) for j in range(n))
    return ((np.asarray(total) + n * n // 2) // (n * n)).astype(np.uint8)


def _png(image: _Bytes) -> bytes:
    """Encode ``(height, width, 3) uint8`` as PNG, each row as its change from the last."""
    height, width, _ = image.shape
    flat = image.reshape(height, -1)
    rows = np.full((height, flat.shape[1] + 1), 2, dtype=np.uint8)
    rows[:, 1:] = flat
    rows[1:, 1:] -= flat[:-1]

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = zlib.compress(rows.tobytes(), 6)
    chunks = chunk(b"IHDR", header), chunk(b"IDAT", data), chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)
