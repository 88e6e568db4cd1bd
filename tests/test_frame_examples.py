"""The frames in examples/frames are what their script draws, and fit to be built."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from scadgen.frame.joints import check_ring_ratios
from scadgen.frame.sameness import sameness
from scadgen.readers.read import read

ROOT = Path(__file__).parent.parent
FRAMES = ROOT / "examples" / "frames"

#: Vertices, edges, smallest angle in degrees, shortest edge in mm.
FACTS = {
    "net.json": (44, 108, 35, 40),
    "star.svg": (142, 172, 72, 40),
    "trellis.json": (24, 38, 90, 60),
}


@pytest.mark.parametrize("name", FACTS)
def test_an_example_is_fit_to_be_built(name):
    result = read(FRAMES / name)
    frame = result.frame
    vertices, edges, angle, length = FACTS[name]
    assert result.notes == ()
    assert (len(frame.vertices), len(frame.edges)) == (vertices, edges)
    assert np.degrees(frame.ends.gap.min()) > angle - 1e-5
    assert frame.lengths.min() > length - 1e-5
    check_ring_ratios(frame, 1.5)


def test_there_are_no_other_examples():
    assert {path.name for path in FRAMES.iterdir()} == set(FACTS)


def test_the_star_pattern_has_few_kinds_of_parts():
    # Joints: crossings, notches of stars, tips at the rim, and the inner corners of kites.
    same = sameness(read(FRAMES / "star.svg").frame)
    assert len(same.joints) == 4
    # Lines of stars and the two long sides of kites are equally long; the short sides are
    # that over the golden ratio.
    golden = (1 + 5**0.5) / 2
    assert sorted({edge.length for edge in same.edges}) == pytest.approx([40, 40 * golden])


def test_the_script_draws_them_again(tmp_path):
    script = ROOT / "scripts" / "frames.py"
    environment = {"PYTHONPATH": str(ROOT), "PATH": ""}
    subprocess.run([sys.executable, script, tmp_path], check=True, timeout=60, env=environment)
    for name in FACTS:
        again, there = read(tmp_path / name).frame, read(FRAMES / name).frame
        assert np.array_equal(again.edges, there.edges)
        assert again.vertices == pytest.approx(there.vertices, abs=0.01)
