"""scadgen in Python: what it gives, what it makes of frames, and what it says of wrong values."""

import doctest
import importlib
import inspect
import json
import pkgutil
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import kits
import networkx as nx
import numpy as np
import pytest
import shapely

import scadgen
from scadgen.api.options import FAMILY, READING
from scadgen.cli.main import main
from scadgen.kit.live import PARAMETERS
from scadgen.kit.store import dumps
from scadgen.readers.units import UNITS

ROOT = Path(__file__).parent.parent

#: What programs may use: a name that goes, or another one, is a change that they notice.
NAMES = [
    *("Frame", "GeometryError", "InputError", "InvariantError", "JointError", "Kit", "KitError"),
    *("KitPlan", "Mesh", "Part", "Result", "ScadgenError", "ToolError"),
    *("__version__", "load_kit", "make_frame", "make_kit"),
]

#: The public parts of its classes, likewise.
MEMBERS = {
    "Kit": "bill check folder frame joints name notes parts placements plan proved ranges read "
    "value values with_cells write",
    "KitPlan": "as_dict files good steps text value whole write",
    "Mesh": "count index points to_trimesh triangles",
    "Part": "kit mesh name read role value volume write",
}

#: Two rungs between two rails, in mm, and what is joined.
POINTS = [(0, 0), (80, 0), (160, 0), (0, 80), (80, 80), (160, 80)]
EDGES = [(0, 1), (1, 2), (3, 4), (4, 5), (0, 3), (1, 4), (2, 5)]

DRAFT = {"detail": "draft", "prove": False}


def made(frame, **options):
    return scadgen.make_kit(frame, **DRAFT | options)


def graph():
    found = nx.Graph()
    for name, point in zip("abcdef", POINTS, strict=True):
        found.add_node(name, pos=point)
    found.add_edges_from(("abcdef"[i], "abcdef"[j]) for i, j in EDGES)
    return found


def loaded(code):
    """Which modules are there after some code, in a new Python."""
    code += "\nimport sys\nprint(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return set(done.stdout.split())


def outside(modules):
    """Packages that are neither scadgen nor Python's own."""
    ours = {name.split(".")[0] for name in modules} - {"scadgen"}
    return {
        name for name in ours - sys.stdlib_module_names if not name.startswith(("_", "sitecus"))
    }


def test_the_import_loads_nothing_but_itself():
    # An editable install has a finder of its own, which is there before any import.
    before, after = loaded("pass"), loaded("import scadgen; dir(scadgen); scadgen.__all__")
    assert {name for name in after - before if name.startswith("scadgen")} == {"scadgen"}
    assert outside(after) == outside(before)
    assert not outside(loaded("import scadgen; scadgen.InputError")) - outside(before)


def test_libraries_that_a_frame_does_not_need_are_not_loaded():
    after = loaded(
        "import scadgen; scadgen.make_frame(([(0, 0), (90, 0)], [(0, 1)]));"
        "scadgen.make_frame('ladder')"
    )
    assert "numpy" in after
    assert not after & {"networkx", "trimesh", "click"}


def test_the_public_names_are_these():
    assert scadgen.__all__ == NAMES
    assert {*NAMES} <= {*dir(scadgen)}
    for name in NAMES:
        assert getattr(getattr(scadgen, name), "__name__", "__version__").startswith(name)
    with pytest.raises(AttributeError, match="no attribute 'made'"):
        _ = scadgen.made
    # A package of the same name would take the place of what is public once it is imported.
    packages = {module.name for module in pkgutil.iter_modules(scadgen.__path__)}
    assert not packages & {*NAMES}


@pytest.mark.parametrize("name", MEMBERS)
def test_the_public_parts_of_classes_are_these(name):
    members = {m for m in dir(getattr(scadgen, name)) if not m.startswith("_")}
    assert sorted(members) == MEMBERS[name].split()


