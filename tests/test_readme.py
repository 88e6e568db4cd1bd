"""The kit's README: its tables can be worked out by hand, and names cannot break it."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from stub_kit import COMMAND, stub_kit, with_joint

from scadgen.emit.readme import readme
from scadgen.emit.scad_parameters import limits
from scadgen.errors import InputError
from scadgen.frame.placement import bill
from scadgen.interlock.path import Path
from scadgen.kit.model import Way
from scadgen.kit.ranges import check_values


def table(text, heading):
    """Rows of the first table under a heading, as lists of cells."""
    lines = iter(text[text.index(f"## {heading}") :].splitlines())
    rows = []
    for line in lines:
        if line.startswith("|"):
            rows.append([cell.strip() for cell in line.strip("|").split("|")])
        elif rows:
            break
    assert len({len(row) for row in rows}) == 1
    return rows[2:]


def section(text, heading):
    return text.split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]


@pytest.mark.parametrize("frame", ["hexagonal", "square"])
@pytest.mark.parametrize("key", ["fixed", "loose"])
def test_what_to_print_is_the_bill_of_the_frame(frame, key):
    kit = stub_kit(frame, key=key, rows=2, columns=3)
    *rows, total = table(readme(kit), "What to print")
    counts = {row[1].strip("`"): int(row[3]) for row in rows}
    assert counts == bill(kit.placements, kit.parts)
    assert int(total[3]) == sum(counts.values())


def test_volumes_and_masses_are_those_of_boxes():
    rows = {row[1].strip("`"): row for row in table(readme(stub_kit()), "What to print")}
    # The stub's connector is 2 s - (0.7 s + clearance / 2) long and s square, s = 10 mm:
    # 12.9 x 10 x 10 mm = 1.29 cm3; the frame needs 6 of them, of PLA of 1.24 g/cm3.
    assert rows["connector"][5] == "1.29"
    count = int(rows["connector"][3])
    assert rows["connector"][6] == f"{count * 1.29:.1f}"
    assert rows["connector"][7] == f"{count * 1.29 * 1.24:.1f}"
    for column in (6, 7):
        parts = [float(row[column]) for name, row in rows.items() if name != "all"]
        assert float(rows["all"][column]) == pytest.approx(sum(parts), abs=0.3)


def test_a_proved_kit_says_how_its_order_is_planned():
    checked = with_joint(stub_kit(), verdicts={"whole connectors lock": "9 contacts in balance"})
    for kit, proved in ((checked, True), (stub_kit(), False)):
        text = readme(kit)
        assert (
            "`scadgen plan` of this folder" in section(text, "How to put it together")
        ) == proved
        assert ("| `plan/` |" in text) == proved


@pytest.mark.parametrize(("first", "second"), ["AB", "BA"])
def test_halves_go_in_in_the_order_that_is_proved(first, second):
    # They come out backwards: the last first.
    plain = stub_kit()
    roles = [piece.role for piece in plain.joints[0].pieces]
    still = Path.through(np.zeros((2, 6)), np.zeros(3))
    ways = [
        Way(f"half {half} comes out", (roles.index(f"half_{half.lower()}"),), still)
        for half in (second, first)
    ]
    made = with_joint(plain, verdicts={"half A comes out": "yes"}, ways=tuple(ways))
    text = section(readme(made), "How to put it together")
    assert f"put half {first} and then half {second} into the gap" in text
    assert "put half A and half B into the gap" in readme(plain)


@pytest.mark.parametrize("key", ["fixed", "loose"])
def test_it_says_that_friction_holds_pegs_and_what_helps(key):
    text = section(readme(stub_kit(key=key)), "How to put it together")
    text = " ".join(text.partition("### What holds it")[2].split())
    assert text.startswith("Friction alone holds ")
    assert ("each row" in text) == (key == "fixed")
    assert "slide" in text
    assert "A smaller `peg_clearance` helps, and so does a drop of glue" in text


def test_spares_are_for_small_pieces_only():
    for row in table(readme(stub_kit()), "What to print")[:-1]:
        name, needed, spare = row[1].strip("`"), int(row[3]), row[4]
        if name in ("half", "connector", "peg"):
            assert needed / 10 <= int(spare) < needed / 10 + 1
        else:
            assert spare == ""


def test_live_parameters_have_value_and_range_inside_the_limits():
    kit = stub_kit()
    rows = table(readme(kit), "What can be set")
    assert {row[0].strip("`") for row in rows} == set(kit.values)
    for name, value, low, high, meaning in rows:
        least, most = limits(kit, name.strip("`"), kit.values)
        assert least - 1e-6 <= float(low) <= float(value) <= float(high) <= most + 1e-6
        assert meaning
        # Each end works if nothing else is changed, and no more does.
        for end, step in ((float(low), -0.02), (float(high), 0.02)):
            check_values(kit.ranges, kit.values | {name.strip("`"): end})
            with pytest.raises(InputError):
                check_values(kit.ranges, kit.values | {name.strip("`"): end + step})


def test_solid_kit_says_nothing_of_a_bore_to_set():
    names = [row[0] for row in table(readme(stub_kit(bore=False)), "What can be set")]
    assert "`bore`" not in names


@pytest.mark.parametrize(
    ("frame", "key", "says", "says_not"),
    [
        (
            "hexagonal",
            "fixed",
            ["zigzag", "`two_sided`", "together"],
            ["`one_sided` element above"],
        ),
        ("square", "fixed", ["`one_sided`", "together"], ["zigzag"]),
        ("hexagonal", "loose", ["zigzag", "ring's hole", "any order"], ["other row"]),
        ("square", "loose", ["`one_sided`", "ring's hole", "any order"], ["zigzag"]),
    ],
)
def test_assembly_is_for_this_frame_and_key(frame, key, says, says_not):
    text = section(readme(stub_kit(frame, key=key)), "How to put it together")
    for words in says:
        assert words in text
    for words in says_not:
        assert words not in text
    steps = [int(n) for n in re.findall(r"^(\d)\.", text, re.MULTILINE)]
    assert steps == list(range(1, len(steps) + 1))
    assert len(steps) >= 3


def test_one_joint_is_listed_to_try_first():
    assert "2 x `connector`, 2 x `half`, 1 x `peg`." in readme(stub_kit("hexagonal"))
    assert "3 x `connector`, 2 x `half`, 1 x `peg`." in readme(stub_kit("square"))


def test_it_says_what_is_proved_of_the_joint_or_that_nothing_is():
    unchecked = section(readme(stub_kit()), "What is known about this kit")
    assert "**Unchecked**" in unchecked
    assert "Proved" not in unchecked
    checked = with_joint(stub_kit(), verdicts={"whole connectors lock": "9 contacts in balance"})
    text = section(readme(checked), "What is known about this kit")
    assert "- whole connectors lock: 9 contacts in balance" in text
    assert "nchecked" not in text


def test_command_can_be_copied():
    assert f"\n```\n{COMMAND}\n```\n" in readme(stub_kit())


def test_command_with_backticks_stays_in_its_block():
    text = readme(stub_kit(command="scadgen kit ```x``` # y\n## Not a heading"))
    assert "\n````\nscadgen kit ```x``` # y ## Not a heading\n````\n" in text


def test_kit_made_without_a_command_says_so():
    assert "by a Python program" in section(readme(stub_kit(command="")), "Make this kit again")


@given(
    name=st.text(st.characters(codec="utf-8") | st.sampled_from("`|<>#*_[]\\\n\r\u2028")),
    command=st.text(st.characters(codec="utf-8") | st.sampled_from("`|<>#\n\r\u2028")),
)
def test_no_name_can_change_the_structure(name, command):
    plain = readme(with_joint(stub_kit(command="x"), weave={"name": "x", "span": 1.0}))
    kit = with_joint(stub_kit(command=f"x{command}"), weave={"name": name, "span": 1.0})
    text = readme(kit)
    text.encode()
    assert len(text.splitlines()) == len(plain.splitlines())

    def skeleton(whole):
        return [line for line in whole.splitlines() if line.startswith(("#", "|"))]

    assert skeleton(text) == skeleton(plain)
    assert not re.search(
        r"(?<!\\)[<`]", section(text, "What is known about this kit").split("\n")[2]
    )


@pytest.mark.parametrize("key", ["fixed", "loose"])
def test_no_line_is_left_with_template_or_trailing_blanks(key):
    text = readme(stub_kit(key=key))
    assert not re.search(r"[{}]|[ \t]$", text, re.MULTILINE)
    assert "\n\n\n" not in text
    assert text.endswith("\n")


def test_same_kit_same_text():
    assert readme(stub_kit()) == readme(stub_kit())
