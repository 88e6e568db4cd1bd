"""``scadgen interlock`` on files as somebody might download them."""

import io
import json

import mechanisms
import numpy as np
import puzzles
import pytest
from PIL import Image
from scipy.optimize import OptimizeResult
from shapes import box
from test_contacts import joined

from scadgen.cli.main import main
from scadgen.emit.mesh import mesh_bytes
from scadgen.interlock import program
from scadgen.interlock.bodies import unpinched
from scadgen.solid.gap import overlap_volume, solid


def write(folder, meshes, names, kind="stl"):
    paths = []
    for (points, triangles), name in zip(meshes, names, strict=True):
        path = folder / f"{name}.{kind}"
        path.write_bytes(mesh_bytes(points, triangles, kind))
        paths.append(str(path))
    return paths


@pytest.fixture
def run(capsys):
    def run(*arguments):
        with pytest.raises(SystemExit) as left:
            main(["interlock", *map(str, arguments)])
        out, err = capsys.readouterr()
        return left.value.code, out, err

    return run


@pytest.fixture
def refused(run):
    def refused(*arguments):
        code, out, err = run(*arguments)
        assert code == 2
        assert out == ""
        assert err.count("\n") == 1
        return err

    return refused


BURR = ("slot", "rail", "bar")


@pytest.mark.parametrize("kind", ["stl", "3mf", "obj"])
def test_a_burr_is_locked_with_its_key_held(run, tmp_path, kind):
    files = write(tmp_path, puzzles.three_piece_burr(), BURR, kind)
    code, out, err = run(*files)
    assert (code, err) == (1, "")
    assert out.startswith("movable\n")
    assert "held         slot, the largest part" in out
    assert "bar         moves along +z" in out
    assert "keys         bar, rail\n" in out
    code, out, err = run(*files, "--hold", "slot,bar")
    assert (code, err) == (0, "")
    assert out.startswith("locked\n")
    assert "rank 6" in out


def test_json_says_it_all(run, tmp_path):
    files = write(tmp_path, puzzles.three_piece_burr(), BURR)
    code, out, _ = run(*files, "--json")
    found = json.loads(out)
    assert code == 1
    assert not found["locked"]
    assert found["held"] == ["slot"]
    assert found["certificate"] is None
    assert [p["part"] for p in found["motion"]["parts"]] == ["bar"]
    assert found["alone"]["rail"] is None
    assert found["alone"]["bar"]["slides"]
    code, out, _ = run(*files, "--json", "--hold", "bar,slot")
    found = json.loads(out)
    assert code == 0
    assert found["certificate"]["residual"] < 1e-6
    assert found["certificate"]["rank"] == 6
    assert found["motion"] is None


@pytest.mark.parametrize("kind", ["stl", "3mf", "obj"])
def test_a_file_with_several_bodies_is_several_parts(run, tmp_path, kind):
    (file,) = write(tmp_path, [joined(*puzzles.six_piece_burr())], ["burr"], kind)
    code, out, _ = run(file, "--json")
    found = json.loads(out)
    assert code == 1
    assert sorted(found["alone"]) == [f"burr.{n}" for n in range(1, 7)]
    (key,) = (name for name, motion in found["alone"].items() if motion)
    held = ",".join(sorted({key, *found["held"]}))
    assert found["keys"][0] == key
    first = next(n for n in found["alone"] if n != key)
    assert run(file, "--hold", f"{key},{first}")[0] == 0
    assert held


def test_objects_give_their_names_to_parts(run, tmp_path):
    import trimesh

    lid = box((0, 0, 3), (4, 4, 4))
    parts = {"box": box((0, 0, 0), (4, 4, 1)), "block": box((1, 1, 1), (2, 2, 2)), "lid, top": lid}
    for kind in ("3mf", "obj"):
        scene = trimesh.Scene()
        for name, mesh in parts.items():
            scene.add_geometry(trimesh.Trimesh(*mesh, process=False), geom_name=name)
        file = tmp_path / f"boxed.{kind}"
        scene.export(file)
        names = [*json.loads(run(file, "--json")[1])["alone"]]
        assert names == (["box", "block", "lid, top"] if kind == "3mf" else names)
        assert {name.partition(",")[0] for name in names} == {"box", "block", "lid"}
        code, out, _ = run(file, "--hold", "lid, top", "--hold", "box", "--json")
        assert code == 1
        assert sorted(json.loads(out)["held"]) == ["box", "lid, top"]


