"""Results kept on disk, by a key of all that they depend on.

Each is a file of its own, of arrays and JSON: nothing that is read is run.  A file that is
damaged is as good as none.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scadgen.work.deferred import interrupts_held

__all__ = ["LIMIT", "Cache", "Entry", "default_folder"]

#: Most that is kept, in bytes.
LIMIT = 2 * 10**9

#: Share of the limit down to which the oldest files go once it is passed.
_LEFT = 0.9

#: Name of the JSON beside the arrays.
_JSON = "json"

#: Files that are written here, by their names: results, and those that never got whole.  The
#: folder may be anybody's, and hold files of others, which are not touched.
_OURS = re.compile(r"[0-9a-f]{62}(\.npz|\.\w{8}\.part)")


@dataclass(frozen=True, slots=True, eq=False)
class Entry:
    """What is kept of one result.

    Parameters
    ----------
    values
        JSON values by name.
    arrays
        Arrays of numbers by name.
    """

    values: Mapping[str, Any]
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)


def default_folder() -> Path:
    """Where results are kept: ``SCADGEN_CACHE``, or where this system's users keep such files."""
    own = os.environ.get("SCADGEN_CACHE")
    if own:
        return Path(own)
    home = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return (Path(home) if home else Path.home() / ".cache") / "scadgen"


class Cache:
    """Results on disk.

    Several processes may use the same folder at once: files appear whole or not at all.

    Parameters
    ----------
    folder
        Where; it is made when something is kept.
    limit
        Most that is kept, in bytes.
    """

    def __init__(self, folder: Path, limit: int = LIMIT) -> None:
        self.folder, self._limit = folder, limit
        self._added = 0

    def find(self, key: str) -> Entry | None:
        """What is kept under a key; None if nothing is, or if it is damaged."""
        path = self._path(key)
        try:
            with np.load(io.BytesIO(path.read_bytes()), allow_pickle=False) as file:
                arrays = {name: file[name] for name in file.files}
            values = json.loads(arrays.pop(_JSON).tobytes())
        except Exception:  # noqa: BLE001 -- the readers let out whatever damaged files cause
            return None
        if not isinstance(values, dict) or values.pop("key", None) != key:
            return None
        with contextlib.suppress(OSError):
            os.utime(path)  # the last that goes is what was used last
        return Entry(values, arrays)

    def keep(self, key: str, entry: Entry) -> None:
        """Keep something under a key.

        That a disk is full or cannot be written is no reason to lose the result itself, so
        it is then just not kept.
        """
        text = json.dumps({**entry.values, "key": key}, allow_nan=False)
        content = io.BytesIO()
        arrays: Any = {**entry.arrays, _JSON: np.frombuffer(text.encode(), dtype=np.uint8)}
        with interrupts_held(), contextlib.suppress(OSError):
            np.savez_compressed(content, **arrays)
            _write(self._path(key), content.getbuffer())
            self._added += content.tell()
        # Looking through the folder takes time, so it is done once in a while.
        if self._added > (1 - _LEFT) / 2 * self._limit:
            self.trim()

    def trim(self) -> None:
        """Remove the files that were not used for longest where they are too many."""
        self._added = 0
        files = sorted(self._files(), reverse=True)
        if sum(size for _, size, _ in files) <= self._limit:
            return
        kept = 0
        for _, size, path in files:
            kept += size
            if kept > _LEFT * self._limit:
                with contextlib.suppress(OSError):
                    path.unlink()

    def _path(self, key: str) -> Path:
        return self.folder / key[:2] / f"{key[2:]}.npz"

    def _files(self) -> Iterator[tuple[float, int, Path]]:
        """When each file was last used, its size, and the file."""
        for path in self.folder.glob("[0-9a-f][0-9a-f]/*"):
            if not _OURS.fullmatch(path.name):
                continue
            with contextlib.suppress(OSError):
                found = path.stat()
                yield found.st_mtime, found.st_size, path


def _write(path: Path, content: memoryview) -> None:
    """Write a file that is there whole or not at all."""
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(".part", f"{path.stem}.", path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        Path(name).replace(path)
    except BaseException:
        with contextlib.suppress(OSError):
            Path(name).unlink()
        raise
