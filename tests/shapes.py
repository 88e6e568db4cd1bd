"""Small meshes whose measures a person can work out."""

from itertools import product

import numpy as np

BOX = np.array(
    [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ]
)


def box(low, high):
    """Box between two corners; vertex 4 x + 2 y + z has those coordinates, low 0, high 1."""
    corners = np.array(list(product((0.0, 1.0), repeat=3)))
    return np.array(low) + corners * (np.array(high) - np.array(low)), BOX


def together(*meshes):
    """Several meshes as one, nothing merged."""
    points, triangles, count = [], [], 0
    for p, t in meshes:
        points.append(p)
        triangles.append(t + count)
        count += len(p)
    return np.concatenate(points), np.concatenate(triangles)


def torus(around=24, across=12):
    """Ring of radius 3 and 1 about z."""
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = 2 * np.pi * u / around, 2 * np.pi * v / across
    r = 3 + np.cos(b)
    points = np.stack([r * np.cos(a), r * np.sin(a), np.sin(b)], axis=-1).reshape(-1, 3)
    one, two = u * across + v, (u + 1) % around * across + v
    up = (v + 1) % across - v
    lower = np.stack([one, two, two + up], axis=-1).reshape(-1, 3)
    upper = np.stack([one, two + up, one + up], axis=-1).reshape(-1, 3)
    return points, np.concatenate([lower, upper])


def merged(points, triangles):
    """Merge the points that are equal."""
    unique, where = np.unique(points, axis=0, return_inverse=True)
    return unique, where.reshape(-1)[triangles]


def grooved(left=1.0, right=3.0, height=2.0):
    """Block 4 x 2 x 1 with a groove from (left, 2) down to (2, 1) and up to (right, 2).

    Vertices 0 to 6 at z = 0 and 7 to 13 at z = 1: the bottom of the groove, its left
    rim, and on round the outline to its right rim.
    """
    outline = [(2, 1), (left, height), (0, 2), (0, 0), (4, 0), (4, 2), (right, height)]
    points = np.array([(x, y, z) for z in (0, 1) for x, y in outline], dtype=float)
    fan = np.array([[0, k, k + 1] for k in range(1, 6)])
    wall = np.array([[k, (k + 1) % 7, (k + 1) % 7 + 7] for k in range(7)])
    back = np.array([[k, (k + 1) % 7 + 7, k + 7] for k in range(7)])
    return points, np.concatenate([fan[:, ::-1], fan + 7, wall, back])
