"""Letters and digits as flat shells, to name things in pictures."""

from __future__ import annotations

import numpy as np

from scadgen.solid.affine import Floats, Ints

__all__ = ["written"]

#: What each character looks like, three dots wide and five high, its rows from the top.
_FONT = {
    "A": ".#. #.# ### #.# #.#",
    "B": "##. #.# ##. #.# ##.",
    "C": ".## #.. #.. #.. .##",
    "D": "##. #.# #.# #.# ##.",
    "E": "### #.. ##. #.. ###",
    "F": "### #.. ##. #.. #..",
    "G": ".## #.. #.# #.# .##",
    "H": "#.# #.# ### #.# #.#",
    "I": "### .#. .#. .#. ###",
    "J": "..# ..# ..# #.# .#.",
    "K": "#.# #.# ##. #.# #.#",
    "L": "#.. #.. #.. #.. ###",
    "M": "#.# ### ### #.# #.#",
    "N": "##. #.# #.# #.# #.#",
    "O": ".#. #.# #.# #.# .#.",
    "P": "##. #.# ##. #.. #..",
    "Q": ".#. #.# #.# ### .##",
    "R": "##. #.# ##. #.# #.#",
    "S": ".## #.. .#. ..# ##.",
    "T": "### .#. .#. .#. .#.",
    "U": "#.# #.# #.# #.# ###",
    "V": "#.# #.# #.# #.# .#.",
    "W": "#.# #.# ### ### #.#",
    "X": "#.# #.# .#. #.# #.#",
    "Y": "#.# #.# .#. .#. .#.",
    "Z": "### ..# .#. #.. ###",
    "0": "### #.# #.# #.# ###",
    "1": ".#. ##. .#. .#. ###",
    "2": "### ..# ### #.. ###",
    "3": "### ..# ### ..# ###",
    "4": "#.# #.# ### ..# ..#",
    "5": "### #.. ### ..# ###",
    "6": "### #.. ### #.# ###",
    "7": "### ..# ..# ..# ..#",
    "8": "### #.# ### #.# ###",
    "9": "### #.# ### ..# ###",
}

#: Dots from one character to the next, and from the top to the bottom of one.
_PITCH, _HEIGHT = 4, 5

#: Corners of a dot, and its two faces.
_CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
_FACES = np.array([[0, 1, 2], [0, 2, 3]])


def written(text: str, right: Floats, up: Floats) -> tuple[Floats, Ints]:
    """Squares in a plane that are a text, its lower left at the origin, one unit high.

    Parameters
    ----------
    text
        Capital letters and digits; there is nothing for what is neither.
    right, up
        ``(3,) float``: unit vectors along and across the line of writing.

    Returns
    -------
    points
        ``(v, 3) float``.
    triangles
        ``(m, 3) int``, counter-clockwise seen from where it can be read.
    """
    dots = np.array(
        [
            (_PITCH * place + column, _HEIGHT - 1 - row)
            for place, character in enumerate(text)
            for row, line in enumerate(_FONT.get(character, "").split())
            for column, dot in enumerate(line)
            if dot == "#"
        ],
        dtype=np.float64,
    ).reshape(-1, 1, 2)
    corners = (dots + _CORNERS).reshape(-1, 2) / _HEIGHT
    first = 4 * np.arange(len(dots), dtype=np.int64)[:, None, None]
    return np.asarray(corners @ np.array([right, up])), (first + _FACES).reshape(-1, 3)
