"""What every module gives to others: listed, sorted, there, and explained."""

import ast
import importlib
import inspect
import pkgutil
import re
import tomllib
from pathlib import Path

import pytest

import scadgen

ROOT = Path(scadgen.__file__).parent
MODULES = sorted(m.name for m in pkgutil.walk_packages(scadgen.__path__, "scadgen.") if not m.ispkg)


def public(name):
    module = importlib.import_module(name)
    return [(n, getattr(module, n)) for n in module.__all__]


def test_every_file_is_a_module_that_is_looked_at():
    files = {p.relative_to(ROOT.parent) for p in ROOT.rglob("*.py") if p.name != "__init__.py"}
    assert {".".join(p.with_suffix("").parts) for p in files} == set(MODULES)
    assert len(MODULES) > 40


@pytest.mark.parametrize("name", MODULES)
def test_a_module_lists_what_it_gives_sorted_and_explains_it(name):
    module = importlib.import_module(name)
    assert module.__doc__
    assert len(module.__all__) == len(set(module.__all__))
    # Constants, then classes, then functions, each by name: as the linter sorts them.
    kinds = [(not n.isupper(), not n[0].isupper(), n) for n in module.__all__]
    assert kinds == sorted(kinds)
    for known, thing in public(name):
        if inspect.isfunction(thing) or inspect.isclass(thing):
            assert inspect.getdoc(thing), known


@pytest.mark.parametrize("name", MODULES)
def test_what_looks_public_is_listed(name):
    module = importlib.import_module(name)
    tree = ast.parse(inspect.getsource(module))
    defined = {
        node.name
        for node in tree.body
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_")
    }
    assert defined <= set(module.__all__)


@pytest.mark.parametrize("name", MODULES)
def test_what_is_private_is_not_imported_from_elsewhere(name):
    tree = ast.parse(inspect.getsource(importlib.import_module(name)))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("scadgen"):
            assert not [a.name for a in node.names if a.name[0] == "_" and a.name[:2] != "__"]


def test_packages_say_what_they_are_or_nothing():
    for folder in {p.parent for p in ROOT.rglob("*.py")}:
        assert (folder / "__init__.py").is_file()


def test_the_layers_that_are_enforced_are_those_that_are_explained():
    settings = tomllib.loads((ROOT.parent / "pyproject.toml").read_text())
    layers, _ = settings["tool"]["importlinter"]["contracts"]
    table = [
        re.findall(r"`scadgen/(\w+)`", line.split("|")[1])
        for line in (ROOT.parent / "CONTRIBUTING.md").read_text().splitlines()
        if line.startswith("| `scadgen/")
    ]
    assert [sorted(row) for row in table] == [
        sorted(layer.split(" : ")) for layer in layers["layers"]
    ]


def test_the_version_is_one():
    assert scadgen.__version__.count(".") == 2
