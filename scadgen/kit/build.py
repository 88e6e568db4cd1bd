"""From a request to a kit."""

from __future__ import annotations

from collections.abc import Callable

from scadgen.kit.any_frame import build_frame
from scadgen.kit.grid import build_grid, build_joint
from scadgen.kit.model import Kit
from scadgen.kit.request import VALENCE, Request
from scadgen.work.each import Means

__all__ = ["VALENCE", "Request", "build", "build_joint"]


def build(
    request: Request,
    means: Means | None = None,
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
        A live parameter outside its range.
    GeometryError
        A weave makes no sound pieces, or the frame cannot be built: says where.
    """
    means = means or Means()
    if request.graph is None:
        return build_grid(request, means)
    return build_frame(request, means, done)
