"""Running OpenSCAD, reading its STL back, and the kit's own Makefile."""

import math
import os
import re
import shutil
import stat
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from stub_kit import stub_kit

from scadgen.emit.makefile import makefile, stl_check
from scadgen.emit.mesh import mesh_bytes
from scadgen.emit.scad import scad
from scadgen.errors import InputError, ToolError
from scadgen.solid.mesh import volume
from scadgen.tools.openscad import PICTURE, define, render
from scadgen.tools.stl import check_stl, read_stl

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
CUBE_FACES = np.array(
    [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]
)  # fmt: skip
SLOW = "minkowski() { sphere(9, $fn = 90); difference() { sphere(5, $fn = 90); cube(9); } }"


@pytest.fixture
def source(tmp_path):
    """Make a file in an empty folder, and say what else is in that folder later."""

    def write(text):
        path = tmp_path / "thing.scad"
        path.write_text(text, encoding="utf-8")
        return path

    return write


# ---- render


def test_render_writes_a_binary_stl_and_tells_what_was_said(source, tmp_path):
    path = source('side = 1;\nname = "";\necho(name);\ncube(side);')
    output = tmp_path / "cube.stl"
    drawn = render(path, output, {"side": 2.5, "name": 'a "b" \\'}, timeout=60)
    assert drawn.output == output
    assert drawn.echoes == ('"a "b" \\"',)
    assert drawn.seconds > 0
    assert check_stl(output) == pytest.approx(2.5**3)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["cube.stl", "thing.scad"]


@pytest.mark.parametrize("suffix", [".3mf", ".off", ".png"])
def test_other_formats(suffix, source, tmp_path):
    output = tmp_path / f"cube{suffix}"
    render(source("cube();"), output, {}, timeout=60, options=PICTURE if suffix == ".png" else ())
    start = {".3mf": b"PK", ".off": b"OFF", ".png": b"\x89PNG"}[suffix]
    assert output.read_bytes().startswith(start)
    assert sorted(p.name for p in tmp_path.iterdir()) == [output.name, "thing.scad"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('assert(false, "side = 9: must be 1 to 5"); cube();', "ERROR: .*side = 9: must be 1 to 5"),
        ("cube(nowhere);", "WARNING: .*nowhere"),
        ("cube(", "ERROR: .*syntax error"),
        ("", "empty|status 1"),
    ],
)
def test_bad_renders_raise_one_line_and_leave_the_old_output(text, message, source, tmp_path):
    output = tmp_path / "cube.stl"
    output.write_bytes(b"before")
    with pytest.raises(ToolError, match=message) as caught:
        render(source(text), output, {}, timeout=60)
    assert "\n" not in str(caught.value)
    assert "thing.scad" in str(caught.value)
    assert output.read_bytes() == b"before"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["cube.stl", "thing.scad"]


