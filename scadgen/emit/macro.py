"""The FreeCAD macro of a kit: the FreeCAD side's own modules in one file, and the kit.

A machine that has never seen scadgen runs it: it imports the standard library and FreeCAD.
"""

from __future__ import annotations

import ast
import itertools
from collections.abc import Iterable
from pathlib import Path

import scadgen
from scadgen.emit.templates import environment
from scadgen.errors import InvariantError
from scadgen.kit.model import Kit
from scadgen.kit.store import dumps

__all__ = ["macro", "workbench"]

#: The modules that the macro is put together from, each after those it imports.
_MODULES = (
    *("faces", "affine", "cells", "tables", "sense", "kit_data", "brep", "shape"),
    *("names", "sheet", "refusal", "macro"),
)

#: What modules import from each other, and the macro has in one place.
_PACKAGE = "freecad.scadgen"


def workbench() -> Path:
    """Where the FreeCAD workbench is: inside an installed package, beside it in a checkout.

    Raises
    ------
    InvariantError
        It was not shipped.
    """
    package = Path(scadgen.__file__).parent
    for folder in (package / "freecad_workbench", package.parent / "freecad_workbench"):
        if folder.is_dir():
            return folder
    msg = f"the workbench is shipped with scadgen: no freecad_workbench in or beside {package}"
    raise InvariantError(msg)


def macro(kit: Kit) -> str:
    """Write the FreeCAD macro of a kit.

    Parameters
    ----------
    kit
        The kit.

    Returns
    -------
    text
        Python of the version that FreeCAD has, with no import but FreeCAD's and the standard
        library's.
    """
    folder = workbench() / "freecad" / "scadgen"
    modules = [_Module((folder / f"{name}.py").read_text("utf-8")) for name in _MODULES]
    names = [name for module in modules for name in module.names]
    if len({*names}) < len(names):
        twice = sorted({name for name in names if names.count(name) > 1})
        msg = f"the macro's modules share no name: {', '.join(twice)}"
        raise InvariantError(msg)
    return (
        environment()
        .get_template("macro.FCMacro.j2")
        .render(
            version=scadgen.__version__,
            name=kit.name,
            key=kit.key,
            proved=kit.proved,
            imports=_merged(module.imports for module in modules),
            modules=[module.body for module in modules],
            lines=[repr(line) for line in dumps(kit).splitlines(keepends=True)],
        )
    )


class _Module:
    """A module's imports from outside, the names it defines, and its text without its head."""

    def __init__(self, text: str) -> None:
        tree = ast.parse(text)
        heads = [n for n, node in enumerate(tree.body) if _is_head(node)]
        if heads != [*range(len(heads))]:
            msg = "a module of the macro starts with its docstring, its imports and __all__"
            raise InvariantError(msg)
        last = tree.body[len(heads) - 1].end_lineno
        self.body = "".join(text.splitlines(keepends=True)[last:]).strip()
        self.imports = [
            node
            for node in tree.body[: len(heads)]
            if isinstance(node, ast.Import | ast.ImportFrom) and not _is_ours(node)
        ]
        self.names = [name for node in tree.body[len(heads) :] for name in _names(node)]


def _is_head(node: ast.stmt) -> bool:
    return (
        isinstance(node, ast.Import | ast.ImportFrom)
        or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant))
        or _names(node) == ["__all__"]
    )


def _is_ours(node: ast.Import | ast.ImportFrom) -> bool:
    """Whether it imports another module of the macro, or what is said once for all of it."""
    module = node.module or "" if isinstance(node, ast.ImportFrom) else ""
    return module == "__future__" or module.startswith(_PACKAGE)


def _names(node: ast.stmt) -> list[str]:
    """What a statement at the top of a module defines."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return [node.name]
    if isinstance(node, ast.Assign | ast.AnnAssign):
        found = (n for n in ast.walk(node) if isinstance(n, ast.Name))
        return [name.id for name in found if isinstance(name.ctx, ast.Store)]
    return []


def _merged(imports: Iterable[list[ast.Import | ast.ImportFrom]]) -> list[str]:
    """Imports of several modules as lines, each name once."""
    plain: set[str] = set()
    members: dict[str, set[str]] = {}
    for node in itertools.chain.from_iterable(imports):
        named = {ast.unparse(alias) for alias in node.names}
        if isinstance(node, ast.Import):
            plain |= named
        else:
            members.setdefault(node.module or "", set()).update(named)
    return [
        *(f"import {name}" for name in sorted(plain)),
        *(
            f"from {module} import {', '.join(sorted(names))}"
            for module, names in sorted(members.items())
        ),
    ]
