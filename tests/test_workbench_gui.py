"""The workbench in FreeCAD's own window: every button is pressed, the engine really runs.

One test, as FreeCAD is started once: its steps are in ``freecad/gui.py``.
"""

from PIL import Image
from workbench import PICTURES, press_everything


def test_every_button_does_what_it_says(tmp_path):
    done, said, folder = press_everything(tmp_path)
    assert done[0] == "the_workbench_is_there"
    assert done[-1] == "it_speaks_german"
    assert len(done) == 21, said
    for name in PICTURES:
        with Image.open(folder / f"{name}.png") as picture:
            assert picture.size == (1280, 800)
            assert len(picture.convert("RGB").getcolors(1280 * 800)) > 500, name
    for words in ("no such program", "is not scadgen", "killed or crashed midway", "kit version 6"):
        assert any(words in line for line in said.splitlines()), words
