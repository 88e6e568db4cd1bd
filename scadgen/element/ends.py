"""Edge elements: two ends, and a tube between them.

An `End` is what stands at one end of an edge: a connector, a peg, a socket, or nothing but a
flat face.  It is an open surface, with the joint at the origin and the edge along +x, that
ends in a square rim; a part is two ends whose rims are joined by the four sides of a tube.
In a bored kit it has a second rim, for the bore that runs along every edge from ring hole
to ring hole.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass

from scadgen.element.pieces import Piece, add_facet, add_surface, corners_of
from scadgen.element.squares import Key, Length, closed, face, square, walls
from scadgen.joint.pieces import PAD, TUBE
from scadgen.solid.affine import AffineSolid
from scadgen.solid.shell import Shell

__all__ = ["CAP", "End", "connector", "connector_end", "flat_end", "key_end", "part", "peg"]

#: Length of the cap that a fixed peg stands on as a loose part, in sides.
CAP = 0.25

_SIDES: tuple[Hashable, ...] = ("bottom", "left", "top", "right")


@dataclass(frozen=True, slots=True, eq=False)
class End:
    """One end of an edge.

    Parameters
    ----------
    shell
        Its surface, open at the rims.
    rim
        The four corners where the tube's sides start.
    bore
        The four corners where the bore's sides start, in a bored kit.
    """

    shell: Shell
    rim: tuple[int, ...]
    bore: tuple[int, ...] | None


def flat_end(key: Key, x: Length) -> End:
    """A flat face across the edge, with the bore in it."""
    shell = Shell()
    rim = square(shell, x, {"side": 0.5})
    bore = square(shell, x, {"bore": 0.5}) if key.bored else None
    face(shell, rim, bore, "end")
    return End(shell, rim, bore)


def key_end(key: Key) -> End:
    """A tube's end at a key: the peg, or the socket of a loose one."""
    shell = Shell()
    start: Length = {"side": key.tube_start, "clearance": 1.0}
    rim = square(shell, start, {"side": 0.5})
    if key.style == "fixed":
        foot = square(shell, start, {"peg_width": 0.5})
        tip, bore = _tip(shell, key, key.tip)
        walls(shell, [*tip, foot], "peg", hole=False)
        face(shell, rim, foot, "end")
        return End(shell, rim, bore)
    mouth, floor = square(shell, start, key.socket), square(shell, key.bottom, key.socket)
    face(shell, rim, mouth, "end")
    walls(shell, [mouth, floor], "socket", hole=True)
    bore = square(shell, key.bottom, {"bore": 0.5}) if key.bored else None
    face(shell, floor, bore, "floor")
    return End(shell, rim, bore)


def _tip(shell: Shell, key: Key, x: Length) -> tuple[list[tuple[int, ...]], tuple[int, ...] | None]:
    """A peg's tip with its lead-in: two squares towards +x, and the bore's if there is one."""
    tip = square(shell, x, {"peg_width": 0.5, "peg_chamfer": -1.0})
    shoulder = square(shell, {**x, "peg_chamfer": 1.0}, {"peg_width": 0.5})
    bore = square(shell, x, {"bore": 0.5}) if key.bored else None
    face(shell, tip, bore, "tip")
    return [tip, shoulder], bore


def connector_end(key: Key, piece: Piece) -> End:
    """A connector, open where its tube starts."""
    shell = Shell()
    rim = corners_of(piece.surface, TUBE)
    if not key.bored:
        add_surface(shell, piece, {TUBE})
        return End(shell, rim, None)
    add_surface(shell, piece, {TUBE, PAD})
    window = square(shell, {"side": key.pad}, {"side": key.window})
    bore = square(shell, {"side": key.pad}, {"bore": 0.5})
    add_facet(shell, piece, PAD, [*piece.surface.loops(PAD), window])
    face(shell, window, bore, "pad")
    return End(shell, rim, bore)


def part(name: str, near: End, far: End, length: Length) -> AffineSolid:
    """A part of two ends, the far one turned about, with a tube in between.

    Parameters
    ----------
    name
        Its name.
    near, far
        Its ends.
    length
        Where the far end's origin is along x.
    """
    shell = Shell()
    shell.add(near.shell)
    first = shell.add(far.shell, {p: (f, 0.0, 0.0) for p, f in length.items()})
    shell.band(closed(near.rim), closed(_facing(far.rim, first)), _SIDES)
    if near.bore is not None and far.bore is not None:
        facets = [("bore", side) for side in _SIDES]
        shell.band(closed(_facing(far.bore, first)), closed(near.bore), facets)
    return shell.solid(name)


def _facing(rim: tuple[int, ...], first: int) -> tuple[int, ...]:
    """The corners of a turned end's rim in the order of the rim it faces."""
    return tuple(rim[n] + first for n in (1, 0, 3, 2))


def connector(key: Key, piece: Piece) -> AffineSolid:
    """The loose part ``connector``: it ends where its tube would start."""
    end = connector_end(key, piece)
    if end.bore is None:
        end.shell.polygon(end.rim, TUBE)
    else:
        mouth = square(end.shell, {"side": key.tube_start}, {"bore": 0.5})
        walls(end.shell, [end.bore, mouth], "bore", hole=True)
        end.shell.band(closed(end.rim), closed(mouth), [TUBE] * 4)
    return end.shell.solid("connector")


def peg(key: Key) -> AffineSolid:
    """The loose part ``peg``: a loose key, or a fixed peg on a cap for the frame's rim."""
    if key.style == "fixed":
        cap: Length = {"side": key.tube_start + CAP, "clearance": 1.0}
        return part("peg", key_end(key), flat_end(key, {}), cap)
    shell = Shell()
    (tip, shoulder), bore = _tip(shell, key, {"side": key.pad})
    walls(shell, [tip, shoulder], "lead", hole=False)
    end = End(shell, shoulder, bore)
    return part("peg", end, end, {"side": 2 * key.pad, "peg_length": 1.0})
