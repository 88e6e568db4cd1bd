"""What several tests need is made once a run, whichever worker asks for it first."""

import copyreg
import fcntl
import os
import pickle
import shutil
import tempfile
from pathlib import Path
from types import MappingProxyType

__all__ = ["PLACE", "once"]

PLACE = "SCADGEN_TESTS_PLACE"

# Who imports this first starts the workers, or is alone; the folder goes when it ends.
if PLACE not in os.environ:
    _folder = tempfile.TemporaryDirectory(prefix="pytest-scadgen-")
    os.environ[PLACE] = _folder.name


def _read_only(mapping):
    return MappingProxyType(mapping)


copyreg.pickle(MappingProxyType, lambda mapping: (_read_only, (dict(mapping),)))

_kept = {}


def once(name, make):
    """What `make` gives; it is given a folder of its own that stays as long as the tests run."""
    if name not in _kept:
        place = Path(os.environ[PLACE]) / name
        with place.with_name(f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            result = place.with_name(f"{name}.pickle")
            if not result.exists():
                shutil.rmtree(place, ignore_errors=True)
                place.mkdir()
                result.write_bytes(pickle.dumps(make(place)))
            _kept[name] = pickle.loads(result.read_bytes())  # noqa: S301  written above
    return _kept[name]
