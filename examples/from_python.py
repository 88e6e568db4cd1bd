"""Make a kit in Python, evaluate one of its parts at other lengths, write it as STL.

    python examples/from_python.py half.stl

Needs neither OpenSCAD nor any file of the kit.
"""

import sys
from pathlib import Path

import scadgen


def main(output: Path) -> None:
    """Write half A of a hexagonal kit with side 8 mm and wider gaps."""
    kit = scadgen.make_kit("hexagonal", side=8, detail="draft")
    half = kit.parts["half"]

    # The kit keeps its own lengths; a part is evaluated at any others within the ranges.
    wider = {"clearance": 0.25, "peg_clearance": 0.25}
    mesh = half.mesh(**wider)  # points (v, 3) in mm, triangles (m, 3)
    assert mesh.to_trimesh().is_volume  # closed, and its faces look outwards

    half.write(output, **wider)
    content = half.volume(**wider) / 1000
    print(f"{output}: {len(mesh.triangles)} triangles, {content:.2f} cm3")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "half.stl"))
