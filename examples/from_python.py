"""Make a kit in Python, evaluate one of its parts at other lengths, write it as STL.

    python examples/from_python.py half.stl

Needs neither OpenSCAD nor any file of the kit.
"""

import sys
from pathlib import Path

from scadgen.emit.mesh import mesh_bytes, write_atomic
from scadgen.kit.build import Request, build
from scadgen.kit.ranges import check_values
from scadgen.plane.catalogue import NamedTiling
from scadgen.solid.mesh import solid_faults, volume


def main(output: Path) -> None:
    """Write half A of a hexagonal kit with side 8 mm and wider gaps."""
    kit = build(Request.tiled(NamedTiling("hexagonal"), detail="draft", values={"side": 8.0}))

    # The kit keeps its own values; a part is evaluated at any others within the ranges.
    values = {**kit.values, "clearance": 0.25, "peg_clearance": 0.25}
    check_values(kit.ranges, values)

    half = kit.parts["half"]
    points = half.points(values)  # (v, 3), mm; linear in the values
    assert not solid_faults(points, half.triangles)  # closed, no crossing faces, ...

    write_atomic(output, mesh_bytes(points, half.triangles, "stl"))
    content = volume(points, half.triangles) / 1000
    print(f"{output}: {len(half.triangles)} triangles, {content:.2f} cm3")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "half.stl"))
