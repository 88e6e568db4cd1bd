"""From a request to a kit: one way for all frames."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from scadgen.errors import InputError, InvariantError
from scadgen.frame.kinds import Kind, Kinds
from scadgen.frame.template import Template
from scadgen.joint.symmetry import Symmetry
from scadgen.joint.weave import Weave
from scadgen.kit.arrangement import Arrangement
from scadgen.kit.compute import JointSpec, compute_joints
from scadgen.kit.model import Kit, Vertex
from scadgen.kit.pieces import Pieces, best_pieces
from scadgen.kit.ranges import LONGEST, TUBE, check_values
from scadgen.kit.repeat import cells_of
from scadgen.kit.request import Request, default_values
from scadgen.kit.room import room
from scadgen.kit.sizing import WIDER, Design, design
from scadgen.kit.solids import Solids
from scadgen.plane.drawn import make_frame
from scadgen.plane.spacing import Spacing
from scadgen.solid.affine import Linear, Range
from scadgen.work.mapping import Execution

__all__ = ["Request", "build", "build_joint", "laid_out"]

#: Decimals of a length, in edge lengths.
_DECIMALS = 9


def build(
    request: Request,
    means: Execution | None = None,
    done: Callable[[int, int], None] = lambda *_: None,
) -> Kit:
    """Make a kit.

    Parameters
    ----------
    request
        What kit to make.
    means
        Who computes its joints, and where they are kept; by default this process alone, and
        nowhere.
    done
        Told how many of how many joints are computed, after each.

    Raises
    ------
    InputError
        A live parameter outside its range, or edges that no ring can hold.
    GeometryError
        A weave makes no sound pieces, or the frame cannot be built: says where.
    """
    made = design(request)
    in_range = made.block is not None  # of a tiling an edge length that is given is looked at
    if not in_range or "edge_length" not in request.values:
        made.check_longest(request.side)
    if not in_range:
        made.check_room(request)
    wanted = [_wanted(request, made, number) for number in range(len(made.weaves))]
    pieces = compute_joints(wanted, means or Execution(), lambda count: done(count, len(wanted)))
    lengths = (made.same.lengths / made.unit).round(_DECIMALS)
    solids = Solids(made.kinds, made.frame.edges, lengths, pieces, request.regular)
    limits = (*solids.limits(), *_apart(made, pieces))
    values = default_values(request, pieces, limits)
    values["edge_length"] = made.unit
    check_values([limit for limit in limits if limit.parameter != "edge_length"], values)
    if not in_range:
        _check_room(request, made, pieces, values)
    check_values(limits, values)
    places = Arrangement(solids, made.frame.plan / made.unit)
    kit = Kit(
        name=request.name,
        key=request.key,
        detail=request.detail,
        command=request.command,
        values=values,
        ranges=limits,
        parts=solids.parts(),
        joints=tuple(places.joint(n) for n in range(len(pieces))),
        frame=made.frame,
        vertices=places.vertices,
        placements=(),
        rim=request.rim,
        refused=request.refused,
    )
    if made.block is None:
        return replace(kit, placements=places.placements())
    cells = cells_of(places, made.block, made.unit)
    if cells is not None:
        return laid_out(
            replace(kit, tiling=request.tiling, cells=cells), request.rows, request.columns
        )
    # Some cells are unlike others, so that rows and columns are as they are.
    frame = made.block.tiling.block(request.rows, request.columns).frame
    return build(replace(request, frame=frame, tiling=None), means, done)


def laid_out(kit: Kit, rows: int, columns: int) -> Kit:
    """The kit with another number of cells, if it has some.

    Raises
    ------
    InputError
        It has none, or a number is not from 1 to `MOST_CELLS`.
    """
    if kit.cells is None or kit.tiling is None:
        msg = f"{kit.name}: this kit's frame has no rows and columns to set"
        raise InputError(msg)
    laid = kit.cells.laid(rows, columns)
    frame = make_frame(kit.tiling.name, laid.at[:, :2] * kit.values["edge_length"], laid.edges)
    if not np.array_equal(frame.edges, laid.edges):
        msg = "vertices are in the same order in edge lengths and in mm"
        raise InvariantError(msg)
    return replace(
        kit,
        frame=frame,
        vertices=tuple(Vertex(*one) for one in laid.vertices),
        placements=laid.placements,
        rows=rows,
        columns=columns,
    )


def build_joint(valence: int, weave: Weave, key: str, detail: str) -> Kit:
    """Make the kit of a single regular joint.

    It has no frame: such a kit is there to be judged.

    Parameters
    ----------
    valence
        Number of edges, at least 2.
    weave, key, detail
        As for `Request`.

    Raises
    ------
    GeometryError
        The weave makes no sound pieces.
    """
    directions = 2 * np.pi * np.arange(valence) / valence
    shape = Template.level(directions, Symmetry(valence, 1, 0))
    none, no_edges = np.zeros(0), np.zeros((0, 2), dtype=np.int64)
    no_kind = none.astype(np.int64)
    kinds = Kinds((shape,), (Kind(0, (0,), ()),), no_kind, none > 0, none, no_edges)
    pieces = best_pieces(directions.tolist(), weave, key, detail, bored=False)
    solids = Solids(kinds, no_edges, none, (pieces,), regular=True)
    limits = solids.limits()
    request = Request("joint", key=key, detail=detail, weave=weave, regular=True)
    values = default_values(request, [pieces], limits)
    least = max(r.low(values) for r in limits if r.parameter == "edge_length")
    values["edge_length"] = max(6, math.ceil(least / request.side + 1)) * request.side
    check_values(limits, values)
    joint = Arrangement(solids, np.zeros((0, 2))).joint(0)
    return Kit("joint", key, detail, "", values, limits, solids.parts(), (joint,), None, (), ())


def _wanted(request: Request, made: Design, number: int) -> JointSpec:
    """The joint whose pieces all joints of one kind have."""
    return JointSpec(
        tuple(made.kinds.shape(number).directions.tolist()),
        made.weaves[number],
        request.key,
        request.detail,
        made.kinds.kinds[number].keys,
        request.bored,
        (0.0,) if request.regular else WIDER,
        "" if request.regular else made.where(number),
    )


def _apart(made: Design, pieces: tuple[Pieces, ...]) -> Iterator[Range]:
    """Of the edge length, so that joints keep apart from others and from tubes that pass by."""
    rings = np.array([one.weave.ring_ratio for one in pieces])[made.kinds.kind_of]
    # With a larger side the shortest edges are too short for their own joints.
    widest = made.unit / (2 * min(one.key.pad for one in pieces) + TUBE)
    side = Spacing(made.frame, rings).largest_side(widest)
    if side < widest:
        low, high = Linear({"side": made.unit / side}), Linear({}, LONGEST)
        yield Range("edge_length", low, high, "joints and tubes that pass by must keep apart")


def _check_room(
    request: Request, made: Design, pieces: tuple[Pieces, ...], values: Mapping[str, float]
) -> None:
    """Refuse edges that are too short for rings that have become wider."""
    reach = [(one.key.tube_start, one.key.pad) for one in pieces]
    rings = np.array([one.weave.ring_ratio for one in pieces])
    fixed = request.key == "fixed"
    needs = room(made.frame, made.kinds, np.array(reach), rings, values, fixed=fixed)
    needs.check(request.side)
