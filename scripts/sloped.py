"""Draw joints whose edges slope: python scripts/sloped.py [FOLDER].

Each is drawn assembled with the beginnings of its tubes, and apart.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from scadgen.element.pieces import Piece, add_surface
from scadgen.emit.mesh import write_atomic
from scadgen.emit.preview import Shell as Drawn
from scadgen.emit.preview import render
from scadgen.errors import ScadgenError
from scadgen.joint.joint import DETAILS, Decomposition, make_joint
from scadgen.joint.spokes import Spokes
from scadgen.joint.surface import Surface
from scadgen.joint.weave import any_joint
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.shell import Shell

__all__ = ["main", "pictures"]

#: Azimuths and slopes in degrees, of a cube's corner and of a joint of mixed slopes.
_JOINTS = {
    "cube": ((0, 120, 240), (35.26, 35.26, 35.26)),
    "mixed": ((0, 72, 172, 260), (40, -35, 0, 25)),
}

#: Width and height of each picture in pixels, and from where it is seen.
_SIZE, _VIEW = (900, 675), (35.0, 30.0)

#: How far pieces are pulled apart along their edges, and halves besides, in sides.
_APART, _ASIDE = 1.2, 0.8

#: Length of the tubes, in sides.
_TUBE = 1.5

_COLOURS = ((214, 120, 80), (90, 150, 200), (120, 180, 110), (200, 180, 90))
_GREY = (190, 190, 190)

#: The faces of a box by its corners, counter-clockwise from outside.
_BOX = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def pictures() -> Iterator[tuple[str, bytes]]:
    """Names and bytes of all pictures."""
    for name, (azimuths, slopes) in _JOINTS.items():
        spokes = Spokes.of(np.radians(azimuths), np.radians(slopes))
        weave = any_joint(float(spokes.gaps.min()), sloped=True)
        made = make_joint(spokes, weave, DETAILS["standard"], keys=[0])
        for title, apart in (("", 0.0), ("_apart", 1.0)):
            shown = list(_shells(made, apart))
            yield f"sloped_{name}{title}.png", render(shown, size=_SIZE, view=_VIEW)


def _shells(made: Decomposition, apart: float) -> Iterator[Drawn]:
    """What is drawn: halves, connectors and tubes, each as far apart as is wanted."""
    for edge, whole in enumerate(made.connectors):
        face = made.lattice.domain.tube_face(edge)
        away = apart * _APART * face.axes[0]
        colour = _COLOURS[edge % len(_COLOURS)]
        parts = [(whole, 0.0)] if edge else list(zip(made.halves[0], (1.0, -1.0), strict=True))
        for surface, side in parts:
            points, triangles = _mesh(surface)
            aside = apart * side * _ASIDE * np.array([0.0, 0.0, 1.0])
            yield points @ made.curves[edge].turn + away + aside, triangles, colour
        box = [(x, y, z) for x in (0.0, _TUBE) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
        yield face.apply(box) + away * (1.0 if edge else 1.6), _quads(), _GREY


def _quads() -> Ints:
    return np.array([t for a, b, c, d in _BOX for t in ((a, b, c), (a, c, d))])


def _mesh(surface: Surface) -> tuple[Floats, Ints]:
    """Points and triangles of a surface without clearance."""
    shell = Shell()
    add_surface(shell, Piece(surface, np.zeros_like(surface.points), 0.0), ())
    return surface.points, shell.solid("piece").triangles


def main(arguments: list[str]) -> int:
    """Draw all pictures into a folder."""
    folder = Path(arguments[0]) if arguments else Path(__file__).parents[1] / "docs" / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    try:
        for name, data in pictures():
            write_atomic(folder / name, data)
    except ScadgenError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
