"""Words for a shell, so that a line of a README or of a comment can be run as it stands."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterable

__all__ = ["in_ascii", "shell_line"]

#: What would be lost, or be taken for something else, in one line of a comment: what is not
#: printed, spaces after a space, and where comments of OpenSCAD begin and end.
_LOST = re.compile(r"[^\x20-\x7e]+|(?<= ) +|\*(?=/)|(?<=/)\*")

_NOT_ASCII = re.compile(r"[^\x00-\x7f]+")


def shell_line(words: Iterable[str]) -> str:
    r"""A command for a shell, in one line of printed characters.

    Examples
    --------
    >>> shell_line(["scadgen", "kit", "my  tiles.svg"])
    'scadgen kit \'my \'"$(printf \'\\040\')"\'tiles.svg\''
    """
    return " ".join(_LOST.sub(_kept, shlex.quote(word)) for word in words)


def in_ascii(line: str) -> str:
    """The same command in ASCII."""
    return _NOT_ASCII.sub(_printed, line)


def _kept(found: re.Match[str]) -> str:
    """The same if it is letters and signs of other alphabets."""
    plain = not found[0].isascii() and found[0].isprintable()
    return found[0] if plain else _printed(found)


def _printed(found: re.Match[str]) -> str:
    """Characters of a quoted word, written so that a shell prints them."""
    # What is printed last loses its ends of lines.
    parts = re.findall(r"\n|[^\n]+", found[0])
    return "".join(
        "'$'\\n''" if part == "\n" else f"'\"$(printf '{_octal(part)}')\"'" for part in parts
    )


def _octal(text: str) -> str:
    return "".join(f"\\{byte:03o}" for byte in text.encode(errors="surrogateescape"))
