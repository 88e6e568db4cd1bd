"""Labels that keep out of each other's way."""

from __future__ import annotations

import html
import math

import numpy as np

from scadgen.solid.affine import Floats

__all__ = ["Labels"]

#: Width of a letter and height of a line, as shares of the text's size.
_LETTER, _LINE = 0.57, 1.15

#: How far from its place a label may be, in sizes of the text, and in how many directions.
_RINGS, _DIRECTIONS = (1.6, 2.4, 3.4, 4.6), 16

#: Distance, in sizes of the text, from which on a line leads to the place.
_LED = 2.0

#: What an area that is covered costs, in lengths.
_COVERED = 0.5


class Labels:
    """Labels on a page, in pixels.

    Parameters
    ----------
    size
        Of the text.
    width
        Of the page.
    """

    def __init__(self, size: float, width: float) -> None:
        self.size, self._width = size, width
        self._taken = np.empty((0, 4))

    def keep(self, middle: Floats, half: Floats | float) -> None:
        """Keep labels away from a box with some middle and half widths."""
        box = np.concatenate([middle - half, middle + half])
        self._taken = np.vstack([self._taken, box])

    def put(self, words: str, at: Floats, *, on: bool) -> str:
        """A label for a place, as SVG: beside it, or on it if wanted and free.

        Parameters
        ----------
        words
            What it says.
        at
            ``(2,) float``: the place.
        on
            Whether the label may be on the place itself.
        """
        half = self.size * np.array([_LETTER * len(words), _LINE]) / 2
        angles = 2 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
        around = np.column_stack([np.cos(angles), np.sin(angles)])
        # From ring to ring by the text's size, and by its width where that is in the way.
        rings = [around * (radius * self.size + half * [0.8, 0.0]) for radius in _RINGS]
        offsets = np.vstack([np.zeros((1 if on else 0, 2)), *rings])
        middles = at + offsets
        costs = np.linalg.norm(offsets, axis=1) + _COVERED * self._covered(middles, half)
        costs[(middles[:, 0] < half[0]) | (middles[:, 0] > self._width - half[0])] += self._width
        best = int(costs.argmin())
        self.keep(middles[best], half)
        return self._drawn(words, middles[best], at)

    def _covered(self, middles: Floats, half: Floats) -> Floats:
        """How much of what is taken labels would cover, each."""
        low = np.maximum((middles - half)[:, None], self._taken[None, :, :2])
        high = np.minimum((middles + half)[:, None], self._taken[None, :, 2:])
        return np.asarray(np.maximum(high - low, 0.0).prod(axis=2).sum(axis=1))

    def _drawn(self, words: str, middle: Floats, at: Floats) -> str:
        (x, y), off = middle, np.linalg.norm(middle - at)
        lead = ""
        if off > _LED * self.size:
            lead = f'<path class="lead" d="M{at[0]:.1f} {at[1]:.1f}L{x:.1f} {y:.1f}"/>'
        # Not all viewers know how to paint a stroke below its own letters.
        text = f'x="{x:.1f}" y="{y + 0.36 * self.size:.1f}">{html.escape(words)}</text>'
        return f'{lead}<text class="halo" {text}<text class="name" {text}'
