"""Draw the pictures of the documentation: python scripts/pictures.py [FOLDER].

The same scadgen gives the same bytes, so a picture changes only when what it shows does.
"""

from __future__ import annotations

import itertools
import sys
from collections.abc import Iterator
from pathlib import Path

from scadgen.check.proof import proved
from scadgen.emit.frame_picture import frame_svg
from scadgen.emit.mesh import write_atomic
from scadgen.emit.picture import assembly_picture, frame_picture, joint_picture, parts_picture
from scadgen.errors import ScadgenError
from scadgen.frame.classes import classify
from scadgen.kit.build import Request, build
from scadgen.plan.order import make_plan
from scadgen.plan.picture import step_pictures
from scadgen.plane.catalogue import NamedTiling
from scadgen.plane.snapping import move_vertices
from scadgen.readers.read import read

__all__ = ["frames", "main", "pictures"]

_EXAMPLES = Path(__file__).parents[1] / "examples" / "frames"

#: Width and height of each, in pixels.
_SIZE = (900, 675)

#: How far vertices of the frame drawn by hand may move, in mm.
_SNAP = 2.0

#: The frames of which kits are drawn.
_REGULAR = ("hexagonal", "square")

#: How far joints are pulled apart, in sides.
_APART = 3.5


def pictures(frame: str) -> Iterator[tuple[str, bytes]]:
    """Names and bytes of a frame's pictures."""
    kit = proved(build(Request.tiled(NamedTiling(frame))))
    yield f"{frame}_frame.png", frame_picture(kit, size=_SIZE)
    yield f"{frame}_joint.png", joint_picture(kit, size=_SIZE)
    yield f"{frame}_joint_apart.png", joint_picture(kit, _APART, size=_SIZE)
    yield f"{frame}_assembly.png", assembly_picture(kit, size=_SIZE)
    yield f"{frame}_parts.png", parts_picture(kit, size=_SIZE)
    yield f"{frame}_step.svg", step_pictures(make_plan(kit))["plan-02.svg"].encode()


def frames() -> Iterator[tuple[str, bytes]]:
    """Names and bytes of the pictures of the examples, and of the one that is snapped."""
    shown = {path.stem: read(path).frame for path in sorted(_EXAMPLES.iterdir())}
    shown["rough_snapped"] = move_vertices(shown["rough"], _SNAP).frame
    for name, frame in shown.items():
        yield f"frame_{name}.svg", frame_svg(frame, classify(frame)).encode()


def main(folder: Path) -> int:
    """Write all pictures into a folder; the exit status."""
    folder.mkdir(parents=True, exist_ok=True)
    try:
        for name, data in itertools.chain(frames(), *map(pictures, _REGULAR)):
            write_atomic(folder / name, data)
            print(folder / name)
    except ScadgenError as error:
        print(f"pictures: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    given = sys.argv[1:2] or [Path(__file__).parents[1] / "docs" / "pictures"]
    sys.exit(main(Path(given[0])))
