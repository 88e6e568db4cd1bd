"""Proofs that a box belongs to one connector alone.

The distance from a curve changes by no more than the distance moved, so the difference of
two changes by at most twice that.  A box whose middle is nearer to its own curve, by more
than twice the box's half diagonal, than to any other is therefore all of one label; other
boxes are halved until that is so, or one is found that is not.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scadgen.joint.lattice import Lattice
from scadgen.joint.site import Site, distances, nearest_site
from scadgen.solid.affine import Floats

__all__ = ["arm", "belongs", "share"]

#: Halvings of a box before it counts as foreign; its half diagonal is then below 1e-3 sides.
_HALVINGS = 10

#: What angles may be off by rounding, in radians.
_ROUNDING = 1e-9


def belongs(
    curves: Sequence[Site],
    own: int,
    low: Floats,
    high: Floats,
    margin: float,
    axes: Floats | None = None,
) -> bool:
    """Whether every point of a box is in one cell, and a margin away from its walls.

    Parameters
    ----------
    curves
        The joint's site curves.
    own
        The cell's curve.
    low, high
        Corners of the box, ``(3,) float``, along its axes; it may be flat.
    margin
        Distance to the walls, in sides, at least zero.
    axes
        ``(3, 3) float``: rows are the directions of the box's sides; by default the curve's edge,
        what is counter-clockwise of it, and up.
    """
    middle, extent = ((low + high) / 2)[None], (high - low) / 2
    turn = curves[own].turn if axes is None else axes
    for _ in range(_HALVINGS):
        needed = 2 * (margin + float(np.linalg.norm(extent)))
        lead = _lead(curves, own, middle @ turn, needed)
        if (lead <= 2 * margin).any():
            return False
        middle = middle[lead <= needed]
        if not len(middle):
            return True
        signs = np.array(np.meshgrid(*([-0.5, 0.5] if e > 0 else [0.0] for e in extent)))
        middle = (middle[:, None] + extent * signs.reshape(3, -1).T).reshape(-1, 3)
        extent = extent / 2
    return False


def share(curves: Sequence[Site], own: int, points: Floats) -> float:
    """Share of points that are in a curve's cell."""
    return float((nearest_site(curves, points) == own).mean())


def _lead(curves: Sequence[Site], own: int, points: Floats, most: float) -> Floats:
    """How much nearer points are to their own curve than to any other, exact up to the most."""
    far = distances(curves, points, most)
    return np.asarray(np.delete(far, own, axis=0).min(axis=0) - far[own])


def arm(lattice: Lattice, curves: Sequence[Site], edge: int, walls: Floats) -> float:
    """Thinnest place of a connector's arms between its edge and its walls.

    At each plane of the lattice, the widest ball that is known to fit into the arm there: its
    radius is at least the distance to the ring's faces, and at least half the lead of the
    connector's curve.  Beyond a wall's middle an arm thins out to its tip by design.

    Parameters
    ----------
    lattice, curves
        The joint's.
    edge
        Number of the connector's edge.
    walls
        ``(k,) float``: angle from each edge to the wall after it.

    Returns
    -------
    thickness
        In sides.
    """
    directions = lattice.domain.spokes.azimuths
    gap = (directions[edge] - directions[edge - 1] - _ROUNDING) % (2 * np.pi) + _ROUNDING
    ahead = (lattice.planes - directions[edge]) % (2 * np.pi)
    behind = (directions[edge] - lattice.planes) % (2 * np.pi)
    near = (ahead <= walls[edge] + _ROUNDING) | (behind <= gap - walls[edge - 1] + _ROUNDING)
    # At the faces themselves there is no room for any ball.
    nodes = lattice.nodes[near, 1:-1, 1:-1]
    share = np.linspace(0, 1, lattice.nodes.shape[1])[1:-1]
    face = np.minimum.outer(np.minimum(share, 1 - share), np.minimum(share, 1 - share))
    ball = np.minimum(
        _lead(curves, edge, nodes.reshape(-1, 3), 1.0).reshape(nodes.shape[:3]) / 2, face
    )
    return float(2 * ball.max(axis=(1, 2)).min())
