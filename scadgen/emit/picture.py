"""Pictures of a kit: its joint whole and pulled apart, its parts, its frame.

Items are turned shells that stand on one ground; they are laid out in rows on the
screen, and every role has one colour, the same as in the kit's OpenSCAD file.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from scadgen.emit.preview import Colour, Shell, render
from scadgen.emit.scad_parameters import limits
from scadgen.errors import InputError
from scadgen.frame.layout import LAYOUTS, bill
from scadgen.frame.placement import Placement
from scadgen.kit.model import Kit
from scadgen.solid.affine import Floats

__all__ = [
    "COLOURS",
    "assembly_picture",
    "frame_picture",
    "joint_picture",
    "parts_picture",
    "preview",
]

#: The colour of each role: steel blue, goldenrod, Indian red, dark salmon, slate, sea green.
COLOURS: Mapping[str, Colour] = MappingProxyType(
    {
        "row": (70, 130, 180),
        "cross": (218, 165, 32),
        "half_a": (205, 92, 92),
        "half_b": (233, 150, 122),
        "peg": (60, 95, 95),
        "cap": (46, 139, 87),
    }
)

#: The role in which a part is shown alone.
_ALONE: Mapping[str, str] = MappingProxyType(
    {
        "basic": "row",
        "one_sided": "cross",
        "two_sided": "cross",
        "connector": "cap",
        "half": "half_a",
        "peg": "peg",
        "tube": "row",
    }
)

#: Where a joint is seen from: azimuth and elevation, in degrees.
_VIEW = (-90.0, 48.0)
#: Turn of a joint, and of a part alone, so that its edge is seen a little from its end.
_JOINT_TURN, _PART_TURN = 18.0, 14.0
#: How far a joint is pulled apart in the preview, in sides, and the furthest it may be.
_APART, _MOST_APART = 3.5, 100.0
#: Tube that a part is shown with, in sides over the shortest; longer ones would dwarf the joints.
_SHOWN = 3.5
#: Steps of an assembly in one row at most.
_MOST_IN_ROW = 3
#: Room between two items, in sides.
_GAP = 1.2

_Item = list[Shell]


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
    elements = bill(p for p in _frame(kit) if p.role in ("row", "cross"))
    joints = [_joint(kit, 0.0), _joint(kit, _APART)]
    return _draw(kit, [joints, [_alone(kit, name) for name in elements]], size)


def joint_picture(kit: Kit, explode: float = 0.0, *, size: tuple[int, int] = (1200, 900)) -> bytes:
    """Draw one joint.

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
    return _draw(kit, [[_joint(kit, explode)]], size)


def assembly_picture(kit: Kit, *, size: tuple[int, int] = (1200, 700)) -> bytes:
    """Draw how a joint is put together: each step with what comes in just outside.

    Parameters
    ----------
    kit
        The kit.
    size
        Width and height in pixels.

    Raises
    ------
    InputError
        The kit was not checked, so that nothing is known of how it is put together.
    """
    if not kit.ways:
        msg = "the kit is unchecked: no way is known on which its joint is put together"
        raise InputError(msg)
    there = set(range(len(kit.joint)))
    steps = []
    for way in kit.ways:
        out = way.path.scaled(kit.values["side"]).poses[-1]
        steps.append(_joint(kit, 0.0, dict.fromkeys(way.moving, out), there))
        there -= {*way.moving}
    steps.reverse()
    rows = math.ceil(len(steps) / _MOST_IN_ROW)
    count = math.ceil(len(steps) / rows)
    return _draw(kit, [steps[n : n + count] for n in range(0, len(steps), count)], size)


def parts_picture(kit: Kit, *, size: tuple[int, int] = (1200, 900)) -> bytes:
    """Draw one of each part that the frame needs, edge elements first.

    Parameters
    ----------
    kit
        The kit.  Tubes longer than a few sides are drawn shorter.
    size
        Width and height in pixels.
    """
    needed = bill(_frame(kit))
    elements = [name for name in needed if _ALONE[name] in ("row", "cross")]
    pieces = [name for name in needed if name not in elements]
    return _draw(kit, [[_alone(kit, n) for n in row] for row in (elements, pieces)], size)


