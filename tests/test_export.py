"""Mesh files, read back by trimesh."""

import io
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from shapes import box, grooved, torus

from scadgen.emit.mesh import FORMATS, mesh_bytes, write_atomic
from scadgen.errors import InputError
from scadgen.solid.mesh import volume

SHAPES = {"box": box((1, 2, 3), (31, 12, 8)), "groove": grooved(), "ring": torus()}
METRE = 1000


def read(data, kind):
    import trimesh

    loaded = trimesh.load(io.BytesIO(data), file_type=kind)
    return loaded.to_mesh() if isinstance(loaded, trimesh.Scene) else loaded


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("name", SHAPES)
def test_read_back(name, kind):
    points, triangles = SHAPES[name]
    back = read(mesh_bytes(points, triangles, kind), kind)
    scale = METRE if kind == "glb" else 1
    assert back.is_watertight
    assert back.is_winding_consistent
    assert len(back.faces) == len(triangles)
    assert back.volume * scale**3 == pytest.approx(volume(points, triangles), rel=1e-5)
    found = back.vertices * scale
    if kind == "glb":
        found = found[:, [0, 2, 1]] * (1, -1, 1)
    assert found.min(axis=0) == pytest.approx(points.min(axis=0), abs=1e-5)
    assert found.max(axis=0) == pytest.approx(points.max(axis=0), abs=1e-5)


@pytest.mark.parametrize("kind", FORMATS)
def test_same_mesh_same_bytes(kind):
    points, triangles = SHAPES["ring"]
    data = mesh_bytes(points, triangles, kind)
    assert data == mesh_bytes(points.copy(order="F"), triangles.astype(np.int32), kind)
    # Minus zero is the same place.
    assert data == mesh_bytes(np.where(points == 0, -0.0, points), triangles, kind)


def test_stl_states_its_length_and_does_not_look_like_text():
    points, triangles = SHAPES["box"]
    data = mesh_bytes(points, triangles, "stl")
    assert len(data) == 84 + 50 * 12
    assert int.from_bytes(data[80:84], "little") == 12
    assert not data.startswith(b"solid")
    face = np.frombuffer(data[84:134], dtype="<f4", count=12).reshape(4, 3)
    assert face[0].tolist() == [-1, 0, 0]
    assert face[1:].tolist() == points[triangles[0]].tolist()


def test_3mf_is_a_package_in_millimetres_without_times():
    points, triangles = SHAPES["box"]
    with zipfile.ZipFile(io.BytesIO(mesh_bytes(points, triangles, "3mf"))) as package:
        assert package.testzip() is None
        assert {x.date_time for x in package.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert package.namelist()[0] == "[Content_Types].xml"
        model = package.read("3D/3dmodel.model").decode()
    assert 'unit="millimeter"' in model
    assert '<vertex x="31.00000" y="12.00000" z="8.00000"/>' in model


def test_obj_keeps_the_vertex_numbers():
    points, triangles = SHAPES["box"]
    lines = mesh_bytes(points, triangles, "obj").decode().splitlines()
    assert lines[1] == "v 1.00000 2.00000 3.00000"
    assert lines[9] == "f 1 2 4"


def test_what_cannot_be_written():
    points, triangles = SHAPES["box"]
    with pytest.raises(InputError, match=r"^unknown mesh format 'ply'; stl, 3mf, obj, glb work$"):
        mesh_bytes(points, triangles, "ply")
    with pytest.raises(InputError, match="mesh of 0 faces"):
        mesh_bytes(points, triangles[:0], "stl")
    with pytest.raises(InputError, match="finite points"):
        mesh_bytes(points * np.inf, triangles, "stl")


def test_a_file_is_put_in_place_whole(tmp_path):
    target = tmp_path / "part.stl"
    for data in (b"one", b"another"):
        write_atomic(target, data)
        assert target.read_bytes() == data
        assert list(tmp_path.iterdir()) == [target]


def test_a_new_file_has_the_usual_permissions(tmp_path):
    (tmp_path / "usual").write_bytes(b"")
    write_atomic(tmp_path / "ours", b"")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_a_link_is_followed(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "real")
    write_atomic(tmp_path / "link", b"data")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_bytes() == b"data"


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("folder", "it is not a file"),
        ("missing/part.stl", "No such file or directory"),
        ("file/part.stl", "Not a directory"),
        ("x" * 300, "File name too long"),
    ],
)
def test_what_is_in_the_way_is_told_and_nothing_is_left(tmp_path, name, why):
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_bytes(b"old")
    with pytest.raises(InputError, match=f"^cannot write '.*': {why}; name .*$") as told:
        write_atomic(tmp_path / name, b"data")
    assert "\n" not in str(told.value)
    assert sorted(x.name for x in tmp_path.rglob("*")) == ["file", "folder"]
    assert (tmp_path / "file").read_bytes() == b"old"


def test_no_space_leaves_the_old_file(tmp_path):
    resource = pytest.importorskip("resource")
    assert resource.RLIMIT_FSIZE is not None
    target = tmp_path / "part.stl"
    target.write_bytes(b"old")
    # A process that may write only 100 bytes to a file meets the same error half way.
    code = (
        "import resource, pathlib, sys\n"
        "from scadgen.emit.mesh import write_atomic\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
        "write_atomic(pathlib.Path(sys.argv[1]), bytes(1000))\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, target], capture_output=True, text=True, check=False
    )
    assert run.returncode == 1
    assert "InputError: cannot write " in run.stderr.splitlines()[-1]
    assert target.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [target]
