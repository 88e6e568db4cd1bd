"""The command line: what works, and every wrong request in one line that says what does."""

import json
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
from kits import kit

import scadgen
from scadgen.cli.main import cli, main
from scadgen.emit.folder import write_kit
from scadgen.joint.weave import BUILT_IN
from scadgen.kit.store import load
from scadgen.solid.mesh import volume
from scadgen.tools.openscad import render
from scadgen.tools.stl import check_stl

ROOT = Path(__file__).parent.parent
DRAFT = ("--detail", "draft")
WEAVE = {name: v for name, v in BUILT_IN["3-fixed"].as_dict().items() if name != "name"}


@pytest.fixture
def run(capsys):
    """Run a command in this process; its status, and what it said on stdout and stderr."""

    def call(*words):
        with pytest.raises(SystemExit) as ended:
            main([str(word) for word in words])
        said = capsys.readouterr()
        return ended.value.code, said.out, said.err

    return call


@pytest.fixture
def refused(run):
    """Run a command that is wrong: status 2, one line on stderr, nothing on stdout."""

    def call(*words):
        code, out, err = run(*words)
        assert (code, out) == (2, ""), (code, out, err)
        assert err.startswith("scadgen: ")
        assert len(err.splitlines()) == 1, err
        return err

    return call


def shell(*words, cwd, **variables):
    """Run a command in a process of its own."""
    environ = os.environ | {"PYTHONPATH": str(ROOT)} | variables
    return subprocess.run(
        [sys.executable, "-c", "from scadgen.cli.main import main; main()", *map(str, words)],
        cwd=cwd,
        env=environ,
        capture_output=True,
        check=False,
        timeout=120,
        stdin=subprocess.DEVNULL,
    )


@cache
def _made():
    return kit("hexagonal")


@pytest.fixture
def folder(tmp_path):
    """Folder with a hexagonal kit."""
    write_kit(_made(), tmp_path / "hexagonal")
    return tmp_path / "hexagonal"


def files(place):
    return sorted(p.relative_to(place).as_posix() for p in place.rglob("*"))


def program(path, text):
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


# What works


def test_alone_it_says_what_it_can_do(run):
    assert run() == run("--help") == run("-h")
    code, out, err = run()
    assert (code, err) == (0, "")
    assert all(re.search(rf"^  {name} ", out, re.MULTILINE) for name in cli.commands)


@pytest.mark.parametrize("command", sorted(cli.commands))
def test_every_command_explains_itself(command, run):
    code, out, err = run(command, "--help")
    assert (code, err) == (0, "")
    assert out.startswith(f"Usage: scadgen {command} ")
    assert "\\b" not in out
    assert all(
        option.split()[0] in out
        for p in cli.commands[command].params
        for option in p.opts
        if option.startswith("-")
    )


def test_version(run):
    assert run("--version") == (0, f"scadgen, version {scadgen.__version__}\n", "")


