"""Where the parts of a frame stand: on its edges and at its vertices, or in a cell of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scadgen.frame.placement import Place, Placement
from scadgen.kit.model import Joint, Vertex
from scadgen.kit.solids import Solids
from scadgen.solid.affine import Floats
from scadgen.solid.pose import Pose

__all__ = ["Arrangement"]

#: Decimals of a placement, in edge lengths and degrees.
_DECIMALS = 9


@dataclass(frozen=True, eq=False)
class Arrangement:
    """Where the parts of a frame stand.

    Parameters
    ----------
    solids
        Its parts.
    at
        ``(n, 2) float``: where its vertices are, in edge lengths.
    """

    solids: Solids
    at: Floats

    def joint(self, number: int) -> Joint:
        """A kind of joint, turned so that its first key is along +x."""
        kinds, one, named = self.solids.kinds, self.solids.pieces[number], self.solids.named
        kind, own = kinds.kinds[number], kinds.shape(number).directions
        count, first = len(own), kind.keys[0]
        slots = [(slot + first) % count for slot in range(count)]
        connectors = [named.connector(number, slot) for slot in slots]
        turns = _degrees((own[slots] - own[first]) % (2 * np.pi))
        return Joint(
            name=kinds.name(number),
            turns=tuple(turns),
            keys=tuple(sorted((slot - first) % count for slot in kind.keys)),
            caps=tuple(sorted((slot - first) % count for slot in kind.caps)),
            connectors=tuple(name for name, _ in connectors),
            over=tuple(slot for slot, (_, over) in enumerate(connectors) if over),
            weave=one.weave.as_dict(),
            key=one.key,
            pieces=tuple(self.pieces(number, 0, Pose(), range(count))),
            figures=one.figures(),
        )

    @cached_property
    def vertices(self) -> tuple[Vertex, ...]:
        """What stands at each vertex."""
        kinds, found = self.solids.kinds, []
        for vertex, at in enumerate(self.at.round(_DECIMALS) + 0.0):
            number = int(kinds.kind_of[vertex])
            turn = kinds.directions(vertex)[kinds.kinds[number].keys[0]]
            pose = Pose.flat(at, _degrees(np.array([turn]))[0], over=bool(kinds.over[vertex]))
            found.append(Vertex(kinds.name(number), pose))
        return tuple(found)

    def placements(self) -> tuple[Placement, ...]:
        """Where everything stands: the elements by edge, then the pieces by vertex."""
        edges = range(len(self.solids.edges))
        pieces = (
            piece
            for vertex, place in enumerate(self.vertices)
            for piece in self.pieces(self.number(vertex), vertex, place.pose, self._free(vertex))
        )
        return (*map(self.element, edges), *pieces)

    def number(self, vertex: int) -> int:
        """Number of the kind of joint at a vertex."""
        return int(self.solids.kinds.kind_of[vertex])

    @cached_property
    def _used(self) -> list[set[int]]:
        """The slots of each vertex that have an edge, counted from its first key."""
        found: list[set[int]] = [set() for _ in self.vertices]
        for edge in range(len(self.solids.edges)):
            for end in self.ends(edge):
                found[end.vertex].add(end.slot)
        return found

    def _free(self, vertex: int) -> set[int]:
        return set(range(len(self._directions(vertex)))) - self._used[vertex]

    def _directions(self, vertex: int) -> Floats:
        return self.solids.kinds.directions(vertex)

    def ends(self, edge: int) -> tuple[Place, Place]:
        """The vertices of an edge and the slots there, counted from the first key."""
        kinds = self.solids.kinds
        first, second = (
            Place(v, kinds.from_first_key(self.number(v), slot))
            for v, slot in zip(
                self.solids.edges[edge].tolist(), kinds.slots[edge].tolist(), strict=True
            )
        )
        return first, second

    def element(self, edge: int) -> Placement:
        """The element on an edge: from its near end, which its part has at the origin."""
        laid = self.solids.elements.laid[edge]
        ends = self.ends(edge)
        near, far = ends[::-1] if laid.swapped else ends
        number = self.solids.kinds.slots[edge, int(laid.swapped)]
        turn = _degrees(self._directions(near.vertex)[[number]])[0]
        pose = Pose.flat(self.vertices[near.vertex].pose.at, turn, over=laid.flipped)
        keyed = any(end.slot is None for end in self.solids.elements.kinds[laid.name].ends)
        return Placement(laid.name, "cross" if keyed else "row", pose, (near, far), edge)

    def pieces(
        self, number: int, vertex: int, pose: Pose, caps: Iterable[int]
    ) -> Iterator[Placement]:
        """The pieces of a joint: halves, connectors without a tube, pegs.

        Parameters
        ----------
        number
            Its kind.
        vertex
            Where it stands.
        pose
            How, its first key along x.
        caps
            The slots that have no tube, counted from its first key.
        """
        kinds, named = self.solids.kinds, self.solids.named
        kind, shape = kinds.kinds[number], kinds.shape(number)
        count, first, over = len(shape.directions), kind.keys[0], pose.over
        keys = [(slot - first) % count for slot in kind.keys]
        sign = -1 if over else 1

        def placed(part: str, role: str, slot: int, *, flip: bool) -> Placement:
            own = shape.directions[(slot + first) % count] - shape.directions[first]
            turn = round(pose.degrees + sign * float(np.degrees(own)), _DECIMALS) % 360
            return Placement(
                part, role, Pose.flat(pose.at, turn, over=flip), (Place(vertex, slot),)
            )

        for slot in keys:
            names = named.half_names(number, (slot + first) % count)
            yield placed(names[0], "half_a", slot, flip=over)
            yield placed(names[1], "half_b", slot, flip=not over)
        for slot in sorted(set(caps) - set(keys)):
            name, turned = named.connector(number, (slot + first) % count)
            yield placed(name, "cap", slot, flip=turned != over)
        for slot in keys:
            if self._is_loose(slot, caps):
                yield placed(named.peg(number), "peg", slot, flip=over)

    def _is_loose(self, slot: int, free: Iterable[int]) -> bool:
        """Whether the peg of a key is a part of its own: fixed ones are where no tube has them."""
        return self.solids.pieces[0].key.style == "loose" or slot in free


def _degrees(radians: Floats) -> list[float]:
    """Angles in degrees, as placements have them."""
    found: list[float] = (np.degrees(radians).round(_DECIMALS) % 360).tolist()
    return found
