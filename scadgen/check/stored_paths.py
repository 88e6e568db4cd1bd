"""Ways out of the built-in joints that are known, so that a kit need not search for them.

They are taken on trust by nothing: each is proved again for the kit at hand.
"""

from __future__ import annotations

import json
from functools import cache
from importlib import resources
from typing import Any

from scadgen.kit.model import Joint, Kit, Way
from scadgen.kit.ways import read_way

__all__ = ["key_of", "known_ways"]


def known_ways(kit: Kit, joint: Joint) -> tuple[Way, ...]:
    """The known ways out of a joint, which may do; none for one that is not built in."""
    return tuple(map(read_way, _file().get(key_of(kit, joint), ())))


def key_of(kit: Kit, joint: Joint) -> str:
    """What tells a joint from all others."""
    shape = [f"{value:g}" for name, value in joint.weave.items() if name != "name"]
    return " ".join([str(len(joint.turns)), kit.key, kit.detail, *shape])


@cache
def _file() -> dict[str, list[dict[str, Any]]]:
    text = resources.files(__package__).joinpath("ways.json").read_text("utf-8")
    found: dict[str, list[dict[str, Any]]] = json.loads(text)
    return found
