"""From a request to a kit: the joint, its pieces, the parts, their ranges."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np

from scadgen.element.ends import connector, connector_end, flat_end, key_end, part, peg
from scadgen.element.pieces import Piece, half
from scadgen.element.squares import Key
from scadgen.errors import GeometryError, InputError, InvariantError, ScadgenError
from scadgen.frame.layout import LAYOUTS, joint
from scadgen.frame.placement import KEYS
from scadgen.joint.joint import DETAILS, Joint, check_footprint, make_joint, site_curves
from scadgen.joint.lattice import make_lattice
from scadgen.joint.pieces import SPLIT
from scadgen.joint.recede import recede
from scadgen.joint.territory import arm, belongs
from scadgen.joint.weave import Weave, built_in
from scadgen.kit.model import Kit
from scadgen.kit.ranges import WALL, check_values, ranges
from scadgen.solid.affine import PARAMETERS, AffineSolid, Range
from scadgen.solid.mesh import solid_faults
from scadgen.solid.sweep import safe_share

__all__ = ["VALENCE", "Request", "build", "build_joint"]

#: Edges at each vertex of the frames.
VALENCE: Mapping[str, int] = MappingProxyType({"hexagonal": 3, "square": 4})

#: Clearance up to which pieces are tried, that which is enough, and that which must be, in sides.
_TRIED, _ENOUGH, _LEAST = 0.06, 0.042, 0.005

#: Above every range, in mm, so that no sum of lengths leaves the numbers there are.
_LONGEST = 1e6

#: Lattices tried for it, by their extra cells in each gap.
_LATTICES = (0, 2, 4, 6, 8)

#: Clearance at which facets are triangulated, in sides: the middle of what is enough.
_REST = 0.02

#: Half widths tried for the window of the holes, in sides, and the depth a socket should have.
_WINDOWS = tuple(n / 100 for n in range(40, 14, -2))
_DEPTH, _LEAST_DEPTH = 0.65, 0.35


@dataclass(frozen=True, slots=True)
class Request:
    """What kit to make.

    Parameters
    ----------
    frame
        ``hexagonal`` or ``square``.
    key
        ``fixed`` or ``loose``.
    rows, columns
        Cells of the frame.
    detail
        Name of a level of `DETAILS`.
    weave
        The weave; by default the built-in one for the frame's joints and the key style.
    values
        Live parameters, in mm; those not given follow from the side.  A bore above zero
        makes a bored kit.
    command
        The command line that makes this kit again.

    Raises
    ------
    InputError
        A name or a count that does not exist.
    """

    frame: str
    key: str = "fixed"
    rows: int = 2
    columns: int = 2
    detail: str = "standard"
    weave: Weave | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    command: str = ""

    def __post_init__(self) -> None:
        """Refuse names that do not exist."""
        for name, value, known in (
            ("frame", self.frame, VALENCE),
            ("key", self.key, KEYS),
            ("detail", self.detail, DETAILS),
        ):
            if value not in known:
                msg = f"{name} = {value!r}: must be one of {', '.join(known)}"
                raise InputError(msg)
        for name in self.values:
            if name not in PARAMETERS:
                msg = f"{name}: not a live parameter; must be one of {', '.join(PARAMETERS)}"
                raise InputError(msg)
        LAYOUTS[self.frame](self.rows, self.columns, self.key)

    @property
    def chosen_weave(self) -> Weave:
        """The weave given, or the built-in one."""
        return self.weave or built_in(self.valence, self.key)

    @property
    def valence(self) -> int:
        """Edges at each vertex."""
        return VALENCE[self.frame]


def build(request: Request) -> Kit:
    """Make a kit.

    Raises
    ------
    InputError
        A live parameter outside its range.
    GeometryError
        The weave makes no sound pieces.
    """
    for name, value in request.values.items():
        if not 0 <= value <= _LONGEST:
            msg = f"{name} = {value:g} mm: must be a number from 0 to {_LONGEST:g}"
            raise InputError(msg)
    weave = request.chosen_weave
    bored = request.values.get("bore", 0.0) > 0
    pieces = _best_pieces(request.valence, weave, request.key, request.detail, bored=bored)
    return _kit(pieces, request)


def build_joint(valence: int, weave: Weave, key: str, detail: str) -> Kit:
    """Make the kit of a single regular joint.

    Its frame is called ``joint`` and has no layout: such a kit is there to be judged.

    Parameters
    ----------
    valence
        Number of edges, at least 2.
    weave, key, detail
        As for `Request`.

    Raises
    ------
    GeometryError
        The weave makes no sound pieces.
    """
    request = Request("hexagonal", key, 1, 1, detail, weave)
    pieces = _best_pieces(valence, weave, key, detail, bored=False)
    return replace(_kit(pieces, request), frame="joint")


def _kit(pieces: _Pieces, request: Request) -> Kit:
    """All of a kit, from its pieces."""
    limits = ranges(pieces.key, pieces.clearance_limit, pieces.hole)
    # All other defaults are shares of the side.
    check_values([r for r in limits if r.parameter == "side"], {"side": 10.0, **request.values})
    values = _values(request, pieces, limits)
    check_values(limits, values)
    return Kit(
        frame=request.frame,
        key=request.key,
        rows=request.rows,
        columns=request.columns,
        detail=request.detail,
        weave=request.chosen_weave.as_dict(),
        command=request.command,
        values=values,
        ranges=limits,
        parts=_parts(pieces),
        joint=joint(len(pieces.joint.edges), request.key),
        figures=_figures(pieces),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Pieces:
    """A joint's connector and half, and how far they may draw back."""

    joint: Joint
    key: Key
    connector: Piece
    half: Piece
    clearance_limit: float
    extra: int

    @property
    def hole(self) -> float:
        """Free width of the ring's hole along the key's edge, as wide as the window."""
        outline = self.joint.lattice.nodes[:, 0, 0, :2]
        ends = np.roll(outline, -1, axis=0)
        share = np.linspace(0, 1, 9)[:, None, None]
        points = (outline + share * (ends - outline)).reshape(-1, 2)
        ahead = (points[:, 0] < 0) & (np.abs(points[:, 1]) <= self.key.window + 0.05)
        return float(self.key.pad + np.abs(points[ahead, 0]).min())


