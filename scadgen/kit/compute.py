"""The pieces of many joints: made by whoever there is to work, and kept."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from scadgen.element.pieces import Piece
from scadgen.element.squares import Key
from scadgen.errors import GeometryError
from scadgen.joint.surface import Surface
from scadgen.joint.weave import LIMITS, Weave
from scadgen.kit.pieces import Pieces, best_pieces
from scadgen.solid.affine import Floats
from scadgen.work.cache import Entry
from scadgen.work.fingerprint import key_of
from scadgen.work.mapping import Execution, Task, map_cached

__all__ = ["JointSpec", "compute_joint", "compute_joints"]

#: Decimals of directions, in radians: joints that are the same but for rounding are the same.
_DECIMALS = 11


@dataclass(frozen=True, slots=True)
class JointSpec:
    """A joint whose pieces are wanted.

    Parameters
    ----------
    directions
        Of the edges, ascending, in [0, 2 pi).
    weave, style, level, keys, bored
        As `best_pieces` takes them.
    wider
        What is added to the ring ratio, one after the other, until there are sound pieces.
    where
        Where it stands, for the message if there are none.
    """

    directions: tuple[float, ...]
    weave: Weave
    style: str
    level: str
    keys: tuple[int, ...] = (0,)
    bored: bool = False
    wider: tuple[float, ...] = (0.0,)
    where: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        """Round directions, so that the pieces are those of the numbers that tell them apart."""
        rounded = tuple((np.round(self.directions, _DECIMALS) + 0.0).tolist())
        object.__setattr__(self, "directions", rounded)


def compute_joints(
    wanted: Sequence[JointSpec], means: Execution, done: Callable[[int], None] = lambda _: None
) -> tuple[Pieces, ...]:
    """The pieces of joints, in order.

    Parameters
    ----------
    wanted
        The joints.
    means
        Who makes them, and where they are kept.
    done
        Told how many are there, after each.

    Raises
    ------
    GeometryError
        The first joint that has no sound ones: says where.
    """
    found: dict[int, Pieces] = {}
    for number, pieces in map_cached(_TASK, wanted, means):
        found[number] = pieces
        done(len(found))
    return tuple(found[number] for number in range(len(wanted)))


def compute_joint(wanted: JointSpec) -> Pieces:
    """The pieces of one joint, on a ring hardly wider where need be.

    Raises
    ------
    GeometryError
        The weave makes no sound ones: says where.
    """
    refusal: GeometryError | None = None
    for wider in wanted.wider:
        own, most = wanted.weave, LIMITS["ring_ratio"][1]
        if wider:
            own = replace(own, ring_ratio=min(round(own.ring_ratio + wider, 2), most))
        try:
            return best_pieces(
                wanted.directions,
                own,
                wanted.style,
                wanted.level,
                wanted.keys,
                bored=wanted.bored,
            )
        except GeometryError as error:
            refusal = refusal or error
    msg = f"{wanted.where}: {refusal}" if wanted.where else str(refusal)
    raise GeometryError(msg) from refusal


def _key(wanted: JointSpec) -> str:
    return key_of("pieces", **{k: v for k, v in asdict(wanted).items() if k != "where"})


def _packed(pieces: Pieces) -> Entry:
    """Pieces as what is kept; those that are one and the same once."""
    own = list(dict.fromkeys((*pieces.connectors, *itertools.chain(*pieces.halves.values()))))
    number = {piece: n for n, piece in enumerate(own)}
    arrays: dict[str, Any] = {}
    for n, piece in enumerate(own):
        arrays[f"{n} points"] = piece.surface.points
        arrays[f"{n} walls"] = piece.surface.walls
        arrays[f"{n} displacement"] = piece.displacement
        for place, sides in enumerate(piece.surface.outlines.values()):
            arrays[f"{n} outline {place}"] = sides
    values = {
        "weave": pieces.weave.as_dict(),
        "key": asdict(pieces.key),
        "rest": [piece.rest for piece in own],
        "facets": [list(piece.surface.outlines) for piece in own],
        "connectors": [number[piece] for piece in pieces.connectors],
        "halves": [[edge, number[a], number[b]] for edge, (a, b) in pieces.halves.items()],
        "clearance_limit": pieces.clearance_limit,
        "holes": pieces.holes,
        "arm": pieces.arm,
        "volume": pieces.volume,
        "extra": pieces.extra,
    }
    return Entry({"pieces": values}, arrays)


def _unpacked(entry: Entry, wanted: JointSpec) -> Pieces:
    values = entry.values["pieces"]
    own = [
        _piece(n, facets, rest, entry.arrays)
        for n, (facets, rest) in enumerate(zip(values["facets"], values["rest"], strict=True))
    ]
    return Pieces(
        weave=Weave.from_dict(values["weave"], wanted.weave.name),
        key=Key(**values["key"]),
        connectors=tuple(own[n] for n in values["connectors"]),
        halves={edge: (own[a], own[b]) for edge, a, b in values["halves"]},
        clearance_limit=values["clearance_limit"],
        holes=tuple(values["holes"]),
        arm=values["arm"],
        volume=values["volume"],
        extra=values["extra"],
    )


def _piece(
    number: int, facets: Sequence[tuple[str, int]], rest: float, arrays: Mapping[str, Floats]
) -> Piece:
    outlines = {
        (kind, which): arrays[f"{number} outline {place}"].astype(np.int64)
        for place, (kind, which) in enumerate(facets)
    }
    walls = arrays[f"{number} walls"].astype(np.int64)
    surface = Surface(arrays[f"{number} points"], walls, outlines)
    return Piece(surface, arrays[f"{number} displacement"], rest)


_TASK = Task(compute_joint, _key, _packed, _unpacked)
