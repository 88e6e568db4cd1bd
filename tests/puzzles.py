"""Puzzles whose answer a person can reason out: lists of meshes, placed as assembled."""

from itertools import product

import numpy as np
from scipy.spatial import ConvexHull
from shapes import box

#: Six sticks of 2 x 2 x 6 cells, two along each axis, crossing in the middle; and the cells
#: that more than one of them would take, ascending, by who has them.  Stick 0 has all of its
#: own, so it slides out along x; the others block each other while it is there.
_STICKS = (
    ((-3, 3), (0, 2), (-1, 1)),
    ((-3, 3), (-2, 0), (-1, 1)),
    ((-1, 1), (-3, 3), (0, 2)),
    ((-1, 1), (-3, 3), (-2, 0)),
    ((0, 2), (-1, 1), (-3, 3)),
    ((-2, 0), (-1, 1), (-3, 3)),
)
_SIX = "55001151523002001134223002004400"

#: The same for one stick along each axis, each holding the next: they never come apart.
_THREE = "1121001002"


def voxels(cells):
    """Mesh of unit cubes, their common faces left out."""
    cells = {tuple(int(x) for x in cell) for cell in cells}
    quads = []
    for cell in sorted(cells):
        for axis, side in product(range(3), (0, 1)):
            beside = list(cell)
            beside[axis] += 2 * side - 1
            if tuple(beside) in cells:
                continue
            corners = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = list(cell)
                corner[axis] += side
                corner[(axis + 1) % 3] += a
                corner[(axis + 2) % 3] += b
                corners.append(corner)
            quads.append(corners if side else corners[::-1])
    quads = np.array(quads, dtype=float)
    points, where = np.unique(quads.reshape(-1, 3), axis=0, return_inverse=True)
    where = where.reshape(-1, 4)
    return points, np.concatenate([where[:, [0, 1, 2]], where[:, [0, 2, 3]]])


def cells(*ranges):
    """Cells of a box."""
    return set(product(*(range(*r) for r in ranges)))


def crossing(sticks, owners):
    """Sticks that share out the cells that several of them would take."""
    boxes = [cells(*s) for s in sticks]
    shared = sorted(c for c in set().union(*boxes) if sum(c in b for b in boxes) > 1)
    owner = dict(zip(shared, map(int, owners), strict=True))
    return [voxels(c for c in box if owner.get(c, n) == n) for n, box in enumerate(boxes)]


def six_piece_burr():
    return crossing(_STICKS, _SIX)


def three_rods():
    return crossing(_STICKS[::2], _THREE)


def three_piece_burr():
    """A rail that slides along x in a slot, and a bar along z through both that stops it."""
    bar = cells((2, 3), (2, 3), (-1, 6))
    section = {(y, 1) for y in (1, 2, 3)} | {(2, 2)} | {(y, 3) for y in range(5)}
    rail = {(x, y, z) for x in range(5) for y, z in section} - bar
    slot = cells((0, 5), (0, 5), (0, 3)) - rail - bar
    return [voxels(slot), voxels(rail), voxels(bar)]


def corner():
    """A cube in the corner of three walls."""
    cube = cells((1, 3), (1, 3), (1, 3))
    return [voxels(cells((0, 3), (0, 3), (0, 3)) - cube), voxels(cube)]


def peg_in_tube():
    """A square peg, longer than the tube around it, along z."""
    peg = cells((1, 2), (1, 2), (-1, 4))
    return [voxels(cells((0, 3), (0, 3), (0, 3)) - peg), voxels(peg)]


