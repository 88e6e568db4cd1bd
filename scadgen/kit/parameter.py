"""What a live parameter is: its words, its default, and what it may be."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from scadgen.element.squares import Key
from scadgen.kit.pieces import Pieces
from scadgen.solid.affine import Range

__all__ = ["Live", "Settings", "Tightest"]

#: Of each edge element the key of the joint at each end, with whether it has a socket there, and
#: its length in edge lengths.
Elements = tuple[tuple[tuple[tuple[Key, bool], ...], float], ...]


@dataclass(frozen=True, slots=True)
class Tightest:
    """What the live parameters of a kit must fit: the tightest of its joints, in sides.

    Parameters
    ----------
    style
        The key style.
    bored
        Whether a bore runs along the edges.
    through
        The longest way of a loose peg through the halves.
    window
        Half the width of the narrowest window in which a socket has room.
    depth
        Of the shallowest socket.
    clearance
        Up to which connectors and halves are proven sound.
    hole
        Free width of the narrowest ring's hole along a key's edge.
    elements
        The edge elements.
    """

    style: str
    bored: bool
    through: float
    window: float
    depth: float
    clearance: float
    hole: float
    elements: Elements = ()

    @classmethod
    def of(cls, pieces: Sequence[Pieces], elements: Elements = ()) -> Tightest:
        """The tightest of joints with these pieces."""
        keys = [one.key for one in pieces]
        return cls(
            style=keys[0].style,
            bored=keys[0].bored,
            through=max(key.tube_start - key.pad for key in keys),
            window=min(key.window for key in keys),
            depth=min(key.depth for key in keys),
            clearance=min(one.clearance_limit for one in pieces),
            hole=min(one.key_hole for one in pieces),
            elements=elements,
        )


@dataclass(frozen=True, slots=True)
class Settings:
    """Live parameters, in mm: those given, and the others as they are by default.

    Parameters
    ----------
    table
        The live parameters.
    tightest
        What they must fit.
    given
        Those that are given.
    """

    table: tuple[Live, ...]
    tightest: Tightest
    given: Mapping[str, float]

    def __getitem__(self, name: str) -> float:
        """One of them."""
        if name in self.given:
            return self.given[name]
        default = next(live.default for live in self.table if live.name == name)
        return default if isinstance(default, float) else default(self)

    def all(self) -> dict[str, float]:
        """All that the kit has, in the order of the table."""
        values = {live.name: self[live.name] for live in self.table}
        return {live.name: values[live.name] for live in self.table if live.is_in(values)}


@dataclass(frozen=True, slots=True)
class Live:
    """A live parameter: a length in mm that can be set once the kit is made.

    Parameters
    ----------
    name
        Its name in all files, a plain identifier.
    text
        What it is.
    section
        The Customizer's tab.
    step
        Of sliders, in mm.
    usual
        What it may be at a side of 10 mm, where it is shown before it is chosen.
    default
        What it is where it is not given; by the others if it follows from them.
    ranges
        What it may be, by the tightest of the joints.
    by_default
        The default in words; what it says if it is a number.
    asked
        What a new kit is asked for, if that is more than the text.
    optional
        Whether kits in which it would be zero do not have it.
    """

    name: str
    text: str
    section: str
    step: float
    usual: float
    default: float | Callable[[Settings], float]
    ranges: Callable[[Tightest], Iterable[Range]]
    by_default: str = ""
    asked: str = ""
    optional: bool = False

    @property
    def option(self) -> str:
        """The option of ``scadgen kit``."""
        return f"--{self.name.replace('_', '-')}"

    @property
    def label(self) -> str:
        """The name as a person reads it."""
        return self.name.replace("_", " ").capitalize()

    @property
    def property_name(self) -> str:
        """The property of FreeCAD's objects."""
        return "".join(word.capitalize() for word in self.name.split("_"))

    @property
    def help(self) -> str:
        """What ``scadgen kit`` says of it."""
        said = self.by_default or f"{self.default:g}"
        return f"{self.asked or self.text}.  [default: {said}]"

    def is_in(self, values: Mapping[str, float]) -> bool:
        """Whether a kit with some values has it."""
        return not self.optional or values.get(self.name, 0.0) > 0
