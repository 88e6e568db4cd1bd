"""All checks of a kit, in order."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from itertools import chain
from pathlib import Path

from scadgen.check import files, geometry, rendered
from scadgen.check.proof import proofs
from scadgen.check.result import Result
from scadgen.kit.model import Kit

__all__ = ["checks"]


def checks(
    kit: Kit, source: Path, timeout: float, say: Callable[[str], None] = lambda _: None
) -> dict[str, Iterator[Result]]:
    """Prepare all checks.

    Parameters
    ----------
    kit
        The kit.
    source
        Its folder.
    timeout
        Seconds that OpenSCAD may take for one drawing.
    say
        Told what takes long.

    Returns
    -------
    checks
        By what is checked, the checks, each made when its result is asked for.  Asking for
        those of OpenSCAD raises a `ToolError` where it is missing.
    """
    return {
        "files": files.unchanged(kit, source),
        "what the parameters make": (geometry.same(made) for made in (kit,)),
        "solids": geometry.closed(kit),
        "partition": geometry.partition(kit),
        "footprint": (geometry.footprint(made) for made in (kit,)),
        "gaps": geometry.gaps(kit),
        "sampling": geometry.sampling(kit),
        "proofs": (proof.result for proof in proofs(kit, say)),
        "drawings": _drawings(kit, source / f"{kit.frame}.scad", timeout),
    }


def _drawings(kit: Kit, scad: Path, timeout: float) -> Iterator[Result]:
    with tempfile.TemporaryDirectory(prefix="scadgen-") as name:
        folder = Path(name)
        yield from chain(
            rendered.part_renders(kit, scad, folder, timeout),
            rendered.view_renders(scad, folder, timeout),
        )
