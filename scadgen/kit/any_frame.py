"""Kits of any frame: a kind of joint for each set of angles and keys, an element for each edge's.

Joints have letters.  A connector is named by the first joint and edge that has it,
``connector_A1``, and so are the halves it may be split into: ``half_A1``, and ``half_A1_over`` for
half B where that is another part; either may be a half of other joints too.  Edge elements are
numbered.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from scadgen.element.ends import End, connector, connector_end, key_end, part, peg
from scadgen.element.pieces import half
from scadgen.element.squares import Key
from scadgen.errors import GeometryError, InputError, InvariantError
from scadgen.frame.graph import Frame, make_frame
from scadgen.frame.joints import least_scale
from scadgen.frame.kinds import Kinds, choose_kinds
from scadgen.frame.placement import Placement
from scadgen.frame.planarity import corner, where
from scadgen.frame.sameness import Sameness, joint_name, sameness
from scadgen.joint.weave import Weave, any_joint
from scadgen.kit.apart import Apart
from scadgen.kit.elements import ElementEnd, Elements, edge_elements
from scadgen.kit.model import Joint, Kit
from scadgen.kit.named import Named
from scadgen.kit.pieces import Pieces
from scadgen.kit.ranges import LONGEST, SIDE, check_values, edge_range, ranges
from scadgen.kit.request import Request, default_values
from scadgen.kit.room import reaches, room
from scadgen.kit.wanted import Wanted, wanted_pieces
from scadgen.solid.affine import AffineSolid, Floats, Range
from scadgen.work.each import Means

__all__ = ["build_frame", "growth"]

#: Decimals of a placement, in edge lengths and degrees.
_DECIMALS = 9

#: Decimals of the edge length, in mm.
_LENGTH_DECIMALS = 6

#: Tube between two joints where it may be chosen, in sides: room for two sockets, and for rings
#: that grow.
_ROOM = 2.0

#: More than these lengths, in sides, is refused by itself: edges are looked at with no more.
_MODEST = {"clearance": 0.06, "peg_clearance": 0.1, "peg_length": 1.5}

#: What is added to a ring ratio until walls keep away from the ring's edges: they hardly move.
_WIDER = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3)


def build_frame(
    request: Request, means: Means, done: Callable[[int, int], None] = lambda *_: None
) -> Kit:
    """Make a kit of any frame.

    Parameters
    ----------
    request
        What kit to make.
    means
        Who computes its joints, and where they are kept.
    done
        Told how many of how many joints are computed, after each.

    Raises
    ------
    InputError
        A live parameter outside its range, or edges that no ring can hold.
    GeometryError
        A joint's weave makes no sound pieces, or an edge is too short: says where.
    """
    frame, side = _graph(request), request.values.get("side", 10.0)
    check_values([SIDE], {"side": side})
    same, kinds, weaves = _joints(request, frame)
    rings = np.array([weaves[n].ring_ratio for n in kinds.kind_of])
    sized = _sized(request, frame, _shortest(same), rings)
    if sized is not frame:
        # Anew, to the last digit as from the frame that the kit keeps.
        frame = sized
        same, kinds, weaves = _joints(request, frame)
    _check_longest(frame, side)
    reach = [reaches(kinds.shape(n).directions, weave.ring_ratio) for n, weave in enumerate(weaves)]
    modest = {n: min(v, _MODEST[n] * side) for n, v in request.values.items() if n in _MODEST}
    rings = np.array([weave.ring_ratio for weave in weaves])
    room(frame, kinds, np.array(reach), rings, modest).check(side)
    wanted = [_wanted(request, frame, kinds, number, weave) for number, weave in enumerate(weaves)]
    pieces = wanted_pieces(wanted, means, lambda count: done(count, len(wanted)))
    build = _Build(frame, same, kinds, pieces)
    limits = build.limits()
    values = default_values(request, pieces, limits)
    values["edge_length"] = build.unit
    check_values([limit for limit in limits if limit.parameter != "edge_length"], values)
    # Rings may have become wider.
    reach = [(one.key.tube_start, one.key.pad) for one in pieces]
    rings = np.array([one.weave.ring_ratio for one in pieces])
    room(frame, kinds, np.array(reach), rings, values).check(side)
    check_values(limits, values)
    return Kit(
        frame=request.frame,
        key=request.key,
        rows=0,
        columns=0,
        detail=request.detail,
        command=request.command,
        values=values,
        ranges=limits,
        parts=build.parts(),
        joints=tuple(build.joint(n) for n in range(len(kinds.kinds))),
        placements=tuple(build.placements()),
        graph=frame,
        rim=request.rim,
        refused=request.refused,
    )


def _graph(request: Request) -> Frame:
    """The frame that is asked for.

    Raises
    ------
    InvariantError
        There is none.
    """
    if request.graph is None:
        msg = "a frame without rows and columns has a graph"
        raise InvariantError(msg)
    return request.graph


def _joints(request: Request, frame: Frame) -> tuple[Sameness, Kinds, list[Weave]]:
    """What of a frame is the same, its kinds of joints, and the weave of each."""
    same = sameness(frame)
    kinds = choose_kinds(frame, same, rim=request.rim == "caps", refused=request.refused)
    return same, kinds, [_weave(frame, kinds, number) for number in range(len(kinds.kinds))]


def _shortest(same: Sameness) -> float:
    """Length of the shortest edges, in mm, as their parts have it."""
    return min(edge.length for edge in same.edges)


def growth(request: Request) -> float:
    """How many times as large a frame has to be for its joints.

    Its shortest edges then are whole sides, six at least.

    Raises
    ------
    InputError
        A side outside its range, or edges that no ring can hold.
    """
    frame = _graph(request)
    check_values([SIDE], {"side": request.values.get("side", 10.0)})
    same, kinds, weaves = _joints(request, frame)
    rings = np.array([weaves[n].ring_ratio for n in kinds.kind_of])
    return _needed(request, frame, _shortest(same), rings) / _shortest(same)


def _needed(request: Request, frame: Frame, shortest: float, rings: Floats) -> float:
    """Length of its shortest edges, in mm, with which a frame has room for its joints."""
    side = request.values.get("side", 10.0)
    need = shortest * least_scale(frame, side, rings, _ROOM)
    need = max(need, shortest * Apart(frame, rings + _WIDER[-1]).least_scale(side))
    return max(6, math.ceil(need / side - 1e-9)) * side


def _sized(request: Request, frame: Frame, shortest: float, rings: Floats) -> Frame:
    """The frame as large as its shortest edges are to be, or as its joints need."""
    wanted = request.values.get("edge_length", shortest)
    if request.resizable and "edge_length" not in request.values:
        wanted = _needed(request, frame, shortest, rings)
    if abs(wanted - shortest) > 10**-_LENGTH_DECIMALS:
        frame = make_frame(frame.name, frame.vertices * (wanted / shortest), frame.edges)
    return frame


def _check_longest(frame: Frame, side: float) -> None:
    """Refuse edges that are too long to be printed.

    Raises
    ------
    GeometryError
        One is: says where.
    """
    edge = int(frame.lengths.argmax())
    if frame.lengths[edge] > LONGEST:
        first, second = (f"vertex {v} at {where(frame.vertices[v])}" for v in frame.edges[edge])
        msg = (
            f"edge {edge} from {first} to {second}, {frame.lengths[edge]:.4g} mm long with a side "
            f"of {side:g} mm, is too long: at most {LONGEST:g} mm works; a smaller side or frame, "
            "or a vertex in its middle helps"
        )
        raise GeometryError(msg)


def _weave(frame: Frame, kinds: Kinds, number: int) -> Weave:
    """The weave of all joints of one kind.

    Raises
    ------
    InputError
        Two of its edges are too near each other: says where.
    """
    try:
        return any_joint(float(kinds.shape(number).gaps.min()))
    except InputError as error:
        msg = f"{_where(frame, kinds, number)}: {error}"
        raise InputError(msg) from error


def _where(frame: Frame, kinds: Kinds, number: int) -> str:
    """Where the first joint of a kind stands, and its angles."""
    vertex = int(np.flatnonzero(kinds.kind_of == number)[0])
    gaps = np.degrees(kinds.shape(number).gaps).tolist()
    return corner(vertex, frame.vertices[vertex], gaps)


def _wanted(request: Request, frame: Frame, kinds: Kinds, number: int, weave: Weave) -> Wanted:
    """The joint whose pieces all joints of one kind have."""
    return Wanted(
        tuple(kinds.shape(number).directions.tolist()),
        weave,
        request.key,
        request.detail,
        kinds.kinds[number].keys,
        request.bored,
        _WIDER,
        _where(frame, kinds, number),
    )


@dataclass(frozen=True, eq=False)
class _Build:
    """What a frame's parts and placements are made from."""

    frame: Frame
    same: Sameness
    kinds: Kinds
    pieces: tuple[Pieces, ...]

    @property
    def unit(self) -> float:
        """Length of the shortest edges, in mm: the edge length."""
        return round(_shortest(self.same), _LENGTH_DECIMALS)

    @cached_property
    def named(self) -> Named:
        """The parts of its joints."""
        return Named(self.pieces, self.kinds.symmetries)

    @cached_property
    def elements(self) -> Elements:
        """Its edge elements."""
        lengths = (self.same.lengths / self.unit).round(_DECIMALS)
        named = self.named
        return edge_elements(self.kinds, self.frame.edges, lengths, named.sockets, named.slots)

    def limits(self) -> tuple[Range, ...]:
        """What the live parameters may be, so that all joints and elements are sound."""
        keys = [one.key for one in self.pieces]
        start = max(key.tube_start for key in keys)
        tightest = Key(
            keys[0].style,
            keys[0].bored,
            start,
            start - max(key.tube_start - key.pad for key in keys),
            min(key.window for key in keys),
            min(key.depth for key in keys),
        )
        clearance = min(one.clearance_limit for one in self.pieces)
        hole = min(one.key_hole for one in self.pieces)
        of_joints = ranges(tightest, clearance, hole)
        of_edges = [
            edge_range([(keys[end.number], end.slot is None) for end in one.ends], one.length)
            for one in self.elements.kinds.values()
        ]
        return (
            *(limit for limit in of_joints if limit.parameter != "edge_length"),
            *(limit for n, limit in enumerate(of_edges) if limit not in of_edges[:n]),
        )

    def parts(self) -> dict[str, AffineSolid]:
        """Every part: the elements, the connectors, the halves, the pegs."""
        solids = [
            part(name, near, far, {"edge_length": one.length})
            for name, one in self.elements.kinds.items()
            for near, far in [map(self._surface, one.ends)]
        ]
        for made, pieces in ((connector, self.named.connectors), (half, self.named.halves)):
            solids += [replace(made(*piece), name=name) for name, piece in pieces.items()]
        solids += [replace(peg(key), name=name) for name, key in self.named.pegs.items()]
        return {solid.name: solid for solid in solids}

    def _surface(self, end: ElementEnd) -> End:
        one = self.pieces[end.number]
        if end.slot is None:
            return key_end(one.key)
        whole = one.connectors[end.slot]
        return connector_end(one.key, whole.turned_over() if end.over else whole)

    def _joint_name(self, number: int) -> str:
        return joint_name(number) if len(self.kinds.kinds) > 1 else ""

    def joint(self, number: int) -> Joint:
        """A kind of joint, turned so that its first key is along +x."""
        kind, shape, one = self.kinds.kinds[number], self.kinds.shape(number), self.pieces[number]
        count = len(shape.directions)
        first = kind.keys[0]
        turns = np.degrees(
            (np.roll(shape.directions, -first) - shape.directions[first]) % (2 * np.pi)
        )
        connectors = [self.named.connector(number, (slot + first) % count) for slot in range(count)]
        return Joint(
            name=self._joint_name(number),
            turns=tuple(turns.round(_DECIMALS).tolist()),
            keys=tuple((slot - first) % count for slot in kind.keys),
            caps=tuple(sorted((slot - first) % count for slot in kind.caps)),
            connectors=tuple(name for name, _ in connectors),
            over=tuple(slot for slot, (_, over) in enumerate(connectors) if over),
            weave=one.weave.as_dict(),
            pieces=tuple(
                self._standing(
                    number, (0.0, 0.0), shape.directions - shape.directions[first], range(count)
                )
            ),
            figures=one.figures(),
        )

    def _standing(
        self,
        number: int,
        at: tuple[float, float],
        directions: Floats,
        caps: Iterable[int],
        *,
        over: bool = False,
    ) -> Iterator[Placement]:
        """The pieces of a joint where it stands: halves, connectors without a tube, pegs."""
        kind, count, joint = self.kinds.kinds[number], len(directions), self._joint_name(number)
        degrees = (np.degrees(directions).round(_DECIMALS) % 360).tolist()
        for slot in kind.keys:
            for name, flip, role in zip(
                self.named.half_names(number, slot),
                (over, not over),
                ("half_a", "half_b"),
                strict=True,
            ):
                yield Placement(name, at, degrees[slot], flip, role, joint)
        first = kind.keys[0]
        for slot in sorted(set(caps) - set(kind.keys), key=lambda s: (s - first) % count):
            name, flip = self.named.connector(number, slot)
            yield Placement(name, at, degrees[slot], flip != over, "cap", joint)
        for slot in kind.keys:
            yield Placement(self.named.peg(number), at, degrees[slot], over, "peg", joint)

    def placements(self) -> Iterator[Placement]:
        """Where everything stands: the elements, then the pieces of each joint."""
        vertices = (self.frame.vertices / self.unit).round(_DECIMALS) + 0.0
        directions = [self.kinds.directions(vertex) for vertex in range(len(vertices))]
        used: list[set[int]] = [set() for _ in vertices]
        for pair, slots, laid in zip(
            self.frame.edges.tolist(), self.kinds.slots.tolist(), self.elements.laid, strict=True
        ):
            for vertex, slot in zip(pair, slots, strict=True):
                used[vertex].add(slot)
            vertex, slot = pair[laid.swapped], slots[laid.swapped]
            turn = round(float(np.degrees(directions[vertex][slot])), _DECIMALS) % 360
            ends = self.elements.kinds[laid.name].ends
            role = "cross" if any(end.slot is None for end in ends) else "row"
            at = (float(vertices[vertex, 0]), float(vertices[vertex, 1]))
            yield Placement(laid.name, at, turn, laid.flipped, role)
        for vertex, (x, y) in enumerate(vertices.tolist()):
            number, over = int(self.kinds.kind_of[vertex]), bool(self.kinds.over[vertex])
            caps = set(range(len(directions[vertex]))) - used[vertex]
            yield from self._standing(number, (x, y), directions[vertex], caps, over=over)
