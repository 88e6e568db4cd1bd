"""Where each piece of a frame goes: the frame as SVG, its elements and joints by name."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial

import numpy as np

from scadgen.emit.templates import UNCHECKED
from scadgen.frame.placement import Placement
from scadgen.kit.model import Kit
from scadgen.kit.roles import COLOURS
from scadgen.solid.affine import Floats

__all__ = ["placing"]

_XML = "http://www.w3.org/2000/svg"

#: Length of the edge length, and width of the margin, in pixels.
_EDGE, _MARGIN = 120.0, 50.0

#: Radius of a joint, width of a tube, side of a key's mark, and size of the text, in pixels.
_JOINT, _TUBE, _KEY, _TEXT = 14.0, 9.0, 10.0, 12.0

#: Where marks of an element's ends are, in radii of a joint, and radius of a near end's, in pixels.
_BESIDE, _DOT = 1.4, 3.0

#: Size of the letter below a joint's number, and height of a line of the legend, in pixels.
_LETTER, _LEGEND = 9.0, 32.0

#: Least width of the picture, for the legend, in pixels.
_WIDE = 430.0


def placing(kit: Kit) -> str:
    """Draw where each piece goes.

    Parameters
    ----------
    kit
        The kit.

    Returns
    -------
    text
        SVG: elements have their names and joints their numbers and letters, dark squares stand
        where a peg goes in, and short stubs are loose connectors, by the end of their names.
        A white dot is on the near end of each element whose ends differ.
        What lies the other way up has a star; a joint has one if its halves do.  A legend says so.
    """
    points = np.array([p.pose.at[:2] for p in kit.placements]) * (_EDGE, -_EDGE)
    corner = points.min(axis=0) - _MARGIN
    width, height = points.max(axis=0) + _MARGIN - corner
    width = max(width, _WIDE)
    dotted = {name for name, part in kit.parts.items() if part.fits_one_way}
    layers: list[list[str]] = [[], [], [], [], []]
    for placement, point in zip(kit.placements, points - corner, strict=True):
        if placement.is_element:
            end = point + _ahead(placement, _EDGE * kit.parts[placement.part].length)
            layers[0].append(_line(point, end, placement.role))
            layers[4].append(_text((point + end) / 2, placement.marked(placement.part)))
            if placement.part in dotted:
                layers[3].append(_dot(point + _ahead(placement, _BESIDE * _JOINT)))
        elif placement.role == "cap":
            layers[0].append(_line(point, point + _ahead(placement, 2 * _JOINT), "cap"))
            which = placement.part.partition("_")[2]
            layers[4].append(
                _text(point + _ahead(placement, 2.6 * _JOINT), placement.marked(which))
            )
        elif placement.role == "half_a":
            letter = placement.marked(kit.vertices[placement.vertex].joint)
            layers[1].append(_joint(point, str(placement.vertex + 1), letter))
        elif placement.role == "peg":
            layers[2].append(_peg(point + _ahead(placement, _BESIDE * _JOINT)))
    legend = _legend(kit, dotted, height)
    height += _LEGEND * len(legend)
    layers.append(legend)
    drawn = "\n".join(shape for layer in layers for shape in dict.fromkeys(layer))
    size = f'width="{width:.0f}" height="{height:.0f}"'
    said = "" if kit.proved else f"<!-- {UNCHECKED} -->\n"
    return (
        f'<svg xmlns="{_XML}" {size} viewBox="0 0 {width:.0f} {height:.0f}" '
        f'font-family="sans-serif" font-size="{_TEXT:g}" text-anchor="middle">\n'
        f'{said}<rect {size} fill="white"/>\n{drawn}\n</svg>\n'
    )


def _legend(kit: Kit, dotted: Collection[str], top: float) -> list[str]:
    """What shapes mean, a line each: those that the picture has."""
    letter = kit.joints[0].name
    kind = ", and its kind" if letter else ""
    said: list[tuple[Callable[[Floats], str], str]] = [
        (partial(_joint, number="1", letter=letter), f"a joint: its number in the plan{kind}"),
        (partial(_tube, role="row"), "an edge element, by its name"),
    ]
    if any(placement.part in dotted for placement in kit.placements):
        said.append((_dotted, "an element's near end: its number begins there"))
    if any(placement.role == "peg" for placement in kit.placements):
        said.append((_peg, "where a peg goes in"))
    caps = [placement.part for placement in kit.placements if placement.role == "cap"]
    if caps:
        words = f"a connector without a tube: {caps[0].partition('_')[2]} is {caps[0]}"
        said.append((partial(_tube, role="cap"), words))
    if any(placement.other_way_up for placement in kit.placements):
        said.append((partial(_words, words="*"), "turned over: that face is down that was up"))
    lines = []
    for number, (shape, words) in enumerate(said):
        at = np.array([_MARGIN / 2, top + _LEGEND * (number + 0.5)])
        text = f'x="{at[0] + 1.6 * _JOINT:.1f}" y="{at[1] + 0.35 * _TEXT:.1f}"'
        lines.append(f'{shape(at)}<text {text} text-anchor="start">{words}</text>')
    return lines


def _joint(point: Floats, number: str, letter: str) -> str:
    """A joint with its number and, below it, its letter."""
    x, y = point
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{_JOINT}" fill="{_colour("half_b")}"/>'
        f'{_words(point - (0, 3), number)}<text x="{x:.1f}" y="{y + 10:.1f}" '
        f'font-size="{_LETTER:g}">{letter}</text>'
    )


def _peg(middle: Floats) -> str:
    x, y = middle - _KEY / 2
    square = f'<rect x="{x:.1f}" y="{y:.1f}" width="{_KEY}" height="{_KEY}"'
    return f'{square} fill="{_colour("peg")}"/>'


def _tube(middle: Floats, role: str) -> str:
    """A short piece of a tube."""
    half = np.array([_JOINT, 0.0])
    return _line(middle - half, middle + half, role)


def _dot(middle: Floats) -> str:
    """The mark of a near end: it is seen on a tube and on a peg's mark."""
    x, y = middle
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{_DOT}" fill="white" stroke="#222222" '
        f'stroke-width="1"/>'
    )


def _dotted(middle: Floats) -> str:
    """A short piece of a tube with that mark."""
    return _tube(middle, "row") + _dot(middle)


def _ahead(placement: Placement, length: float) -> Floats:
    return length * np.array(placement.pose.x[:2]) * (1.0, -1.0)


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
