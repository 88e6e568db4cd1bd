"""The kit: everything generated for one frame, as a plain value.

Stages before this one compute; emitters after it read kits and nothing else.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from scadgen.element.squares import Key
from scadgen.errors import InvariantError
from scadgen.frame.graph import Frame
from scadgen.frame.placement import Placement
from scadgen.frame.slots import Refused
from scadgen.interlock.path import Path
from scadgen.kit.cells import Cells
from scadgen.kit.live import PARAMETERS
from scadgen.plane.catalogue import NamedTiling
from scadgen.solid.affine import AffineSolid, Range
from scadgen.solid.pose import Pose

__all__ = [
    "DENSITIES",
    "RIMS",
    "Joint",
    "Kit",
    "Part",
    "PartEnd",
    "Slicing",
    "Vertex",
    "Way",
]

#: Materials to print with, and the density of each in g/cm3, as most makers state them.
DENSITIES: Mapping[str, float] = {
    "PLA": 1.24,
    "PETG": 1.27,
    "ABS": 1.04,
    "ASA": 1.07,
    "PC": 1.2,
    "PA": 1.12,
}

#: What stands at a joint of the rim in place of the edges that it lacks: caps, or nothing.
RIMS = ("caps", "open")


@dataclass(frozen=True, slots=True)
class PartEnd:
    """What a part ends in.

    Parameters
    ----------
    joint
        Name of the kind of joint that it belongs to; the first, if several kinds have it.
    slot
        The slot of its connector in that joint.  None for a socket or a fixed peg, which fit
        every slot with a key.
    over
        Whether the connector is turned over.  Of a half: whether it is half B of a joint whose
        half B has another shape than half A.
    """

    joint: str
    slot: int | None
    over: bool = False

    @property
    def is_key(self) -> bool:
        """Whether it is a key's end: a socket, or a fixed peg."""
        return self.slot is None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Part(AffineSolid):
    """A printed part: an affine solid that knows what it is for.

    Parameters
    ----------
    role
        What it is for; one of `roles.PART_ROLES`.
    ends
        What it ends in.  An element has a near and a far end; a connector, a half and a loose
        peg have one; a tube has none.
    length
        Length of an element or a tube, in edge lengths; 0 for other parts.
    """

    role: str
    ends: tuple[PartEnd, ...] = ()
    length: float = 0.0

    def __post_init__(self) -> None:
        """Put the live parameters in order.

        Raises
        ------
        InvariantError
            It moves with something else.
        """
        if others := {*self.coefficients} - {*PARAMETERS}:
            msg = f"{self.name} moves with live parameters only, not with {min(others)}"
            raise InvariantError(msg)
        ordered = {p: self.coefficients[p] for p in PARAMETERS if p in self.coefficients}
        object.__setattr__(self, "coefficients", ordered)
        AffineSolid.__post_init__(self)

    @classmethod
    def of(
        cls, solid: AffineSolid, role: str, ends: tuple[PartEnd, ...] = (), length: float = 0.0
    ) -> Part:
        """A solid as a part."""
        return cls(
            name=solid.name,
            coefficients=solid.coefficients,
            triangles=solid.triangles,
            facets=solid.facets,
            role=role,
            ends=ends,
            length=length,
        )

    @property
    def is_element(self) -> bool:
        """Whether it is an edge element."""
        return self.role == "element"

    @property
    def fits_one_way(self) -> bool:
        """Whether it is an element whose ends differ."""
        return self.is_element and self.ends[0] != self.ends[1]


@dataclass(frozen=True, slots=True)
class Vertex:
    """What stands at a vertex of the frame.

    Parameters
    ----------
    joint
        Name of the kind of joint.
    pose
        Where it stands, its first key along x; its position in edge lengths.
    """

    joint: str
    pose: Pose


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """The way of some pieces out of a joint.

    Parameters
    ----------
    name
        What comes out.
    moving
        Which of the joint's `pieces` move, as one, by number; each with its tube, if it has
        one.
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
        Direction of each edge, in degrees, ascending; that of the first key is 0.
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
    key
        What its keys are like.
    pieces
        What meets there, assembled: half A and half B of each key, the other connectors
        counter-clockwise, the pegs.
    figures
        What was measured on it, by name; plain numbers with their unit in the name.
    verdicts
        What was proved of it, by name; empty if it was not checked.
    ways
        The ways on which its pieces come apart, in order; empty if it was not checked.
    """

    name: str
    turns: tuple[float, ...]
    keys: tuple[int, ...]
    caps: tuple[int, ...]
    connectors: tuple[str, ...]
    over: tuple[int, ...]
    weave: Mapping[str, float | int | str]
    key: Key
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

    def is_cap(self, piece: Placement) -> bool:
        """Whether one of its pieces is in a slot that has no tube wherever this joint stands."""
        return piece.slot in self.caps


@dataclass(frozen=True, slots=True, eq=False)
class Kit:
    """Everything generated for one frame.

    Parameters
    ----------
    name
        What its files are called.
    key
        One of `KEYS`.
    detail
        Name of the detail level.
    command
        The command line that makes this kit again.
    values
        Default of each live parameter that the kit has, in mm.  A kit without a bore has no
        ``bore``.
    ranges
        What each live parameter may be; every one in `values` has at least one.
    parts
        The parts by name, edge elements first.
    joints
        The kinds of joints.
    frame
        The frame, in mm; None for a single joint, which is there to be judged.
    vertices
        What stands at each of the frame's vertices.
    placements
        Where everything stands: the elements by edge, then the pieces by vertex.
    tiling
        The tiling whose cells make the frame; None if rows and columns cannot be set.
    cells
        What stands in a cell of the tiling.
    rows, columns
        How many cells there are; 0 without a tiling.
    rim
        One of `RIMS`.
    refused
        Joints that could not be proved, so that other keys were chosen.
    material
        What it is to be printed with; one of `DENSITIES`.
    slicing
        What printing it takes, if a slicer was asked.
    """

    name: str
    key: str
    detail: str
    command: str
    values: Mapping[str, float]
    ranges: tuple[Range, ...]
    parts: Mapping[str, Part]
    joints: tuple[Joint, ...]
    frame: Frame | None
    vertices: tuple[Vertex, ...]
    placements: tuple[Placement, ...]
    tiling: NamedTiling | None = None
    cells: Cells | None = None
    rows: int = 0
    columns: int = 0
    rim: str = "caps"
    refused: tuple[Refused, ...] = ()
    material: str = "PLA"
    slicing: Slicing | None = None

    @property
    def elements(self) -> list[str]:
        """The edge elements among its parts."""
        return [name for name, part in self.parts.items() if part.is_element]

    def joint(self, name: str) -> Joint:
        """The kind of joint with this name."""
        return next(joint for joint in self.joints if joint.name == name)

    @property
    def proved(self) -> bool:
        """Whether something was proved of every joint."""
        return all(joint.verdicts for joint in self.joints)
