"""Collects the words of the FreeCAD workbench for its translators.

Brings every ``translations/Scadgen_*.ts`` up to date, keeping what is translated, and makes the
``.qm`` files that FreeCAD reads with Qt's lrelease (Debian: ``apt install qttools5-dev-tools``).

usage: python scripts/freecad_translations.py
"""

from __future__ import annotations

import ast
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as ET

from scadgen.kit.live import LIVE
from scadgen.kit.roles import PART_ROLES

__all__ = ["SOURCE", "translated", "words"]

SOURCE = Path(__file__).parent.parent / "freecad_workbench" / "freecad" / "scadgen"

#: Functions that mark words, whatever they are called through.
_MARKS = ("translate", "QT_TRANSLATE_NOOP", "_NOOP")


def words(source: Path = SOURCE) -> list[tuple[str, str]]:
    """Context and text of all words that a person sees, sorted."""
    found = {pair for path in source.rglob("*.py") for pair in _python_words(path)}
    found |= {pair for path in source.rglob("*.ui") for pair in _ui_words(path)}
    found |= {("App::Property", live.text) for live in LIVE}
    found |= {("Scadgen", role.label) for role in PART_ROLES.values()}
    return sorted(found)


def translated(path: Path) -> dict[tuple[str, str], str]:
    """What a ``.ts`` file has: translation by context and text."""
    return {
        (context.findtext("name", ""), message.findtext("source", "")): message.findtext(
            "translation", ""
        )
        for context in ET.parse(path).getroot().iter("context")  # noqa: S314  our own file
        for message in context.iter("message")
    }


def _python_words(path: Path) -> Iterator[tuple[str, str]]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and len(node.args) == 2:
            function = node.func
            name = (
                function.attr
                if isinstance(function, ast.Attribute)
                else getattr(function, "id", "")
            )
            values = [a.value for a in node.args if isinstance(a, ast.Constant)]
            if name in _MARKS and len(values) == 2:
                yield str(values[0]), str(values[1])


def _ui_words(path: Path) -> Iterator[tuple[str, str]]:
    root = ET.parse(path).getroot()  # noqa: S314  our own file
    context = root.findtext("class", "")
    for prop in root.iter("property"):
        text = prop.findtext("string")
        if text and prop.get("name") not in ("unit", "filter", "suffix"):
            yield context, text


def _write(path: Path, known: dict[tuple[str, str], str]) -> list[tuple[str, str]]:
    """Write a ``.ts`` file; gives what is not translated."""
    language = path.stem.partition("_")[2]
    root = ET.Element("TS", version="2.1", language=language, sourcelanguage="en")
    contexts: dict[str, ET.Element] = {}
    missing = []
    for context, text in words():
        if context not in contexts:
            contexts[context] = ET.SubElement(root, "context")
            ET.SubElement(contexts[context], "name").text = context
        message = ET.SubElement(contexts[context], "message")
        ET.SubElement(message, "source").text = text
        translation = ET.SubElement(message, "translation")
        translation.text = known.get((context, text), "")
        if not translation.text:
            translation.set("type", "unfinished")
            missing.append((context, text))
    ET.indent(root, " ")
    text = ET.tostring(root, encoding="unicode")
    path.write_text(f'<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n{text}\n', "utf-8")
    return missing


def main() -> None:
    """Bring all languages up to date."""
    program = shutil.which("lrelease")
    if program is None:
        sys.exit("lrelease: not found; Debian: apt install qttools5-dev-tools")
    for path in sorted((SOURCE / "translations").glob("Scadgen_*.ts")):
        missing = _write(path, translated(path))
        for context, text in missing:
            print(f"{path.name}: {context}: not translated: {text}")
        subprocess.run([program, "-silent", str(path)], check=True)


if __name__ == "__main__":
    main()
