"""The command line that makes a kit again."""

from __future__ import annotations

import re
import shlex
from collections.abc import Mapping

from scadgen.api.options import option
from scadgen.emit.shell import shell_line

__all__ = ["command_line", "remade"]


def command_line(frame: str, options: Mapping[str, object]) -> str:
    """The command that makes a kit.

    Parameters
    ----------
    frame
        The name of a frame, or of a file.
    options
        By name, those that are given: True for a flag.

    Examples
    --------
    >>> command_line("4.8.8", {"side": 8.0, "unchecked": True})
    'scadgen kit 4.8.8 --side 8.0 --unchecked'
    """
    # A name that begins so would be an option.
    words = ["scadgen", "kit", f"./{frame}" if frame.startswith("-") else frame]
    for name, value in options.items():
        if value is not False:
            words.append(option(name))
            if value is not True:  # a flag is its option alone
                words.append(repr(value) if isinstance(value, float) else str(value))
    return shell_line(words)


def remade(command: str, name: str, value: object) -> str:
    """The command that makes a kit again, with another value of an option.

    Examples
    --------
    >>> remade("scadgen kit square --rows 2", "rows", 3)
    'scadgen kit square --rows 3'
    >>> remade("scadgen kit square", "material", "PETG")
    'scadgen kit square --material PETG'
    """
    if not command:
        return command
    words = f"{option(name)} {shlex.quote(str(value))}"
    given = re.compile(rf"(?<= ){re.escape(option(name))} \w+(?= |$)")
    return given.sub(words, command) if given.search(command) else f"{command} {words}"
