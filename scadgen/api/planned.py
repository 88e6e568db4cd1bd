"""In which order a frame goes together, with what is proved of it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scadgen.kit import model
from scadgen.plan.as_json import dumps, plan_entry
from scadgen.plan.folder import check_plan_folder, write_plan
from scadgen.plan.model import Plan, Step
from scadgen.plan.order import make_plan
from scadgen.plan.picture import step_pictures
from scadgen.plan.text import plan_text
from scadgen.plan.whole import Whole, whole_frame

__all__ = ["KitPlan", "planned"]

#: Shares of the time after which the order is proved, and the whole frame.
_ORDERED, _HELD = 0.8, 0.95


@dataclass(frozen=True, slots=True, eq=False)
class KitPlan:
    """In which order a frame goes together; `plan` of a kit makes it.

    Parameters
    ----------
    value
        The order, with the way of every piece.
    whole
        What was found of the finished frame.
    """

    value: Plan
    whole: Whole

    @property
    def good(self) -> bool:
        """Whether every step is proved, and the finished frame holds."""
        return self.value.proved and self.whole.held

    @property
    def steps(self) -> tuple[Step, ...]:
        """The steps, in order."""
        return self.value.steps

    @property
    def text(self) -> str:
        """The steps in words, a line each, as ``plan.txt`` has them."""
        return plan_text(self.value, self.whole)

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values; the schema is ``scadgen/plan/plan.schema.json``."""
        return plan_entry(self.value, self.whole)

    def files(self) -> dict[str, str]:
        """The texts of its files, by name: ``plan.json``, ``plan.txt``, a picture a step."""
        pictures = step_pictures(self.value)
        entry = plan_entry(self.value, self.whole, list(pictures))
        return {"plan.json": dumps(entry), "plan.txt": self.text, **pictures}

    def write(self, folder: str | os.PathLike[str]) -> Path:
        """Write its files; those of a plan that is there are replaced.

        Parameters
        ----------
        folder
            Where to.

        Returns
        -------
        folder
            The folder.

        Raises
        ------
        InputError
            The folder is a file, holds something else, or cannot be written.
        """
        place = check_plan_folder(Path(folder))
        write_plan(self.files(), place)
        return place


def planned(kit: model.Kit, say: Callable[[float, str], None] = lambda *_: None) -> KitPlan:
    """Plan in which order a frame goes together, and prove every step.

    Parameters
    ----------
    kit
        The kit.
    say
        Told what share of the time is gone, and what runs now.
    """
    made = make_plan(kit, lambda share, words: say(_ORDERED * share, words))
    say(_ORDERED, "proving that the finished frame holds")
    whole = whole_frame(made.standing)
    say(_HELD, "drawing the steps")
    return KitPlan(made, whole)
