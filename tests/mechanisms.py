"""Hinges, screws, bayonets, cages and chains with round faces of any number of facets.

Each is a list of meshes: what it is in, then what moves.
"""

import numpy as np
from puzzles import hull, joined_solids, rod, without
from shapes import box, torus

__all__ = [
    "bayonet",
    "caged_ball",
    "chain",
    "hinge",
    "keyed_hinge",
    "pin_at_stop",
    "plain_pin",
    "screw",
]


def _knuckle(facets, gap):
    """A block with a round hole along z, and a pin with heads in it."""
    hub = without(box((-9, -9, -8), (9, 9, 8)), rod(5.0, facets, -9, 9))
    heads = [rod(8.0, facets, low, low + 3) for low in (-11 - gap, 8 + gap)]
    return hub, joined_solids(rod(5.0 - gap, facets, -10, 10), *heads)


def hinge(facets, gap):
    """A pin with heads at both ends: it turns, and cannot leave."""
    return [*_knuckle(facets, gap)]


def keyed_hinge(facets, gap):
    """The same with a feather of the pin in a groove of the hub: nothing turns."""
    hub, pin = _knuckle(facets, gap)
    groove, feather = (
        box((3, -1.5, -9), (7, 1.5, 9)),
        box((3, gap - 1.5, -8.5), (7 - gap, 1.5 - gap, 8.5)),
    )
    return [without(hub, groove), joined_solids(pin, feather)]


def plain_pin(facets, gap):
    """A pin in a blind hole: it leaves along +z."""
    hub = without(box((-9, -9, -8), (9, 9, 8)), rod(5.0, facets, -4, 9))
    return [hub, rod(5.0 - gap, facets, -4, 12)]


def pin_at_stop(facets, gap):
    """A hinge whose pin has a lug that lies on a stop: it turns one way, about -z."""
    hub, pin = _knuckle(facets, gap)
    lug = box((4, -2, 8 + gap), (12, 0, 11 + gap))
    return [joined_solids(hub, box((8.5, 0, 7), (9, 4, 11))), joined_solids(pin, lug)]


def bayonet(facets, gap):
    """A shaft whose lug is at the end of a bent slot: it turns back and rises."""
    hole, low = rod(5.0, facets, -8, 9), -2.0
    turn = np.radians(np.linspace(0, 75, 11))
    rim = [(7 * np.cos(a), 7 * np.sin(a)) for a in turn]
    sweep = hull([(x, y, z) for z in (low, low + 3) for x, y in [(0, 0), *rim]])
    rise = hull([(x, y, z) for z in (low, 10) for x, y in [(0, 0), *rim[5:]]])
    bush = without(box((-9, -9, -8), (9, 9, 8)), hole, sweep, rise)
    part = np.radians(np.linspace(0, 20, 4))
    lug = [(6.5 * np.cos(a), 6.5 * np.sin(a)) for a in part]
    lug = hull([(x, y, z) for z in (low + gap, low + 3 - gap) for x, y in [(0, 0), *lug]])
    return [bush, joined_solids(rod(5.0 - gap, facets, -8 + gap, 12), lug)]


def _threaded(radius, facets, pitch, low, high):
    """A right-handed screw along z: a round bar whose radius goes up and down by 1."""
    profile = radius + np.array([0.5, 0.5, -0.5, -0.5])
    start = pitch * np.floor(low / pitch - 2)
    turns = int(np.ceil((high - start) / pitch)) + 2
    place = np.arange(turns * facets + 1)
    angle = 2 * np.pi * place / facets
    # Strips that climb a pitch a turn, four to a pitch; each ends where the next turn begins.
    lines = [
        np.column_stack(
            [r * np.cos(angle), r * np.sin(angle), start + pitch * (place / facets + k / 4)]
        )
        for k, r in enumerate(profile)
    ]
    count = len(place)
    points = np.concatenate(lines)
    faces = []
    for k in range(4):
        n = np.arange(count - 1 if k < 3 else count - 1 - facets)
        here, above = k * count + n, ((k + 1) % 4) * count + n + (facets if k == 3 else 0)
        faces += [
            np.column_stack([here, here + 1, above + 1]),
            np.column_stack([here, above + 1, above]),
        ]
    ends = [*range(facets + 1), *(k * count for k in (3, 2, 1))]
    last = [k * count + count - 1 for k in (1, 2, 3)]
    top = [*(3 * count + n for n in range(count - 1 - facets, count)), *last[1::-1], count - 1]
    for rim, middle, turned in ((ends, len(points), True), (top, len(points) + 1, False)):
        ring = np.array(rim)
        cap = np.column_stack([ring, np.roll(ring, -1), np.full(len(ring), middle)])
        faces.append(cap[:, ::-1] if turned else cap)
    z = [points[ends, 2].mean(), points[top, 2].mean()]
    points = np.concatenate([points, [(0, 0, z[0]), (0, 0, z[1])]])
    far = 4 * radius
    return without(
        (points, np.concatenate(faces)),
        box((-far, -far, start - far), (far, far, low)),
        box((-far, -far, high), (far, far, high + far)),
    )


def screw(facets, gap, *, seated=True):
    """A screw in a block, its head on it if it is seated: it unscrews along +z."""
    thread = _threaded(5.0 - gap, facets, 4.0, -8, 8 if seated else 12)
    hole = _threaded(5.0, facets, 4.0, -10, 10)
    body = box((-9, -9, -8), (9, 9, 8))
    return [
        without(body, hole),
        joined_solids(thread, rod(8.0, facets, 8, 11)) if seated else thread,
    ]


def caged_ball(facets, gap):
    """A ball in a box with a window in each wall that it does not pass."""
    around = np.pi * np.arange(1, facets // 2) / (facets // 2)
    turn = 2 * np.pi * np.arange(facets) / facets
    ball = hull(
        [(np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)) for a in turn for b in around]
        + [(0, 0, 1), (0, 0, -1)]
    )
    side = 5 + gap
    bars = [box(*np.array([np.roll((-9, -3, -3), k), np.roll((9, 3, 3), k)])) for k in range(3)]
    cage = without(box(3 * [-7], 3 * [7]), box(3 * [-side], 3 * [side]), *bars)
    return [cage, (5 * ball[0], ball[1])]


def chain(facets, count):
    """Links of a chain, each through the one before."""
    points, faces = torus(facets, max(facets // 2, 6))
    links = []
    for n in range(count):
        link = points[:, [0, 2, 1]] * (1, 1, -1) if n % 2 else points
        links.append((link + np.array([3 * n, 0, 0]), faces))
    return links
