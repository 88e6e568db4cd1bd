"""Proof that some parts get out past others: pair by pair, each pair that is alike but once.

A set of parts touches none of another on its way if no part of the one touches one of the
other.  So the way is proved for each part that moves and each that it may come near, where
they stand to each other; in a regular frame there are few such pairs.  Each is proved by
conservative advancement, as in `interlock.path.narrowest`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import shapely

from scadgen.check.disassembly import LEAST, LOOK
from scadgen.frame.placement import Placement
from scadgen.interlock.contacts import Mesh
from scadgen.interlock.path import Path
from scadgen.kit.ways import WAY_DECIMALS
from scadgen.plan.standing import Standing
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.gap import solid as manifold_of
from scadgen.solid.pose import Pose

if TYPE_CHECKING:
    from manifold3d import Manifold

__all__ = ["Found", "Prover"]

#: Gaps beyond this are not looked for, in sides.
_FAR = 2.0

#: Poses of a proof after which some ahead are looked at, and how many: a narrow way takes many.
_LONG, _AHEAD = 60, 24

#: Decimals, in mm and degrees, to which places are compared; a thousandth of the least gaps.
_DECIMALS = 6

#: Step with which a way's reach is measured, in sides.
_STEP = 0.5

#: How far above all others a part that is lifted ends, in sides.
_ABOVE = 0.1


@dataclass(frozen=True, slots=True)
class Found:
    """What was found of a move.

    Parameters
    ----------
    way
        Number of the way that was proved, or looked at.
    gap
        Smallest gap on it, in mm, 0 if it is not proved.
    blocking
        The part that is in the way; None if it is proved.
    """

    way: int
    gap: float
    blocking: int | None


class Prover:
    """Proves ways, and remembers what it has proved.

    Parameters
    ----------
    standing
        The frame.
    """

    def __init__(self, standing: Standing) -> None:
        self.ways: list[Path] = []
        self.known: dict[tuple[object, ...], float] = {}
        self._standing = standing
        kit = standing.kit
        self._side, self._unit = kit.values["side"], kit.values["edge_length"]
        self._least = LEAST * kit.values["clearance"]
        self._look = LOOK * kit.values["clearance"]
        self._bodies: dict[str, _Body] = {}
        self._numbers: dict[bytes, int] = {}
        self._asides: dict[tuple[object, ...], float] = {}

    @cached_property
    def _outlines(self) -> list[shapely.Geometry]:
        """Middle line of each part in the plane, in mm."""
        found: list[shapely.Geometry] = []
        for number, place in enumerate(self._standing.kit.placements):
            start = self._unit * np.array(place.pose.at)[:2]
            if number in self._standing.elements:
                ahead = self._standing.length(number) * np.array(place.pose.x)[:2]
                found.append(shapely.LineString([start, start + self._unit * ahead]))
            else:
                found.append(shapely.Point(start))
        return found

    @cached_property
    def _widths(self) -> Floats:
        """How far each part reaches from its middle line, in mm."""
        widths = {}
        for number, place in enumerate(self._standing.kit.placements):
            if place.part not in widths:
                points = self._body(place).points
                along = points[:, 0].copy()
                if number in self._standing.elements:
                    length = self._unit * self._standing.length(number)
                    along = along - np.clip(along, 0.0, length)
                widths[place.part] = float(np.hypot(along, points[:, 1]).max())
        return np.array([widths[place.part] for place in self._standing.kit.placements])

    def number(self, path: Path) -> int:
        """The number of a way, the same for the same one: as it is written, which is proved."""
        written = np.vstack([path.steps(), [*path.middle, 0.0, 0.0, 0.0]]).round(WAY_DECIMALS) + 0.0
        key = written.tobytes()
        if key not in self._numbers:
            self._numbers[key] = len(self.ways)
            self.ways.append(Path.through(written[:-1], written[-1, :3]))
        return self._numbers[key]

    def mesh(self, part: int, origin: Pose) -> Mesh:
        """A part's mesh where it stands as a way sees it, in mm."""
        place = self._standing.kit.placements[part]
        points = self._pose(place, origin).apply(self._body(place).points)
        return points, self._standing.kit.parts[place.part].triangles

    def place(self, part: int, origin: Pose) -> tuple[object, ...]:
        """What a part is and where it stands as a way sees it: the same for what is alike."""
        place = self._standing.kit.placements[part]
        pose = self._pose(place, origin)
        return place.part, pose.at, pose.x, pose.z

    def lifted(self, path: Path, moving: Sequence[int], origin: Pose, up: float) -> Path:
        """A way, and then straight up, or down, out of the plane of the frame."""
        last = path.poses[-1]
        low = math.inf
        for part in moving:
            points = self._points(part, origin) @ last[:3, :3].T + last[:3, 3]
            low = min(low, float((up * points[:, 2]).min()))
        ends = self._side * (0.5 + _ABOVE)
        if low >= ends:
            return path
        # By whole sides, so that ways of parts that differ little are the same.
        rise = self._side * math.ceil((ends - low) / self._side)
        end = last.copy()
        end[2, 3] += up * rise
        return Path(np.concatenate([path.poses, end[None]]), path.middle)

    def proved(
        self,
        path: Path,
        moving: Sequence[int],
        rest: Iterable[int],
        origin: Pose,
    ) -> Found:
        """Whether some parts get out on a way, past the rest.

        Parameters
        ----------
        path
            The way, in mm; at its end they are clear of all.
        moving
            Numbers of the parts that move as one.
        rest
            Numbers of all that is there.
        origin
            Where the way's coordinates are in the frame.
        """
        way = self.number(path)
        worst = math.inf
        others = np.array(sorted(set(rest) - set(moving)), dtype=np.int64)
        for part in moving:
            for other in self._near(way, part, others, origin):
                gap = self._gap(way, part, other, origin)
                if not gap > 0:
                    return Found(way, 0.0, other)
                worst = min(worst, gap)
        return Found(way, worst, None)

    def _near(self, way: int, part: int, others: Ints, origin: Pose) -> list[int]:
        """Those of some parts that a part may come near on a way."""
        aside = self._aside(way, part, origin)
        outlines = np.array(self._outlines, dtype=object)[others]
        away = shapely.distance(outlines, self._outlines[part])
        limit = aside + self._widths[part] + self._widths[others]
        return [int(n) for n in others[away < limit]]

    def _aside(self, way: int, part: int, origin: Pose) -> float:
        """How far a part goes aside on a way at most, in mm: not up, which brings nothing near."""
        key = way, *self.place(part, origin)
        if key not in self._asides:
            path, points = self.ways[way], self._points(part, origin)
            reach = float(np.linalg.norm(points - path.middle, axis=1).max())
            step = _STEP * self._side
            poses = path.dense(reach, step)
            moved = np.einsum("kij,pj->kpi", poses[:, :2, :3], points) + poses[:, None, :2, 3]
            far = float(np.linalg.norm(moved - points[None, :, :2], axis=2).max())
            self._asides[key] = far + step  # between two poses it may go on, but no farther
        return self._asides[key]

    def _points(self, part: int, origin: Pose) -> Floats:
        """Corners of a part's hull in the way's coordinates, in mm."""
        place = self._standing.kit.placements[part]
        return self._pose(place, origin).apply(self._body(place).hull)

    def _body(self, place: Placement) -> _Body:
        """A part at its own origin."""
        if place.part not in self._bodies:
            kit = self._standing.kit
            solid = kit.parts[place.part]
            self._bodies[place.part] = _Body((solid.points(kit.values), solid.triangles))
        return self._bodies[place.part]

    def _pose(self, place: Placement, origin: Pose) -> Pose:
        """Where a part is as a way sees it, in mm, rounded so that what is alike is the same."""
        return (origin.inverse() @ place.pose).scaled(self._unit).rounded(_DECIMALS)

    def _gap(self, way: int, part: int, other: int, origin: Pose) -> float:
        """Smallest gap of two parts while one moves, 0 if it is not proved."""
        key = way, self.place(part, origin), self.place(other, origin)
        if key not in self.known:
            mover, stays = (self._standing.kit.placements[n] for n in (part, other))
            bodies = self._body(mover), self._body(stays)
            places = self._pose(mover, origin).matrix, self._pose(stays, origin).matrix
            self.known[key] = self._narrowest(self.ways[way], bodies, places)
        return self.known[key]

    def _narrowest(
        self, path: Path, bodies: tuple[_Body, _Body], places: tuple[Floats, Floats]
    ) -> float:
        """Smallest gap on a way, by conservative advancement; as seen from what stays."""
        mover, stays = bodies
        back = np.linalg.inv(places[1])
        hull = mover.hull @ places[0][:3, :3].T + places[0][:3, 3]
        reach = float(np.linalg.norm(hull - path.middle, axis=1).max())
        ends = np.concatenate([[0.0], np.cumsum(path.lengths(reach))])
        times, at = np.arange(len(ends)), path.between()

        def gap_at(gone: float, look: float) -> float:
            pose = back @ at(np.array([np.interp(gone, ends, times)]))[0] @ places[0]
            return _gap_of(mover, stays, pose, look)

        gone, worst, look = 0.0, math.inf, self._look
        for tries in itertools.count(1):
            gap = gap_at(gone, look)
            worst = min(worst, gap)
            if gap < self._least or not self._least > 0:
                return 0.0
            if gone >= ends[-1]:
                break
            if tries == _LONG:  # one that is shut farther on is told sooner so
                ahead = np.linspace(gone, ends[-1], _AHEAD)
                if any(gap_at(place, self._least) < self._least for place in ahead):
                    return 0.0
            look = min(2 * look, _FAR * self._side) if gap >= look else 1.1 * gap
            gone = min(gone + gap, float(ends[-1]))
        return worst


def _gap_of(mover: _Body, stays: _Body, pose: Floats, look: float) -> float:
    """Gap of two bodies, one of them at a pose; where their boxes are farther apart, of those."""
    points = mover.hull @ pose[:3, :3].T + pose[:3, 3]
    apart = np.maximum(stays.low - points.max(axis=0), points.min(axis=0) - stays.high)
    gap = float(np.linalg.norm(np.maximum(apart, 0.0)))
    if gap >= look:
        return gap
    return float(mover.manifold.transform(pose[:3]).min_gap(stays.manifold, look))


class _Body:
    """A part as manifold3d takes it, at its origin."""

    def __init__(self, mesh: Mesh) -> None:
        self.points = mesh[0]
        self.manifold: Manifold = manifold_of(*mesh)
        self.hull: Floats = np.asarray(self.manifold.hull().to_mesh64().vert_properties[:, :3])
        self.low, self.high = self.points.min(axis=0), self.points.max(axis=0)
