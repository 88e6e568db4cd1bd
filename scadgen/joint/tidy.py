"""Make the walls fit to draw back: no short sides, no corner of the ring in their way.

When walls draw back by a clearance, faces smaller than that turn over.  Small faces come
from two accidents of where the lattice lies: walls that pass close to a node, whose
vertices then stand close together; and walls that run along a vertical corner of the ring's
outline, or meet its end.  The first are merged; those corners are left out.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scadgen.joint.domain import OUTSIDE, Domain
from scadgen.joint.lattice import Lattice
from scadgen.joint.site import Site, nearest_site
from scadgen.joint.walls import Facet, Feature, Wedge
from scadgen.solid.affine import Floats, Ints

__all__ = ["corners_in_the_way", "merge_short_sides"]

#: Room left beside each corner of the outlines, in sides: what walls draw back at most.
_ROOM = 0.06

#: Room left at its ends, where a wall slides along the rim, at most this far, in sides.
_SLIDE = 0.12

#: A wall that stays within that room for more than this height, in sides, runs along it.
_ALONG = 0.25

#: Levels at which the ring's faces are looked at.
_LEVELS = 21

#: Sides of the walls' polygons shorter than this share of a cell are merged.
_SHORT = 0.5

#: Which vertex of a merged pair stays: the one that is less free to move.
_RANK = {"cell": 0, "face": 1, "edge": 2}


def corners_in_the_way(lattice: Lattice, curves: Sequence[Site]) -> NDArray[np.bool_]:
    """Corners of the outlines that walls would slide across when they draw back.

    Returns
    -------
    dropped
        ``(2, planes) bool``, inside and outside.
    """
    height = np.linspace(-0.5, 0.5, _LEVELS)
    dropped = []
    for side in (0, 1):
        beside, slid = (
            _labels_beside(lattice.lines(side, levels), curves, room)
            for room, levels in ((_ROOM, height), (_SLIDE, height[[0, -1]]))
        )
        passed = (beside[:, 0] != beside[:, 1]).mean(axis=1) > _ALONG
        for rim, near in ((0, height < _ROOM - 0.5), (-1, height > 0.5 - _ROOM)):
            ends = np.hstack([slid[:, :, rim], beside[:, :, near].reshape(len(beside), -1)])
            passed |= (ends != ends[:, :1]).any(axis=1)
        dropped.append(passed)
    return np.stack(dropped)


def _labels_beside(lines: Floats, curves: Sequence[Site], room: float) -> Ints:
    """Nearest curves to either side of points ``(n, heights, 3)``, ``(n, 2, heights)``."""
    plan = (lines[..., 0] + 1j * lines[..., 1])[:, None]
    plan = plan * np.exp(1j * np.array([-room, room])[:, None] / np.abs(plan))
    height = np.broadcast_to(lines[:, None, :, 2], plan.shape)
    return nearest_site(curves, np.stack([plan.real, plan.imag, height], axis=-1))


def merge_short_sides(
    walls: Sequence[Wedge], position: dict[Feature, Floats], cell: float, domain: Domain
) -> list[Wedge]:
    """Merge vertices that stand too close together, shortest sides first.

    Parameters
    ----------
    walls
        All polygons of all walls.
    position
        Where their vertices are; those that stay may be moved here.
    cell
        Length of a cell's side.
    domain
        What the walls divide, and may not leave.

    Returns
    -------
    walls
        The polygons on the vertices that are left, without those that vanished.
    """
    around: dict[Feature, set[int]] = defaultdict(set)
    for number, wedge in enumerate(walls):
        for corner in wedge.corners:
            around[corner].add(number)
    merged = list(walls)
    into: dict[Feature, Feature] = {}
    for side in _short_sides(walls, position, cell):
        ends = {_last(into, key) for key in side}
        if len(ends) < 2:
            continue
        gone, kept = sorted(ends, key=lambda key: (_RANK[key[0]], key))
        if _may_merge(merged, around, gone, kept) and not (
            domain.leans and _leaves(merged, around, position, domain, (gone, kept))
        ):
            into[gone] = kept
            if _RANK[gone[0]] == _RANK[kept[0]]:
                position[kept] = (position[gone] + position[kept]) / 2
            for number in sorted(around.pop(gone)):
                merged[number] = _renamed(merged[number], gone, kept)
                around[kept].add(number)
            _pass_on_borders(merged, around, kept)
    return [wedge for wedge in merged if len(wedge.corners) > 2]


def _last(into: dict[Feature, Feature], key: Feature) -> Feature:
    """The vertex that a vertex has been merged into, or itself."""
    while key in into:
        key = into[key]
    return key


def _short_sides(
    walls: Sequence[Wedge], position: dict[Feature, Floats], cell: float
) -> list[tuple[Feature, Feature]]:
    """Sides to merge, shortest first.

    Of two sides of the same length at one vertex neither is merged: a half turn of the joint
    swaps them, and whichever were taken, the walls would lose that symmetry.
    """
    sides = list(
        {
            (a, b) if a < b else (b, a)
            for wedge in walls
            for a, b in zip(wedge.corners, wedge.corners[1:] + wedge.corners[:1], strict=True)
        }
    )
    ends = np.array([(position[a], position[b]) for a, b in sides]).reshape(-1, 2, 3)
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).round(9)
    short = np.flatnonzero(lengths < _SHORT * cell)
    length = {sides[n]: float(lengths[n]) for n in short.tolist()}
    at_vertex = Counter((key, length[side]) for side in length for key in side)
    alone = [side for side in length if all(at_vertex[key, length[side]] == 1 for key in side)]
    return sorted(alone, key=lambda side: (length[side], side))


def _may_merge(
    walls: Sequence[Wedge], around: dict[Feature, set[int]], gone: Feature, kept: Feature
) -> bool:
    """Whether the walls stay surfaces that end on their facets if two vertices become one.

    That is so if what both touch, vertices as well as facets, they touch along what shrinks:
    a triangle with both becomes a side, a border between both a vertex.
    """
    borders = [
        {border for number in around[key] for border in walls[number].borders if key in border}
        for key in (gone, kept)
    ]
    facets = [{facet for facet, *_ in found} for found in borders]
    between = {facet for facet, *_ in borders[0] & borders[1]}
    if not facets[0] <= facets[1] or facets[0] != between:
        return False
    near = [
        {v for number in around[key] for v in _beside(walls[number].corners, key)}
        for key in (gone, kept)
    ]
    shared = around[gone] & around[kept]
    shrinking = [walls[n] for n in shared if len(walls[n].corners) == 3]
    passed_on = [b for w in shrinking for b in w.borders if not {gone, kept} <= set(b)]
    beyond: set[int] = set()
    for _, *ends in passed_on:
        (other,) = {*ends} - {kept}
        far = (around[gone] & around[other]) - shared
        beyond |= {n for n in far if other in _beside(walls[n].corners, gone)}
    if len(passed_on) > (gone[0] == "cell") or len(beyond) != len(passed_on):
        return False
    new = facets[1] - facets[0]
    staying = around[gone] - {n for n in shared if len(walls[n].corners) == 3}
    for number in staying if new else ():
        corners = {*walls[number].corners} - {gone, kept}
        touching = sum(bool(_facets(walls, around, corner) & new) for corner in corners)
        if touching > (number in shared or number in beyond):
            return False
    return kept in near[0] and near[0] & near[1] <= {v for w in shrinking for v in w.corners}


def _leaves(
    walls: Sequence[Wedge],
    around: dict[Feature, set[int]],
    position: dict[Feature, Floats],
    domain: Domain,
    ends: tuple[Feature, Feature],
) -> bool:
    """Whether a wall leaves the domain if one vertex goes into another that is on a facet."""
    gone, kept = ends
    near = {v for n in around[gone] for v in _beside(walls[n].corners, gone)} - {kept}
    on_facets = sorted(v for v in near if v[0] != "cell")
    if kept[0] == "cell" or not on_facets:
        return False
    middles = np.array([(position[v] + position[kept]) / 2 for v in on_facets])
    return bool((domain.beyond(middles) > OUTSIDE).any())


def _facets(walls: Sequence[Wedge], around: dict[Feature, set[int]], key: Feature) -> set[Facet]:
    """The facets that a vertex lies on."""
    return {b[0] for number in around[key] for b in walls[number].borders if key in b[1:]}


def _pass_on_borders(walls: list[Wedge], around: dict[Feature, set[int]], kept: Feature) -> None:
    """Give the borders of polygons that vanished to those beyond them."""
    for number in sorted(around[kept]):
        if len(walls[number].corners) > 2:
            continue
        for facet, start, stop in walls[number].borders:
            for beyond in sorted(around[start] & around[stop]):
                corners = walls[beyond].corners
                if len(corners) > 2 and start in _beside(corners, stop):
                    forward = corners[corners.index(start) - len(corners) + 1] == stop
                    border = (facet, start, stop) if forward else (facet, stop, start)
                    found = (*walls[beyond].borders, border)
                    walls[beyond] = walls[beyond]._replace(borders=found)
        for corner in walls[number].corners:
            around[corner].discard(number)


def _beside(corners: tuple[Feature, ...], key: Feature) -> tuple[Feature, Feature]:
    """The two corners next to one."""
    place = corners.index(key)
    return corners[place - 1], corners[(place + 1) % len(corners)]


def _renamed(wedge: Wedge, gone: Feature, kept: Feature) -> Wedge:
    """A polygon with one vertex put in the place of another."""
    corners = [kept if corner == gone else corner for corner in wedge.corners]
    once = tuple(c for n, c in enumerate(corners) if c != corners[n - 1])
    ends = [
        (facet, kept if a == gone else a, kept if b == gone else b) for facet, a, b in wedge.borders
    ]
    return wedge._replace(corners=once, borders=tuple(e for e in ends if e[1] != e[2]))
