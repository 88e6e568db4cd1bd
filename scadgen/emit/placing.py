"""Where each piece of a frame goes: the frame as SVG, its elements and joints by name."""

from __future__ import annotations

import math

import numpy as np

from scadgen.emit.picture import COLOURS
from scadgen.emit.templates import UNCHECKED
from scadgen.frame.placement import Placement
from scadgen.kit.model import Kit
from scadgen.solid.affine import Floats

__all__ = ["placing"]

_XML = "http://www.w3.org/2000/svg"

#: Length of the edge length, and width of the margin, in pixels.
_EDGE, _MARGIN = 120.0, 50.0

#: Radius of a joint, width of a tube, side of a key's mark, and size of the text, in pixels.
_JOINT, _TUBE, _KEY, _TEXT = 14.0, 9.0, 10.0, 12.0


def placing(kit: Kit) -> str:
    """Draw where each piece goes.

    Parameters
    ----------
    kit
        The kit.

    Returns
    -------
    text
        SVG: elements have their names and joints their letters, dark squares stand where a peg
        goes in, and short stubs are loose connectors, named by joint and number.  What lies
        the other way up has a star; a joint has one if its halves do.
    """
    points = np.array([p.at for p in kit.placements]) * (_EDGE, -_EDGE)
    corner = points.min(axis=0) - _MARGIN
    width, height = points.max(axis=0) + _MARGIN - corner
    names = set(kit.elements)
    letters = {piece.part: one.name for one in kit.joints for piece in one.pieces}
    layers: list[list[str]] = [[], [], [], []]
    for placement, point in zip(kit.placements, points - corner, strict=True):
        if placement.part in names:
            end = point + _ahead(placement, _EDGE * _times(kit, placement.part))
            layers[0].append(_line(point, end, placement.role))
            layers[3].append(_text((point + end) / 2, placement.marked(placement.part)))
        elif placement.role == "cap":
            layers[0].append(_line(point, point + _ahead(placement, 2 * _JOINT), "cap"))
            which = placement.part.partition("_")[2]
            layers[3].append(
                _text(point + _ahead(placement, 2.6 * _JOINT), placement.marked(which))
            )
        elif placement.role == "half_a":
            x, y = point
            fill = _colour("half_b")
            layers[1].append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{_JOINT}" fill="{fill}"/>')
            layers[2].append(_words(point, placement.marked(letters[placement.part])))
        elif placement.role == "peg":
            x, y = point + _ahead(placement, 1.4 * _JOINT) - _KEY / 2
            square = f'<rect x="{x:.1f}" y="{y:.1f}" width="{_KEY}" height="{_KEY}"'
            layers[2].append(f'{square} fill="{_colour("peg")}"/>')
    drawn = "\n".join(shape for layer in layers for shape in dict.fromkeys(layer))
    size = f'width="{width:.0f}" height="{height:.0f}"'
    said = "" if kit.proved else f"<!-- {UNCHECKED} -->\n"
    return (
        f'<svg xmlns="{_XML}" {size} viewBox="0 0 {width:.0f} {height:.0f}" '
        f'font-family="sans-serif" font-size="{_TEXT:g}" text-anchor="middle">\n'
        f'{said}<rect {size} fill="white"/>\n{drawn}\n</svg>\n'
    )


def _times(kit: Kit, name: str) -> float:
    """Length of an element, in edge lengths."""
    return float(kit.parts[name].coefficients["edge_length"][:, 0].max())


def _ahead(placement: Placement, length: float) -> Floats:
    turn = math.radians(placement.turn)
    return length * np.array([math.cos(turn), -math.sin(turn)])


def _line(start: Floats, end: Floats, role: str) -> str:
    (a, b), (c, d) = start, end
    return (
        f'<path d="M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" stroke="{_colour(role)}" '
        f'stroke-width="{_TUBE}"/>'
    )


def _text(middle: Floats, name: str) -> str:
    """A name on a light ground, so that it is read on any tube."""
    x, y = middle
    box = 0.58 * _TEXT * len(name), 1.3 * _TEXT
    return (
        f'<rect x="{x - box[0] / 2:.1f}" y="{y - box[1] / 2:.1f}" width="{box[0]:.1f}" '
        f'height="{box[1]:.1f}" rx="3" fill="white"/>{_words(middle, name)}'
    )


def _words(middle: Floats, words: str) -> str:
    x, y = middle
    return f'<text x="{x:.1f}" y="{y + 0.35 * _TEXT:.1f}">{words}</text>' if words else ""


def _colour(role: str) -> str:
    return "#{:02x}{:02x}{:02x}".format(*COLOURS[role])
