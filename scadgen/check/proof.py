"""What is proved of a kit's joints: they lock, and they can be put together."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from functools import partial

from scadgen.check.disassembly import come_apart
from scadgen.check.locking import joint_locks
from scadgen.check.result import Result
from scadgen.check.stored_paths import known_ways
from scadgen.errors import JointError
from scadgen.kit.model import Joint, Kit, Way
from scadgen.kit.ways import read_way, way_entry
from scadgen.solid.affine import AffineSolid
from scadgen.work.cache import Entry
from scadgen.work.executor import ALONE
from scadgen.work.fingerprint import key_of
from scadgen.work.mapping import Execution, Task, map_cached

__all__ = ["Claim", "Proof", "proofs", "prove", "proved"]


@dataclass(frozen=True, slots=True)
class Proof:
    """A result, and the way that shows it, if one does."""

    result: Result
    way: Way | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Claim:
    """That a joint locks and comes apart.

    Parameters
    ----------
    kit
        A kit that has what the proof needs: the joint's parts, and the live parameters.
    joint
        The joint.
    """

    kit: Kit
    joint: Joint


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


def proved(
    kit: Kit, means: Execution | None = None, say: Callable[[str], None] = lambda _: None
) -> Kit:
    """The kit with all that is proved of its joints.

    Parameters
    ----------
    kit
        The kit.
    means
        Who proves it, and where proofs are kept; by default this process alone, and nowhere.
    say
        Told what is proved: of a lone joint each step, of several each joint.

    Raises
    ------
    JointError
        One does not lock, or no way is found on which it comes apart: the first of them.
    """
    claims = [Claim(_alone(kit, joint), joint) for joint in kit.joints]
    means, task = means or Execution(), _TASK
    if len(claims) == 1:
        # A lone item is done by this process, to which each step can be told.
        means, task = replace(means, crew=ALONE), replace(task, function=partial(prove, say=say))
    done: dict[int, Joint] = {}
    for number, joint in map_cached(task, claims, means):
        done[number] = joint
        if len(claims) > 1:
            say(f"{joint.title}, {len(done)} of {len(claims)}")
    return replace(kit, joints=tuple(done[number] for number in range(len(claims))))


def prove(claim: Claim, say: Callable[[str], None] = lambda _: None) -> Joint:
    """The joint with all that is proved of it.

    Parameters
    ----------
    claim
        What is to be proved.
    say
        Told what is being proved.

    Raises
    ------
    JointError
        It does not lock, or no way is found on which it comes apart.
    """
    joint = claim.joint
    verdicts, ways = {}, []
    of = f"{joint.title}: " if joint.name else ""
    for proof in proofs(claim.kit, joint, lambda what: say(of + what)):
        result = proof.result
        if not result.good:
            fault = f"{result.check}: {result.figure}, must be {result.bound}"
            msg = (
                f"{of}weave {joint.weave['name']}: {fault}; another weave or more clearance "
                "helps, or --unchecked makes the kit all the same"
            )
            raise JointError(msg, joint.name, fault)
        say(of + result.check)
        verdicts[result.check] = result.figure
        if proof.way:
            ways.append(proof.way)
    return replace(joint, verdicts=verdicts, ways=tuple(ways))


def _alone(kit: Kit, joint: Joint) -> Kit:
    """A kit of one joint: what is proved of it depends on nothing else."""
    used = dict.fromkeys((*(place.part for place in joint.pieces), *joint.connectors))
    parts = {name: kit.parts[name] for name in used}
    return replace(
        kit,
        parts=parts,
        joints=(joint,),
        frame=None,
        tiling=None,
        cells=None,
        vertices=(),
        placements=(),
        slicing=None,
        ranges=(),
    )


def _key(claim: Claim) -> str:
    """The key of a proof: parts and joints may have any name."""
    kit, joint = claim.kit, claim.joint
    number = {name: n for n, name in enumerate(kit.parts)}
    return key_of(
        "proof",
        style=kit.key,
        detail=kit.detail,
        values=dict(kit.values),
        parts=[_tables(solid) for solid in kit.parts.values()],
        turns=joint.turns,
        keys=joint.keys,
        caps=joint.caps,
        connectors=[number[name] for name in joint.connectors],
        over=joint.over,
        weave=dict(joint.weave),
        pieces=[[number[p.part], p.role, p.pose.x, p.pose.z, p.slot] for p in joint.pieces],
        key=asdict(joint.key),
        figures=dict(joint.figures),
        ways=[way_entry(way) for way in joint.ways],
    )


def _tables(solid: AffineSolid) -> Mapping[str, object]:
    """All that a solid is."""
    return {
        "points": dict(solid.coefficients),
        "triangles": solid.triangles,
        "facets": solid.facets,
    }


def _packed(joint: Joint) -> Entry:
    verdicts = list(joint.verdicts.items())
    return Entry({"verdicts": verdicts, "ways": [way_entry(way) for way in joint.ways]})


def _unpacked(entry: Entry, claim: Claim) -> Joint:
    ways = tuple(read_way(way) for way in entry.values["ways"])
    return replace(claim.joint, verdicts=dict(entry.values["verdicts"]), ways=ways)


_TASK = Task(prove, _key, _packed, _unpacked)
