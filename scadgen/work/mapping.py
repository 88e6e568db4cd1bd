"""A pure function applied to many items, each only once for as long as its result is kept."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from scadgen.errors import ScadgenError
from scadgen.work.cache import Cache, Entry
from scadgen.work.executor import ALONE, Executor

__all__ = ["Execution", "Task", "map_cached"]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


@dataclass(frozen=True, slots=True)
class Task(Generic[_Item, _Result]):
    """A pure function, and how its results are kept.

    Parameters
    ----------
    function
        A public function of a module, which depends on nothing but its argument.
    key
        The key of an item's result, as `key_of` makes it.
    packed, unpacked
        A result as what can be kept, and back; the latter is given the item too.
    """

    function: Callable[[_Item], _Result]
    key: Callable[[_Item], str]
    packed: Callable[[_Result], Entry]
    unpacked: Callable[[Entry, _Item], _Result]


@dataclass(frozen=True, slots=True)
class Execution:
    """What there is to work with.

    Parameters
    ----------
    crew
        Who works.
    cache
        Where results are kept; None for nowhere.
    """

    crew: Executor = field(default=ALONE)
    cache: Cache | None = None


def map_cached(
    task: Task[_Item, _Result], items: Sequence[_Item], means: Execution
) -> Iterator[tuple[int, _Result]]:
    """Do a task for each of some items.

    Results are kept one by one as they come: what is done is done, whatever happens then.

    Parameters
    ----------
    task
        The task.
    items
        What to do it for.
    means
        Who works, and where results are kept.

    Yields
    ------
    number, result
        An item's number and its result: first those that were kept, in order; then those
        that are new, in any order.

    Raises
    ------
    ScadgenError
        An item is refused: the first in order, whichever is found first.
    """
    left: list[int] = []
    for number, item in enumerate(items):
        kept = _kept(task, item, means.cache)
        if kept is None:
            left.append(number)
        else:
            yield number, kept
    yield from _new(task, items, left, means)


def _kept(task: Task[_Item, _Result], item: _Item, cache: Cache | None) -> _Result | None:
    """A result that is kept, if it is."""
    entry = cache.find(task.key(item)) if cache else None
    if entry is None:
        return None
    try:
        return task.unpacked(entry, item)
    except (KeyError, IndexError, TypeError, ValueError):
        return None  # whatever wrote that, it is not what this writes


def _new(
    task: Task[_Item, _Result], items: Sequence[_Item], numbers: Sequence[int], means: Execution
) -> Iterator[tuple[int, _Result]]:
    """Results that are not kept yet, as they come."""
    left, refused = set(numbers), dict[int, ScadgenError]()
    outcomes = means.crew.outcomes(task.function, [items[number] for number in numbers])
    with closing(outcomes):
        for place, outcome in outcomes:
            number = numbers[place]
            left.discard(number)
            if isinstance(outcome, ScadgenError):
                refused[number] = outcome
            else:
                if means.cache:
                    means.cache.keep(task.key(items[number]), task.packed(outcome))
                yield number, outcome
            if refused and min(refused) < min(left, default=len(items)):
                raise refused[min(refused)]
