"""One joint: a ring decomposed into connectors, one of which can be split."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from scadgen.errors import GeometryError
from scadgen.joint.curve import SiteCurve
from scadgen.joint.fan import fanned
from scadgen.joint.lattice import Lattice, make_lattice, without_corners
from scadgen.joint.pieces import SPLIT, halves
from scadgen.joint.place import beside_walls, place
from scadgen.joint.site import Site
from scadgen.joint.spokes import Spokes
from scadgen.joint.surface import Surface, half_turn, join, simplify
from scadgen.joint.symmetry import lopsided
from scadgen.joint.territory import belongs, share
from scadgen.joint.tidy import corners_in_the_way, merge_short_sides
from scadgen.joint.walls import Feature, wedges
from scadgen.joint.weave import SLOPED_ROOM, Weave
from scadgen.solid.affine import Floats

__all__ = [
    "DETAILS",
    "Decomposition",
    "Detail",
    "FaceError",
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


#: The levels of detail by name.
DETAILS: Mapping[str, Detail] = MappingProxyType(
    {"draft": Detail(60, 5), "standard": Detail(120, 9), "fine": Detail(240, 17)}
)


@dataclass(frozen=True, slots=True, eq=False)
class Decomposition:
    """A joint's pieces, in sides.

    Parameters
    ----------
    spokes
        Its edges.
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

    spokes: Spokes
    weave: Weave
    lattice: Lattice
    curves: tuple[SiteCurve, ...]
    walls: Floats
    alike: tuple[tuple[int, bool], ...]
    connectors: tuple[Surface, ...]
    halves: tuple[tuple[Surface, Surface], ...]


def wall_angles(spokes: Spokes, weave: Weave, keys: Collection[int]) -> Floats:
    """Angle from each edge to the wall after it, ``(k,)``.

    Where the arms of a weave weave in a stretch, a wall beside a key is as near to it as that
    allows, so that halves come out the same way whatever the gap; where neither edge has a better
    claim it may be beside the first (see `lopsided`).  All others are in the middle of their gaps,
    as are all walls of other weaves.
    """
    gaps = spokes.gaps
    if weave.stretch is None:
        return gaps / 2
    room = SLOPED_ROOM if spokes.slopes.any() else 1.0
    near = np.minimum(room * weave.stretch / (2 * weave.ring_ratio), gaps / 2)
    here = np.isin(np.arange(len(gaps)), list(keys))
    after = np.roll(here, -1)
    first = here | lopsided(gaps, keys)
    return np.where(first, near, np.where(after, gaps - near, gaps / 2))


def site_curves(
    spokes: Spokes, weave: Weave, samples: int, walls: Floats | None = None
) -> tuple[SiteCurve, ...]:
    """The site curve of each edge.

    Parameters
    ----------
    spokes
        The joint's edges; their slopes make no difference.
    weave
        Its weave.
    samples
        Of each curve.
    walls
        As `wall_angles` gives them; by default in the middle of the gaps.
    """
    after = spokes.gaps / 2 if walls is None else walls
    before = np.roll(spokes.gaps - after, 1)
    return tuple(
        SiteCurve(weave, float(angle), float(a), float(b), samples)
        for angle, a, b in zip(spokes.azimuths, after, before, strict=True)
    )


def fitted(
    spokes: Spokes,
    weave: Weave,
    detail: Detail,
    extra: int = 0,
    keys: Collection[int] = (),
) -> tuple[Lattice, tuple[SiteCurve, ...], Floats]:
    """A joint's lattice, with all corners of its outlines, its site curves and its walls' angles.

    The parameters, and what is raised, are as for `make_joint`.
    """
    at = wall_angles(spokes, weave, keys)
    woven = None
    if weave.stretch is not None:
        half = weave.stretch / (2 * weave.ring_ratio)
        woven = [(wall - half, wall + half) for wall in at.tolist()]
    lattice = make_lattice(spokes, weave.ring_ratio, detail.cells, extra, woven)
    return lattice, site_curves(spokes, weave, detail.samples, at), at


def make_joint(
    spokes: Spokes,
    weave: Weave,
    detail: Detail,
    extra: int = 0,
    keys: Collection[int] = (),
) -> Decomposition:
    """Decompose a ring into the connectors of its edges.

    Parameters
    ----------
    spokes
        Its edges.  What is alike when the joint is turned, or turned over, is computed once.
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
    FaceError
        A connector does not own all of its tube's face.
    GeometryError
        The ring is too small for its tubes, or the weave makes a connector that falls
        apart, or whose halves hang together.
    """
    lattice, curves, at = fitted(spokes, weave, detail, extra, keys)
    symmetry = spokes.symmetry(at)
    alike = tuple(symmetry.alike(edge) for edge in range(len(spokes)))
    computed = sorted({first for first, _ in alike})
    for edge in computed:
        check_footprint(lattice, curves, edge)
    lattice = without_corners(lattice, corners_in_the_way(lattice, curves))
    far = beside_walls(lattice, curves)
    labels = far.argmin(axis=0)
    walls = list(wedges(lattice, labels))
    corners = sorted({corner for wedge in walls for corner in wedge.corners})
    places = place(lattice, curves, far, corners)
    position: dict[Feature, Floats] = dict(zip(corners, places, strict=True))
    walls = merge_short_sides(walls, position, 1 / detail.cells, lattice.domain)
    walls = fanned(walls, position, curves, lattice.domain)
    pairs = {edge: halves(lattice, labels, walls, position, edge) for edge in computed}
    for edge, (first, _) in pairs.items():
        if symmetry.either(edge):
            pairs[edge] = first, half_turn(first)
    wholes = {edge: simplify(join(*pair, SPLIT)) for edge, pair in pairs.items()}
    turned = {edge: half_turn(whole) for edge, whole in wholes.items()}
    swapped = {edge: (half_turn(b), half_turn(a)) for edge, (a, b) in pairs.items()}
    return Decomposition(
        spokes,
        weave,
        lattice,
        curves,
        at,
        alike,
        tuple((turned if over else wholes)[edge] for edge, over in alike),
        tuple((swapped if over else pairs)[edge] for edge, over in alike),
    )


def check_footprint(lattice: Lattice, curves: Sequence[Site], edge: int) -> None:
    """Prove that a tube's face belongs to its connector alone.

    Raises
    ------
    FaceError
        It does not: says what share of it does.
    """
    face = lattice.domain.tube_face(edge)
    middle, corner = face.axes @ face.at, np.array([0.0, 0.5, 0.5])
    if belongs(curves, edge, middle - corner, middle + corner, margin=0.0, axes=face.axes):
        return
    grid = np.stack(np.meshgrid([0.0], *[np.linspace(-0.5, 0.5, 41)] * 2), axis=-1).reshape(-1, 3)
    msg = (
        f"{curves[edge].name}: only "
        f"{share(curves, edge, (middle + grid) @ face.axes):.1%} of a tube's face "
        "belongs to its own connector; a smaller span or a smaller bend helps"
    )
    raise FaceError(msg)
