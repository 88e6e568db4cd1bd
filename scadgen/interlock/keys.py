"""Which parts can move alone, and in what order an assembly comes apart part by part."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.interlock.verdict import Certificate, Motion, contacts_by_part, verdict

__all__ = ["alone", "keys"]


def alone(meshes: Sequence[Mesh], contacts: Contacts) -> list[Certificate | Motion]:
    """Whether each part can move while all others are held.

    Parameters
    ----------
    meshes
        The parts, at least two.
    contacts
        Where they touch.

    Returns
    -------
    answers
        One a part.  A certificate's rows count among the part's own contacts.

    Raises
    ------
    InputError
        There is only one part.
    ToolError
        The solver gives no answer: its status.
    """
    of_part = contacts_by_part(contacts, len(meshes))
    whole = make_assembly(meshes, contacts, range(1, len(meshes)))
    return [verdict(whole.only(part, mine)) for part, mine in enumerate(of_part)]


def keys(
    meshes: Sequence[Mesh], contacts: Contacts, held: Collection[int] = ()
) -> list[tuple[int, Motion]]:
    """Order in which parts come free alone, each with its first motion.

    The first part that can move while all others stand still is taken away, and so on.  A
    first motion is not yet a way out: that is as far as contacts alone can tell.

    Parameters
    ----------
    meshes
        The parts, at least two.
    contacts
        Where they touch.
    held
        Parts that are never taken away.

    Returns
    -------
    order
        Part and motion; parts that never come free, and the last one, are not in it.

    Raises
    ------
    InputError
        There is only one part.
    ToolError
        The solver gives no answer: its status.
    """
    whole = make_assembly(meshes, contacts, range(1, len(meshes)))
    of_part = contacts_by_part(contacts, len(meshes))
    order: list[tuple[int, Motion]] = []
    there, stuck = np.ones(len(meshes), dtype=bool), set(held)
    while there.sum() > 1:
        for part in np.flatnonzero(there).tolist():
            if part in stuck:
                continue
            mine = of_part[part]
            mine = mine[there[contacts.first[mine]] & there[contacts.second[mine]]]
            found = verdict(whole.only(part, mine))
            if isinstance(found, Motion):
                order.append((part, found))
                there[part] = False
                lost = of_part[part]
                around = {*contacts.first[lost].tolist(), *contacts.second[lost].tolist()}
                stuck = (stuck - around) | set(held)
                break
            stuck.add(part)
        else:
            break
    return order
