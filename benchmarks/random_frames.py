"""How many random planar frames become proved kits, and why others do not.

usage: benchmarks/random_frames.py [COUNT] [SEED]
Each has 3 to 60 vertices, edges of a Delaunay triangulation that are 25 degrees apart and more,
and is as large as its joints need.  A kit is at detail `draft`, with all joints proved, and so
are its plan and the finished frame; where only the latter is not, the kit is told as not held.
What is refused is told with its reason.  One line a frame.
"""

from __future__ import annotations

import math
import sys
import time
from collections import Counter

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import Delaunay

from scadgen.errors import InvariantError, ScadgenError
from scadgen.frame.graph import Frame
from scadgen.kit.build import Request
from scadgen.plan.keyed import proved_kit
from scadgen.plan.order import make_plan
from scadgen.plan.whole import whole_frame
from scadgen.plane.drawn import make_frame

#: Least angle between two edges, in degrees, and the vertices of a frame.
LEAST, FEWEST, MOST = 25.5, 3, 60

#: Least distance of two vertices, where there is one for each square of 100.
APART = 50.0

#: Least distance of an edge from a vertex that it passes.
PASSED = 30.0


def random_frame(random: np.random.Generator, most: int = MOST) -> Frame:
    """A connected planar frame of no more than so many vertices."""
    while True:
        count = round(math.exp(random.uniform(math.log(FEWEST), math.log(most))))
        points = apart(random, count)
        triangles = Delaunay(points).simplices
        pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, 1:], triangles[:, ::2]]))
        edges = np.unique(pairs, axis=0)
        edges = thinned(points, edges[random.permutation(len(edges))])
        if connected(edges, count):
            kept = [edges]
            for edge in random.permutation(len(edges))[: int(random.uniform(0, 0.4) * len(edges))]:
                fewer = kept[-1][(kept[-1] != edges[edge]).any(axis=1)]
                if connected(fewer, count):
                    kept.append(fewer)
            return make_frame("random", points, kept[-1])


def apart(random: np.random.Generator, count: int) -> np.ndarray:
    """Random points that keep a distance from each other."""
    points = np.empty((0, 2))
    while len(points) < count:
        point = random.uniform(0, 100 * math.sqrt(count), 2)
        if (np.linalg.norm(points - point, axis=1) > APART).all():
            points = np.vstack([points, point])
    return points


def connected(edges: np.ndarray, count: int) -> bool:
    """Whether edges join all vertices."""
    graph = coo_array((np.ones(len(edges)), edges.T), shape=(count, count))
    return bool(connected_components(graph, directed=False)[0] == 1)


def thinned(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Those of some edges that keep their distance from all kept before them."""
    taken: list[list[float]] = [[] for _ in points]
    kept = []
    for a, b in edges.tolist():
        x, y = points[b] - points[a]
        turn = math.atan2(y, x)
        ends = (a, turn), (b, turn + math.pi)
        if passed(points, a, b) > PASSED and all(
            abs((other - angle + math.pi) % (2 * math.pi) - math.pi) > math.radians(LEAST)
            for end, angle in ends
            for other in taken[end]
        ):
            kept.append([a, b])
            for end, angle in ends:
                taken[end].append(angle)
    return np.array(kept)


def become(frame: Frame) -> tuple[str, str]:
    """What becomes of a frame, and what is to be said of it."""
    try:
        wish = Request("random", frame=frame, detail="draft", resizable=True)
        kit = proved_kit(wish)
    except ScadgenError as error:
        return "refused" if not isinstance(error, InvariantError) else "failed", str(error)
    plan = make_plan(kit)
    held = whole_frame(plan.standing).held
    said = f"{len(kit.joints)} kinds of joints, plan of {len(plan.steps)} steps"
    if not plan.proved:
        return "kit, not its plan", said
    return "kit" if held else "kit, not held", said


def passed(points: np.ndarray, a: int, b: int) -> float:
    """How near an edge passes to other vertices."""
    way = points[b] - points[a]
    others = np.delete(points, [a, b], axis=0)
    share = np.clip((others - points[a]) @ way / (way @ way), 0, 1)
    return float(np.linalg.norm(others - points[a] - share[:, None] * way, axis=1).min())


def main(count: int, seed: int) -> None:
    """Make the frames and say what becomes of them."""
    ends: Counter[str] = Counter()
    for number in range(seed, seed + count):
        frame = random_frame(np.random.default_rng(number))
        start = time.process_time()
        end, said = become(frame)
        ends[end] += 1
        size = f"{len(frame.vertices):3d} vertices, {len(frame.edges):3d} edges"
        seconds = time.process_time() - start
        print(f"{number:4d}: {size}, {seconds:6.1f} CPU s: {end}: {said}", flush=True)
    told = ", ".join(f"{end} {number}" for end, number in ends.most_common())
    print(f"of {count} frames: {told}")


if __name__ == "__main__":
    words = [int(word) for word in sys.argv[1:3]]
    main(*words, *(200, 0)[len(words) :])
