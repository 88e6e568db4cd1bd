"""Makes frames and kits for Python programs."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scadgen.api.command import command_line
from scadgen.api.curves import told_of_curves
from scadgen.api.drawing import drawing
from scadgen.api.kit import KitHandle
from scadgen.api.request import keys_note, kit_request, plain_name
from scadgen.api.source import Source, is_file, load_frame, renamed
from scadgen.api.values import as_given
from scadgen.frame.graph import Frame
from scadgen.kit.bill import check_material
from scadgen.kit.live import PARAMETERS

if TYPE_CHECKING:
    from scadgen.kit import model
    from scadgen.kit.build import Request

__all__ = ["make_frame", "make_kit"]


def make_frame(
    source: object,
    *,
    name: str | None = None,
    note: Callable[[str], None] | None = None,
    **options: Any,  # noqa: ANN401  each has its own kind
) -> Frame:
    """Make or read a planar frame.

    Parameters
    ----------
    source
        One of

        - the name of a frame, as ``scadgen frame --list`` shows: ``"4.8.8"``;
        - a file: JSON, SVG, DXF, OBJ or OFF;
        - vertices ``(n, 2) float`` in mm, and edges ``(m, 2) int``;
        - a graph of networkx whose nodes have ``pos``, an x and a y in mm;
        - lines of shapely in mm, one or a list: ends that nearly meet are joined and crossings
          split, as in drawings;
        - a frame.
    name
        What to call it.
    note
        Told what was changed or left out on the way, a line each.
    **options
        Options of ``scadgen frame``, with ``_`` for ``-``.  Lengths are numbers of mm, or texts
        with a unit.

        - Named frames: ``edge_length``, ``rows``, ``columns``, ``radius``, ``outline``,
          ``width``, ``height``, ``angle``, ``sides``, ``bays``, ``bay_length``, ``triangles``.
        - Files, and what a program gives: ``scale``, ``unit``, ``centre``, ``tolerance``,
          ``flatten``, ``repair``, ``no_split``, ``strict``, ``components``, ``shortest``,
          ``most``.
        - All: ``snap``.

    Returns
    -------
    frame
        Its ``plan`` has the vertices, ``(n, 2) float`` in mm, ascending by y, then x.

    Raises
    ------
    InputError
        It is no frame, or an option does not go with it.

    Examples
    --------
    >>> import scadgen
    >>> square = scadgen.make_frame("square", rows=1, columns=1, edge_length="8 cm")
    >>> square.plan.tolist()
    [[0.0, 0.0], [80.0, 0.0], [0.0, 80.0], [80.0, 80.0]]
    >>> tee = scadgen.make_frame(([(0, 0), (90, 0), (0, 90)], [(0, 1), (0, 2)]))
    >>> tee.lengths.tolist()
    [90.0, 90.0]
    """
    given = as_given({"name": name, **options})
    given.pop("name", None)
    read = load_frame(_source(source, name), given)
    for line in read.notes:
        if note is not None:
            note(line)
    return read.frame if name is None else renamed(read.frame, name)


def make_kit(  # noqa: PLR0913  one argument an option
    frame: object,
    *,
    name: str | None = None,
    rows: int | None = None,
    columns: int | None = None,
    key: str | None = None,
    rim: str = "caps",
    detail: str = "standard",
    weave: str | os.PathLike[str] | None = None,
    material: str = "PLA",
    prove: bool = True,
    jobs: int | None = None,
    cache: bool = True,
    progress: Callable[[str], None] | None = None,
    **options: Any,  # noqa: ANN401  each has its own kind
) -> KitHandle:
    """Make a kit for a frame, as ``scadgen kit`` does; nothing is written.

    Parameters
    ----------
    frame
        What `make_frame` takes.
    name
        What its files are called; by default as the frame or its file.
    rows, columns
        Cells up and across, of named tilings; by default 2 of hexagonal and square ones, 3 of
        others.
    key
        ``"fixed"`` for pegs that are part of the tubes, ``"loose"`` for pegs put in from the
        ring's hole; by default fixed for hexagonal and square frames, and loose for others,
        which have no fixed ones.
    rim
        ``"caps"`` or ``"open"``: what joints at the rim have where they lack edges of inner ones.
    detail
        ``"draft"``, ``"standard"`` or ``"fine"``.
    weave
        A built-in weave by name, or a JSON file with one.
    material
        For the bill of materials: ``"PLA"``, ``"PETG"``, ``"ABS"``, ``"ASA"``, ``"PC"`` or
        ``"PA"``.
    prove
        Whether every joint must be proved to lock and to come apart.
    jobs
        Processes; by default one a core.
    cache
        Whether to use and keep joints and proofs in ``SCADGEN_CACHE``, by default
        ``~/.cache/scadgen``.
    progress
        Told what runs.
    **options
        Those of `make_frame`, and live parameters: ``side``, ``edge_length``, ``clearance``,
        ``peg_width``, ``peg_length``, ``peg_clearance``, ``peg_chamfer``, ``bore``.  Lengths are
        numbers of mm, or texts with a unit.

    Raises
    ------
    InputError
        There is no such frame, an option does not go with it, or a length leaves its range.
    GeometryError
        The frame cannot be built: says where.
    JointError
        A joint is not proved to lock, or to come apart.

    Examples
    --------
    >>> import scadgen
    >>> kit = scadgen.make_kit("hexagonal", side=8, detail="draft", prove=False)
    >>> kit
    <kit hexagonal: 2 x 2 cells, 16 joints, 19 edges, not proved>
    >>> kit.values["edge_length"]
    48.0
    >>> scadgen.make_kit("hexagonal", side=3)
    Traceback (most recent call last):
    scadgen.errors.InputError: side = 3 mm: must be 5 to 100 mm (thinner walls do not print)
    """
    named = {"name": name, "rows": rows, "columns": columns, "key": key, "jobs": jobs}
    words = {"rim": rim, "detail": detail, "material": material}
    path = {} if weave is None else {"weave": os.fspath(weave)}
    given = as_given({**named, **words, **path, **options})
    called, workers = given.pop("name", None), given.pop("jobs", None)
    source = _source(frame, called)
    material = check_material(given.pop("material"))
    request, notes = kit_request(
        source,
        dict.fromkeys(("rows", "columns", "key", "weave")) | given,
        PARAMETERS,
        "" if called else _command(source, given, material, prove=prove),
    )
    if called is not None:
        request = replace(request, name=plain_name(called))
    with told_of_curves(notes):
        made = _made(request, workers, progress or (lambda _: None), prove=prove, cache=cache)
    files = [Path(source)] if isinstance(source, str) and is_file(source) else []
    return KitHandle(
        replace(made, material=material),
        (*notes, *keys_note(made)),
        read=(*files, *([Path(given["weave"])] if "weave" in given else [])),
    )


def _source(given: object, name: str | None) -> Source:
    """What messages and the reader take: a name, a file's name, or what a program has."""
    if isinstance(given, str | os.PathLike):
        return os.fsdecode(given)
    return drawing(given, name)


def _command(source: Source, given: Mapping[str, Any], material: str, *, prove: bool) -> str:
    """The command that makes the same kit; empty if what a program has is its frame."""
    if not isinstance(source, str):
        return ""
    usual = {"rim": "caps", "detail": "standard"}
    own = {n: v for n, v in given.items() if usual.get(n) != v}
    if material != "PLA":
        own["material"] = material
    return command_line(source, {**own, "unchecked": not prove})


def _made(
    request: Request, jobs: int | None, say: Callable[[str], None], *, prove: bool, cache: bool
) -> model.Kit:
    """The kit, proved if that is wanted."""
    from scadgen.kit.build import build
    from scadgen.plan.keyed import proved_kit
    from scadgen.work.cache import Cache, default_folder
    from scadgen.work.executor import Executor
    from scadgen.work.mapping import Execution

    means = Execution(Executor(jobs), Cache(default_folder()) if cache else None)

    def computed(count: int, of: int) -> None:
        say(f"computing the joints, {count} of {of}")

    if not prove:
        return build(request, means, computed)
    return proved_kit(request, means, computed, lambda what: say(f"proving {what}"))