def functions():
    """All functions and methods that are public, by name."""
    for name in NAMES:
        thing = getattr(scadgen, name)
        if inspect.isfunction(thing):
            yield name, thing
        elif name in MEMBERS:
            for member in MEMBERS[name].split():
                method = inspect.getattr_static(thing, member)
                if inspect.isfunction(method):
                    yield f"{name}.{member}", method


@pytest.mark.parametrize(("name", "function"), [*functions()])
def test_every_argument_is_explained(name, function):
    text = inspect.getdoc(function)
    for one in inspect.signature(function).parameters.values():
        if one.name != "self":
            stars = r"\*\*" if one.kind is one.VAR_KEYWORD else ""
            assert re.search(rf"^(\w+, )*{stars}{one.name}(, \w+)*$", text, re.MULTILINE), name


def test_every_option_is_named_where_it_can_be_given():
    frames, kit = (inspect.getdoc(f) for f in (scadgen.make_frame, scadgen.make_kit))
    assert [n for n in (*FAMILY, *READING, "snap") if f"``{n}``" not in frames] == []
    assert [n for n in PARAMETERS if f"``{n}``" not in kit] == []


def modules():
    for module in pkgutil.walk_packages(scadgen.__path__, "scadgen."):
        if not module.ispkg and ">>>" in inspect.getsource(importlib.import_module(module.name)):
            yield module.name


@pytest.mark.parametrize("name", [*modules()])
def test_the_examples_of_docstrings_are_so(name):
    failed, tried = doctest.testmod(importlib.import_module(name))
    assert (failed, tried > 0) == (0, True)


def test_the_tour_is_so(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs/python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) == page.count("```python") > 10
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "python.md", None, 0)
    assert len(test.examples) > 30
    assert doctest.DocTestRunner().run(test).failed == 0


#: A wrong request as words, and as a call.
WRONG = [
    (["hexagonal", "--side", "3"], ("hexagonal", {"side": 3})),
    (["hexagonal", "--side", "inf"], ("hexagonal", {"side": float("inf")})),
    (["hexagonal", "--rows", "0"], ("hexagonal", {"rows": 0})),
    (["hexagonal", "--detail", "rough"], ("hexagonal", {"detail": "rough"})),
    (["hexagonal", "--key", "glued"], ("hexagonal", {"key": "glued"})),
    (["hexagonal", "--clearance", "2"], ("hexagonal", {"clearance": 2})),
    (["hexagonal", "--scale", "2"], ("hexagonal", {"scale": 2})),
    (["hexagonal", "--outline", "1.0,2.0"], ("hexagonal", {"outline": [(1, 2)]})),
    (["hexagonal", "--weave", "tight"], ("hexagonal", {"weave": "tight"})),
    (["hexagonal", "--material", "wood"], ("hexagonal", {"material": "wood"})),
    (["hexagonal", "--jobs", "0"], ("hexagonal", {"jobs": 0})),
    (["hexagnal"], ("hexagnal", {})),
    (["ring", "--sides", "2"], ("ring", {"sides": 2})),
    (
        ["4.8.8", "--radius", "90", "--edge-length", "50"],
        ("4.8.8", {"radius": 90, "edge_length": 50}),
    ),
    (["no/such.svg"], (Path("no/such.svg"), {})),
    (["no/such.svg", "--repair"], ("no/such.svg", {"repair": True})),
]


