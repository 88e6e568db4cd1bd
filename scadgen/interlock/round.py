"""Parts that turn in each other although the facets of their round faces lock.

The facets of two round faces are saw-teeth: to first order they lock by themselves, however
wide the gap.  So where they might, round faces get the normals that they were drawn from:
across edges where facets meet at a small angle the normals at corners are means, and in
between they change steadily.  The motions along which contacts only slide by these normals,
nearly, are the least eigenvectors of a matrix of six rows (Gelfand and Guibas, Shape
segmentation using local slippage analysis, 2004).  Such a motion counts if the parts as they
are can follow it some way and overlap nowhere deeper than facets are off the round faces.

Flat contacts may open on it but not close, as where a pin turns off a stop.

Bodies that turn until something stops them after less than that way are not found, nor are
motions in which round faces part, nor sets of parts other than the ones that are asked for.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import csr_array

from scadgen.interlock.contacts import Contacts, Mesh, find_contacts
from scadgen.interlock.facets import Bools, bent_faces
from scadgen.interlock.follow import middle, screw
from scadgen.interlock.path import united
from scadgen.interlock.program import farthest
from scadgen.interlock.roundness import round_normals
from scadgen.interlock.verdict import Motion
from scadgen.solid.affine import Floats, Ints
from scadgen.solid.gap import thickness
from scadgen.solid.mesh import normals as face_normals

__all__ = ["round_depth", "round_motions", "smooth_normals"]

#: Cosine of the angle below which facets that meet are of one round face.
_ROUND = np.cos(np.radians(20.0))

#: Least change of a normal by which a face counts as round.
_BENT = 1e-3

#: Change of a normal that is rounding.
_SAME = 1e-9

#: Speed at which contacts may close in, root mean square, as a share of their own.
_SLIP = 0.02

#: Share of the unhindered speed below which flat contacts hinder a motion.
_FREE = 0.3

#: Share of its speed at which a contact of flat faces may close in.
_CLOSING = 0.01

#: How nearly contacts climb alike on the way round an axis, and ways of climbing to try.
_CLIMB, _CLIMBS = 0.02, 3

#: How far the fastest contact follows a motion, in tolerances: no play in a gap goes so far.
_FAR = 10.0

#: Places that are looked at on the way.
_PLACES = 12

#: Depth of an overlap, as a share of all parts' size, that is rounding.
_ROUNDING = 1e-6

#: How nearly a motion must turn about an axis to be told by that axis.
_ALONG = 0.02


def round_motions(
    meshes: Sequence[Mesh], contacts: Contacts, tolerance: float, bodies: Sequence[Sequence[int]]
) -> list[Motion | None]:
    """Motions along which round faces slide.

    Parameters
    ----------
    meshes
        The parts, closed and oriented.
    contacts
        Where they touch within the tolerance.
    tolerance
        That distance.
    bodies
        Numbers of the parts of each body, which moves as one while all others stand still.

    Returns
    -------
    motions
        One a body, None where none is found.

    Raises
    ------
    InvariantError
        If one of the meshes is not a solid.
    """
    sure = [round_normals(*mesh) for mesh in meshes]
    normals = [smooth_normals(*m, true) for m, true in zip(meshes, sure, strict=True)]
    off = [_off(*mesh, normal) for mesh, normal in zip(meshes, normals, strict=True)]
    corners = np.concatenate([points for points, _ in meshes])
    rounding = _ROUNDING * float(np.linalg.norm(np.ptp(corners, axis=0)))
    if max(off) <= rounding:
        return [None] * len(bodies)
    # Where facets are few, those of a thread are no help: cylinders and the like alone are sure.
    coarse = any(not np.isnan(normal).all() for normal in sure)
    kinds = [find_contacts(meshes, tolerance, normals)]
    marked, change = kinds[0], _SAME
    if coarse:
        kinds.append(find_contacts(meshes, tolerance, _with_facets(meshes, sure)))
        marked, change = find_contacts(meshes, tolerance, _marks(meshes, normals)), _BENT
    hard = np.linalg.norm(marked.normals - contacts.normals, axis=1) <= change
    found: list[Motion | None] = [None] * len(bodies)
    for smooth in kinds:
        bent = np.linalg.norm(smooth.normals - contacts.normals, axis=1) > _BENT
        for number, body in enumerate(bodies):
            inside = np.isin(smooth.first, body)
            mine = np.flatnonzero(inside != np.isin(smooth.second, body))
            others = [n for n in range(len(meshes)) if n not in body]
            both = max(off[n] for n in body) + max(off[n] for n in others)
            depth = rounding + min(both, tolerance)
            if found[number] is None and bent[mine].any():
                touching, far = smooth.some(mine), _FAR * tolerance
                which = bent[mine], hard[mine]
                found[number] = _slides(meshes, touching, which, body, far, depth)
    return found


def _with_facets(meshes: Sequence[Mesh], normals: Sequence[Floats]) -> list[Floats]:
    """Normals of round faces, and those of facets where there are none."""
    return [
        np.where(np.isnan(normal), face_normals(*mesh)[:, None], normal)
        for mesh, normal in zip(meshes, normals, strict=True)
    ]


def _marks(meshes: Sequence[Mesh], normals: Sequence[Floats]) -> list[Floats]:
    """Normals of flat faces; for those that may stand for round ones vectors that are none.

    By these contacts of flat faces are told from all others.
    """
    found = []
    for (points, triangles), normal in zip(meshes, normals, strict=True):
        own = face_normals(points, triangles)
        soft = np.abs(normal - own[:, None]).max(axis=(1, 2)) > _BENT
        soft |= bent_faces(points, triangles)
        across = np.cross(own, np.eye(3)[np.abs(own).argmin(axis=1)])
        found.append(np.repeat((own + soft[:, None] * across)[:, None], 3, axis=1))
    return found


def round_depth(meshes: Sequence[Mesh], tolerance: float) -> float:
    """How deep round faces of parts may be in each other where facets stand for them.

    Parameters
    ----------
    meshes
        The parts.
    tolerance
        The most that it is.
    """
    off = [_off(*mesh, smooth_normals(*mesh)) for mesh in meshes]
    return min(sum(sorted(off)[-2:]), tolerance)


def smooth_normals(points: Floats, triangles: Ints, true: Floats | None = None) -> Floats:
    """Normals at the corners of facets, of the round faces that they stand for.

    Parameters
    ----------
    points
        ``(v, 3) float``; equal points have one number.
    triangles
        ``(m, 3) int``.
    true
        What `round_normals` says of them, if that is known.

    Returns
    -------
    normals
        ``(m, 3, 3) float``: at each corner the mean of the facets there that meet this one
        below 20 degrees, weighted by their angles, so that it matters not how flat faces are
        cut into triangles; of facets that lie on a cylinder, cone or sphere, that one's own.
    """
    corners = points[triangles]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    across = np.cross(ahead, back)
    length = np.linalg.norm(across, axis=2)
    angle = np.arctan2(length, (ahead * back).sum(axis=2)).ravel()
    unit = across[:, 0] / np.maximum(length[:, :1], 1e-300)
    # Facets of one plane count as one, which keeps the pairs few where many meet.
    sign = np.column_stack([triangles.ravel(), np.repeat(unit.round(6), 3, axis=0)])
    _, first, group = np.unique(sign, axis=0, return_index=True, return_inverse=True)
    group = group.reshape(-1)
    vertex, normal = triangles.ravel()[first], np.repeat(unit, 3, axis=0)[first]
    weight = np.bincount(group, weights=angle)
    total = np.zeros((len(first), 3))
    count = np.bincount(vertex, minlength=len(points))
    start = np.cumsum(count) - count
    # Groups are in the order of their vertices: each meets the one some steps on, in turn.
    place = np.arange(len(first)) - start[vertex]
    for step in range(int(count.max(initial=0))):
        here = np.flatnonzero(step < count[vertex])
        other = start[vertex[here]] + (place[here] + step) % count[vertex[here]]
        near = (normal[here] * normal[other]).sum(axis=1) > _ROUND
        total[here[near]] += weight[other[near], None] * normal[other[near]]
    total /= np.maximum(np.linalg.norm(total, axis=1), 1e-300)[:, None]
    true = round_normals(points, triangles) if true is None else true
    return np.where(np.isnan(true), total[group].reshape(-1, 3, 3), true)


def _off(points: Floats, triangles: Ints, normals: Floats) -> float:
    """How far facets are at most off the round faces that they stand for."""
    along = np.roll(points[triangles], -1, axis=1) - points[triangles]
    turn = np.roll(normals, -1, axis=1) - normals
    return float(np.abs((along * turn).sum(axis=2)).max(initial=0.0)) / 8


def _slides(
    meshes: Sequence[Mesh],
    contacts: Contacts,
    kinds: tuple[Bools, Bools],
    body: Sequence[int],
    far: float,
    depth: float,
) -> Motion | None:
    """A motion of a body that its contacts nearly allow and that its mesh can follow."""
    points = np.concatenate([meshes[n][0] for n in body])
    about, size = middle(points), float(np.linalg.norm(np.ptp(points, axis=0))) / 2
    moving = united([meshes[n] for n in body])
    rest = united([mesh for n, mesh in enumerate(meshes) if n not in body])
    arms = (contacts.points - about) / size
    away = np.where(np.isin(contacts.second, body), 1.0, -1.0)[:, None] * contacts.normals
    rows = np.column_stack([away, np.cross(arms, away)])
    bent, hard = kinds
    for x in _slippage(arms, rows, bent, hard & ~bent):
        t, w = x[:3], x[3:] / size
        fastest = np.linalg.norm(t + np.cross(x[3:], arms), axis=1).max()
        poses = (screw(about, t, w, k * far / fastest / _PLACES) for k in range(1, _PLACES + 1))
        if all(thickness(moving.transform(pose) ^ rest) <= depth for pose in poses):
            slides = bool((rows[hard] @ x).max(initial=0.0) <= _SLIP)
            return _motion(meshes, body, about, (t, w), slides=slides)
    return None


def _slippage(arms: Floats, rows: Floats, bent: Bools, hard: Bools) -> Iterator[Floats]:
    """Motions by which contacts of round faces nearly slide; and no flat ones close.

    Those about the axes of coordinates come first.  Where there is an axis, contacts that may
    be of either kind say how far it climbs in a turn.  Where flat contacts let a motion go one
    way only, or another one, a linear program finds it.
    """
    blocks = np.zeros((int(bent.sum()), 3, 6))
    blocks[:, :, :3] = np.eye(3)
    blocks[:, :, 3:] = np.cross(np.eye(3), arms[bent, None]).transpose(0, 2, 1)
    velocity = blocks.reshape(-1, 6)
    speeds = velocity.T @ velocity
    speeds += 1e-9 * np.trace(speeds) * np.eye(6)
    values, vectors = eigh(rows[bent].T @ rows[bent], speeds)
    # Their root mean square speed at the contacts is 1.
    free = vectors[:, values <= _SLIP**2] * np.sqrt(bent.sum())
    if not free.size:
        return
    shares = np.linalg.pinv(free[3:])
    about = [free @ shares[:, k] for k in range(3)]
    straight = [x for k, x in enumerate(about) if np.abs(x[3:] - np.eye(3)[k]).max() < _ALONG]
    flat = rows[hard]
    for x in chain(straight, free.T, _climbing(free, rows[~bent & ~hard])):
        speed = np.linalg.norm(x[:3] + np.cross(x[3:], arms[hard]), axis=1)
        yield from (way for way in (x, -x) if (flat @ way >= -_CLOSING * speed).all())
    for goal in chain(free[3:], -free[3:], free[:3], -free[:3]):
        found = farthest(goal, csr_array(flat @ free), _SLIP, 1.0)
        if found is not None and goal @ found.x > _FREE * np.abs(goal).sum():
            yield np.asarray(free @ found.x)


def _climbing(free: Floats, flat: Floats) -> Iterator[Floats]:
    """Turns about an axis that climb along it as most of some contacts do."""
    if free.shape[1] != 2:
        return
    turns, mix = np.linalg.svd(free[3:])[1:]
    if turns[1] > _ALONG * turns[0]:
        return
    turn, shift = free @ mix[0], free @ mix[1]
    lead = flat @ shift
    leads = np.abs(lead) > _FREE * np.linalg.norm(shift)
    climbs = -(flat[leads] @ turn) / lead[leads]
    bins, count = np.unique((climbs / _CLIMB).round(), return_counts=True)
    for place in bins[np.argsort(-count, kind="stable")[:_CLIMBS]]:
        here = np.abs(climbs / _CLIMB - place) <= 1
        yield np.asarray(turn + np.median(climbs[here]) * shift)


def _motion(
    meshes: Sequence[Mesh],
    body: Sequence[int],
    about: Floats,
    velocity: tuple[Floats, Floats],
    *,
    slides: bool,
) -> Motion:
    """The motion of a body by its parts."""
    t, w = velocity
    arms = np.array([middle(meshes[n][0]) for n in body]) - about
    sizes = np.array([np.linalg.norm(np.ptp(meshes[n][0], axis=0)) / 2 for n in body])
    translations, rotations = t + np.cross(w, arms), np.tile(w, (len(body), 1))
    largest = max(np.abs(translations).max(), np.abs(rotations * sizes[:, None]).max())
    return Motion(
        tuple(body), translations / largest, rotations / largest, slides=slides, rounded=True
    )
