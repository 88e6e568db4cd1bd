"""The kit: everything generated for one frame, as a plain value.

Stages before this one compute; emitters after it read kits and nothing else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scadgen.frame.placement import Placement
from scadgen.interlock.path import Path
from scadgen.solid.affine import AffineSolid, Range

__all__ = ["Kit", "Way"]


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """The way of some pieces out of a joint.

    Parameters
    ----------
    name
        What comes out.
    moving
        Numbers, in the kit's `joint`, of the pieces that move as one; with their tubes, those
        that have one.
    path
        The motion, in sides.
    """

    name: str
    moving: tuple[int, ...]
    path: Path


@dataclass(frozen=True, slots=True)
class Kit:
    """Everything generated for one frame.

    Parameters
    ----------
    frame
        ``hexagonal`` or ``square``.
    key
        One of `KEYS`.
    rows, columns
        Cells of the frame (hexagons, squares), at least 1.
    detail
        Name of the detail level.
    weave
        Name of the weave and its parameters, as `Weave.as_dict` gives them.
    command
        The command line that makes this kit again.
    values
        Default of every live parameter the kit has, in mm.  A solid kit has no ``bore``.
    ranges
        What each live parameter may be; every one in `values` has at least one.
    parts
        The affine solids by name, in the order of `PARTS`.
    joint
        The pieces that meet at one vertex, assembled; the key's edge along +x.
    figures
        What was measured on the kit, by name; plain numbers with their unit in the name.
    verdicts
        What was proved of its joint, by name; empty for a kit that was not checked.
    ways
        The ways on which the pieces of its joint come apart, in order; likewise.
    """

    frame: str
    key: str
    rows: int
    columns: int
    detail: str
    weave: Mapping[str, float | int | str]
    command: str
    values: Mapping[str, float]
    ranges: tuple[Range, ...]
    parts: Mapping[str, AffineSolid]
    joint: tuple[Placement, ...]
    figures: Mapping[str, float]
    verdicts: Mapping[str, str] = field(default_factory=dict)
    ways: tuple[Way, ...] = ()

    @property
    def valence(self) -> int:
        """Number of edges at a vertex."""
        return 1 + sum(place.part == "connector" for place in self.joint)
