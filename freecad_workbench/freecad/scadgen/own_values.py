"""Lets a part have live parameters of its own, or follow its kit again."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from freecad.scadgen import document
from freecad.scadgen.kit_object import data_of
from freecad.scadgen.part_object import follow, follows, own
from freecad.scadgen.tables import LENGTHS

__all__ = ["add_actions", "follow_kit", "own_clearance"]

translate = App.Qt.translate


def own_clearance(part: Any) -> None:
    """Let a part have a clearance of its own; it begins with the kit's."""
    with document.one_step(part.Document, translate("Scadgen", "Own clearance")):
        own(part, "clearance")


def follow_kit(part: Any) -> None:
    """Let all live parameters of a part be the kit's again."""
    with document.one_step(part.Document, translate("Scadgen", "Follow the kit")):
        for name in data_of(part.Kit).values:
            follow(part, name)


def add_actions(part: Any, menu: Any) -> None:
    """Add what can be done to a part's menu in the tree."""
    if part.Kit is None:
        return
    if follows(part, "clearance"):
        text = translate("Scadgen", "Give it a clearance of its own")
        menu.addAction(text).triggered.connect(lambda *_: own_clearance(part))
    if not all(follows(part, name) for name in LENGTHS if name in data_of(part.Kit).values):
        text = translate("Scadgen", "Let it follow its kit again")
        menu.addAction(text).triggered.connect(lambda *_: follow_kit(part))
