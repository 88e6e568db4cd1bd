"""The frames in examples/frames are what their script draws, and fit to be built."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from scadgen.check.frame import rings as build_of
from scadgen.cli.main import main
from scadgen.emit.frame_picture import frame_svg
from scadgen.frame.classes import classify
from scadgen.frame.joints import least_ring_ratio
from scadgen.plane.catalogue import named
from scadgen.plane.snapping import move_vertices
from scadgen.readers.read import read

ROOT = Path(__file__).parent.parent
FRAMES = ROOT / "examples" / "frames"

#: Vertices, edges, smallest angle in degrees, shortest edge in mm.
FACTS = {
    "cells.json": (26, 33, 90, 49.99),
    "crosses.svg": (89, 96, 90, 40),
    "net.json": (44, 108, 35, 40),
    "rough.svg": (22, 27, 117, 68),
    "star.svg": (142, 172, 72, 40),
    "tiling.json": (73, 126, 60, 60),
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
    assert least_ring_ratio(frame.ends.gap) < 1.5


def test_there_are_no_other_examples():
    assert {path.name for path in FRAMES.iterdir()} == set(FACTS)


def test_the_star_pattern_has_few_kinds_of_parts():
    # Joints: crossings, notches of stars, tips at the rim, and the inner corners of kites.
    same = classify(read(FRAMES / "star.svg").frame)
    assert len(same.joints) == 4
    # Lines of stars and the two long sides of kites are equally long; the short sides are
    # that over the golden ratio.
    golden = (1 + 5**0.5) / 2
    assert sorted({edge.length for edge in same.edges}) == pytest.approx([40, 40 * golden])


def test_stars_and_crosses_have_right_angles_at_all_tips():
    frame = read(FRAMES / "crosses.svg").frame
    same = classify(frame)
    assert len({round(edge.length, 4) for edge in same.edges}) == 1
    # Two stars touch at each of 7 tips; all other corners have two edges.
    assert np.count_nonzero(frame.degree == 4) == 7
    gaps = np.degrees(frame.ends.gap)
    assert np.abs(gaps[:, None] - [90, 135, 225, 270]).min(axis=1) == pytest.approx(0, abs=1e-3)


def test_the_one_drawn_by_hand_is_hexagons_when_it_is_snapped():
    rough = read(FRAMES / "rough.svg").frame
    found = move_vertices(rough, 2.0)
    hexagons = classify(named("hexagonal", rows=2, columns=3))
    assert found.after == (len(hexagons.joints), len(hexagons.edges)) == (2, 3)
    assert found.before == (22, 27)


@pytest.mark.parametrize("name", [Path(name).stem for name in FACTS])
def test_each_example_has_its_picture(name):
    (path,) = FRAMES.glob(f"{name}.*")
    frame = read(path).frame
    drawn = ROOT / "docs" / "pictures" / f"frame_{name}.svg"
    assert drawn.read_text() == frame_svg(frame, classify(frame))


def test_the_gallery_has_each_example_with_its_facts():
    text = (ROOT / "examples" / "README.md").read_text()
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in text.splitlines()
        if line.startswith("| [") and "](frames/" in line
    ]
    assert len(rows) == len(FACTS) >= 6
    for link, elements, joints, joint_kinds, edge_kinds, side in rows:
        name = link[1 : link.index("]")]
        frame = read(FRAMES / name).frame
        same = classify(frame)
        assert (int(elements), int(joints)) == (len(frame.edges), len(frame.vertices))
        assert (int(joint_kinds), int(edge_kinds)) == (len(same.joints), len(same.edges))
        largest = build_of(frame, same).largest_side
        assert float(side) == pytest.approx(largest, abs=0.1)
        assert float(side) <= largest
        assert f"../docs/pictures/frame_{Path(name).stem}.svg" in text
        assert f"    scadgen frame examples/frames/{name} " in text


def test_every_command_of_the_gallery_works(tmp_path, monkeypatch, capsys):
    text = (ROOT / "examples" / "README.md").read_text()
    commands = [line.split() for line in text.splitlines() if line.startswith("    scadgen frame ")]
    assert len(commands) >= len(FACTS)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    (tmp_path / "out").mkdir()
    for words in commands:
        with pytest.raises(SystemExit) as ended:
            main(words[1:])
        assert ended.value.code == 0, (words, capsys.readouterr())
    drawn = {path.name for path in (tmp_path / "out").iterdir()}
    assert {f"{Path(name).stem}.svg" for name in FACTS} <= drawn


def test_the_script_draws_them_again(tmp_path):
    script = ROOT / "scripts" / "frames.py"
    environment = {"PYTHONPATH": str(ROOT), "PATH": ""}
    subprocess.run([sys.executable, script, tmp_path], check=True, timeout=60, env=environment)
    for name in FACTS:
        again, there = read(tmp_path / name).frame, read(FRAMES / name).frame
        assert np.array_equal(again.edges, there.edges)
        assert again.plan == pytest.approx(there.plan, abs=0.01)
