"""Which shape of joint stands at every vertex: at the rim often a larger one, filled up with caps.

A vertex at the rim often lacks some edges of an inner one.  Caps, which are connectors without
a tube, stand for them, so that both are the same joint.  Where it fits into the inner one in
several ways, it takes the one in which its edges are like most inner ones.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scadgen.frame.classes import Classes
from scadgen.frame.faces import at_rim
from scadgen.frame.graph import Frame
from scadgen.frame.hosts import Host, find_hosts, sign
from scadgen.frame.slots import ANGLE
from scadgen.frame.template import Template
from scadgen.solid.affine import Floats, Ints

__all__ = ["Templates", "fit_templates"]


@dataclass(frozen=True, slots=True, eq=False)
class Templates:
    """What shape stands where.

    Parameters
    ----------
    shapes
        Of all joints.
    shape_of
        ``(n,) int``: the shape of each vertex.
    over
        ``(n,) bool``: whether its shape is turned over there; not if it can be turned over onto
        itself.
    turn
        ``(n,) float``: where its shape's first direction is there; as small as the shape's
        symmetry allows.
    slots
        ``(m, 2) int``: the slot of its shape that each end of an edge takes.
    """

    shapes: tuple[Template, ...]
    shape_of: Ints
    over: NDArray[np.bool_]
    turn: Floats
    slots: Ints


@dataclass(frozen=True, slots=True)
class _Stood:
    """A host at a vertex: whether it is turned over, its turn, its slots by the class's."""

    over: bool
    turn: float
    slots: tuple[int, ...]


def fit_templates(frame: Frame, same: Classes, *, rim: bool = True) -> Templates:
    """Find the shape of the joint at every vertex.

    Parameters
    ----------
    frame
        The frame.
    same
        What of it is the same.
    rim
        Whether a joint that lacks edges of another gets caps in their place.  Without, only
        lone ends of edges get some.
    """
    inner = np.unique(same.joint_of[~at_rim(frame)]).tolist()
    hosts = find_hosts(same, range(len(same.joints)) if not rim else inner)
    choice = _Choice(frame, same, hosts)
    chosen = choice.made()
    used = sorted({host.joint for host in chosen})
    found = [choice.standing(vertex, host) for vertex, host in enumerate(chosen)]
    return Templates(
        tuple(choice.shape(number) for number in used),
        np.array([used.index(host.joint) for host in chosen]),
        np.array([stood.over for stood in found]),
        np.array([stood.turn for stood in found]),
        np.array(
            [
                [found[v].slots[n] for v, n in zip(*pair, strict=True)]
                for pair in zip(frame.edges.tolist(), choice.place.tolist(), strict=True)
            ]
        ),
    )


class _Choice:
    """The choice of a host for each vertex."""

    def __init__(self, frame: Frame, same: Classes, hosts: Sequence[Sequence[Host]]) -> None:
        self._frame, self._same, self._hosts = frame, same, hosts
        #: Which direction of its class each end of an edge takes.
        way = np.where(same.over, -1, 1)[frame.edges]
        self.place = way * (frame.slots - same.shift[frame.edges]) % frame.degree[frame.edges]
        self._ends: list[list[tuple[int, int]]] = [[] for _ in frame.vertices]
        for edge, pair in enumerate(frame.edges.tolist()):
            for end, vertex in enumerate(pair):
                self._ends[vertex].append((edge, end))

    def shape(self, joint: int) -> Template:
        """The template of a class of joints, by number; of a lone end ``~number``."""
        return Template.of(self._same.joints[max(joint, ~joint)])

    def standing(self, vertex: int, host: Host) -> _Stood:
        """A joint in a host, turned as little as its symmetry allows, over only if need be.

        A lone end stays as it is: with its edge in the first slot.
        """
        over = bool(self._same.over[vertex]) != host.over
        turn = float(self._same.turn[vertex]) - sign(over) * host.turn
        if host.joint < 0:
            return _Stood(over, turn, host.slots)
        shape = self.shape(host.joint)
        slots, count, mirror = np.array(host.slots), len(shape.directions), shape.symmetry.mirror
        if over and mirror is not None:
            over, turn = False, turn - float(shape.directions[mirror])
            slots = mirror - slots
        least, steps = shape.symmetry.least_turn(np.array([turn % (2 * np.pi)]), ANGLE)
        slots = (slots + sign(over) * int(steps[0]) * shape.symmetry.period) % count
        return _Stood(over, float(least[0]), tuple(slots.tolist()))

    def made(self) -> list[Host]:
        """The host of each vertex."""
        options = [self._hosts[joint] for joint in self._same.joint_of.tolist()]
        chosen = {v: hosts[0] for v, hosts in enumerate(options) if len(hosts) == 1}
        usual = {
            pair
            for edge, ends in enumerate(self._frame.edges.tolist())
            if all(vertex in chosen for vertex in ends)
            for pair in itertools.permutations(
                self._end(edge, end, chosen[v]) for end, v in enumerate(ends)
            )
        }
        turns = self._turns(chosen)
        for vertex in self._outwards(chosen):
            chosen[vertex] = max(
                options[vertex],
                key=lambda host: (
                    self._likeness(vertex, host, chosen, usual),
                    self._is_usual(vertex, host, turns),
                ),
            )
        return [chosen[vertex] for vertex in range(len(options))]

    def _turns(self, chosen: Mapping[int, Host]) -> dict[tuple[int, bool], Floats]:
        """How the chosen hosts are turned, by their joint and whether they are turned over."""
        found = defaultdict(set)
        for vertex, host in chosen.items():
            stood = self.standing(vertex, host)
            found[host.joint, stood.over].add(stood.turn)
        return {which: np.array(sorted(turns)) for which, turns in found.items()}

    def _is_usual(self, vertex: int, host: Host, turns: Mapping[tuple[int, bool], Floats]) -> bool:
        """Whether a host would be turned at a vertex as one of others is."""
        stood = self.standing(vertex, host)
        off = turns.get((host.joint, stood.over), np.empty(0)) - stood.turn
        return bool((np.abs((off + np.pi) % (2 * np.pi) - np.pi) < ANGLE).any())

    def _end(self, edge: int, end: int, host: Host) -> tuple[int, bool, int]:
        """Joint, whether it is turned over, and slot of an edge's end in a host."""
        vertex = int(self._frame.edges[edge, end])
        stood = self.standing(vertex, host)
        return host.joint, stood.over, stood.slots[int(self.place[edge, end])]

    def _outwards(self, chosen: Collection[int]) -> Iterator[int]:
        """The vertices that are not chosen, those beside chosen ones first."""
        reached, wave = set(chosen), set(chosen)
        while wave:
            wave = {
                int(self._frame.edges[edge, 1 - end]) for v in wave for edge, end in self._ends[v]
            } - reached
            yield from sorted(wave)
            reached |= wave
        yield from sorted(set(range(len(self._ends))) - reached)

    def _likeness(
        self,
        vertex: int,
        host: Host,
        chosen: dict[int, Host],
        usual: Collection[tuple[tuple[int, bool, int], ...]],
    ) -> int:
        """How many of a vertex's edges would be like usual ones, as far as is known."""
        return sum(
            (self._end(edge, end, host), self._end(edge, 1 - end, chosen[other])) in usual
            for edge, end in self._ends[vertex]
            if (other := int(self._frame.edges[edge, 1 - end])) in chosen
        )
