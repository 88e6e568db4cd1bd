"""Where the file templates are, and how they are rendered."""

from __future__ import annotations

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

import scadgen
from scadgen.errors import InvariantError

__all__ = ["UNCHECKED", "environment"]

#: What every text file of a kit that was not proved says, where comments can be.
UNCHECKED = (
    "UNCHECKED: nothing was proved of this kit's joints; they may not lock, or not come together."
)


def _folder() -> Path:
    """Find the templates: inside an installed package, beside it in a checkout."""
    package = Path(scadgen.__file__).parent
    for folder in (package / "templates", package.parent / "templates"):
        if folder.is_dir():
            return folder
    msg = f"templates are shipped with scadgen: no templates folder in or beside {package}"
    raise InvariantError(msg)


def environment() -> Environment:
    """Make the Jinja2 environment that renders every generated text file.

    An undefined name is an error, nothing is escaped, and a block tag alone on its line
    leaves no line behind.  Templates know what to say of an `unchecked` kit.

    Returns
    -------
    environment
        A fresh one, so that a caller's filters stay its own.

    Raises
    ------
    InvariantError
        The templates were not shipped.
    """
    made = Environment(
        loader=FileSystemLoader(_folder()),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
        # The outputs are OpenSCAD, Make and Markdown, never HTML.
        autoescape=False,  # noqa: S701
    )
    made.globals["unchecked"] = UNCHECKED
    return made
