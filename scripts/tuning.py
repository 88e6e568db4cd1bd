"""Plot what searches for weaves have found: play against the thinnest section of the arms.

usage: scripts/tuning.py [RECORD...]
Takes up the proved weaves of `scadgen tune --record` into docs/tuning.json, and draws that into
docs/pictures/tuning.svg.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt

from scadgen.joint.weave import BUILT_IN, SHAPE

DOCS = Path(__file__).parents[1] / "docs"

#: One colour a number of edges, one mark a key style.
COLOURS = {"2": "#4477aa", "3": "#ee6677", "4": "#228833", "5": "#aa3377", "6": "#ccbb44"}
MARKS = {"fixed": "o", "loose": "s"}


def proved(record: Path) -> tuple[str, list[dict[str, Any]]]:
    """The joint that a record is for, and the weaves in it that are proved."""
    head, *lines = (json.loads(line) for line in record.read_text("utf-8").splitlines())
    found = [
        {**dict(zip(SHAPE, shape, strict=True)), "play": f["play"], "arm": f["arm"]}
        for kind, shape, f in lines
        if kind == "proof" and not f["refused"]
    ]
    return f"{head['valence']}-{head['key']}", found


def merged(known: dict[str, list[dict[str, Any]]], records: list[Path]) -> None:
    """Take records up into what is known, the tightest first."""
    for name, found in map(proved, records):
        every = {tuple(one.values()): one for one in (*known.get(name, []), *found)}
        known[name] = sorted(every.values(), key=lambda one: (one["play"], -one["arm"]))


def plot(known: dict[str, list[dict[str, Any]]], path: Path) -> None:
    """Every proved weave; a line along those that no other beats, a ring around the built-in."""
    mpl.rcParams.update({"svg.hashsalt": "scadgen", "font.size": 9})
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for name, found in sorted(known.items()):
        valence, key = name.split("-")
        colour, mark = COLOURS[valence], MARKS[key]
        axes.plot(*points(found), mark, color=colour, alpha=0.35, markersize=3.5)
        best = [one for n, one in enumerate(found) if one["arm"] > max_arm(found[:n])]
        line = "-" if key == "fixed" else "--"
        axes.plot(*points(best), line, color=colour, marker=mark, markersize=4.5, label=name)
        shape = BUILT_IN[name].shape
        chosen = [one for one in found if tuple(one[n] for n in SHAPE) == shape]
        axes.plot(*points(chosen), "o", color=colour, markersize=11, fillstyle="none")
    axes.set(
        xlabel="thinnest section of the arms, in sides",
        ylabel="play of a tube's tip, mm for each mm of clearance",
        yscale="log",
        yticks=(5, 10, 20, 40),
        yticklabels=("5", "10", "20", "40"),
    )
    axes.grid(alpha=0.3)
    axes.legend(title="edges-key", ncols=2)
    figure.savefig(path, metadata={"Date": None})


def points(found: list[dict[str, Any]]) -> tuple[list[float], list[float]]:
    """Coordinates of weaves in the plot."""
    return [one["arm"] for one in found], [one["play"] for one in found]


def max_arm(found: list[dict[str, Any]]) -> float:
    """Thickest arm among weaves."""
    return max((one["arm"] for one in found), default=0.0)


if __name__ == "__main__":
    file = DOCS / "tuning.json"
    tuning = json.loads(file.read_text("utf-8")) if file.exists() else {}
    merged(tuning, [Path(name) for name in sys.argv[1:]])
    text = ",\n".join(
        f' "{name}": [\n' + ",\n".join(f"  {json.dumps(one)}" for one in found) + "\n ]"
        for name, found in sorted(tuning.items())
    )
    file.write_text("{\n" + text + "\n}\n", encoding="utf-8")
    plot(tuning, DOCS / "pictures" / "tuning.svg")
