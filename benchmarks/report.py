"""Lines of the report: what was measured, the figure, the aim, whether it is met."""

from __future__ import annotations

import sys

__all__ = ["heading", "line", "progress"]


def heading(text: str) -> None:
    """Start a section."""
    print(f"\n{text}", flush=True)


def line(what: str, figure: str, aim: str = "", *, met: bool | None = None) -> None:
    """Say one figure, and beside it the aim where there is one."""
    verdict = "" if met is None else "met" if met else "NOT MET"
    print(f"  {what:<45} {figure:<36} {aim:<30} {verdict}".rstrip(), flush=True)


def progress(text: str) -> None:
    """Say on stderr what is being done."""
    print(f"bench: {text}", file=sys.stderr, flush=True)
