"""A kit's folder: all of its files or none, and nothing of the user's is lost."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from kits import KINDS, drawn, grid, kit, named, proved_kit, tee

from scadgen.emit.folder import files_of, write_kit
from scadgen.errors import InputError
from scadgen.kit.build import build
from scadgen.kit.store import dumps, load
from scadgen.plane.drawn import make_frame

FILES = {
    "kit.json",
    "hexagonal.scad",
    "hexagonal.json",
    "hexagonal.FCMacro",
    "Makefile",
    "check_stl.py",
    "README.md",
    "parts.csv",
    "preview.png",
}


def contents(folder):
    """Everything below a folder: names, and what is in the files."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None
        for path in sorted(folder.rglob("*"))
    }


def test_an_interrupt_while_a_folder_is_replaced_loses_nothing(tmp_path, monkeypatch):
    folder = tmp_path / "kit"
    write_kit(kit("hexagonal"), folder)
    (folder / "mine.txt").write_text("mine")
    before = contents(folder)
    rename = Path.rename

    def interrupted(path, target):
        rename(path, target)
        if path == folder:
            raise KeyboardInterrupt

    monkeypatch.setattr(Path, "rename", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_kit(kit("hexagonal"), folder)
    assert contents(folder) == before
    assert [path.name for path in tmp_path.iterdir()] == ["kit"]


def test_a_frame_whose_files_would_be_named_as_the_kit_is_refused():
    frame = make_frame("Kit", [[0, 0], [99, 0], [0, 99]], [[0, 1], [0, 2], [1, 2]])
    with pytest.raises(InputError, match=r"frame = 'Kit': .*another name"):
        drawn("Kit", frame)


class Interrupted(Exception):  # noqa: N818  what a user does is no error
    """What stops a kit half way."""


def interrupt_at(file):
    def progress(name):
        if name == file:
            raise Interrupted

    return progress


@pytest.mark.parametrize("kind", KINDS, ids=named)
def test_a_kit_is_all_of_its_files(kind, tmp_path):
    made = kit(*kind)
    write_kit(made, tmp_path / "kit")
    names = {name.replace("hexagonal", made.name) for name in FILES}
    assert set(contents(tmp_path / "kit")) == names == set(files_of(made))
    assert all(path.stat().st_size for path in (tmp_path / "kit").iterdir())
    assert dumps(load(tmp_path / "kit")) == dumps(made)
    assert [p.name for p in tmp_path.iterdir()] == ["kit"]


def test_the_manual_names_every_file_of_a_kit():
    manual = (Path(__file__).parent.parent / "README.md").read_text()
    section = manual.split("### A kit's folder\n", 1)[1].split("\n## ", 1)[0]
    for name in [*FILES, *files_of(proved_kit("hexagonal")), "placing.svg"]:
        assert f"`{name}`" in section, name


def test_the_same_request_gives_the_same_bytes(tmp_path):
    for name in ("one", "other"):
        write_kit(build(grid("hexagonal", detail="draft")), tmp_path / name)
    assert contents(tmp_path / "one") == contents(tmp_path / "other")


def test_an_empty_folder_and_folders_that_are_not_there_yet_will_do(tmp_path):
    (tmp_path / "empty").mkdir()
    write_kit(kit("hexagonal"), tmp_path / "empty")
    write_kit(kit("hexagonal"), tmp_path / "a" / "b" / "kit")
    assert contents(tmp_path / "empty") == contents(tmp_path / "a" / "b" / "kit")


def test_a_link_to_a_folder_stays_a_link(tmp_path):
    (tmp_path / "far").mkdir()
    (tmp_path / "near").symlink_to("far")
    write_kit(kit("hexagonal"), tmp_path / "near")
    assert (tmp_path / "near").is_symlink()
    assert set(contents(tmp_path / "far")) == FILES


def test_a_kit_is_replaced_and_other_files_are_kept(tmp_path):
    folder = tmp_path / "kit"
    write_kit(kit("hexagonal"), folder)
    (folder / "notes.txt").write_text("print on Tuesday")
    (folder / "photos" / "2").mkdir(parents=True)
    (folder / "photos" / "2" / "x.jpg").write_bytes(b"\xff\xd8")
    (folder / "gone").symlink_to("nowhere")
    (folder / "all").symlink_to("photos")
    for stale in ("stl", "3mf", "png", "plates", ".build"):
        (folder / stale).mkdir()
        (folder / stale / "half.stl").write_bytes(b"of the old kit")
    write_kit(kit("hexagonal", "loose"), folder)
    assert load(folder).key == "loose"
    assert set(contents(folder)) == FILES | {
        "notes.txt",
        "photos",
        "photos/2",
        "photos/2/x.jpg",
        "gone",
        "all",
    }
    assert (folder / "photos" / "2" / "x.jpg").read_bytes() == b"\xff\xd8"
    assert (folder / "gone").readlink() == Path("nowhere")
    assert (folder / "all").readlink() == Path("photos")
    assert [p.name for p in tmp_path.iterdir()] == ["kit"]


@pytest.mark.parametrize("file", sorted(FILES))
def test_stopped_half_way_nothing_new_is_there(file, tmp_path):
    with pytest.raises(Interrupted):
        write_kit(kit("hexagonal"), tmp_path / "kit", progress=interrupt_at(file))
    assert contents(tmp_path) == {}


@pytest.mark.parametrize("file", sorted(FILES))
def test_stopped_half_way_the_old_kit_is_as_it_was(file, tmp_path):
    write_kit(kit("hexagonal"), tmp_path / "kit")
    (tmp_path / "kit" / "notes.txt").write_text("print on Tuesday")
    before = contents(tmp_path)
    with pytest.raises(Interrupted):
        write_kit(kit("hexagonal", "loose"), tmp_path / "kit", progress=interrupt_at(file))
    assert contents(tmp_path) == before


def refused(folder, *words):
    with pytest.raises(InputError) as error:
        write_kit(kit("hexagonal"), folder)
    text = str(error.value)
    assert text.startswith(f"cannot write the kit to {str(folder)!r}: ")
    assert "name a" in text
    assert "\n" not in text
    assert all(word in text for word in words), text


def test_a_file_in_the_way_is_refused_and_kept(tmp_path):
    (tmp_path / "kit").write_text("mine")
    refused(tmp_path / "kit", "it is a file")
    assert contents(tmp_path) == {"kit": b"mine"}


def test_a_file_in_place_of_a_folder_above_is_refused(tmp_path):
    (tmp_path / "file").write_text("mine")
    refused(tmp_path / "file" / "kit", "in a writable place")
    assert contents(tmp_path) == {"file": b"mine"}


def test_a_folder_that_holds_other_things_is_refused_and_kept(tmp_path):
    (tmp_path / "thesis.tex").write_text("mine")
    refused(tmp_path, "it holds other things")
    assert contents(tmp_path) == {"thesis.tex": b"mine"}


def test_a_name_too_long_is_refused(tmp_path):
    refused(tmp_path / ("k" * 300), "File name too long")
    assert contents(tmp_path) == {}


@pytest.mark.parametrize("name", ["line\nbreak", "it's", 'a "b"'])
def test_a_strange_name_is_shown_on_one_line(name, tmp_path):
    (tmp_path / name).write_text("mine")
    refused(tmp_path / name, "it is a file")


def test_a_place_where_nobody_may_write_is_refused():
    refused(Path("/proc/kit"))


WITH_LITTLE_SPACE = """
import resource, sys
from pathlib import Path
from scadgen.emit.folder import write_kit
from scadgen.errors import InputError
from scadgen.kit.store import load

made = load(Path(sys.argv[1]))
resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
try:
    write_kit(made, Path(sys.argv[2]))
except InputError as error:
    print(error)
"""


@pytest.mark.parametrize("old", [False, True])
def test_a_disk_that_fills_up_leaves_what_was_there(old, tmp_path):
    write_kit(kit("hexagonal", "loose"), tmp_path / "source")
    target = tmp_path / "place" / "kit"
    if old:
        write_kit(kit("hexagonal"), target)
    else:
        target.parent.mkdir()
    before = contents(target.parent)
    said = subprocess.run(
        [sys.executable, "-c", WITH_LITTLE_SPACE, tmp_path / "source", target],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
        cwd=Path(__file__).parent.parent,
    )
    assert "File too large; name a folder in a writable place with space left" in said.stdout
    assert contents(target.parent) == before


def test_the_kit_can_be_moved(tmp_path):
    write_kit(kit("hexagonal"), tmp_path / "kit")
    shutil.move(tmp_path / "kit", tmp_path / "moved")
    for path in (tmp_path / "moved").iterdir():
        assert str(tmp_path).encode() not in path.read_bytes()


def test_a_proved_kit_shows_how_its_joint_is_put_together(tmp_path):
    folder = tmp_path / "kit"
    made = proved_kit("hexagonal")
    write_kit(made, folder)
    assert {path.name for path in folder.iterdir()} == {*FILES, "assembly.png"}
    readme = (folder / "README.md").read_text()
    assert "](assembly.png)" in readme
    assert "Unchecked" not in readme
    # An unchecked one in its place shows nothing.
    write_kit(kit("hexagonal"), folder)
    assert {path.name for path in folder.iterdir()} == FILES


def texts(kit):
    """The kit's text files by name."""
    files = {name: write(kit) for name, write in files_of(kit).items()}
    return {name: text for name, text in files.items() if isinstance(text, str)}


@pytest.mark.parametrize("make", [lambda: kit("hexagonal"), tee])
def test_an_unchecked_kit_says_so_in_every_text(make):
    made = make()
    written = texts(made)
    # JSON and CSV have none, and OpenSCAD's Customizer would take an entry for a set of values.
    del written[f"{made.name}.json"], written["parts.csv"]
    assert '"proved": false' in written.pop("kit.json")
    assert len(written) == (5 if made.cells is not None else 6)
    for name, text in written.items():
        assert "unchecked: nothing was proved" in text.lower().replace("*", ""), name


def test_a_proved_kit_does_not_say_that_it_is_unchecked():
    for name, text in texts(proved_kit("hexagonal")).items():
        assert "unchecked" not in text.lower(), name
