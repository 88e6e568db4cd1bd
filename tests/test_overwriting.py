"""No command writes over what it read, nor over a file that scadgen did not make."""

import io
import json
import os
import struct
import zipfile

import numpy as np
import pytest
import trimesh
from kits import kit
from PIL import Image

from scadgen.cli.main import main
from scadgen.emit.folder import write_kit
from scadgen.emit.mark import is_ours, marked
from scadgen.emit.mesh import FORMATS, mesh_bytes
from scadgen.emit.motion import motion_png

TRIANGLE = '{"vertices": [[0, 0], [99, 0], [0, 99]], "edges": [[0, 1], [1, 2], [0, 2]]}'
DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="99mm" height="99mm" viewBox="0 0 99 99">'
    '<path d="M0 0H99V99Z" fill="none" stroke="black"/></svg>'
)


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def run_command(*words):
        with pytest.raises(SystemExit) as end:
            main([str(word) for word in words])
        return end.value.code or 0, *capsys.readouterr()

    return run_command


@pytest.fixture
def made(tmp_path):
    write_kit(kit("hexagonal"), tmp_path / "kit")
    return tmp_path / "kit"


def same_file(kind, tmp_path):
    """Another way to the drawing."""
    drawing, other = tmp_path / "X.svg", tmp_path / "other.svg"
    if kind == "the same":
        return drawing
    if kind == "a longer way":
        (tmp_path / "folder").mkdir()
        return tmp_path / "folder" / ".." / "X.svg"
    if kind == "a symbolic link":
        other.symlink_to("X.svg")
    else:
        os.link(drawing, other)
    return other


@pytest.mark.parametrize("kind", ["the same", "a longer way", "a symbolic link", "a hard link"])
def test_a_drawing_that_was_read_is_not_written_over(kind, run, tmp_path):
    (tmp_path / "X.svg").write_text(DRAWING)
    other = same_file(kind, tmp_path)
    code, out, err = run("frame", "X.svg", "--picture", other)
    assert (code, out) == (2, "")
    assert "it was read; name another file, or use --force" in err
    assert err.count("\n") == 1
    assert (tmp_path / "X.svg").read_text() == DRAWING
    assert run("frame", "X.svg", "--picture", other, "--force")[0] == 0
    assert is_ours(other.read_bytes())


def test_upper_case_is_the_same_file_where_the_system_says_so(run, tmp_path):
    # A system that does not tell case apart gives both names one inode, as a hard link does.
    (tmp_path / "X.svg").write_text(DRAWING)
    os.link("X.svg", "x.SVG")
    assert "it was read" in run("frame", "X.svg", "--picture", "x.SVG")[2]


def test_what_was_read_is_kept_though_scadgen_made_it(run, tmp_path):
    assert run("frame", "ring", "-o", "ring.json")[0] == 0
    before = (tmp_path / "ring.json").read_bytes()
    assert "it was read" in run("frame", "ring.json", "-o", "ring.json")[2]
    assert (tmp_path / "ring.json").read_bytes() == before


def test_files_of_others_are_kept_by_every_command_that_writes(run, tmp_path, made):
    (tmp_path / "weave.json").write_text("mine")
    words = {
        "a.json": ("frame", "ring", "-o"),
        "a.svg": ("frame", "ring", "--picture"),
        "a.csv": ("bill", made, "-o"),
        "a.png": ("interlock", "one.stl", "two.stl", "--png"),
        "a.gif": ("interlock", "one.stl", "two.stl", "--gif"),
        "w.json": ("tune", "--rounds", "1", "-o"),
        **{f"part.{kind}": ("export", made, "--part", "half", "-o") for kind in FORMATS},
    }
    for at, name in enumerate(("one.stl", "two.stl")):
        trimesh.creation.box((10, 10, 10)).apply_translation((10 * at, 0, 0)).export(name)
    for name, command in words.items():
        (tmp_path / name).write_text("mine")
        code, out, err = run(*command, name)
        assert (code, out) == (2, ""), name
        assert "scadgen did not make it as it is; name another file, or use --force" in err
        assert (tmp_path / name).read_text() == "mine"


