"""What kit to make, and the live parameters that were not said."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from scadgen.errors import InputError
from scadgen.frame.graph import Frame
from scadgen.frame.placement import KEYS
from scadgen.frame.slots import Refused
from scadgen.joint.joint import DETAILS
from scadgen.joint.weave import Weave
from scadgen.kit.cells import check_cells
from scadgen.kit.live import LIVE, PARAMETERS, USUAL_SIDE
from scadgen.kit.model import RIMS
from scadgen.kit.parameter import Settings, Tightest
from scadgen.kit.pieces import Pieces
from scadgen.kit.ranges import check_values
from scadgen.plane.catalogue import NamedTiling
from scadgen.solid.affine import Range

__all__ = ["Request", "default_values"]

#: Rows and columns that are not said: of regular joints, and of others.
_FEW, _MORE = 2, 3

#: Above every range, in mm, so that no sum of lengths leaves the numbers there are.
_LONGEST = 1e6


@dataclass(frozen=True, slots=True)
class Request:
    """What kit to make: of a frame, or of rows and columns of a tiling.

    Parameters
    ----------
    name
        What the kit's files are called.
    frame
        The frame, in mm; None if there is a tiling.
    tiling
        A tiling; rows and columns of its cells can be set later.
    rows, columns
        How many of them.
    key
        One of `KEYS`.  A fixed peg is part of a tube, which rows that slide need.
    detail
        Name of a level of `DETAILS`.
    weave
        The weave of all joints, which must be regular; by default each joint has that of its own
        angles, or of `regular`.
    regular
        Whether all joints are one regular joint with its built-in weave, and keys in rows.
    values
        Live parameters, in mm; those not given follow from the side.  A bore above zero
        makes a bored kit.  An edge length makes a frame as large that its shortest edge is
        as long.
    command
        The command line that makes the kit again.
    rim
        One of `RIMS`.
    resizable
        Whether the frame may be made as large as its joints need.
    refused
        Joints to keep out, by other keys, as far as that goes.

    Raises
    ------
    InputError
        A name or a count that does not exist.
    """

    name: str
    frame: Frame | None = None
    tiling: NamedTiling | None = None
    rows: int = 2
    columns: int = 2
    key: str = "loose"
    detail: str = "standard"
    weave: Weave | None = None
    regular: bool = False
    values: Mapping[str, float] = field(default_factory=dict)
    command: str = ""
    rim: str = "caps"
    resizable: bool = False
    refused: tuple[Refused, ...] = ()

    @classmethod
    def tiled(
        cls,
        tiling: NamedTiling,
        *,
        rows: int | None = None,
        columns: int | None = None,
        key: str | None = None,
        **more: Any,  # noqa: ANN401  the other parameters
    ) -> Request:
        """The kit of rows and columns of a named tiling, which may be as large as joints need.

        Parameters
        ----------
        tiling
            The tiling.
        rows, columns
            How many of its cells; by default 2 of regular joints, else 3.
        key
            One of `KEYS`; by default fixed for regular joints.
        **more
            The other parameters of `Request`.
        """
        few = _FEW if tiling.regular else _MORE
        return cls(
            **{"name": tiling.name, "regular": tiling.regular, "resizable": True, **more},
            tiling=tiling,
            rows=few if rows is None else rows,
            columns=few if columns is None else columns,
            key=key or ("fixed" if tiling.regular else "loose"),
        )

    def __post_init__(self) -> None:
        """Refuse names that do not exist."""
        for name, value, known in (
            ("key", self.key, KEYS),
            ("detail", self.detail, DETAILS),
            ("rim", self.rim, RIMS),
        ):
            if value not in known:
                msg = f"{name} = {value!r}: must be one of {', '.join(known)}"
                raise InputError(msg)
        if self.name.lower() == "kit":
            msg = f"frame = {self.name!r}: would name its files as kit.json; another name works"
            raise InputError(msg)
        self._check_values()
        if self.weave and not self.regular:
            msg = f"weave {self.weave.name}: each joint of this frame has one of its own"
            raise InputError(msg)
        if self.tiling is not None:
            check_cells(self.rows, self.columns)

    def _check_values(self) -> None:
        """Refuse live parameters that do not exist, and lengths that are none."""
        for name in self.values:
            if name not in PARAMETERS:
                msg = f"{name}: not a live parameter; must be one of {', '.join(PARAMETERS)}"
                raise InputError(msg)
        for name, length in self.values.items():
            if not 0 <= length <= _LONGEST:
                msg = f"{name} = {length:g} mm: must be a number from 0 to {_LONGEST:g}"
                raise InputError(msg)

    @property
    def side(self) -> float:
        """Side of the tubes, in mm."""
        return self.values.get("side", USUAL_SIDE)

    @property
    def bored(self) -> bool:
        """Whether a bore runs along the edges."""
        return self.values.get("bore", 0.0) > 0


def default_values(
    request: Request, pieces: Sequence[Pieces], limits: Iterable[Range]
) -> dict[str, float]:
    """All live parameters: those given, and the others by the side.

    Raises
    ------
    InputError
        The side is not in its range; all other defaults are shares of it.
    """
    values = {**request.values, "side": request.side}
    check_values([r for r in limits if r.parameter == "side"], values)
    return Settings(LIVE, Tightest.of(pieces), values).all()
