"""Draws the frames in examples/frames: patterns of stars, a tiling, a trellis, random ones.

usage: scripts/frames.py [FOLDER]
"""

from __future__ import annotations

import cmath
import itertools
import math
import sys
from pathlib import Path

import numpy as np
import shapely
from scipy.spatial import Delaunay, Voronoi

from scadgen.frame.graph import Frame
from scadgen.plane.catalogue import named
from scadgen.plane.drawn import make_frame
from scadgen.readers.json_frame import dumps

#: Length of the shortest edge of the star pattern, in mm.
SHORTEST = 40.0

#: Angle between a line of the star pattern and the tile's side that it begins on, in degrees.
CONTACT = 54


def star_pattern() -> str:
    """Ten-pointed stars and kites: decagons and bow ties with lines from the sides' middles.

    From the middle of each side two lines go inwards, 54 degrees off the side.  In a decagon
    each meets its neighbour's, which makes a star; in a bow tie they make two kites.
    """
    apothem = 0.5 / math.tan(math.pi / 10)
    across, up = 2 * apothem * math.sin(math.radians(36)), apothem * math.cos(math.radians(36))
    rows = {0: (-2, 0, 2), 1: (-1, 1), -1: (-1, 1)}
    star, kite = star_in_decagon(), kite_in_bow_tie()
    shapes = []
    for row, places in rows.items():
        centres = [complex(column * across, 2 * row * up) for column in places]
        shapes += [[centre + point for point in star] for centre in centres]
        for left, right in itertools.pairwise(centres):
            middle = (left + right) / 2
            shapes += [[middle + turn * point for point in kite] for turn in (1j, -1j)]
    scale = SHORTEST / min(abs(b - a) for a, b in itertools.pairwise(kite))
    return svg([[scale * point for point in s] for s in shapes], "Ten-pointed stars and kites")


def star_in_decagon() -> list[complex]:
    """The star in a decagon of side 1 with a vertex on the x axis."""
    tip = 0.5 / math.tan(math.pi / 10)
    # The triangle of a tip, the centre and a notch has 36 degrees at the tip, 18 at the centre.
    notch = tip * math.sin(math.radians(90 - CONTACT)) / math.sin(math.radians(CONTACT + 72))
    return [cmath.rect(tip if k % 2 else notch, math.radians(18 * k)) for k in range(20)]


def kite_in_bow_tie() -> list[complex]:
    """The left kite in a bow tie of side 1 with its waist on the y axis."""
    base = complex(-math.sin(math.radians(72)), 0)
    waist = 0.5 - math.cos(math.radians(72))
    upper = complex(base.real / 2, (0.5 + waist) / 2)
    # The slanted side falls by 18 degrees, the line from its middle by 54 more.
    inner = complex(upper.real + upper.imag / math.tan(math.radians(18 + CONTACT)), 0)
    return [base, upper.conjugate(), inner, upper]


def crosses() -> str:
    """Eight-pointed stars that touch at their tips, with crosses between them."""
    tip, notch = 1.0, math.sqrt(2 - math.sqrt(2))
    outline = [tip if k % 2 == 0 else notch for k in range(16)]
    star = [cmath.rect(r, math.radians(22.5 * k)) for k, r in enumerate(outline)]
    places = [complex(2 * column, 2 * row) for row in range(2) for column in range(3)]
    scale = SHORTEST / abs(star[1] - star[0])
    return svg([[scale * (at + point) for point in star] for at in places], "Stars and crosses")


def rough(seed: int = 7, most: float = 1.5) -> str:
    """Hexagons as a hand draws them: no vertex is further off than this, in mm."""
    frame = named("hexagonal", edge_length=70.0, rows=2, columns=3)
    rng = np.random.default_rng(seed)
    by = most * np.sqrt(rng.random(len(frame.vertices)))
    turn = 2 * np.pi * rng.random(len(frame.vertices))
    points = frame.plan @ (1, 1j) + by * np.exp(1j * turn)
    return svg([list(points[edge]) for edge in frame.edges], "Hexagons drawn by hand")