def test_what_scadgen_made_is_written_again_until_somebody_changes_it(run, tmp_path, made):
    for kind in FORMATS:
        command = ("export", made, "--part", "half", "-o", f"part.{kind}")
        assert run(*command)[0] == 0
        first = (tmp_path / f"part.{kind}").read_bytes()
        assert run(*command)[0] == 0
        assert (tmp_path / f"part.{kind}").read_bytes() == first
        for at in (len(first) // 2, 100):
            changed = bytearray(first)
            changed[at] ^= 1
            (tmp_path / f"part.{kind}").write_bytes(changed)
            assert run(*command)[0] == 2
        assert run(*command, "--force")[0] == 0
        assert (tmp_path / f"part.{kind}").read_bytes() == first


def test_an_empty_file_is_no_loss(run, tmp_path):
    (tmp_path / "a.svg").touch()
    assert run("frame", "ring", "--picture", "a.svg")[0] == 0


def test_a_kit_that_was_read_is_kept(run, made):
    before = (made / "kit.json").read_bytes()
    command = ("export", made, "--part", "half", "--format", "stl", "-o", made / "kit.json")
    assert "it was read" in run(*command)[2]
    assert "it was read" in run("bill", made / "kit.json", "-o", made / "kit.json")[2]
    assert (made / "kit.json").read_bytes() == before


def test_a_kit_is_not_put_over_its_drawing(run, tmp_path, made):
    (made / "tri.json").write_text(TRIANGLE)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "tri.json").symlink_to(made / "tri.json")
    for source in (made / "tri.json", "elsewhere/tri.json"):
        code, _, err = run("kit", source, "--unchecked", "--detail", "draft", "-o", made)
        assert code == 2
        assert "'tri.json', which was read; name another folder, or use --force" in err
        assert (made / "tri.json").read_text() == TRIANGLE


def test_files_of_others_in_the_folder_of_a_kit_are_kept(run, made):
    (made / "square.scad").write_text("mine")
    code, _, err = run("kit", "square", "--unchecked", "--detail", "draft", "-o", made)
    assert code == 2
    assert "'square.scad', which is not of the kit there; name another folder, or use" in err
    assert (made / "square.scad").read_text() == "mine"
    # Those of the kit itself are replaced, and what nothing new is called like is kept.
    (made / "notes.txt").write_text("mine")
    assert run("kit", "hexagonal", "--unchecked", "--detail", "draft", "-o", made)[0] == 0
    assert (made / "notes.txt").read_text() == (made / "square.scad").read_text() == "mine"


def test_a_folder_of_other_things_keeps_them_when_a_kit_is_forced_in(run, tmp_path):
    folder = tmp_path / "mine"
    (folder / "stl").mkdir(parents=True)
    (folder / "stl" / "own.stl").write_text("mine")
    command = ("kit", "hexagonal", "--unchecked", "--detail", "draft", "-o", folder)
    assert "holds other things; name a new folder, or use --force" in run(*command)[2]
    assert run(*command, "--force")[0] == 0
    assert (folder / "stl" / "own.stl").read_text() == "mine"
    assert (folder / "kit.json").is_file()


def test_marked_files_are_what_they_were(tmp_path):
    points, triangles = trimesh.creation.box((1, 2, 3)).vertices, trimesh.creation.box().faces
    for kind in FORMATS:
        path = tmp_path / f"a.{kind}"
        path.write_bytes(marked(mesh_bytes(points, triangles, kind), kind))
        assert is_ours(path.read_bytes())
        loaded = trimesh.load(path, force="mesh")
        assert len(loaded.faces) == 12
        assert loaded.is_watertight
    assert zipfile.ZipFile(tmp_path / "a.3mf").testzip() is None
    data = (tmp_path / "a.glb").read_bytes()
    assert struct.unpack_from("<I", data, 8) == (len(data),)
    assert len((tmp_path / "a.stl").read_bytes()) == 84 + 50 * 12


def test_marked_pictures_are_what_they_were():
    box = trimesh.creation.box()
    meshes = [(box.vertices + np.array([at, 0, 0]), box.faces) for at in (0, 1)]
    plain = {"png": motion_png(meshes, None)}
    film = io.BytesIO()
    frames = [Image.new("P", (9, 9), colour) for colour in (1, 2)]
    frames[0].save(film, "gif", save_all=True, append_images=frames[1:])
    plain["gif"] = film.getvalue()
    for kind, data in plain.items():
        assert not is_ours(data)
        assert is_ours(marked(data, kind))
        before, after = (Image.open(io.BytesIO(d)) for d in (data, marked(data, kind)))
        # A wrong checksum is refused here.
        before.load(), after.load()
        assert before.tobytes() == after.tobytes()
        assert getattr(before, "n_frames", 1) == getattr(after, "n_frames", 1)


def test_json_with_its_mark_is_read_again(run, tmp_path):
    assert run("frame", "ring", "-o", "ring.json")[0] == 0
    assert json.loads((tmp_path / "ring.json").read_text())["comment"].startswith("made by scadgen")
    assert run("frame", "ring.json")[0] == 0
