"""The options of frames that commands have."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

import click

from scadgen.api.options import FAMILY, READING, SNAP, Option, option
from scadgen.cli.length import LENGTH

__all__ = ["source_options"]

#: What click makes of the values of each kind of option.
_TYPES: dict[str, Any] = {"length": LENGTH, "whole": int, "number": float, "text": str}


def source_options(
    without: Collection[str] = (),
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Give a command the options of named frames and of files, and of what is done to either.

    Parameters
    ----------
    without
        Names of options that the command has already.
    """

    def add(function: Callable[..., Any]) -> Callable[..., Any]:
        function = click.option(
            "--snap",
            type=LENGTH,
            metavar="MM",
            help=f"{SNAP.text[0].upper()}{SNAP.text[1:]}.",
        )(function)
        for name, one in reversed([*READING.items()]):
            function = _added(function, name, one, f"Files: {one.text}")
        for name, one in reversed([*FAMILY.items()]):
            if name not in without:
                function = _added(function, name, one, f"Named frames: {one.text}.")
        return function

    return add


def _added(function: Callable[..., Any], name: str, one: Option, text: str) -> Callable[..., Any]:
    form: dict[str, Any] = (
        {"is_flag": True}
        if one.kind == "flag"
        else {"type": _TYPES[one.kind], "metavar": one.metavar}
    )
    return click.option(option(name), name, help=text, **form)(function)
