"""All checks of a kit, in order."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from scadgen.check import files, geometry, locking, rendered
from scadgen.check.result import Result
from scadgen.kit.model import Kit

__all__ = ["checks"]


def checks(kit: Kit, source: Path, timeout: float) -> Iterator[Result]:
    """Run all checks, one result after the other.

    Parameters
    ----------
    kit
        The kit.
    source
        Its folder.
    timeout
        Seconds that OpenSCAD may take for one drawing.

    Raises
    ------
    ToolError
        OpenSCAD is missing.
    """
    scad = source / f"{kit.frame}.scad"
    yield from files.unchanged(kit, source)
    yield geometry.same(kit)
    yield from geometry.closed(kit)
    yield from geometry.partition(kit)
    yield geometry.footprint(kit)
    yield from geometry.gaps(kit)
    yield from geometry.sampling(kit)
    yield locking.connectors_lock(kit)
    yield locking.finer_connectors_lock(kit)
    yield from locking.only_the_peg_moves(kit)
    yield from locking.without_the_peg(kit)
    yield locking.tightness(kit)
    with tempfile.TemporaryDirectory(prefix="scadgen-") as name:
        folder = Path(name)
        yield from rendered.part_renders(kit, scad, folder, timeout)
        yield from rendered.view_renders(scad, folder, timeout)
