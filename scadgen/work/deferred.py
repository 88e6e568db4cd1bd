"""Interrupts that wait for the end of what must not be cut in two."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

__all__ = ["interrupts_held"]

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Let interrupts wait until this is done, then do what they would have done.

    For short work within others' code that an exception in the wrong place leaves torn, as
    the writing of a zip file.  Threads but the main one never see an interrupt: there this
    does nothing.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in _SIGNALS}
    seen: list[int] = []
    over = False

    def note(number: int, frame: FrameType | None) -> None:
        handler = before[signal.Signals(number)]
        if not over:
            seen.append(number)
        elif callable(handler):  # it came while handlers are put back
            handler(number, frame)

    for number in _SIGNALS:
        signal.signal(number, note)
    try:
        yield
    finally:
        over = True
        for number, handler in before.items():
            # None stands for a handler that Python did not set and cannot set again.
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
        if seen:
            signal.raise_signal(seen[0])
