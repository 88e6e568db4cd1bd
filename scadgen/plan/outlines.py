"""Outlines of parts as they are seen from above, as SVG paths."""

from __future__ import annotations

import numpy as np

from scadgen.kit.model import Kit
from scadgen.plan.standing import Standing
from scadgen.solid.affine import Floats
from scadgen.solid.gap import solid
from scadgen.solid.pose import OVER, Pose

__all__ = ["Outlines"]

#: How far an outline may be from the part's, in sides: less than is seen.
_OFF = 0.01


class Outlines:
    """Outlines of a frame's parts, each kind of part drawn once.

    Parameters
    ----------
    standing
        The frame.
    """

    def __init__(self, standing: Standing) -> None:
        self._standing, kit = standing, standing.kit
        kinds = sorted({(p.part, p.pose.over) for p in kit.placements})
        self._number = {kind: number for number, kind in enumerate(kinds)}
        self._lines = [_outline(kit, *kind) for kind in kinds]

    def name(self, part: int) -> str:
        """The id of a part's outline."""
        place = self._standing.kit.placements[part]
        return f"p{self._number[place.part, place.pose.over]}"

    def corners(self, part: int) -> Floats:
        """Corners of a part's outline where it stands, ``(k, 2)``, in mm."""
        place = self._standing.kit.placements[part]
        lines = self._lines[self._number[place.part, place.pose.over]]
        unit = self._standing.kit.values["edge_length"]
        turned = Pose(place.pose.at, place.pose.x).scaled(unit)
        flat = np.vstack(lines)
        return turned.apply(np.column_stack([flat, np.zeros(len(flat))]))[:, :2]

    def shapes(self, parts: set[int], scale: float) -> str:
        """Outlines of some parts at their origins, y down, to be used by name."""
        names = sorted({self.name(part) for part in parts}, key=lambda name: int(name[1:]))
        return "\n".join(
            f'<path id="{name}" d="{_path(self._lines[int(name[1:])], scale)}"/>' for name in names
        )


def _outline(kit: Kit, name: str, over: bool) -> list[Floats]:  # noqa: FBT001
    """Lines around a part and around its holes, in mm."""
    from manifold3d import CrossSection, FillRule  # slow to import

    points = kit.parts[name].points(kit.values)
    points = OVER.apply(points) if over else points
    seen = solid(points, kit.parts[name].triangles).project().to_polygons()
    whole = CrossSection(seen, FillRule.Positive).simplify(_OFF * kit.values["side"])
    return [np.asarray(line, dtype=np.float64) for line in whole.to_polygons()]


def _path(lines: list[Floats], scale: float) -> str:
    return "".join(
        "M" + "L".join(f"{scale * x:.1f} {-scale * y:.1f}" for x, y in line) + "Z" for line in lines
    )