def test_objects_that_share_a_surface_are_one_part(run, tmp_path):
    low, high = write(tmp_path, [box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (1, 1, 2))], "ab", "obj")
    lines = (tmp_path / "b.obj").read_text().splitlines()
    first = next(n for n, line in enumerate(lines) if line.startswith("f"))
    lines[first + 4 : first + 4] = ["o side"]
    lines[first:first] = ["o top"]
    (tmp_path / "b.obj").write_text("\n".join(lines) + "\n")
    code, out, _ = run(low, high, "--json")
    assert code == 1
    assert sorted(json.loads(out)["alone"]) == ["a", "b"]


def test_held_parts_are_no_keys(run, tmp_path):
    files = write(tmp_path, puzzles.three_piece_burr(), BURR)
    assert json.loads(run(*files, "--json")[1])["keys"] == ["bar", "rail"]
    assert json.loads(run(*files, "--hold", "rail", "--json")[1])["keys"] == ["bar", "slot"]
    # Off a bar that is held, slot and rail go together; then they part.
    keys = json.loads(run(*files, "--hold", "bar", "--json")[1])["keys"]
    assert keys == ["slot+rail", "rail"]
    tube = write(tmp_path, puzzles.peg_in_tube(), ("tube", "peg"))
    assert json.loads(run(*tube, "--json")[1])["keys"] == ["peg"]


def test_a_motion_is_told_up_to_what_it_touches(run, tmp_path):
    tray = box((0, 0, 0), (8, 8, 1))
    meshes = [tray, box((3, 3, 1), (5, 5, 3)), box((0, 0, 6), (8, 8, 7))]
    files = write(tmp_path, meshes, ("tray", "block", "lid"))
    png = tmp_path / "a.png"
    code, out, _ = run(*files, "--hold", "tray,lid", "--png", png)
    assert code == 1
    assert "block        moves along +z" in out
    assert "way          moves 3 mm, then touches lid" in out
    way = json.loads(run(*files, "--hold", "tray,lid", "--json")[1])["motion"]["way"]
    assert way["mm"] == pytest.approx(3, abs=0.01)
    assert way["degrees"] == 0
    assert way["touches"] == "lid"
    free = run(*files[:2], "--json")[1]
    assert json.loads(free)["motion"]["way"]["touches"] is None


def test_an_axle_in_a_round_hole_turns(run, tmp_path):
    files = write(tmp_path, puzzles.axle_in_hub(4.8, 100), ("hub", "axle"))
    code, out, _ = run(*files)
    assert code == 1
    assert out.startswith("movable\n")
    assert "axle        turns about +z through (0, 0, 0) (round faces)" in out
    assert "keys         none" in out
    found = json.loads(run(*files, "--json")[1])
    assert found["motion"]["round_faces"]
    assert found["certificate"] is None


def test_text_stl_and_ply_are_read(run, tmp_path):
    import trimesh

    for kind in ("stl_ascii", "ply", "off"):
        files = []
        for (points, triangles), name in zip(puzzles.three_piece_burr(), BURR, strict=True):
            path = tmp_path / f"{name}.{kind.partition('_')[0]}"
            trimesh.Trimesh(points, triangles, process=False).export(path, file_type=kind)
            files.append(path)
        assert run(*files)[0] == 1
        assert run(*files, "--hold", "slot,bar")[0] == 0


def test_clearance_is_bridged_by_the_tolerance(run, refused, tmp_path):
    files = write(tmp_path, puzzles.cube_in_box(0.1), ("box", "cube"))
    assert "no two parts touch within" in refused(*files)
    code, out, _ = run(*files, "--tolerance", "0.11")
    assert code == 0
    assert "within 0.11 mm" in out


