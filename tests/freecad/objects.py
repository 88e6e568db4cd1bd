"""Run by freecadcmd: a kit as objects of the workbench, saved, opened again, edited."""

from pathlib import Path

import FreeCAD as App

#: Where things are: the kit, and the folder for what is saved.
PLACES = {}

#: Whether shapes are sound, as far as they were judged.
JUDGED = {}

#: What an attached object stands on: FreeCAD 1.0 has another name for it.
SUPPORT = "Support" if App.Version()[0] == "0" else "AttachmentSupport"

KINDS = ("basic", "one_sided", "two_sided", "connector", "half", "peg", "tube")


def saved(name="kit"):
    return str(PLACES["folder"] / f"{name}.FCStd")


def text():
    return PLACES["kit"].read_text()


def volumes(doc):
    """The volume of each part, by its name; each must be a sound solid."""
    parts = [o for o in doc.Objects if o.TypeId == "Part::FeaturePython"]
    assert all(is_sound(doc, part) for part in parts)
    return {p.Name: p.Shape.Volume for p in parts}


def is_sound(doc, part):
    """Whether a part is one sound solid; slow, so once for each shape in a document."""
    shape = part.Shape
    key = (doc.FileName, part.Name, shape.Volume, shape.Area)
    if key not in JUDGED:
        JUDGED[key] = shape.isValid() and len(shape.Solids) == 1
    return JUDGED[key]


def states(doc):
    return {o.Name: o.getStatusString() for o in doc.Objects if not o.isValid()}


def make():
    """One part of each kind, a joint and a frame; saved."""
    from freecad.scadgen import document

    doc = App.newDocument("kit")
    kit = document.add_kit(doc, text())
    for kind in KINDS:
        document.add_part(kit, kind)
    joint, frame = document.add_joint(kit), document.add_frame(kit)
    doc.recompute()
    doc.saveAs(saved())
    half = doc.Half
    return {
        "volumes": volumes(doc),
        "invalid": states(doc),
        "bill": kit.Bill,
        "kit": [kit.Pieces, kit.Volume.Value, kit.Mass],
        "half": [half.Kind, half.Volume.Value, half.Mass, half.Count, half.BomName],
        "read_only": [n for n in half.PropertiesList if "ReadOnly" in half.getTypeOfProperty(n)],
        "joint": [joint.Pieces, sorted({o.LinkedObject.Name for o in joint.Group})],
        "frame": [frame.Pieces, sum(o.ElementCount for o in frame.Group)],
        "frame_types": sorted({o.TypeId for o in frame.Group}),
        "frame_volume": sum(o.ElementCount * o.LinkedObject.Shape.Volume for o in frame.Group),
    }


def edit():
    """Opened again: live parameters, placement, attachment; saved."""
    from freecad.scadgen import document, own_values, part_object

    doc = App.openDocument(saved())
    opened, touched = volumes(doc), [o.Name for o in doc.Objects if "Touched" in o.State]
    doc.Kit.Clearance = "0.3 mm"
    doc.recompute()
    wide = volumes(doc)
    half, second = doc.Half, document.add_part(doc.Kit, "half")
    part_object.own(second, "clearance", 0.1)
    second.Placement.Base = App.Vector(100, 0, 0)
    box = doc.addObject("Part::Box", "Box")
    box.Placement.Base = App.Vector(0, 0, 50)
    doc.recompute()
    half.MapMode = "ObjectXY"
    setattr(half, SUPPORT, [(box, "")])
    doc.recompute()
    own = second.Shape.Volume
    found = {
        "opened": opened,
        "touched": touched,
        "wide": wide,
        "own": own,
        "follows": [part_object.follows(p, "clearance") for p in (half, second)],
        "placed": second.Shape.BoundBox.Center.x > 50,
        "attached": half.Placement.Base.z,
        "frame_reuses": doc.Frame.Group[0].LinkedObject.Name,
    }
    doc.Frame.setExpression("Rows", None)
    doc.Frame.Rows = 3
    doc.Kit.EdgeLength = 70
    doc.recompute()
    found["rows"] = [doc.Frame.Pieces, doc.Kit.Pieces]
    ends = [p.Base for o in doc.Frame.Group if o.Role == "half_a" for p in o.PlacementList]
    found["pitch"] = min((a - b).Length for a in ends for b in ends if (a - b).Length > 1)
    own_values.follow_kit(second)
    found["followed"] = second.Shape.Volume
    doc.save()
    return found


def refuse():
    """A value out of its range, and a kit that is gone: said, and the last shape kept."""
    from freecad.scadgen import document, part_object
    from freecad.scadgen.kit_data import KitError

    doc = App.openDocument(saved())
    before, found = volumes(doc), {}
    part_object.own(doc.Half, "clearance", 3.0)
    doc.recompute()
    found["part"] = [states(doc), volumes(doc) == before]
    part_object.follow(doc.Half, "clearance")
    doc.Kit.Clearance = 3.0
    doc.recompute()
    found["kit"] = [states(doc), volumes(doc) == before]
    doc.Kit.Clearance = 0.3
    doc.recompute()
    found["again"] = [states(doc), volumes(doc) == before]
    count = len(doc.Objects)
    try:
        document.add_kit(doc, text()[:-100])
    except KitError as error:
        found["broken"] = str(error)
    found["added"] = len(doc.Objects) - count
    try:
        with document.one_step(doc, "fails"):
            document.add_part(doc.Kit, "half")
            document.add_kit(doc, "")
    except KitError:
        found["midway"] = len(doc.Objects) - count
    return found


