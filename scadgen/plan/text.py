"""What a plan says to people: its steps, and what can move at the end, in words."""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from scadgen.frame.placement import bill
from scadgen.plan.model import Move, Plan, Step
from scadgen.plan.motion import joints_of, motion_of, towards
from scadgen.plan.pegs import Pegs, count_pegs
from scadgen.plan.whole import Loose, Whole

__all__ = ["finished", "movable", "plan_text", "sentence", "title"]

#: Widest that a line is, and how far lines that go on are indented.
_WIDE, _INDENT = 100, "     "

#: Joints that are named at most, runs of them counted once; and sorts of parts that are.
_NAMED, _SORTS = 12, 6

#: Letters that a picture's title has at most, before it sums up.
_LONG = 190

#: What parts are called together, by their role: one of them, and several.
_CALLED = {
    "row": ("edge element", "edge elements"),
    "cross": ("edge element", "edge elements"),
    "cap": ("connector", "connectors"),
    "half_a": ("half A", "halves A"),
    "half_b": ("half B", "halves B"),
    "peg": ("peg", "pegs"),
}


def plan_text(plan: Plan, whole: Whole) -> str:
    """A plan as lines for people.

    Parameters
    ----------
    plan
        The plan.
    whole
        What was found of the finished frame.
    """
    kit = plan.standing.kit
    kinds = len(bill(kit.placements, kit.parts))
    good = "each proved" if plan.proved else "NOT ALL PROVED"
    parts = f"{len(kit.placements)} parts of {kinds} kinds, {len(plan.standing.sites)} joints"
    lines = [f"{kit.name}: {parts}; {_count(len(plan.steps), 'step')}, {good}"]
    lines.append(_pegs(count_pegs(plan.standing)))
    for number, step in enumerate(plan.steps, 1):
        lines.append(f"{number:3d}. {sentence(plan, number)}")
        lines += [
            f"{_INDENT}not proved: joint {move.joint + 1}: {move.reason}"
            for move in step.moves
            if not move.proved
        ]
    if plan.left:
        lines.append(f"{_INDENT}not proved: no way is known to join {_bill(plan, plan.left)}")
    lines.append(f"finished: {finished(plan, whole)}")
    lines += [f"can move: {one}" for one in movable(plan, whole)]
    return "".join(f"{_wrapped(line)}\n" for line in lines)


def _wrapped(line: str) -> str:
    """A line as several, none of which ends between a number and its parts."""
    kept = line.replace(" x ", "\0x\0")
    wide = textwrap.TextWrapper(
        _WIDE, subsequent_indent=_INDENT, break_long_words=False, break_on_hyphens=False
    )
    return wide.fill(kept).replace("\0", " ")


def _pegs(pegs: Pegs) -> str:
    """How many pegs there are, and how many there have to be."""
    if pegs.fixed:
        rim = f"; {_count(pegs.rim, 'peg')} at the rim, where a key has no edge" if pegs.rim else ""
        return f"pegs: {pegs.fixed} on elements, no loose one{rim}"
    return f"pegs: {pegs.loose} loose ones; a frame like this needs at least {pegs.least}"


def sentence(plan: Plan, number: int) -> str:
    """What to do in a step.

    Parameters
    ----------
    plan
        The plan.
    number
        The step's number, from 1.
    """
    step = plan.steps[number - 1]
    verb = "push in" if step.what == "rows" else "put in"
    ways = [
        f"{how}{_as_half(plan, moves)}: {'; '.join(_items(plan, number, moves))}"
        for how, moves in _by_way(plan, step)
    ]
    laid = [f"lay out {'; '.join(_laid(plan))}"] if number == 1 else []
    said = [*laid, f"{verb} {ways[0]}", *ways[1:]]
    return ". ".join(words[0].upper() + words[1:] for words in said)


def title(plan: Plan, number: int) -> str:
    """What to do in a step, in a few words if it takes many.

    Parameters
    ----------
    plan
        The plan.
    number
        The step's number, from 1.
    """
    head, full = f"Step {number} of {len(plan.steps)}: ", sentence(plan, number)
    if len(full) <= _LONG:
        return head + full
    step = plan.steps[number - 1]
    laid = f"Lay out {_summed(plan, plan.first())}. " if number == 1 else ""
    ways = [
        f"{how} {_summed(plan, [part for move in moves for part in move.parts])}"
        for how, moves in _by_way(plan, step)
    ]
    return f"{head}{laid}Put in {'; '.join(ways)}, as named below"


def _by_way(plan: Plan, step: Step) -> Iterator[tuple[str, list[Move]]]:
    """Moves that go in alike, with how that is."""
    moves = sorted(step.moves, key=lambda move: (_how(plan, move), move.joint))
    for how, group in groupby(moves, key=lambda move: _how(plan, move)):
        yield how, list(group)


def _how(plan: Plan, move: Move) -> str:
    """How a move goes in."""
    motion, role = motion_of(plan, move), plan.standing.kit.placements[move.parts[0]].role
    words = ["", "from above", "from below"][motion.above]
    if motion.towards is not None:
        along = "along its edge" if role == "peg" else towards(motion.towards)
        words = f"{words}, then {along}" if words else along
    if motion.tilted:
        words += ", tilted"
    return words.strip(", ") or "straight in"


