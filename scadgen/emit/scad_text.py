"""Values as OpenSCAD text: numbers, strings, comments, expressions and vertex tables.

Everything that goes from a kit into a template goes through one of these, so nothing
in a kit can end a comment or a string, or make the same kit give other bytes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby

from scadgen.errors import InvariantError
from scadgen.solid.affine import AffineSolid, Floats, Linear

__all__ = ["comment", "expression", "faces", "literal", "number", "quoted", "table"]

#: Decimals of a vertex factor: at 400 mm an error under 1e-6 mm, less than STL keeps.
DECIMALS = 9

#: Longest line of a table, in characters.
WIDTH = 110


def comment(text: str) -> str:
    r"""Text that stays inside one line of a comment, in OpenSCAD and in a Makefile.

    Examples
    --------
    >>> comment('a */ b\ncube();')
    'a * / b cube();'
    """
    one_line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    ascii_only = one_line.encode("ascii", "replace").decode("ascii")
    # A backslash at a line's end would continue a Makefile's comment.
    return ascii_only.replace("*/", "* /").replace("/*", "/ *").rstrip("\\")


def quoted(text: str) -> str:
    r"""Text as an OpenSCAD string literal, in ASCII.

    Examples
    --------
    >>> quoted('5" peg')
    '"5\\" peg"'
    """
    return '"' + comment(text).replace("\\", "\\\\").replace('"', '\\"') + '"'


def number(value: float) -> str:
    """Round to `DECIMALS` decimals, without trailing zeros.

    Examples
    --------
    >>> number(-0.25), number(3.0), number(-1e-12)
    ('-0.25', '3', '0')
    """
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def literal(value: float) -> str:
    """Shortest text that OpenSCAD reads back as exactly this number.

    Examples
    --------
    >>> literal(80.0), literal(0.1)
    ('80', '0.1')
    """
    text = repr(float(value))
    return text.removesuffix(".0")


def expression(linear: Linear) -> str:
    """Linear expression in the live parameters, summed in Python's order.

    Examples
    --------
    >>> expression(Linear({"side": 0.6, "bore": -1}, 0.4))
    '0.4 + (0.6 * side + -1 * bore)'
    """
    terms = [
        name if factor == 1 else f"{literal(factor)} * {name}"
        for name, factor in linear.terms.items()
    ]
    if not terms:
        return literal(linear.constant)
    total = " + ".join(terms)
    if linear.constant == 0:
        return total
    return f"{literal(linear.constant)} + {total if len(terms) == 1 else f'({total})'}"


def table(factors: Floats) -> str:
    """Vertex factors of one live parameter, whichever way is shorter.

    Dense: ``[x, y, z]`` a vertex.  In runs: ``_runs([count, x, y, z])``, ``count`` equal
    rows one after another; a bare count stands for rows of zeros.

    Parameters
    ----------
    factors
        ``(v, 3) float``.

    Returns
    -------
    expression
        OpenSCAD text that gives ``v`` rows.
    """
    rows = [",".join(number(x) for x in row) for row in factors.tolist()]
    dense = _wrapped("[", (f"[{row}]" for row in rows), "]")
    counted = ((row, sum(1 for _ in same)) for row, same in groupby(rows))
    runs = _wrapped(
        "_runs([",
        (str(count) if row == "0,0,0" else f"[{count},{row}]" for row, count in counted),
        "])",
    )
    return min(dense, runs, key=len)


def faces(solid: AffineSolid) -> str:
    """Triangles of a solid, turned clockwise from outside as OpenSCAD wants them."""
    count = solid.vertex_count
    if solid.triangles.min() < 0 or solid.triangles.max() >= count:
        msg = f"affine solid {solid.name}: a triangle has a vertex outside 0 to {count - 1}"
        raise InvariantError(msg)
    return _wrapped("[", (f"[{a},{c},{b}]" for a, b, c in solid.triangles.tolist()), "]")


def _wrapped(start: str, items: Iterable[str], end: str) -> str:
    """List of items, broken into lines of at most `WIDTH` characters."""
    return start + "\n    " + ",\n    ".join(_lines(items)) + end


def _lines(items: Iterable[str]) -> Iterator[str]:
    line: list[str] = []
    length = 0
    for item in items:
        if line and length + len(item) > WIDTH:
            yield ",".join(line)
            line, length = [], 0
        line.append(item)
        length += len(item) + 1
    yield ",".join(line)
