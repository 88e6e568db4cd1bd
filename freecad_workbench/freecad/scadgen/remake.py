"""What makes the kit of a document again, by all that the document says of it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from freecad.scadgen.kit_data import KitData
from freecad.scadgen.kit_object import data_of
from freecad.scadgen.properties import refuse, values_of

__all__ = ["remaking"]


def remaking(kit: Any, folder: Path) -> list[str]:
    """Arguments of ``scadgen`` that make a kit again at its present values, rows and columns.

    Parameters
    ----------
    kit
        The kit object.
    folder
        Where the kit is made, as ``kit``; what the arguments refer to is written there now.

    Returns
    -------
    arguments
        They say all that the kit does; nothing of it is read where it came from.

    Raises
    ------
    KitError
        A value is out of its range.
    """
    data = data_of(kit)
    values = values_of(kit, data)
    refuse(data, values)
    words = ["kit", *_frame(kit, data, folder), "--output", str(folder / "kit")]
    words += ["--key", data.key, "--detail", data.detail, "--rim", data.rim]
    for name, value in values.items():
        words += [_option(name), repr(value)]
    # The check proves it anyway; but keys that follow from a proof do so again.
    return words if data.has_refused else [*words, "--unchecked"]


def _frame(kit: Any, data: KitData, folder: Path) -> list[str]:
    """Arguments that name a kit's frame: a tiling, or the file that it is written to."""
    if data.tiling is None:
        path = folder / f"{data.name}.json"
        path.write_text(json.dumps(data.frame), encoding="utf-8")
        return [str(path)]
    words = [data.tiling["name"], "--rows", str(kit.Rows), "--columns", str(kit.Columns)]
    for name, value in data.tiling["options"].items():
        words += [_option(name), repr(value)]
    if data.is_regular:
        weave = data.joints[0]["weave"]
        path = folder / "weave.json"  # a name in the document may lead elsewhere
        numbers = {name: value for name, value in weave.items() if name != "name"}
        path.write_text(json.dumps(numbers), encoding="utf-8")
        words += ["--weave", str(path)]
    return words


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"
