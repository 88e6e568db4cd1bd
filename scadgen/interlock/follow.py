"""Parts along their motion, beyond its start: where they are, and what they touch first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from scadgen.interlock.contacts import Mesh
from scadgen.interlock.path import united
from scadgen.interlock.verdict import Motion
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from manifold3d import Manifold

__all__ = ["first_touch", "middle", "moved", "screw", "speed"]

#: Places that are looked at on the way, and halvings of the step in which parts touch.
_PLACES, _HALVINGS = 64, 12

#: Volume that parts share more than at rest, as a share of the smaller one's, that is a touch.
_TOUCH = 1e-4


def middle(points: Floats) -> Floats:
    """Middle of a part's box: the point whose velocity is a motion's translation."""
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)


def screw(about: Floats, translation: Floats, rotation: Floats, time: float) -> Floats:
    """Pose of a part on the screw that its velocities begin.

    Parameters
    ----------
    about
        ``(3,) float``: the point that has the velocity.
    translation, rotation
        ``(3,) float`` each: velocity, and radians per unit of time.
    time
        How long.

    Returns
    -------
    pose
        ``(3, 4) float``: a turn and where the origin goes.
    """
    turn = Rotation.from_rotvec(rotation * time).as_matrix()
    shift = translation * time
    if angle := float(np.linalg.norm(rotation)) * time:
        axis = rotation / np.linalg.norm(rotation)
        along = axis * (axis @ shift)
        bow = (shift - along) * np.sin(angle) + np.cross(axis, shift) * (1 - np.cos(angle))
        shift = along + bow / angle
    return np.column_stack([turn, about + shift - turn @ about])


def moved(points: Floats, translation: Floats, rotation: Floats, time: float) -> Floats:
    """Points of a part after a screw motion.

    Parameters
    ----------
    points
        ``(v, 3) float``.
    translation, rotation
        ``(3,) float`` each: velocity of the middle of its box, and radians per unit of time.
    time
        How long.
    """
    pose = screw(middle(points), translation, rotation, time)
    return np.asarray(points @ pose[:, :3].T + pose[:, 3])


def speed(points: Floats, translation: Floats, rotation: Floats) -> float:
    """How fast a part's fastest point is at most."""
    half = np.linalg.norm(np.ptp(points, axis=0)) / 2
    return float(np.linalg.norm(translation) + np.linalg.norm(rotation) * half)


def first_touch(meshes: Sequence[Mesh], motion: Motion) -> tuple[float, int | None]:
    """How long parts can go on as they begin, and what they touch then.

    Parameters
    ----------
    meshes
        The parts, closed and oriented.
    motion
        How they begin.

    Returns
    -------
    time
        When they touch.  If they touch nothing: when they have gone the length of all parts, or
        once round.
    part
        Number of what a part that moves touches, None if nothing.

    Raises
    ------
    InvariantError
        If one of the meshes is not a solid.
    """
    numbers = {part: n for n, part in enumerate(motion.parts)}
    steps = [(motion.translations[n], motion.rotations[n]) for n in range(len(numbers))]
    corners = np.concatenate([points for points, _ in meshes])
    fastest = max(speed(meshes[part][0], *steps[n]) for part, n in numbers.items())
    end = float(np.linalg.norm(np.ptp(corners, axis=0))) / fastest
    if spin := max(float(np.linalg.norm(turn)) for _, turn in steps):
        end = min(end, 2 * np.pi / spin)
    solids = [united([mesh]) for mesh in meshes]

    def placed(time: float) -> list[Manifold]:
        return [
            solid.transform(screw(middle(meshes[n][0]), *steps[numbers[n]], time))
            if n in numbers
            else solid
            for n, solid in enumerate(solids)
        ]

    rest = _shared(solids, motion.parts)

    def touched(time: float) -> int | None:
        for (part, other), volume in _shared(placed(time), motion.parts).items():
            least = min(solids[part].volume(), solids[other].volume())
            if volume - rest.get((part, other), 0.0) > _TOUCH * least:
                return other
        return None

    return _first(touched, end)


def _first(touched: Callable[[float], int | None], end: float) -> tuple[float, int | None]:
    """The last time before a touch, and with what."""
    before = 0.0
    for after in np.linspace(0.0, end, _PLACES + 1)[1:].tolist():
        if (part := touched(after)) is not None:
            break
        before = after
    else:
        return end, None
    for _ in range(_HALVINGS):
        half = (before + after) / 2
        if (nearer := touched(half)) is None:
            before = half
        else:
            after, part = half, nearer
    return before, part


def _shared(solids: Sequence[Manifold], moving: Sequence[int]) -> dict[tuple[int, int], float]:
    """Volume that each part that moves shares with others near it."""
    boxes = np.array([solid.bounding_box() for solid in solids])
    found = {}
    for part in moving:
        near = (boxes[:, :3] <= boxes[part, 3:]).all(axis=1)
        near &= (boxes[:, 3:] >= boxes[part, :3]).all(axis=1)
        for other in np.flatnonzero(near).tolist():
            if other != part and (other, part) not in found:
                found[part, other] = float((solids[part] ^ solids[other]).volume())
    return found
