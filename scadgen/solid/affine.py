"""The affine solid: one closed polyhedron that every tool only evaluates.

The faces are fixed; the vertices are linear in the live parameters::

    points = side * P_side + edge_length * P_edge_length + clearance * P_clearance + ...

There is no constant term: every live parameter is a length, so scaling them all
together scales the part.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from scadgen.errors import InvariantError

__all__ = ["AffineSolid", "Floats", "Ints", "Linear", "Range"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Linear:
    """A linear expression in the live parameters, in mm.

    Parameters
    ----------
    terms
        Factor of each live parameter that occurs.
    constant
        The constant, in mm.
    """

    terms: Mapping[str, float]
    constant: float = 0.0

    def __call__(self, values: Mapping[str, float]) -> float:
        """Value at the given live parameters, in mm."""
        return self.constant + sum(f * values[name] for name, f in self.terms.items())


@dataclass(frozen=True, slots=True)
class Range:
    """What one live parameter may be, given the others.

    Parameters
    ----------
    parameter
        Its name.
    low, high
        Bounds, both included, linear in the *other* parameters.
    reason
        What breaks outside, in a few words.
    """

    parameter: str
    low: Linear
    high: Linear
    reason: str


@dataclass(frozen=True, slots=True, eq=False)
class AffineSolid:
    """A closed polyhedron whose vertices are linear in the live parameters.

    Parameters
    ----------
    name
        The part's name, a plain identifier.
    coefficients
        For each live parameter that moves a vertex, the ``(v, 3) float`` factors.
    triangles
        ``(m, 3) int``, counter-clockwise seen from outside.
    facets
        ``(m,) int``; triangles with the same number stay in one plane whatever the
        parameters are.
    """

    name: str
    coefficients: Mapping[str, Floats]
    triangles: Ints
    facets: Ints

    def __post_init__(self) -> None:
        """Check shapes and freeze the arrays."""
        count = {len(c) for c in self.coefficients.values()}
        if len(count) != 1:
            msg = f"affine solid {self.name}: coefficients do not match its vertices"
            raise InvariantError(msg)
        for array in (*self.coefficients.values(), self.triangles, self.facets):
            array.setflags(write=False)
        object.__setattr__(self, "coefficients", MappingProxyType({**self.coefficients}))

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return len(next(iter(self.coefficients.values())))

    def points(self, values: Mapping[str, float]) -> Floats:
        """Vertices at the given live parameters.

        Parameters
        ----------
        values
            All live parameters, in mm.

        Returns
        -------
        points
            ``(v, 3) float``, mm.
        """
        total = np.zeros((self.vertex_count, 3))
        for name, coefficient in self.coefficients.items():
            total += values[name] * coefficient
        return total
