"""Find the ways out of the built-in joints that `scadgen kit` need not search for then.

usage: scripts/ways.py
Writes scadgen/check/ways.json; a way that is there and still holds is kept.
"""

from __future__ import annotations

import itertools
import json
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

from scadgen.check.known import key_of, known_ways
from scadgen.check.ways import come_apart
from scadgen.joint.joint import DETAILS
from scadgen.joint.weave import BUILT_IN
from scadgen.kit.build import build_joint
from scadgen.kit.store import way_entry

FILE = Path(__file__).parents[1] / "scadgen" / "check" / "ways.json"


def found(joint: tuple[str, str]) -> tuple[str, list[dict[str, Any]]]:
    """The ways of a joint's pieces out of it, by what tells it from all others."""
    name, detail = joint
    valence, key = name.split("-")
    kit = build_joint(int(valence), BUILT_IN[name], key, detail)
    known, ways = known_ways(kit), []
    for result, way in come_apart(kit, known, roomy=not known):
        print(name, detail, result.check, result.figure, file=sys.stderr, flush=True)
        if way is None:
            sys.exit(f"{name} {detail}: stuck")
        ways.append(way_entry(way))
    return key_of(kit), ways


if __name__ == "__main__":
    with ProcessPoolExecutor() as workers:
        ways = dict(workers.map(found, itertools.product(BUILT_IN, DETAILS)))
    lines = [f"{json.dumps(name)}: {json.dumps(entries)}" for name, entries in ways.items()]
    FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
