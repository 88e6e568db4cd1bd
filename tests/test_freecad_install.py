"""``scadgen freecad``: the workbench goes where FreeCAD looks, and nothing of others is touched."""

import errno
import json
import os
import shutil
import stat
from pathlib import Path

import pytest

import scadgen
from scadgen.cli.main import main
from scadgen.emit.macro import workbench
from scadgen.errors import InputError
from scadgen.tools import freecad
from scadgen.tools.workbench import inspect, install, uninstall


@pytest.fixture
def run(capsys):
    """Run a command; its status, and what it said on stdout and stderr."""

    def call(*words):
        with pytest.raises(SystemExit) as ended:
            main(["freecad", *map(str, words)])
        said = capsys.readouterr()
        return ended.value.code, said.out, said.err

    return call


@pytest.fixture
def home(tmp_path, monkeypatch):
    """Home of a user without any FreeCAD, and none on the path."""
    for name in ("FREECAD_USER_HOME", "FREECAD_USER_DATA", "XDG_DATA_HOME", "SCADGEN_FREECAD"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("PATH", str(tmp_path / "none"))
    return tmp_path


def test_a_link_leads_to_the_workbench(tmp_path):
    done = install(tmp_path / "Mod", copy=False)
    assert (done.kind, done.version, done.current) == ("link", scadgen.__version__, True)
    assert done.where.resolve() == workbench().resolve()
    assert install(tmp_path / "Mod", copy=False) == done
    assert uninstall(tmp_path / "Mod").kind == "link"
    assert [*(tmp_path / "Mod").iterdir()] == []
    assert (workbench() / "package.xml").is_file()


def test_a_copy_is_whole_and_goes_away_again(tmp_path):
    done = install(tmp_path, copy=True)
    assert (done.kind, done.current) == ("copy", True)
    files = {p.relative_to(workbench()) for p in workbench().rglob("*") if p.is_file()}
    ours = {p for p in files if "__pycache__" not in p.parts}
    copied = {p.relative_to(done.where) for p in done.where.rglob("*") if p.is_file()}
    assert copied == ours | {Path(".scadgen-copy.json")}
    (done.where / "freecad" / "scadgen" / "__pycache__").mkdir()
    (done.where / "freecad" / "scadgen" / "__pycache__" / "x.pyc").write_bytes(b"")
    uninstall(tmp_path)
    assert [*tmp_path.iterdir()] == []


def test_ours_is_replaced_by_ours(tmp_path):
    for copy in (True, False, True, True):
        assert install(tmp_path, copy=copy).kind == ("copy" if copy else "link")
        assert [p.name for p in tmp_path.iterdir()] == ["Scadgen"]


def test_an_older_copy_is_brought_up_to_date(tmp_path):
    where = install(tmp_path, copy=True).where
    about = json.loads((where / ".scadgen-copy.json").read_text())
    del about["files"]["README.md"]
    (where / "README.md").unlink()
    (where / ".scadgen-copy.json").write_text(json.dumps(about))
    found = inspect(tmp_path)
    assert (found.kind, found.current) == ("copy", False)
    assert install(tmp_path, copy=True).current
    assert (where / "README.md").is_file()


def test_what_is_there_comes_back_if_its_successor_cannot_be_put_there(tmp_path, monkeypatch):
    before = install(tmp_path, copy=True)
    rename = Path.rename

    def fail_for_the_new(path, target):
        if path.name == "new":
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", fail_for_the_new)
    with pytest.raises(InputError, match="cannot be changed"):
        install(tmp_path, copy=False)
    assert inspect(tmp_path) == before
    assert [p.name for p in tmp_path.iterdir()] == ["Scadgen"]


def folder(where):
    where.mkdir()
    (where / "mine.txt").write_text("mine")


def changed(where):
    install(where.parent, copy=True)
    (where / "README.md").write_text("mine")


def grown(where):
    install(where.parent, copy=True)
    (where / "mine.txt").write_text("mine")


def link(where):
    (where.parent / "elsewhere").mkdir()
    where.symlink_to(where.parent / "elsewhere")


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (folder, "a folder"),
        (lambda where: where.write_text("mine"), "a file"),
        (changed, "a copy in which README.md was changed"),
        (grown, "a copy in which mine.txt was changed"),
        (link, "a link to "),
        (lambda where: where.symlink_to("nowhere"), "a link to nowhere"),
    ],
)
def test_what_others_put_there_stays(make, what, tmp_path):
    make(tmp_path / "Scadgen")
    before = {p: p.lstat().st_mtime_ns for p in tmp_path.rglob("*")}
    for act in (
        lambda: install(tmp_path, copy=False),
        lambda: install(tmp_path, copy=True),
        lambda: uninstall(tmp_path),
    ):
        with pytest.raises(InputError, match="which scadgen did not put there") as refused:
            act()
        assert what in str(refused.value)
        assert "\n" not in str(refused.value)
    assert {p: p.lstat().st_mtime_ns for p in tmp_path.rglob("*")} == before