def _items(plan: Plan, number: int, moves: Iterable[Move]) -> Iterator[str]:
    """What goes in, and at which joints: what is alike together."""
    joints: dict[str, list[int]] = {}
    for move in moves:
        joints.setdefault(_name(plan, move.parts), []).extend(joints_of(plan, number, move))
    for name, where in joints.items():
        count = f"{len(where)} x " if len(where) > 1 and not name.endswith("as one") else ""
        yield f"{count}{name} at {_numbers(plan, where)}"


def _as_half(plan: Plan, moves: Sequence[Move]) -> str:
    """Which half all of some moves are, if they are."""
    roles = {plan.standing.kit.placements[part].role for move in moves for part in move.parts}
    return {"half_a": ", as half A", "half_b": ", as half B"}.get("".join(roles), "")


def _name(plan: Plan, parts: Sequence[int]) -> str:
    """A part's name; of several that are joined already their names."""
    if len(parts) > 1:
        return f"{_bill(plan, parts)}, joined already, as one"
    return _single(plan, parts[0])


def _single(plan: Plan, part: int) -> str:
    """A part's name, and how it lies if that is the other way up than others."""
    place = plan.standing.kit.placements[part]
    if not place.other_way_up:
        return place.part
    return f"{place.part}, {'turned over' if place.pose.over else 'as printed'},"


def _laid(plan: Plan) -> Iterator[str]:
    """What is there before all steps, and where."""
    joints: dict[str, list[int]] = {}
    count: Counter[str] = Counter()
    for part in sorted(plan.first()):
        name = _single(plan, part)
        count[name] += 1
        joints.setdefault(name, []).extend(plan.standing.sites_of[part])
    for name, where in joints.items():
        many = f"{count[name]} x " if count[name] > 1 else ""
        yield f"{many}{name} at {_numbers(plan, where)}"


def _numbers(plan: Plan, joints: Iterable[int]) -> str:
    """Joints by their numbers from 1, runs of them by their ends."""
    some = sorted(set(joints))
    if len(some) == len(plan.standing.sites) > 1:
        return "all joints"
    runs = [list(run) for _, run in groupby(enumerate(some), key=lambda one: one[1] - one[0])]
    words: list[str] = []
    for run in runs:
        first, last = run[0][1] + 1, run[-1][1] + 1
        several = len(run) > 2
        words += [f"{first}-{last}"] if several else [str(n + 1) for _, n in run]
    if len(words) > _NAMED:
        return f"{len(some)} joints"
    return f"joint{'s' if len(some) > 1 else ''} {', '.join(words)}"


def _bill(plan: Plan, parts: Iterable[int]) -> str:
    """Parts by name and number; by what they are where there are many."""
    kit, some = plan.standing.kit, list(parts)
    counts = bill((kit.placements[n] for n in some), kit.parts)
    if len(counts) > _SORTS:
        return _summed(plan, some)
    return ", ".join(f"{count} x {name}" if count > 1 else name for name, count in counts.items())


def _summed(plan: Plan, parts: Iterable[int]) -> str:
    """Parts by what they are."""
    counts: Counter[tuple[str, str]] = Counter()
    for part in parts:
        counts[_CALLED[plan.standing.kit.placements[part].role]] += 1
    ranked = [
        (count, *names) for names in dict.fromkeys(_CALLED.values()) if (count := counts[names])
    ]
    return ", ".join(f"{count} {one if count == 1 else many}" for count, one, many in ranked)


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def finished(plan: Plan, whole: Whole) -> str:
    """What holds the finished frame.

    Parameters
    ----------
    plan
        The plan.
    whole
        What was found of the frame.
    """
    if not whole.held:
        moving = whole.loose[-1].parts
        at = _numbers(plan, (n for part in moving for n in plan.standing.sites_of[part]))
        what = f"{_bill(plan, moving)} at {at}" if moving else "no proof is found that nothing"
        return f"NOT HELD: {what} can move"
    least = (
        "nothing moves but pegs" if whole.moves == "pegs" else "nothing moves unless a peg slides"
    )
    proof = f"proved by {whole.forces} contacts in balance"
    return f"{least}, {proof}; only the fit of the pegs holds in what went in last"


def movable(plan: Plan, whole: Whole) -> list[str]:
    """What can move in the finished frame: which parts, where, and where to.

    Parameters
    ----------
    plan
        The plan.
    whole
        What was found of the frame.
    """
    pegs: dict[str, list[int]] = {}
    sets: list[str] = []
    for one in whole.loose[: None if whole.held else -1]:
        if len(one.parts) == 1:
            name = plan.standing.kit.placements[one.parts[0]].part
            pegs.setdefault(name, []).append(plan.standing.sites_of[one.parts[0]][0])
        else:
            sets.append(_sliding(plan, one))
    return [
        f"{len(at)} x {name}, each along its edge, at {_numbers(plan, at)}"
        if len(at) > 1
        else f"{name}, along its edge, at {_numbers(plan, at)}"
        for name, at in pegs.items()
    ] + sets


def _sliding(plan: Plan, one: Loose) -> str:
    """Parts that slide off pegs as one."""
    others = set(range(len(plan.standing.kit.placements))) - set(one.parts)
    off = plan.standing.meeting(one.parts, others)
    own = {n for part in one.parts for n in plan.standing.sites_of[part]} - set(off)
    at = f" at {_numbers(plan, own)}" if own else ""
    return (
        f"as one {towards(one.degrees)}, off the pegs at {_numbers(plan, off)}: "
        f"{_bill(plan, one.parts)}{at}"
    )