def old():
    """A property that an older version did not have is added; a newer version is left alone."""
    doc = App.openDocument(saved())
    doc.Half.removeProperty("BomName")
    doc.Half.ScadgenVersion = 0
    doc.Peg.removeProperty("BomName")
    doc.Peg.ScadgenVersion = 99
    doc.Kit.Data = doc.Kit.Data.replace('"version": 5', '"version": 7', 1)
    doc.saveAs(saved("old"))
    App.closeDocument(doc.Name)
    doc = App.openDocument(saved("old"))
    before = volumes(doc)
    doc.Kit.touch()
    doc.recompute()
    return {
        "kit": doc.Kit.getStatusString(),
        "kept": volumes(doc) == before,
        "half": ["BomName" in doc.Half.PropertiesList, doc.Half.ScadgenVersion],
        "peg": ["BomName" in doc.Peg.PropertiesList, doc.Peg.ScadgenVersion],
    }


def bare():
    """Opened and saved without the workbench: shapes, properties and links stay."""
    doc = App.openDocument(saved())
    before = volumes(doc)
    doc.Kit.Clearance = 0.2
    doc.recompute()
    doc.saveAs(saved("bare"))
    return {
        "proxies": [o.Name for o in doc.Objects if getattr(o, "Proxy", None) is not None],
        "volumes": before,
        "kept": volumes(doc) == before,
        "half": [doc.Half.Clearance.Value, doc.Half.Mass],
        "frame": sum(o.ElementCount for o in doc.Frame.Group),
    }


def restore():
    """Opened with the workbench again, and restored."""
    from freecad.scadgen import document

    doc = App.openDocument(saved("bare"))
    restored = document.restore(doc)
    doc.recompute()
    return {
        "restored": sorted(o.Name for o in restored),
        "again": document.restore(doc),
        "volumes": volumes(doc),
        "invalid": states(doc),
    }


def export():
    """Every format of a part, a joint and the whole kit."""
    from freecad.scadgen import export as files

    doc = App.openDocument(saved())
    folder = PLACES["folder"]
    doc.Half.MapMode = "Deactivated"
    doc.Half.Placement = App.Placement()
    doc.Joint.Placement.Base = App.Vector(0, 0, 20)
    doc.recompute()
    found = {}
    doc.Peg.Label = "Half "
    for kind in files.FORMATS:
        files.write(files.selection_files([doc.Half, doc.Joint], kind), folder)
        whole = files.whole_files(doc.Kit, kind, (220.0, 220.0))
        files.write(whole, folder)
        found[kind] = whole == files.whole_files(doc.Kit, kind, (220.0, 220.0))
    for name, act in (
        ("nothing", lambda: files.selection_files([], "stl")),
        ("other", lambda: files.selection_files([doc.Box], "stl")),
        ("same", lambda: files.selection_files([doc.Half, doc.Peg], "step")),
        ("bed", lambda: files.whole_files(doc.Kit, "3mf", (60.0, 50.0))),
        ("folder", lambda: files.write({"a": b""}, folder / "none")),
    ):
        try:
            act()
        except ValueError as error:
            found[name] = str(error)
    found["half"] = doc.Half.Shape.Volume
    found["joint"] = sum(o.ElementCount * o.LinkedObject.Shape.Volume for o in doc.Joint.Group)
    found["kit"] = doc.Kit.Volume.Value
    return found


def other():
    """A kit of several kinds of joints in cells, and one of a frame that is as it is."""
    from freecad.scadgen import document
    from freecad.scadgen.kit_object import data_of
    from freecad.scadgen.remake import remaking

    found = {}
    for name in ("cells", "drawn"):
        doc = App.newDocument(name)
        kit = document.add_kit(doc, PLACES[name].read_text())
        data = data_of(kit)
        for part in data.parts:
            document.add_part(kit, part)
        for joint in data.joints:
            document.add_joint(kit, joint["name"])
        frame = document.add_frame(kit)
        doc.recompute()
        found[name] = {
            "volumes": volumes(doc),
            "invalid": states(doc),
            "labels": [o.Label for o in doc.Objects if o.TypeId == "Part::FeaturePython"],
            "joints": {o.Joint: placed_of(o) for o in doc.Objects if is_joint(o)},
            "frame": placed_of(frame),
            "counts": [n for n in ("Rows", "Columns") if n in kit.PropertiesList],
            "of_frame": [n for n in ("Rows", "Columns") if n in frame.PropertiesList],
        }
        if name == "cells":
            kit.Rows, kit.Columns = 3, 2
            doc.recompute()
            found[name]["more"] = [placed_of(frame), kit.Pieces]
        kit.Clearance = 0.25
        (PLACES["folder"] / f"{name}_again").mkdir()
        found[name]["again"] = remaking(kit, PLACES["folder"] / f"{name}_again")
        doc.saveAs(saved(name))
    return found


def is_joint(obj):
    return getattr(obj, "Layout", "") == "joint"


def placed_of(assembly):
    """Part, and matrix row by row, of each piece that is shown."""
    return [
        [link.LinkedObject.Kind, *place.toMatrix().A]
        for link in assembly.Group
        for n, place in enumerate(link.PlacementList)
        if link.isElementVisible(str(n))
    ]


STEPS = (make, edit, refuse, old, other, bare, restore, export)


def main(steps, **given):
    """Do some of the steps in one start of FreeCAD; what each finds, by its name."""
    PLACES.update({name: Path(path) for name, path in given.items()})
    found = {}
    for step in STEPS:
        if step.__name__ in steps:
            JUDGED.clear()
            found[step.__name__] = step()
            for name in [*App.listDocuments()]:
                App.closeDocument(name)
    return found
