"""Connectors and halves as solids: the joint's surfaces with their clearance and holes."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.element.squares import Key, Length, chain, vertex
from scadgen.errors import InvariantError
from scadgen.joint.pieces import PAD, SPLIT, TUBE
from scadgen.joint.surface import Surface, half_turn
from scadgen.joint.walls import Facet
from scadgen.solid.affine import AffineSolid, Floats
from scadgen.solid.planar import triangulate
from scadgen.solid.shell import Shell

__all__ = ["Piece", "add_facet", "add_surface", "corners_of", "half"]

#: Displacements are the same within this share of the clearance, which is a twentieth of a side or
#: less: so points stay within some millionths of a side, as those of surfaces that match.
_ALIKE = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A connector or a half, as a part is made from it.

    Parameters
    ----------
    surface
        Its surface, in sides.
    displacement
        ``(v, 3) float``: how each vertex moves per unit of its share of the clearance.
    rest
        Clearance, in sides, at which its facets are triangulated.
    """

    surface: Surface
    displacement: Floats
    rest: float

    def is_like(self, other: Piece) -> bool:
        """Whether it is the same part at any clearance, however it is numbered."""
        match = self.surface.match(other.surface)
        return match is not None and bool(
            np.allclose(self.displacement, other.displacement[match], rtol=0, atol=_ALIKE)
        )

    def turned_over(self) -> Piece:
        """The same after a half turn about its edge."""
        way = np.array([1.0, -1.0, -1.0])
        return Piece(half_turn(self.surface), self.displacement * way, self.rest)


def add_surface(shell: Shell, piece: Piece, left_out: Collection[Facet]) -> None:
    """Add a piece's walls and facets to an empty shell, so that it keeps its numbering."""
    shell.vertices({"side": piece.surface.points, "clearance": piece.displacement / 2})
    shell.triangles(piece.surface.walls)
    kept = [facet for facet in piece.surface.outlines if facet not in left_out]
    _add_facets(shell, piece, {facet: piece.surface.loops(facet) for facet in kept})


def add_facet(shell: Shell, piece: Piece, facet: Facet, loops: Sequence[Sequence[int]]) -> None:
    """Add a facet of a piece, by its outlines in the shell's numbering."""
    _add_facets(shell, piece, {facet: loops})


def _add_facets(
    shell: Shell, piece: Piece, facets: Mapping[Facet, Sequence[Sequence[int]]]
) -> None:
    used = sorted({v for loops in facets.values() for loop in loops for v in loop})
    local = {v: n for n, v in enumerate(used)}
    place = shell.points(used, {"side": 1.0, "clearance": piece.rest})
    outlines = [[[local[v] for v in loop] for loop in loops] for loops in facets.values()]
    for facet, triangles in zip(facets, triangulate(place, outlines), strict=True):
        corners = np.array(used)[triangles]
        shell.triangles(corners, facet[0] if facet[0] in ("top", "bottom") else facet)


def half(key: Key, piece: Piece) -> AffineSolid:
    """The part ``half``: half A with its side of the socket."""
    shell = Shell()
    add_surface(shell, piece, {TUBE, SPLIT, *([PAD] if key.through else [])})
    mouth: Length = {"side": key.tube_start}
    stations: list[tuple[Length, Length]] = [(mouth, key.socket)]
    if key.style == "fixed":
        stations.append((key.bottom, key.socket))
        if key.bored:
            stations.append((key.bottom, {"bore": 0.5}))
    if key.through:
        stations.append(({"side": key.pad}, stations[-1][1]))
    channel = [chain(shell, x, width) for x, width in stations]
    for n, (near, deep) in enumerate(itertools.pairwise(channel)):
        shell.band(deep, near, [("socket", n, side) for side in range(3)])
    window = chain(shell, mouth, {"side": key.window})
    shell.band(channel[0], window, [TUBE] * 3)
    add_facet(shell, piece, TUBE, [_notched(piece.surface, TUBE, SPLIT, window)])
    if key.through:
        _split_through(shell, piece, key, channel, window)
    else:
        _split_blind(shell, piece, key, channel, window)
    return shell.solid("half")


