"""Settings that every test shares."""

import os
from pathlib import Path

import shared  # before the workers start, who use its folder
from hypothesis import settings

# Matrices here are small, and several workers share the machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# What is kept for users is not for tests to use, nor to fill.
os.environ["SCADGEN_CACHE"] = str(Path(os.environ[shared.PLACE]) / "cache")

# What a command says depends on nothing but what it does, not on how long that takes.
os.environ["SCADGEN_PROGRESS"] = "none"

# The same examples every time, no time limit on a busy machine, no file in the tree.
settings.register_profile("scadgen", derandomize=True, deadline=None, database=None)
settings.load_profile("scadgen")
