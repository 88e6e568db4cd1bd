"""Forces at contacts that hold parts in equilibrium, and motions that no contact feels.

Both come from one factorisation of A^T D A, sparse, where A are the contacts' rows.

The forces are looked for by Newton's method for the largest product of all of them with
A^T lambda = 0: a lock mostly shows in two to ten steps.  Where there are none they grow apart
beyond all measure, and the search ends.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, diags_array, eye_array
from scipy.sparse.linalg import SuperLU, splu

from scadgen.solid.affine import Floats

__all__ = ["ROUNDING", "balanced", "equilibrium", "unfelt"]

#: How much of a motion's speed a contact may close in with and still count as sliding.  The
#: normals of an STL, which keeps 7 digits, tilt by 1e-7 to 1e-5.
ROUNDING = 1e-5

#: Newton steps, and the share of the way to the first force of zero that one may go.
_STEPS, _SHARE = 25, 0.9

#: Diagonal added, as a share of the largest: parts that slide make A^T D A singular.
_SHIFT = 1e-13

#: Steps that put forces right in an equilibrium: what the shift leaves over shrinks with each.
_CORRECTIONS = 4

#: Steps of inverse iteration.
_ITERATIONS = 4


def _factor(rows: csr_array, weights: Floats) -> SuperLU:
    """Factors of A^T D A."""
    square = csc_array(rows.T @ (diags_array(weights) @ rows))
    shift = _SHIFT * max(float(square.diagonal().max(initial=0.0)), np.finfo(float).tiny)
    return splu(
        csc_array(square + shift * eye_array(square.shape[0])),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )


def equilibrium(rows: csr_array, rounding: float = ROUNDING) -> Floats | None:
    """Forces, all of them pushing, that hold parts in equilibrium.

    Parameters
    ----------
    rows
        ``(k, n)``: the contacts' inequalities.
    rounding
        How far the contacts' normals may be tilted: a lock that such a tilt could undo is none.

    Returns
    -------
    forces
        ``(k,) float``, the least of them 1; None if none are found, or none that are within
        1 / `rounding` of each other.
    """
    forces = np.ones(rows.shape[0])
    for _ in range(_STEPS):
        weights = forces**2
        x = _factor(rows, weights).solve(rows.T @ (-2 * forces))
        change = 1 + forces * (rows @ x)
        whole = bool(change.min() > -_SHARE)
        forces *= 1 + (1.0 if whole else -_SHARE / change.min()) * change
        if not np.isfinite(forces).all() or forces.max() * rounding > forces.min():
            return None
        if whole:
            return balanced(rows, forces)
    return None


def balanced(rows: csr_array, forces: Floats) -> Floats | None:
    """Correct forces that are nearly in equilibrium; the least of them is 1 then.

    Returns
    -------
    forces
        None if they are not all pushing then.
    """
    factor = _factor(rows, forces**2)
    for _ in range(_CORRECTIONS):
        forces = forces - forces**2 * (rows @ factor.solve(rows.T @ forces))
        if forces.min() <= 0:
            return None
    return np.asarray(forces / forces.min())


def unfelt(rows: csr_array) -> NDArray[np.float64] | None:
    """A motion along which all contacts only slide, its largest entry 1, if there is one."""
    factor = _factor(rows, np.ones(rows.shape[0]))
    x = np.random.default_rng(0).normal(size=rows.shape[1])
    for _ in range(_ITERATIONS):
        x = factor.solve(x)
        x /= np.abs(x).max()
    felt = float(np.abs(rows @ x).max(initial=0.0))
    return x if felt <= ROUNDING else None
