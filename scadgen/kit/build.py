"""From a request to a kit."""

from __future__ import annotations

from scadgen.kit.any_frame import build_frame
from scadgen.kit.grid import build_grid, build_joint
from scadgen.kit.model import Kit
from scadgen.kit.request import VALENCE, Request

__all__ = ["VALENCE", "Request", "build", "build_joint"]


def build(request: Request) -> Kit:
    """Make a kit.

    Raises
    ------
    InputError
        A live parameter outside its range.
    GeometryError
        A weave makes no sound pieces, or the frame cannot be built: says where.
    """
    return build_grid(request) if request.graph is None else build_frame(request)