def test_the_motion_can_be_seen(run, tmp_path):
    files = write(tmp_path, puzzles.three_piece_burr(), BURR)
    gif, png = tmp_path / "a.gif", tmp_path / "a.png"
    assert run(*files, "--gif", gif, "--png", png)[0] == 1
    with Image.open(gif) as film:
        assert film.n_frames > 10
        first = np.asarray(film.convert("RGB"), dtype=int)
        film.seek(film.n_frames // 2)
        middle = np.asarray(film.convert("RGB"), dtype=int)
        film.seek(film.n_frames - 1)
        last = np.asarray(film.convert("RGB"), dtype=int)
    assert np.abs(middle - first).mean() > 5 * np.abs(last - first).mean() > 0
    again = tmp_path / "b.png"
    run(*files, "--png", again)
    assert again.read_bytes() == png.read_bytes()
    with Image.open(io.BytesIO(png.read_bytes())) as picture:
        assert picture.size == (1200, 900)


def test_nothing_is_filmed_where_nothing_moves(run, tmp_path):
    files = write(tmp_path, puzzles.three_rods(), "abc")
    code, out, err = run(*files, "--gif", tmp_path / "a.gif", "--png", tmp_path / "a.png")
    assert code == 0
    assert out.startswith("locked")
    assert "nothing moves" in err
    assert not (tmp_path / "a.gif").exists()
    assert (tmp_path / "a.png").exists()


def test_files_that_are_none_are_refused(refused, tmp_path):
    (good,) = write(tmp_path, [box((0, 0, 0), (1, 1, 1))], ["good"])
    for name, data, says in (
        ("empty.stl", b"", "has no faces|not a whole"),
        ("none.stl", bytes(84), "has no faces"),
        ("half.stl", (tmp_path / "good.stl").read_bytes()[:-20], "not a whole|not closed|has no"),
        ("noise.3mf", b"PK\x03\x04 nothing", "not a whole 3MF"),
        ("notes.txt", b"hello", "must be one of stl"),
    ):
        (tmp_path / name).write_bytes(data)
        err = refused(good, tmp_path / name)
        assert name in err
        assert any(part in err for part in says.split("|")), err
    assert "cannot be read" in refused(good, tmp_path / "missing.stl")
    assert "at least two" in refused(good)


def test_meshes_that_are_no_solids_are_refused_and_where(refused, tmp_path):
    points, triangles = box((0, 0, 0), (1, 1, 1))
    spike = points.copy()
    spike[7] = (-1.0, 0.4, 0.3)
    meshes = [
        (points, triangles[1:]),
        (points, triangles[:, ::-1]),
        (spike, triangles),
        (points * [1, 1, np.nan], triangles),
        (points * [1, 1, 0], triangles),
    ]
    (good,) = write(tmp_path, [box((0, 0, 1), (1, 1, 2))], ["good"])
    says = (
        "not closed: 3 open edges, one at (",
        "look inwards",
        "crosses itself",
        "not finite",
        "volume 0: must be above 0; it is flat",
    )
    for mesh, text in zip(meshes, says, strict=True):
        data = mesh_bytes(points, triangles[: len(mesh[1])], "stl")
        faces = np.frombuffer(data[84:], dtype=np.uint8).reshape(-1, 50).copy()
        corners = mesh[0][mesh[1]].astype("<f4").reshape(len(faces), -1)
        faces[:, 12:48] = corners.view(np.uint8)
        (tmp_path / "bad.stl").write_bytes(data[:84] + faces.tobytes())
        err = refused(good, tmp_path / "bad.stl")
        assert "bad.stl" in err
        assert text in err


def test_other_requests_that_cannot_be_met_are_refused(refused, tmp_path):
    files = write(tmp_path, puzzles.three_piece_burr(), BURR)
    assert "--hold key: must be one of slot, rail, bar" in refused(*files, "--hold", "key")
    assert "holds all parts" in refused(*files, "--hold", "slot,rail,bar")
    assert "tolerance = -1" in refused(*files, "--tolerance", "-1")
    (tmp_path / "film.gif").mkdir()
    long = f"{'x' * 300}.gif"
    for path in ("film.gif", "nowhere/film.gif", long):
        assert "cannot write" in refused(*files, "--gif", tmp_path / path)
    (tmp_path / "other").mkdir()
    (twin,) = write(tmp_path / "other", [box((9, 9, 9), (10, 10, 10))], ["bar"])
    assert "a part bar already" in refused(*files, twin)
    (metres,) = write(tmp_path, [box((0, 0, 0), (0.005, 0.005, 0.005))], ["metres"])
    assert "must be in one unit" in refused(*files, metres)
    (inside,) = write(tmp_path, [box((0, 0, 0), (2, 1, 1))], ["inside"])
    err = refused(*files, inside)
    assert "slot and inside overlap by 2 mm3" in err


def test_a_solver_that_fails_gives_its_status_and_no_verdict(refused, tmp_path, monkeypatch):
    meshes, _ = puzzles.placed(puzzles.three_piece_burr(), np.random.default_rng(1))
    files = write(tmp_path, meshes, BURR)
    failed = OptimizeResult(status=4, message="numerical\ndifficulties", x=None)
    monkeypatch.setattr(program, "linprog", lambda *_, **__: failed)
    assert "status 4, numerical difficulties" in refused(*files)


def text_stl(solids):
    """An STL as text, with a solid for each name and mesh."""
    lines = []
    for name, (points, triangles) in solids.items():
        lines.append(f"solid {name}")
        for corners in points[triangles]:
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += [f"vertex {x:g} {y:g} {z:g}" for x, y, z in corners]
            lines += ["endloop", "endfacet"]
        lines.append(f"endsolid {name}")
    return "\n".join(lines) + "\n"


def grouped_obj(groups):
    """An OBJ with a group for each name and mesh."""
    lines, count = [], 1
    for name, (points, triangles) in groups.items():
        lines.append(f"g {name}")
        lines += [f"v {x:g} {y:g} {z:g}" for x, y, z in points]
        lines += [f"f {a} {b} {c}" for a, b, c in triangles + count]
        count += len(points)
    return "\n".join(lines) + "\n"


def test_solids_and_groups_give_their_names(run, refused, tmp_path):
    parts = {"base plate": box((0, 0, 0), (4, 4, 1)), "block": box((1, 1, 1), (2, 2, 2))}
    for name, text in (("a.stl", text_stl(parts)), ("b.obj", grouped_obj(parts))):
        (tmp_path / name).write_text(text)
        code, out, _ = run(tmp_path / name, "--json")
        assert code == 1
        assert sorted(json.loads(out)["alone"]) == ["base plate", "block"]
    # Patches of one surface are one part, whatever their names.
    points, triangles = parts["block"]
    patches = {"top": (points, triangles[:4]), "side": (points, triangles[4:])}
    (tmp_path / "c.stl").write_text(text_stl(patches))
    (plate,) = write(tmp_path, [parts["base plate"]], ["plate"])
    assert sorted(json.loads(run(plate, tmp_path / "c.stl", "--json")[1])["alone"]) == [
        "c",
        "plate",
    ]
    (tmp_path / "d.stl").write_text(text_stl(parts).replace("endfacet", "", 1).replace("1", "x"))
    assert "not a whole STL file" in refused(plate, tmp_path / "d.stl")


def test_a_file_or_a_pattern_is_held_as_a_whole(run, refused, tmp_path):
    ends = joined(box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (3, 1, 1)))
    files = write(tmp_path, [ends, box((1, 0, 0), (2, 1, 1))], ["frame", "mid"])
    for hold in ("frame", "frame.stl", files[0], "frame.*", "frame.1,frame.2"):
        code, out, _ = run(*files, "--hold", hold, "--json")
        assert code == 1
        assert json.loads(out)["held"] == ["frame.1", "frame.2"]
        assert json.loads(out)["keys"] == ["mid"]
    assert "--hold lid.*: must be one of" in refused(*files, "--hold", "lid.*")
    assert "holds all parts" in refused(*files, "--hold", "*")


