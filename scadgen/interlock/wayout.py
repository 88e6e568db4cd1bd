"""Ways out of one body that need no search: straight, or along a screw."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scadgen.interlock.contacts import Mesh
from scadgen.interlock.follow import middle, screw, speed
from scadgen.interlock.path import Path
from scadgen.interlock.scene import Scene, Stance
from scadgen.interlock.verdict import Motion
from scadgen.solid.affine import Floats

__all__ = ["followed", "screwed", "straight", "united_mesh"]

#: Straight ways that are tried at most, the shortest; the length of a step on them in sizes,
#: and how many of them go by until one that is shut mostly shows it.
_TRIED, _STRIDE, _FIRST = 24, 0.01, 2

#: Places that are looked at along a motion.
_PLACES = 90

#: Turns of a screw at most, the least pitch in sizes, and the length of a step.
_TURNS, _PITCH, _STEP = 40, 5e-3, 0.02


def straight(scene: Scene, directions: Floats) -> Path | None:
    """The shortest straight way out.

    Parameters
    ----------
    scene
        The body among the others.
    directions
        ``(k, 3) float``: unit vectors that are tried.
    """
    start = Stance(np.eye(3), scene.middle)
    ways = np.maximum(scene.ways(directions) + scene.step, 0.0)
    stride = max(scene.step, _STRIDE * scene.size)
    for which in np.argsort(ways, kind="stable")[:_TRIED]:
        near, end = (
            Stance(start.turn, start.centre + length * directions[which])
            for length in (min(ways[which], _FIRST * stride), ways[which])
        )
        if scene.free(near):
            path = scene.path([start, end])
            if scene.leads_out(path, stride):
                return path
    return None


def screwed(scene: Scene, mesh: Mesh, motion: Motion) -> Path | None:
    """The way out along a motion that turns, gone on with round its axis and along it.

    Parameters
    ----------
    scene
        The body among the others.
    mesh
        The body's mesh.
    motion
        Its motion, the only one in it.

    Returns
    -------
    path
        None where the motion is not along its axis, or something is in the way.
    """
    shift, turn = motion.translations[0], motion.rotations[0]
    spin = float(np.linalg.norm(turn))
    if not spin:
        return None
    pitch = float(shift @ turn) / spin**2
    if abs(pitch) * 2 * np.pi < _PITCH * scene.size:
        return None
    axis = np.sign(pitch) * turn / spin
    through = middle(mesh[0]) + np.cross(turn, shift) / spin**2
    whole = (float(scene.ways(axis[None])[0]) + scene.step) / abs(pitch)
    if not 0 < whole <= 2 * np.pi * _TURNS:
        return None
    angle = np.linspace(0.0, whole, 2 + int(whole // (np.pi / 2)))[:, None]
    steps = np.hstack([abs(pitch) * angle * axis, np.sign(pitch) * angle * axis])
    path = Path.through(steps, through)
    return path if scene.leads_out(path, _STEP * scene.size) else None


def followed(scene: Scene, mesh: Mesh, motion: Motion) -> tuple[float, float]:
    """How far a body can follow a motion, as it begins.

    Parameters
    ----------
    scene
        The body among the others.
    mesh
        The body's mesh.
    motion
        Its motion, the only one in it.

    Returns
    -------
    shift, turn
        Of the middle of its box, in mm, and in radians; once round at most, or the size of all.
    """
    shift, turn = motion.translations[0], motion.rotations[0]
    size = float(np.linalg.norm(np.ptp(np.concatenate([scene.body[0], scene.rest[0]]), axis=0)))
    fastest = speed(mesh[0], shift, turn)
    end = size / fastest if not turn.any() else 2 * np.pi / float(np.linalg.norm(turn))
    gone = 0.0
    for time in np.linspace(0.0, end, _PLACES + 1)[1:].tolist():
        if not scene.clear_at(screw(middle(mesh[0]), shift, turn, time)):
            break
        gone = time
    return gone * float(np.linalg.norm(shift)), gone * float(np.linalg.norm(turn))


def united_mesh(meshes: Sequence[Mesh]) -> Mesh:
    """Meshes as one, nothing merged."""
    start = np.cumsum([0, *(len(points) for points, _ in meshes[:-1])])
    numbered = [t + n for (_, t), n in zip(meshes, start, strict=True)]
    return np.concatenate([p for p, _ in meshes]), np.concatenate(numbered)
