"""Pictures of kits: what is in them, and where."""

import io
from dataclasses import replace

import numpy as np
import pytest
from kits import kit, proved_kit
from PIL import Image
from stub_kit import stub_kit

from scadgen.emit.letters import written
from scadgen.emit.picture import (
    assembly_picture,
    frame_picture,
    joint_picture,
    parts_picture,
    preview,
)
from scadgen.emit.readme import readme
from scadgen.errors import InputError
from scadgen.frame.classes import joint_name
from scadgen.kit.roles import COLOURS

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


def several(made, count):
    """A kit with its joint as so many kinds."""
    (one,) = made.joints
    return replace(made, joints=tuple(replace(one, name=joint_name(n)) for n in range(count)))


@pytest.mark.parametrize(("count", "shown"), [(5, 5), (7, 7), (16, 16), (30, 16)])
def test_every_kind_of_joint_is_shown_up_to_a_limit(count, shown):
    image = pixels(joint_picture(several(stub_kit(), count), size=(800, 600)))
    # Each has one letter above it, of dots that touch.
    alone = blobs(pixels(joint_picture(stub_kit(), size=SMALL)))
    assert blobs(image) == (alone + 1) * shown
    assert preview(several(stub_kit(), shown)) == preview(several(stub_kit(), count))
    assert ("show the first 16 of" in readme(several(stub_kit(), count))) == (count > shown)


def test_kinds_of_joints_are_named_where_there_are_several():
    first, second = several(stub_kit(), 2).joints
    same, other = (replace(stub_kit(), joints=(first, replace(second, name=n))) for n in "BC")
    assert preview(several(stub_kit(), 2)) == preview(same) != preview(other)
    assert joint_picture(same) != joint_picture(other)


def test_each_kind_of_joint_has_its_steps_in_a_row():
    made = proved_kit("hexagonal")
    image = pixels(assembly_picture(several(made, 3), size=(900, 600)))
    assert image.shape == (3 * 240, 900, 3)
    for third in np.array_split(image, 3):
        for role in ("half_a", "half_b", "peg", "cap"):
            assert shows(third, role)
    assert pixels(assembly_picture(several(made, 30))).shape[0] == 16 * 240


def test_letters_are_dots_that_are_read_from_the_front():
    right, up = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.6, 0.8])
    points, triangles = written("L1", right, up)
    flat = np.column_stack([points @ right, points @ up])
    assert np.ptp(flat, axis=0) == pytest.approx([7 / 5, 1.0])
    # An L has seven dots, a 1 eight: each a square of a fifth.
    a, b, c = (flat[triangles[:, n]] for n in range(3))
    area = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert (area > 0).all()
    assert area.sum() == pytest.approx(15 / 25)
    assert len(written("", right, up)[1]) == 0


def test_an_unchecked_kit_has_no_assembly_to_show():
    with pytest.raises(InputError, match="unchecked"):
        assembly_picture(kit("hexagonal"))
