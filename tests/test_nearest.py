"""Nearest points of small polyhedra, against all sets of rows that may limit them."""

import itertools

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from scadgen.joint.joint import DETAILS, make_joint
from scadgen.joint.nearest import nearest_points
from scadgen.joint.recede import recede
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import any_joint


def shortest(rows, need):
    """The shortest x with rows . x >= need: the shortest one that some three rows limit."""
    found = []
    for count in range(4):
        for some in map(list, itertools.combinations(range(len(rows)), count)):
            x = np.linalg.pinv(rows[some], rcond=1e-7) @ need[some] if some else np.zeros(3)
            if (rows @ x >= need - 1e-9).all():
                found.append(x)
    return min(found, key=np.linalg.norm, default=None)


def limited(rows, need):
    """The point that `nearest_points` says is limited so; None where there is none."""
    (limiting,), (found,) = nearest_points(rows[None], need[None])
    if not found:
        return None
    used = limiting[limiting >= 0].tolist()
    assert len(set(used)) == len(used)
    inverse = np.linalg.pinv(rows[used])
    x = inverse @ need[used]
    assert (inverse.T @ x >= -1e-9 * np.abs(inverse.T @ x).max(initial=1.0)).all()
    return x


@given(
    st.integers(0, 2**32 - 1),
    st.integers(1, 7),
    st.sampled_from([1.0, 0.1, 1e-2, 1e-3, 3e-4, 1e-4]),
)
def test_the_nearest_point_is_the_shortest_of_all_that_rows_limit(seed, count, spread):
    # Rows all around one direction have such points; the closer, the more nearly they depend.
    random = np.random.default_rng(seed)
    rows = np.array([0.0, 0.0, 1.0]) + spread * random.uniform(-1, 1, (count, 3))
    rows /= np.linalg.norm(rows, axis=1)[:, None]
    need = random.uniform(0.5, 1.0, count) if spread == 1.0 else np.ones(count)
    wanted, x = shortest(rows, need), limited(rows, need)
    assert (wanted is None) == (x is None)
    if wanted is not None:
        assert (rows @ x >= need - 1e-10).all()
        assert np.linalg.norm(x) <= np.linalg.norm(wanted) + 1e-6


def test_rows_that_nearly_depend_limit_a_point_once_each():
    # Four facets of a wall that all but lie in one plane.
    rows = np.array(
        [
            [-0.8986264473088579, 0.43866746058587636, 0.006431735395618176],
            [-0.8981280627454205, 0.4396486809981782, 0.008661420537096036],
            [-0.8985833003063635, 0.43875583909775145, 0.006431645835392695],
            [-0.899036523849577, 0.43778793636168145, 0.008663230381857366],
        ]
    )
    assert np.abs(limited(rows, np.ones(4)) - shortest(rows, np.ones(4))).max() < 1e-6


def test_walls_draw_back_by_a_whole_unit_at_every_corner():
    turns = np.radians([0.0, 70.0, 200.0]).tolist()
    made = make_joint(Spokes.flat(turns), any_joint(turns[1]), DETAILS["standard"])
    pieces = [(surface, ()) for surface in made.connectors]
    for (surface, _), displacement in zip(pieces, recede(pieces), strict=True):
        corners = surface.points[surface.walls]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        across /= np.linalg.norm(across, axis=1)[:, None]
        along = (displacement[surface.walls] * across[:, None]).sum(axis=2)
        assert along.max() < -1 + 1e-10


def test_where_rows_contradict_each_other_there_is_no_point():
    rows = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    assert limited(rows, np.array([1.0, 0.5])) is None
