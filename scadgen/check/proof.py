"""What is proved of a kit's joints: they lock, and they can be put together."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from scadgen.check.known import known_ways
from scadgen.check.locking import joint_locks
from scadgen.check.result import Result
from scadgen.check.ways import come_apart
from scadgen.errors import GeometryError
from scadgen.kit.model import Joint, Kit, Way

__all__ = ["Proof", "proofs", "proved"]


@dataclass(frozen=True, slots=True)
class Proof:
    """A result, and the way that shows it, if one does."""

    result: Result
    way: Way | None = None


def proofs(kit: Kit, joint: Joint, say: Callable[[str], None] = lambda _: None) -> Iterator[Proof]:
    """Prove what a kit promises of one of its joints, one result after the other.

    Parameters
    ----------
    kit
        The kit.
    joint
        The joint; ways that it carries are proved, and searched for only where it has none.
    say
        Told what takes long.
    """
    for result in joint_locks(kit, joint):
        yield Proof(result)
    ways = (*joint.ways, *known_ways(kit, joint))
    for result, way in come_apart(kit, joint, ways, say=say):
        yield Proof(result, way)


def proved(kit: Kit, say: Callable[[str], None] = lambda _: None) -> Kit:
    """The kit with all that is proved of its joints.

    Parameters
    ----------
    kit
        The kit.
    say
        Told what is being proved.

    Raises
    ------
    GeometryError
        One does not lock, or no way is found on which it comes apart.
    """
    return replace(kit, joints=tuple(_proved(kit, joint, say) for joint in kit.joints))


def _proved(kit: Kit, joint: Joint, say: Callable[[str], None]) -> Joint:
    """A joint with all that is proved of it."""
    verdicts, ways = {}, []
    of = f"{joint.title}: " if joint.name else ""
    for proof in proofs(kit, joint, lambda what: say(of + what)):
        result = proof.result
        if not result.good:
            msg = (
                f"{of}weave {joint.weave['name']}: {result.check}: {result.figure}, must be "
                f"{result.bound}; another weave or more clearance helps, or --unchecked makes "
                "the kit all the same"
            )
            raise GeometryError(msg)
        say(of + result.check)
        verdicts[result.check] = result.figure
        if proof.way:
            ways.append(proof.way)
    return replace(joint, verdicts=verdicts, ways=tuple(ways))
