"""What tells one computation from another: the code that computes, and what it is given."""

from __future__ import annotations

import hashlib
import json
import platform
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

from scadgen import __version__

__all__ = ["fingerprint", "key_of"]

#: Packages of scadgen that results depend on, and the libraries that compute for them.
_PACKAGES = ("solid", "joint", "frame", "interlock", "element", "kit", "check", "work")
_LIBRARIES = ("manifold3d", "numpy", "scipy", "shapely")


@cache
def fingerprint() -> str:
    """What tells this scadgen from all others: its version, its source, and its libraries."""
    sum_ = hashlib.sha256(f"{__version__} {platform.python_version()}".encode())
    for library in _LIBRARIES:
        sum_.update(f" {library} {metadata.version(library)}".encode())
    root = Path(__file__).parent.parent
    for package in _PACKAGES:
        for path in sorted((root / package).rglob("*")):
            if path.suffix in (".py", ".json"):
                sum_.update(f"\n{path.relative_to(root).as_posix()}\n".encode())
                sum_.update(path.read_bytes())
    return sum_.hexdigest()


def key_of(what: str, **given: object) -> str:
    """The key of a result.

    Parameters
    ----------
    what
        What is computed.
    given
        All that it is computed from: values as JSON has them, and arrays among them.

    Returns
    -------
    key
        64 hexadecimal digits, which are others for another scadgen.

    Examples
    --------
    >>> key_of("sum", of=[1, 2]) == key_of("sum", of=(1, 2))
    True
    >>> key_of("sum", of=[1, 2]) == key_of("sum", of=[1, 3])
    False
    """
    text = json.dumps([fingerprint(), what, given], sort_keys=True, default=_plain)
    return hashlib.sha256(text.encode()).hexdigest()


def _plain(value: object) -> Any:  # noqa: ANN401  whatever JSON has
    """An array as what is the same for the same array only."""
    if not isinstance(value, np.ndarray):
        msg = f"no key for a {type(value).__name__}"
        raise TypeError(msg)
    content = hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()
    return [str(value.dtype), list(value.shape), content]
