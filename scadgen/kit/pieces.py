"""From directions and a weave to a joint's pieces, its key, and how far all may draw back."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.element.ends import connector
from scadgen.element.pieces import Piece, half
from scadgen.element.squares import Key
from scadgen.errors import GeometryError, InvariantError, ScadgenError
from scadgen.joint.joint import (
    DETAILS,
    Decomposition,
    FaceError,
    make_joint,
)
from scadgen.joint.pieces import SPLIT
from scadgen.joint.recede import recede
from scadgen.joint.spokes import Spokes
from scadgen.joint.surface import Surface, half_turn
from scadgen.joint.territory import arm, belongs
from scadgen.joint.weave import Weave
from scadgen.kit.ranges import WALL
from scadgen.solid.affine import AffineSolid
from scadgen.solid.mesh import solid_faults
from scadgen.solid.sweep import safe_share

__all__ = ["Pieces", "best_pieces"]

#: Clearance up to which pieces are tried, that which is enough, and that which must be, in sides.
_TRIED, _ENOUGH, _LEAST = 0.06, 0.042, 0.005

#: Lattices tried for it, by their extra cells in each gap.
_LATTICES = (0, 2, 4, 6, 8)

#: Clearance at which facets are triangulated, in sides: the middle of what is enough.
_REST = 0.02

#: Half widths tried for the window of the holes, in sides, and the depth a socket should have.
_WINDOWS = tuple(n / 100 for n in range(40, 14, -2))
_DEPTH, _LEAST_DEPTH = 0.65, 0.35


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """A joint's connectors and halves, and how far they may draw back.

    Parameters
    ----------
    weave
        The joint's weave.
    key
        What its keys are like.
    connectors
        Of each edge.  In a regular joint they are all the same.  If one is another one turned
        over, it is so to the last digit.
    halves
        Of each edge that is a key's, half A, and half B turned over about its edge, which
        are the same where the joint is alike on both sides of it.
    clearance_limit
        Clearance up to which they are proven sound, in sides.
    holes
        Free width of the ring's hole along each edge, as wide as the window, in sides.
    arm
        Thinnest section of the connectors' arms, in sides.
    volume
        Of the domain, in cubic sides.
    extra
        Extra cells of the lattice.
    """

    weave: Weave
    key: Key
    connectors: tuple[Piece, ...]
    halves: Mapping[int, tuple[Piece, Piece]]
    clearance_limit: float
    holes: tuple[float, ...]
    arm: float
    volume: float
    extra: int

    @property
    def key_hole(self) -> float:
        """Free width of the ring's hole along the keys' edges."""
        return min(self.holes[edge] for edge in self.halves)

    def figures(self) -> dict[str, float]:
        """What is known about them, in sides."""
        return {
            "ring_hole_sides": self.key_hole,
            "clearance_limit_sides": self.clearance_limit,
            "thinnest_arm_sides": self.arm,
            "domain_volume_sides3": self.volume,
            "lattice_extra": float(self.extra),
        }


@dataclass(frozen=True, slots=True, eq=False)
class _Tried:
    """Pieces on one lattice."""

    joint: Decomposition
    key: Key
    connectors: tuple[Piece, ...]
    halves: Mapping[int, tuple[Piece, Piece]]
    limit: float
    extra: int

    def pieces(self) -> Pieces:
        """The pieces with all that is to be known about them."""
        made = self.joint
        edges = sorted({edge for edge, _ in made.alike})
        return Pieces(
            weave=made.weave,
            key=self.key,
            connectors=self.connectors,
            halves=self.halves,
            clearance_limit=self.limit,
            holes=tuple(self._hole(edge) for edge in range(len(made.spokes))),
            arm=min(arm(made.lattice, made.curves, edge, made.walls) for edge in edges),
            volume=made.lattice.domain.volume(),
            extra=self.extra,
        )

    def _hole(self, edge: int) -> float:
        outline = self.joint.lattice.nodes[:, 0, 0, :2]
        turn = float(self.joint.spokes.azimuths[edge])
        c, s = math.cos(turn), math.sin(turn)
        outline = outline @ np.array([[c, -s], [s, c]])
        ends = np.roll(outline, -1, axis=0)
        share = np.linspace(0, 1, 9)[:, None, None]
        points = (outline + share * (ends - outline)).reshape(-1, 2)
        ahead = (points[:, 0] < 0) & (np.abs(points[:, 1]) <= self.key.window + 0.05)
        return float(self.key.pad + np.abs(points[ahead, 0]).min())


def best_pieces(
    directions: Sequence[float],
    weave: Weave,
    style: str,
    level: str,
    keys: Sequence[int] = (0,),
    *,
    bored: bool,
) -> Pieces:
    """Make pieces on the first lattice that lets them draw back enough, or else the furthest.

    Parameters
    ----------
    directions
        Of the edges, ascending, in [0, 2 pi).
    weave
        The weave.
    style
        One of `KEYS`.
    level
        Name of the detail level.
    keys
        Which edges' connectors are split.
    bored
        Whether a bore runs along the edges.

    Raises
    ------
    GeometryError
        The weave makes no sound pieces: says why, of the first lattice.
    """
    best: _Tried | None = None
    refusal: ScadgenError | None = None
    for extra in _LATTICES:
        try:
            made = make_joint(Spokes.flat(directions), weave, DETAILS[level], extra, keys)
            found = _tried(made, style, extra, keys, bored=bored)
        except FaceError:
            raise
        except (GeometryError, InvariantError) as error:
            refusal = refusal or error
            continue
        if best is None or found.limit > best.limit:
            best = found
        if found.limit >= _ENOUGH:
            break
    if best is not None and best.limit >= _LEAST:
        return best.pieces()
    if isinstance(refusal, GeometryError):
        raise refusal
    msg = (
        f"weave {weave.name}: its walls meet the ring's faces at too flat an angle "
        "to leave any clearance; another amplitude, bend or span helps"
    )
    raise GeometryError(msg)


def _tried(
    made: Decomposition, style: str, extra: int, keys: Sequence[int], *, bored: bool
) -> _Tried:
    """The pieces of a joint, and the clearance up to which they are sound."""
    key = _key(made, style, keys, bored=bored)
    firsts = sorted({edge for edge, _ in made.alike})
    over = {edge: _turned_over(*made.halves[edge]) for edge in {made.alike[n][0] for n in keys}}
    split = list(dict.fromkeys(itertools.chain(*over.values())))
    surfaces = [
        *((made.connectors[edge], ()) for edge in firsts),
        *((surface, (SPLIT,)) for surface in split),
    ]
    piece = {
        surface: Piece(surface, displacement, _REST)
        for (surface, _), displacement in zip(surfaces, recede(surfaces), strict=True)
    }
    wholes = {edge: piece[made.connectors[edge]] for edge in firsts}
    turned = {edge: whole.turned_over() for edge, whole in wholes.items()}
    connectors = tuple((turned if flip else wholes)[edge] for edge, flip in made.alike)
    halves = {}
    for edge in keys:
        first, flip = made.alike[edge]
        half_a, half_b = (piece[surface] for surface in over[first])
        halves[edge] = (half_b, half_a) if flip else (half_a, half_b)
    solids = itertools.chain(
        (connector(key, whole) for whole in wholes.values()),
        (half(key, piece[surface]) for surface in split),
    )
    limit = _TRIED
    for solid in solids:
        limit = min(limit, _limit(solid, key))
        if limit < _LEAST:
            break
    return _Tried(made, key, connectors, halves, math.floor(limit * 1e3) / 1e3, extra)


def _turned_over(first: Surface, second: Surface) -> tuple[Surface, Surface]:
    """Half A, and half B turned over, which is half A where they are alike.

    What draws back is then the same: the split, and the walls that both have.
    """
    over = half_turn(second)
    return first, over if first.match(over) is None else first


def _limit(solid: AffineSolid, key: Key) -> float:
    """Clearance, in sides, up to which a solid is proven sound.

    Its holes are as wide and as deep as their ranges allow, so that what draws back without
    touching them touches no smaller ones either.
    """
    width = 2 * (key.window - WALL)
    values = {"side": 1.0, "edge_length": 6.0, "clearance": 0.0, "peg_clearance": 0.0}
    values |= {"peg_width": width, "peg_length": key.depth - 2 * WALL, "bore": width - 4 * WALL}
    values["peg_chamfer"] = 0.01
    start = solid.points(values)
    faults = solid_faults(solid.points({**values, "clearance": _LEAST}), solid.triangles)
    if faults:
        return 0.0
    way = solid.points({**values, "clearance": _TRIED}) - start
    return _TRIED * safe_share(start, way, solid.triangles, solid.facets)


def _key(made: Decomposition, style: str, keys: Sequence[int], *, bored: bool) -> Key:
    """The window in which a socket has room inside each connector that is split.

    Raises
    ------
    GeometryError
        There is none.
    """
    domain = made.lattice.domain
    start, (pad, half_width) = float(domain.flats.distance[0]), domain.pad(0)
    through = bored or style == "loose"
    best = (0.0, 0.0)
    for depth, window in _windows(start - pad, half_width, through=through):
        if best[0] >= _DEPTH or (depth, window) <= best:
            continue
        low = np.array([start - depth, -window, -window])
        high = np.array([start, window, window])
        if all(belongs(made.curves, edge, low, high, margin=WALL) for edge in keys):
            best = depth, window
    depth, window = best
    if not depth:
        msg = (
            f"weave {made.weave.name}: no room for a peg's socket beside the connector's walls; "
            "a larger ring ratio or a smaller span helps"
        )
        raise GeometryError(msg)
    return Key(style, bored, start, pad, window, depth)


def _windows(thick: float, pad: float, *, through: bool) -> Iterator[tuple[float, float]]:
    """Depths and half widths to try, the widest first, and of those the deepest."""
    for window in _WINDOWS:
        if not through:
            yield from (
                (float(d), window) for d in np.arange(thick - 2 * WALL, _LEAST_DEPTH, -0.05)
            )
        elif window <= pad - WALL / 2:
            yield thick, window
