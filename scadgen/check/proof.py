"""What is proved of a kit's joint: it locks, and it can be put together."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from scadgen.check.known import known_ways
from scadgen.check.locking import joint_locks
from scadgen.check.result import Result
from scadgen.check.ways import come_apart
from scadgen.errors import GeometryError
from scadgen.kit.model import Kit, Way

__all__ = ["Proof", "proofs", "proved"]


@dataclass(frozen=True, slots=True)
class Proof:
    """A result, and the way that shows it, if one does."""

    result: Result
    way: Way | None = None


def proofs(kit: Kit, say: Callable[[str], None] = lambda _: None) -> Iterator[Proof]:
    """Prove what a kit promises, one result after the other.

    Parameters
    ----------
    kit
        The kit; ways that it carries are proved, and searched for only where it has none.
    say
        Told what takes long.
    """
    for result in joint_locks(kit):
        yield Proof(result)
    for result, way in come_apart(kit, (*kit.ways, *known_ways(kit)), say=say):
        yield Proof(result, way)


def proved(kit: Kit, say: Callable[[str], None] = lambda _: None) -> Kit:
    """The kit with all that is proved of it.

    Parameters
    ----------
    kit
        The kit.
    say
        Told what is being proved.

    Raises
    ------
    GeometryError
        It does not lock, or no way is found on which it comes apart.
    """
    verdicts, ways = {}, []
    for proof in proofs(kit, say):
        result = proof.result
        if not result.good:
            msg = (
                f"weave {kit.weave['name']}: {result.check}: {result.figure}, must be "
                f"{result.bound}; another weave or more clearance helps, or --unchecked makes "
                "the kit all the same"
            )
            raise GeometryError(msg)
        say(result.check)
        verdicts[result.check] = result.figure
        if proof.way:
            ways.append(proof.way)
    return replace(kit, verdicts=verdicts, ways=tuple(ways))
