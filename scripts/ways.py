"""Find the ways out of the built-in joints that `scadgen kit` need not search for then.

usage: scripts/ways.py [VALENCE | DETAIL]...
Writes scadgen/check/ways.json; ways of other joints than those named stay as they are, and one
that is there and holds is where a wider one is looked for.
"""

from __future__ import annotations

import itertools
import json
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

from scadgen.check.disassembly import come_apart
from scadgen.check.stored_paths import key_of, known_ways
from scadgen.frame.placement import KEYS
from scadgen.joint.joint import DETAILS
from scadgen.joint.weave import BUILT_IN
from scadgen.kit.build import build_joint
from scadgen.kit.model import Way
from scadgen.kit.ways import way_entry

FILE = Path(__file__).parents[1] / "scadgen" / "check" / "ways.json"


def found(joint: tuple[int, str]) -> dict[str, list[dict[str, Any]]]:
    """The ways of a joint's pieces out of it in both key styles, by what tells it from others."""
    valence, detail = joint
    entries: dict[str, list[dict[str, Any]]] = {}
    known: list[Way] = []  # connectors come apart alike in both
    for key in KEYS:
        name = f"{valence}-{key}"
        kit = build_joint(valence, BUILT_IN[name], key, detail)
        (joint_kind,) = kit.joints
        known += known_ways(kit, joint_kind)
        ways = []
        for result, way in come_apart(kit, joint_kind, known, roomy=True):
            print(name, detail, result.check, result.figure, file=sys.stderr, flush=True)
            if way is None:
                sys.exit(f"{name} {detail}: stuck")
            ways.append(way)
        entries[key_of(kit, joint_kind)] = [way_entry(way) for way in ways]
        known = ways
    return entries


def main(words: list[str]) -> None:
    """Find the ways of all joints, or of those that some words name."""
    names = sorted({int(name.split("-")[0]) for name in BUILT_IN})
    joints = [
        (valence, detail)
        for detail, valence in itertools.product(DETAILS, names)
        if not words or (str(valence) in words or detail in words)
    ]
    ways = json.loads(FILE.read_text("utf-8"))
    with ProcessPoolExecutor() as workers:
        for entries in workers.map(found, joints):
            ways |= entries
            lines = [f"{json.dumps(name)}: {json.dumps(ways[name])}" for name in sorted(ways)]
            FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
