"""Frames as SVG: vertices coloured by kind of joint, edges by kind of edge."""

from __future__ import annotations

import colorsys
import html
from collections.abc import Callable, Iterator

import numpy as np

from scadgen.frame.classes import Classes, joint_name
from scadgen.frame.graph import Frame
from scadgen.solid.affine import Floats

__all__ = ["frame_svg"]

_XML = "http://www.w3.org/2000/svg"

#: Width of a picture and largest height of its drawing, in pixels.
_WIDTH, _HEIGHT = 900, 900

#: Space around the drawing and around the legend, in pixels.
_MARGIN = 30

#: Tubes and joints as shares of the edges' median length, and the least and most in pixels.
_TUBE, _TUBES = 0.09, (1.0, 8.0)
_JOINT, _JOINTS = 0.14, (1.5, 12.0)

#: Rings around places: how much wider than a joint, and their colours.
_RING, _REPAIRED, _IN_THE_WAY = 1.8, "#1f6feb", "#d1242f"

_NOWHERE = np.zeros((0, 2))

#: The legend: its entries a row, height of a row in pixels, and most entries of joints or edges.
_COLUMNS, _ROW, _ENTRIES = 5, 24, 30

#: Hues a golden section of the circle apart: any few that follow each other differ well.
_GOLDEN = 0.381966

#: Lightness and saturation of edges, which are pale, and of joints.
_PALE, _STRONG = ((0.62, 0.55, 0.7), 0.5), ((0.42, 0.3, 0.52), 0.75)


def frame_svg(
    frame: Frame, same: Classes, repaired: Floats = _NOWHERE, in_the_way: Floats = _NOWHERE
) -> str:
    """Draw a frame, y up, with a legend where there are few kinds.

    Parameters
    ----------
    frame
        The frame.
    same
        Its kinds of joints and edges.
    repaired, in_the_way
        ``(k, 2) float``: places where the drawing was changed, and where something keeps it from
        being built, in mm.  They have a ring around them.
    """
    to_page, height = _page(frame)
    points = to_page(frame.plan)
    median = float(np.median(np.linalg.norm(np.diff(points[frame.edges], axis=1), axis=2)))
    tube = float(np.clip(_TUBE * median, *_TUBES))
    joint = float(np.clip(_JOINT * median, *_JOINTS))
    legend: list[str] = []
    for texts, what, mark in (
        (_joint_texts(same), "joints", _disc),
        (_edge_texts(same), "edges", _line),
    ):
        marks = len(texts) <= _ENTRIES
        entries = texts if marks else [f"{len(texts)} kinds of {what}"]
        legend += _legend(entries, mark if marks else None, height)
        height += _ROW * -(-len(entries) // _COLUMNS)
    size = f'width="{_WIDTH}" height="{height}"'
    return "\n".join(
        [
            f'<svg xmlns="{_XML}" {size} viewBox="0 0 {_WIDTH} {height}">',
            f"<title>{html.escape(frame.name)}</title>",
            f'<rect {size} fill="white"/>',
            f'<g stroke-width="{tube:.2f}" stroke-linecap="round">',
            *_edges(points, frame, same),
            "</g>",
            '<g stroke="#222222">',
            *_joints(points, frame, same, joint),
            "</g>",
            *_marks(to_page(repaired), "repaired", _REPAIRED, _RING * joint),
            *_marks(to_page(in_the_way), "in the way", _IN_THE_WAY, 1.5 * _RING * joint),
            '<g font-family="sans-serif" font-size="13" fill="#222222">',
            *legend,
            "</g>",
            "</svg>\n",
        ]
    )


def _page(frame: Frame) -> tuple[Callable[[Floats], Floats], int]:
    """What takes places to pixels, y down, and the height of the page without legend."""
    low, high = frame.bounds
    extent = high - low
    room = np.array([_WIDTH, _HEIGHT]) - 2 * _MARGIN
    scale = float((room / np.maximum(extent, 1e-9)).min())
    width, height = extent * scale
    left = (_WIDTH - width) / 2

    def to_page(places: Floats) -> Floats:
        return np.asarray((places - low) * scale * (1, -1) + (left, _MARGIN + height))

    return to_page, round(height) + 2 * _MARGIN


def _marks(points: Floats, what: str, colour: str, radius: float) -> Iterator[str]:
    """A ring around each place, with what it means."""
    if len(points):
        yield f'<g fill="none" stroke="{colour}" stroke-width="2"><title>{what}</title>'
        for x, y in points:
            yield f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius:.2f}"/>'
        yield "</g>"


def _edges(points: Floats, frame: Frame, same: Classes) -> Iterator[str]:
    """A group of lines for each kind of edge."""
    for kind, text in enumerate(_edge_texts(same)):
        ends = points[frame.edges[same.edges[kind].edges]].reshape(-1, 4)
        path = "".join(f"M{a:.2f} {b:.2f}L{c:.2f} {d:.2f}" for a, b, c, d in ends)
        yield f'<path stroke="{_colour(kind, _PALE)}" d="{path}"><title>edge {text}</title></path>'


def _joints(points: Floats, frame: Frame, same: Classes, radius: float) -> Iterator[str]:
    """A group of discs for each kind of joint; each says what its vertex is called."""
    for kind, text in enumerate(_joint_texts(same)):
        yield f'<g fill="{_colour(kind, _STRONG)}"><title>joint {text}</title>'
        for vertex in same.joints[kind].vertices:
            x, y = points[vertex]
            called = f"joint {joint_name(kind)}, {frame.called_vertex(int(vertex))}"
            disc = f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius:.2f}">'
            yield f"{disc}<title>{called}</title></circle>"
        yield "</g>"


def _joint_texts(same: Classes) -> list[str]:
    return [
        f"{joint_name(kind)}: {len(joint.vertices)} with {_edges_of(len(joint.directions))}"
        for kind, joint in enumerate(same.joints)
    ]


def _edge_texts(same: Classes) -> list[str]:
    return [
        f"{kind}: {len(edge.edges)} of {edge.length:.4g} mm"
        for kind, edge in enumerate(same.edges, 1)
    ]


def _edges_of(count: int) -> str:
    return "1 edge" if count == 1 else f"{count} edges"


def _legend(
    texts: list[str], mark: Callable[[int, float, float], str] | None, top: int
) -> Iterator[str]:
    """Texts in rows that begin at this height, each with the mark of its kind."""
    wide = (_WIDTH - 2 * _MARGIN) / _COLUMNS
    for kind, text in enumerate(texts):
        row, column = divmod(kind, _COLUMNS)
        x, y = _MARGIN + column * wide, top + row * _ROW
        if mark is not None:
            yield mark(kind, x, y)
        yield f'<text x="{x + (24 if mark else 0):.2f}" y="{y + 4:.2f}">{text}</text>'


def _disc(kind: int, x: float, y: float) -> str:
    return f'<circle cx="{x + 8:.2f}" cy="{y:.2f}" r="6" fill="{_colour(kind, _STRONG)}"/>'


def _line(kind: int, x: float, y: float) -> str:
    colour = _colour(kind, _PALE)
    return f'<path stroke="{colour}" stroke-width="6" d="M{x:.2f} {y:.2f}h16"/>'


def _colour(kind: int, tone: tuple[tuple[float, ...], float]) -> str:
    """A colour of its own for each of many kinds."""
    lightness, saturation = tone
    rgb = colorsys.hls_to_rgb(
        (0.58 + kind * _GOLDEN) % 1.0, lightness[kind % len(lightness)], saturation
    )
    return "#" + "".join(f"{round(255 * part):02x}" for part in rgb)