def frame_picture(kit: Kit, *, size: tuple[int, int] = (1200, 900)) -> bytes:
    """Draw the whole frame, rows by columns.

    Parameters
    ----------
    kit
        The kit.
    size
        Width and height in pixels.
    """
    shells = _placed(kit, _frame(kit), kit.values, 0.0)
    return render(shells, size=size, view=(-70.0, 52.0))


def _frame(kit: Kit) -> tuple[Placement, ...]:
    return LAYOUTS[kit.frame](kit.rows, kit.columns, kit.key)


def _joint(
    kit: Kit,
    explode: float,
    moved: Mapping[int, Floats] = MappingProxyType({}),
    there: Collection[int] | None = None,
) -> _Item:
    """The pieces of a joint; its connectors, which have one role, in turn lighter.

    Some may be moved, each by a pose; and some may not be there.
    """
    shells = _placed(kit, kit.joint, kit.values, explode)
    seen = 0
    for n, placement in enumerate(kit.joint):
        points, triangles, colour = shells[n]
        if n in moved:
            points = points @ moved[n][:3, :3].T + moved[n][:3, 3]
        if placement.role == "cap":
            colour = _lighter(colour, 0.3 * seen)
            seen += 1
        shells[n] = _turned(points, _JOINT_TURN, flip=False), triangles, colour
    return [shell for n, shell in enumerate(shells) if there is None or n in there]


def _lighter(colour: Colour, share: float) -> Colour:
    red, green, blue = (round(c + share * (255 - c)) for c in colour)
    return red, green, blue


def _alone(kit: Kit, name: str) -> _Item:
    """One part, with a tube no longer than a few sides."""
    shortest, _ = limits(kit, "edge_length", kit.values)
    shown = min(kit.values["edge_length"], shortest + _SHOWN * kit.values["side"])
    placement = Placement(name, (0.0, 0.0), _PART_TURN, flip=False, role=_ALONE[name])
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
        place = np.array([*p.at, 0.0]) * values["edge_length"]
        turned = _turned(own, p.turn, flip=p.flip) + place
        shells.append((turned, kit.parts[p.part].triangles, COLOURS[p.role]))
    return shells


def _way(placement: Placement, points: Floats) -> Floats:
    """Where a piece goes when a joint is pulled apart, before it is turned, in its explosion."""
    if placement.part == "half":
        return np.array([0.5, 0.5 * math.copysign(1.0, points[:, 1].mean()), 0.0])
    return np.array([1.0, 0.0, 0.0])


def _turned(points: Floats, turn: float, *, flip: bool) -> Floats:
    """Points after a half turn about x where `flip` says so, then a turn about z in degrees."""
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    f = -1.0 if flip else 1.0
    turning = np.array([[c, s, 0.0], [-s * f, c * f, 0.0], [0.0, 0.0, f]])
    return np.asarray(points @ turning)


def _draw(kit: Kit, rows: Sequence[Sequence[_Item]], size: tuple[int, int]) -> bytes:
    """Draw rows of items, the first at the top, each row centred."""
    gap, elevation = _GAP * kit.values["side"], math.radians(_VIEW[1])
    # On the screen, right is x and up is along this.
    upwards = np.array([0.0, math.sin(elevation), math.cos(elevation)])
    shells: list[Shell] = []
    top = 0.0
    for row in rows:
        boxes = [_box(item, upwards) for item in row]
        widths, heights = np.array([high - low for low, high in boxes]).T
        left = -(widths.sum() + gap * (len(row) - 1)) / 2
        for item, (low, _), width, height in zip(row, boxes, widths, heights, strict=True):
            up = top - (heights.max() + height) / 2 - low[1]
            move = np.array([left - low[0], up / upwards[1], 0.0])
            shells += [(points + move, triangles, colour) for points, triangles, colour in item]
            left += width + gap
        top -= heights.max() + gap
    return render(shells, size=size, view=_VIEW)


def _box(item: _Item, upwards: Floats) -> tuple[Floats, Floats]:
    """Lower left and upper right corner of an item on the screen."""
    flat = np.concatenate([np.column_stack([p[:, 0], p @ upwards]) for p, _, _ in item])
    return flat.min(axis=0), flat.max(axis=0)
