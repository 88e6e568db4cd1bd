"""Takes the pictures in the workbench's README: FreeCAD itself, pressed through by its test.

usage: python scripts/freecad_pictures.py
"""

import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parent.parent
TARGET = ROOT / "freecad_workbench" / "docs"

#: The pictures that the README shows.
SHOWN = ("new_kit", "joint", "frame", "explode", "check", "export")

#: Width in pixels and number of colours: small files that can still be read.
WIDTH, COLOURS = 960, 256


def main() -> None:
    """Press every button, and keep what the window looked like."""
    sys.path.append(str(ROOT / "tests"))
    from workbench import press_everything

    with tempfile.TemporaryDirectory(prefix="scadgen-") as place:
        _, _, folder = press_everything(Path(place))
        TARGET.mkdir(exist_ok=True)
        for name in SHOWN:
            with Image.open(folder / f"{name}.png") as picture:
                size = (WIDTH, round(picture.height * WIDTH / picture.width))
                small = picture.convert("RGB").resize(size, Image.Resampling.LANCZOS)
                drawn = small.quantize(COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
                drawn.save(TARGET / f"{name}.png", optimize=True)
                print(f"{TARGET / name}.png")


if __name__ == "__main__":
    main()
