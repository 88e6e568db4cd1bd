"""Drawings as Chromium shows them: all of them in one page, by one start of it."""

import subprocess

import numpy as np
from PIL import Image
from scipy.ndimage import distance_transform_edt

__all__ = ["SIDE", "edges", "lines", "off", "rendered"]

#: Pixels of a side of each picture, and pictures in a row.
SIDE, ROW = 320, 8

#: It starts alone, asks nobody for anything, and shows pixels as they are.
QUIET = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
    "--force-device-scale-factor=1",
]


def rendered(folder, drawings):
    """Pictures of drawings, ``{name: (SIDE, SIDE, 3) int}``, each from its text and its page.

    A page, width and height, is as wide as its picture, and at its top.
    """
    shown = []
    for number, (text, (wide, high)) in enumerate(drawings.values()):
        (folder / f"{number}.svg").write_text(text)
        across, down = number % ROW * SIDE, number // ROW * SIDE
        shown.append(
            f'<img src="{number}.svg" style="position:absolute;left:{across}px;top:{down}px;'
            f'width:{SIDE}px;height:{SIDE * high / wide}px">'
        )
    page = folder / "page.html"
    page.write_text(f"<!doctype html><body style='margin:0;background:#fff'>{''.join(shown)}")
    height = -(-len(drawings) // ROW) * SIDE
    picture = folder / "page.png"
    command = ["chromium", *QUIET, f"--user-data-dir={folder / 'profile'}"]
    command += [f"--window-size={ROW * SIDE},{height}", f"--screenshot={picture}", page.as_uri()]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    whole = np.asarray(Image.open(picture).convert("RGB")).astype(int)
    return {
        name: whole[n // ROW * SIDE :, n % ROW * SIDE :][:SIDE, :SIDE]
        for n, name in enumerate(drawings)
    }


def edges(picture):
    """Where colours change from one pixel to the next, ``(SIDE, SIDE) bool``."""
    found = np.zeros(picture.shape[:2], dtype=bool)
    for axis in (0, 1):
        jump = np.abs(np.diff(picture, axis=axis)).sum(axis=2) > 60
        pad = [(0, 0), (0, 0)]
        for pad[axis] in ((0, 1), (1, 0)):
            found |= np.pad(jump, pad)
    return found


def lines(frame, page):
    """Points along the edges of a frame in a picture of a page, ``(k, 2) float``, in pixels."""
    width, height = page
    start, end = frame.plan[frame.edges].transpose(1, 0, 2) * [1, -1] + [0, height]
    start, end = (points * SIDE / width for points in (start, end))
    counts = np.ceil(np.linalg.norm(end - start, axis=1)).astype(int) + 1
    return np.concatenate(
        [
            a + np.linspace(0, 1, n)[:, None] * (b - a)
            for a, b, n in zip(start, end, counts, strict=True)
        ]
    )


def off(picture, points):
    """How far lines are from edges in a picture at most, and edges from lines, in pixels.

    The rim of the picture is no edge: what ends there may be seen or not.
    """
    seen = edges(picture)
    inside = ((points > 1) & (points < SIDE - 1)).all(axis=1)
    cells = points[inside].astype(int)
    drawn = np.zeros_like(seen)
    drawn[cells[:, 1], cells[:, 0]] = True
    rim = np.ones_like(seen)
    rim[3:-3, 3:-3] = False
    to_seen = distance_transform_edt(~seen)[drawn & ~rim]
    on_rim = np.zeros_like(seen)
    rest = points.round().astype(int).clip(0, SIDE - 1)
    on_rim[rest[:, 1], rest[:, 0]] = True
    to_drawn = distance_transform_edt(~(drawn | on_rim))[seen & ~rim]
    return float(to_seen.max(initial=0)), float(to_drawn.max(initial=0))
