"""What vertices and edges are called: by the numbers of the file they come from, or by place."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from scadgen.solid.affine import Floats, Ints

__all__ = ["BY_PLACE", "Numbering", "counted", "where"]


@dataclass(frozen=True, slots=True, eq=False)
class Numbering:
    """The numbers that vertices and edges have in a file.

    Parameters
    ----------
    vertices
        ``(n,) int``: of each vertex; None where the file does not number them.
    edges
        ``(m,) int``: of each edge, or None.
    """

    vertices: Ints | None = None
    edges: Ints | None = None

    def vertex(self, vertex: int, point: Floats) -> str:
        """A vertex by its number, if it has one, and its place: ``vertex 3 at (0, 80)``."""
        return f"{self._vertex(vertex)} at {where(point)}"

    def edge(self, edge: int, ends: Iterable[int], points: Floats) -> str:
        """An edge by its number, if it has one, and its ends.

        Parameters
        ----------
        edge
            Which edge.
        ends
            Its two vertices.
        points
            ``(2, 2) float`` or ``(2, 3)``: their places, in mm.
        """
        called = "the edge" if self.edges is None else f"edge {self.edges[edge]}"
        if self.vertices is None:
            return f"{called} from {where(points[0])} to {where(points[1])}"
        first, second = (self.vertex(v, p) for v, p in zip(ends, points, strict=True))
        return f"{called} from {first} to {second}"

    def short(self, edge: int, ends: Iterable[int], points: Floats) -> str:
        """An edge by its number alone; if it has none, by its ends, as `edge` has them."""
        if self.edges is not None:
            return f"edge {self.edges[edge]}"
        if self.vertices is None:
            return self.edge(edge, ends, points)
        return f"the edge from {' to '.join(map(self._vertex, ends))}"

    def sorted(self, vertices: Ints, edges: Ints) -> Numbering:
        """The same in another order.

        Parameters
        ----------
        vertices, edges
            Which of those here is at each place.
        """
        return Numbering(
            None if self.vertices is None else self.vertices[vertices],
            None if self.edges is None else self.edges[edges],
        )

    def numbers(self, of: str, which: Ints) -> list[int]:
        """The numbers of some ``vertices`` or ``edges``: of the file, if it has them."""
        known: Ints | None = getattr(self, of)
        return list(map(int, which if known is None else known[which]))

    def _vertex(self, vertex: int) -> str:
        return "the vertex" if self.vertices is None else f"vertex {self.vertices[vertex]}"


#: Of drawings, which number nothing.
BY_PLACE = Numbering()


def counted(vertices: int, edges: int) -> Numbering:
    """Numbers from 0."""
    return Numbering(np.arange(vertices), np.arange(edges))


def where(point: Floats) -> str:
    """A point of two or three coordinates as text: ``(12.5, 40)``, in mm."""
    return f"({', '.join(f'{number + 0.0:.6g}' for number in point)})"
