"""Names that are not plain: on terminals that lack their letters, and in lines to be run again."""

import os
import shlex
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scadgen.emit.scad_text import comment
from scadgen.emit.shell import in_ascii, shell_line

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">'
    '<path d="M0 0H200V200Z" fill="none" stroke="black"/></svg>'
)

NAME = "Brücke → ½.svg"


def scadgen(*words, cwd, **environment):
    return subprocess.run(
        [sys.executable, "-m", "scadgen", *map(str, words)],
        cwd=cwd,
        env=os.environ | {"SCADGEN_PROGRESS": "none"} | environment,
        capture_output=True,
        check=False,
    )


#: Terminals that have not all letters of the name; the last one none of them.
TERMINALS = [
    {"PYTHONIOENCODING": "cp1252"},
    {"PYTHONIOENCODING": "ascii"},
    {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
]


@pytest.mark.parametrize("terminal", TERMINALS)
def test_letters_that_a_terminal_lacks_are_no_error(tmp_path, terminal):
    (tmp_path / NAME).write_text(DRAWING)
    done = scadgen("frame", NAME, "-o", "ü→.json", cwd=tmp_path, **terminal)
    assert (done.returncode, done.stderr) == (0, b"")
    assert b"3 vertices, 3 edges" in done.stdout
    # The name is kept in the file, whatever the terminal shows of it.
    assert b'"name": "Br\\u00fccke _ \\u00bd"' in (tmp_path / "ü→.json").read_bytes()
    done = scadgen("frame", f"no {NAME}", cwd=tmp_path, **terminal)
    assert done.returncode == 2
    assert done.stderr.startswith(b"scadgen: no Br")
    assert done.stderr.count(b"\n") == 1


def heard(line):
    """What a shell makes of a line that begins with scadgen."""
    script = "scadgen() { for word; do printf '%s\\0' \"$word\"; done; }\n" + line + "\n"
    done = subprocess.run(["bash", "-c", script], capture_output=True, check=True)
    return [os.fsdecode(word) for word in done.stdout.split(b"\0")[:-1]]


def lines(words):
    """The line of a README, and that of a comment in a Makefile or in OpenSCAD."""
    line = shell_line(["scadgen", *words])
    assert line.isprintable()
    yield line
    remark = comment(in_ascii(line))
    assert remark.isascii()
    assert "*/" not in remark
    assert "/*" not in remark
    yield remark


@pytest.mark.parametrize(
    "name",
    [
        *(NAME, "my  tiles .svg", 'it\'s "one".svg', "a*/b.svg", "/*.svg", "$HOME `x`\\", "", "  "),
        *("a\tb", "a\n\nb\n", "\n", "\u00a0\u2003\u200b", "☃\U0001f600", os.fsdecode(b"br\xfccke")),
    ],
)
def test_a_line_is_run_as_it_stands(name):
    for line in lines(["kit", name, "--side", "8.0"]):
        assert heard(line) == ["kit", name, "--side", "8.0"]


@given(st.lists(st.text(st.characters(exclude_characters="\0", codec="utf-8")), max_size=3))
def test_any_words_are_run_as_they_stand(words):
    for line in lines(words):
        assert heard(line) == words


def test_plain_words_stay_plain():
    words = ["scadgen", "kit", "drawing.svg", "--side", "8.0", "my tiles"]
    assert shell_line(words) == shlex.join(words)


def test_a_kit_is_made_again_by_the_line_in_its_makefile(tmp_path):
    folder = tmp_path / "a*"
    folder.mkdir()
    (folder / NAME).write_text(DRAWING)
    options = ("--detail", "draft", "--unchecked", "--side", "0.6cm", "--snap", "0.1mm")
    assert scadgen("kit", f"a*/{NAME}", *options, "-o", "one", cwd=tmp_path).returncode == 0
    makefile = (tmp_path / "one" / "Makefile").read_text()
    line = next(row for row in makefile.splitlines() if row.startswith("#   scadgen"))
    words = heard(line.removeprefix("#   "))
    assert scadgen(*words, "-o", "two", cwd=tmp_path).returncode == 0
    kits = [(tmp_path / name / "kit.json").read_bytes() for name in ("one", "two")]
    assert kits[0] == kits[1]
