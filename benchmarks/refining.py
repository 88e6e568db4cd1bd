"""How a joint's time, triangles, walls and volume change as it is resolved more finely."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

import numpy as np
from report import heading, line, progress
from scipy.spatial import cKDTree
from trimesh.triangles import closest_point

from scadgen.element.ends import connector
from scadgen.element.pieces import Piece
from scadgen.element.squares import Key
from scadgen.errors import GeometryError
from scadgen.joint.joint import DETAILS, Decomposition, Detail, make_joint, site_curves
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import built_in
from scadgen.solid.affine import AffineSolid, Floats
from scadgen.solid.mesh import volume

__all__ = ["accuracy", "growth"]

#: Samples a curve, and those from which fixed costs no longer matter.
_SAMPLES = (30, 60, 120, 240, 400, 600)
_LARGE = 240

#: Aim: how fast time and triangles may grow with the samples; walls are surfaces.
_EXPONENT = 2.0

#: Stated tolerance of the walls at `standard`, in sides.
_TOLERANCE = 0.002

#: Samples of the curves that distances are measured from; these are exact, whatever it is.
_EXACT = 1200

#: Points looked at in each triangle of a wall, by their weights of its corners.
_WEIGHTS = np.array(
    [(i, j, 6 - i - j) for i in range(7) for j in range(7 - i)], dtype=float
) / 6  # fmt: skip

#: Triangles of the finer wall, the nearest by their middles, that a point is compared with.
_NEAREST = 12


def _made(frame: str, detail: Detail) -> Decomposition:
    """A joint with the frame's built-in weave, on the first lattice that takes it."""
    count = {"hexagonal": 3, "square": 4}[frame]
    edges = [2 * math.pi * n / count for n in range(count)]
    for extra in (0, 2, 4):
        try:
            return make_joint(Spokes.flat(edges), built_in(count, "fixed"), detail, extra)
        except GeometryError:
            if extra == 4:
                raise
    raise AssertionError


def _solid(joint: Decomposition) -> AffineSolid:
    """A joint's connector as a closed solid, without clearance."""
    domain, surface = joint.lattice.domain, joint.connectors[0]
    start, (pad, _) = float(domain.flats.distance[0]), domain.pad(0)
    key = Key("fixed", bored=False, tube_start=start, pad=pad, window=0.3, depth=0.5)
    return connector(key, Piece(surface, np.zeros_like(surface.points), 0.0))


def _exponent(x: Sequence[float], y: Sequence[float]) -> float:
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def growth(frame: str) -> None:
    """Report time and triangles against samples."""
    heading(f"One {frame} joint against samples a curve (cells across the side: a 13.5th)")
    rows: list[tuple[int, float, int]] = []
    for samples in _SAMPLES:
        cells = 2 * round((samples / 13.5 - 1) / 2) + 1
        progress(f"{frame} joint of {samples} samples, {cells} cells")
        start = time.process_time()
        made = _made(frame, Detail(samples, cells))
        seconds = time.process_time() - start
        rows.append((samples, seconds, len(_solid(made).triangles)))
        line(f"{samples} samples, {cells} cells", f"{seconds:.2f} s CPU, {rows[-1][2]} triangles")
    for what, column in (("time", 1), ("triangles", 2)):
        for first in (_SAMPLES[0], _LARGE):
            some = [row for row in rows if row[0] >= first]
            power = _exponent([row[0] for row in some], [row[column] for row in some])
            line(
                f"{what} from {first} on grow{'s' * (what == 'time')} as samples to the",
                f"{power:.2f}",
                f"at most {_EXPONENT:g}",
                met=power <= _EXPONENT,
            )


def accuracy(frame: str) -> None:
    """Report how far walls and volume are from exact ones and from those of twice the detail."""
    heading(f"Walls of a {frame} connector, in sides: largest distance")
    progress(f"walls of a {frame} connector at {', '.join(DETAILS)} and twice the detail")
    for name, detail in DETAILS.items():
        coarse = _made(frame, detail)
        fine = _made(frame, Detail(2 * detail.samples, 2 * detail.cells - 1))
        points = _on_walls(coarse)
        exact, moved = _to_bisector(coarse, points), _to_mesh(fine, points)
        held = name == "standard"
        for what, far in (("the exact wall", exact), ("twice the detail", moved)):
            line(
                f"{name}, to {what}",
                f"{far.max():.5f}, root mean square {math.sqrt((far**2).mean()):.5f}",
                f"at most {_TOLERANCE} at standard" if held else "",
                met=bool(far.max() <= _TOLERANCE) if held else None,
            )
        small, large = (_volume(joint) for joint in (coarse, fine))
        line(f"{name}, volume moves by", f"{abs(small / large - 1):.1e} of itself")


def _on_walls(joint: Decomposition) -> Floats:
    surface = joint.connectors[0]
    return np.einsum("wc,mcx->mwx", _WEIGHTS, surface.points[surface.walls]).reshape(-1, 3)


def _to_bisector(joint: Decomposition, points: Floats) -> Floats:
    """Distance from the exact wall, to first order: lead over its slope."""
    curves = site_curves(joint.spokes, joint.weave, _EXACT)
    found = [curve.distance(points) for curve in curves]
    far, slope = np.stack([d for d, _ in found]), np.stack([g for _, g in found])
    other, row = 1 + far[1:].argmin(axis=0), np.arange(len(points))
    lead = np.abs(far[other, row] - far[0])
    return np.asarray(lead / np.linalg.norm(slope[other, row] - slope[0], axis=1))


def _to_mesh(joint: Decomposition, points: Floats) -> Floats:
    """Distance from the walls of another joint."""
    surface = joint.connectors[0]
    corners = surface.points[surface.walls]
    _, near = cKDTree(corners.mean(axis=1)).query(points, k=_NEAREST)
    best = np.full(len(points), np.inf)
    for column in near.T:
        closest = closest_point(corners[column], points)
        best = np.minimum(best, np.linalg.norm(closest - points, axis=1))
    return best


def _volume(joint: Decomposition) -> float:
    solid = _solid(joint)
    return volume(solid.points({"side": 1.0, "clearance": 0.0}), solid.triangles)
