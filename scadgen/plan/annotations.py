"""Marks on the pictures of a plan, as SVG, and the legend that says what they mean."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable

import numpy as np

from scadgen.solid.affine import Floats

__all__ = ["STYLE", "arrow", "joint_mark", "legend", "rise_mark"]

_DARK, _NEW = "#222222", "#ff9f1c"

#: How everything looks, once a page.
STYLE = (
    ".pale{fill:#f2f2ef;stroke:#cfcfca;stroke-width:.7}"
    ".there{fill:#cfcfca;stroke:#83837d;stroke-width:.7}"
    f".new{{fill:{_NEW};stroke:#7a4300;stroke-width:.9}}"
    ".set{fill:#ffd591;stroke:#7a4300;stroke-width:.9}"
    f".words,.name{{fill:{_DARK}}}"
    ".halo{fill:#fff;stroke:#fff;stroke-width:3px;stroke-linejoin:round}"
    f".lead{{stroke:{_DARK};stroke-width:.6;fill:none}}"
    f".line{{stroke:{_DARK};stroke-width:1.3;fill:#fff}}"
    f".arrow{{stroke:{_DARK};stroke-width:2;fill:none}}"
    f".solid{{fill:{_DARK}}}"
    ".joint{fill:#fff;stroke:#83837d;stroke-width:.7}"
    f".busy{{fill:#fff;stroke:{_DARK};stroke-width:1.5}}"
    ".number{text-anchor:middle}.quiet{fill:#83837d}"
)

#: Widths of a letter and of a legend's sample, and heights of its lines, in sizes of its text.
_LETTER, _SAMPLE, _LINE = 0.56, 2.8, 2.4


def arrow(start: Floats, stop: Floats, size: float) -> str:
    """An arrow in the frame's plane."""
    ahead = (stop - start) / np.linalg.norm(stop - start)
    across = np.array([-ahead[1], ahead[0]])
    head = 0.8 * size
    barbs = [stop, stop - head * ahead + 0.5 * head * across, stop - head * (ahead + 0.5 * across)]
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in barbs)
    (a, b), (c, d) = start, stop - 0.8 * head * ahead
    line = f'<path class="arrow" d="M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}"/>'
    return f'{line}<polygon class="solid" points="{points}"/>'


def rise_mark(at: Floats, above: int, size: float) -> str:
    """A circle with a cross for what goes down, away from the eye; with a dot for what goes up."""
    (x, y), radius = at, 0.6 * size
    circle = f'<circle class="line" cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}"/>'
    if above < 0:
        return f'{circle}<circle class="solid" cx="{x:.1f}" cy="{y:.1f}" r="{0.35 * radius:.1f}"/>'
    off = 0.7 * radius
    return (
        f'{circle}<path class="line" d="M{x - off:.1f} {y - off:.1f}L{x + off:.1f} {y + off:.1f}'
        f'M{x - off:.1f} {y + off:.1f}L{x + off:.1f} {y - off:.1f}"/>'
    )


def joint_mark(at: Floats, number: int, kind: str, size: float, *, busy: bool) -> str:
    """A joint's number in a circle, and the letter of its kind below it, if there are several."""
    (x, y), radius = at, 0.9 * size
    look = "busy" if busy else "joint"
    found = (
        f'<circle class="{look}" cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}"/>'
        f'<text class="number{"" if busy else " quiet"}" x="{x:.1f}" y="{y + 0.36 * size:.1f}">'
        f"{number}</text>"
    )
    if kind:
        found += (
            f'<text class="number quiet" font-size="{0.8 * size:.1f}" x="{x:.1f}" '
            f'y="{y + 1.75 * size:.1f}">{html.escape(kind)}</text>'
        )
    return found


def _swatch(look: str) -> Callable[[Floats, float], str]:
    def draw(at: Floats, size: float) -> str:
        x, y = at - np.array([size, 0.5 * size])
        box = f'x="{x:.1f}" y="{y:.1f}" width="{2 * size:.1f}" height="{size:.1f}"'
        return f'<rect class="{look}" {box}/>'

    return draw


def _across(at: Floats, size: float) -> str:
    half = np.array([1.2 * size, 0.0])
    return arrow(at - half, at + half, size)


def _written(words: str) -> Callable[[Floats, float], str]:
    def draw(at: Floats, size: float) -> str:
        x, y = at
        return f'<text class="number quiet" x="{x:.1f}" y="{y + 0.36 * size:.1f}">{words}</text>'

    return draw


#: What each mark is called in the legend, how it is drawn there, and what it means.
_MEANINGS: tuple[tuple[str, Callable[[Floats, float], str], str], ...] = (
    ("new", _swatch("new"), "goes in now"),
    ("set", _swatch("set"), "goes in now as one, joined already"),
    ("there", _swatch("there"), "stands already"),
    ("later", _swatch("pale"), "lies apart until later"),
    ("above", lambda at, size: rise_mark(at, 1, size), "goes down, from above"),
    ("below", lambda at, size: rise_mark(at, -1, size), "goes up, from below"),
    ("along", _across, "goes along the frame"),
    ("joint", lambda at, size: joint_mark(at, 1, "", size, busy=True), "joint with its number"),
    ("kind", _written("A"), "kind of joint, by its letter"),
    ("other", _written("*"), "lies turned over, half B as printed"),
)


def legend(shown: Iterable[str], size: float, width: float) -> tuple[str, float]:
    """What some marks mean, in lines from the origin down, and how high that is.

    Parameters
    ----------
    shown
        What the marks are called.
    size
        Of the text, in pixels.
    width
        Widest that a line is, in pixels.
    """
    names, drawn = set(shown), []
    x, y = 0.0, 0.5 * _LINE * size
    for name, draw, words in _MEANINGS:
        if name not in names:
            continue
        wide = size * (_SAMPLE + _LETTER * len(words) + 1.6)
        if x > 0 and x + wide > width:
            x, y = 0.0, y + _LINE * size
        drawn.append(draw(np.array([x + 0.5 * _SAMPLE * size, y]), size))
        drawn.append(
            f'<text x="{x + (_SAMPLE + 0.4) * size:.1f}" y="{y + 0.36 * size:.1f}">{words}</text>'
        )
        x += wide
    return "\n".join(drawn), y + 0.5 * _LINE * size
