"""CPU time of parts and frames in FreeCAD.

python benchmarks/in_freecad.py
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from report import heading, line, progress

from scadgen.emit.macro import macro
from scadgen.kit.build import Request, build
from scadgen.plane.catalogue import NamedTiling

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

__all__ = ["run"]

#: Aims: CPU seconds for a basic element at `standard`, and for opening the frame.
_PART, _FRAME = 1.5, 10.0

#: Cells of the frame, up and across.
_CELLS = 5

_INSIDE = Path(__file__).with_name("inside_freecad.py")


def run() -> None:
    """Report both frames."""
    for frame in ("hexagonal", "square"):
        _report(frame)


def _report(frame: str) -> None:
    import freecadcmd

    kit = build(Request.tiled(NamedTiling(frame), rows=_CELLS, columns=_CELLS))
    heading(f"The {frame} kit at {kit.detail} in FreeCAD, CPU time")
    progress(f"{frame}: FreeCAD")
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / f"{frame}.FCMacro"
        path.write_text(macro(kit), encoding="utf-8")
        found, _ = freecadcmd.run(_INSIDE, Path(name), macro=str(path))
    first, again = found["first"], found["again"]
    faces = f"{first:.2f} s, {found['faces']} faces"
    line("basic element, first", faces, f"at most {_PART} s", met=first <= _PART)
    line(
        "basic element, other clearance", f"{again:.2f} s", f"at most {_PART} s", met=again <= _PART
    )
    line("  the same with FreeCAD's calls", f"{found['calls']:.2f} s")
    line("all parts, other clearance", f"{found['recompute']:.2f} s")
    pieces = f"{found['pieces']} pieces"
    for what, key in (("macro makes", "made"), ("opening", "opened")):
        took = found[key]
        line(
            f"{what} a frame of {_CELLS} x {_CELLS}",
            f"{took:.2f} s, {pieces}",
            f"at most {_FRAME:g} s",
            met=took <= _FRAME,
        )


if __name__ == "__main__":
    run()
