"""Pictures of a motion: the parts that move in colour, the others grey.

A motion is only a start, so it is drawn larger than life: each part goes the way that it
starts on, until the farthest has gone about half its size or what stops it is there.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from scadgen.emit.preview import Colour, Shell, render
from scadgen.interlock.follow import moved, speed
from scadgen.interlock.taken import Removal
from scadgen.interlock.verdict import Motion
from scadgen.solid.affine import Floats, Ints

__all__ = ["apart_gif", "motion_gif", "motion_png"]

#: Colours of what rests, in turn, and of what moves.
_REST: tuple[Colour, ...] = ((200, 200, 196), (172, 174, 178), (222, 218, 208))
_MOVES: tuple[Colour, ...] = ((205, 92, 92), (70, 130, 180), (218, 165, 32), (46, 139, 87))

#: How far the farthest part goes, as a share of its half diagonal.
_FAR = 1.0

#: Frames of a film, there and back, and milliseconds each.
_FRAMES, _PACE = 24, 60


def motion_png(
    meshes: Sequence[tuple[Floats, Ints]],
    motion: Motion | None,
    *,
    until: float = math.inf,
    size: tuple[int, int] = (1200, 900),
) -> bytes:
    """Draw parts some way along their motion, or at rest if there is none.

    Parameters
    ----------
    meshes
        Points ``(v, 3) float`` and triangles ``(m, 3) int`` of each part.
    motion
        The motion.
    until
        Time at which it ends at the latest.
    size
        Width and height in pixels.

    Returns
    -------
    png
        The file's bytes; the same for the same input.
    """
    return render(_shells(meshes, motion, until, 1.0 if motion else 0.0), size=size)


def motion_gif(
    meshes: Sequence[tuple[Floats, Ints]],
    motion: Motion,
    *,
    until: float = math.inf,
    size: tuple[int, int] = (640, 480),
) -> bytes:
    """Film parts along their motion, there and back, for ever.

    Parameters
    ----------
    meshes
        Points ``(v, 3) float`` and triangles ``(m, 3) int`` of each part.
    motion
        The motion.
    until
        Time at which it ends at the latest.
    size
        Width and height in pixels.

    Returns
    -------
    gif
        The file's bytes; the same for the same input.
    """
    shares = (0.5 - 0.5 * math.cos(2 * math.pi * n / _FRAMES) for n in range(_FRAMES))
    return _film((_shells(meshes, motion, until, share) for share in shares), size)


def apart_gif(
    meshes: Sequence[tuple[Floats, Ints]],
    removals: Sequence[Removal],
    *,
    size: tuple[int, int] = (640, 480),
) -> bytes:
    """Film parts as they are taken apart, one after the other, for ever.

    Parameters
    ----------
    meshes
        Points ``(v, 3) float`` and triangles ``(m, 3) int`` of each part.
    removals
        What is taken out, at least one.
    size
        Width and height in pixels.

    Returns
    -------
    gif
        The file's bytes; the same for the same input.
    """
    return _film((shells for removal in removals for shells in _taken(meshes, removal)), size)


def _film(frames: Iterable[list[Shell]], size: tuple[int, int]) -> bytes:
    """A GIF of some pictures."""
    from PIL import Image  # not needed otherwise

    first, *others = (
        Image.open(io.BytesIO(render(shells, size=size))).quantize(128) for shells in frames
    )
    buffer = io.BytesIO()
    first.save(buffer, format="GIF", save_all=True, append_images=others, duration=_PACE, loop=0)
    return buffer.getvalue()


def _taken(meshes: Sequence[tuple[Floats, Ints]], removal: Removal) -> Iterator[list[Shell]]:
    """What is seen while something is taken out, in frames that hold all of its way."""
    path = removal.path
    rest = [(*meshes[n], _REST[n % len(_REST)]) for n in removal.left]
    corners = np.concatenate([meshes[n][0] for n in removal.parts])
    reach = float(np.linalg.norm(corners - path.middle, axis=1).max())
    ends = np.append(0.0, np.cumsum(path.lengths(reach)))
    gone = np.linspace(0.0, ends[-1], _FRAMES)
    poses = path.at(np.interp(gone, ends, np.arange(len(ends))))
    extent = np.concatenate([corners @ pose[:3, :3].T + pose[:3, 3] for pose in poses])
    extent = np.concatenate([extent, *(points for points, _, _ in rest)])
    for pose in poses:
        moving = [
            (meshes[n][0] @ pose[:3, :3].T + pose[:3, 3], meshes[n][1], _MOVES[k % len(_MOVES)])
            for k, n in enumerate(removal.parts)
        ]
        yield [*rest, *moving, _room(extent)]


def _shells(
    meshes: Sequence[tuple[Floats, Ints]], motion: Motion | None, until: float, share: float
) -> list[Shell]:
    """The parts a share of the way along, in a frame that holds all of the way."""
    numbers = {part: n for n, part in enumerate(motion.parts)} if motion else {}
    shells: list[Shell] = []
    extent = []
    time = min(_duration(meshes, motion), until) if motion else 0.0
    for part, (points, triangles) in enumerate(meshes):
        extent.append(points)
        if motion is None or part not in numbers:
            shells.append((points, triangles, _REST[part % len(_REST)]))
            continue
        n = numbers[part]
        step = motion.translations[n], motion.rotations[n]
        extent += [moved(points, *step, time * k / 4) for k in range(1, 5)]
        shells.append((moved(points, *step, time * share), triangles, _MOVES[n % len(_MOVES)]))
    shells.append(_room(np.concatenate(extent)))
    return shells


def _room(points: Floats) -> Shell:
    """Faces without area, which are not drawn, but for which the picture makes room."""
    return points, np.repeat(np.arange(len(points))[:, None], 3, axis=1), (0, 0, 0)


def _duration(meshes: Sequence[tuple[Floats, Ints]], motion: Motion) -> float:
    """Time at which the part that goes farthest has gone `_FAR` of its half diagonal."""
    times = []
    for n, part in enumerate(motion.parts):
        half = float(np.linalg.norm(np.ptp(meshes[part][0], axis=0))) / 2
        fastest = speed(meshes[part][0], motion.translations[n], motion.rotations[n])
        times.append(_FAR * half / fastest)
    return min(times)