def _best_pieces(valence: int, weave: Weave, style: str, level: str, *, bored: bool) -> _Pieces:
    """Pieces on the first lattice that lets them draw back enough, or else the furthest."""
    edges, detail = [2 * math.pi * n / valence for n in range(valence)], DETAILS[level]
    probe = make_lattice(edges, weave.ring_ratio, detail.cells)
    check_footprint(probe, site_curves(probe.edges, weave, detail.samples), 0)
    best: _Pieces | None = None
    refusal: ScadgenError | None = None
    for extra in _LATTICES:
        try:
            made = make_joint(edges, weave, detail, extra)
            found = _pieces(made, style, extra, bored=bored)
        except (GeometryError, InvariantError) as error:
            refusal = refusal or error
            continue
        if best is None or found.clearance_limit > best.clearance_limit:
            best = found
        if found.clearance_limit >= _ENOUGH:
            break
    if best is not None and best.clearance_limit >= _LEAST:
        return best
    if isinstance(refusal, GeometryError):
        raise refusal
    msg = (
        f"weave {weave.name}: its walls meet the ring's faces at too flat an angle "
        "to leave any clearance; another amplitude, bend or span helps"
    )
    raise GeometryError(msg)


def _pieces(made: Joint, style: str, extra: int, *, bored: bool) -> _Pieces:
    """The pieces of a joint, and the clearance up to which they are sound."""
    key = _key(made, style, bored=bored)
    whole, first = made.connectors[0], made.halves[0][0]
    whole_piece = Piece(whole, recede(whole, ()), _REST)
    half_piece = Piece(first, recede(first, (SPLIT,)), _REST)
    limit = min(_limit(connector(key, whole_piece), key), _limit(half(key, half_piece), key))
    return _Pieces(made, key, whole_piece, half_piece, math.floor(limit * 1e3) / 1e3, extra)


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


