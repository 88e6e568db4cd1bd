"""A way searched for where none of the joints' own ways does in the frame."""

from __future__ import annotations

from collections.abc import Iterable

from scadgen.errors import InputError
from scadgen.interlock.escape import escape
from scadgen.interlock.path import Path
from scadgen.plan.choice import Choice
from scadgen.plan.proof import Prover
from scadgen.plan.standing import Standing

__all__ = ["WaySearch"]

#: Seed of the searches.
_SEED = 1


class WaySearch:
    """Searches for ways, and remembers what was found and what was not.

    Parameters
    ----------
    standing
        The frame.
    prover
        What knows its parts.
    """

    def __init__(self, standing: Standing, prover: Prover) -> None:
        self._standing, self._prover = standing, prover
        self._known: dict[tuple[object, ...], Path | None] = {}

    def way(self, choice: Choice, rest: Iterable[int]) -> Path | None:
        """A way for a choice past what is at its joints, with the joint at the origin.

        Nothing is proved of it yet.
        """
        joints = {joint for part in choice.parts for joint in self._standing.sites_of[part]}
        around = sorted(
            part
            for part in set(rest) - choice.parts
            if joints.intersection(self._standing.sites_of[part])
        )
        moving = sorted(choice.parts)
        key = tuple(
            tuple(sorted(self._prover.place(n, choice.origin) for n in group))
            for group in (moving, around)
        )
        if key not in self._known:
            self._known[key] = self._found(choice, moving, around)
        return self._known[key]

    def _found(self, choice: Choice, moving: list[int], around: list[int]) -> Path | None:
        if not around:
            return None
        body, fixed = (
            [self._prover.mesh(n, choice.origin) for n in group] for group in (moving, around)
        )
        try:
            found = escape(body, fixed, seed=_SEED)
        except InputError:  # they overlap: nothing comes out
            return None
        return found if isinstance(found, Path) else None
