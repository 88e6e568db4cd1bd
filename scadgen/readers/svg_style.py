"""The cascade: what style sheets and attributes say of an element, and what it inherits."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from scadgen.errors import InputError
from scadgen.readers.svg_elements import kind_of
from scadgen.readers.svg_properties import GEOMETRY, INHERITED, KNOWN, as_text, custom, plain, valid

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["Cascade", "Declared", "Style"]

#: What an element has in the end: values as they are written, of properties that are said.
Style = Mapping[str, str]

#: Style sheets of a document have at most this many characters.
_LONGEST = 4_000_000

#: Variables are replaced this often at most; their values are at most this long.
_DEEPEST, _LONGEST_VALUE = 16, 10_000

_VARIABLE = re.compile(r"var\(\s*(--[^\s,()]+)\s*(?:,((?:[^()]|\([^()]*\))*))?\)")

#: The size in the shorthand `font`: the first length in it.
_FONT_SIZE = re.compile(r"(?:^|\s)([\d.]+(?:%|[a-zA-Z]+)|(?:xx?-)?(?:small|large)|medium)")

#: Media that a browser's window is, in a light colour scheme.
_MEDIA = re.compile(
    r"(?:(?:only\s+)?(?:all|screen))?(?:\s*and\s*)?(?:\(\s*prefers-color-scheme\s*:\s*light\s*\))?|"
    r"not\s+print",
    re.IGNORECASE,
)

_NAMES = frozenset(KNOWN)
_ATTRIBUTES = (
    _NAMES - GEOMETRY - {"d", "transform", "transform-box", "translate", "rotate", "scale"}
)


@dataclass(frozen=True, slots=True)
class Declared:
    """Declarations of one rule: usual and important ones."""

    usual: Mapping[str, str]
    important: Mapping[str, str]


@dataclass(slots=True)
class Cascade:
    """The style of every element of a document.

    Parameters
    ----------
    root
        Its root.
    """

    root: Element
    #: How many style sheets are referred to, which are not opened.
    outside: int = 0
    _parents: dict[Element, Element] | None = None
    #: Rules of elements: those of the document, and those in each element that is used.
    _of_rules: dict[Element | None, dict[Element, list[Declared]]] = field(default_factory=dict)
    _rules: Any = None
    _inline: dict[str, Declared] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Read the style sheets."""
        from scadgen.readers.svg_selectors import Rules

        texts = [text for text in _sheets(self.root) if text.strip()]
        if not texts:
            return
        if sum(map(len, texts)) > _LONGEST:
            msg = f"style sheets: more than {_LONGEST} characters"
            raise InputError(msg)
        rules = Rules()
        for text in texts:
            self._add(rules, text)
        self._rules = rules or None

    def style(self, element: Element, parent: Style, used: Element | None = None) -> dict[str, str]:
        """Compute what an element has.

        Parameters
        ----------
        element
            The element.
        parent
            What that has, from which it inherits: where it is used, if it is.
        used
            What is used, if it is in that.
        """
        style = {k: v for k, v in parent.items() if k in INHERITED or custom(k)}
        declared = self._declared(element, used)
        variables = {k: v for k, v in declared.items() if custom(k)}
        style |= {k: _replaced(v, style | variables) or "" for k, v in variables.items()}
        for name, text in declared.items():
            if name in variables:
                continue
            value = _replaced(text, style) if "var(" in text else text
            value = value and plain(name, value)
            if value is None or value in {"unset", "revert"} or not valid(name, value):
                if value not in {"unset", "revert"} and "var(" not in text:
                    continue
                value = "inherit" if name in INHERITED else "initial"
            if value == "inherit":
                value = parent.get(name, "initial")
            if value == "initial":
                style.pop(name, None)
            else:
                style[name] = value
        for name in ("fill", "stroke"):
            if style.get(name, "").lower() == "currentcolor":
                style[name] = style.get("color", "black")
        return style

    def in_place(self, element: Element) -> Style:
        """What an element has where it stands in the document."""
        if self._parents is None:
            self._parents = {child: outer for outer in self.root.iter() for child in outer}
        line = [element]
        while line[-1] in self._parents:
            line.append(self._parents[line[-1]])
        style: Style = {}
        for one in reversed(line):
            style = self.style(one, style)
        return style

    def _declared(self, element: Element, used: Element | None) -> dict[str, str]:
        found = {
            name: value
            for name, text in element.items()
            if name in _ATTRIBUTES and valid(name, value := plain(name, text.strip()))
        }
        rules = self._matching(used).get(element, [])
        text = element.get("style")
        if text:
            if text not in self._inline:
                self._inline[text] = _declarations(text)
            rules = [*rules, self._inline[text]]
        for rule in rules:
            found |= rule.usual
        for rule in rules:
            found |= rule.important
        return found

    def _matching(self, used: Element | None) -> dict[Element, list[Declared]]:
        if self._rules is None:
            return {}
        if used not in self._of_rules:
            root = self.root if used is None else used
            found = self._rules.matching(root, used=used is not None)
            self._of_rules[used] = dict(found)
        return self._of_rules[used]

    def _add(self, rules: Any, sheet: str | list[Any], depth: int = 0) -> None:  # noqa: ANN401
        """Add the rules of a sheet, and of what is in it for screens."""
        import tinycss2

        for rule in tinycss2.parse_stylesheet(sheet, skip_comments=True, skip_whitespace=True):
            if rule.type == "qualified-rule":
                declared = _declarations(rule.content)
                if declared.usual or declared.important:
                    rules.add(rule.prelude, declared)
            elif rule.type == "at-rule" and rule.lower_at_keyword == "namespace":
                rules.name(as_text(rule.prelude))
            elif rule.type == "at-rule" and rule.lower_at_keyword == "import":
                self.outside += 1
            elif (
                rule.type == "at-rule"
                and rule.lower_at_keyword == "media"
                and depth < _DEEPEST
                and rule.content is not None
                and _on_screen(as_text(rule.prelude))
            ):
                self._add(rules, rule.content, depth + 1)


