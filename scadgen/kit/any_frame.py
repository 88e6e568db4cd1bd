"""Kits of any frame: a kind of joint for each set of angles and keys, an element for each edge's.

Joints have letters.  A connector is named by its joint and its edge there, ``connector_A1``, and
so are the halves it may be split into: ``half_A1``, and ``half_A1_over`` for half B where that is
another part.  Edge elements are numbered.
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
from scadgen.errors import InputError, InvariantError
from scadgen.frame.graph import Frame, make_frame
from scadgen.frame.joints import least_scale
from scadgen.frame.kinds import Kinds, choose_kinds
from scadgen.frame.placement import Placement
from scadgen.frame.planarity import corner
from scadgen.frame.sameness import Sameness, joint_name, sameness
from scadgen.joint.weave import Weave, any_joint
from scadgen.kit.apart import Apart
from scadgen.kit.model import Joint, Kit
from scadgen.kit.pieces import Pieces
from scadgen.kit.ranges import SIDE, check_values, edge_range, ranges
from scadgen.kit.request import Request, default_values
from scadgen.kit.room import reaches, room
from scadgen.kit.wanted import Wanted, wanted_pieces
from scadgen.solid.affine import AffineSolid, Floats, Range
from scadgen.work.each import Means

__all__ = ["build_frame"]

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

#: An end of an element: number of its kind of joint, slot there, and whether it is a socket.
_End = tuple[int, int, bool]


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


def _sized(request: Request, frame: Frame, shortest: float, rings: Floats) -> Frame:
    """The frame as large as its shortest edges are to be, or as its joints need."""
    side = request.values.get("side", 10.0)
    wanted = request.values.get("edge_length", shortest)
    if request.resizable and "edge_length" not in request.values:
        need = shortest * least_scale(frame, side, rings, _ROOM)
        need = max(need, shortest * Apart(frame, rings + _WIDER[-1]).least_scale(side))
        wanted = max(6, math.ceil(need / side - 1e-9)) * side
    if abs(wanted - shortest) > 10**-_LENGTH_DECIMALS:
        frame = make_frame(frame.name, frame.vertices * (wanted / shortest), frame.edges)
    return frame


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
    def elements(self) -> dict[tuple[_End, _End, float], str]:
        """Name of each kind of edge element, by its ends and its length in edge lengths."""
        found = {self._element(edge)[0] for edge in range(len(self.frame.edges))}
        return {what: f"edge_{n}" for n, what in enumerate(sorted(found), 1)}

    def _element(self, edge: int) -> tuple[tuple[_End, _End, float], bool]:
        """What an edge's element is, and whether it stands the other way round."""
        length = self.same.edges[self.same.edge_of[edge]].length / self.unit
        near, far = (self._end(edge, end) for end in (0, 1))
        swapped = far < near
        return ((far, near) if swapped else (near, far)) + (round(length, _DECIMALS),), swapped

    def _end(self, edge: int, end: int) -> _End:
        number = int(self.kinds.kind_of[self.frame.edges[edge, end]])
        slot = int(self.kinds.slots[edge, end])
        return number, slot % self.kinds.period(number), slot in self.kinds.kinds[number].keys

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
        hole = min(one.hole(edge) for one in self.pieces for edge in one.halves)
        of_joints = ranges(tightest, clearance, hole)
        of_edges = [
            edge_range((keys[a], near), (keys[b], far), length)
            for (a, _, near), (b, _, far), length in sorted(self.elements)
        ]
        return (
            *(limit for limit in of_joints if limit.parameter != "edge_length"),
            *(limit for n, limit in enumerate(of_edges) if limit not in of_edges[:n]),
        )

    def parts(self) -> dict[str, AffineSolid]:
        """Every part: the elements, the connectors, the halves, the pegs."""
        solids = [
            part(name, self._surface(near), self._surface(far), {"edge_length": length})
            for (near, far, length), name in self.elements.items()
        ]
        for number, one in enumerate(self.pieces):
            for slot in range(self.kinds.period(number)):
                solid = connector(one.key, one.connectors[slot])
                solids.append(replace(solid, name=self._name("connector", number, slot)))
        for number, one in enumerate(self.pieces):
            period = self.kinds.period(number)
            for slot, (first, second) in one.halves.items():
                if slot >= period:
                    continue
                names = self._halves(number, slot)
                for name, piece in dict(zip(names, (first, second), strict=True)).items():
                    solids.append(replace(half(one.key, piece), name=name))
        solids += [
            replace(peg(self.pieces[number].key), name=self._peg(number))
            for number in range(len(self.pieces))
        ]
        return {solid.name: solid for solid in solids}

    def _surface(self, end: _End) -> End:
        number, slot, socket = end
        one = self.pieces[number]
        return key_end(one.key) if socket else connector_end(one.key, one.connectors[slot])

    def _name(self, what: str, number: int, slot: int) -> str:
        return f"{what}_{joint_name(number)}{slot % self.kinds.period(number) + 1}"

    def _halves(self, number: int, slot: int) -> tuple[str, str]:
        """Names of half A and half B, the same where they are the same part."""
        first, second = self.pieces[number].halves[slot]
        name = self._name("half", number, slot)
        return name, name if first is second else f"{name}_over"

    def _peg(self, number: int) -> str:
        """Name of a joint's peg: those that start in the same place are the same."""
        pads = [round(one.key.pad, _DECIMALS) for one in self.pieces]
        alike = pads.index(pads[number])
        return "peg" if len(set(pads)) == 1 else f"peg_{joint_name(alike)}"

    def joint(self, number: int) -> Joint:
        """A kind of joint, turned so that its first key is along +x."""
        kind, shape, one = self.kinds.kinds[number], self.kinds.shape(number), self.pieces[number]
        count = len(shape.directions)
        first = kind.keys[0]
        turns = np.degrees(
            (np.roll(shape.directions, -first) - shape.directions[first]) % (2 * np.pi)
        )
        return Joint(
            name=joint_name(number) if len(self.kinds.kinds) > 1 else "",
            turns=tuple(turns.round(_DECIMALS).tolist()),
            keys=tuple((slot - first) % count for slot in kind.keys),
            caps=tuple(sorted((slot - first) % count for slot in kind.caps)),
            connectors=tuple(
                self._name("connector", number, slot + first) for slot in range(count)
            ),
            weave=one.weave.as_dict(),
            pieces=tuple(
                self._standing(number, (0.0, 0.0), -shape.directions[first], range(count))
            ),
            figures=one.figures(),
        )

    def _standing(
        self, number: int, at: tuple[float, float], turn: float, caps: Iterable[int]
    ) -> Iterator[Placement]:
        """The pieces of a joint where it stands: halves, connectors without a tube, pegs."""
        kind, directions = self.kinds.kinds[number], self.kinds.shape(number).directions
        degrees = (np.degrees(turn + directions).round(_DECIMALS) % 360).tolist()
        for slot in kind.keys:
            for name, flip, role in zip(
                self._halves(number, slot), (False, True), ("half_a", "half_b"), strict=True
            ):
                yield Placement(name, at, degrees[slot], flip, role)
        first = kind.keys[0]
        for slot in sorted(set(caps) - set(kind.keys), key=lambda s: (s - first) % len(directions)):
            name = self._name("connector", number, slot)
            yield Placement(name, at, degrees[slot], flip=False, role="cap")
        for slot in kind.keys:
            yield Placement(self._peg(number), at, degrees[slot], flip=False, role="peg")

    def placements(self) -> Iterator[Placement]:
        """Where everything stands: the elements, then the pieces of each joint."""
        vertices = (self.frame.vertices / self.unit).round(_DECIMALS) + 0.0
        used: list[set[int]] = [set() for _ in vertices]
        for edge, pair in enumerate(self.frame.edges):
            what, swapped = self._element(edge)
            for end, vertex in enumerate(pair):
                used[vertex].add(int(self.kinds.slots[edge, end]))
            vertex, slot = int(pair[int(swapped)]), int(self.kinds.slots[edge, int(swapped)])
            shape = self.kinds.shape(int(self.kinds.kind_of[vertex]))
            turn = float(np.degrees(self.kinds.turn[vertex] + shape.directions[slot]))
            role = "cross" if what[0][2] or what[1][2] else "row"
            at = (float(vertices[vertex, 0]), float(vertices[vertex, 1]))
            yield Placement(
                self.elements[what], at, round(turn, _DECIMALS) % 360, flip=False, role=role
            )
        for vertex, (x, y) in enumerate(vertices.tolist()):
            number = int(self.kinds.kind_of[vertex])
            caps = set(range(len(self.kinds.shape(number).directions))) - used[vertex]
            yield from self._standing(number, (x, y), float(self.kinds.turn[vertex]), caps)