@pytest.mark.parametrize(("words", "call"), WRONG, ids=lambda given: " ".join(map(str, given)))
def test_wrong_values_get_the_line_of_the_command(words, call, tmp_path, capsys):
    with pytest.raises(SystemExit) as done:
        main(["kit", *words, "-o", str(tmp_path / "kit")])
    assert done.value.code == 2
    with pytest.raises(scadgen.ScadgenError) as refused:
        scadgen.make_kit(call[0], **call[1])
    assert f"scadgen: {refused.value}\n" == capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"sid": 8}, "sid: no option of frames or kits (did you mean side?)"),
        (
            {"side": "8 furlongs"},
            f"side: unit 'furlongs': must be one of {', '.join(UNITS)}",
        ),
        ({"rows": 2.5}, "rows = 2.5: must be a whole number"),
        ({"rows": True}, "rows = True: must be a whole number"),
        ({"side": None, "detail": 3}, "detail = 3: must be a text"),
        (
            {"side": [8]},
            "side = [8]: must be a number of mm, or a text with a unit, as '8mm' or '1in'",
        ),
        ({"centre": 1}, "centre = 1: must be True or False"),
        ({"outline": 3}, "outline = 3: must be 3 or more corners, an x and a y each, in mm"),
        ({"angle": "60"}, "angle = '60': must be a number"),
    ],
)
def test_values_of_the_wrong_kind_are_refused(options, said):
    with pytest.raises(scadgen.InputError, match=f"^{re.escape(said)}$"):
        scadgen.make_kit("hexagonal", **options)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (3, "frame 3: must be a name or a file; a frame; vertices and edges; a graph of networkx"),
        ((1, 2), "frame: vertices of shape (): must be (n, 2), an x and a y each"),
        (([(0, 0), (1, 1, 1)], [(0, 1)]), "frame: vertices = [(0, 0), (1, 1, 1)]: must be numbers"),
        (([(0, 0), (9, 0)], [(0, 2)]), "frame: edge 0 = [0, 2]: vertices go from 0 to 1"),
        (([(0, 0), (9, 0)], [(0, 1), 2]), "frame: edges [(0, 1), 2]: must be (m, 2)"),
        (nx.path_graph(2), "graph: node 0: pos = None: must be an x and a y, in mm"),
        (shapely.Point(0, 0), "lines: Point: must be lines; of an area take its boundary"),
        (shapely.LineString([(0, 0, 0), (9, 0, 9)]), "lines: <LINESTRING Z (0 0 0, 9 0 9)>: must"),
        (shapely.LineString(), "lines: there is nothing in it that could be an edge"),
    ],
)
def test_what_is_no_frame_is_refused(given, said):
    with pytest.raises(scadgen.InputError, match=f"^{re.escape(said)}") as refused:
        scadgen.make_frame(given)
    assert "\n" not in str(refused.value)


def test_all_ways_to_say_a_frame_make_the_same(tmp_path):
    file = tmp_path / "frame.json"
    file.write_text(json.dumps({"vertices": POINTS, "edges": EDGES}))
    lines = [shapely.LineString([POINTS[i], POINTS[j]]) for i, j in EDGES]
    frames = [
        scadgen.make_frame(given)
        for given in (
            str(file),
            file,
            (POINTS, EDGES),
            (np.array(POINTS, dtype=np.int32), np.array(EDGES, dtype=np.uint8)),
            graph(),
            lines,
            shapely.MultiLineString(lines),
            shapely.GeometryCollection([shapely.MultiLineString(lines[:3]), *lines[3:]]),
        )
    ]
    for frame in (*frames, scadgen.make_frame(frames[0])):
        assert frame.plan.tolist() == [list(map(float, point)) for point in POINTS]
        assert sorted(frame.edges.tolist()) == sorted(map(list, EDGES))


def test_lines_are_joined_and_split_as_drawings_are():
    # A bar, another across it, and one that ends 4 micrometres beside the first one's end.
    lines = [[(0, 0), (100, 0)], [(50, -50), (50, 50)], [(100.004, 0), (100, 60)]]
    notes = []
    frame = scadgen.make_frame(shapely.MultiLineString(lines), note=notes.append)
    assert len(frame.vertices) == 6
    assert sorted(frame.lengths.tolist()) == [50, 50, 50, 50, 60]
    assert notes == ["2 places within 0.01 mm merged at (100, 0)", "crossing split at (50, 0)"]
    with pytest.raises(scadgen.InputError, match=r"segments cross at \(50, 0\)"):
        scadgen.make_frame(shapely.MultiLineString(lines), no_split=True)


