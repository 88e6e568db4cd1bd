"""Lengths on the command line."""

from __future__ import annotations

import click

from scadgen.api.words import length
from scadgen.errors import InputError

__all__ = ["LENGTH"]


class _Length(click.ParamType[float]):
    """A length on the command line, in mm."""

    name = "length"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        try:
            return length(str(value))
        except InputError as error:
            self.fail(str(error), param, ctx)


#: The type of options that are lengths.
LENGTH = _Length()
