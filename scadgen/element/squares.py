"""Squares across an edge: all that a tube, a peg, a socket and a bore are made of.

Everything along an edge is square to it, so it is made of squares at stations: a position
along x and a half width, both linear in the live parameters.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from scadgen.solid.shell import Shell

__all__ = ["Key", "Length", "chain", "closed", "face", "square", "vertex", "walls"]

#: A length: its factors of the live parameters.
Length = Mapping[str, float]

#: Corners of a square across the edge, counter-clockwise seen along -x: signs of y and z.
_CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))


@dataclass(frozen=True, slots=True)
class Key:
    """What the key of a joint is like.

    Parameters
    ----------
    style
        ``fixed`` or ``loose``.
    bored
        Whether a bore runs along the edges.
    tube_start, pad
        Distances of the outer and inner flats from the ring's axis, in sides.
    window
        Half width of the square window in the flats in which all holes stay, in sides.
    depth
        How far the window goes along the split, from the tube inwards, in sides; unused
        where the hole goes right through.
    """

    style: str
    bored: bool
    tube_start: float
    pad: float
    window: float
    depth: float

    @property
    def through(self) -> bool:
        """Whether the halves have a hole right through."""
        return self.bored or self.style == "loose"

    @property
    def socket(self) -> Length:
        """Half width of the socket."""
        return {"peg_width": 0.5, "peg_clearance": 1.0}

    @property
    def tip(self) -> Length:
        """Where a fixed peg ends."""
        return {"side": self.tube_start, "peg_length": -1.0}

    @property
    def bottom(self) -> Length:
        """Where a socket ends: in the halves for a fixed peg, in the tube for a loose one."""
        if self.style == "fixed":
            return {**self.tip, "peg_clearance": -1.0}
        return {"side": self.pad, "peg_length": 1.0, "peg_clearance": 1.0}


def vertex(shell: Shell, x: Length, y: Length, z: Length) -> int:
    """Add a vertex by its three coordinates; its number."""
    names = {*x, *y, *z}
    return shell.vertex(**{n: (x.get(n, 0.0), y.get(n, 0.0), z.get(n, 0.0)) for n in names})


def _times(length: Length, factor: float) -> Length:
    return {name: factor * value for name, value in length.items()}


def square(shell: Shell, x: Length, half: Length) -> tuple[int, ...]:
    """Add the four corners of a square across the edge, counter-clockwise seen along -x."""
    return tuple(vertex(shell, x, _times(half, y), _times(half, z)) for y, z in _CORNERS)


def chain(shell: Shell, x: Length, half: Length) -> tuple[int, ...]:
    """Add half A's part of a square, from the split's top around to the split's bottom."""
    split: Length = {"clearance": 0.5}
    top, bottom = half, _times(half, -1.0)
    return tuple(
        vertex(shell, x, y, z)
        for y, z in ((split, top), (half, top), (half, bottom), (split, bottom))
    )


def closed(loop: Sequence[int]) -> tuple[int, ...]:
    """A loop as a chain that ends where it starts."""
    return (*loop, loop[0])


def walls(shell: Shell, stations: Sequence[tuple[int, ...]], name: str, *, hole: bool) -> None:
    """Add the four faces between each two squares that follow each other towards +x."""
    for n, pair in enumerate(itertools.pairwise(stations)):
        first, second = pair[::-1] if hole else pair
        shell.band(closed(first), closed(second), [(name, n, side) for side in range(4)])


def face(shell: Shell, outer: tuple[int, ...], inner: tuple[int, ...] | None, name: str) -> None:
    """Add a square face towards -x, whole or with a square hole."""
    if inner is None:
        shell.polygon(outer[::-1], name)
    else:
        shell.band(closed(inner), closed(outer), [name] * 4)