def test_names_are_those_of_files(tmp_path):
    frame = scadgen.make_frame((POINTS, EDGES), name="a/b: c")
    assert frame.name == scadgen.make_frame("ladder", name="a/b: c").name == "a_b_ c"
    kit = made("hexagonal", name="My shelf")
    # No command gives a kit another name than its frame's.
    assert (kit.name, kit.value.command) == ("My_shelf", "")
    assert (kit.write(tmp_path / "kit") / "My_shelf.scad").is_file()
    assert scadgen.load_kit(tmp_path / "kit" / "kit.json").name == "My_shelf"


def test_units_go_for_what_a_program_has():
    inches = ([(0, 0), (4, 0)], [(0, 1)])
    for given in (inches, shapely.LineString(inches[0])):
        frame = scadgen.make_frame(given, unit="inch", centre=True)
        assert frame.plan.tolist() == [[-50.8, 0], [50.8, 0]]


def test_a_kit_is_that_of_the_command_byte_for_byte(tmp_path):
    words = ["--rows", "1", "--detail", "draft", "--side", "8mm", "--material", "PETG"]
    with pytest.raises(SystemExit) as done:
        main(["kit", "square", *words, "--unchecked", "-o", str(tmp_path / "command")])
    assert done.value.code == 0
    kit = made("square", rows=1, side="8mm", material="petg")
    kit.write(tmp_path / "python")
    command, python = (
        {file.name: file.read_bytes() for file in (tmp_path / name).iterdir()}
        for name in ("command", "python")
    )
    assert command == python
    # Read again it is the same, and written over itself it stays so.
    again = scadgen.load_kit(tmp_path / "python")
    assert dumps(again.value) == dumps(kit.value)
    assert again.write(tmp_path / "python") == tmp_path / "python"


def test_a_kit_of_what_a_program_has_is_that_of_its_file(tmp_path):
    file = tmp_path / "Shelf 1.json"
    file.write_text(json.dumps({"vertices": POINTS, "edges": EDGES}))
    of_file, of_graph = made(file), made(graph(), name="Shelf 1")
    assert of_graph.name == of_file.name == "Shelf_1"
    assert of_graph.value.command == ""
    folder = of_graph.write(tmp_path / "graph")
    for text in ("Makefile", "Shelf_1.scad", "README.md"):
        said = (folder / text).read_text()
        assert "by a Python program with scadgen" in " ".join(said.split())
        assert not re.search(r"^(//|#) +$", said, re.MULTILINE)
    assert [*of_graph.parts] == [*of_file.parts]
    for name, part in of_file.parts.items():
        points, triangles = of_graph.parts[name].mesh()
        assert np.array_equal(points, part.mesh().points)
        assert np.array_equal(triangles, part.mesh().triangles)
    # What was read is not written over.
    before = file.read_bytes()
    (tmp_path / "kit").mkdir()
    (tmp_path / "kit" / "kit.json").symlink_to(file)
    with pytest.raises(scadgen.InputError, match=r"cannot write"):
        of_file.write(tmp_path / "kit")
    assert file.read_bytes() == before


def test_other_cells_are_those_that_could_have_been_asked_for():
    kit = made("hexagonal", rows=1, columns=1).with_cells(2, 3)
    assert dumps(kit.value) == dumps(made("hexagonal", rows=2, columns=3).value)
    for wrong in ({"rows": 0, "columns": 1}, {"rows": 101, "columns": 1}):
        with pytest.raises(scadgen.InputError, match="must be a whole number from 1 to 100"):
            kit.with_cells(**wrong)
    with pytest.raises(scadgen.InputError, match="no rows and columns to set"):
        made((POINTS, EDGES)).with_cells(1, 1)


def test_a_part_is_linear_in_its_lengths():
    half = made("hexagonal").parts["half"]
    at = [half.mesh(clearance=gap).points for gap in (0.1, 0.2, 0.3)]
    assert np.allclose(at[0] + at[2], 2 * at[1], atol=1e-12)
    assert not np.allclose(at[0], at[1], atol=1e-3)
    # By the divergence theorem, as trimesh has it.
    assert half.volume(clearance="0.03cm") == pytest.approx(
        half.mesh(clearance=0.3).to_trimesh().volume, rel=1e-9
    )


