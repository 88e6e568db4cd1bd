"""Frames from DXF: what is seen of its model space, down into its blocks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from scadgen.errors import InputError
from scadgen.readers.curves import check_count, flattened
from scadgen.readers.dxf_file import open_dxf, units_of
from scadgen.readers.dxf_shapes import SHAPES, is_curved, outlines
from scadgen.readers.reading import Read, Reading, from_segments, load, unknown
from scadgen.solid.affine import Floats

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.dxfgfx import DXFGraphic
    from ezdxf.entities.insert import Insert

__all__ = ["read_dxf"]

_T = TypeVar("_T")

#: Blocks within each other go this deep; deeper ones go in circles.
_DEEPEST = 32

#: The layer of what takes that of the block it is in, and the one that nobody plots.
_OF_BLOCK, _UNPLOTTED = "0", "defpoints"


def read_dxf(path: Path, reading: Reading) -> Read:
    """Read a frame from the lines and curves of a DXF file, its hatches and meshes too.

    Without units in its header, a unit is a millimetre.

    Raises
    ------
    InputError
        Another kind of file; entities that cannot be part of a frame, if these are refused;
        points at different heights; or no frame.
    """
    data = load(path, reading)
    document, repairs = open_dxf(path, data)
    scale, units = units_of(document, data, reading)
    walk = _Walk(document, reading.most)
    lines: list[Floats] = []
    most, shapes, chords = reading.most, 0, 0
    for entity in _guarded(walk.drawn(document.modelspace())):
        found = list(_guarded(outlines(entity, reading.flatten / scale, most), entity))
        count = sum(len(line) - 1 for line in found)
        most -= count
        check_count(most)
        lines += [line * scale for line in found]
        if is_curved(entity):
            shapes, chords = shapes + 1, chords + count
    notes = (
        *repairs,
        *units,
        *unknown(walk.strange, reading),
        *walk.notes(),
        *flattened(shapes, chords, reading.flatten),
    )
    _check_flat(lines, reading.tolerance)
    segments = [np.stack([line[:-1, :2], line[1:, :2]], axis=1) for line in lines]
    return from_segments(path.stem, segments, reading, notes)


class _Walk:
    """What is seen of a document, entity by entity; and how much is not."""

    def __init__(self, document: Drawing, most: int) -> None:
        layers = document.layers
        self._key = layers.key
        self._frozen = {layers.key(one.dxf.name) for one in layers if one.is_frozen()}
        self._off = {layers.key(one.dxf.name) for one in layers if one.is_off() or not one.dxf.plot}
        self._off.add(_UNPLOTTED)
        self._most = most
        self._visited = 0
        self._unseen = 0
        self._clipped = 0
        self.strange: Counter[str] = Counter()

    def drawn(
        self, entities: Iterable[DXFGraphic], under: str = _OF_BLOCK, depth: int = 0
    ) -> Iterator[DXFGraphic]:
        """Shapes among some entities and in the blocks among them.

        Parameters
        ----------
        entities
            The entities.
        under
            The layer of the block that they are in.
        depth
            How many blocks they are in.
        """
        for entity in entities:
            self._visited += 1
            if self._visited > self._most:
                msg = f"more than {self._most} entities, unless more are allowed (--most)"
                raise InputError(msg)
            # What ezdxf does not know has no such attribute, and may have a layer all the same.
            layer = self._key(entity.graphic_properties().get("layer", _OF_BLOCK))
            layer = under if layer == _OF_BLOCK else layer
            kind = entity.dxftype()
            invisible = entity.dxf.hasattr("invisible") and entity.dxf.invisible
            # What is in a block that is off, but on a layer of its own, is seen.
            if invisible or layer in self._frozen or (layer in self._off and kind != "INSERT"):
                self._unseen += 1
            elif kind == "INSERT":
                yield from self._inserted(entity, layer, depth)
            elif kind == "MLINE":
                yield from self.drawn(_parts(entity), layer, depth)
            elif kind in SHAPES:
                yield entity
            else:
                self.strange[kind] += 1

    def _inserted(self, insert: Any, layer: str, depth: int) -> Iterator[DXFGraphic]:  # noqa: ANN401
        """What a block shows where it is inserted, once or in rows and columns."""
        from ezdxf.xclip import XClip

        if depth == _DEEPEST:
            msg = f"block {insert.dxf.name[:60]!r}: more than {_DEEPEST} blocks within each other"
            raise InputError(msg)
        block = insert.block()
        if block is None:
            self.strange["INSERT of a block that is not there"] += 1
            return
        if block.block is not None and block.block.is_xref:
            self.strange["INSERT of another file"] += 1
            return
        if insert.attribs:
            self.strange["ATTRIB"] += len(insert.attribs)
        self._clipped += XClip(insert).is_clipping_enabled
        for one in insert.multi_insert() if insert.mcount > 1 else [insert]:
            yield from self.drawn(self._block(one), layer, depth + 1)

    def _block(self, insert: Insert) -> Iterator[DXFGraphic]:
        def skipped(entity: DXFGraphic, _: str) -> None:
            self.strange[f"{entity.dxftype()} in a stretched block"] += 1

        yield from insert.virtual_entities(skipped_entity_callback=skipped)

    def notes(self) -> Iterator[str]:
        """What was left out as nobody sees it, and what was not."""
        if self._unseen:
            yield (
                "entities that are invisible, or on layers that are off, frozen or not plotted, "
                f"left out: {self._unseen}"
            )
        if self._clipped:
            yield f"blocks that are clipped, read whole: {self._clipped}"


def _parts(entity: Any) -> Iterator[DXFGraphic]:  # noqa: ANN401 -- only some entities have parts
    yield from entity.virtual_entities()


def _guarded(found: Iterator[_T], entity: DXFGraphic | None = None) -> Iterator[_T]:
    """The same, with what broken numbers cause in one line."""
    from ezdxf.lldxf.const import DXFError

    try:
        yield from found
    except InputError:
        raise
    except (
        *(ValueError, TypeError, ArithmeticError, AttributeError, LookupError),
        *(RecursionError, AssertionError, DXFError),
    ):
        what = "an entity in a block" if entity is None else f"{entity.dxftype()} {_handle(entity)}"
        msg = f"{what}: its numbers are broken"
        raise InputError(msg) from None


def _handle(entity: DXFGraphic) -> str:
    return str(entity.dxf.handle or "in a block")


def _check_flat(lines: list[Floats], tolerance: float) -> None:
    heights = np.concatenate([line[:, 2] for line in lines]) if lines else np.zeros(1)
    if not np.ptp(heights) <= tolerance:
        low, high = heights.min(), heights.max()
        msg = (
            f"is not plane: its points are at heights from {low:.6g} to {high:.6g} mm, "
            f"{tolerance:g} mm apart at most; a larger --tolerance flattens it"
        )
        raise InputError(msg)