def children(marker):
    """Processes whose command line has the marker."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes()
        except OSError:
            continue
        if marker.encode() in command:
            found.append(int(folder.name))
    return found


@pytest.mark.parametrize("suffix", [".stl", ".png"])
def test_time_limit_ends_openscad_and_only_that(suffix, source, tmp_path):
    path = source("render() " + SLOW)
    with subprocess.Popen(["sleep", "60"]) as bystander:
        begun = time.monotonic()
        with pytest.raises(ToolError, match=r"thing.scad: stopped after 1 s"):
            render(path, tmp_path / f"slow{suffix}", {}, timeout=1)
        assert time.monotonic() - begun < 20
        assert children(str(path)) == []
        assert bystander.poll() is None
        bystander.kill()
    assert [p.name for p in tmp_path.iterdir()] == ["thing.scad"]


def test_requests_that_openscad_would_pass_over_are_refused(source, tmp_path):
    path = source("side = 1;\ncube(side);")
    with pytest.raises(InputError, match=r"setting 'sied': thing.scad has no such variable"):
        render(path, tmp_path / "cube.stl", {"sied": 2}, timeout=60)
    with pytest.raises(InputError, match=r"setting 'side=1;x': thing.scad has no such variable"):
        render(path, tmp_path / "cube.stl", {"side=1;x": 2}, timeout=60)
    with pytest.raises(InputError, match=r"none.scad: no such file"):
        render(tmp_path / "none.scad", tmp_path / "cube.stl", {}, timeout=60)
    with pytest.raises(InputError, match="none: no such folder"):
        render(path, tmp_path / "none" / "cube.stl", {}, timeout=60)
    with pytest.raises(InputError, match=r"cube.step: format must be one of .stl, .3mf"):
        render(path, tmp_path / "cube.step", {}, timeout=60)


def test_a_missing_program_says_what_to_install(source, tmp_path, monkeypatch):
    monkeypatch.setenv("SCADGEN_OPENSCAD", "openscad-of-tomorrow")
    with pytest.raises(ToolError, match="openscad-of-tomorrow: not found; install OpenSCAD"):
        render(source("cube();"), tmp_path / "cube.stl", {}, timeout=60)
    monkeypatch.delenv("SCADGEN_OPENSCAD")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ToolError, match="openscad: not found; install OpenSCAD"):
        render(source("cube();"), tmp_path / "cube.stl", {}, timeout=60)


def test_a_picture_without_xvfb_says_what_to_install(source, tmp_path, monkeypatch):
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/openscad").symlink_to(shutil.which("openscad"))
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(ToolError, match="xvfb-run: not found; a picture needs it"):
        render(source("cube();"), tmp_path / "cube.png", {}, timeout=60)


def test_another_openscad_can_be_named(source, tmp_path, monkeypatch):
    other = tmp_path / "my openscad"
    other.write_text(f'#!/bin/sh\necho "ECHO: mine" >&2\nexec {shutil.which("openscad")} "$@"\n')
    other.chmod(other.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("SCADGEN_OPENSCAD", str(other))
    assert render(source("cube();"), tmp_path / "c.stl", {}, timeout=60).echoes == ("mine",)


def test_strings_arrive_as_they_are(source, tmp_path):
    texts = ['"', "\\", 'a"; cube(9); "', "a\nb", "\t", "caf\u00e9", "$(touch x)", "*/ //", ""]
    path = source("texts = [];\nfor (t = texts) echo([for (c = t) ord(c)]);\ncube();")
    drawn = render(path, tmp_path / "c.stl", {"texts": texts}, timeout=60)
    said = [[int(x) for x in re.findall(r"\d+", line)] for line in drawn.echoes]
    assert said == [[ord(c) for c in text] for text in texts]
    assert not (tmp_path / "x").exists()


def test_values_arrive_as_they_are(source, tmp_path):
    path = source(
        "v = 0;\nassert(v[0] == 0.1 + 0.2 && v[1] == true && v[2] == [1, 2.5] && v[3] != v[3]);"
        "\nassert(v[4] == 1 / 0 && v[5] == -1 / 0 && v[6] == 1e-300);\ncube();"
    )
    values = [0.1 + 0.2, True, [1, 2.5], math.nan, math.inf, -math.inf, 1e-300]
    render(path, tmp_path / "c.stl", {"v": values}, timeout=60)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_keep_every_digit(value):
    assert float(define(value)) == value


# ---- STL


def stl(path, points, triangles):
    path.write_bytes(mesh_bytes(points, triangles, "stl"))
    return path


def test_stl_read_back(tmp_path):
    points, triangles = read_stl(stl(tmp_path / "cube.stl", 3 * CUBE, CUBE_FACES))
    assert len(points) == 8
    assert triangles.shape == (12, 3)
    assert volume(points, triangles) == pytest.approx(27)


def test_faulty_stl_is_told(tmp_path):
    path = tmp_path / "cube.stl"
    with pytest.raises(ToolError, match="not watertight: 3 faulty edges, the first at"):
        check_stl(stl(path, CUBE, CUBE_FACES[1:]))
    turned = np.vstack([CUBE_FACES[:1, ::-1], CUBE_FACES[1:]])
    with pytest.raises(ToolError, match="not watertight"):
        check_stl(stl(path, CUBE, turned))
    with pytest.raises(ToolError, match=r"volume = -1 mm3: must be above 0"):
        check_stl(stl(path, CUBE, CUBE_FACES[:, ::-1]))
    with pytest.raises(ToolError, match=r"volume = 0 mm3: must be above 0; it is flat"):
        check_stl(stl(path, CUBE, np.array([[0, 1, 2], [0, 2, 1]])))
    whole = stl(path, CUBE, CUBE_FACES).read_bytes()
    path.write_bytes(whole[:-1])
    with pytest.raises(ToolError, match=f"{len(whole) - 1} bytes: not a whole binary STL"):
        check_stl(path)
    path.write_bytes(b"")
    with pytest.raises(ToolError, match="0 bytes: not a whole binary STL"):
        check_stl(path)
    path.write_bytes(bytes(84))
    with pytest.raises(ToolError, match="has no triangles"):
        check_stl(path)
    path.write_bytes(whole[:96] + b"\x00\x00\xc0\x7f" + whole[100:])
    with pytest.raises(ToolError, match="a coordinate is not finite"):
        check_stl(path)


# ---- the kit's Makefile


class Project:
    """A kit's folder."""

    def __init__(self, folder, kit):
        self.folder = folder
        self.kit = kit
        self.scad = folder / f"{kit.name}.scad"
        folder.mkdir()
        self.scad.write_text(scad(kit), encoding="ascii")
        (folder / "Makefile").write_text(makefile(kit), encoding="ascii")
        (folder / "check_stl.py").write_text(stl_check(kit), encoding="ascii")

    def make(self, *arguments):
        environ = {k: v for k, v in os.environ.items() if not k.startswith("MAKE")}
        return subprocess.run(
            ["make", *arguments],
            cwd=self.folder,
            env=environ,
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )

    def files(self, folder="stl"):
        return sorted(p.name for p in (self.folder / folder).glob("*"))

    def edit(self, old, new):
        text = self.scad.read_text()
        assert old in text
        self.scad.write_text(text.replace(old, new, 1))


