"""Facts about a triangle mesh, and the list of what keeps it from being a solid.

Points are ``(v, 3) float`` in mm, triangles ``(m, 3) int``, counter-clockwise seen from
outside.  Everything that asks which faces are neighbours goes by shared vertex index,
never by position.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from scadgen.solid.affine import Floats, Ints
from scadgen.solid.crossing import crossing_faces
from scadgen.solid.vectors import cross

__all__ = [
    "FLAT",
    "areas",
    "components",
    "edge_faults",
    "euler",
    "genus",
    "heights",
    "normals",
    "pinched_vertices",
    "solid_faults",
    "volume",
    "weld_float32",
]

#: A face lower than this share of the mesh's diagonal is degenerate: its normal would be
#: rounding.  The smallest feature kept is about 1e-5 of the diagonal.
FLAT = 1e-9

#: How many offenders a fault names.
_NAMED = 3


def _crosses(points: Floats, triangles: Ints) -> Floats:
    a, b, c = (points.take(triangles[:, k], axis=0) for k in range(3))
    doubled: Floats = cross(b - a, c - a)
    return doubled


def volume(points: Floats, triangles: Ints) -> float:
    """Enclosed volume, in mm3; negative if the faces look inwards."""
    if not len(triangles):
        return 0.0
    # Measured from the mesh's own middle: far from the origin the terms would cancel.
    local = points - points[triangles[:, 0]].mean(axis=0)
    a, b, c = (local.take(triangles[:, k], axis=0) for k in range(3))
    return float((a * cross(b, c)).sum() / 6)


def areas(points: Floats, triangles: Ints) -> Floats:
    """Area of every face, ``(m,) float``, mm2."""
    area: Floats = np.linalg.norm(_crosses(points, triangles), axis=1) / 2
    return area


def normals(points: Floats, triangles: Ints) -> Floats:
    """Outward unit normal of every face, ``(m, 3) float``; zero for a face without area."""
    doubled = _crosses(points, triangles)
    length = np.linalg.norm(doubled, axis=1, keepdims=True)
    unit: Floats = np.divide(doubled, length, out=np.zeros_like(doubled), where=length > 0)
    return unit


def heights(points: Floats, triangles: Ints) -> Floats:
    """Smallest height of every face, ``(m,) float``, mm; zero if all corners are in line."""
    corners = points.take(triangles, axis=0)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    doubled = 2 * areas(points, triangles)
    height: Floats = np.divide(doubled, longest, out=np.zeros_like(doubled), where=longest > 0)
    return height


def _half_edges(triangles: Ints) -> tuple[Ints, Ints]:
    """Start and end of the half-edges; number ``3 * face + corner`` starts at that corner."""
    return triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)


def _edges(triangles: Ints) -> tuple[Ints, Ints, Ints, Ints]:
    """Edges ``(e, 2)``, lower vertex first; each half-edge's edge; uses; balance of senses."""
    tail, head = _half_edges(triangles)
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    # One number an edge: ten times as fast as telling rows apart.
    count = int(high.max(initial=0)) + 1
    numbers, which = np.unique(low * count + high, return_inverse=True)
    edges = np.column_stack(np.divmod(numbers, count))
    uses = np.bincount(which, minlength=len(edges))
    sense = np.where(tail < head, 1, -1)
    balance = np.bincount(which, weights=sense, minlength=len(edges)).astype(np.int64)
    return edges, which, uses, balance


def edge_faults(triangles: Ints) -> Ints:
    """Edges that do not have exactly two faces, one on each side.

    Returns
    -------
    edges
        ``(k, 2) int``, vertex numbers, the lower one first, sorted.
    """
    edges, _, uses, balance = _edges(triangles)
    faulty: Ints = edges[(uses != 2) | (balance != 0)]
    return faulty


def _labels(count: int, one: Ints, other: Ints) -> tuple[int, Ints]:
    order = np.argsort(one, kind="stable")
    starts, ends = np.searchsorted(one[order], np.arange(count + 1)), other[order]
    graph = csr_array((np.ones(len(one), dtype=np.int8), ends, starts), shape=(count, count))
    found, labels = connected_components(graph, directed=False)
    return int(found), labels.astype(np.int64)


def components(triangles: Ints, through: Literal["edges", "vertices"] = "edges") -> int:
    """Count the shells: faces that hang together through shared edges, or vertices."""
    if through == "edges":
        edges, link, _, _ = _edges(triangles)
        count = len(edges)
    else:
        vertices, link = np.unique(triangles, return_inverse=True)
        link, count = link.reshape(-1), len(vertices)
    return _shells(triangles, link, count)


def _shells(triangles: Ints, link: Ints, count: int) -> int:
    """Parts of a mesh whose faces hang together through what links their corners, so many."""
    face = np.repeat(np.arange(len(triangles)), 3)
    return _labels(len(triangles) + count, face, len(triangles) + link)[0]


def euler(triangles: Ints) -> int:
    """Euler's characteristic: vertices in use - edges + faces."""
    return len(np.unique(triangles)) - len(_edges(triangles)[0]) + len(triangles)


def genus(triangles: Ints) -> int:
    """Number of handles of a closed mesh, all its shells together."""
    return components(triangles) - euler(triangles) // 2


