"""Kits of one regular joint: hexagonal and square frames, which have rows and columns."""

from __future__ import annotations

import math
from dataclasses import replace

from scadgen.element.ends import connector, connector_end, flat_end, key_end, part, peg
from scadgen.element.pieces import half
from scadgen.frame.layout import LAYOUTS, joint
from scadgen.joint.weave import Weave
from scadgen.kit.model import Joint, Kit
from scadgen.kit.pieces import Pieces, best_pieces
from scadgen.kit.ranges import check_values, ranges
from scadgen.kit.request import Request, default_values
from scadgen.kit.wanted import Wanted, wanted_pieces
from scadgen.solid.affine import AffineSolid
from scadgen.work.each import Means

__all__ = ["build_grid", "build_joint"]


def build_grid(request: Request, means: Means) -> Kit:
    """Make a kit of a hexagonal or square frame.

    Parameters
    ----------
    request
        What kit to make.
    means
        Where its joint is kept.

    Raises
    ------
    InputError
        A live parameter outside its range.
    GeometryError
        The weave makes no sound pieces.
    """
    directions = tuple(_even(request.valence))
    wanted = Wanted(
        directions, request.chosen_weave, request.key, request.detail, bored=request.bored
    )
    (pieces,) = wanted_pieces([wanted], means)
    return _kit(pieces, request)


def build_joint(valence: int, weave: Weave, key: str, detail: str) -> Kit:
    """Make the kit of a single regular joint.

    Its frame is called ``joint`` and has no layout: such a kit is there to be judged.

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
    request = Request("hexagonal", key, 1, 1, detail, weave)
    pieces = best_pieces(_even(valence), weave, key, detail, bored=False)
    return replace(_kit(pieces, request), frame="joint", rows=0, columns=0, placements=())


def _kit(pieces: Pieces, request: Request) -> Kit:
    """All of a kit, from its pieces."""
    limits = ranges(pieces.key, pieces.clearance_limit, pieces.key_hole)
    values = default_values(request, [pieces], limits)
    check_values(limits, values)
    count = len(pieces.connectors)
    kind = Joint(
        name="",
        turns=tuple(360.0 * n / count for n in range(count)),
        keys=(0,),
        caps=(),
        connectors=("connector",) * count,
        over=(),
        weave=request.chosen_weave.as_dict(),
        pieces=joint(count, request.key),
        figures=pieces.figures(),
    )
    return Kit(
        frame=request.frame,
        key=request.key,
        rows=request.rows,
        columns=request.columns,
        detail=request.detail,
        command=request.command,
        values=values,
        ranges=limits,
        parts=_parts(pieces),
        joints=(kind,),
        placements=LAYOUTS[request.frame](request.rows, request.columns, request.key),
    )


def _parts(pieces: Pieces) -> dict[str, AffineSolid]:
    """Every printed part."""
    key = pieces.key
    joined, keyed = connector_end(key, pieces.connectors[0]), key_end(key)
    flat = flat_end(key, {"side": key.tube_start, "clearance": 1.0})
    length = {"edge_length": 1.0}
    solids = (
        part("basic", joined, joined, length),
        part("one_sided", joined, keyed, length),
        part("two_sided", keyed, keyed, length),
        connector(key, pieces.connectors[0]),
        half(key, pieces.halves[0][0]),
        peg(key),
        part("tube", flat, flat, length),
    )
    return {solid.name: solid for solid in solids}


def _even(valence: int) -> list[float]:
    """Directions that divide the circle evenly."""
    return [2 * math.pi * n / valence for n in range(valence)]