def test_it_runs_as_a_module():
    command = [sys.executable, "-m", "scadgen", "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == f"scadgen, version {scadgen.__version__}\n"


def test_kit_says_what_to_print_and_what_comes_next(run, tmp_path):
    target = tmp_path / "my kit"
    code, out, err = run("kit", "hexagonal", *DRAFT, "-o", target)
    assert (code, err) == (0, "")
    assert f"{target}: 61 pieces to print for 2 x 2 cells" in out
    assert re.search(r"^ +13 basic$", out, re.MULTILINE)
    assert f"next: scadgen render '{target}'" in out
    assert load(target).name == "hexagonal"


def test_kit_takes_every_option_and_its_command_makes_it_again(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    counts = ("--rows", "1", "--columns", "3", "--key", "loose", *DRAFT)
    lengths = ("--side", "12.5", "--edge-length", "130", "--clearance", "0.15", "--bore", "2")
    peg = ("--peg-width", "4.5", "--peg-clearance", "0.1", "--peg-chamfer", "0.4")
    words = ("kit", "square", *counts, *lengths, *peg, "--material", "PETG")
    code, out, _ = run(*words, "--json", "-o", "one")
    assert code == 0
    said = json.loads(out)
    made = load(tmp_path / "one")
    assert said["folder"] == "one"
    assert said["values"] == dict(made.values)
    assert (made.rows, made.columns, made.key) == (1, 3, "loose")
    assert made.values["side"] == 12.5
    assert made.values["bore"] == 2.0
    assert made.material == "PETG"
    assert made.command.startswith("scadgen kit square ")
    again = made.command.split()[1:]
    assert run(*again, "-o", "other")[0] == 0
    assert (tmp_path / "one" / "kit.json").read_bytes() == (
        tmp_path / "other" / "kit.json"
    ).read_bytes()


def test_the_command_of_a_kit_has_flags_as_they_are_typed(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rail.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="9mm" viewBox="0 0 150 9">'
        '<path stroke="black" d="M0 0 H150"/><text x="9" y="9">rail</text></svg>'
    )
    flags = ("--no-split", "--centre", "--components", "--unchecked")
    assert run("kit", "rail.svg", *DRAFT, *flags, "-o", "one")[0] == 0
    command = load(tmp_path / "one").command.split()
    assert {*flags} < {*command}
    assert "True" not in command
    assert run(*command[1:], "-o", "other")[0] == 0
    assert (tmp_path / "one" / "kit.json").read_bytes() == (
        tmp_path / "other" / "kit.json"
    ).read_bytes()


def test_a_grid_that_is_made_as_other_frames_are_is_told(run, tmp_path):
    words = ("kit", "square", "--rows", 1, "--columns", 1, "--detail", "draft", "--unchecked")
    code, out, _ = run(*words, "--rim", "open", "--snap", 1, "-o", tmp_path / "open")
    assert code == 0
    assert load(tmp_path / "open").rows == 0
    assert out.startswith(
        "note: with --snap and --rim the rows and columns of this square frame cannot be set "
        "later\n"
    )
    assert "note" not in run(*words, "-o", tmp_path / "grid")[1]


def test_kit_goes_into_a_folder_of_the_frames_name(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run("kit", "hexagonal", *DRAFT, "--unchecked")[0] == 0
    assert load(tmp_path / "hexagonal").name == "hexagonal"


@pytest.mark.parametrize("name", [name for name in sorted(BUILT_IN) if name[0] in "34"])
def test_kit_takes_a_built_in_weave(name, run, tmp_path):
    frame = {"3": "hexagonal", "4": "square"}[name[0]]
    # Its proofs are those of the frame's own kit, and tested there.
    words = ("kit", frame, *DRAFT, "--weave", name, "--unchecked", "-o", tmp_path / "kit")
    assert run(*words)[0] == 0
    assert load(tmp_path / "kit").joints[0].weave == BUILT_IN[name].as_dict()


def test_kit_takes_a_weave_from_a_file(run, tmp_path):
    (tmp_path / "mine.json").write_text(json.dumps(WEAVE))
    words = ("kit", "hexagonal", *DRAFT, "--weave", tmp_path / "mine.json", "-o", tmp_path / "kit")
    assert run(*words)[0] == 0
    assert load(tmp_path / "kit").joints[0].weave == {**WEAVE, "name": "mine"}


def test_kit_that_does_not_lock_is_made_only_if_asked_for_unchecked(run, refused, tmp_path):
    straight = {**WEAVE, "ring_ratio": 1.8, "span": 0.5, "amplitude": 0.0, "bend": 0.0}
    (tmp_path / "straight.json").write_text(json.dumps(straight))
    words = ("kit", "hexagonal", *DRAFT, "--weave", tmp_path / "straight.json")
    said = refused(*words, "-o", tmp_path / "kit")
    assert "weave straight: " in said
    assert "--unchecked makes the kit all the same" in said
    assert not (tmp_path / "kit").exists()
    assert run(*words, "--unchecked", "-o", tmp_path / "kit")[0] == 0
    assert load(tmp_path / "kit").joints[0].weave["name"] == "straight"


@pytest.mark.parametrize("kind", ["stl", "3mf", "obj", "glb"])
def test_export_is_read_back_with_the_right_volume(kind, run, folder, tmp_path):
    import trimesh

    made = load(folder)
    for name, changes in (("half", {}), ("basic", {"side": 12.0, "edge_length": 90.0})):
        words = [w for n, v in changes.items() for w in ("--set", f"{n}={v}")]
        output = tmp_path / f"{name}.{kind}"
        code, out, err = run("export", folder, "--part", name, *words, "-o", output)
        solid = made.parts[name]
        assert (code, err) == (0, "")
        assert out == f"{output}: {name}, {len(solid.triangles)} triangles\n"
        read = trimesh.load_mesh(output)
        read.merge_vertices(merge_tex=True, merge_norm=True)
        assert read.is_watertight
        expected = volume(solid.points({**made.values, **changes}), solid.triangles)
        scale = 1e9 if kind == "glb" else 1.0
        assert scale * read.volume == pytest.approx(expected, rel=1e-5)


def test_export_takes_the_format_from_an_option(run, folder, tmp_path):
    stl = ("--format", "stl")
    for name, words in (("a.stl", ()), ("b", stl), ("c.STL", stl), ("d.v2", stl)):
        assert run("export", folder, "--part", "half", *words, "-o", tmp_path / name)[0] == 0
    whole = (tmp_path / "a.stl").read_bytes()
    assert {(tmp_path / name).read_bytes() for name in ("b", "c.STL", "d.v2")} == {whole}


def test_render_draws_the_parts_and_views_that_are_asked_for(run, folder):
    words = ("--part", "half", "--part", "joint", "--set", "clearance=0.3", "--jobs", 2)
    code, out, err = run("render", folder, *words)
    assert (code, err) == (0, "")
    assert [line.split()[0] for line in out.splitlines()[1:]] == [
        f"{folder}/stl/half.stl",
        f"{folder}/stl/joint.stl",
    ]
    assert out.count("watertight") == 2
    made = load(folder)
    solid = made.parts["half"]
    expected = volume(solid.points({**made.values, "clearance": 0.3}), solid.triangles)
    assert check_stl(folder / "stl" / "half.stl") == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("kind", ["stl", "3mf"])
def test_render_draws_every_part(kind, run, folder):
    assert run("render", folder, "--format", kind)[0] == 0
    assert files(folder / kind) == sorted(f"{name}.{kind}" for name in load(folder).parts)


def test_render_draws_pictures(run, folder):
    from PIL import Image

    assert run("render", folder, "--format", "png", "--part", "joint")[0] == 0
    with Image.open(folder / "png" / "joint.png") as picture:
        assert len(picture.convert("RGB").quantize(32).getcolors()) > 8


def test_check_finds_a_kit_good(run, folder):
    code, out, err = run("check", folder)
    assert err == ""
    assert "FAILED" not in out, out
    assert code == 0
    last = out.splitlines()[-1]
    found = re.fullmatch(rf"{folder}: (\d+) of (\d+) checks are good", last)
    assert found
    assert found[1] == found[2]


def test_check_finds_an_edited_kit_bad(run, folder):
    text = json.loads((folder / "kit.json").read_text())
    for point in text["parts"]["connector"]["points"]["side"]:
        point[0] *= 1.01
    (folder / "kit.json").write_text(json.dumps(text))
    code, out, err = run("check", folder, "--json")
    assert (code, err) == (1, "")
    bad = {result["check"] for result in json.loads(out) if not result["good"]}
    assert {"the parameters make this kit", "connectors make up the domain"} <= bad
    last = run("check", folder)[1].splitlines()[-1]
    assert re.fullmatch(rf"{folder}: \d+ of \d+ checks are good; FAILED: .*, \.\.\.", last)


def test_a_process_of_its_own_does_the_same(folder, tmp_path):
    said = shell("export", "hexagonal", "--part", "half", "-o", "half.stl", cwd=tmp_path)
    assert (said.returncode, said.stderr) == (0, b"")
    assert check_stl(tmp_path / "half.stl") > 0
    said = shell("kit", "heptagonal", cwd=tmp_path)
    assert said.returncode == 2
    assert said.stdout == b""
    assert said.stderr.startswith(b"scadgen: frame 'heptagonal': must be a name that ")
    assert said.stderr.count(b"\n") == 1
    assert files(tmp_path) == sorted(
        ["half.stl", "hexagonal", *(f"hexagonal/{name}" for name in files(folder))]
    )


def test_it_can_be_interrupted(folder, tmp_path):
    slow = program(tmp_path / "slow", "exec sleep 50")
    with subprocess.Popen(
        [sys.executable, "-c", "from scadgen.cli.main import main; main()", "render", folder],
        env=os.environ | {"PYTHONPATH": str(ROOT), "SCADGEN_OPENSCAD": slow},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        try:
            process.wait(timeout=3)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert err.strip() == b"scadgen: interrupted"
    assert not (folder / "stl").exists()


# What is refused

NUMBERS = ("ring_ratio", "span", "amplitude", "bend", "periods")
WEAVES = {
    "falls-apart": (2.48, 0.69, 0.89, 0.99, 2.51),
    "slides": (1.8, 0.5, 0.0, 0.0, 1.0),
    "loses-footprint": (1.809, 0.98, 0.093, 0.674, 1.018),
}

BAD_KITS = [
    ("hexagonl", (), "shows (did you mean hexagonal?), or a file that ends in .dxf, "),
    ("", (), "frame '': must be a name that scadgen frame --list shows, or a file that ends in "),
    ("triangular", ("--key", "fixed"), "key = 'fixed': with pegs that are part of tubes a frame"),
    ("ladder", ("--key", "glued"), "key = 'glued': must be one of fixed, loose"),
    ("ladder", ("--rim", "round"), "rim = 'round': must be one of caps, open"),
    ("ladder", ("--weave", "4-loose"), "weave 4-loose: each joint of this frame has one of its"),
    ("ladder", ("--radius", "9"), "frame ladder: no option --radius; it has "),
    ("hexagonal", ("--radius", "100", "--side", "0"), "side = 0 mm: must be 5 to 100 mm"),
    ("hexagonal", ("--radius", "55"), "its joints need edges of 90 mm, and no tile with such"),
    (
        "rectangular",
        ("--radius", "200", "--edge-length", "60"),
        "frame rectangular: --edge-length and --radius: give one of them",
    ),
    ("hexagonal", ("--key", "glued"), "key = 'glued': must be one of fixed, loose"),
    ("hexagonal", ("--detail", "ultra"), "detail = 'ultra': must be one of draft, standard, fine"),
    ("hexagonal", ("--rows", "0"), "rows = 0: must be a whole number from 1 to 100"),
    ("hexagonal", ("--rows", "-3"), "rows = -3: must be a whole number from 1 to 100"),
    ("hexagonal", ("--columns", "101"), "columns = 101: must be a whole number from 1 to 100"),
    ("hexagonal", ("--rows", "1.5"), "'1.5' is not a valid integer"),
    (
        "hexagonal",
        ("--side", "wide"),
        "'wide' is not a length: must be a number of mm, or have a unit, as 8mm",
    ),
    ("hexagonal", ("--side", "-10"), "side = -10 mm: must be a number from 0"),
    ("hexagonal", ("--side", "nan"), "side = nan mm: must be a number from 0"),
    ("hexagonal", ("--side", "inf"), "side = inf mm: must be a number from 0"),
    ("hexagonal", ("--side", "1e308"), "side = 1e+308 mm: must be a number from 0"),
    ("hexagonal", ("--side", "0"), "side = 0 mm: must be 5 to 100 mm"),
    ("hexagonal", ("--bore", "nan"), "bore = nan mm: must be a number from 0"),
    ("hexagonal", ("--clearance", "-0.1"), "clearance = -0.1 mm: must be a number from 0"),
    ("hexagonal", ("--clearance", "2"), "clearance = 2 mm: must be 0 to 0."),
    ("square", ("--clearance", "2"), "clearance = 2 mm: must be 0 to 0."),
    ("hexagonal", ("--edge-length", "20"), "edge_length = 20 mm: must be "),
    ("square", ("--edge-length", "50"), "edge_length = 50 mm: must be "),
    ("hexagonal", ("--edge-length", "5000"), "to 2000 mm"),
    ("hexagonal", ("--peg-width", "9"), "peg_width = 9 mm: must be 1.5 to "),
    ("hexagonal", ("--peg-length", "25"), "peg_length = 25 mm: must be 2.5 to "),
    ("hexagonal", ("--peg-chamfer", "3"), "peg_chamfer = 3 mm: must be 0.1 to 1 mm"),
    ("hexagonal", ("--bore", "5"), "bore = 5 mm: must be 0.7 to 2.4 mm"),
    ("hexagonal", ("--key", "loose", "--peg-length", "3"), "peg_length = 3 mm: must be "),
    ("hexagonal", ("--weave", "granny"), "weave 'granny': neither a file nor one of 2-fixed"),
    ("hexagonal", ("--weave", "falls-apart.json"), "a connector falls apart into 3 pieces"),
    ("square", ("--weave", "slides.json"), "whole connectors lock: 1 parts can move"),
    ("square", ("--weave", "loses-footprint.json"), "weave loses-footprint: only "),
    ("hexagonal", ("--weave", "empty.json"), "weave 'empty.json': not a JSON file"),
    ("hexagonal", ("--weave", "list.json"), "weave list: must be a JSON object with amplitude"),
    ("hexagonal", ("--weave", "words.json"), "weave: span = 'long': must be a number from 0.1"),
    ("hexagonal", ("--weave", "."), "weave '.': neither a file nor one of"),
    ("hexagonal", ("--weave", "/dev/zero"), "weave '/dev/zero': is a device or a pipe: must be a"),
    ("hexagonal", ("--weave", "long.json"), "weave 'long.json': 100001 bytes: at most 100000"),
    ("hexagonal", ("--output", "file"), "cannot write the kit to 'file': it is a file"),
    ("hexagonal", ("--output", "file/kit"), "cannot write the kit to 'file/kit': "),
    ("hexagonal", ("--output", "."), "it is the current folder"),
    ("hexagonal", ("--output", "/proc/kit"), "cannot write the kit to '/proc/kit': "),
    ("hexagonal", ("--gears", "3"), "No such option '--gears'"),
    ("hexagonal", ("square",), "unexpected extra argument"),
]


@pytest.mark.parametrize(
    ("frame", "words", "message"), BAD_KITS, ids=[" ".join((b[0], *b[1])) for b in BAD_KITS]
)
def test_a_kit_that_cannot_be_is_refused(frame, words, message, refused, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, numbers in WEAVES.items():
        entries = dict(zip(NUMBERS, numbers, strict=True))
        Path(f"{name}.json").write_text(json.dumps(entries))
    Path("empty.json").write_text("")
    Path("list.json").write_text("[]")
    Path("long.json").write_text("[" + " " * 99_999 + "]")
    Path("words.json").write_text(json.dumps({**WEAVE, "span": "long"}))
    Path("file").write_text("mine")
    before = files(tmp_path)
    draft = () if "--detail" in words else DRAFT
    assert message in refused("kit", frame, *draft, *words)
    assert files(tmp_path) == before
    assert Path("file").read_text() == "mine"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "Missing argument 'FRAME'"),
        (("hexagonal", "--rows"), "Option '--rows' requires an argument"),
    ],
)
def test_a_kit_of_nothing_is_refused(words, message, refused):
    assert message in refused("kit", *words)


def test_an_unknown_command_is_refused(refused):
    assert "No such command 'knit'" in refused("knit")


EDITS = {
    "truncated": (lambda text: text[: len(text) // 2], "truncated or not JSON"),
    "emptied": (lambda _: "", "truncated or not JSON"),
    "another version": (
        lambda text: text.replace('"version": 5', '"version": 7'),
        "kit version 7: this scadgen",
    ),
    "another format": (lambda text: text.replace("scadgen-kit", "gear-kit"), "not a sound kit"),
    "a value in words": (
        lambda text: text.replace('"clearance": 0.2', '"clearance": "thin"'),
        "at values/clearance: 'thin' is not of type 'number'",
    ),
    "a value out of range": (
        lambda text: text.replace('"clearance": 0.2', '"clearance": 5'),
        "clearance = 5 mm: must be 0 to ",
    ),
    "a value not finite": (
        lambda text: text.replace('"clearance": 0.2', '"clearance": NaN'),
        "NaN is not a number",
    ),
    "a value beyond all numbers": (
        lambda text: text.replace('"edge_length": 60.0', '"edge_length": 1e999'),
        "not a finite number",
    ),
    "a part renamed": (lambda text: text.replace('"half": {', '"gear": {'), "not a sound kit"),
    "corners swapped": (
        lambda text: re.sub(r'"triangles":\[\[(\d+),(\d+)', r'"triangles":[[\2,\1', text),
        "not a closed surface",
    ),
}


@pytest.mark.parametrize(("edit", "message"), EDITS.values(), ids=EDITS)
def test_a_broken_kit_is_refused_by_every_command(edit, message, refused, folder, tmp_path):
    path = folder / "kit.json"
    path.write_text(edit(path.read_text()))
    before = files(tmp_path)
    for words in (
        ("check", folder),
        ("render", folder),
        ("export", folder, "--part", "half", "-o", tmp_path / "half.stl"),
    ):
        said = refused(*words)
        assert message in said
        assert str(path) in said
        assert "make it again" in said
    assert files(tmp_path) == before


@pytest.mark.parametrize("command", ["export", "render", "check"])
def test_what_the_system_says_is_one_line(command, refused, tmp_path):
    words = ("--part", "half", "-o", tmp_path / "half.stl") if command == "export" else ()
    long = tmp_path / ("k" * 300)
    assert refused(command, long, *words) == f"scadgen: {long}: File name too long\n"


def test_no_kit_is_refused_by_every_command(refused, tmp_path):
    for words in (
        ("check", tmp_path),
        ("render", tmp_path / "nothing"),
        ("export", tmp_path, "--part", "half", "-o", tmp_path / "half.stl"),
    ):
        assert "no kit can be read there" in refused(*words)
    assert files(tmp_path) == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--part", "gear"), "part = 'gear': must be one of basic, one_sided"),
        (("--part", "half", "--set", "gear=3"), "--set gear=3: must be NAME=MM with NAME one of"),
        (("--part", "half", "--set", "side"), "--set side: must be NAME=MM"),
        (("--part", "half", "--set", "bore=2"), "--set bore=2: must be NAME=MM"),
        (("--part", "half", "--set", "side=wide"), "--set side=wide: 'wide' is not a length"),
        (("--part", "half", "--set", "side=nan"), "side = nan: must be a finite number"),
        (("--part", "half", "--set", "side=1e999"), "side = inf: must be a finite number"),
        (("--part", "half", "--set", "clearance=3"), "clearance = 3 mm: must be 0 to "),
    ],
)
def test_a_drawing_or_an_export_that_cannot_be_is_refused(
    words, message, refused, folder, tmp_path
):
    before = files(tmp_path)
    assert message in refused("export", folder, *words, "-o", tmp_path / "part.stl")
    assert message in refused("render", folder, *words)
    assert files(tmp_path) == before


@pytest.mark.parametrize(
    ("output", "words", "message"),
    [
        ("half.xyz", (), "'xyz'; stl, 3mf, obj, glb work"),
        ("half", (), "''; stl, 3mf, obj, glb work"),
        ("half.stl", ("--format", "step"), "'step'; stl, 3mf, obj, glb work"),
        ("half.3mf", ("--format", "stl"), "half.3mf' is 3mf by its ending; leave --format out"),
        ("nowhere/half.stl", (), "nowhere/half.stl': No such file or directory"),
        ("folder.stl", (), "it is not a file"),
    ],
)
def test_an_export_to_where_it_cannot_go_is_refused(
    output, words, message, refused, folder, tmp_path
):
    (tmp_path / "folder.stl").mkdir()
    before = files(tmp_path)
    said = refused("export", folder, "--part", "half", *words, "-o", tmp_path / output)
    assert message in said
    assert files(tmp_path) == before


@pytest.mark.parametrize("seconds", ["0", "-1", "nan", "inf", "soon"])
@pytest.mark.parametrize("command", ["render", "check"])
def test_a_time_limit_that_is_none_is_refused(command, seconds, refused, folder):
    assert "--timeout" in refused(command, folder, "--timeout", seconds)


def test_other_options_of_render_are_checked_too(refused, folder):
    assert "--format step: must be stl, 3mf or png" in refused("render", folder, "--format", "step")
    assert "--jobs" in refused("render", folder, "--jobs", "0")
    assert not (folder / "stl").exists()


def test_a_folder_that_cannot_be_written_is_refused(refused, folder):
    (folder / "stl").write_text("mine")
    assert "cannot write to" in refused("render", folder)


# OpenSCAD that is missing, hangs or fails


@pytest.mark.parametrize("command", ["render", "check"])
def test_openscad_missing(command, refused, folder, monkeypatch):
    before = files(folder)
    monkeypatch.setenv("PATH", "/nowhere")
    said = refused(command, folder)
    assert "openscad: not found; install OpenSCAD 2021.01 or newer" in said
    monkeypatch.setenv("SCADGEN_OPENSCAD", "/nowhere/openscad")
    assert "SCADGEN_OPENSCAD = /nowhere/openscad: not found" in refused(command, folder)
    assert files(folder) == before


@pytest.mark.parametrize("command", ["render", "check"])
def test_openscad_hanging(command, refused, folder, tmp_path, monkeypatch):
    before = files(folder)
    monkeypatch.setenv("SCADGEN_OPENSCAD", program(tmp_path / "slow", "sleep 60"))
    said = refused(command, folder, "--timeout", "0.5")
    assert "hexagonal.scad: stopped after 0.5 s; give it more time" in said
    assert files(folder) == before


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("echo out of memory >&2; exit 3", "left with status 3: out of memory"),
        ("exit 1", "left with status 1: it said nothing"),
        ("echo 'WARNING: mesh is not closed' >&2", "WARNING: mesh is not closed"),
        ("exit 0", "wrote nothing"),
        ("kill -9 $$", "left with status -9"),
    ],
)
def test_openscad_failing(text, message, refused, folder, tmp_path, monkeypatch):
    before = files(folder)
    monkeypatch.setenv("SCADGEN_OPENSCAD", program(tmp_path / "broken", text))
    assert message in refused("render", folder)
    assert message in refused("check", folder)
    assert files(folder) == before