def svg(shapes: list[list[complex]], title: str) -> str:
    """Polygons and lines as a drawing in mm, y up."""
    corners = np.concatenate(shapes)
    left, top = corners.real.min(), corners.imag.max()
    width, height = np.ptp(corners.real), np.ptp(corners.imag)
    lists = [" ".join(f"{p.real - left:.6f},{top - p.imag:.6f}" for p in s) for s in shapes]
    polygons = "\n".join(
        f'  <{"polygon" if len(shape) > 2 else "polyline"} points="{points}"/>'
        for shape, points in zip(shapes, lists, strict=True)
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.6f}mm" height="{height:.6f}mm" '
        f'viewBox="0 0 {width:.6f} {height:.6f}">\n'
        f" <title>{title}</title>\n"
        f' <g fill="none" stroke="black" stroke-width="2">\n{polygons}\n </g>\n</svg>\n'
    )


def net(seed: int = 13, count: int = 45, least: float = 35.0) -> Frame:
    """Delaunay triangles of random points, evened out; none has an angle under `least` degrees.

    The points move into the middle of their Voronoi cells a few times; then slim triangles
    at the rim are taken away, the slimmest first.
    """
    size = np.array([420.0, 300.0])
    points = np.random.default_rng(seed).random((count, 2)) * size
    for _ in range(5):
        points = middles(points, size)
    triangles = Delaunay(points).simplices
    while (smallest := angles(points, triangles).min(axis=1)).min() < least:
        triangles = np.delete(triangles, smallest.argmin(), axis=0)
    sides = np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    used, edges = np.unique(np.unique(np.sort(sides, axis=1), axis=0), return_inverse=True)
    return make_frame("net", points[used].round(3), edges.reshape(-1, 2))


def cells(seed: int = 63, count: int = 22, shortest: float = 50.0) -> Frame:
    """Voronoi cells of random points that moved into the middle of theirs, whole ones only."""
    size = np.array([420.0, 300.0])
    points = np.random.default_rng(seed).random((count, 2)) * size
    for _ in range(40):
        points = middles(points, size)
    found = Voronoi(points)
    within = ((found.vertices > 0) & (found.vertices < size)).all(axis=1)
    edges = np.array([pair for pair in found.ridge_vertices if min(pair) >= 0])
    edges = edges[within[edges].all(axis=1)]
    # What is left of cells that the rim cuts off.
    while (loose := np.bincount(edges.ravel(), minlength=len(within)) == 1).any():
        edges = edges[~loose[edges].any(axis=1)]
    used, edges = np.unique(edges, return_inverse=True)
    vertices, edges = found.vertices[used], edges.reshape(-1, 2)
    scale = shortest / np.linalg.norm(np.diff(vertices[edges], axis=1), axis=2).min()
    return make_frame("cells", (vertices * scale).round(3), edges)


def middles(points: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Middles of the Voronoi cells in a rectangle; mirror images of the points bound them."""
    mirrored = [points]
    for axis, side in itertools.product((0, 1), (0.0, 1.0)):
        image = points.copy()
        image[:, axis] = 2 * side * size[axis] - image[:, axis]
        mirrored.append(image)
    cells = Voronoi(np.concatenate(mirrored))
    regions = [cells.regions[region] for region in cells.point_region[: len(points)]]
    polygons = [shapely.convex_hull(shapely.multipoints(cells.vertices[r])) for r in regions]
    return shapely.get_coordinates(shapely.centroid(polygons))


def angles(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Angles of triangles in degrees, ``(n, 3) float``."""
    corners = points[triangles]
    one = np.roll(corners, -1, axis=1) - corners
    other = np.roll(corners, 1, axis=1) - corners
    cosine = (one * other).sum(axis=2) / np.linalg.norm(one, axis=2) / np.linalg.norm(other, axis=2)
    return np.degrees(np.arccos(cosine))


def main(folder: Path) -> None:
    """Write the frames."""
    folder.mkdir(parents=True, exist_ok=True)
    trellis = named("rectangular", width=60.0, height=90.0, rows=3, columns=5)
    tiling = named("3.4.6.4", edge_length=60.0)
    files = {
        "star.svg": star_pattern(),
        "trellis.json": dumps(Frame.planar("trellis", trellis.plan, trellis.edges)),
        "net.json": dumps(net()),
        "cells.json": dumps(cells()),
        "crosses.svg": crosses(),
        "rough.svg": rough(),
        "tiling.json": dumps(Frame.planar("tiling", tiling.plan, tiling.edges)),
    }
    for name, text in files.items():
        (folder / name).write_text(text, encoding="ascii")


if __name__ == "__main__":
    root = Path(__file__).parent.parent
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else root / "examples" / "frames")
