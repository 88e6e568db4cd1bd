"""What comes of one item, wherever it is worked on."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from scadgen.errors import ScadgenError

__all__ = ["Outcome", "attempt"]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")

#: An item's number, and its result or why there is none.
Outcome = tuple[int, _Result | ScadgenError]


def attempt(function: Callable[[_Item], _Result], number: int, item: _Item) -> Outcome[_Result]:
    """The outcome of one item.

    Parameters
    ----------
    function
        What is to be done.
    number, item
        Which item of all, and the item.
    """
    try:
        return number, function(item)
    except ScadgenError as error:
        return number, error