def test_nothing_to_remove_and_a_folder_that_cannot_be_made(tmp_path, run):
    code, out, err = run("uninstall", "--mod", tmp_path)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert "nothing is installed there" in err
    (tmp_path / "file").write_text("")
    code, out, err = run("install", "--mod", tmp_path / "file" / "Mod")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "cannot be changed" in err


@pytest.mark.parametrize("command", ["status", "install", "uninstall"])
def test_a_folder_that_no_system_can_have_is_refused(command, tmp_path, run):
    code, out, err = run(command, "--mod", tmp_path / ("x" * 300))
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "cannot be looked at (File name too long); name a writable folder with --mod" in err


def test_status_is_the_answer(tmp_path, run):
    assert run("status", "--mod", tmp_path)[0] == 1
    code, out, err = run("install", "--mod", tmp_path)
    assert (code, err) == (0, "")
    assert str(tmp_path / "Scadgen") in out
    code, out, err = run("status", "--mod", tmp_path, "--json")
    assert (code, err) == (0, "")
    said = json.loads(out)
    assert (said["kind"], said["current"], said["version"]) == ("link", True, scadgen.__version__)
    assert said["where"] == str(tmp_path / "Scadgen")
    assert said["source"] == str(workbench())
    assert run("uninstall", "--mod", tmp_path)[0] == 0
    assert run("status", "--mod", tmp_path)[0] == 1


@pytest.mark.parametrize(
    ("made", "variables", "mod"),
    [
        ([], {}, ".local/share/FreeCAD/Mod"),
        ([], {"XDG_DATA_HOME": "data"}, "data/FreeCAD/Mod"),
        ([".FreeCAD"], {}, ".FreeCAD/Mod"),
        ([".FreeCAD", ".local/share/FreeCAD"], {}, ".local/share/FreeCAD/Mod"),
        (
            [".local/share/FreeCAD/v1-1", ".local/share/FreeCAD/v1-10"],
            {},
            ".local/share/FreeCAD/v1-10/Mod",
        ),
        (["own"], {"FREECAD_USER_HOME": "own"}, "own/Mod"),
        ([], {"FREECAD_USER_HOME": "missing"}, ".local/share/FreeCAD/Mod"),
        (["a", "b"], {"FREECAD_USER_HOME": "a", "FREECAD_USER_DATA": "b"}, "b/Mod"),
    ],
)
def test_the_folder_without_freecad(made, variables, mod, home, monkeypatch, run):
    for name in made:
        (home / name).mkdir(parents=True)
    for name, value in variables.items():
        monkeypatch.setenv(name, str(home / value))
    assert freecad.mod_folder(None) == home / mod
    code, out, _ = run("status")
    assert code == 1
    assert out.startswith("FreeCAD: not found on the path")
    assert str(home / mod / "Scadgen") in out


@pytest.mark.parametrize("variable", ["FREECAD_USER_HOME", "XDG_DATA_HOME"])
def test_freecad_says_where_it_looks(variable, home, monkeypatch):
    path = os.pathsep.join(["/usr/bin", "/usr/local/bin"])
    program = shutil.which("freecadcmd", path=path)
    assert program, "freecadcmd: not found; make setup installs it"
    monkeypatch.setenv("SCADGEN_FREECAD", program)
    monkeypatch.setenv(variable, str(home))
    found = freecad.find()
    assert tuple(map(int, found.version.split("."))) >= (0, 20)
    assert freecad.mod_folder(found) == freecad.mod_folder(None)


def test_a_freecad_that_does_not_answer_is_none(home, monkeypatch, run):
    program = home / "freecadcmd"
    program.write_text("#!/bin/sh\nexit 1\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("SCADGEN_FREECAD", str(program))
    assert freecad.find() is None
    monkeypatch.setenv("SCADGEN_FREECAD", str(home / "nowhere"))
    code, out, err = run("status")
    assert (code, out) == (2, "")
    assert "SCADGEN_FREECAD" in err
    assert err.count("\n") == 1
