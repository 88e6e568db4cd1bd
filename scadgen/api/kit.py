"""A kit as Python programs have it."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

from scadgen.api.command import remade
from scadgen.api.part import PartHandle
from scadgen.api.planned import KitPlan, planned
from scadgen.api.values import as_given
from scadgen.check.result import Result
from scadgen.check.run import checks
from scadgen.emit.folder import write_kit
from scadgen.frame.graph import Frame
from scadgen.frame.placement import Placement
from scadgen.kit import bill, model
from scadgen.kit.build import laid_out
from scadgen.kit.ranges import span
from scadgen.kit.store import load

__all__ = ["KitHandle", "load_kit"]

#: Checks of files, and of what OpenSCAD draws of them.
_FILES, _DRAWINGS = "files", "drawings"


@dataclass(frozen=True, slots=True, eq=False)
class KitHandle:
    """A kit: everything that is made for one frame; to programs `scadgen.Kit`.

    `make_kit` makes it, `load_kit` reads it.

    Parameters
    ----------
    value
        The kit as a plain value; `Kit` of ``scadgen.kit.model``.
    notes
        What there is to say of its frame, a line each.
    folder
        Where it was read from; None if it was made.
    read
        Files that it was made of, which are not written over.

    Examples
    --------
    >>> import scadgen
    >>> kit = scadgen.make_kit("square", rows=1, columns=2, detail="draft", prove=False)
    >>> kit
    <kit square: 1 x 2 cells, 6 joints, 7 edges, not proved>
    >>> list(kit.parts)[-3:]
    ['half', 'peg', 'tube']
    >>> kit.values["clearance"], kit.ranges["clearance"][0]
    (0.2, 0.0)
    """

    value: model.Kit
    notes: tuple[str, ...] = ()
    folder: Path | None = None
    read: tuple[Path, ...] = field(default=(), repr=False)

    def __repr__(self) -> str:
        """Its name, and how large it is."""
        kit = self.value
        edges = 0 if kit.frame is None else len(kit.frame.edges)
        cells = f"{kit.rows} x {kit.columns} cells, " if kit.cells is not None else ""
        proved = "proved" if kit.proved else "not proved"
        return f"<kit {kit.name}: {cells}{len(kit.vertices)} joints, {edges} edges, {proved}>"

    @property
    def name(self) -> str:
        """What its files are called."""
        return self.value.name

    @property
    def frame(self) -> Frame | None:
        """The frame, in mm; None for a single joint."""
        return self.value.frame

    @property
    def parts(self) -> Mapping[str, PartHandle]:
        """The parts by name, edge elements first."""
        read = () if self.folder is None else (_file(self.folder),)
        found = {
            name: PartHandle(part, self.value, read) for name, part in self.value.parts.items()
        }
        return MappingProxyType(found)

    @property
    def values(self) -> Mapping[str, float]:
        """The live parameters, in mm."""
        return MappingProxyType({**self.value.values})

    @property
    def ranges(self) -> Mapping[str, tuple[float, float]]:
        """Least and most of each live parameter, in mm, if it alone is changed."""
        kit = self.value
        return MappingProxyType({name: span(kit.ranges, name, kit.values) for name in kit.values})

    @property
    def joints(self) -> tuple[model.Joint, ...]:
        """The kinds of joints, with their figures and what is proved of them."""
        return self.value.joints

    @property
    def placements(self) -> tuple[Placement, ...]:
        """Where each piece stands; positions are in edge lengths."""
        return self.value.placements

    @property
    def proved(self) -> bool:
        """Whether it is proved that every joint locks and comes apart."""
        return self.value.proved

    def bill(self) -> tuple[bill.Line, ...]:
        """The bill of materials: number, part, count, spares, volume in mm3, mass in g."""
        return bill.lines(self.value)

    def check(
        self,
        *,
        drawings: bool = False,
        timeout: float = 300.0,
        progress: Callable[[str], None] | None = None,
    ) -> tuple[Result, ...]:
        """Check everything about it anew, as ``scadgen check`` does.

        Parameters
        ----------
        drawings
            Whether OpenSCAD draws it as well, which must be the same then.
        timeout
            Seconds that OpenSCAD may take for one drawing.
        progress
            Told what is checked.

        Returns
        -------
        results
            What was found, one after the other; each is ``good`` or not.  Files are among it
            if the kit was read from a folder.

        Raises
        ------
        ToolError
            OpenSCAD is wanted and missing.
        """
        say = progress or (lambda _: None)
        left_out = {_FILES} if self.folder is None else set()
        left_out |= set() if drawings else {_DRAWINGS}
        found: list[Result] = []
        with self._written(wanted=drawings) as folder:
            for what, results in checks(self.value, folder, timeout, say).items():
                if what not in left_out:
                    say(what)
                    found += results
        return tuple(found)

    @contextmanager
    def _written(self, *, wanted: bool) -> Iterator[Path]:
        """A folder with its files: its own, or one for the time that it is needed."""
        if self.folder is not None:
            yield self.folder
            return
        with tempfile.TemporaryDirectory(prefix="scadgen-") as name:
            folder = Path(name) / self.name
            if wanted:
                write_kit(self.value, folder)
            yield folder

    def plan(self, *, progress: Callable[[str], None] | None = None) -> KitPlan:
        """Plan in which order the frame goes together, and prove every step.

        Parameters
        ----------
        progress
            Told what runs.
        """
        say = progress or (lambda _: None)
        return planned(self.value, lambda _, words: say(words))

    def write(self, folder: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write its folder, all of it or nothing, as ``scadgen kit`` does.

        Parameters
        ----------
        folder
            Where to; a kit that is there is replaced.
        force
            Whether to put it where other things are, and over any file.

        Returns
        -------
        folder
            The folder; `load_kit` reads it.

        Raises
        ------
        InputError
            The folder is a file, holds something else, or cannot be written.
        """
        place = Path(folder)
        write_kit(self.value, place, read=self.read, force=force)
        return place

    def with_cells(self, rows: int, columns: int) -> KitHandle:
        """The same with other rows and columns; its parts and what is proved stay.

        Parameters
        ----------
        rows, columns
            Cells up and across, from 1 to 100.

        Raises
        ------
        InputError
            Its frame has no rows and columns to set, or one is not in that range.

        Examples
        --------
        >>> import scadgen
        >>> kit = scadgen.make_kit("square", rows=1, columns=1, detail="draft", prove=False)
        >>> kit.with_cells(3, 2)
        <kit square: 3 x 2 cells, 12 joints, 17 edges, not proved>
        """
        cells = as_given({"rows": rows, "columns": columns})
        kit = laid_out(self.value, **cells)
        command = kit.command
        for name, value in cells.items():
            command = remade(command, name, value)
        return replace(self, value=replace(kit, command=command), folder=None)


def load_kit(path: str | os.PathLike[str]) -> KitHandle:
    """Read a kit.

    Parameters
    ----------
    path
        Its folder, or the ``kit.json`` in it.

    Raises
    ------
    InputError
        There is none.
    KitError
        It is truncated, from another version, or not a sound kit.
    """
    place = Path(path)
    kit = load(place)
    return KitHandle(kit, folder=place if place.is_dir() else place.parent)


def _file(folder: Path) -> Path:
    return folder / "kit.json"
