"""How large a frame is, and how wide the rings of its joints: what its parts are computed for."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from scadgen.errors import GeometryError, InputError, InvariantError
from scadgen.frame.classes import Classes, classify
from scadgen.frame.graph import Frame
from scadgen.frame.joints import least_scale
from scadgen.frame.kinds import Kinds, choose_kinds
from scadgen.frame.words import corner
from scadgen.joint.weave import Weave, any_joint, built_in
from scadgen.kit.ranges import LONGEST, SIDE, check_values
from scadgen.kit.request import Request
from scadgen.kit.room import reaches, room
from scadgen.plane.drawn import make_frame
from scadgen.plane.periodic import Block
from scadgen.plane.spacing import Spacing
from scadgen.solid.affine import Floats

__all__ = ["WIDER", "Design", "design", "growth"]

#: Rows and columns of a tiling whose joints and edges are looked at: each is inside of some.
_LOOKED_AT = 3

#: Tube between two joints where it may be chosen, in sides, by key style: room for two sockets,
#: and for rings that grow.
_ROOM = {"loose": 2.0, "fixed": 1.4}

#: Decimals of the edge length, in mm.
_DECIMALS = 6

#: What is added to a ring ratio until walls keep away from the ring's edges: they hardly move.
WIDER = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3)

#: More than these lengths, in sides, is refused by itself: edges are looked at with no more.
_MODEST = {"clearance": 0.06, "peg_clearance": 0.1, "peg_length": 1.5}


@dataclass(frozen=True, eq=False)
class Design:
    """What a kit's parts are computed for.

    Parameters
    ----------
    frame
        The frame, in mm; of a tiling a block of its cells.
    block
        Those cells.
    same
        What of the frame is the same.
    kinds
        What stands where.
    weaves
        The weave of each kind of joint.
    """

    frame: Frame
    block: Block | None
    same: Classes
    kinds: Kinds
    weaves: tuple[Weave, ...]

    @property
    def unit(self) -> float:
        """Length of the shortest edges, in mm, as their parts have it: the edge length."""
        return round(_shortest(self.same), _DECIMALS)

    @property
    def rings(self) -> Floats:
        """``(n,) float``: the ring ratio of each vertex."""
        return np.array([self.weaves[n].ring_ratio for n in self.kinds.kind_of])

    def where(self, number: int) -> str:
        """Where the first joint of a kind stands, and its angles."""
        return _where(self.frame, self.kinds, number)

    def check_longest(self, side: float) -> None:
        """Refuse edges that are too long to be printed.

        Raises
        ------
        GeometryError
            One is: says where.
        """
        _check_longest(self.frame, side)

    def check_room(self, request: Request) -> None:
        """Refuse edges that are too short, or too near to joints.

        Raises
        ------
        GeometryError
            One is: says where.
        """
        shapes = [self.kinds.shape(n).directions for n in range(len(self.weaves))]
        reach = [reaches(own, w.ring_ratio) for own, w in zip(shapes, self.weaves, strict=True)]
        rings = np.array([weave.ring_ratio for weave in self.weaves])
        modest = {
            n: min(v, _MODEST[n] * request.side) for n, v in request.values.items() if n in _MODEST
        }
        fixed = request.key == "fixed"
        needs = room(self.frame, self.kinds, np.array(reach), rings, modest, fixed=fixed)
        needs.check(request.side)


def design(request: Request) -> Design:
    """Choose the frame's size, its kinds of joints, and their weaves.

    Raises
    ------
    InputError
        A side outside its range, edges that no ring can hold, or no rows for fixed pegs.
    GeometryError
        A kind of joint that has no regular weave.
    """
    check_values([SIDE], {"side": request.side})
    drawn, block = _drawn(request)
    found = _designed(request, drawn, block)
    shortest = _shortest(found.same)
    wanted = request.values.get("edge_length", shortest)
    if request.resizable and "edge_length" not in request.values:
        wanted = _needed(request, found)
    if abs(wanted - shortest) <= 10**-_DECIMALS:
        return found
    # Anew, to the last digit as from the frame that the kit keeps.
    return _designed(request, *_drawn(request, wanted / shortest))


def growth(request: Request) -> float:
    """By what factor a frame must grow to have room for its joints.

    Its shortest edges then are whole sides, six at least.

    Raises
    ------
    InputError
        A side outside its range, or edges that no ring can hold.
    """
    check_values([SIDE], {"side": request.side})
    found = _designed(request, *_drawn(request))
    return _needed(request, found) / _shortest(found.same)


def _drawn(request: Request, scale: float = 1.0) -> tuple[Frame, Block | None]:
    """The frame that is looked at, some times as large.

    Raises
    ------
    InvariantError
        There is none.
    """
    if request.tiling is not None:
        block = request.tiling.made().block(_LOOKED_AT, _LOOKED_AT)
        block = block if scale == 1.0 else block.scaled(scale)
        return block.frame, block
    if request.frame is None:
        msg = "a kit has a frame or a tiling"
        raise InvariantError(msg)
    frame = request.frame
    if scale != 1.0:
        frame = make_frame(frame.name, frame.plan * scale, frame.edges, frame.numbering)
    return frame, None


def _designed(request: Request, frame: Frame, block: Block | None) -> Design:
    same = classify(frame)
    kinds = choose_kinds(
        frame,
        same,
        rim=request.rim == "caps",
        refused=request.refused,
        in_rows=request.regular or request.key == "fixed",
    )
    weaves = tuple(_weave(request, frame, kinds, number) for number in range(len(kinds.kinds)))
    return Design(frame, block, same, kinds, weaves)


def _shortest(same: Classes) -> float:
    """Length of the shortest edges, in mm, as their parts have it."""
    return min(edge.length for edge in same.edges)


def _needed(request: Request, found: Design) -> float:
    """Length of its shortest edges, in mm, with which a frame has room for its joints."""
    side, shortest = request.side, _shortest(found.same)
    need = shortest * least_scale(found.frame, side, found.rings, _ROOM[request.key])
    if not request.regular:  # whose joints keep apart if their edges are long enough
        need = max(need, shortest * Spacing(found.frame, found.rings + WIDER[-1]).least_scale(side))
    return max(6, math.ceil(need / side - 1e-9)) * side


def _check_longest(frame: Frame, side: float) -> None:
    """Refuse edges that are too long to be printed.

    Raises
    ------
    GeometryError
        One is: says where.
    """
    edge = int(frame.lengths.argmax())
    if frame.lengths[edge] > LONGEST:
        msg = (
            f"{frame.called_edge(edge)}, {frame.lengths[edge]:.4g} mm long with a side "
            f"of {side:g} mm, is too long: at most {LONGEST:g} mm works; a smaller side or frame, "
            "or a vertex in its middle helps"
        )
        raise GeometryError(msg)


def _weave(request: Request, frame: Frame, kinds: Kinds, number: int) -> Weave:
    """The weave of all joints of one kind.

    Raises
    ------
    InputError
        Two of its edges are too near each other: says where.
    """
    gaps = kinds.shape(number).gaps
    if request.regular:
        return request.weave or built_in(len(gaps), request.key)
    try:
        return any_joint(float(gaps.min()))
    except InputError as error:
        msg = f"{_where(frame, kinds, number)}: {error}"
        raise InputError(msg) from error


def _where(frame: Frame, kinds: Kinds, number: int) -> str:
    """Where the joint of a kind with the narrowest gap stands, and the angles of the kind."""
    vertex = min(
        np.flatnonzero(kinds.kind_of == number).tolist(),
        key=lambda one: float(frame.gaps(one).min()),
    )
    gaps = np.degrees(kinds.shape(number).gaps).tolist()
    return corner(frame.called_vertex(vertex), gaps)