def _split_blind(
    shell: Shell,
    piece: Piece,
    key: Key,
    channel: Sequence[tuple[int, ...]],
    window: tuple[int, ...],
) -> None:
    """The floor of a socket that ends in the half, and the split face around it."""
    shell.polygon(channel[-1][::-1], "floor")
    deep = {"side": key.tube_start - key.depth}
    top, bottom = (
        vertex(shell, deep, {"clearance": 0.5}, {"side": sign * key.window}) for sign in (1, -1)
    )
    outer = (window[0], top, bottom, window[3])
    inner = (channel[0][0], channel[1][0], channel[1][3], channel[0][3])
    shell.band(outer, inner, [SPLIT] * 3)
    add_facet(shell, piece, SPLIT, [_notched(piece.surface, SPLIT, TUBE, outer)])


def _split_through(
    shell: Shell,
    piece: Piece,
    key: Key,
    channel: Sequence[tuple[int, ...]],
    window: tuple[int, ...],
) -> None:
    """The inner flat around a hole right through, and the split face above and below it."""
    pad = chain(shell, {"side": key.pad}, {"side": key.window})
    shell.band(pad, channel[-1], [PAD] * 3)
    add_facet(shell, piece, PAD, [_notched(piece.surface, PAD, SPLIT, pad)])
    for end, turn in ((0, 1), (3, -1)):
        line = [square[end] for square in channel]
        shell.polygon((window[end], line[1], line[0])[::turn], SPLIT)
        for a, b in itertools.pairwise((window[end], *line[1:])):
            if a == window[end]:
                shell.polygon((window[end], pad[end], b)[::turn], SPLIT)
            else:
                shell.polygon((pad[end], b, a)[::turn], SPLIT)
    loop = _from_side(piece.surface, SPLIT, TUBE, key.window)
    other = _from_side(piece.surface, SPLIT, PAD, key.window)
    cut = loop.index(other[-1])
    upper, lower = loop[: cut + 1], loop[cut + 1 :]
    add_facet(shell, piece, SPLIT, [[*upper, pad[0], window[0]]])
    add_facet(shell, piece, SPLIT, [[*lower, window[3], pad[3]]])


def _from_side(surface: Surface, facet: Facet, beside: Facet, window: float) -> list[int]:
    """A facet's outline from the end of the side it shares with another, around to its start.

    The side is the one that the window reaches from top to bottom.
    """
    shared = {frozenset(side) for side in surface.outlines[beside].tolist()}
    loops = surface.loops(facet)
    for loop in loops:
        for n, ends in enumerate(zip(loop, loop[1:] + loop[:1], strict=True)):
            low, high = sorted(surface.points[list(ends), 2])
            if frozenset(ends) in shared and low < -window and high > window and len(loops) == 1:
                return [*loop[n + 1 :], *loop[: n + 1]]
    msg = f"facet {facet} has one outline, with a whole side on facet {beside}"
    raise InvariantError(msg)


def _notched(surface: Surface, facet: Facet, beside: Facet, window: tuple[int, ...]) -> list[int]:
    """A facet's outline with a window's chain, from top to bottom, put into a side."""
    loop = _from_side(surface, facet, beside, 0.0)
    upwards = surface.points[loop[0], 2] > surface.points[loop[-1], 2]
    return [*loop, *(window[::-1] if upwards else window)]


def corners_of(surface: Surface, facet: Facet) -> tuple[int, ...]:
    """The four corners of a square facet across the edge, counter-clockwise seen along -x."""
    loops = surface.loops(facet)
    corner = {
        tuple(np.sign(surface.points[v, 1:]).astype(int).tolist()): v
        for loop in loops
        for v in loop
    }
    found = tuple(corner.get(signs, -1) for signs in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    if len(loops) != 1 or len(loops[0]) != 4 or -1 in found:
        msg = f"facet {facet} is a square"
        raise InvariantError(msg)
    return found
