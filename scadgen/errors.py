"""The errors scadgen raises.

::

    ScadgenError            anything scadgen says on purpose; one line
    +-- InputError          the request was wrong: the value, and what works
    +-- GeometryError       the request makes no valid part: which, and what would help
    |   +-- JointError      a joint is not proved to lock or to come apart: which
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
    "JointError",
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


class JointError(GeometryError):
    """A joint is not proved to lock, or to come apart.

    Parameters
    ----------
    message
        The line.
    joint
        The joint's name in its kit.
    fault
        What is not proved, without what would help.
    """

    def __init__(self, message: str, joint: str = "", fault: str = "") -> None:
        super().__init__(message)
        self.joint, self.fault = joint, fault


class KitError(ScadgenError):
    """A kit file is truncated, edited into nonsense, or from another version."""


class ToolError(ScadgenError):
    """An outside program is missing, failed, or took too long."""


class InvariantError(ScadgenError, AssertionError):
    """A bug here: names the invariant that does not hold."""
