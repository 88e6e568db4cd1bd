"""The kit: everything generated for one frame, as a plain value.

Stages before this one compute; emitters after it read kits and nothing else.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from scadgen.frame.graph import Frame
from scadgen.frame.keys import Refused
from scadgen.frame.placement import Placement
from scadgen.interlock.path import Path
from scadgen.solid.affine import AffineSolid, Range

__all__ = ["DENSITIES", "RIMS", "Joint", "Kit", "Slicing", "Way"]

#: Materials to print with, and the density of each in g/cm3, as most makers state them.
DENSITIES: Mapping[str, float] = {
    "PLA": 1.24,
    "PETG": 1.27,
    "ABS": 1.04,
    "ASA": 1.07,
    "PC": 1.2,
    "PA": 1.12,
}

#: What is done where a joint at the rim lacks edges of an inner one.
RIMS = ("caps", "open")


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """The way of some pieces out of a joint.

    Parameters
    ----------
    name
        What comes out.
    moving
        Numbers, in the joint's `pieces`, of those that move as one; with their tubes, those
        that have one.
    path
        The motion, in sides.
    """

    name: str
    moving: tuple[int, ...]
    path: Path


@dataclass(frozen=True, slots=True)
class Slicing:
    """What printing the parts takes, as a slicer says.

    Parameters
    ----------
    how
        The slicer, and the settings that matter most.
    seconds
        Print time of one piece, by part.
    filament
        Filament for one piece, supports and all, in mm3, by part.
    """

    how: str
    seconds: Mapping[str, int]
    filament: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Joint:
    """One kind of joint: what meets at each vertex that has it.

    Parameters
    ----------
    name
        A letter; empty in a frame that has one kind.
    turns
        Direction of each edge, in degrees, ascending from that of its first key, 0.
    keys
        Which of the edges have a split connector; the first one does.
    caps
        Which of the edges have no tube wherever this joint stands.
    connectors
        The part that is each edge's whole connector.
    over
        Which of the edges have that part turned over.
    weave
        Name of the weave and its parameters, as `Weave.as_dict` gives them.
    pieces
        What meets there, assembled: half A and half B of each key, the other connectors
        counter-clockwise, the pegs.
    figures
        What was measured on it, by name; plain numbers with their unit in the name.
    verdicts
        What was proved of it, by name; empty if it was not checked.
    ways
        The ways on which its pieces come apart, in order; likewise.
    """

    name: str
    turns: tuple[float, ...]
    keys: tuple[int, ...]
    caps: tuple[int, ...]
    connectors: tuple[str, ...]
    over: tuple[int, ...]
    weave: Mapping[str, float | int | str]
    pieces: tuple[Placement, ...]
    figures: Mapping[str, float]
    verdicts: Mapping[str, str] = field(default_factory=dict)
    ways: tuple[Way, ...] = ()

    @property
    def title(self) -> str:
        """What to call it in a sentence."""
        return f"joint {self.name}" if self.name else "the joint"

    @property
    def directions(self) -> list[float]:
        """Direction of each edge, in radians."""
        return [math.radians(turn) for turn in self.turns]

    @property
    def view(self) -> str:
        """What to call it where names have no spaces."""
        return f"joint_{self.name}" if self.name else "joint"

    @property
    def half_parts(self) -> frozenset[str]:
        """The parts that are halves."""
        return frozenset(p.part for p in self.pieces if p.role in ("half_a", "half_b"))


@dataclass(frozen=True, slots=True)
class Kit:
    """Everything generated for one frame.

    Parameters
    ----------
    frame
        Its name.
    key
        One of `KEYS`.
    rows, columns
        Cells of a hexagonal or square frame, at least 1, which can be set later; otherwise 0.
    detail
        Name of the detail level.
    command
        The command line that makes this kit again.
    values
        Default of every live parameter the kit has, in mm.  A solid kit has no ``bore``.
    ranges
        What each live parameter may be; every one in `values` has at least one.
    parts
        The affine solids by name, edge elements first.
    joints
        The kinds of joints.
    placements
        Where everything stands.
    graph
        The frame where it has no rows and columns, in mm.
    rim
        Whether joints at its rim have caps where they lack edges; one of `RIMS`.
    refused
        Joints of a graph that were kept out, by other keys.
    material
        What it is to be printed with; one of `DENSITIES`.
    slicing
        What printing it takes, if a slicer was asked.
    """

    frame: str
    key: str
    rows: int
    columns: int
    detail: str
    command: str
    values: Mapping[str, float]
    ranges: tuple[Range, ...]
    parts: Mapping[str, AffineSolid]
    joints: tuple[Joint, ...]
    placements: tuple[Placement, ...]
    graph: Frame | None = None
    rim: str = "caps"
    refused: tuple[Refused, ...] = ()
    material: str = "PLA"
    slicing: Slicing | None = None

    @property
    def elements(self) -> list[str]:
        """The edge elements among its parts."""
        halves_and_pegs = {p.part for one in self.joints for p in one.pieces if p.role != "cap"}
        others = halves_and_pegs.union(*(one.connectors for one in self.joints))
        return [name for name in self.parts if name not in others]

    @property
    def vertices(self) -> list[tuple[float, float]]:
        """Where its frame's joints stand, in edge lengths: ascending by y, then x, from joint 1."""
        places = {placement.at for placement in self.placements if placement.role == "half_a"}
        return sorted(places, key=lambda at: (at[1], at[0]))

    @property
    def proved(self) -> bool:
        """Whether something was proved of every joint."""
        return all(joint.verdicts for joint in self.joints)