def test_a_range_is_where_a_part_stops_to_be_made():
    kit = made("hexagonal")
    half = kit.parts["half"]
    for name, (low, high) in kit.ranges.items():
        for bound, beyond in ((low, low - 1e-3), (high, high + 1e-3)):
            half.mesh(**{name: bound})
            with pytest.raises(scadgen.InputError, match=r" mm: must be "):
                half.mesh(**{name: beyond})


def test_lengths_of_a_part_get_the_line_of_the_command(tmp_path, capsys):
    kit = made("hexagonal")
    kit.write(tmp_path / "kit")
    words = ["export", str(tmp_path / "kit"), "--part", "half", "-o", str(tmp_path / "half.stl")]
    with pytest.raises(SystemExit):
        main([*words, "--set", "clearance=9"])
    with pytest.raises(scadgen.InputError) as refused:
        kit.parts["half"].mesh(clearance=9)
    assert f"scadgen: {refused.value}\n" == capsys.readouterr().err
    said = r"^clearence: not a live parameter of this kit; must be .* \(did you mean clearance\?\)$"
    with pytest.raises(scadgen.InputError, match=said):
        kit.parts["half"].mesh(clearence=0.3)


def test_a_part_is_written_as_the_command_exports_it(tmp_path):
    kit = made("hexagonal")
    kit.write(tmp_path / "kit")
    for ending in ("stl", "3mf", "obj", "glb"):
        command, python = tmp_path / f"command.{ending}", tmp_path / f"python.{ending}"
        words = ["export", str(tmp_path / "kit"), "--part", "half", "--set", "clearance=0.3"]
        with pytest.raises(SystemExit) as done:
            main([*words, "-o", str(command)])
        assert done.value.code == 0
        assert kit.parts["half"].write(python, clearance=0.3) == python
        assert python.read_bytes() == command.read_bytes()
    with pytest.raises(scadgen.InputError, match="unknown mesh format 'step'"):
        kit.parts["half"].write(tmp_path / "half.step")
    (tmp_path / "mine.stl").write_text("mine")
    with pytest.raises(scadgen.InputError, match="scadgen did not make it"):
        kit.parts["half"].write(tmp_path / "mine.stl")
    kit.parts["half"].write(tmp_path / "mine.stl", force=True)
    assert (tmp_path / "mine.stl").read_bytes() != b"mine"
    # The kit that a part was read from is not written over either.
    read = scadgen.load_kit(tmp_path / "kit").parts["half"]
    (tmp_path / "link.stl").symlink_to(tmp_path / "kit" / "kit.json")
    with pytest.raises(scadgen.InputError, match="it was read"):
        read.write(tmp_path / "link.stl")


def test_checks_find_what_is_wrong(tmp_path):
    kit = scadgen.Kit(kits.proved_kit("hexagonal"))
    # A kit in a folder has files besides; one of these is spoiled, and nothing else.
    folder = kit.write(tmp_path / "kit")
    (folder / "README.md").write_text("spoiled")
    said = []
    results = scadgen.load_kit(folder).check(progress=said.append)
    (bad,) = [one for one in results if not one.good]
    assert "README.md" in bad.check + bad.figure
    assert said.index("files") < said.index("solids")
    # A kit that is not what its own parameters make is found without any file.
    other = scadgen.Kit(replace(kit.value, detail="standard"))
    assert not all(one.good for one in other.check())


def test_a_plan_is_that_of_the_command(tmp_path):
    kit = scadgen.Kit(kits.proved_kit("hexagonal")).with_cells(1, 1)
    folder = kit.write(tmp_path / "kit")
    with pytest.raises(SystemExit) as done:
        main(["plan", str(folder)])
    said = []
    plan = kit.plan(progress=said.append)
    assert (plan.good, done.value.code) == (True, 0)
    assert said
    assert plan.write(tmp_path / "plan") == tmp_path / "plan"
    command, python = (
        {file.name: file.read_bytes() for file in place.iterdir()}
        for place in (folder / "plan", tmp_path / "plan")
    )
    assert command == python
    assert plan.as_dict()["proved"] is True