@pytest.fixture
def project(tmp_path):
    # A folder with a space in its name, as users have.
    return Project(tmp_path / "my kit", stub_kit())


def test_make_draws_and_checks_every_part_once(project):
    first = project.make("-j2")
    assert first.returncode == 0, first.stderr
    names = list(project.kit.parts)
    assert project.files() == sorted(f"{n}.stl" for n in names)
    assert first.stdout.count("watertight") == len(names)
    for name, solid in project.kit.parts.items():
        expected = volume(solid.points(project.kit.values), solid.triangles)
        assert check_stl(project.folder / f"stl/{name}.stl") == pytest.approx(expected, rel=1e-6)
    assert "watertight" not in project.make("-j2").stdout
    again = time.time() + 2
    os.utime(project.scad, (again, again))
    assert project.make("-j2").stdout.count("watertight") == len(names)


def test_make_draws_again_when_settings_change_and_only_then(project):
    target = "stl/half.stl"
    assert project.make(target).returncode == 0
    before = check_stl(project.folder / target)
    settings = "SET=-D clearance=0.4 -D 'side=10'"
    changed = project.make(target, settings)
    assert changed.returncode == 0, changed.stderr
    assert check_stl(project.folder / target) < before
    assert "watertight" not in project.make(target, settings).stdout
    assert "watertight" in project.make(target).stdout
    assert check_stl(project.folder / target) == before


def test_make_follows_what_the_file_includes(project):
    (project.folder / "extra.scad").write_text("function extra() = 1;\n")
    project.scad.write_text("include <extra.scad>\n" + project.scad.read_text())
    assert project.make("stl/peg.stl").returncode == 0
    later = time.time() + 2
    os.utime(project.folder / "extra.scad", (later, later))
    assert "watertight" in project.make("stl/peg.stl").stdout


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        # One face of the peg is missing: OpenSCAD itself says nothing and leaves with 0.
        ("[8,10,9],[8,11,10]];", "[8,10,9]];", "not watertight"),
        ("\nclearance = 0.2;", "\nclearance = 9;", "clearance = 9 mm: must be 0.02 to 0.4"),
        ("_main();\n\n", "_main();\ntranslate(nowhere) cube();\n", "WARNING: .*nowhere"),
        # A solid that OpenSCAD unites with another is not the one the file meant.
        ("_main();\n\n", "_main();\ntranslate([9, 9, 9]) cube();\n", "volume = .*: must be"),
        ("_main();\n\n", "\n", "empty|status|volume"),
    ],
)
def test_make_fails_loudly_and_leaves_no_stl(old, new, message, project):
    assert project.make("stl/peg.stl").returncode == 0
    project.edit(old, new)
    later = time.time() + 2
    os.utime(project.scad, (later, later))
    said = project.make("stl/peg.stl")
    assert said.returncode != 0
    assert re.search(message, said.stderr)
    assert "stl/peg.stl: failed" in said.stderr
    assert project.files() == []
    assert not list(project.folder.glob(".build/*.stl"))