def two_hooks():
    """Two L-shaped pieces that lie in each other's corner."""
    first = {(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (0, 2, 0)}
    second = {(1, 1, 0), (2, 1, 0), (1, 2, 0)}
    return [voxels(first), voxels(second)]


def without(mesh, *tools):
    """A mesh less others."""
    from manifold3d import Manifold, Mesh64

    def solid(points, triangles):
        return Manifold(
            Mesh64(vert_properties=points.copy(), tri_verts=triangles.astype(np.uint64))
        )

    left = solid(*mesh)
    for tool in tools:
        left -= solid(*tool)
    out = left.to_mesh64()
    return np.array(out.vert_properties)[:, :3].copy(), np.array(out.tri_verts, dtype=np.int64)


def hull(points):
    """Convex polyhedron around points, counter-clockwise from outside."""
    points = np.asarray(points, dtype=float)
    found = ConvexHull(points)
    triangles = found.simplices.astype(np.int64)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    inward = (np.cross(b - a, c - a) * found.equations[:, :3]).sum(axis=1) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return points, triangles


def dovetail(*, stopped):
    """A dovetail along x in a block; stopped: the slot ends inside the block."""
    outline = [(-1, 0), (1, 0), (2, 2), (-2, 2)]
    tail = hull([(x, y, 4 - z) for x in (0, 6) for y, z in outline])
    tool = hull([(x, y, 4 - z) for x in (0, 8) for y, z in outline])
    block = box((-2 if stopped else 0, -4, 0), (6, 4, 4))
    return [without(block, tool), tail]


def ball_in_socket(top):
    """A ball of 92 corners and radius 1, in a block up to a height over its middle."""
    golden = (1 + 5**0.5) / 2
    corners = [(0, a, b * golden) for a in (-1, 1) for b in (-1, 1)]
    corners = [np.roll(c, k) for c in corners for k in range(3)]
    points, triangles = hull(corners)
    split = [points]
    for i, j, k in ((1, 1, 0), (2, 1, 0), (1, 2, 0), (1, 1, 1)):
        for turn in range(3):
            weight = np.roll((i, j, k), turn)
            split.append(np.einsum("tcx,c->tx", points[triangles], weight))
    directions = np.concatenate(split)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    ball = hull(np.unique(directions.round(9), axis=0))
    return [without(box((-2, -2, -2), (2, 2, top)), ball), ball]


def fine_ball(radius):
    """A ball of some thousand corners."""
    n = np.arange(3000) + 0.5
    height, angle = 1 - 2 * n / 3000, np.pi * (1 + 5**0.5) * n
    flat = np.sqrt(1 - height**2)
    return hull(radius * np.column_stack([flat * np.cos(angle), flat * np.sin(angle), height]))


def rod(radius, sides, low, high):
    """A regular prism along z; a corner points along x."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return hull([(x, y, z) for z in (low, high) for x, y in ring])


def joined_solids(*meshes):
    """The union of meshes."""
    size = 2 * max(np.abs(points).max() for points, _ in meshes)
    block = box(3 * [-size], 3 * [size])
    return without(block, without(block, *meshes))


def axle_in_hub(radius, sides, hole=64, pin=None):
    """An axle in a hub's hole of radius 5 and some sides; flanges 0.2 off hold it.

    The pin, if there is one, is a mesh that is taken from the hub and added to the axle.
    """
    ends = [rod(9.0, sides, -30, -15.2), rod(9.0, sides, 15.2, 30)]
    axle = joined_solids(rod(radius, sides, -20, 20), *ends, *([] if pin is None else [pin]))
    block = box((-20, -20, -15), (20, 20, 15))
    hub = without(block, rod(5.0, hole, -20, 20), *([] if pin is None else [pin]))
    return [hub, axle]


def cube_in_box(gap):
    """A cube of side 2 about the origin in a closed box, a gap all around."""
    inner = box((-1 - gap,) * 3, (1 + gap,) * 3)
    return [without(box((-2,) * 3, (2,) * 3), inner), box((-1,) * 3, (1,) * 3)]


def placed(meshes, rng):
    """The same anywhere, turned anyhow, and of any size; the turn as well."""
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    size, shift = 10 ** rng.uniform(-2, 3), rng.uniform(-5, 5, size=3)
    return [(size * (points @ turn.T + shift), triangles) for points, triangles in meshes], turn


def diagonal(meshes):
    """Diagonal of the box of all."""
    return float(np.linalg.norm(np.ptp(np.concatenate([p for p, _ in meshes]), axis=0)))


def grown(side, count, seed):
    """Cells of a cube shared out among parts that grow at random, all at once.

    Returns the parts' cells.
    """
    rng = np.random.default_rng(seed)
    owner = np.full((side,) * 3, -1)
    owner.flat[rng.choice(side**3, count, replace=False)] = np.arange(count)
    parts = [[tuple(c) for c in np.argwhere(owner == n)] for n in range(count)]
    growing = set(range(count))
    while growing:
        part = min(growing, key=lambda n: (len(parts[n]), n))
        around = {
            tuple(np.add(cell, step))
            for cell in parts[part]
            for step in np.concatenate([np.eye(3, dtype=int), -np.eye(3, dtype=int)])
        }
        free = sorted(c for c in around if min(c) >= 0 and max(c) < side and owner[c] < 0)
        if not free:
            growing.discard(part)
            continue
        cell = free[rng.integers(len(free))]
        owner[cell] = part
        parts[part].append(cell)
    return parts
