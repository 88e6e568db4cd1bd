"""Building affine solids out of vertices, triangles and facets."""

from __future__ import annotations

import itertools
from collections.abc import Hashable, Mapping, Sequence

import numpy as np

from scadgen.solid.affine import AffineSolid, Floats, Ints

__all__ = ["DECIMALS", "Shell", "Vector"]

#: Decimals of the factors: what files keep, so that a kit read back is the kit that was made.
DECIMALS = 9

#: Factors of a live parameter in x, y and z.
Vector = tuple[float, float, float]

_NOTHING: Vector = (0.0, 0.0, 0.0)


class Shell:
    """A surface under construction whose vertices are linear in the live parameters."""

    def __init__(self) -> None:
        self._rows: list[Mapping[str, Sequence[float]]] = []
        self._triangles: list[tuple[int, int, int]] = []
        self._facets: list[Hashable] = []

    def __len__(self) -> int:
        """Number of vertices so far."""
        return len(self._rows)

    def vertex(self, **factors: Sequence[float]) -> int:
        """Add a vertex, by the factors of each live parameter in x, y, z; its number."""
        self._rows.append(factors)
        return len(self._rows) - 1

    def vertices(self, factors: Mapping[str, Floats]) -> int:
        """Add many vertices by ``(v, 3)`` factors of each live parameter; the first's number."""
        first = len(self._rows)
        columns = [[(name, row) for row in array.tolist()] for name, array in factors.items()]
        self._rows += [dict(row) for row in zip(*columns, strict=True)]
        return first

    def triangles(self, corners: Ints, facet: Hashable = None) -> None:
        """Add ``(m, 3)`` triangles, counter-clockwise from outside, on one facet or on none."""
        self._triangles += [tuple(t) for t in corners.tolist()]
        self._facets += [facet] * len(corners)

    def polygon(self, corners: Sequence[int], facet: Hashable) -> None:
        """Add a convex polygon, counter-clockwise from outside, as a fan from its first corner."""
        fan = [(corners[0], b, c) for b, c in itertools.pairwise(corners[1:])]
        self._triangles += fan
        self._facets += [facet] * len(fan)

    def band(self, first: Sequence[int], second: Sequence[int], facets: Sequence[Hashable]) -> None:
        """Add four-sided faces between two chains of the same length.

        Counter-clockwise from outside when `first` is passed forwards and `second` back.
        """
        for (a, b), (c, d), facet in zip(
            itertools.pairwise(first), itertools.pairwise(second), facets, strict=True
        ):
            self.polygon((a, b, d, c), facet)

    def add(self, other: Shell, turn: Mapping[str, Vector] | None = None) -> int:
        """Add another shell; the number its first vertex gets here.

        Parameters
        ----------
        other
            The shell.
        turn
            Where given, the other end of an edge: a half turn about the vertical through
            the middle of the edge from the origin to this point, linear as a vertex is.
        """
        first = len(self._rows)
        rows = other._rows
        if turn is not None:
            rows = [_turned(row, turn) for row in rows]
        self._rows += rows
        self._triangles += [(a + first, b + first, c + first) for a, b, c in other._triangles]
        self._facets += other._facets if turn is None else [_other_end(f) for f in other._facets]
        return first

    def points(self, vertices: Sequence[int], values: Mapping[str, float]) -> Floats:
        """Some vertices at some live parameters, the others zero; ``(k, 3) float``."""
        rows = [self._rows[v] for v in vertices]
        total = np.zeros((len(rows), 3))
        for parameter, value in values.items():
            total += value * np.array([row.get(parameter, _NOTHING) for row in rows]).reshape(-1, 3)
        return total

    def solid(self, name: str) -> AffineSolid:
        """The finished part."""
        used = dict.fromkeys(parameter for row in self._rows for parameter in row)
        coefficients = {
            parameter: np.array([row.get(parameter, _NOTHING) for row in self._rows]).round(
                DECIMALS
            )
            for parameter in used
        }
        number: dict[Hashable, int] = {}
        facets = [
            number.setdefault(n if facet is None else (facet,), len(number))
            for n, facet in enumerate(self._facets)
        ]
        triangles = np.array(self._triangles, dtype=np.int64)
        return AffineSolid(name, coefficients, triangles, np.array(facets, dtype=np.int64))


def _turned(
    row: Mapping[str, Sequence[float]], end: Mapping[str, Vector]
) -> dict[str, Sequence[float]]:
    """A vertex's factors after a half turn about z and a shift."""
    turned: dict[str, Sequence[float]] = {p: (-x, -y, z) for p, (x, y, z) in row.items()}
    for parameter, shift in end.items():
        found = turned.get(parameter, (0.0, 0.0, 0.0))
        turned[parameter] = [a + b for a, b in zip(found, shift, strict=True)]
    return turned


def _other_end(facet: Hashable) -> Hashable:
    """A facet's name at the other end: level faces go through, all others are its own."""
    return facet if facet is None or facet in ("top", "bottom") else ("other", facet)
