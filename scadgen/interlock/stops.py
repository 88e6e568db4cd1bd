"""Parts stopped in others: what shows that nothing moves unless they slide.

A peg slides along its edge, by which everything comes apart again.  What moves besides is found
where it is stopped, by two contacts that face each other.  Where the stop must not lock what
moves together with the peg, contacts that open on the peg's way are left out, which lets more
move.  All others only slide on that way, so that they still allow a motion less what it takes the
peg along its axis: if nothing can move like that, nothing moves but by the peg's sliding.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from scadgen.interlock.contacts import Contacts
from scadgen.interlock.verdict import contacts_by_part
from scadgen.solid.affine import Floats

__all__ = ["SLIDES", "Stop", "stopped"]

#: Cosine of the angle between a contact's normal and a way up to which the contact only slides.
SLIDES = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Stop:
    """Where a part is stopped.

    Parameters
    ----------
    part
        Its number.
    others
        Numbers of the parts in which it is stopped.
    at, axis
        ``(3,) float``: a point of it, and the unit vector along which it slides.
    alone
        Whether its contacts that open or shut along the axis are left out.
    """

    part: int
    others: tuple[int, ...]
    at: Floats
    axis: Floats
    alone: bool = True


def stopped(contacts: Contacts, stops: Sequence[Stop]) -> Contacts:
    """Contacts of parts that are stopped.

    Parameters
    ----------
    contacts
        Those that there are.
    stops
        At least one.
    """
    stay = np.ones(len(contacts), dtype=np.bool_)
    parts = 1 + max(int(contacts.first.max()), int(contacts.second.max()), *(s.part for s in stops))
    of_part = contacts_by_part(contacts, parts)
    for stop in stops:
        if stop.alone:
            mine = of_part[stop.part]
            stay[mine] &= np.abs(contacts.normals[mine] @ stop.axis) < SLIDES
    left = contacts.some(np.flatnonzero(stay))
    both = [(stop, other, sign) for stop in stops for other in stop.others for sign in (1, -1)]
    return Contacts(
        np.vstack([left.points, *(stop.at for stop, _, _ in both)]),
        np.vstack([left.normals, *(sign * stop.axis for stop, _, sign in both)]),
        np.append(left.first, [other for _, other, _ in both]),
        np.append(left.second, [stop.part for stop, _, _ in both]),
    )
