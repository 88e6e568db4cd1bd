"""How wide the gaps are that count as closed where an assembly is called locked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from scadgen.interlock.contacts import Contacts, Mesh
from scadgen.solid.affine import Floats

__all__ = ["Gap", "closed_gaps"]

#: Cosine of the angle up to which a face faces along a contact's normal.
_FACING = np.cos(np.radians(15.0))

#: How far beside a face a contact may be and still be on it, as a share of its sides.
_BESIDE = 1e-6


class Gap(NamedTuple):
    """The gaps between two parts that count as closed.

    Parameters
    ----------
    first, second
        The parts' numbers.
    smallest, largest
        In the parts' unit; below 0 where they are in each other.
    """

    first: int
    second: int
    smallest: float
    largest: float


def closed_gaps(meshes: Sequence[Mesh], contacts: Contacts, near: float) -> list[Gap]:
    """The gaps at some contacts, those of each two parts together.

    Parameters
    ----------
    meshes
        The parts.
    contacts
        The contacts.
    near
        The distance up to which faces touch.
    """
    corners = [points[triangles] for points, triangles in meshes]
    pairs = np.unique(np.column_stack([contacts.first, contacts.second]), axis=0)
    found = []
    for first, second in pairs.tolist():
        mine = np.flatnonzero((contacts.first == first) & (contacts.second == second))
        widths = [
            _height(corners[first], point, normal, near)
            + _height(corners[second], point, -normal, near)
            for point, normal in zip(contacts.points[mine], contacts.normals[mine], strict=True)
        ]
        found.append(Gap(first, second, float(min(widths)), float(max(widths))))
    return found


def _height(corners: Floats, point: Floats, normal: Floats, near: float) -> float:
    """How high a point is over the nearest face that faces along a normal."""
    close = (corners.min(axis=1) <= point + near).all(axis=1)
    close &= (corners.max(axis=1) >= point - near).all(axis=1)
    some = corners[close]
    sides = np.roll(some, -1, axis=1) - some
    across = np.cross(sides[:, 0], sides[:, 1])
    size = np.linalg.norm(across, axis=1)
    arm = point - some
    inside = (np.cross(sides, arm) * across[:, None]).sum(axis=2).min(axis=1)
    facing = (across @ normal > _FACING * size) & (inside >= -_BESIDE * size**2)
    heights = (arm[facing, 0] * across[facing]).sum(axis=1) / size[facing]
    return float(heights[np.abs(heights).argmin()]) if len(heights) else 0.0
