"""Whether a joint can be put together: the ways on which its pieces come apart, backwards.

1. The peg comes out: a fixed one with its tube, a loose one into the ring's hole.
2. Half A, then half B; the tubes of all connectors stay, and that of a loose peg.
3. The connectors, with their tubes, until one is left.

A way that is known is proved again for the kit's own solids; only where there is none is
one searched for.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from scadgen.check.pieces import key_tube, pieces, tubes
from scadgen.check.result import Result
from scadgen.interlock.contacts import Mesh
from scadgen.interlock.escape import escape
from scadgen.interlock.path import Path, narrowest
from scadgen.interlock.widen import widened
from scadgen.kit.model import Kit, Way
from scadgen.kit.store import WAY_DECIMALS

__all__ = ["PATIENCE", "come_apart"]

#: Seconds after which a search is given up.
PATIENCE = 60.0

#: Seeds of the searches: one that gives up too soon mostly does not with another.
_SEEDS = (1, 2, 3)

#: Gap that a piece keeps on its way, as shares of the clearance: at least; known at most.
_LEAST, _LOOK = 0.05, 2.0

#: Gap, as a share of the clearance, of a way that cannot be much wider.
_ROOMY = 0.9

#: What every way has to be.
_BOUND = "touching nothing"


@dataclass(frozen=True, slots=True)
class _Stage:
    """What is to come out next.

    Parameters
    ----------
    name
        Its words.
    choices
        Bodies of which one has to come out: numbers of pieces in the joint.
    """

    name: str
    choices: Sequence[tuple[int, ...]]


def come_apart(
    kit: Kit,
    known: Iterable[Way] = (),
    *,
    seconds: float = PATIENCE,
    roomy: bool = False,
    say: Callable[[str], None] = lambda _: None,
) -> Iterator[tuple[Result, Way | None]]:
    """Take a kit's joint apart at its own clearances.

    Parameters
    ----------
    kit
        The kit.
    known
        Ways that may do, of this kit or of one like it.
    seconds
        Time for each search; some are made before a stage is given up.
    roomy
        Whether to widen each way that is narrow, which may take longer than to find it: it
        then holds for smaller clearances too.
    say
        Told what is being searched for.

    Yields
    ------
    result, way
        One for each body that comes out; it ends with the first for which no way is found.

    Raises
    ------
    InvariantError
        If a part is not a solid.
    """
    joint = _Joint(kit)
    known, present = tuple(known), set(range(len(kit.joint)))
    while stage := _next(kit, present):
        found = joint.known(stage, known, present)
        if found is None:
            say(f"searching how {stage.name}")
            found = joint.searched(stage, present, seconds)
        if found is None:
            yield Result(stage.name, good=False, figure="no way found", bound=_BOUND), None
            return
        if roomy and found[1] < _ROOMY * joint.clearance:
            found = joint.widened(found[0], present) or found
        way, gap = found
        figure = f"{gap:.3f} mm from all others"
        yield Result(stage.name, good=True, figure=figure, bound=_BOUND), way
        present -= set(way.moving)


def _next(kit: Kit, present: set[int]) -> _Stage | None:
    """The stage at which these pieces are left."""
    parts = {n: kit.joint[n].part for n in sorted(present)}
    for part, name in (("peg", "the peg comes out"), ("half", "half {} comes out")):
        left = [n for n, p in parts.items() if p == part]
        if left:
            return _Stage(name.format("AB"[len(left) == 1]), [(left[0],)])
    left = list(parts)
    if len(left) < 2:
        return None
    name = f"{len(left)} connectors come apart"
    sizes = range(1, len(left) // 2 + 1)
    runs = [left[n : n + size] for size in sizes for n in range(len(left) - size + 1)]
    return _Stage(name, [tuple(run) for run in runs])


class _Joint:
    """A joint's bodies, each piece with its tube, where they stand."""

    def __init__(self, kit: Kit) -> None:
        values = kit.values
        self.side, self.clearance = values["side"], values["clearance"]
        self.meshes = pieces(kit, values)
        self.tubes = tubes(kit, values)
        self.halves = {n for n, place in enumerate(kit.joint) if place.part == "half"}
        self.key_tube = [key_tube(kit, values)] if kit.key == "loose" else []

    def bodies(self, moving: tuple[int, ...], present: set[int]) -> tuple[list[Mesh], list[Mesh]]:
        """What moves, and what stays."""
        stay = self.key_tube if self.halves & present else []
        return self._with_tubes(moving), [*self._with_tubes(present - set(moving)), *stay]

    def gap(self, way: Way, present: set[int]) -> float:
        """Smallest gap on a way, in mm; 0 where it is not proven that there is one."""
        path, least = way.path.scaled(self.side), _LEAST * self.clearance
        if not least > 0:
            return 0.0
        bodies = self.bodies(way.moving, present)
        return narrowest(path, *bodies, least=least, look=_LOOK * self.clearance)

    def known(
        self, stage: _Stage, ways: Sequence[Way], present: set[int]
    ) -> tuple[Way, float] | None:
        """The first of some ways that is one for this stage, and its smallest gap.

        One that is too near to a wall here may still lead to another that is not.
        """
        fitting = [w for w in ways if w.name == stage.name and w.moving in stage.choices]
        for way in fitting:
            gap = self.gap(way, present)
            if gap > 0:
                return way, gap
        return next(filter(None, (self.widened(way, present) for way in fitting)), None)

    def widened(self, way: Way, present: set[int]) -> tuple[Way, float] | None:
        """A way drawn away from the walls, if it is one then, and its smallest gap."""
        least = _LEAST * self.clearance
        if not least > 0:
            return None
        bodies = self.bodies(way.moving, present)
        path = widened(way.path.scaled(self.side), *bodies, least)
        found = replace(way, path=_rounded(path.scaled(1 / self.side)))
        gap = self.gap(found, present)
        return (found, gap) if gap > 0 else None

    def searched(
        self, stage: _Stage, present: set[int], seconds: float
    ) -> tuple[Way, float] | None:
        """A way for this stage, if one is found, and its smallest gap."""
        for seed, choice in itertools.product(_SEEDS, stage.choices):
            found = escape(*self.bodies(choice, present), seed=seed, seconds=seconds)
            if isinstance(found, Path):
                way = Way(stage.name, choice, _rounded(found.scaled(1 / self.side)))
                gap = self.gap(way, present)
                if gap > 0:
                    return way, gap
        return None

    def _with_tubes(self, numbers: Iterable[int]) -> list[Mesh]:
        chosen = sorted(numbers)
        return [self.meshes[n] for n in chosen] + [self.tubes[n] for n in chosen if n in self.tubes]


def _rounded(path: Path) -> Path:
    """A path as files keep it, so that what is proved is what is written."""
    return Path.through(np.round(path.steps(), WAY_DECIMALS), np.round(path.middle, WAY_DECIMALS))
