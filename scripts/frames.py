"""Draws the frames in examples/frames: a star pattern, a trellis, a net of random points.

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

from scadgen.frame.catalogue import named
from scadgen.frame.graph import Frame, make_frame
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
    return svg([[scale * point for point in shape] for shape in shapes])


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


def svg(shapes: list[list[complex]]) -> str:
    """Polygons as a drawing in mm, y up."""
    corners = np.concatenate(shapes)
    left, top = corners.real.min(), corners.imag.max()
    width, height = np.ptp(corners.real), np.ptp(corners.imag)
    lists = [" ".join(f"{p.real - left:.6f},{top - p.imag:.6f}" for p in s) for s in shapes]
    polygons = "\n".join(f'  <polygon points="{points}"/>' for points in lists)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.6f}mm" height="{height:.6f}mm" '
        f'viewBox="0 0 {width:.6f} {height:.6f}">\n'
        " <title>Ten-pointed stars and kites</title>\n"
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
    files = {
        "star.svg": star_pattern(),
        "trellis.json": dumps(Frame("trellis", trellis.vertices, trellis.edges)),
        "net.json": dumps(net()),
    }
    for name, text in files.items():
        (folder / name).write_text(text, encoding="ascii")


if __name__ == "__main__":
    root = Path(__file__).parent.parent
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else root / "examples" / "frames")
