"""Checks a certificate from the contacts alone, sharing no code with what found it."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from scipy.sparse import coo_array, csc_array
from scipy.sparse.linalg import ArpackError, eigsh

from scadgen.interlock.contacts import Contacts
from scadgen.interlock.verdict import Certificate
from scadgen.solid.affine import Floats, Ints

__all__ = ["check_certificate", "rank_deficiency"]

#: Least eigenvalue of the stiffness, as a share of the largest, that counts as above zero.
_RANK = 1e-12

#: Unknowns up to which the eigenvalues are found densely.
_DENSE = 600


def check_certificate(
    contacts: Contacts, held: Collection[int], count: int, certificate: Certificate
) -> float:
    """Largest force or torque left on a free part, as a share of all forces on it.

    The forces are summed up part by part.  The proof holds if the result is below 1e-8.

    Parameters
    ----------
    contacts
        The assembly's contacts.
    held
        Numbers of the parts that are held.
    count
        Number of parts.
    certificate
        The certificate.

    Returns
    -------
    residual
        Infinite if the certificate is no proof for another reason: a contact that does not
        exist or comes twice, a force below 1, a free part without any, or a rank that is not
        six times the number of free parts, found anew.
    """
    rows, forces = np.asarray(certificate.rows), np.asarray(certificate.forces)
    free = np.setdiff1d(np.arange(count), list(held))
    listed = len(rows) == len(forces) == len(np.unique(rows)) > 0
    if not listed or rows.min() < 0 or rows.max() >= len(contacts):
        return np.inf
    if not np.isfinite(forces).all() or forces.min() < 1 - 1e-9:
        return np.inf
    push = forces[:, None] * contacts.normals[rows]
    middle = contacts.points[rows].mean(axis=0)
    arms = contacts.points[rows] - middle
    wrench = np.concatenate([push, np.cross(arms, push)], axis=1)
    total, left = np.zeros(count), np.zeros((count, 6))
    for part, sign in ((contacts.second[rows], 1.0), (contacts.first[rows], -1.0)):
        np.add.at(left, part, sign * wrench)
        np.add.at(total, part, forces)
    if not total[free].all() or certificate.rank != 6 * len(free):
        return np.inf
    reach = max(float(np.linalg.norm(arms, axis=1).max()), np.finfo(float).tiny)
    left[:, 3:] /= reach
    if rank_deficiency(contacts, free, rows):
        return np.inf
    return float((np.linalg.norm(left[free], axis=1) / total[free]).max())


def rank_deficiency(contacts: Contacts, free: Ints, rows: Ints) -> int:
    """How many independent motions some contacts do not feel at all.

    Parameters
    ----------
    contacts
        The assembly's contacts.
    free
        Numbers of the parts that are not held.
    rows
        Numbers of the contacts that count.

    Returns
    -------
    count
        In assemblies of more than 100 free parts 1 stands for any number above 0.
    """
    normals, points = contacts.normals[rows], contacts.points[rows]
    ends = (contacts.first[rows], contacts.second[rows])
    parts = [np.flatnonzero((ends[0] == part) | (ends[1] == part)) for part in free]
    entries: list[tuple[Floats, Ints, Ints]] = []
    for number, (part, mine) in enumerate(zip(free, parts, strict=True)):
        arms = points[mine] - points[mine].mean(axis=0)
        size = max(float(np.linalg.norm(arms, axis=1).max(initial=0.0)), np.finfo(float).tiny)
        block = np.concatenate([normals[mine], np.cross(arms, normals[mine]) / size], axis=1)
        block[ends[0][mine] == part] *= -1
        column = np.tile(6 * number + np.arange(6), len(mine))
        entries.append((block.ravel(), np.repeat(mine, 6), column))
    values, row, column = (np.concatenate(e) for e in zip(*entries, strict=True))
    matrix = coo_array((values, (row, column)), shape=(len(rows), 6 * len(free))).tocsr()
    stiffness = csc_array(matrix.T @ matrix)
    if stiffness.shape[0] <= _DENSE:
        found = np.linalg.eigvalsh(stiffness.toarray())
        return int((found <= _RANK * found[-1]).sum())
    start = np.ones(stiffness.shape[0])
    largest = float(eigsh(stiffness, 1, which="LM", v0=start, return_eigenvectors=False)[0])
    try:
        least = eigsh(
            stiffness, 1, sigma=-_RANK * largest, which="LM", v0=start, return_eigenvectors=False
        )
    except (RuntimeError, ArpackError):  # the factor is exactly singular, or it never settles
        return 1
    return int(least[0] <= _RANK * largest)
