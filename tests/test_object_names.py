"""Every object of a 3MF has the name of its part."""

import subprocess
import zipfile
from collections import Counter

import pytest
import trimesh
from defusedxml.ElementTree import fromstring
from kits import kit

from scadgen.cli.main import main
from scadgen.emit.folder import write_kit
from scadgen.kit.store import load, summary


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("named") / "kit"
    write_kit(kit("hexagonal"), folder)
    subprocess.run(["make", "-C", folder, "3mf", "plates", "joint-plate"], check=True)
    return folder


def objects(path):
    """Name and solid of each object."""
    model = fromstring(zipfile.ZipFile(path).read("3D/3dmodel.model"))
    for one in model.iterfind(".//{*}object"):
        points = [[float(p.get(axis)) for axis in "xyz"] for p in one.iterfind(".//{*}vertex")]
        faces = [
            [int(f.get(corner)) for corner in ("v1", "v2", "v3")]
            for f in one.iterfind(".//{*}triangle")
        ]
        yield one.get("name"), trimesh.Trimesh(points, faces, process=False)


def names(path):
    return [name for name, _ in objects(path)]


def volumes(kit):
    return {
        name: abs(trimesh.Trimesh(solid.points(kit.values), solid.triangles).volume)
        for name, solid in kit.parts.items()
    }


def test_parts_that_make_draws_are_named(made):
    for path in (made / "3mf").iterdir():
        assert names(path) == [path.stem]


def test_plates_have_an_object_for_each_piece_of_the_bill(made):
    kit = load(made)
    size, found = volumes(kit), Counter()
    for path in sorted((made / "plates").glob("plate_*.3mf")):
        for name, solid in objects(path):
            assert solid.is_watertight
            assert solid.volume == pytest.approx(size[name], rel=1e-4)
            found[name] += 1
    assert found == Counter(summary(kit)["bill"])
    joint = Counter(names(made / "plates" / "joint.3mf"))
    assert set(joint) <= set(size)
    assert len(joint) > 1


def test_what_scadgen_writes_is_named(made, tmp_path):
    for command in (
        ("export", made, "--part", "half", "-o", tmp_path / "half.3mf"),
        ("render", made, "--part", "half", "--format", "3mf"),
    ):
        with pytest.raises(SystemExit) as end:
            main([str(word) for word in command])
        assert not end.value.code
    assert names(tmp_path / "half.3mf") == names(made / "3mf" / "half.3mf") == ["half"]
    kit = load(made)
    for path in (tmp_path / "half.3mf", made / "3mf" / "half.3mf"):
        assert trimesh.load(path, force="mesh").volume == pytest.approx(
            volumes(kit)["half"], rel=1e-4
        )
