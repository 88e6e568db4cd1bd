"""The kit's Makefile, and the checker of meshes that it runs.

A user of a kit has no scadgen, so the checker is a script that needs Python's standard
library alone.
"""

from __future__ import annotations

from scadgen import __version__
from scadgen.emit.scad_parameters import views
from scadgen.emit.scad_text import comment
from scadgen.emit.shell import in_ascii
from scadgen.emit.templates import UNCHECKED, environment
from scadgen.kit.model import Kit

__all__ = ["makefile", "stl_check"]

#: Views that are printed, and look like nothing.
_FLAT = ("plate", "joint_plate", "coupon")


def makefile(kit: Kit) -> str:
    """Write the Makefile that renders and checks everything a kit can print.

    Parameters
    ----------
    kit
        The kit; the Makefile stands beside its ``.scad`` and ``check_stl.py``.

    Returns
    -------
    text
        For GNU make, ASCII.
    """
    return (
        environment()
        .get_template("kit.mk.j2")
        .render(
            title=f"{comment(kit.name)} frame of interlocking edge elements",
            version=__version__,
            command=comment(in_ascii(kit.command)),
            scad=f"{kit.name}.scad",
            parts=list(kit.parts),
            pictures=[name for name in views(kit) if name not in _FLAT],
            proved=kit.proved,
        )
    )


def stl_check(kit: Kit) -> str:
    """Write ``check_stl.py``, which the Makefile runs on every mesh.

    Parameters
    ----------
    kit
        The kit; nothing but whether it is proved makes a difference.

    Returns
    -------
    text
        Python, ASCII.
    """
    text = environment().get_template("check_stl.py").render()
    return text if kit.proved else f"# {UNCHECKED}\n{text}"
