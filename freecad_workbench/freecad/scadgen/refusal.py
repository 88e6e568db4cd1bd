"""Refusing in `execute`: the object is in an error state, and the report view says one line.

FreeCAD prints a traceback of whatever `execute` raises, unless Python is told that tracebacks
have no lines.  It is told so from the refusal to the end of the recompute.
"""

from __future__ import annotations

import sys
from typing import Any, NoReturn

import FreeCAD

__all__ = ["refuse"]


class _Limit:
    """Python's limit of traceback lines, put back when a recompute has ended."""

    def __init__(self) -> None:
        self._before: int | None = None
        self._set = False
        FreeCAD.addDocumentObserver(self)

    def set(self) -> None:
        """Lines: none."""
        limit = getattr(sys, "tracebacklimit", None)
        if limit != 0:
            self._before, self._set = limit, True
            sys.tracebacklimit = 0

    def slotRecomputedDocument(self, _: Any) -> None:
        self._put_back()

    def slotRecomputedObject(self, _: Any) -> None:
        self._put_back()

    def _put_back(self) -> None:
        if not self._set:
            return
        self._set = False
        if self._before is None:
            del sys.tracebacklimit
        else:
            sys.tracebacklimit = self._before


_LIMIT = _Limit()


def refuse(message: str) -> NoReturn:
    """Leave `execute` with an error; the object keeps its shape.

    Parameters
    ----------
    message
        One line: what is wrong, the value, what works.

    Raises
    ------
    ValueError
        Always.
    """
    _LIMIT.set()
    raise ValueError(message)
