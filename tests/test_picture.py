"""Pictures of kits: what is in them, and where."""

import io
from dataclasses import replace

import numpy as np
import pytest
from kits import kit, proved_kit
from PIL import Image
from stub_kit import stub_kit

from scadgen.emit.picture import (
    COLOURS,
    assembly_picture,
    frame_picture,
    joint_picture,
    parts_picture,
    preview,
)
from scadgen.errors import InputError

PAPER = (250, 250, 248)
SMALL = (320, 240)


def pixels(png):
    return np.array(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)


def covered(image):
    return (np.abs(image - PAPER) > 3).any(axis=2)


def shows(image, role):
    """Whether many pixels have a role's hue: shading scales all three channels alike."""
    drawn = image[covered(image)].astype(float)
    wanted = np.array(COLOURS[role], dtype=float)
    cosine = drawn @ wanted / np.linalg.norm(wanted) / np.linalg.norm(drawn, axis=1)
    return (cosine > 0.9995).sum() > 30


def blobs(image):
    """Number of separate things in a picture, specks left out."""
    rest = covered(image)
    count = 0
    while rest.any():
        blob = np.zeros_like(rest)
        blob.flat[rest.argmax()] = True
        size = 0
        while blob.sum() > size:
            size = blob.sum()
            for axis in (0, 1):
                for step in (1, -1):
                    blob |= np.roll(blob, step, axis) & rest
        rest = rest & ~blob
        count += size > 20
    return count


@pytest.mark.parametrize("frame", ["hexagonal", "square"])
@pytest.mark.parametrize("key", ["fixed", "loose"])
def test_preview_shows_every_role_and_has_the_default_size(frame, key):
    image = pixels(preview(stub_kit(frame, key=key)))
    assert image.shape == (750, 1000, 3)
    for role in COLOURS:
        assert shows(image, role), role


def test_preview_has_the_joint_twice_and_each_element_once():
    kit = stub_kit()
    # The stub's joint is one lump when whole, and five pieces when pulled apart.
    whole = blobs(pixels(joint_picture(kit, size=SMALL)))
    apart = blobs(pixels(joint_picture(kit, 3.5, size=SMALL)))
    assert whole < apart
    assert blobs(pixels(preview(kit, size=(640, 480)))) == whole + apart + 2


def test_pieces_of_a_joint_move_apart():
    kit = stub_kit()
    pictures = [joint_picture(kit, explode, size=SMALL) for explode in (0.0, 0.5, 2.0)]
    empty = [1 - covered(pixels(png)).mean() for png in pictures]
    assert empty[0] < empty[2]
    assert len(set(pictures)) == 3


@pytest.mark.parametrize("explode", [-0.1, float("nan"), 1e9])
def test_explosion_out_of_range_is_an_input_error(explode):
    with pytest.raises(InputError, match=r"explode = .*: must be 0 to 100 sides"):
        joint_picture(stub_kit(), explode)


def test_long_tubes_do_not_dwarf_the_joint():
    kit = stub_kit()
    long, longer = (replace(kit, values={**kit.values, "edge_length": x}) for x in (300.0, 400.0))
    assert preview(long, size=SMALL) == preview(longer, size=SMALL)
    assert frame_picture(long, size=SMALL) != frame_picture(longer, size=SMALL)


def test_parts_are_apart_from_each_other():
    # basic, two_sided; connector, half, peg.
    assert blobs(pixels(parts_picture(stub_kit(), size=(640, 480)))) == 5


def test_frame_grows_with_its_cells():
    one = pixels(frame_picture(stub_kit(rows=1, columns=1), size=SMALL))
    wide = pixels(frame_picture(stub_kit(rows=1, columns=4), size=SMALL))

    def aspect(image):
        drawn = covered(image)
        return drawn.any(axis=0).sum() / drawn.any(axis=1).sum()

    assert aspect(wide) > 1.5 * aspect(one)


def test_frame_shows_rows_crosses_halves_and_caps():
    # The stub's pegs are hidden in its tubes.
    image = pixels(frame_picture(stub_kit(rows=1, columns=1)))
    for role in sorted(set(COLOURS) - {"peg"}):
        assert shows(image, role), role


def test_same_kit_same_bytes():
    assert preview(stub_kit(), size=SMALL) == preview(stub_kit(), size=SMALL)


def test_assembly_shows_each_step_with_what_comes_in():
    made = proved_kit("hexagonal")
    image = pixels(assembly_picture(made, size=(900, 600)))
    # Four steps of two things each, some of which hide behind each other.
    assert 4 <= blobs(image) <= 8
    for role in ("half_a", "half_b", "peg", "cap"):
        assert shows(image, role)
    top, bottom = image[:300], image[300:]
    assert not shows(top, "peg")
    assert shows(bottom, "peg")


def test_an_unchecked_kit_has_no_assembly_to_show():
    with pytest.raises(InputError, match="unchecked"):
        assembly_picture(kit("hexagonal"))
