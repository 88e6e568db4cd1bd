"""Pictures of a plan's steps, as SVG: the frame from above, what goes in coloured and named.

What stands already is grey, what is joined elsewhere until later pale, what comes later left out.
What slides in along the frame is drawn where it comes from.
"""

from __future__ import annotations

import html
import textwrap
from collections.abc import Iterable, Iterator

import numpy as np

from scadgen.plan.annotations import STYLE, arrow, joint_mark, legend, rise_mark
from scadgen.plan.figure import Shown, ahead
from scadgen.plan.labels import Labels
from scadgen.plan.model import Plan
from scadgen.plan.outlines import Outlines
from scadgen.plan.text import title
from scadgen.solid.affine import Floats

__all__ = ["step_pictures"]

_XML = "http://www.w3.org/2000/svg"

#: Length of the median edge element, and width of the margin, in pixels.
_EDGE, _MARGIN = 150.0, 24.0

#: Widest that a picture is, in pixels: larger frames are drawn smaller; and narrowest.
_WIDEST, _NARROWEST = 1600.0, 640.0

#: Size of the title, in pixels; height of its lines and width of its letters, in sizes.
_TITLE, _LINE, _LETTER = 16.0, 1.35, 0.5

#: Size of the names, as a share of the median element; least and most, in pixels.
_NAME, _SMALLEST, _LARGEST = 0.075, 7.0, 11.0

#: Parts that are named one by one when they go in as one.
_NAMED = 4

#: Half length of an arrow at a part, and before a peg; how far beside it a circle is, in sizes
#: of the names.
_SHORT, _LONG, _BESIDE = 1.3, 2.2, 1.4


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
    outlines, tables = Outlines(plan.standing), plan.tables
    return {
        f"plan-{number:0{digits}d}.svg": _Page(plan, outlines, number, tables[number]).svg()
        for number in range(1, len(plan.steps) + 1)
    }


