"""SVG files as trees of elements, whoever wrote them.

What a document defines is followed if it is plain text, as drawing programs write it, and as
long as that stays short.  Nothing outside the file is ever opened.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn

from scadgen.errors import InputError
from scadgen.readers.svg_elements import NAMESPACE

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from defusedxml.ElementTree import XMLParser

__all__ = ["parse_svg"]

#: What a document defines may fill this many characters, wherever it is used.
_MOST_DEFINED = 16_000_000


def parse_svg(data: bytes) -> tuple[Element, int]:
    """Read a document; its root, and how many style sheets outside it are left out.

    Raises
    ------
    InputError
        It is no XML, or no SVG; it refers to other files, or defines what is no plain text or
        becomes too long.
    """
    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import ParseError

    reader = _reader(data)
    sheets: list[str] = []
    reader.parser.ProcessingInstructionHandler = lambda target, _: sheets.append(target)
    try:
        reader.feed(data)
        root: Element = reader.close()
    except InputError:
        raise
    except DefusedXmlException:
        msg = "refers to other files, or defines XML entities that are no plain text"
    except (ParseError, ValueError, LookupError) as error:
        msg = f"is not XML: {error}"
    else:
        if root.tag in (f"{NAMESPACE}svg", "svg"):
            return root, sheets.count("xml-stylesheet")
        msg = f"is not SVG: its first element is {root.tag[:60]!r}"
    raise InputError(msg)


def _reader(data: bytes) -> XMLParser:
    from xml.etree.ElementTree import TreeBuilder

    from defusedxml.ElementTree import XMLParser

    class Reader(XMLParser):
        """Takes entities that are plain text, as long as they stay short."""

        defined = 0

        def __init__(self) -> None:
            # Of this one's elements, unlike the default's, trees may be deep.
            super().__init__(target=TreeBuilder(), forbid_entities=True, forbid_external=True)
            self.parser.AttlistDeclHandler = self.default

        def defused_entity_decl(
            self,
            name: str,
            is_parameter_entity: bool,  # noqa: FBT001 -- as expat calls it
            value: str | None,
            base: str | None,
            sysid: str,
            pubid: str | None,
            notation_name: str | None,
        ) -> None:
            if is_parameter_entity or value is None or any(c in value for c in "&%<"):
                super().defused_entity_decl(
                    name, is_parameter_entity, value, base, sysid, pubid, notation_name
                )
            self.count(len(value or "") * data.count(b"&"))

        def default(
            self,
            _element: str,
            _attribute: str,
            _kind: str,
            value: str | None,
            _required: bool,  # noqa: FBT001
        ) -> None:
            self.count(len(value or "") * data.count(b"<"))

        def count(self, length: int) -> None:
            self.defined += length
            if self.defined > _MOST_DEFINED:
                _refuse_length()

    return Reader()


def _refuse_length() -> NoReturn:
    msg = f"defines XML entities or attributes of more than {_MOST_DEFINED} characters in all"
    raise InputError(msg)
