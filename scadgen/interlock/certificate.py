"""Checks a certificate from the contacts alone, sharing no code with what found it."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array
from scipy.sparse.linalg import ArpackError, eigsh

from scadgen.interlock.contacts import Contacts
from scadgen.interlock.verdict import Certificate
from scadgen.solid.affine import Floats, Ints

__all__ = ["BALANCED", "check_certificate"]

#: Below this a certificate is a proof.  1 would do; what balances but for rounding is far below.
BALANCED = 1e-6

#: Least eigenvalue of the stiffness, as a share of the largest, that counts as above zero.
_RANK = 1e-12

#: Unknowns up to which the eigenvalues are found densely.
_DENSE = 600


def check_certificate(
    contacts: Contacts, held: Collection[int], count: int, certificate: Certificate
) -> float:
    """How far a certificate is from a balance, as a share of what would make it no proof.

    Let A be the contacts' rows, with rotations scaled by the reach of each part's contacts, s
    its least singular value, and l the forces, each at least 1.  If A x >= 0 then

        s |x| <= |A x| <= sum of A x <= l . A x <= |A^T l| |x|,

    so that |A^T l| / s below 1 leaves nothing but x = 0.  Forces that balance by themselves
    make neither side larger or smaller.

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
    quotient
        |A^T l| / s; the proof holds below `BALANCED`.  Infinite if the certificate is no proof
        for another reason: a contact that does not exist or comes twice, a force below 1, a
        free part without any, or a rank that is not six times the number of free parts, found
        anew.
    """
    rows, forces = np.asarray(certificate.rows), np.asarray(certificate.forces)
    free = np.setdiff1d(np.arange(count), list(held))
    listed = len(rows) == len(forces) == len(np.unique(rows)) > 0
    if not listed or rows.min() < 0 or rows.max() >= len(contacts):
        return np.inf
    if not np.isfinite(forces).all() or forces.min() < 1 - 1e-9:
        return np.inf
    pushing = contacts.some(rows)
    touched = np.isin(free, [pushing.first, pushing.second]).all()
    if not touched or certificate.rank != 6 * len(free):
        return np.inf
    matrix = _scaled(pushing, free)
    least = _least_singular(matrix)
    return float(np.linalg.norm(matrix.T @ forces) / least) if least else np.inf


def _scaled(contacts: Contacts, free: Ints) -> csr_array:
    """A row a contact; columns are a free part's motion, about the middle of its contacts."""
    entries: list[tuple[Floats, Ints, Ints]] = []
    for number, part in enumerate(free):
        mine = np.flatnonzero((contacts.first == part) | (contacts.second == part))
        points, normals = contacts.points[mine], contacts.normals[mine]
        arms = points - points.mean(axis=0)
        reach = max(float(np.linalg.norm(arms, axis=1).max()), np.finfo(float).tiny)
        block = np.concatenate([normals, np.cross(arms, normals) / reach], axis=1)
        block[contacts.first[mine] == part] *= -1
        column = np.tile(6 * number + np.arange(6), len(mine))
        entries.append((block.ravel(), np.repeat(mine, 6), column))
    values, row, column = (np.concatenate(e) for e in zip(*entries, strict=True))
    return csr_array(coo_array((values, (row, column)), shape=(len(contacts), 6 * len(free))))


def _least_singular(matrix: csr_array) -> float:
    """The least singular value, 0 where the rank is not full."""
    stiffness = csc_array(matrix.T @ matrix)
    if stiffness.shape[0] <= _DENSE:
        found = np.linalg.eigvalsh(stiffness.toarray())
        least, largest = float(found[0]), float(found[-1])
    else:
        start = np.ones(stiffness.shape[0])
        largest = float(eigsh(stiffness, 1, which="LM", v0=start, return_eigenvectors=False)[0])
        shift = -_RANK * largest
        try:
            (least,) = eigsh(
                stiffness, 1, sigma=shift, which="LM", v0=start, return_eigenvectors=False
            )
        except (RuntimeError, ArpackError):  # the factor is exactly singular, or never settles
            return 0.0
    return float(np.sqrt(least)) if least > _RANK * largest else 0.0
