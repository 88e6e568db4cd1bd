"""No vertex of any part moves when the code is put in order: digests made before, and now."""

import json

import pytest
from digests import DRAWN, FILE, GRIDS, SUMS, digest, made

BEFORE = json.loads(FILE.read_text(encoding="utf-8"))


@pytest.mark.parametrize("detail", ["draft", "standard"])
@pytest.mark.parametrize("name", [*GRIDS, *DRAWN])
def test_parts_are_what_they_were(name, detail):
    before = BEFORE[f"{name} {detail}"]
    now = digest(made([*(GRIDS | DRAWN)[name], "--detail", detail]))
    assert now["bill"] == before["bill"]
    assert now["parts"].keys() == before["parts"].keys()
    for part, one in now["parts"].items():
        other = before["parts"][part]
        assert one["triangles"] == other["triangles"], part
        assert one["sums"].keys() == other["sums"].keys(), part
        for parameter, sums in one["sums"].items():
            assert sums == pytest.approx(other["sums"][parameter], abs=SUMS, rel=0), part
