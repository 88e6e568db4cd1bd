"""Pictures of a kit: its joint whole and pulled apart, its parts, its frame.

Items are turned shells that stand on one ground; they are laid out in rows on the
screen, and every role has one colour, the same as in the kit's OpenSCAD file.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TypeVar

import numpy as np

from scadgen.emit.letters import written
from scadgen.emit.preview import LARGEST, Colour, Shell, render
from scadgen.emit.scad_parameters import limits
from scadgen.errors import InputError
from scadgen.frame.placement import Placement, bill
from scadgen.kit.model import Joint, Kit
from scadgen.kit.roles import COLOURS
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Pose

__all__ = [
    "MOST_JOINTS",
    "assembly_picture",
    "frame_picture",
    "joint_picture",
    "parts_picture",
    "preview",
]

#: Where a joint is seen from: azimuth and elevation, in degrees.
_VIEW = (-90.0, 48.0)
#: Which way is right and up on the screen then.
_RIGHT = np.array([1.0, 0.0, 0.0])
_UP = np.array([0.0, math.sin(math.radians(_VIEW[1])), math.cos(math.radians(_VIEW[1]))])
#: Turn of a joint, and of a part alone, so that its edge is seen a little from its end.
_JOINT_TURN, _PART_TURN = Pose.flat((0, 0), 18.0), Pose.flat((0, 0), 14.0)
#: How far a joint is pulled apart in the preview, in sides, and the furthest it may be.
_APART, _MOST_APART = 3.5, 100.0
#: Tube that a part is shown with, in sides over the shortest; longer ones would dwarf the joints.
_SHOWN = 3.5
#: Items in one row at most, in a picture of one kind of joint; of steps of an assembly where
#: there are several; and height of a row of these, in pixels.
_MOST_IN_ROW, _MOST_STEPS, _STEPS_HEIGHT = 3, 6, 240
#: Kinds of joints and edge elements that a picture shows at most: the first of many.
MOST_JOINTS, _MOST_ELEMENTS = 16, 8
#: Room between two items, and height of their names, in sides.
_GAP, _NAME = 1.2, 1.0
#: Colour of names: nearly black.
_INK: Colour = (40, 40, 40)

_Item = list[Shell]
_T = TypeVar("_T")


def preview(kit: Kit, *, size: tuple[int, int] = (1000, 750)) -> bytes:
    """Draw what a kit is about: its joint whole and pulled apart, its edge elements.

    Parameters
    ----------
    kit
        The kit.  Tubes longer than a few sides are drawn shorter.
    size
        Width and height in pixels.

    Returns
    -------
    png
        The file's bytes; the same for the same kit.
    """
    elements = list(bill((p for p in kit.placements if p.is_element), kit.parts))
    shown = kit.joints[:MOST_JOINTS]
    joints = [
        [_named(_joint(kit, one), one.name, kit.values["side"]), _joint(kit, one, _APART)]
        for one in shown
    ]
    alone = [_alone(kit, name) for name in elements[:_MOST_ELEMENTS]]
    # Pairs are twice as wide as high, and so about as many in a row as there are rows.
    pairs = _in_rows(joints, math.ceil(math.sqrt(0.7 * len(shown))))
    rows = [list(itertools.chain(*row)) for row in pairs]
    return _draw(kit, [*rows, *_in_rows(alone, max(_MOST_IN_ROW, len(rows[0])))], size)


def joint_picture(kit: Kit, explode: float = 0.0, *, size: tuple[int, int] = (1200, 900)) -> bytes:
    """Draw one joint, or the first of each kind.

    Parameters
    ----------
    kit
        The kit.
    explode
        How far its pieces are pulled apart, in sides; 0 shows it assembled.
    size
        Width and height in pixels.

    Raises
    ------
    InputError
        `explode` is not in its range.
    """
    if not 0 <= explode <= _MOST_APART:
        msg = f"explode = {explode:g}: must be 0 to {_MOST_APART:g} sides"
        raise InputError(msg)
    side, shown = kit.values["side"], kit.joints[:MOST_JOINTS]
    joints = [_named(_joint(kit, one, explode), one.name, side) for one in shown]
    return _draw(kit, _in_rows(joints, max(_MOST_IN_ROW, math.isqrt(len(joints)))), size)


def assembly_picture(kit: Kit, *, size: tuple[int, int] = (1200, 700)) -> bytes:
    """Draw how joints are put together: each step with what comes in just outside.

    Parameters
    ----------
    kit
        The kit.
    size
        Width and height in pixels; where there are several kinds of joints, it is as high as
        their rows need.

    Raises
    ------
    InputError
        The kit was not checked, so that nothing is known of how it is put together.
    """
    if not kit.proved:
        msg = "the kit is unchecked: no way is known on which its joint is put together"
        raise InputError(msg)
    if len(kit.joints) == 1:
        return _draw(kit, _in_rows(_steps(kit, kit.joints[0]), _MOST_IN_ROW), size)
    rows = []
    for one in kit.joints[:MOST_JOINTS]:
        first, *others = _steps(kit, one)
        named = _named(first, one.name, kit.values["side"])
        rows += _in_rows([named, *others], _MOST_STEPS)
    return _draw(kit, rows, (size[0], min(_STEPS_HEIGHT * len(rows), LARGEST)))


def _steps(kit: Kit, one: Joint) -> list[_Item]:
    """A joint at each step of putting it together."""
    there = set(range(len(one.pieces)))
    steps = []
    for way in one.ways:
        out = way.path.scaled(kit.values["side"]).poses[-1]
        steps.append(_joint(kit, one, 0.0, dict.fromkeys(way.moving, out), there))
        there -= {*way.moving}
    return steps[::-1]


def _in_rows(items: Sequence[_T], most: int) -> list[Sequence[_T]]:
    """Items in as few rows as need be, all of them about as long."""
    rows = math.ceil(len(items) / most)
    count = math.ceil(len(items) / max(rows, 1))
    return [items[n : n + count] for n in range(0, len(items), max(count, 1))]


def parts_picture(kit: Kit, *, size: tuple[int, int] = (1200, 900)) -> bytes:
    """Draw one of each part that the frame needs, edge elements first.

    Parameters
    ----------
    kit
        The kit.  Tubes longer than a few sides are drawn shorter.
    size
        Width and height in pixels.
    """
    needed = bill(kit.placements, kit.parts)
    elements = [name for name in needed if kit.parts[name].is_element]
    pieces = [name for name in needed if name not in elements]
    return _draw(kit, [[_alone(kit, n) for n in row] for row in (elements, pieces)], size)


def frame_picture(kit: Kit, *, size: tuple[int, int] = (1200, 900)) -> bytes:
    """Draw the whole frame.

    Parameters
    ----------
    kit
        The kit.
    size
        Width and height in pixels.
    """
    shells = _placed(kit, kit.placements, kit.values, 0.0)
    return render(shells, size=size, view=(-70.0, 52.0))


def _roles(kit: Kit) -> dict[str, str]:
    """The role in which each part is shown alone."""
    placed = [*(p for one in kit.joints for p in one.pieces), *kit.placements]
    roles = dict.fromkeys(kit.parts, "row")
    roles |= {name: "cap" for one in kit.joints for name in one.connectors}
    return roles | {p.part: p.role for p in reversed(placed)}


def _joint(
    kit: Kit,
    one: Joint,
    explode: float = 0.0,
    moved: Mapping[int, Floats] = MappingProxyType({}),
    there: Collection[int] | None = None,
) -> _Item:
    """The pieces of a joint; its connectors, which have one role, in turn lighter.

    Some may be moved, each by a pose; and some may not be there.
    """
    shells = _placed(kit, one.pieces, kit.values, explode)
    seen = 0
    step = min(0.3, 0.75 / max(1, sum(p.role == "cap" for p in one.pieces) - 1))
    for n, placement in enumerate(one.pieces):
        points, triangles, colour = shells[n]
        if n in moved:
            points = points @ moved[n][:3, :3].T + moved[n][:3, 3]
        if placement.role == "cap":
            colour = _lighter(colour, step * seen)
            seen += 1
        shells[n] = _JOINT_TURN.apply(points), triangles, colour
    return [shell for n, shell in enumerate(shells) if there is None or n in there]


def _named(item: _Item, name: str, side: float) -> _Item:
    """An item with its name above it on the left, if it has one."""
    if not name:
        return item
    (left, _), (_, top) = _box(item)
    points, triangles = written(name, _RIGHT, _UP)
    place = left * _RIGHT + (top + 0.3 * _NAME * side) * _UP
    return [*item, (_NAME * side * points + place, triangles, _INK)]


def _lighter(colour: Colour, share: float) -> Colour:
    red, green, blue = (round(c + share * (255 - c)) for c in colour)
    return red, green, blue


def _alone(kit: Kit, name: str) -> _Item:
    """One part, with a tube no longer than a few sides."""
    shortest, _ = limits(kit, "edge_length", kit.values)
    shown = min(kit.values["edge_length"], shortest + _SHOWN * kit.values["side"])
    placement = Placement(name, _roles(kit)[name], _PART_TURN, ())
    return _placed(kit, [placement], {**kit.values, "edge_length": shown}, 0.0)


def _placed(
    kit: Kit, placements: Iterable[Placement], values: Mapping[str, float], explode: float
) -> _Item:
    """Shells of placements, each in its place; all pulled apart by `explode` sides."""
    placements = tuple(placements)
    points = {name: kit.parts[name].points(values) for name in {p.part for p in placements}}
    shells = []
    for p in placements:
        own = points[p.part]
        if explode:
            own = own + explode * values["side"] * _way(p, own)
        turned = p.pose.scaled(values["edge_length"]).apply(own)
        shells.append((turned, kit.parts[p.part].triangles, COLOURS[p.role]))
    return shells


def _way(placement: Placement, points: Floats) -> Floats:
    """Where a piece goes when a joint is pulled apart, before it is turned, in its explosion."""
    if placement.role in ("half_a", "half_b"):
        return np.array([0.5, 0.5 * math.copysign(1.0, points[:, 1].mean()), 0.0])
    return np.array([1.0, 0.0, 0.0])


def _draw(kit: Kit, rows: Sequence[Sequence[_Item]], size: tuple[int, int]) -> bytes:
    """Draw rows of items, the first at the top, each row centred."""
    gap = _GAP * kit.values["side"]
    shells: list[Shell] = []
    top = 0.0
    for row in rows:
        boxes = [_box(item) for item in row]
        widths, heights = np.array([high - low for low, high in boxes]).T
        left = -(widths.sum() + gap * (len(row) - 1)) / 2
        for item, (low, _), width, height in zip(row, boxes, widths, heights, strict=True):
            up = top - (heights.max() + height) / 2 - low[1]
            move = np.array([left - low[0], up / _UP[1], 0.0])
            shells += [(points + move, triangles, colour) for points, triangles, colour in item]
            left += width + gap
        top -= heights.max() + gap
    return render(shells, size=size, view=_VIEW)


def _box(item: _Item) -> tuple[Floats, Floats]:
    """Lower left and upper right corner of an item on the screen."""
    flat = np.concatenate([points @ np.column_stack([_RIGHT, _UP]) for points, _, _ in item])
    return flat.min(axis=0), flat.max(axis=0)
