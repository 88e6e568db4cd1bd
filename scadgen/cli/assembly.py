"""An assembly as files give it: what is held, and what counts as touching."""

from __future__ import annotations

import fnmatch
import itertools
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from scadgen.api.words import meant
from scadgen.errors import InputError

if TYPE_CHECKING:
    from scadgen.interlock.contacts import Contacts, Mesh
    from scadgen.tools.read_mesh import MeshPart

__all__ = ["checked_interference", "checked_tolerance", "held_parts", "touching"]

#: Share of a part's mean thickness above which a tolerance is large.
_LARGE = 0.5

#: Share of the tolerance up to which parts may be in each other.
_FILM = 0.01


def held_parts(parts: Sequence[MeshPart], hold: tuple[str, ...]) -> list[int]:
    """Numbers of the parts to hold.

    Parameters
    ----------
    parts
        All parts.
    hold
        Names, files and patterns, with commas between; none for the largest part.

    Raises
    ------
    InputError
        There is one part only, nothing is called so, or nothing would be left free.
    """
    from scadgen.interlock.assembly import largest_part

    names = [part.name for part in parts]
    if len(names) < 2:
        msg = f"{len(names)} part: must be at least two; name more files"
        raise InputError(msg)
    if not hold:
        return [largest_part([part.mesh for part in parts])]
    # A name may have commas of its own.
    lists = ([text] if _named(parts, text) else text.split(",") for text in hold)
    chosen: set[int] = set()
    for name in itertools.chain(*lists):
        found = _named(parts, name.strip())
        if not found:
            msg = f"--hold {name.strip()}: must be one of {', '.join(names)}, a file, or a pattern"
            msg += meant(name.strip(), names)
            raise InputError(msg)
        chosen.update(found)
    if len(chosen) == len(names):
        msg = f"--hold {','.join(hold)}: holds all parts; leave at least one free"
        raise InputError(msg)
    return sorted(chosen)


def _named(parts: Sequence[MeshPart], text: str) -> list[int]:
    """Numbers of the parts that a name, a file or a pattern stands for."""
    for fits in (
        [n for n, part in enumerate(parts) if part.name == text],
        [n for n, part in enumerate(parts) if text in {str(part.path), part.path.name}],
        [n for n, part in enumerate(parts) if part.path.stem == text],
    ):
        if fits:
            return fits
    return [n for n, part in enumerate(parts) if fnmatch.fnmatchcase(part.name, text)]


def checked_tolerance(names: list[str], meshes: list[Mesh], tolerance: float | None) -> float:
    """The distance up to which faces touch; a person is told where it is large.

    Parameters
    ----------
    names, meshes
        The parts.
    tolerance
        What was asked for, if anything.

    Raises
    ------
    InputError
        It is not above 0, or larger than the largest part.
    """
    from scadgen.interlock.contacts import default_tolerance
    from scadgen.solid.mesh import areas, volume

    near = default_tolerance(meshes) if tolerance is None else tolerance
    size = max(float((points.max(axis=0) - points.min(axis=0)).max()) for points, _ in meshes)
    if near > size:
        msg = f"--tolerance {near:.4g}: must be at most the largest part's size, {size:.4g} mm"
        raise InputError(msg)
    if not 0 < near < math.inf:
        msg = f"tolerance = {near:g}: must be a finite number above 0"
        raise InputError(msg)
    # Of a plate twice the volume over the surface is its thickness.
    thick = {
        name: 2 * volume(*mesh) / float(areas(*mesh).sum())
        for name, mesh in zip(names, meshes, strict=True)
    }
    thin = min(thick, key=lambda name: thick[name])
    if near > _LARGE * thick[thin]:
        click.echo(
            f"scadgen: tolerance {near:.4g} mm is large: {thin} is {thick[thin]:.3g} mm thick on "
            "average, so gaps beside it may count as closed that are wide for it; "
            f"see --tolerance {thick[thin] / 10:.2g}",
            err=True,
        )
    return near


def checked_interference(
    names: list[str], meshes: list[Mesh], interference: float | None, near: float
) -> float:
    """How deep parts may be in each other; a person is told where they are.

    Parameters
    ----------
    names, meshes
        The parts.
    interference
        What was asked for, if anything.
    near
        The distance up to which faces touch.

    Raises
    ------
    InputError
        Parts are deeper in each other.
    """
    from scadgen.interlock.overlap import overlaps

    deep = _FILM * near if interference is None else interference
    if not 0 <= deep < math.inf:
        msg = f"--interference {deep:g}: must be a finite number, at least 0"
        raise InputError(msg)
    found = overlaps(meshes)
    if not found:
        return deep
    worst = max(found, key=lambda pair: pair.depth)
    both = f"{names[worst.first]} and {names[worst.second]}"
    others = f", {len(found)} pairs in all" if len(found) > 1 else ""
    if worst.depth > deep:
        msg = (
            f"{both} overlap by {worst.volume:.6g} mm3, {worst.depth:.3g} mm deep{others}: parts "
            "must be placed as assembled, or give --interference to count that as contact"
        )
        raise InputError(msg)
    click.echo(
        f"scadgen: {both} overlap by {worst.depth:.3g} mm{others}: it counts as contact", err=True
    )
    return deep


def touching(meshes: list[Mesh], near: float) -> Contacts:
    """Where parts touch.

    Parameters
    ----------
    meshes
        The parts.
    near
        The distance up to which they do.

    Raises
    ------
    InputError
        No two of them touch.
    """
    from scadgen.interlock.contacts import find_contacts

    contacts = find_contacts(meshes, near)
    if not len(contacts):
        msg = (
            f"no two parts touch within {near:.4g} mm: "
            "place them as assembled, or give a larger --tolerance"
        )
        raise InputError(msg)
    return contacts
