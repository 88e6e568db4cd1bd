"""Real kits and joints, each made once a run, and random settings inside their ranges."""

import math

import numpy as np
from shared import once

from scadgen.check.proof import proved
from scadgen.element.pieces import Piece, add_surface
from scadgen.emit.scad import scad
from scadgen.joint.joint import DETAILS, make_joint
from scadgen.joint.spokes import Spokes
from scadgen.joint.weave import BUILT_IN
from scadgen.kit.build import Request, build
from scadgen.kit.live import PARAMETERS
from scadgen.kit.store import dumps
from scadgen.plane.catalogue import NAMES, NamedTiling
from scadgen.plane.drawn import make_frame
from scadgen.solid.shell import Shell

#: Every kind of kit: frame, key, bore in mm.
KINDS = [
    (frame, key, bore)
    for frame in ("hexagonal", "square")
    for key in ("fixed", "loose")
    for bore in (0.0, 1.5)
]

#: Edges at each vertex of the regular frames.
VALENCE = {"hexagonal": 3, "square": 4}

#: The built-in weave of each frame.
WEAVES = {frame: BUILT_IN[f"{count}-fixed"] for frame, count in VALENCE.items()}


def named(kind):
    """Name of a kind of kit, for pytest."""
    frame, key, bore = kind
    return f"{frame}-{key}-{'bored' if bore else 'solid'}"


def grid(frame, key="fixed", **more):
    """The request for a kit of regular joints in rows and columns."""
    return Request.tiled(NamedTiling(frame), key=key, **more)


def drawn(name, frame, **more):
    """The request for a kit of a frame that is as it is."""
    return Request(name, frame=frame, **{"detail": "draft"} | more)


def kit(frame, key="fixed", bore=0.0, detail="draft"):
    """A kit, not proved."""
    request = grid(frame, key, detail=detail, values={"bore": bore} if bore else {})
    return once(f"kit-{frame}-{key}-{bore}-{detail}", lambda _: build(request))


def tiled(name):
    """The kit of a named tiling, of one cell; not proved."""
    request = grid(name, "loose", detail="draft", regular=NAMES[name].regular, rows=1, columns=1)
    return once(f"kit-tiled-{name}", lambda _: build(request))


def tee():
    """The kit of a frame without rows and columns to set, of three edges; not proved."""
    ends = [(0, 0), (-150, 0), (150, 0), (0, 150)]
    graph = make_frame("tee", ends, [(0, 1), (0, 2), (0, 3)])
    return once("kit-tee", lambda _: build(drawn("tee", graph)))


def proved_kit(frame):
    """A kit with all that is proved of it."""
    return once(f"proved-{frame}", lambda _: proved(kit(frame)))


def written(kind, detail="draft"):
    """A folder with a kit and its OpenSCAD file, for reading alone."""

    def write(place):
        made = kit(*kind, detail)
        (place / "kit.json").write_text(dumps(made), encoding="utf-8")
        (place / f"{made.name}.scad").write_text(scad(made), encoding="utf-8")
        return place

    return once(f"written-{named(kind)}-{detail}", write)


def joint(frame, detail="draft"):
    """The joint of a frame's solid kit with a fixed key, on the kit's lattice."""
    extra = int(kit(frame, detail=detail).joints[0].figures["lattice_extra"])
    edges, weave = Spokes.flat(regular(VALENCE[frame])), WEAVES[frame]
    return once(
        f"joint-{frame}-{detail}", lambda _: make_joint(edges, weave, DETAILS[detail], extra)
    )


def regular(count):
    """Directions of a regular joint's edges."""
    return [2 * math.pi * n / count for n in range(count)]


def mesh(surface):
    """Points and triangles of a joint's surface, in sides."""
    shell = Shell()
    add_surface(shell, Piece(surface, np.zeros_like(surface.points), 0.0), ())
    return surface.points, shell.solid("piece").triangles


def bounds(kit, name, values):
    """Lowest and highest value of a live parameter, given the others."""
    limits = [r for r in kit.ranges if r.parameter == name]
    return max(r.low(values) for r in limits), min(r.high(values) for r in limits)


def inside(kit, shares):
    """Settings inside all ranges: each parameter a share of the way between its bounds.

    A parameter is chosen before those whose bounds depend on it.  None where the ones
    before leave it no room.
    """
    values = {}
    order = ("side", "clearance", "peg_clearance", "peg_width", "bore", "peg_chamfer")
    for name in [n for n in (*order, "peg_length", "edge_length") if n in kit.values]:
        low, high = bounds(kit, name, {**kit.values, **values})
        if low > high:
            return None
        # Rounding must not take the sum past the end.
        values[name] = min(low + shares[PARAMETERS.index(name)] * (high - low), high)
    return {name: values[name] for name in kit.values}


def random_inside(kit, seed):
    """Random settings inside all ranges, the same for the same seed."""
    rng = np.random.default_rng(seed)
    while True:
        values = inside(kit, rng.random(len(PARAMETERS)).tolist())
        if values:
            return {name: round(value, 6) for name, value in values.items()}