def test_a_part_that_touches_itself_along_an_edge_is_one_solid(run, tmp_path):
    # Two cubes that touch along an edge, joined by three more above.
    pinched = [(0, 0, 0), (1, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1)]
    mesh, cube = puzzles.voxels(pinched), puzzles.voxels([(0, 1, 0)])
    found = solid(*unpinched(*mesh))
    assert found.volume() == pytest.approx(5)
    assert overlap_volume(*unpinched(*mesh), *cube) == pytest.approx(0, abs=1e-12)
    files = write(tmp_path, [mesh, cube], ["shelf", "cube"])
    code, out, err = run(*files, "--json")
    assert (code, err) == (1, "")
    assert json.loads(out)["keys"] == ["cube"]


def test_a_mesh_that_touches_itself_nowhere_stays_as_it_is():
    points, triangles = puzzles.voxels(puzzles.cells((0, 2), (0, 2), (0, 2)))
    again, faces = unpinched(points, triangles)
    assert again[faces] == pytest.approx(points[triangles])
    assert len(again) == len(points)


def test_a_film_of_interference_is_contact(run, refused, tmp_path):
    def pressed(deep):
        return write(tmp_path, [box((0, 0, 0), (6, 4, 1)), box((0, 0, 1 - deep), (6, 4, 2))], "ab")

    code, out, err = run(*pressed(1e-3), "--tolerance", "0.2", "--json")
    assert code == 1
    assert json.loads(out)["keys"] == ["a"]
    assert "a and b overlap by 0.001 mm: it counts as contact" in err
    deep = pressed(0.02)
    assert "0.0198 mm deep: parts must be placed as assembled" in refused(*deep)
    assert run(*deep, "--interference", "0.03")[0] == 1
    assert "--interference -1: must be" in refused(*deep, "--interference", "-1")


