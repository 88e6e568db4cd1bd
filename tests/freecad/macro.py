"""Inside FreeCAD: what a kit's macro makes, at many settings, saved and opened again."""

import sys
from pathlib import Path

import FreeCAD
import Part

STEP = "part.step"


def main(task, **given):
    return TASKS[task](**given)


def parts_of(document):
    return {obj.Name: obj for obj in document.Parts.Group}


def opened(macro):
    """Run a macro as FreeCAD does: in a copy of its main module."""
    text = Path(macro).read_text(encoding="utf-8")
    exec(compile(text, macro, "exec"), dict(vars(sys.modules["__main__"])))  # noqa: S102
    return FreeCAD.ActiveDocument


def set_all(document, values):
    for name, value in values.items():
        document.Parameters.set(name, f"={value!r} mm")
    document.recompute()


def facts(obj):
    box, base = obj.Shape.BoundBox, obj.Placement.Base
    return {
        "state": list(obj.State),
        "says": obj.getStatusString(),
        "type": obj.Shape.ShapeType,
        "closed": obj.Shape.isClosed(),
        "volume": obj.Shape.Volume,
        "low": [box.XMin - base.x, box.YMin - base.y, box.ZMin - base.z],
        "high": [box.XMax - base.x, box.YMax - base.y, box.ZMax - base.z],
    }


def validity(document):
    return [obj.Shape.isValid() for obj in parts_of(document).values()]


def through_step(obj, folder):
    """Validity, type and volume of a part after a trip through STEP."""
    path = f"{folder}/{STEP}"
    obj.Shape.exportStep(path)
    back = Part.Shape()
    back.read(path)
    return [back.isValid(), back.ShapeType, back.Volume]


def shapes(macro, settings, judged, folder):
    """Facts of all parts at each setting; validity as it opens, and at the last `judged` ones."""
    document = opened(macro)
    found = {"modules": sorted({m.split(".")[0] for m in sys.modules} & {"scadgen", "numpy"})}
    found["step"] = {n: through_step(obj, folder) for n, obj in parts_of(document).items()}
    found["valid"], found["settings"] = [validity(document)], []
    for number, values in enumerate(settings, judged - len(settings)):
        set_all(document, values)
        found["settings"].append({n: facts(obj) for n, obj in parts_of(document).items()})
        if number >= 0:
            found["valid"].append(validity(document))
    return found


def opens(macros):
    """Facts of all parts, and the volumes of joints and frame, as each macro leaves them."""
    return [facts_of(opened(macro)) for macro in macros]


def facts_of(document):
    (first, *_) = document.Frame.Group
    counts = [getattr(first, n) for n in ("Rows", "Columns") if n in first.PropertiesList]
    return {
        "counts": counts,
        "valid": validity(document),
        "parts": {n: facts(obj) for n, obj in parts_of(document).items()},
        "wholes": {o.Name: Part.getShape(o).Volume for o in document.findObjects("App::Part")},
    }


def assembly(macro, wider, rows, columns):
    document = opened(macro)
    found = {
        "types": {obj.TypeId for obj in document.Joint.Group + document.Frame.Group},
        "joint": [
            [obj.LinkedObject.Name, *obj.Placement.toMatrix().A] for obj in document.Joint.Group
        ],
        "joint_volume": Part.getShape(document.Joint).Volume,
        "frame_volume": Part.getShape(document.Frame).Volume,
    }
    for alias, count in (("rows", rows), ("columns", columns)):
        document.Parameters.set(alias, f"={count}")
    set_all(document, {"edge_length": wider})
    found["types"] = sorted(found["types"])
    found["frame"] = [
        [obj.LinkedObject.Name, *place.toMatrix().A]
        for obj in document.Frame.Group
        for n, place in enumerate(obj.PlacementList)
        if obj.isElementVisible(str(n))
    ]
    document.Parameters.set("rows", "=0")
    document.recompute()
    found["none"] = document.Frame.Group[0].getStatusString()
    return found


def life(macro, other, path, steps):
    """Cells set one after the other; saved, opened without the macro, and brought back."""
    document = opened(macro)
    found = []
    for cell, text in steps:
        document.Parameters.set(cell, text)
        document.recompute()
        found.append({n: facts(obj) for n, obj in parts_of(document).items()})
    limited = hasattr(sys, "tracebacklimit")
    document.saveAs(path)
    FreeCAD.closeDocument(document.Name)
    document = FreeCAD.openDocument(path)
    asleep = [parts_of(document)["half"].Proxy is None, facts(parts_of(document)["half"])]
    document.Parameters.set("clearance", "=0.1 mm")
    document.recompute()
    still = facts(parts_of(document)["half"])
    again = opened(macro)
    awake = facts(parts_of(again)["half"])
    names = [again.Name == document.Name, opened(other).Name != document.Name]
    return {
        "steps": found,
        "limited": limited,
        "asleep": asleep,
        "still": still,
        "awake": awake,
        "names": names,
    }


def beside(macro):
    """Run while a document of something else is open."""
    mine = FreeCAD.newDocument("mine")
    mine.addObject("Part::Box", "Box")
    mine.recompute()
    made = opened(macro)
    return [len(mine.Objects), made.Name != mine.Name, len(parts_of(made))]


def looks(macro, picture):
    """A picture from above, and where things are in it, in mm."""
    import FreeCADGui
    from PySide import QtGui

    document = opened(macro)
    view = FreeCADGui.activeDocument().activeView()
    view.viewTop()
    view.fitAll()
    FreeCADGui.updateGui()
    view.saveImage(picture, 600, 600, "White")
    image = QtGui.QImage(picture)
    colours = [image.pixelColor(x, y).getHsv() for x in range(600) for y in range(600)]
    hues = [colour[0] // 10 * 10 for colour in colours if colour[1] > 60]
    shown = [obj.Visibility for obj in document.Parts.Group]
    return [{str(hue): hues.count(hue) for hue in set(hues)}, shown]


TASKS = {
    "looks": looks,
    "opens": opens,
    "shapes": shapes,
    "assembly": assembly,
    "life": life,
    "beside": beside,
}
