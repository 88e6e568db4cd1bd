"""The errors scadgen raises.

::

    ScadgenError            anything scadgen says on purpose; one line
    +-- InputError          the request was wrong: the value, and what works
    +-- GeometryError       the request makes no valid part: which, and what would help
    +-- KitError            a kit file is broken, or from another version
    +-- ToolError           an outside program is missing, failed, or took too long
    +-- InvariantError      a bug here: the invariant that does not hold

Every message is one line.  The command line turns each of them into that line on
stderr and exit status 2.
"""

__all__ = [
    "GeometryError",
    "InputError",
    "InvariantError",
    "KitError",
    "ScadgenError",
    "ToolError",
]


class ScadgenError(Exception):
    """Anything scadgen says on purpose; its text is one line."""


class InputError(ScadgenError, ValueError):
    """The request was wrong: says what, the value, and what works."""


class GeometryError(ScadgenError):
    """The request is well formed but makes no valid part."""


class KitError(ScadgenError):
    """A kit file is truncated, edited into nonsense, or from another version."""


class ToolError(ScadgenError):
    """An outside program is missing, failed, or took too long."""


class InvariantError(ScadgenError, AssertionError):
    """A bug here: names the invariant that does not hold."""