def test_an_stl_that_is_not_watertight_is_no_drawing(refused, folder, tmp_path, monkeypatch):
    """A real kit, drawn by a program that leaves out the last triangle."""
    code = (
        "import sys,subprocess as s,pathlib as p;o=p.Path(sys.argv[sys.argv.index('-o')+1]);"
        f"s.run(['{shutil.which('openscad')}',*sys.argv[1:]],check=True);d=o.read_bytes();"
        "n=int.from_bytes(d[80:84],'little')-1;"
        "o.write_bytes(d[:80]+n.to_bytes(4,'little')+d[84:-50])"
    )
    lossy = program(tmp_path / "lossy", f'exec {sys.executable} -c "{code}" "$@"')
    monkeypatch.setenv("SCADGEN_OPENSCAD", lossy)
    assert "half.stl: not watertight: 3 faulty edges" in refused("render", folder, "--part", "half")


# Names that users choose

NASTY = [
    "a */ cube(9); /*",
    'q"uote',
    "it's",
    "line\nbreak",
    "caf\u00e9",
    "-dash",
    "tab\tstop",
    "$(x)",
]


@pytest.mark.parametrize("name", NASTY)
def test_names_from_users_break_nothing(name, tmp_path):
    safe = name.replace("/", "\u2215")
    (tmp_path / f"{safe}.json").write_text(json.dumps(WEAVE))
    words = ("kit", "hexagonal", *DRAFT, "--weave", f"./{safe}.json", "--output", f"./{safe}")
    said = shell(*words, cwd=tmp_path)
    assert (said.returncode, said.stderr) == (0, b"")
    made = load(tmp_path / safe)
    assert made.joints[0].weave["name"] == safe
    drawn = render(
        tmp_path / safe / "hexagonal.scad", tmp_path / "half.stl", {"part": "half"}, timeout=60
    )
    assert drawn.seconds < 60
    expected = volume(made.parts["half"].points(made.values), made.parts["half"].triangles)
    assert check_stl(tmp_path / "half.stl") == pytest.approx(expected, rel=1e-6)
    said = shell(
        "export",
        safe if safe[0] != "-" else f"./{safe}",
        "--part",
        "peg",
        "-o",
        "p.stl",
        cwd=tmp_path,
    )
    assert said.returncode == 0


@pytest.mark.parametrize("encoding", ["utf-8:strict", "ascii:strict"])
def test_names_that_a_terminal_cannot_show_break_nothing(encoding, tmp_path):
    name = os.fsdecode(b"w\xff\xc3\xa9")
    (tmp_path / f"{name}.json").write_text(json.dumps(WEAVE))
    words = ("kit", "hexagonal", *DRAFT, "--weave", f"{name}.json", "-o", name)
    said = shell(*words, cwd=tmp_path, PYTHONIOENCODING=encoding)
    assert said.returncode == 0, said.stderr.decode()
    assert load(tmp_path / name).name == "hexagonal"


def test_messages_about_nasty_names_are_one_line(refused, tmp_path):
    for name in NASTY:
        path = tmp_path / name.replace("/", "\u2215")
        path.write_text("mine")
        assert "it is a file" in refused("kit", "hexagonal", *DRAFT, "--unchecked", "-o", path)
        assert "not a JSON file" in refused("kit", "hexagonal", "--weave", path)
        assert "no kit" in refused("check", tmp_path / "nothing" / path.name)
        assert "must be a kit's folder" in refused("check", path)
