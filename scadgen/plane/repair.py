"""From segments as people draw them to a frame; everything that is changed is told."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.frame.numbering import BY_PLACE, where
from scadgen.frame.words import more
from scadgen.plane.drawn import LARGEST, make_frame
from scadgen.plane.planarity import COUNTED, TOUCH, crossings, touches
from scadgen.solid.affine import Floats, Ints

__all__ = ["MOST_SEGMENTS", "REPAIRS", "TOLERANCE", "Repaired", "repair"]

#: Segments and their pieces: at most this many, unless the caller says otherwise.
MOST_SEGMENTS = 100_000

#: Ends nearer than this are one, in mm, unless the caller says otherwise: what printing
#: does not resolve.
TOLERANCE = 0.01

#: Ends that are merged lie within this many tolerances of each other; more is a curve of tiny
#: segments, or a tolerance that is too coarse.
_SPREAD = 5

#: Pairs of ends that share a square whose diagonal is the tolerance: at most this many.  All that
#: are near enough to be merged are some twenty times as many, which still fit into the memory.
_CROWDED = 1_000_000

#: Merging and splitting settle in a few rounds; what takes more goes in circles.
_ROUNDS = 40

#: Places shown of repairs of one kind.
_SHOWN = 3

#: What is repaired, in the order in which it is counted.
REPAIRS: Mapping[str, str] = MappingProxyType(
    {
        "dropped": "segments without length dropped",
        "merged": "groups of ends merged",
        "duplicates": "duplicate segments dropped",
        "joined": "ends joined to a segment they lie on",
        "crossings": "crossings split",
        "overlaps": "overlapping pieces dropped",
    }
)


@dataclass(frozen=True, slots=True, eq=False)
class Repaired:
    """A frame, and what was done to get it.

    Parameters
    ----------
    frame
        The frame.
    counts
        How many repairs of each kind, by the keys of `REPAIRS`.
    notes
        A line for each kind of repair, with some of its places.
    places
        ``(p, 2) float``: all of them, in mm.
    """

    frame: Frame
    counts: Mapping[str, int]
    notes: tuple[str, ...]
    places: Floats


@dataclass(slots=True)
class _Work:
    """Points and segments between them, and what has been done so far."""

    points: Floats
    pairs: Ints
    tolerance: float
    most: int
    done: dict[str, list[tuple[Floats, str]]] = field(default_factory=dict)
    #: How far the ends were off that were joined to segments, in mm.
    off: float = 0.0

    def note(self, kind: str, repairs: Iterable[tuple[Floats, str]]) -> None:
        """Keep where something was repaired, and what is said of it if it is the only one."""
        self.done.setdefault(kind, []).extend(repairs)

    def notes(self) -> Iterator[str]:
        for kind, repairs in self.done.items():
            if len(repairs) == 1:
                yield repairs[0][1]
            elif repairs:
                at = ", ".join(where(place) for place, _ in repairs[:_SHOWN])
                rest = f" and {len(repairs) - _SHOWN} more" if len(repairs) > _SHOWN else ""
                off = f", up to {self.off:.2g} mm off" if kind == "joined" else ""
                yield f"{len(repairs)} {REPAIRS[kind]}{off}: at {at}{rest}"

    def places(self) -> Floats:
        found = [place for repairs in self.done.values() for place, _ in repairs]
        return np.array(found, dtype=float).reshape(-1, 2)

    def middle(self, pair: Ints) -> Floats:
        return np.asarray(self.points[pair].mean(axis=0))

    def segment(self, pair: Ints) -> str:
        return f"{where(self.points[pair[0]])} to {where(self.points[pair[1]])}"


def repair(
    name: str,
    segments: ArrayLike,
    tolerance: float = TOLERANCE,
    *,
    split: bool = True,
    most: int = MOST_SEGMENTS,
) -> Repaired:
    """Make a frame of segments; a frame's own segments come back as they are.

    Of ends nearer to each other than the tolerance, the place where most of them are stays.
    An end that lies on another segment always splits it.

    Parameters
    ----------
    name
        The frame's name.
    segments
        ``(k, 2, 2) float``: the two ends of each, in mm.
    tolerance
        How near is the same place, in mm; at least 1e-6.
    split
        Whether two segments that cross get a vertex there; if not, they are refused.
    most
        Segments, and pieces of them, at most.

    Raises
    ------
    InputError
        Segments of another shape, none, too many or not finite; ends that hang together over
        a distance; crossings where they are not to be split.
    """
    work = _begin(segments, tolerance, most)
    for turn in range(_ROUNDS):
        _merge(work)
        _drop(work, "duplicates" if turn == 0 else "overlaps")
        if not len(work.pairs):
            msg = f"nothing is longer than the tolerance of {tolerance:g} mm"
            raise InputError(msg)
        if not (_join(work) or _cross(work, split=split)):
            used, numbers = np.unique(work.pairs, return_inverse=True)
            frame = make_frame(name, work.points[used], numbers.reshape(-1, 2), BY_PLACE)
            counts = {kind: len(work.done.get(kind, ())) for kind in REPAIRS}
            notes = tuple(work.notes())
            return Repaired(frame, MappingProxyType(counts), notes, work.places())
    msg = f"repairs with a tolerance of {tolerance:g} mm do not settle; try a smaller one"
    raise InputError(msg)


def _begin(segments: ArrayLike, tolerance: float, most: int) -> _Work:
    given = np.asarray(segments, dtype=float)
    if given.ndim != 3 or given.shape[1:] != (2, 2) or not len(given):
        msg = f"segments of shape {given.shape}: must be (k, 2, 2), at least one"
        raise InputError(msg)
    _check_count(len(given), most)
    if not TOUCH <= tolerance < LARGEST:
        msg = f"tolerance = {tolerance!r}: must be at least {TOUCH:g} mm"
        raise InputError(msg)
    bad = np.flatnonzero(~(np.abs(given) <= LARGEST).all(axis=(1, 2)))
    if len(bad):
        ends = f"{where(given[bad[0], 0])} to {where(given[bad[0], 1])}"
        msg = f"segment {bad[0]}, {ends}: must be within {LARGEST:g} mm of 0"
        raise InputError(msg)
    points = given.reshape(-1, 2).round(9) + 0.0
    return _Work(points, np.arange(2 * len(given)).reshape(-1, 2), tolerance, most)


def _merge(work: _Work) -> None:
    """Let ends nearer than the tolerance be one, until none are."""
    while True:
        points, number, counts = np.unique(
            work.points[work.pairs.ravel()], axis=0, return_inverse=True, return_counts=True
        )
        _check_crowd(points, work.tolerance)
        near = cKDTree(points).query_pairs(work.tolerance, output_type="ndarray")
        work.points, work.pairs = points, number.reshape(-1, 2)
        if not len(near):
            return
        size = len(points)
        graph = coo_array((np.ones(len(near)), near.T), shape=(size, size))
        group = connected_components(graph, directed=False)[1].astype(np.int64)
        # Of each group: the point with most ends, of equals the first.
        order = np.lexsort((np.arange(size), -counts, group))
        stays = order[np.unique(group[order], return_index=True)[1]][group]
        _check_spread(work, group, stays)
        # Places that differ by rounding only are no repair.
        moved = np.linalg.norm(points - points[stays], axis=1) > TOUCH
        crowd = np.bincount(stays, moved, size).astype(np.int64)
        work.note(
            "merged",
            (
                (
                    points[k],
                    (
                        f"{crowd[k] + 1} places within {work.tolerance:g} mm merged at "
                        f"{where(points[k])}"
                    ),
                )
                for k in np.flatnonzero(crowd)
            ),
        )
        work.pairs = stays[work.pairs]


def _check_crowd(points: Floats, tolerance: float) -> None:
    """Refuse so many points near each other that their pairs would fill the memory."""
    cells = np.floor(points / (tolerance / np.sqrt(2)))
    _, first, counts = np.unique(cells, axis=0, return_index=True, return_counts=True)
    if (counts * (counts - 1) // 2).sum() > _CROWDED:
        worst = int(counts.argmax())
        msg = (
            f"{counts[worst]} places near {where(points[first[worst]])} are within the tolerance "
            f"of {tolerance:g} mm of each other; try a smaller one"
        )
        raise InputError(msg)


def _check_spread(work: _Work, group: Ints, stays: Ints) -> None:
    moved = np.linalg.norm(work.points - work.points[stays], axis=1)
    worst = int(moved.argmax())
    if moved[worst] > _SPREAD * work.tolerance:
        count = np.count_nonzero(group == group[worst])
        msg = (
            f"{count} places near {where(work.points[worst])} hang together over "
            f"{moved[worst]:.4g} mm with a tolerance of {work.tolerance:g} mm; try a smaller one"
        )
        raise InputError(msg)


def _drop(work: _Work, again: str) -> None:
    """Leave out segments without length and those that are there already."""
    flat = work.pairs[:, 0] == work.pairs[:, 1]
    work.note(
        "dropped",
        (
            (work.points[k], f"segment without length dropped at {where(work.points[k])}")
            for k in work.pairs[flat, 0]
        ),
    )
    pairs = np.sort(work.pairs[~flat], axis=1)
    work.pairs, counts = np.unique(pairs, axis=0, return_counts=True)
    work.note(
        again,
        (
            (work.middle(pair), f"segment {work.segment(pair)} was there {count} times")
            for pair, count in zip(work.pairs, counts, strict=True)
            for _ in range(count - 1)
        ),
    )


def _join(work: _Work) -> bool:
    """Split segments at ends that lie on them; whether there were any."""
    room = work.most - len(work.pairs)
    on = touches(work.points, work.pairs, work.tolerance, room)
    if not len(on):
        return False
    if len(on) > room:
        _refuse_pieces(work, "where ends lie on them")
    point, segment = on.T
    start, end = work.points[work.pairs[segment]].transpose(1, 0, 2)
    along = end - start
    to = work.points[point] - start
    share = (to * along).sum(axis=1) / (along**2).sum(axis=1)
    off = np.linalg.norm(to - share[:, None] * along, axis=1)
    work.off = max(work.off, float(off.max()))
    work.note(
        "joined",
        (
            (
                work.points[p],
                (
                    f"end at {where(work.points[p])} joined to segment "
                    f"{work.segment(work.pairs[s])}, {d:.2g} mm off"
                ),
            )
            for p, s, d in zip(point, segment, off, strict=True)
        ),
    )
    _split(work, segment, point, share)
    return True


def _cross(work: _Work, *, split: bool) -> bool:
    """Split segments where they cross; whether there were any."""
    # Each crossing makes two pieces more.
    room = (work.most - len(work.pairs)) // 2 if split else COUNTED
    pairs = crossings(work.points, work.pairs, room)
    if not len(pairs):
        return False
    if split and len(pairs) > room:
        _refuse_pieces(work, "where they cross")
    (a, b), (c, d) = (work.points[work.pairs[side]].transpose(1, 0, 2) for side in pairs.T)
    turn = _cross_product(b - a, d - c)
    shares = np.stack([_cross_product(c - a, d - c), _cross_product(c - a, b - a)]) / turn
    at = (a + shares[0][:, None] * (b - a)).round(9) + 0.0
    if not split:
        place = where(at[0]) + more(len(at), COUNTED)
        msg = f"segments cross at {place}; they must not cross, or be split there (no --no-split)"
        raise InputError(msg)
    work.note("crossings", ((point, f"crossing split at {where(point)}") for point in at))
    new = np.arange(len(work.points), len(work.points) + len(at))
    work.points = np.concatenate([work.points, at])
    _split(work, pairs.T.ravel(), np.tile(new, 2), shares.ravel())
    return True


def _split(work: _Work, segment: Ints, point: Ints, share: Floats) -> None:
    """Cut segments at points that lie at these shares of their lengths."""
    count = len(work.pairs)
    number = np.arange(count)
    segment = np.concatenate([number, segment, number])
    point = np.concatenate([work.pairs[:, 0], point, work.pairs[:, 1]])
    share = np.concatenate([np.full(count, -np.inf), share, np.full(count, np.inf)])
    order = np.lexsort((point, share, segment))
    segment, point = segment[order], point[order]
    same = segment[1:] == segment[:-1]
    work.pairs = np.stack([point[:-1][same], point[1:][same]], axis=1)


def _cross_product(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _refuse_pieces(work: _Work, place: str) -> NoReturn:
    msg = (
        f"more than {work.most} segments once {len(work.pairs)} are split {place}, unless more "
        "are allowed (--most)"
    )
    raise InputError(msg)


def _check_count(count: int, most: int) -> None:
    if count > most:
        msg = f"{count} segments: at most {most}, unless more are allowed (--most)"
        raise InputError(msg)
