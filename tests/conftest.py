"""Settings that every test shares."""

import os

import shared  # noqa: F401  before the workers start, who use its folder
from hypothesis import settings

# Matrices here are small, and several workers share the machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# The same examples every time, no time limit on a busy machine, no file in the tree.
settings.register_profile("scadgen", derandomize=True, deadline=None, database=None)
settings.load_profile("scadgen")