class _Page:
    """One step on its page."""

    def __init__(
        self, plan: Plan, outlines: Outlines, number: int, tables: Iterable[frozenset[int]]
    ) -> None:
        self._plan, self._outlines, self._number = plan, outlines, number
        self._shown = Shown(plan, outlines, number, tables)
        low, high = self._shown.box()
        lengths = [plan.standing.length(part) for part in plan.standing.elements]
        edge = plan.standing.kit.values["edge_length"] * float(np.median(lengths))
        wide, high_up = high - low
        self._scale = min(_EDGE / edge, (_WIDEST - 2 * _MARGIN) / wide)
        self._size = float(np.clip(_NAME * edge * self._scale, _SMALLEST, _LARGEST))
        self._width = max(self._scale * wide + 2 * _MARGIN, _NARROWEST)
        letters = int((self._width - 2 * _MARGIN) / (_LETTER * _TITLE))
        self._lines = textwrap.wrap(title(plan, number), letters)
        top = _MARGIN + _LINE * _TITLE * len(self._lines) + _MARGIN
        self._corner = np.array([low[0], high[1]])
        self._origin = np.array([(self._width - self._scale * wide) / 2, top])
        self._bottom = top + self._scale * high_up + _MARGIN
        self._labels = Labels(self._size, self._width)

    def svg(self) -> str:
        """The page."""
        shown, width = self._shown, self._width
        body = "\n".join([*self._parts(), *self._joints(), *self._marks(), *self._names()])
        said, below = legend(self._meant(), self._size, width - 2 * _MARGIN)
        size = f'width="{width:.0f}" height="{self._bottom + below + 0.5 * _MARGIN:.0f}"'
        box = size.replace("width=", "").replace(" height=", " ").replace('"', "")
        drawn = shown.there | shown.later | shown.moving
        words = "\n".join(
            f'<text x="{_MARGIN:g}" y="{_MARGIN + _LINE * _TITLE * (n + 0.5):.1f}">'
            f"{html.escape(line)}</text>"
            for n, line in enumerate(self._lines)
        )
        return (
            f'<svg xmlns="{_XML}" {size} viewBox="0 0 {box}" font-family="sans-serif">\n'
            f"<style>{STYLE}</style>\n"
            f"<defs>\n{self._outlines.shapes(drawn, self._scale)}\n</defs>\n"
            f'<rect {size} fill="white"/>\n'
            f'<g font-size="{_TITLE:g}" class="words">\n{words}\n</g>\n'
            f'<g font-size="{self._size:.1f}" text-anchor="middle">\n{body}\n</g>\n'
            f'<g font-size="{self._size:.1f}" class="words" '
            f'transform="translate({_MARGIN:g} {self._bottom:.1f})">\n{said}\n</g>\n</svg>\n'
        )

    def _on_page(self, point: Floats) -> Floats:
        """A point of the frame, in mm, in pixels."""
        flat = (point - self._corner) * (self._scale, -self._scale)
        return np.asarray(flat + self._origin)

    def _parts(self) -> Iterator[str]:
        """Outlines of all that is there."""
        shown = self._shown
        sets = {part for move in shown.motions if len(move.parts) > 1 for part in move.parts}
        looks = {"pale": shown.later, "there": shown.there, "set": sets, "new": shown.moving - sets}
        for look, parts in looks.items():
            yield f'<g class="{look}">'
            for part in sorted(parts):
                (x, y), turn = self._on_page(shown.at(part)), self._turn(part)
                move = f"translate({x:.1f} {y:.1f}) rotate({turn:.6g})"
                yield f'<use href="#{self._outlines.name(part)}" transform="{move}"/>'
            yield "</g>"

    def _turn(self, part: int) -> float:
        return -self._plan.standing.kit.placements[part].pose.degrees % 360

    def _joints(self) -> Iterator[str]:
        """Numbers of the joints."""
        for number, place, busy in self._shown.joints():
            site = self._plan.standing.sites[number]
            at, kind = self._on_page(place), site.kind.name + "*" * site.pose.over
            self._labels.keep(at, self._size * (1.9 if kind else 1.0))
            yield joint_mark(at, number + 1, kind, self._size, busy=busy)

    def _marks(self) -> Iterator[str]:
        """How everything goes in: first all arrows and circles, so that names keep off them."""
        size = self._size
        for move, motion in self._shown.motions.items():
            for place in self._shown.marks(move):
                at, way = self._on_page(place), np.zeros(2)
                if motion.towards is not None:
                    way = ahead(motion.towards) * (1.0, -1.0)
                    half = size * (_LONG if motion.slides else _SHORT)
                    yield arrow(at - half * way, at + half * way, size)
                    self._labels.keep(at, half * np.abs(way) + 0.4 * size)
                if motion.above:
                    circle = at + _BESIDE * size * np.array([way[1], -way[0]])
                    yield rise_mark(circle, motion.above, size)
                    self._labels.keep(circle, 0.7 * size)

    def _names(self) -> Iterator[str]:
        """Names of what goes in, and in the first step of what is laid out."""
        shown, named = self._shown, []
        if self._number == 1:
            named += [(self._name(part), shown.middle(part), part) for part in self._plan.first()]
        for move in shown.motions:
            if len(move.parts) > _NAMED:
                middle = np.mean([shown.middle(part) for part in move.parts], axis=0)
                named.append((f"{len(move.parts)} parts as one", middle, min(move.parts)))
            else:
                named += [(self._name(part), shown.middle(part), part) for part in move.parts]
        for words, place, part in sorted(named, key=lambda one: one[2]):
            on = part in self._plan.standing.elements
            yield self._labels.put(words, self._on_page(place), on=on)

    def _name(self, part: int) -> str:
        place = self._plan.standing.kit.placements[part]
        return place.marked(place.part)

    def _meant(self) -> Iterator[str]:
        """What there is on the page, as the legend calls it."""
        shown = self._shown
        yield "joint"
        yield from ["there"] * bool(shown.there) + ["later"] * bool(shown.later)
        for move, motion in shown.motions.items():
            yield "set" if len(move.parts) > 1 else "new"
            yield ("", "above", "below")[motion.above]
            if motion.towards is not None:
                yield "along"
        named = shown.moving | (self._plan.first() if self._number == 1 else frozenset())
        over = any(self._plan.standing.sites[n].pose.over for n, *_ in shown.joints())
        if over or any(self._plan.standing.kit.placements[n].other_way_up for n in named):
            yield "other"
        if any(site.kind.name for site in self._plan.standing.sites):
            yield "kind"