def test_gaps_that_count_as_closed_are_told(run, tmp_path):
    shell, _ = puzzles.cube_in_box(0.1)
    files = write(tmp_path, [shell, box((-1, -1, -1), (1, 1.04, 1))], ("box", "cube"))
    code, out, _ = run(*files, "--tolerance", "0.15")
    assert code == 0
    assert "gaps         0.06 to 0.1 mm between box and cube count as closed" in out
    (gap,) = json.loads(run(*files, "--tolerance", "0.15", "--json")[1])["gaps"]
    assert gap["smallest"] == pytest.approx(0.06, abs=1e-6)
    assert gap["largest"] == pytest.approx(0.1, abs=1e-6)
    # Where parts touch there is none.
    flush = write(tmp_path, puzzles.three_rods(), "abc")
    assert json.loads(run(*flush, "--json")[1])["gaps"] == []


def test_a_tolerance_that_is_large_for_a_part_is_warned_of(run, tmp_path):
    files = write(tmp_path, [box((0, 0, 0), (9, 9, 0.1)), box((0, 0, 0.1), (9, 9, 5))], "ab")
    _, _, err = run(*files)
    assert err.count("\n") == 1
    assert "is large: a is 0.0978 mm thick" in err
    assert run(*files, "--tolerance", "0.01")[2] == ""


def test_taking_apart_is_told_filmed_and_the_exit_status(run, tmp_path):
    files = write(tmp_path, puzzles.three_piece_burr(), BURR)
    gif = tmp_path / "apart.gif"
    code, out, err = run(*files, "--apart", "--gif", gif)
    assert (code, err) == (0, "")
    assert "keys         bar, rail" in out
    assert "apart        comes apart" in out
    with Image.open(gif) as film:
        assert film.n_frames > 30
    found = json.loads(run(*files, "--apart", "--json")[1])["apart"]
    assert found["answer"] == "apart"
    assert [step["parts"] for step in found["order"]] == [["bar"], ["rail"]]
    assert found["order"][0]["steps"][0] == [0] * 6
    code, out, _ = run(*files, "--apart", "--hold", "slot,bar")
    assert code == 1
    assert "slot, rail, bar: locked" in out


def test_a_pin_that_only_turns_is_no_key(run, tmp_path):
    files = write(tmp_path, mechanisms.hinge(16, 0.1), ("hub", "pin"))
    code, out, _ = run(*files, "--json")
    assert code == 1
    found = json.loads(out)
    assert found["motion"]["round_faces"]
    assert found["keys"] == []
