"""Is an assembly locked?  The answer with its proof.

Let A be the rows of an assembly.  It is locked to first order iff A x >= 0 has no solution but
x = 0.  By Stiemke's lemma that is so iff A has full column rank and there is a lambda > 0 with
A^T lambda = 0: forces at the contacts, all of them pushing, that leave every free part in
equilibrium.  They are the certificate; `certificate.check_certificate` checks it without any
of the code here.

1. Look for the forces by Newton's method; where they exist that takes milliseconds.
2. Else see whether a single part moves, straight first: the motion easiest to understand, along
   an axis of coordinates or a normal if that is possible.
3. Else maximise the sum of A x with A x >= 0 and |x| <= 1: a motion of several parts.  A
   motion along which all contacts slide has A x = 0; only the rank shows it.
4. Else let every contact have a gap of `ROUNDING`: what then moves by 1 is only jammed by
   rounding; otherwise the prices y >= 0 of the gaps satisfy A^T (1 + y) = 0.

All on the extreme contacts alone; others are added where a motion violates them, as locked on
some rows is locked on all.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array
from scipy.sparse.csgraph import connected_components

from scadgen.errors import ToolError
from scadgen.interlock.assembly import Assembly, extreme_rows
from scadgen.interlock.contacts import Contacts
from scadgen.interlock.forces import ROUNDING, balanced, equilibrium, unfelt
from scadgen.interlock.program import farthest
from scadgen.solid.affine import Floats, Ints

__all__ = ["Certificate", "Motion", "contacts_by_part", "verdict"]

#: Rows to add at most in a round, for each unknown.
_ADD = 3

#: Speed, as a share of the fastest part's, below which a part rests.
_RESTS = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Certificate:
    """Proof that an assembly is locked.

    Parameters
    ----------
    rows
        ``(k,) int``: the contacts that push.
    forces
        ``(k,) float``: how hard, each at least 1.
    rank
        Column rank of these contacts' rows.
    """

    rows: Ints
    forces: Floats
    rank: int


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """A way in which parts can move, to first order.

    No contact closes in by more than `ROUNDING` of the motion's speed.

    Parameters
    ----------
    parts
        Numbers of the parts that move.
    translations
        ``(parts, 3) float``: velocity of the middle of each part's box; the largest entry of
        these, and of the rotations times the parts' sizes, is 1.
    rotations
        ``(parts, 3) float``: rotation about it, in radians per unit of time.
    slides
        Whether all contacts only slide.
    rounded
        Whether it is of round faces, not of the facets that stand for them: then contacts
        of facets may close in.
    """

    parts: tuple[int, ...]
    translations: Floats
    rotations: Floats
    slides: bool
    rounded: bool = False


def verdict(assembly: Assembly) -> Certificate | Motion:
    """Whether an assembly is locked to first order.

    Parameters
    ----------
    assembly
        The assembly.

    Returns
    -------
    answer
        The proof that it is, or a motion: of one part if one can move alone, straight if
        that is possible.

    Raises
    ------
    ToolError
        The solver gives no answer: its status.
    """
    if adrift := _adrift(assembly):
        x = np.zeros(assembly.rows.shape[1])
        x[[6 * assembly.free.index(part) for part in adrift]] = 1.0
        return _motion(assembly, x)
    chosen, unknowns = extreme_rows(assembly), assembly.rows.shape[1]
    some = assembly.rows[chosen]
    forces = equilibrium(some)
    if forces is not None and unfelt(some) is None:
        return Certificate(chosen, forces, unknowns)
    if len(assembly.free) > 1:
        of_part = contacts_by_part(assembly.contacts, len(assembly.middles))
        for part in assembly.free:
            alone = verdict(assembly.only(part, of_part[part]))
            if isinstance(alone, Motion):
                return alone
    else:
        shifts = csr_array(csc_array(assembly.rows)[:, :3])
        plain = _plain(shifts, chosen)
        straight = _follow(shifts, chosen) if plain is None else plain
        if isinstance(straight, np.ndarray):
            return _motion(assembly, np.concatenate([straight, np.zeros(3)]))
    found = _follow(assembly.rows, chosen)
    return found if isinstance(found, Certificate) else _motion(assembly, found)


def contacts_by_part(contacts: Contacts, count: int) -> list[Ints]:
    """Numbers of the contacts of each part, ascending."""
    both = np.concatenate([contacts.first, contacts.second])
    order = np.argsort(both, kind="stable")
    ends = np.searchsorted(both[order], np.arange(1, count))
    return [np.sort(mine % max(len(contacts), 1)) for mine in np.split(order, ends)]


def _adrift(assembly: Assembly) -> list[int]:
    """Free parts that nothing held touches, not even by way of others."""
    contacts, count = assembly.contacts, len(assembly.middles)
    graph = csr_array(
        (np.ones(len(contacts)), (contacts.first, contacts.second)), shape=(count, count)
    )
    _, label = connected_components(graph, directed=False)
    held = np.setdiff1d(np.arange(count), assembly.free)
    adrift = [part for part in assembly.free if label[part] not in label[held]]
    # Those that hang together move together.
    return [part for part in adrift if label[part] == label[adrift[0]]]


def _plain(shifts: csr_array, chosen: Ints) -> Floats | None:
    """A straight motion along an axis of coordinates, else a normal: the one that opens most."""
    some = shifts[chosen]
    normals = np.unique(some.toarray().round(9) + 0.0, axis=0)
    # A contact of other parts has no normal here.
    for ways in (np.eye(3), normals[normals.any(axis=1)]):
        both = np.concatenate([ways, -ways])
        both = both[(some @ both.T).min(axis=0) >= -ROUNDING]
        separation = shifts @ both.T
        good = np.flatnonzero(separation.min(axis=0, initial=0.0) >= -ROUNDING)
        if len(good):
            opens = separation[:, good].mean(axis=0).round(9)
            return np.asarray(both[good[np.argmax(opens)]])
    return None


def _follow(rows: csr_array, chosen: Ints) -> Floats | Certificate:
    """A motion that no row forbids, its largest entry 1, or the proof that there is none."""
    while True:
        found = _judged(rows[chosen])
        if isinstance(found, tuple):
            return Certificate(chosen, found[0], rows.shape[1])
        ways = [found, -found] if np.abs(rows[chosen] @ found).max() <= ROUNDING else [found]
        worst = chosen
        for way in ways:
            separation = rows @ way
            violated = np.flatnonzero(separation < -2 * ROUNDING)
            if not len(violated):
                return way
            order = np.argsort(separation[violated], kind="stable")
            worst = np.union1d(worst, violated[order][: _ADD * rows.shape[1]])
        if len(worst) == len(chosen):
            msg = "the solver gives no answer: its motion violates its own constraints"
            raise ToolError(msg)
        chosen = worst


def _judged(rows: csr_array) -> Floats | tuple[Floats]:
    """A motion, its largest entry 1, or the forces that forbid any."""
    goal = np.asarray(rows.sum(axis=0), dtype=np.float64).ravel()
    for gap, bound in ((0.0, 1.0), (1.0, 1 / ROUNDING)):
        found = farthest(goal, rows, gap, bound)
        if found is not None and np.abs(found.x).max() > 0.9 * bound:
            return np.asarray(found.x / np.abs(found.x).max())
        if gap == 0 and (slide := unfelt(rows)) is not None:
            return slide
    forces = equilibrium(rows)
    if forces is None and found is not None:
        forces = balanced(rows, 1 + found.prices)
    if forces is None:
        msg = "the solver gives no answer: its prices are no equilibrium"
        raise ToolError(msg)
    return (forces,)


def _motion(assembly: Assembly, x: Floats) -> Motion:
    """A solution by parts."""
    x = x / np.abs(x).max()
    steps = x.reshape(-1, 6)
    moving = np.flatnonzero(np.abs(steps).max(axis=1) > _RESTS)
    parts = tuple(assembly.free[n] for n in moving)
    slides = bool(np.abs(assembly.rows @ x).max(initial=0.0) <= 2 * ROUNDING)
    if slides:  # either way; the same one each time
        steps = steps * np.sign(x[np.abs(x).argmax()])
    turns = steps[moving, 3:] / assembly.sizes[list(parts), None]
    return Motion(parts, steps[moving, :3], turns, slides)
