"""Which rules of style sheets go for which element, within a bounded number of steps."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any
from xml.etree import ElementTree as ET

from cssselect2 import ElementWrapper, Matcher, SelectorError, compile_selector_list

from scadgen.errors import InputError
from scadgen.readers.svg_properties import as_text

__all__ = ["Rules"]

#: Elements that are compared with selectors, at most, each time that one is.
_MOST_STEPS = 2_000_000

#: A selector is at most this long: it is compiled to an expression of Python.
_LONGEST = 2_000

#: A prefix and what it stands for.
_PREFIX = re.compile(r"([\w-]+)\s+(?:url\()?\s*[\"']?([^\"'()\s]*)[\"']?\s*\)?")


class Rules:
    """Rules by their selectors; the payload of each is the caller's."""

    def __init__(self) -> None:
        self._matcher = Matcher()
        self._steps = 0
        self._namespaces: dict[str, str] = {}

    def __bool__(self) -> bool:
        """Whether there are any."""
        return bool(self._matcher.order)

    def name(self, prelude: str) -> None:
        """Take a prefix of names, as a rule says it; others stand for names of any kind."""
        found = _PREFIX.fullmatch(prelude)
        if found is not None:
            self._namespaces[found[1]] = found[2]

    def add(self, prelude: list[Any], payload: object) -> None:
        """Add a rule; one whose selectors nobody understands is none, as in browsers.

        Parameters
        ----------
        prelude
            The selectors, as tinycss2 gives them.
        payload
            What `matching` gives for elements that they select.
        """
        text = as_text(prelude)
        if len(text) > _LONGEST:
            msg = f"style sheet: selector {text[:40]!r} has more than {_LONGEST} characters"
            raise InputError(msg)
        try:
            selectors = compile_selector_list(text, self._namespaces)
        except (SelectorError, NotImplementedError, SyntaxError, RecursionError, MemoryError):
            return
        for selector in selectors:
            self._matcher.add_selector(selector, payload)

    def matching(self, root: ET.Element, *, used: bool) -> Iterator[tuple[ET.Element, list[Any]]]:
        """Every element that has rules, and their payloads; those that win last.

        Parameters
        ----------
        root
            Where to begin.
        used
            Whether it stands in a use: selectors know nothing of what is around it there.

        Raises
        ------
        InputError
            It would take too long to find them.
        """
        if used:
            around = ET.Element("use")
            around.append(root)
            root = around
        for node in _Node.of(root, self).iter_subtree():
            found = self._matcher.match(node)
            self.step(self._compared(node))
            payloads = [payload for _, _, pseudo, payload in found if pseudo is None]
            if payloads:
                yield node.etree_element, payloads

    def step(self, count: int = 1) -> None:
        """Count what is compared."""
        self._steps += count
        if self._steps > _MOST_STEPS:
            msg = f"style sheet: its selectors take more than {_MOST_STEPS} comparisons"
            raise InputError(msg)

    def _compared(self, node: _Node) -> int:
        """How many selectors are compared with an element."""
        matcher = self._matcher
        return (
            len(matcher.other_selectors)
            + len(matcher.lower_local_name_selectors.get(node.local_name.lower(), ()))
            + len(matcher.namespace_selectors.get(node.namespace_url, ()))
            + len(matcher.id_selectors.get(node.id, ()))
            + sum(1 + len(matcher.class_selectors.get(name, ())) for name in node.classes)
        )


class _Node(ElementWrapper):  # type: ignore[misc]
    """An element whose relatives are counted as they are asked for, and not kept."""

    rules: Rules

    @classmethod
    def of(cls, root: ET.Element, rules: Rules) -> _Node:
        node: _Node = cls.from_xml_root(root)
        node.rules = rules
        return node

    def __init__(
        self,
        etree_element: ET.Element,
        parent: _Node | None,
        *others: Any,  # noqa: ANN401 -- as its base has it
        **named: Any,  # noqa: ANN401
    ) -> None:
        super().__init__(etree_element, parent, *others, **named)
        if parent is not None:
            self.rules = parent.rules
            self.rules.step()

    @property
    def ancestors(self) -> Iterator[_Node]:
        return self._along("parent")

    @property
    def previous_siblings(self) -> Iterator[_Node]:
        return self._along("previous")

    @property
    def etree_siblings(self) -> list[ET.Element]:
        self.rules.step(len(self._siblings))
        return self._siblings

    @etree_siblings.setter
    def etree_siblings(self, siblings: list[ET.Element]) -> None:
        self._siblings = siblings

    def _along(self, way: str) -> Iterator[_Node]:
        node = getattr(self, way)
        while node is not None:
            self.rules.step()
            yield node
            node = getattr(node, way)
