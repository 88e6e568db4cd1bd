"""Whether a joint can be put together: the ways on which its pieces come apart, backwards.

1. The pegs come out: a fixed one with its tube, a loose one into the ring's hole.
2. The halves, half A of a lone key first if it can; the tubes of all connectors stay, and those
   of loose pegs.
3. The connectors, with their tubes, each alone, until one is left.

A way that is known is proved again for the kit's own solids.  Where there is none, a motion that
opens all contacts at once is tried; only where there is none of these is a way searched for.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from scadgen.check.opening_motions import Openings
from scadgen.check.pieces import key_tubes, pieces, tubes
from scadgen.check.result import Result
from scadgen.interlock.contacts import Mesh
from scadgen.interlock.escape import STEPS, escape
from scadgen.interlock.path import Path, narrowest
from scadgen.interlock.widen import widened
from scadgen.kit.model import Joint, Kit, Way
from scadgen.kit.ways import WAY_DECIMALS

__all__ = ["LEAST", "LOOK", "come_apart"]

#: Seeds of the searches: one that gives up too soon mostly does not with another.
_SEEDS = (1, 2, 3)

#: Gap that a piece keeps on its way, as shares of the clearance: at least; known at most.
LEAST, LOOK = 0.05, 2.0

#: Gap, as a share of the clearance, of a way that cannot be much wider.
_ROOMY = 0.9

#: How far a peg rises out of the ring's hole, in sides.
_RISE = 1.2

#: Words for several pieces.
_MANY = {"peg": "pegs", "half": "halves"}

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
        Bodies of which one has to come out, numbers of pieces in the joint, each with the words
        for that.
    """

    name: str
    choices: Mapping[tuple[int, ...], str]

    def way(self, moving: tuple[int, ...], path: Path) -> Way:
        """The way of one of these bodies."""
        return Way(self.choices[moving], moving, _rounded(path))