def _sheets(root: Element) -> Iterator[str]:
    for element in root.iter():
        if kind_of(element) != "style":
            continue
        kind = (element.get("type") or "text/css").strip().lower()
        if kind == "text/css" and _on_screen(element.get("media") or ""):
            yield "".join(element.itertext())


def _on_screen(media: str) -> bool:
    return any(_MEDIA.fullmatch(one.strip()) is not None for one in media.split(","))


def _declarations(block: str | Iterable[Any]) -> Declared:
    import tinycss2

    found: tuple[dict[str, str], dict[str, str]] = ({}, {})
    parsed = tinycss2.parse_blocks_contents(block, skip_comments=True, skip_whitespace=True)
    for one in parsed:
        if one.type != "declaration":
            continue
        name = one.name if custom(one.name) else one.lower_name
        if name not in {"font", "marker"} and name not in _NAMES and not custom(name):
            continue
        value = as_text(one.value)
        for real, text in _longhands(name, plain(name, value)):
            if valid(real, text):
                found[one.important][real] = text
    return Declared(*found)


def _longhands(name: str, value: str) -> list[tuple[str, str]]:
    if name == "marker":
        return [(f"marker-{place}", value) for place in ("start", "mid", "end")]
    if name == "font":
        size = _FONT_SIZE.search(value)
        return [("font-size", size[1])] if size else []
    return [(name, value)]


def _replaced(text: str, style: Style) -> str | None:
    """A value with its variables replaced; None if one of them is not there."""
    for _ in range(_DEEPEST):
        found = _VARIABLE.search(text)
        if found is None:
            return text.strip()
        value = style.get(found[1]) or found[2]
        if value is None or len(text) + len(value) > _LONGEST_VALUE:
            return None
        text = text[: found.start()] + value + text[found.end() :]
    return None
