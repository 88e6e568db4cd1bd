"""scadgen: planar frames as parts that snap into a stable truss.

::

    import scadgen

    kit = scadgen.make_kit("4.8.8", side=8)
    kit.write("out")

What is listed here is for programs to use; it is loaded when it is first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scadgen.api.kit import KitHandle as Kit
    from scadgen.api.kit import load_kit
    from scadgen.api.make import make_frame, make_kit
    from scadgen.api.part import Mesh
    from scadgen.api.part import PartHandle as Part
    from scadgen.api.planned import KitPlan
    from scadgen.check.result import Result
    from scadgen.errors import (
        GeometryError,
        InputError,
        InvariantError,
        JointError,
        KitError,
        ScadgenError,
        ToolError,
    )
    from scadgen.frame.graph import Frame

__all__ = [
    "Frame",
    "GeometryError",
    "InputError",
    "InvariantError",
    "JointError",
    "Kit",
    "KitError",
    "KitPlan",
    "Mesh",
    "Part",
    "Result",
    "ScadgenError",
    "ToolError",
    "__version__",
    "load_kit",
    "make_frame",
    "make_kit",
]

__version__ = "0.1.0"

#: The module of each name, if that is not ``scadgen.errors``, and what it is called there.
_HOMES = {
    "Frame": ("frame.graph", "Frame"),
    "Kit": ("api.kit", "KitHandle"),
    "KitPlan": ("api.planned", "KitPlan"),
    "Mesh": ("api.part", "Mesh"),
    "Part": ("api.part", "PartHandle"),
    "Result": ("check.result", "Result"),
    "load_kit": ("api.kit", "load_kit"),
    "make_frame": ("api.make", "make_frame"),
    "make_kit": ("api.make", "make_kit"),
}


if not TYPE_CHECKING:  # who checks types is to know which names there are

    def __getattr__(name: str) -> object:
        """A public name, when it is first asked for."""
        if name not in __all__:
            msg = f"module {__name__!r} has no attribute {name!r}"
            raise AttributeError(msg)
        module, called = _HOMES.get(name, ("errors", name))
        found = getattr(import_module(f"scadgen.{module}"), called)
        globals()[name] = found
        return found


def __dir__() -> list[str]:
    """The public names."""
    return sorted({*globals(), *__all__})
