"""Pictures of a plan's steps, as SVG: the frame from above, what goes in coloured.

What is there already is grey, what comes later is left out.  Numbers on parts are the order
in which they go in, in a square if what is joined already goes in as one there; where there
is no order, numbers in joints are the joints'.
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from scadgen.emit.picture import COLOURS
from scadgen.frame.placement import Placement
from scadgen.plan.model import Move, Plan
from scadgen.plan.told import sentence
from scadgen.solid.affine import Floats

__all__ = ["step_pictures"]

_XML = "http://www.w3.org/2000/svg"

#: Length of the median edge, and width of the margin, in pixels.
_EDGE, _MARGIN = 110.0, 50.0

#: Widest that a picture is, in pixels: larger frames are drawn smaller; and narrowest.
_WIDEST, _NARROWEST = 1600.0, 700.0

#: Room for the sentence above the drawing, its text's size, and characters in a line for each
#: pixel of width.
_HEAD, _WORDS, _LETTERS = 70.0, 15.0, 0.118

#: Shares of an edge: radius of a joint, width of a tube, side of a peg, size of the numbers.
_JOINT, _TUBE, _PEG, _NUMBER = 0.12, 0.075, 0.085, 0.105

#: How far a row that goes in is drawn from its place, in edges.
_AWAY = 0.45

#: Colours of what is there already, and of what is numbered.
_THERE, _DARK = "#c8c8c4", "#222222"


def step_pictures(plan: Plan) -> dict[str, str]:
    """Draw every step.

    Parameters
    ----------
    plan
        The plan.

    Returns
    -------
    pictures
        SVG by name of the file: ``plan-01.svg`` and so on.
    """
    digits = max(2, len(str(len(plan.steps))))
    there = set(plan.first())
    pictures = {}
    for number, step in enumerate(plan.steps, 1):
        there |= {part for move in step.moves for part in move.parts}
        # Rows that go in later lie elsewhere until then.
        later = {part for move in _moves(plan, number, "rows") for part in move.parts}
        shown = there - later if step.what == "rows" else there
        pictures[f"plan-{number:0{digits}d}.svg"] = _Page(plan, number, shown).svg()
    return pictures


def _moves(plan: Plan, after: int, what: str) -> Iterator[Move]:
    """Moves of one sort in later steps."""
    for step in plan.steps[after:]:
        if step.what == what:
            yield from step.moves


class _Page:
    """One step on its page."""

    def __init__(self, plan: Plan, number: int, there: Iterable[int]) -> None:
        self._plan, self._number = plan, number
        self._there = sorted(there)
        self._moves = plan.steps[number - 1].moves
        places = plan.standing.kit.placements
        points = np.array([end for n, p in enumerate(places) for end in self._ends(n, p)])
        points = points * (1.0, -1.0)
        low, high = points.min(axis=0) - _AWAY, points.max(axis=0) + _AWAY
        wide = float((high - low)[0])
        self._scale = min(_EDGE, (_WIDEST - 2 * _MARGIN) / wide)
        self._width = max(self._scale * wide + 2 * _MARGIN, _NARROWEST)
        self._low = low
        lines = _lines(f"{number}. {sentence(plan, number)}", int(_LETTERS * self._width))
        self._lines = lines
        self._top = _HEAD + 1.3 * _WORDS * (len(lines) - 1)
        self._height = self._scale * float((high - low)[1]) + _MARGIN + self._top

    def svg(self) -> str:
        """The page."""
        size = f'width="{self._width:.0f}" height="{self._height:.0f}"'
        drawn = "\n".join([*self._resting(), *self._moving(), *self._joints()])
        words = "\n".join(
            f'<text x="{_MARGIN:g}" y="{32 + 1.3 * _WORDS * n:.1f}">{html.escape(line)}</text>'
            for n, line in enumerate(self._lines)
        )
        number = _NUMBER * self._scale
        return (
            f'<svg xmlns="{_XML}" {size} viewBox="0 0 {self._width:.0f} {self._height:.0f}" '
            f'font-family="sans-serif">\n<rect {size} fill="white"/>\n'
            f'<g font-size="{_WORDS:g}" fill="{_DARK}">\n{words}\n</g>\n'
            f'<g font-size="{number:.1f}" text-anchor="middle" stroke-linecap="butt">\n'
            f"{drawn}\n</g>\n</svg>\n"
        )

    def _ends(self, part: int, place: Placement) -> list[Floats]:
        """Where a part is, or both ends of an element, in edge lengths."""
        at = np.array(place.at)
        if part not in self._plan.standing.elements:
            return [at]
        return [at, at + self._plan.standing.length(part) * _ahead(place.turn)]

    def _on_page(self, point: Floats) -> Floats:
        """A point of the frame, in edge lengths, in pixels."""
        flat = (point * (1.0, -1.0) - self._low) * self._scale
        return np.asarray(flat + np.array([_MARGIN, self._top - 10]))

    def _resting(self) -> Iterator[str]:
        """What is there before the step."""
        coloured = self._coloured()
        for part in self._there:
            if part not in coloured:
                yield self._part(part, _THERE, np.zeros(2))

    def _coloured(self) -> set[int]:
        """What goes in; of what is joined already and goes in as one, rows alone."""
        rows = self._plan.steps[self._number - 1].what == "rows"
        sets = [move.parts for move in self._moves if rows or len(move.parts) == 1]
        return {part for parts in sets for part in parts}

    def _moving(self) -> Iterator[str]:
        """What goes in, its numbers, and arrows at rows."""
        places, coloured = self._plan.standing.kit.placements, self._coloured()
        numbered = max(move.order for move in self._moves) > 1
        for move in sorted(self._moves, key=lambda m: len(m.parts), reverse=True):
            away = self._away(move)
            for part in sorted(coloured.intersection(move.parts)):
                colour = "#{:02x}{:02x}{:02x}".format(*COLOURS[places[part].role])
                yield self._part(part, colour, away)
            if away.any() and len(move.parts) > 1:
                yield self._arrow(move, away)
        if numbered:
            yield from map(self._order, self._moves)

    def _away(self, move: Move) -> Floats:
        """How far from their place a move's parts are drawn, in edge lengths."""
        alone = len({move.order for move in self._moves}) == 1
        rows = self._plan.steps[self._number - 1].what == "rows"
        return _AWAY * _ahead(move.turn) if rows and alone else np.zeros(2)

    def _part(self, part: int, colour: str, away: Floats) -> str:
        """A part as it is seen from above."""
        place = self._plan.standing.kit.placements[part]
        ends = [self._on_page(end + away) for end in self._ends(part, place)]
        wide, ring = _TUBE * self._scale, _JOINT * self._scale
        if len(ends) == 2:
            return _path(ends[0], ends[1], colour, wide)
        middle = ends[0]
        ahead = _ahead(place.turn) * (1.0, -1.0)
        if place.role == "cap":
            return _path(middle, middle + 2 * ring * ahead, colour, wide)
        if place.role == "peg":
            start = middle + 0.9 * ring * ahead
            return _path(start, start + 1.4 * ring * ahead, colour, _PEG * self._scale)
        # Halves: the half of a disc on either side of the edge.
        side = 1.0 if place.role == "half_a" else -1.0
        across = side * ring * np.array([ahead[1], -ahead[0]])
        (a, b), (c, d) = middle - ring * ahead, middle + ring * ahead
        (e, f), turn = middle + across, int(side > 0)
        return (
            f'<path d="M{a:.1f} {b:.1f}A{ring:.1f} {ring:.1f} 0 0 {turn} {e:.1f} {f:.1f}'
            f'A{ring:.1f} {ring:.1f} 0 0 {turn} {c:.1f} {d:.1f}Z" fill="{colour}"/>'
        )

    def _arrow(self, move: Move, away: Floats) -> str:
        """Where something goes, beside its middle."""
        places = self._plan.standing.kit.placements
        ends = np.array([end for n in move.parts for end in self._ends(n, places[n])])
        middle = (ends.min(axis=0) + ends.max(axis=0)) / 2
        start, stop = self._on_page(middle + away), self._on_page(middle + 0.15 * away)
        ahead = (stop - start) / np.linalg.norm(stop - start)
        across = np.array([-ahead[1], ahead[0]])
        barbs = [stop - 9 * ahead + sign * 5 * across for sign in (1, -1)]
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (stop, *barbs))
        return f'{_path(start, stop - 8 * ahead, _DARK, 2.5)}<polygon points="{points}"/>'

    def _order(self, move: Move) -> str:
        """A move's number in the order: round at a part, square at the joint of several."""
        size = _NUMBER * self._scale
        if len(move.parts) > 1:
            x, y = self._on_page(np.array(self._plan.standing.sites[move.joint].at))
            mark = (
                f'<rect x="{x - 0.8 * size:.1f}" y="{y - 0.8 * size:.1f}" '
                f'width="{1.6 * size:.1f}" height="{1.6 * size:.1f}"'
            )
        else:
            (part,) = move.parts
            place = self._plan.standing.kit.placements[part]
            ends = self._ends(part, place)
            ahead = 2.2 * _JOINT * self._scale * _ahead(place.turn) * (1.0, -1.0)
            x, y = self._on_page((ends[0] + ends[-1]) / 2) + ahead * (len(ends) == 1)
            mark = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{0.8 * size:.1f}"'
        return (
            f'{mark} fill="white" stroke="{_DARK}" stroke-width="0.8"/>'
            f'<text x="{x:.1f}" y="{y + 0.36 * size:.1f}">{move.order}</text>'
        )

    def _joints(self) -> Iterator[str]:
        """Numbers of the joints that the step is about."""
        if max(move.order for move in self._moves) > 1:
            return  # the numbers are of the order
        size = _NUMBER * self._scale
        for joint in sorted({move.joint for move in self._moves if not self._away(move).any()}):
            x, y = self._on_page(np.array(self._plan.standing.sites[joint].at))
            yield f'<text x="{x:.1f}" y="{y + 0.36 * size:.1f}" fill="{_DARK}">{joint + 1}</text>'


def _ahead(turn: float) -> Floats:
    return np.array([math.cos(math.radians(turn)), math.sin(math.radians(turn))])


def _path(start: Floats, end: Floats, colour: str, width: float) -> str:
    (a, b), (c, d) = start, end
    return (
        f'<path d="M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" stroke="{colour}" stroke-width="{width:.1f}"/>'
    )


def _lines(text: str, most: int) -> Sequence[str]:
    """Words in lines of so many letters at most."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > most:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines
