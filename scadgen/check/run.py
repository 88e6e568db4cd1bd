"""All checks of a kit, in order."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import chain
from pathlib import Path

from scadgen.check import files, geometry, rendered
from scadgen.check.proof import proofs
from scadgen.check.result import Result
from scadgen.kit.model import Joint, Kit

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
        **{
            f"{what}{f' of {joint.title}' if joint.name else ''}": _named(joint, found)
            for joint in kit.joints
            for what, found in _of_joint(kit, joint, say).items()
        },
        "drawings": _drawings(kit, source / f"{kit.name}.scad", timeout),
    }


def _drawings(kit: Kit, scad: Path, timeout: float) -> Iterator[Result]:
    with tempfile.TemporaryDirectory(prefix="scadgen-") as name:
        folder = Path(name)
        yield from chain(
            rendered.part_renders(kit, scad, folder, timeout),
            rendered.view_renders(kit, scad, folder, timeout),
        )


def _of_joint(kit: Kit, joint: Joint, say: Callable[[str], None]) -> dict[str, Iterable[Result]]:
    """Prepare the checks of a kind of joint."""
    return {
        "partition": geometry.partition(kit, joint),
        "footprint": (geometry.footprint(kit, one) for one in (joint,)),
        "gaps": geometry.gaps(kit, joint),
        "sampling": geometry.sampling(kit, joint),
        "proofs": (proof.result for proof in proofs(kit, joint, say=say)),
    }


def _named(joint: Joint, found: Iterable[Result]) -> Iterator[Result]:
    """Results that say which joint they are of, where there are several."""
    for result in found:
        named = f"{joint.title}: {result.check}" if joint.name else result.check
        yield replace(result, check=named)