def come_apart(
    kit: Kit,
    joint: Joint,
    known: Iterable[Way] = (),
    *,
    steps: int = STEPS,
    roomy: bool = False,
    say: Callable[[str], None] = lambda _: None,
) -> Iterator[tuple[Result, Way | None]]:
    """Take a kind of joint apart at its kit's own clearances.

    Parameters
    ----------
    kit
        The kit.
    joint
        One of its joints.
    known
        Ways that may do, of this joint or of one like it.
    steps
        Steps after which a search is given up.  There is one for each piece that may be next
        and each of some seeds.
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
    bodies = _Bodies(kit, joint)
    known, present = tuple(known), set(range(len(joint.pieces)))
    while stage := _next(joint, present):
        fitting = [way for way in known if stage.choices.get(way.moving) == way.name]
        found: tuple[Way, float] | str | None = (
            bodies.known(fitting, present)
            or bodies.opened(stage, present)
            or bodies.nearly_known(fitting, present)
        )
        if found is None:
            say(f"searching how {stage.name}")
            found = bodies.searched(stage, present, steps)
        if isinstance(found, str):
            yield Result(stage.name, good=False, figure=found, bound=_BOUND), None
            return
        if roomy and found[1] < _ROOMY * bodies.clearance:
            found = bodies.widened(found[0], present) or found
        way, gap = found
        figure = f"{gap:.3f} mm from all others"
        yield Result(way.name, good=True, figure=figure, bound=_BOUND), way
        present -= set(way.moving)


def _next(joint: Joint, present: set[int]) -> _Stage | None:
    """The stage at which these pieces are left."""
    kinds = {n: joint.pieces[n].role.partition("_")[0] for n in sorted(present)}
    for kind in ("peg", "half"):
        left = [n for n, k in kinds.items() if k == kind]
        if left and len(joint.keys) == 1:
            words = {"half_a": "half A", "half_b": "half B", "peg": "the peg"}
            names = {n: f"{words[joint.pieces[n].role]} comes out" for n in left}
            return _Stage(names[left[0]], {(n,): name for n, name in names.items()})
        if left:
            name = {1: f"the last {kind} comes"}.get(
                len(left), f"one of {len(left)} {_MANY[kind]} comes"
            )
            return _one_of(f"{name} out", left)
    left = list(kinds)
    if len(left) < 2:
        return None
    return _one_of(f"{len(left)} connectors come apart", left)


def _one_of(name: str, pieces: Iterable[int]) -> _Stage:
    """A stage that is called the same whichever piece comes out."""
    return _Stage(name, {(n,): name for n in pieces})


class _Bodies:
    """A joint's bodies, each piece with its tube, where they stand."""

    def __init__(self, kit: Kit, joint: Joint) -> None:
        values = kit.values
        self.side, self.clearance = values["side"], values["clearance"]
        self.meshes = pieces(kit, joint, values)
        self.tubes = tubes(joint, values)
        self.key_tubes = key_tubes(joint, values) if kit.key == "loose" else {}
        self._is_loose, self._joint = kit.key == "loose", joint
        self._openings = Openings(kit, joint) if "stretch" in joint.weave else None

    def bodies(self, moving: tuple[int, ...], present: set[int]) -> tuple[list[Mesh], list[Mesh]]:
        """What moves, and what stays."""
        stay = [tube for n, tube in self.key_tubes.items() if {n, n + 1} & present]
        return self._with_tubes(moving), [*self._with_tubes(present - set(moving)), *stay]

    def gap(self, way: Way, present: set[int]) -> float:
        """Smallest gap on a way, in mm; 0 where it is not proven that there is one."""
        path, least = way.path.scaled(self.side), LEAST * self.clearance
        if not least > 0:
            return 0.0
        bodies = self.bodies(way.moving, present)
        return narrowest(path, *bodies, least=least, look=LOOK * self.clearance)

    def known(self, ways: Sequence[Way], present: set[int]) -> tuple[Way, float] | None:
        """The first of some ways that is one here too, and its smallest gap."""
        gaps = ((way, self.gap(way, present)) for way in ways)
        return next((found for found in gaps if found[1] > 0), None)

    def nearly_known(self, ways: Sequence[Way], present: set[int]) -> tuple[Way, float] | None:
        """The first of some ways, too near to a wall here, that is one once it is widened."""
        return next(filter(None, (self.widened(way, present) for way in ways)), None)

    def opened(self, stage: _Stage, present: set[int]) -> tuple[Way, float] | None:
        """A way for this stage that needs no search, and its smallest gap."""
        narrow: tuple[Way, float] | None = None
        for choice in stage.choices:
            for path in self._proposed(choice[0], present):
                way = stage.way(choice, path)
                gap = self.gap(way, present)
                if gap > _ROOMY * self.clearance:
                    return way, gap
                if gap > (narrow[1] if narrow else 0):
                    narrow = way, gap
        return narrow

    def _proposed(self, piece: int, present: set[int]) -> Iterator[Path]:
        """Ways for a piece, in sides, that may do."""
        is_peg = self._joint.pieces[piece].role == "peg"
        if is_peg and self._is_loose:
            yield self._of_peg(piece)
        elif self._openings and not is_peg:
            yield from self._openings.paths(piece, present)

    def _of_peg(self, piece: int) -> Path:
        """A loose peg's way into the middle of the ring's hole, and up."""
        along = np.array(self._joint.pieces[piece].pose.x)
        reach, key = self.meshes[piece][0] @ along, self._joint.key
        pad, hole = (v * self.side for v in (key.pad, self._joint.figures["ring_hole_sides"]))
        inwards = reach.max() - pad + (hole - np.ptp(reach)) / 2
        steps = np.zeros((3, 6))
        steps[1:, :3] = -inwards / self.side * along
        steps[2, 2] = _RISE
        return Path.through(steps, np.zeros(3))

    def widened(self, way: Way, present: set[int]) -> tuple[Way, float] | None:
        """A way drawn away from the walls, if it is one then, and its smallest gap."""
        least = LEAST * self.clearance
        if not least > 0:
            return None
        bodies = self.bodies(way.moving, present)
        path = widened(way.path.scaled(self.side), *bodies, least)
        found = replace(way, path=_rounded(path.scaled(1 / self.side)))
        gap = self.gap(found, present)
        return (found, gap) if gap > 0 else None

    def searched(self, stage: _Stage, present: set[int], steps: int) -> tuple[Way, float] | str:
        """A way for this stage and its smallest gap, or what was tried in vain."""
        tries, finished = 0, True
        for seed, choice in itertools.product(_SEEDS, stage.choices):
            found = escape(*self.bodies(choice, present), seed=seed, steps=steps)
            if isinstance(found, Path):
                way = stage.way(choice, found.scaled(1 / self.side))
                gap = self.gap(way, present)
                if gap > 0:
                    return way, gap
                tries += 1
            else:
                tries += found.tries
                finished &= found.finished
        return f"none found in {tries} tries{'' if finished else ', not finished'}"

    def _with_tubes(self, numbers: Iterable[int]) -> list[Mesh]:
        chosen = sorted(numbers)
        return [self.meshes[n] for n in chosen] + [self.tubes[n] for n in chosen if n in self.tubes]


def _rounded(path: Path) -> Path:
    """A path as files keep it, so that what is proved is what is written."""
    return Path.through(np.round(path.steps(), WAY_DECIMALS), np.round(path.middle, WAY_DECIMALS))
