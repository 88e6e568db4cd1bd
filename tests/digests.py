"""Digests of the parts of many kits, which tell whether any vertex of any of them moved.

A digest of a part is the hash of its triangles, and a few sums of each of its tables: every entry
times a fixed random factor, from 1 to 2 or from -2 to -1.  A coordinate that moves moves each sum
by as much or more.  Tables are rounded to 9 decimals, so that two ways to compute one point may
differ by 1e-9 sides; sums may differ by the few of these that there are.

    python tests/digests.py

writes those of this tree to tests/digests.json.
"""

import hashlib
import json
from pathlib import Path

import numpy as np

from scadgen.api.request import kit_request
from scadgen.cli.kit import kit as command
from scadgen.frame.placement import bill
from scadgen.kit.build import build
from scadgen.kit.live import PARAMETERS
from scadgen.work.executor import open_executor
from scadgen.work.mapping import Execution

__all__ = ["DRAWN", "FILE", "GRIDS", "SUMS", "digest", "made"]

#: Where the digests are.
FILE = Path(__file__).with_name("digests.json")

#: Sums of each table, and how far they may differ, in sides.
_COUNT, SUMS = 2, 1e-8

_FOLDER = Path(__file__).parents[1] / "examples" / "frames"

#: Arguments of `scadgen kit` for kits with rows and columns, by name.
GRIDS = {
    f"{frame} {key}{' bored' if bore else ''}": [frame, "--key", key, *bore]
    for frame in ("hexagonal", "square")
    for key in ("fixed", "loose")
    for bore in ([], ["--bore", "1.5"])
}

#: And for others.
DRAWN = {
    **{name: [name] for name in ("ladder", "3.4.6.4", "4.8.8", "cairo")},
    "net": [str(_FOLDER / "net.json"), "--scale", "2", "--side", "6"],
    "trellis": [str(_FOLDER / "trellis.json"), "--side", "6"],
}


def made(arguments, means=None):
    """The kit that `scadgen kit` makes of some arguments; not proved."""
    with command.make_context("kit", list(arguments)) as context:
        options = dict(context.params)
    request, _ = kit_request(options.pop("frame"), _own(options), set(PARAMETERS), "")
    return build(request, means)


def _own(options):
    """What of the options of `scadgen kit` says what kit to make."""
    others = ("output", "material", "unchecked", "jobs", "dask", "no_cache", "as_json")
    return {name: value for name, value in options.items() if name not in others}


def digest(kit):
    """The digest of every part of a kit, and how many of each its frame takes."""
    return {
        "bill": bill(kit.placements, kit.parts),
        "parts": {
            name: {
                "triangles": hashlib.sha256(solid.triangles.astype("<i8").tobytes()).hexdigest()[
                    :16
                ],
                "sums": {p: _sums(table) for p, table in sorted(solid.coefficients.items())},
            }
            for name, solid in kit.parts.items()
        },
    }


def _sums(table):
    """Sums of a table's entries times fixed factors."""
    rng = np.random.Generator(np.random.PCG64(table.size))
    factors = rng.uniform(1, 2, (_COUNT, table.size)) * rng.choice([-1, 1], (_COUNT, table.size))
    return [round(float(one), 10) for one in factors @ table.ravel()]


def _write():
    """Write the digests of this tree."""
    told = []
    with open_executor(None, None, told.append) as crew:
        found = {
            f"{name} {detail}": digest(made([*arguments, "--detail", detail], Execution(crew)))
            for name, arguments in (GRIDS | DRAWN).items()
            for detail in ("draft", "standard")
        }
    lines = (f'"{name}": {json.dumps(one)}' for name, one in found.items())
    FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    _write()
