"""A part of a kit, at any lengths within their ranges."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from scadgen.api.values import as_length
from scadgen.api.words import meant
from scadgen.emit.mesh import mesh_bytes
from scadgen.emit.target import target
from scadgen.errors import InputError
from scadgen.kit import model
from scadgen.kit.ranges import check_values
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.mesh import volume

if TYPE_CHECKING:
    import trimesh

__all__ = ["Mesh", "PartHandle"]


class Mesh(NamedTuple):
    """A closed triangle mesh.

    Parameters
    ----------
    points
        ``(v, 3) float``, in mm.
    triangles
        ``(m, 3) int``, counter-clockwise seen from outside.
    """

    points: Floats
    triangles: Ints

    def to_trimesh(self) -> trimesh.Trimesh:
        """The same as trimesh has it, vertex for vertex.

        Examples
        --------
        >>> import scadgen
        >>> kit = scadgen.make_kit("hexagonal", detail="draft", prove=False)
        >>> kit.parts["half"].mesh().to_trimesh().is_watertight
        True
        """
        import trimesh

        return trimesh.Trimesh(self.points, self.triangles, process=False)


@dataclass(frozen=True, slots=True, eq=False)
class PartHandle:
    """A part of a kit, to programs `scadgen.Part`; `parts` of a kit has all of them.

    Its vertices are linear in the kit's live parameters.  Lengths that are given to its methods
    are such parameters, in mm or as texts with a unit; the others are as in the kit.

    Parameters
    ----------
    value
        Its tables; `Part` of ``scadgen.kit.model``.
    kit
        The kit that it belongs to.
    read
        Files that the kit was read from.

    Examples
    --------
    >>> import scadgen
    >>> kit = scadgen.make_kit("hexagonal", detail="draft", prove=False)
    >>> half = kit.parts["half"]
    >>> points, triangles = half.mesh(clearance=0.25)
    >>> points.shape[1], triangles.shape[1]
    (3, 3)
    >>> half.volume(clearance=0.3) < half.volume(clearance=0.1)
    True
    """

    value: model.Part
    kit: model.Kit
    read: tuple[Path, ...] = ()

    def __repr__(self) -> str:
        """Its name, and what it is for."""
        return f"<{self.name}: {self.role.replace('_', ' ')} of {self.kit.name}>"

    @property
    def name(self) -> str:
        """Its name."""
        return self.value.name

    @property
    def role(self) -> str:
        """What it is for: ``element``, ``half``, ``connector``, ``peg``, ..."""
        return self.value.role

    def mesh(self, **lengths: float | str) -> Mesh:
        """Its surface.

        Parameters
        ----------
        **lengths
            Live parameters that differ from the kit's.

        Raises
        ------
        InputError
            There is no such parameter, or a length leaves its range.
        """
        return Mesh(self.value.points(_settings(self.kit, lengths)), self.value.triangles)

    def volume(self, **lengths: float | str) -> float:
        """What it encloses, in mm3.

        Parameters
        ----------
        **lengths
            As for `mesh`.
        """
        return volume(*self.mesh(**lengths))

    def write(
        self, path: str | os.PathLike[str], *, force: bool = False, **lengths: float | str
    ) -> Path:
        """Write it as a mesh file.

        Parameters
        ----------
        path
            The file; it ends in ``.stl``, ``.3mf``, ``.obj`` or ``.glb``.
        force
            Whether to write over a file that scadgen did not make, or that was changed since.
        **lengths
            As for `mesh`.

        Returns
        -------
        path
            The file.

        Raises
        ------
        InputError
            As for `mesh`; the ending is another one, or the file may not be written.
        """
        place = target(Path(path), self.read, force=force)
        kind = place.path.suffix.lstrip(".").lower()
        place.put(mesh_bytes(*self.mesh(**lengths), kind, self.name), kind)
        return place.path


def _settings(kit: model.Kit, lengths: Mapping[str, float | str]) -> dict[str, float]:
    """The kit's live parameters with some changed, within their ranges."""
    for name in lengths:
        if name not in kit.values:
            msg = (
                f"{name}: not a live parameter of this kit; must be one of "
                f"{', '.join(kit.values)}{meant(name, kit.values)}"
            )
            raise InputError(msg)
    values = {**kit.values, **{name: as_length(name, value) for name, value in lengths.items()}}
    check_values(kit.ranges, values)
    return values
