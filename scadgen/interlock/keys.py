"""Which parts can move alone."""

from __future__ import annotations

from collections.abc import Sequence

from scadgen.interlock.assembly import make_assembly
from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.interlock.verdict import Certificate, Motion, contacts_by_part, verdict

__all__ = ["alone"]


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
