"""Whether the workbench works in this FreeCAD: ``freecadcmd -t freecad.scadgen.self_test``.

FreeCAD's Test workbench lists it as well.  The kit here is a square frame of plain boxes, whose
volumes anyone can work out: in each cell a tube along its lower side, and what joins it there.
"""

from __future__ import annotations

import json
import tempfile
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import FreeCAD as App

from freecad.scadgen import document, part_object
from freecad.scadgen.kit_data import KitError

__all__ = ["BoxesTest"]

_VALUES = {
    "side": 10.0,
    "edge_length": 60.0,
    "clearance": 0.2,
    "peg_width": 4.0,
    "peg_length": 6.0,
    "peg_clearance": 0.2,
    "peg_chamfer": 0.5,
}

_WEAVE = {"ring_ratio": 2.0, "span": 0.9, "amplitude": 0.3, "bend": 0.7, "periods": 1.2}

#: Parts of the kit: what each is for, and its length in sides and edge lengths.
_PARTS = {
    "basic": ("element", -2, 1),
    "connector": ("connector", 1, 0),
    "half": ("half", 2, 0),
    "peg": ("peg", 1, 0),
    "tube": ("tube", 3, 0),
}


class BoxesTest(unittest.TestCase):
    """A kit of boxes as objects of a document."""

    def setUp(self) -> None:
        """Begin with a document that has the kit."""
        self.doc = App.newDocument("ScadgenSelfTest")
        self.kit = document.add_kit(self.doc, _kit())

    def tearDown(self) -> None:
        """Leave no document."""
        App.closeDocument(self.doc.Name)

    def add(self, kind: str) -> Any:
        """A part, made."""
        part = document.add_part(self.kit, kind)
        self.doc.recompute()
        return part

    def test_every_part_is_a_sound_solid_of_the_right_volume(self) -> None:
        for kind in _PARTS:
            part = self.add(kind)
            self.assertTrue(part.Shape.isValid() and part.Shape.isClosed(), kind)
            self.assertAlmostEqual(part.Shape.Volume, _volume(kind, 0.2), 6, kind)

    def test_a_part_follows_its_kit_until_it_has_its_own(self) -> None:
        half = self.add("half")
        self.kit.Clearance = "0.4 mm"
        self.doc.recompute()
        self.assertAlmostEqual(half.Shape.Volume, _volume("half", 0.4), 6)
        part_object.own(half, "clearance", 0.1)
        self.doc.recompute()
        self.assertAlmostEqual(half.Shape.Volume, _volume("half", 0.1), 6)

    def test_a_value_out_of_its_range_keeps_the_shape(self) -> None:
        half = self.add("half")
        part_object.own(half, "clearance", 2.0)
        self.doc.recompute()
        self.assertIn("clearance = 2 mm: must be 0 to 1 mm", half.getStatusString())
        self.assertAlmostEqual(half.Shape.Volume, _volume("half", 0.2), 6)

    def test_a_frame_is_links(self) -> None:
        frame = document.add_frame(self.kit)
        self.doc.recompute()
        # Of 1 x 2 cells: two tubes, a half at the near end of each, and a connector at the rim.
        self.assertEqual(frame.Pieces, 5)
        self.assertEqual({link.TypeId for link in frame.Group}, {"App::Link"})
        self.kit.Columns = 5
        self.doc.recompute()
        self.assertEqual([link.ElementCount for link in frame.Group], [5, 5, 1])
        self.assertEqual(frame.Group[2].PlacementList[0].Base.x, 5 * 60)

    def test_a_saved_document_behaves_when_it_is_opened(self) -> None:
        self.add("half")
        with tempfile.TemporaryDirectory(prefix="scadgen-") as folder:
            path = str(Path(folder) / "kit.FCStd")
            self.doc.saveAs(path)
            App.closeDocument(self.doc.Name)
            self.doc = App.openDocument(path)
        self.doc.Kit.Clearance = 0.4
        self.doc.recompute()
        self.assertAlmostEqual(self.doc.Half.Shape.Volume, _volume("half", 0.4), 6)

    def test_what_is_no_kit_adds_nothing(self) -> None:
        before = len(self.doc.Objects)
        with self.assertRaises(KitError):
            document.add_kit(self.doc, _kit()[:-1])
        self.assertEqual(len(self.doc.Objects), before)


def _volume(kind: str, clearance: float) -> float:
    _, sides, edges = _PARTS[kind]
    length = sides * _VALUES["side"] + edges * _VALUES["edge_length"] - clearance
    return length * _VALUES["side"] ** 2


def _box(role: str, sides: int, edges: int) -> dict[str, Any]:
    """A box from 0 along x, a side wide and high, shortened by the clearance."""
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    points = {
        "side": [[x * sides, y, z] for x, y, z in corners],
        "edge_length": [[x * edges, 0, 0] for x, _, _ in corners],
        "clearance": [[-x, 0, 0] for x, _, _ in corners],
    }
    return {
        "role": role,
        "ends": [{"joint": "", "slot": 0, "over": False}] if role == "half" else [],
        "length": edges,
        "points": points,
        "triangles": [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))],
        "facets": [n // 2 for n in range(12)],
    }


def _piece(
    part: str, role: str, any_of: Sequence[Sequence[int]], none_of: Sequence[Sequence[int]] = ()
) -> dict[str, Any]:
    """A piece of a cell, at its lower left."""
    axes = {"at": [0, 0, 0], "x": [1, 0, 0], "z": [0, 0, 1]}
    return {"part": part, "role": role, **axes, "any_of": any_of, "none_of": none_of}


def _kit() -> str:
    """The text of the kit."""
    ranges = [
        {
            "parameter": name,
            "low": {"terms": {}, "constant": 0.0},
            "high": {"terms": {}, "constant": 5 * value},
            "reason": "larger is not tested",
        }
        for name, value in _VALUES.items()
    ]
    kit = {
        "format": "scadgen-kit",
        "version": 5,
        "name": "boxes",
        "rim": "caps",
        "refused": [],
        "tiling": {"name": "boxes", "options": {}},
        "key": "fixed",
        "detail": "boxes",
        "rows": 1,
        "columns": 2,
        "command": "",
        "values": _VALUES,
        "ranges": ranges,
        "cells": {
            "across": [1, 0],
            "up": [0, 1],
            "drift": 0,
            "pieces": [
                _piece("basic", "row", [[0, 0]]),
                _piece("half", "half_a", [[0, 0]]),
                _piece("connector", "cap", [[-1, 0]], [[0, 0]]),
            ],
        },
        "joints": [
            {
                "name": "",
                "connectors": ["connector"],
                "weave": {"name": "boxes", **_WEAVE},
                "pieces": [_piece("half", "half_a", [])],
            }
        ],
        "parts": {name: _box(*about) for name, about in _PARTS.items()},
    }
    return json.dumps(kit)