def pinched_vertices(triangles: Ints) -> Ints:
    """Vertices of a closed mesh at which more than one fan of faces meets, ``(k,) int``."""
    return _pinched(triangles, _edges(triangles)[1])


def _pinched(triangles: Ints, edge: Ints) -> Ints:
    """The same, by each half-edge's edge."""
    tail, _ = _half_edges(triangles)
    # Each half-edge ties its two corners to the edge's own two sides, so corners at one
    # vertex hang together exactly when their faces do so around it.
    corner = np.arange(len(tail))
    following = corner.reshape(-1, 3)[:, [1, 2, 0]].reshape(-1)
    tail_first = tail < tail[following]
    count = len(tail)
    side_of_tail = count + 2 * edge + ~tail_first
    side_of_head = count + 2 * edge + tail_first
    total = count + 2 * (int(edge.max(initial=-1)) + 1)
    one = np.concatenate([corner, following])
    _, fan = _labels(total, one, np.concatenate([side_of_tail, side_of_head]))
    # One number a pair, as for edges.
    pairs = np.unique(tail * total + fan[:count])
    vertices, fans = np.unique(pairs // total, return_counts=True)
    pinched: Ints = vertices[fans > 1]
    return pinched


def weld_float32(points: Floats, triangles: Ints) -> tuple[NDArray[np.float32], Ints]:
    """Round to float32, as STL does, and merge the points that become equal.

    Returns
    -------
    points
        ``(w, 3) float32``, mm, sorted.
    triangles
        ``(m, 3) int``; a face that collapsed is kept, with a vertex number twice.
    """
    # Adding zero turns -0.0 into 0.0, which is the same place.
    rounded = points.astype(np.float32) + np.float32(0)
    order = np.lexsort(rounded.T[::-1])
    ordered = rounded[order]
    new = np.append(True, (ordered[1:] != ordered[:-1]).any(axis=1))[: len(order)]
    where = np.empty(len(order), dtype=np.int64)
    where[order] = np.cumsum(new) - 1
    return ordered[new], where[triangles]


def _named(what: str, offenders: Ints) -> str:
    """Say how many and name the first few."""
    rows = ["-".join(map(str, np.atleast_1d(row))) for row in offenders[:_NAMED]]
    more = ", ..." if len(offenders) > _NAMED else ""
    return f"{what}: {len(offenders)} ({', '.join(rows)}{more})"


def _degenerate(points: Floats, triangles: Ints) -> Ints:
    size = float(np.linalg.norm(np.ptp(points.take(triangles, axis=0), axis=(0, 1))))
    return np.flatnonzero(heights(points, triangles) <= FLAT * size)


def _topology_faults(triangles: Ints) -> list[str]:
    faults = []
    edges, which, uses, balance = _edges(triangles)
    open_ = edges[uses != 2]
    if len(open_):
        faults.append(_named("closed: edges without exactly two faces", open_))
    turned = edges[(uses == 2) & (balance != 0)]
    if len(turned):
        faults.append(_named("oriented: edges whose two faces run the same way", turned))
    if (shells := _shells(triangles, which, len(edges))) != 1:
        faults.append(f"one shell: {shells} shells")
    pinched = _pinched(triangles, which)
    if not len(open_) and len(pinched):
        faults.append(_named("one fan at a vertex: vertices where several meet", pinched))
    return faults


def _float32_faults(points: Floats, triangles: Ints) -> list[str]:
    """What the rounding to float32 breaks."""
    rounded, welded = weld_float32(points, triangles)
    collapsed = _degenerate(rounded.astype(np.float64), welded)
    if len(collapsed):
        return [_named("no collapsed face in float32: faces", collapsed)]
    broken = edge_faults(welded)
    if len(broken):
        return [_named("closed in float32: edges without two opposite faces", broken)]
    return []


def solid_faults(points: Floats, triangles: Ints) -> list[str]:
    """Everything that keeps the mesh from bounding one printable solid.

    The invariants, in this order: closed, oriented, one shell, one fan at a vertex,
    positive volume, no degenerate face, no crossing faces, and in float32 still closed
    and without collapsed faces.

    Parameters
    ----------
    points
        ``(v, 3) float``, mm.
    triangles
        ``(m, 3) int``.

    Returns
    -------
    faults
        One line each, starting with the invariant that does not hold; empty for a
        solid.
    """
    if not len(triangles):
        return ["closed: the mesh has no faces"]
    if triangles.min() < 0 or triangles.max() >= len(points):
        return [f"vertex numbers: a face uses one outside 0 to {len(points) - 1}"]
    if not np.isfinite(points).all():
        return [_named("finite: points", np.flatnonzero(~np.isfinite(points).all(axis=1)))]
    faults = _topology_faults(triangles)
    if not (enclosed := volume(points, triangles)) > 0:
        faults.append(f"positive volume: {enclosed:.6g} mm3")
    degenerate = _degenerate(points, triangles)
    if len(degenerate):
        faults.append(_named("no degenerate face: faces", degenerate))
    else:
        # A face without area has no axes of its own to be told apart by.
        crossing = crossing_faces(points, triangles)
        if len(crossing):
            faults.append(_named("no crossing faces: pairs of faces", crossing))
        faults += _float32_faults(points, triangles)
    return faults
