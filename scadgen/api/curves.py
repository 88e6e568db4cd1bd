"""Curves of drawings in as many segments as joints have room for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from scadgen.errors import GeometryError, InputError, JointError

if TYPE_CHECKING:
    from scadgen.frame.graph import Frame
    from scadgen.readers.reading import Read

__all__ = ["roomiest", "share_of_room", "told_of_curves"]

#: Distances from curves that are tried are this many times as large as the one before, and then
#: halfway between the last two so often.
_COARSER, _HALVINGS = 2.0, 3

#: No distance beyond this share of the drawing is tried: a circle is a square then.
_COARSEST = 0.15


def share_of_room(frame: Frame, side: float, shortest: float | None = None) -> float:
    """The largest side that joints have room for, as a share of the one wanted.

    Parameters
    ----------
    frame
        The frame.
    side
        The side wanted, in mm.
    shortest
        To what length its shortest edges are brought, in mm, if they are.
    """
    from scadgen.check.frame import rings
    from scadgen.frame.classes import classify

    largest = rings(frame, classify(frame)).largest_side or 0.0
    grown = 1.0 if shortest is None else shortest / float(frame.lengths.min())
    return largest * grown / side


def roomiest(
    finest: Read, within: float, read: Callable[[float], Read], room: Callable[[Frame], float]
) -> Read:
    """A drawing with its curves as fine as joints have room for.

    Where they have no room however coarse the curves are, these are as fine as they can be all the
    same, so that it is told what would help.

    Parameters
    ----------
    finest
        The drawing with its curves as fine as they need ever be.
    within
        How far segments may be from their curves then, in mm.
    read
        Reads it with segments up to this far from curves.
    room
        The share of the room that a frame's joints have; at 1 it is enough.
    """
    from scadgen.readers.curves import CURVED

    if not any(note.startswith(CURVED) for note in finest.notes) or room(finest.frame) >= 1:
        return finest
    limit = _COARSEST * float(np.ptp(finest.frame.plan, axis=0).max())
    short, good, found = within, 0.0, finest
    tries = 0
    while tries < _HALVINGS if good else short * _COARSER <= limit:
        at = (short + good) / 2 if good else short * _COARSER
        tries += bool(good)
        try:
            coarser = read(at)
        except InputError:
            # Coarse segments may cross, or come to nothing.
            break
        if room(coarser.frame) >= 1:
            good, found = at, coarser
        else:
            short = at
    if not good:
        return finest
    note = f"curves are as near as joints have room for, {good:.3g} mm; --flatten sets how near"
    return replace(found, notes=(*found.notes, note))


@contextmanager
def told_of_curves(notes: Sequence[str]) -> Iterator[None]:
    """Say what helps if there is no room for joints in a drawing that has curves."""
    from scadgen.readers.curves import CURVED

    try:
        yield
    except GeometryError as error:
        # A joint that is not proved is no matter of room.
        if isinstance(error, JointError) or not any(note.startswith(CURVED) for note in notes):
            raise
        msg = f"{error}; a larger --flatten makes the segments of its curves longer"
        raise GeometryError(msg) from error
