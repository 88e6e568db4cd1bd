"""Writes what the schema of kits and the workbench hold of live parameters and parts.

usage: python scripts/tables.py
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from xml.sax.saxutils import escape

from scadgen.kit.live import LIVE
from scadgen.kit.parameter import Live
from scadgen.kit.roles import COLOURS, PART_ROLES

__all__ = ["tables"]

ROOT = Path(__file__).parent.parent
SCHEMA = ROOT / "scadgen" / "kit" / "kit.schema.json"
WORKBENCH = ROOT / "freecad_workbench" / "freecad" / "scadgen"

#: The layout of the panel's lengths, and its rows.
_ROWS = re.compile(r'(name="lengths_grid">\n).*?(      </layout>\n)', re.DOTALL)

#: Lowest and highest value that the panel takes, in mm; the engine knows the ranges.
_LOWEST, _HIGHEST = 0.01, 2000.0


def tables() -> Iterator[tuple[Path, str]]:
    """Each file, and its text as the tables have it."""
    yield SCHEMA, _schema(SCHEMA.read_text("utf-8"))
    yield WORKBENCH / "tables.py", _workbench()
    panel = WORKBENCH / "ui" / "new_kit.ui"
    rows = "".join(_row(number, live) for number, live in enumerate(LIVE))
    yield panel, _ROWS.sub(lambda m: m[1] + rows + m[2], panel.read_text("utf-8"))


def _schema(text: str) -> str:
    """The schema with the names that there are, and those that every kit has."""
    names = [live.name for live in LIVE]
    needed = [live.name for live in LIVE if not live.optional]
    text = re.sub(r'("parameter": {"enum": )\[.*?\]', lambda m: m[1] + json.dumps(names), text)
    roles = json.dumps([*PART_ROLES])
    of_parts = re.compile(r'("ends", "length".*?"role": {"enum": )\[.*?\]', re.DOTALL)
    text = of_parts.sub(lambda m: m[1] + roles, text)
    lengths = re.compile(r'("lengths": {[^\[]*?"required": )\[.*?\]')
    return lengths.sub(lambda m: m[1] + json.dumps(needed), text)


def _workbench() -> str:
    """The table as the workbench has it, which imports nothing of scadgen."""
    rows = "".join(
        f'    "{live.name}": (\n        "{live.property_name}",\n'
        f"        {json.dumps(live.text)},\n    ),\n"
        for live in LIVE
    )
    roles = "".join(
        f'    "{name}": ("{role.label}", "{role.alone}", "{role.icon}"),\n'
        for name, role in PART_ROLES.items()
    )
    colours = "".join(f'    "{role}": {colour},\n' for role, colour in COLOURS.items())
    optional = "".join(f'"{live.name}", ' for live in LIVE if live.optional).rstrip()
    return f'''\
"""The live parameters, and what parts are for; written by scripts/tables.py.  Do not edit."""

__all__ = ["COLOURS", "LENGTHS", "OPTIONAL", "PART_ROLES"]

#: The colour of what a placed piece is.
COLOURS = {{
{colours}}}

#: The property that each is, and what it means.
LENGTHS = {{
{rows}}}

#: Those that a kit may lack.
OPTIONAL = ({optional})

#: What a part is for: what it is called, the role whose colour it has alone, its icon.
PART_ROLES = {{
{roles}}}
'''


def _row(number: int, live: Live) -> str:
    """A row of the panel: a tick to say that it is given, and a field for its value."""
    tip = escape(live.text + ("; without a tick there is none" if live.optional else ""))
    ticked = str(isinstance(live.default, float) and not live.optional and not live.by_default)
    return f"""\
       <item row="{number}" column="0">
        <widget class="QCheckBox" name="has_{live.name}">
         <property name="text"><string>{escape(live.label)}</string></property>
         <property name="toolTip"><string>{tip}</string></property>
         <property name="checked"><bool>{ticked.lower()}</bool></property>
        </widget>
       </item>
       <item row="{number}" column="1">
        <widget class="Gui::QuantitySpinBox" name="{live.name}">
         <property name="enabled"><bool>{ticked.lower()}</bool></property>
         <property name="toolTip"><string>{tip}</string></property>
         <property name="unit"><string>mm</string></property>
         <property name="minimum"><double>{_LOWEST}</double></property>
         <property name="maximum"><double>{_HIGHEST}</double></property>
         <property name="singleStep"><double>{live.step}</double></property>
         <property name="rawValue"><double>{live.usual}</double></property>
        </widget>
       </item>
"""


def main() -> None:
    """Bring all of them up to date."""
    for path, text in tables():
        path.write_text(text, "utf-8")
        print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
