"""One joint: a ring decomposed into connectors, one of which can be split."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from scadgen.errors import GeometryError
from scadgen.joint.curve import SiteCurve
from scadgen.joint.fan import fanned
from scadgen.joint.lattice import Lattice, directions_and_gaps, make_lattice, without_corners
from scadgen.joint.pieces import SPLIT, halves
from scadgen.joint.place import beside_walls, place
from scadgen.joint.site import Site
from scadgen.joint.surface import Surface, half_turn, join, simplify
from scadgen.joint.symmetry import Symmetry, lopsided
from scadgen.joint.territory import belongs, share
from scadgen.joint.tidy import corners_in_the_way, merge_short_sides
from scadgen.joint.walls import Key, wedges
from scadgen.joint.weave import Weave
from scadgen.solid.affine import Floats

__all__ = [
    "DETAILS",
    "Detail",
    "FaceError",
    "Joint",
    "check_footprint",
    "fitted",
    "make_joint",
    "site_curves",
    "wall_angles",
]


class FaceError(GeometryError):
    """A tube's face is not its connector's alone, on whatever lattice."""


@dataclass(frozen=True, slots=True)
class Detail:
    """How finely a joint is resolved.

    Parameters
    ----------
    samples
        Samples of each site curve.
    cells
        Cells of the lattice across the side; odd.
    """

    samples: int
    cells: int


#: Angles as near to each other as this are the same, in radians.
_ALIKE = 1e-9

#: The levels of detail by name.
DETAILS: Mapping[str, Detail] = MappingProxyType(
    {"draft": Detail(60, 5), "standard": Detail(120, 9), "fine": Detail(240, 17)}
)


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """A joint's pieces, in sides.

    Parameters
    ----------
    edges
        Directions of its edges, ascending, in [0, 2 pi).
    weave
        Its weave.
    lattice
        The lattice its walls were found on.
    curves
        Its site curves, one an edge.
    walls
        ``(k,) float``: angle from each edge to the wall after it.
    alike
        For each edge, the first that is alike, and whether it is turned over for it.
    connectors
        For each edge, its connector with the edge turned to +x.
    halves
        For each edge, half A and half B of its connector, turned likewise.
    """

    edges: Floats
    weave: Weave
    lattice: Lattice
    curves: tuple[SiteCurve, ...]
    walls: Floats
    alike: tuple[tuple[int, bool], ...]
    connectors: tuple[Surface, ...]
    halves: tuple[tuple[Surface, Surface], ...]


def wall_angles(edges: Sequence[float], weave: Weave, keys: Collection[int]) -> Floats:
    """Angle from each edge to the wall after it, ``(k,)``.

    Where the arms of a weave weave in a stretch, a wall beside a key is as near to it as that
    allows, so that halves come out the same way whatever the gap; where neither edge has a better
    claim it may be beside the first (see `lopsided`).  All others are in the middle of their gaps,
    as are all walls of other weaves.
    """
    _, gaps = directions_and_gaps(edges)
    if weave.stretch is None:
        return gaps / 2
    near = np.minimum(weave.stretch / (2 * weave.ring_ratio), gaps / 2)
    here = np.isin(np.arange(len(gaps)), list(keys))
    after = np.roll(here, -1)
    first = here | lopsided(gaps, keys)
    return np.where(first, near, np.where(after, gaps - near, gaps / 2))


def site_curves(
    edges: Sequence[float], weave: Weave, samples: int, walls: Floats | None = None
) -> tuple[SiteCurve, ...]:
    """The site curve of each edge.

    Parameters
    ----------
    edges
        Directions, ascending.
    weave
        Its weave.
    samples
        Of each curve.
    walls
        As `wall_angles` gives them; by default in the middle of the gaps.
    """
    _, gaps = directions_and_gaps(edges)
    after = gaps / 2 if walls is None else walls
    before = np.roll(gaps - after, 1)
    return tuple(
        SiteCurve(weave, float(angle), float(a), float(b), samples)
        for angle, a, b in zip(edges, after, before, strict=True)
    )


def fitted(
    edges: Sequence[float],
    weave: Weave,
    detail: Detail,
    extra: int = 0,
    keys: Collection[int] = (),
) -> tuple[Lattice, tuple[SiteCurve, ...], Floats]:
    """A joint's lattice, with all corners of its outlines, its site curves and its walls' angles.

    The parameters, and what is raised, are as for `make_joint`.
    """
    at = wall_angles(edges, weave, keys)
    woven = None
    if weave.stretch is not None:
        half = weave.stretch / (2 * weave.ring_ratio)
        woven = [(wall - half, wall + half) for wall in at.tolist()]
    lattice = make_lattice(edges, weave.ring_ratio, detail.cells, extra, woven)
    return lattice, site_curves(edges, weave, detail.samples, at), at


def make_joint(
    edges: Sequence[float],
    weave: Weave,
    detail: Detail,
    extra: int = 0,
    keys: Collection[int] = (),
) -> Joint:
    """Decompose a ring into the connectors of its edges.

    Parameters
    ----------
    edges
        Directions of the edges, ascending, in [0, 2 pi), at least two.  What is alike when
        the joint is turned, or turned over, is computed once.
    weave
        Its weave.
    detail
        How finely.
    extra
        Cells to add to the lattice in each gap; even.  Another lattice cuts the same walls
        elsewhere, which may let them draw back further.
    keys
        Edges whose connectors are to be split; walls may be nearer to them.

    Raises
    ------
    InputError
        Directions that do not ascend.
    FaceError
        A connector does not own all of its tube's face.
    GeometryError
        The ring is too small for its tubes, or the weave makes a connector that falls
        apart, or whose halves hang together.
    """
    lattice, curves, at = fitted(edges, weave, detail, extra, keys)
    # From each edge to the wall after it, and from there to the next edge.
    steps = np.column_stack([at, directions_and_gaps(edges)[1] - at])
    alike = _alike(steps)
    computed = sorted({first for first, _ in alike})
    for edge in computed:
        check_footprint(lattice, curves, edge)
    lattice = without_corners(lattice, corners_in_the_way(lattice, curves))
    far = beside_walls(lattice, curves)
    labels = far.argmin(axis=0)
    walls = list(wedges(lattice, labels))
    corners = sorted({corner for wedge in walls for corner in wedge.corners})
    places = place(lattice, curves, far, corners)
    position: dict[Key, Floats] = dict(zip(corners, places, strict=True))
    walls = merge_short_sides(walls, position, 1 / detail.cells)
    walls = fanned(walls, position, curves)
    pairs = {edge: halves(lattice, labels, walls, position, edge) for edge in computed}
    for edge, (first, _) in pairs.items():
        if _mirrored(steps, 2 * edge):
            pairs[edge] = first, half_turn(first)
    wholes = {edge: simplify(join(*pair, SPLIT)) for edge, pair in pairs.items()}
    turned = {edge: half_turn(whole) for edge, whole in wholes.items()}
    swapped = {edge: (half_turn(b), half_turn(a)) for edge, (a, b) in pairs.items()}
    return Joint(
        lattice.edges,
        weave,
        lattice,
        curves,
        at,
        alike,
        tuple((turned if over else wholes)[edge] for edge, over in alike),
        tuple((swapped if over else pairs)[edge] for edge, over in alike),
    )


def _alike(steps: Floats) -> tuple[tuple[int, bool], ...]:
    """For each edge the first that is alike, and whether it is turned over for it."""
    count = len(steps)
    periods = (n for n in range(1, count + 1) if count % n == 0)
    period = next(n for n in periods if _same(steps, np.roll(steps, n, 0)))
    mirror = next((c for c in range(period) if _mirrored(steps, c)), None)
    symmetry = Symmetry(count, period, mirror)
    return tuple(symmetry.alike(edge) for edge in range(count))


def _mirrored(steps: Floats, mirror: int) -> bool:
    """Whether the joint turned over, edge s where ``mirror - s`` was, is itself."""
    back = (mirror - 1 - np.arange(len(steps))) % len(steps)
    return _same(steps, steps[back, ::-1])


def _same(steps: Floats, others: Floats) -> bool:
    return bool(np.allclose(steps, others, rtol=0, atol=_ALIKE))


def check_footprint(lattice: Lattice, curves: Sequence[Site], edge: int) -> None:
    """Prove that a tube's face belongs to its connector alone.

    Raises
    ------
    FaceError
        It does not: says what share of it does.
    """
    low, high = np.array([lattice.tube_start, -0.5, -0.5]), np.array([lattice.tube_start, 0.5, 0.5])
    if belongs(curves, edge, low, high, margin=0.0):
        return
    grid = np.stack(np.meshgrid(low[:1], *[np.linspace(-0.5, 0.5, 41)] * 2), axis=-1).reshape(-1, 3)
    msg = (
        f"{curves[edge].name}: only {share(curves, edge, grid):.1%} of a tube's face "
        "belongs to its own connector; a smaller span or a smaller bend helps"
    )
    raise FaceError(msg)