def _key(made: Joint, style: str, *, bored: bool) -> Key:
    """The window in which a socket has room inside its connector.

    Raises
    ------
    GeometryError
        There is none.
    """
    lattice = made.lattice
    start, pad = lattice.tube_start, lattice.pad
    through = bored or style == "loose"
    best = (0.0, 0.0)
    for window in _WINDOWS:
        if through and window > lattice.pad_half_width - WALL / 2:
            continue
        depths = (
            [start - pad] if through else np.arange(start - pad - 2 * WALL, _LEAST_DEPTH, -0.05)
        )
        for depth in depths:
            low = np.array([start - depth, -window, -window])
            high = np.array([start, window, window])
            if belongs(made.curves, 0, low, high, margin=WALL):
                best = max(best, (float(depth), window))
                break
        if best[0] >= _DEPTH:
            break
    depth, window = best
    if not depth:
        msg = (
            f"weave {made.weave.name}: no room for a peg's socket beside the connector's walls; "
            "a larger ring ratio or a smaller span helps"
        )
        raise GeometryError(msg)
    return Key(style, bored, start, pad, window, depth)


def _values(request: Request, pieces: _Pieces, limits: Iterable[Range]) -> dict[str, float]:
    """All live parameters: those given, and the others by the side."""
    side = request.values.get("side", 10.0)
    clearance = request.values.get("clearance", 0.2)
    gap = request.values.get("peg_clearance", clearance)
    key = pieces.key
    width = min(0.4 * side, 2 * (key.window - WALL) * side - 2 * gap)
    if key.style == "fixed":
        length = min(0.6 * side, (key.depth - WALL) * side - gap)
    else:
        through = (key.tube_start - key.pad + 0.35) * side + clearance
        length = min(through, (pieces.hole - WALL) * side - 2 * gap)
    values = {
        "side": side,
        "edge_length": max(6, math.ceil(2 * key.tube_start + 1.5)) * side,
        "clearance": clearance,
        "peg_width": math.floor(10 * width) / 10,
        "peg_length": math.floor(10 * length) / 10,
        "peg_clearance": gap,
        "peg_chamfer": 0.05 * side,
    }
    values |= {name: v for name, v in request.values.items() if name != "bore" or v > 0}
    if "edge_length" not in request.values:
        least = max(r.low(values) for r in limits if r.parameter == "edge_length")
        values["edge_length"] = max(6, math.ceil(least / side + 0.9)) * side
    return values


def _parts(pieces: _Pieces) -> dict[str, AffineSolid]:
    """Every printed part."""
    key = pieces.key
    joined, keyed = connector_end(key, pieces.connector), key_end(key)
    flat = flat_end(key, {"side": key.tube_start, "clearance": 1.0})
    length = {"edge_length": 1.0}
    solids = (
        part("basic", joined, joined, length),
        part("one_sided", joined, keyed, length),
        part("two_sided", keyed, keyed, length),
        connector(key, pieces.connector),
        half(key, pieces.half),
        peg(key),
        part("tube", flat, flat, length),
    )
    return {solid.name: solid for solid in solids}


def _figures(pieces: _Pieces) -> dict[str, float]:
    """What is known about a kit's pieces, in sides."""
    made, key = pieces.joint, pieces.key
    return {
        "tube_start_sides": key.tube_start,
        "pad_sides": key.pad,
        "ring_hole_sides": pieces.hole,
        "window_half_width_sides": key.window,
        "window_depth_sides": key.depth,
        "clearance_limit_sides": pieces.clearance_limit,
        "thinnest_arm_sides": arm(made.lattice, made.curves, 0),
        "domain_volume_sides3": made.lattice.volume(),
        "lattice_extra": float(pieces.extra),
    }
