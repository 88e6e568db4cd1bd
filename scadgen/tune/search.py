"""A seeded search for tight weaves: what is tight and thick breeds, what is best is proved.

Each round looks at some weaves quickly, then proves the most promising: those that no proved
weave beats.  A round depends on the seed and on the rounds before it, not on how many cores
work; so a search goes on from its record as if it had never stopped.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from multiprocessing.pool import Pool
from typing import Literal

import numpy as np

from scadgen.joint.weave import LIMITS, SHAPE, Weave
from scadgen.solid.affine import Floats
from scadgen.tune.judge import Figures, Wish, figures, proof
from scadgen.tune.record import Record, Shape

__all__ = ["WeaveSearch"]

#: Where weaves are looked for: low and high; ring ratios as shares of half the valence, so
#: that the room between neighbouring tubes is about the same.
_LOW = np.array([0.8, 0.65, 0.08, 0.15, 0.7])
_HIGH = np.array([1.7, 1.15, 0.75, 0.9, 1.9])

#: Weaves looked at in a round, and proved at most.
_LOOKS, _PROOFS = 32, 2

#: Shares of them that are new altogether, and mixed of two; the steps of those that change.
_NEW, _MIXED, _STEPS = 0.2, 0.2, (0.01, 0.08)

#: Best weaves that breed.
_PARENTS = 12

#: What is no farther from one that was refused, in shares, is not proved.
_LIKE = 0.01

#: How much of the play, as a power of e, a whole side of arm is worth.
_ARM = 2.0


@dataclass
class WeaveSearch:
    """A search, and what it has found.

    Parameters
    ----------
    wish
        What is wanted.
    seed
        Seed of all that is random.
    record
        What is known of weaves, and where what is found is written down.
    looked, proved
        Figures of the weaves looked at, and proved; refused ones as well.
    """

    wish: Wish
    seed: int
    record: Record
    looked: dict[Shape, Figures] = field(default_factory=dict)
    proved: dict[Shape, Figures] = field(default_factory=dict)

    def rounds(self, workers: Pool, start: Iterable[Weave], count: int) -> Iterator[None]:
        """WeaveSearch for some rounds, each of which looks and then proves.

        Parameters
        ----------
        workers
            Who looks and proves.
        start
            Weaves that the first round looks at.
        count
            Number of rounds.

        Yields
        ------
        nothing
            Twice a round: once it has looked, and once it has proved.
        """
        shapes = [weave.shape for weave in start]
        for number in range(count):
            random = np.random.default_rng([self.seed, number])
            while len(shapes) < _LOOKS:
                shapes.append(self._bred(random))
            self._judge(workers, "look", shapes)
            yield
            self._judge(workers, "proof", self._promising())
            shapes = []
            yield

    @property
    def front(self) -> list[tuple[Shape, Figures]]:
        """The proved weaves that no other beats, the tightest first."""
        good = [(shape, found) for shape, found in self.proved.items() if not found.refused]
        best = [one for one in good if not any(found.beats(one[1]) for _, found in good)]
        return sorted(best, key=lambda one: one[1].play)

    def _judge(
        self, workers: Pool, kind: Literal["look", "proof"], shapes: Iterable[Shape]
    ) -> None:
        """Judge weaves, in parallel; those on record by the record."""
        judge, found = (figures, self.looked) if kind == "look" else (proof, self.proved)
        wanted = [shape for shape in dict.fromkeys(shapes) if shape not in found]
        pending = {
            shape: workers.apply_async(judge, (self.wish, Weave(*shape)))
            for shape in wanted
            if self.record.get(kind, shape) is None
        }
        try:
            for answer in pending.values():
                answer.wait()
        finally:
            for shape, answer in pending.items():
                if answer.ready():
                    self.record.add(kind, shape, answer.get())
            for shape in wanted:
                if known := self.record.get(kind, shape):
                    found[shape] = known

    def _promising(self) -> list[Shape]:
        """Weaves to prove: no proved one beats them, nor was one like them refused."""
        chosen: list[Shape] = []
        bad = [shape for shape, found in self.proved.items() if found.refused]
        for shape in self._best():
            ours = self.looked[shape]
            beaten = any(f.beats(ours) for f in self.proved.values() if not f.refused)
            near = [*bad, *chosen]
            known = shape in self.proved
            if not beaten and not known and not _is_like(shape, near):
                chosen.append(shape)
            if len(chosen) == _PROOFS:
                break
        return chosen

    def _best(self) -> list[Shape]:
        """Weaves that may be good, the best first."""
        refused = {shape for shape, found in self.proved.items() if found.refused}
        good = [s for s, f in self.looked.items() if not f.refused and s not in refused]
        return sorted(good, key=lambda shape: _worth(self.looked[shape]))

    def _bred(self, random: np.random.Generator) -> Shape:
        """Another weave: a new one, a changed one, or one mixed of two."""
        parents = self._best()[:_PARENTS]
        kind = random.random()
        if not parents or kind < _NEW:
            found = random.uniform(_LOW, _HIGH)
            found[0] *= self.wish.valence / 2
        else:
            found = np.array(parents[random.integers(len(parents))])
            if kind < _NEW + _MIXED:
                share = random.random(5)
                found = share * found + (1 - share) * parents[random.integers(len(parents))]
            step = np.exp(random.uniform(*np.log(_STEPS)))
            found = found * (1 + step * random.normal(size=5))
        return _shape(found)


def _shape(values: Floats) -> Shape:
    """Parameters that a weave may have, with three decimals."""
    low, high = np.array([LIMITS[name] for name in SHAPE]).T
    r, s, a, b, p = np.clip(values, low, high).round(3).tolist()
    return r, s, a, b, p


def _worth(found: Figures) -> float:
    """How good figures are: less is better."""
    return float(np.log(found.play) - _ARM * found.arm)


def _is_like(shape: Shape, others: Iterable[Shape]) -> bool:
    """Whether a weave is much like one of others."""
    mine = np.array(shape)
    return any(np.abs(np.array(other) / mine - 1).max() < _LIKE for other in others)
