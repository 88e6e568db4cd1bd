"""Find the ways out of the built-in joints that `scadgen kit` need not search for then.

usage: scripts/ways.py
Writes scadgen/check/ways.json; a way that is there and still holds is kept.
"""

from __future__ import annotations

import itertools
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from scadgen.check.known import key_of, known_ways
from scadgen.check.ways import come_apart
from scadgen.joint.joint import DETAILS
from scadgen.joint.weave import BUILT_IN
from scadgen.kit.build import build_joint
from scadgen.kit.store import way_entry

FILE = Path(__file__).parents[1] / "scadgen" / "check" / "ways.json"


def found() -> Iterator[tuple[str, list[dict[str, Any]]]]:
    """Every built-in joint, and the ways of its pieces out of it."""
    for (name, weave), detail in itertools.product(BUILT_IN.items(), DETAILS):
        valence, key = name.split("-")
        kit = build_joint(int(valence), weave, key, detail)
        ways = []
        for result, way in come_apart(kit, known_ways(kit), roomy=True):
            print(name, detail, result.check, result.figure, file=sys.stderr)
            if way is None:
                sys.exit(1)
            ways.append(way_entry(way))
        yield key_of(kit), ways


if __name__ == "__main__":
    FILE.write_text(json.dumps(dict(found()), indent=0) + "\n", encoding="utf-8")