def test_make_plates_draws_as_many_as_the_file_says(project):
    small = "SET=-D 'bed=[90, 120]'"
    said = project.make("plates", "-j2", small)
    assert said.returncode == 0, said.stderr
    many = project.files("plates")
    assert len(many) > 1
    assert many == sorted(f"plate_{i + 1}.3mf" for i in range(len(many)))
    assert "watertight" not in project.make("plates", small).stdout
    assert project.make("plates").returncode == 0
    assert project.files("plates") == ["plate_1.3mf"]
    failed = project.make("plates", "SET=-D bed=[20,20]")
    assert failed.returncode != 0
    assert "too small for" in failed.stderr


def test_make_everything_else(project):
    said = project.make("-j2", "3mf", "joint-plate", "joint", "frame", "coupon", "png")
    assert said.returncode == 0, said.stderr
    assert project.files("3mf") == sorted(f"{n}.3mf" for n in project.kit.parts)
    assert project.files("plates") == ["joint.3mf"]
    assert project.files() == ["coupon.stl", "frame.stl", "joint.stl", "joint_exploded.stl"]
    pictures = ["frame.png", "joint.png", "joint_exploded.png"]
    assert project.files("png") == pictures
    for name in pictures:
        assert (project.folder / "png" / name).read_bytes().startswith(b"\x89PNG")
    assert project.make("clean").returncode == 0
    left = ["Makefile", "check_stl.py", "hexagonal.scad"]
    assert sorted(p.name for p in project.folder.iterdir()) == left


def test_make_png_fails_on_a_failed_assert(project):
    failed = project.make("png/joint.png", "SET=-D clearance=9")
    assert failed.returncode != 0
    assert "clearance = 9 mm: must be" in failed.stderr
    assert project.files("png") == []


def test_make_help_names_every_target(project):
    said = project.make("help").stdout
    plates = ("plates", "joint-plate")
    for target in ("-j2", "3mf", *plates, "png", "joint", "frame", "coupon", "clean"):
        assert f"make {target} " in said
    assert "python3" in said


def test_make_without_python_or_openscad_fails(project):
    for variable in ("PYTHON", "OPENSCAD"):
        said = project.make("stl/peg.stl", f"{variable}=not-there")
        assert said.returncode != 0
        assert project.files() == []


def test_nasty_command_stays_in_the_makefiles_comment(tmp_path):
    kit = stub_kit(command="x \\\nall:\n\ttouch $(shell touch owned) owned \\")
    project = Project(tmp_path / "kit", kit)
    assert project.make("stl/peg.stl").returncode == 0
    assert not (project.folder / "owned").exists()
    assert makefile(kit) == makefile(kit)


def checked(project, *arguments):
    command = [sys.executable, "-I", project.folder / "check_stl.py", *arguments]
    said = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    return said.returncode, said.stdout + said.stderr


def test_the_kits_checker_alone(project, tmp_path):
    path = stl(tmp_path / "cube.stl", CUBE, CUBE_FACES)
    log = tmp_path / "log"
    assert checked(project, path) == (0, "cube.stl: watertight, 12 triangles, 1 mm3\n")
    for text, message in {
        'ECHO: "volume = 1.1 mm3"\n': "volume = 1 mm3: must be 1.1",
        "nothing\n": "the log states no volume",
        'ECHO: "volume = 1 mm3"\nEXPORT-WARNING: open\n': "EXPORT-WARNING: open",
    }.items():
        log.write_text(text)
        status, said = checked(project, path, log)
        assert status == 1
        assert message in said
    for triangles, message in (
        (CUBE_FACES[1:], "not watertight"),
        (CUBE_FACES[:, ::-1], "inside out"),
        (np.array([[0, 1, 2], [0, 2, 1]]), "flat"),
    ):
        status, said = checked(project, stl(path, CUBE, triangles))
        assert status == 1
        assert message in said
    for data, message in ((bytes(84), "has no triangles"), (b"solid", "not a whole binary STL")):
        path.write_bytes(data)
        status, said = checked(project, path)
        assert status == 1
        assert message in said
    assert checked(project, tmp_path / "none.stl")[0] == 1
    (tmp_path / "not.3mf").write_bytes(b"PK")
    assert checked(project, tmp_path / "not.3mf")[0] == 1
