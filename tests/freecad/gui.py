"""Run by FreeCAD with a window: every button is pressed, and what comes of it is looked at."""

import json
import os
import signal
import tempfile
import traceback
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
import Part
from PySide import QtCore, QtGui

#: Where things are: the kit, the engine, a document that has lost its behaviour, a folder.
PLACES = {}

BUTTONS = (
    *("NewKit", "OpenKit", "Joint", "Part", "Frame", "Explode", "Check", "Export"),
    *("Restore", "Preferences"),
)

#: Where task panels and the tree are: one in FreeCAD 0.20, two in 1.0.
PANELS = ("Combo View", "Tasks", "Model")

#: Seconds that anything may take.
PATIENCE = 120

app = QtGui.QApplication.instance()


def settings():
    return App.ParamGet("User parameter:BaseApp/Preferences/Mod/Scadgen")


def bar():
    return Gui.getMainWindow().findChild(QtGui.QToolBar, "Scadgen")


def button(name):
    (action,) = (a for a in bar().actions() if a.objectName() == f"Scadgen_{name}")
    return bar().widgetForAction(action)


def press(name):
    """Press a button once it can be, when the loop is free: a dialog would keep it."""
    yield lambda: button(name).isEnabled()
    QtCore.QTimer.singleShot(0, button(name).click)


def visible(kind):
    """All widgets of a kind that are shown.

    None of a panel may be kept: once the panel is closed, Python would take it for another
    widget that comes to lie where it was.  `findChildren` of the main window keeps them.
    """
    return [w for w in app.allWidgets() if isinstance(w, kind) and w.isVisible()]


def panel(name):
    """The form of the open task panel, if it is the one of a name."""
    return next((w for w in visible(QtGui.QWidget) if w.objectName() == name), None)


def field(kind, name):
    """A field of the open task panel."""
    return next(w for w in visible(kind) if w.objectName() == name)


def box_button(kind):
    """A button of the open task panel."""
    return next(b.button(kind) for b in visible(QtGui.QDialogButtonBox) if b.button(kind))


def names(doc=None):
    return sorted(o.Name for o in (doc or App.ActiveDocument).Objects)


def arrange(width):
    """The panel and the 3D view, and nothing else."""
    window = Gui.getMainWindow()
    for dock in window.findChildren(QtGui.QDockWidget):
        shown = dock.objectName() in PANELS
        dock.setVisible(shown)
        if shown:
            window.resizeDocks([dock], [width], QtCore.Qt.Horizontal)
    window.statusBar().clearMessage()


def settle():
    """Let FreeCAD draw; the tree is a little late."""
    loop = QtCore.QEventLoop()
    QtCore.QTimer.singleShot(300, loop.quit)
    loop.exec_()


def picture(name, *, fit=False, width=330):
    """Keep a picture of the whole window."""
    arrange(width)
    settle()
    if fit:
        Gui.activeView().viewIsometric()
        Gui.activeView().fitAll()
        settle()
    image = QtGui.QApplication.primaryScreen().grabWindow(0)
    assert image.save(str(PLACES["folder"] / f"{name}.png"))


def ok():
    box_button(QtGui.QDialogButtonBox.Ok).click()


def cancel():
    box_button(QtGui.QDialogButtonBox.Cancel).click()


def is_closed():
    return not Gui.Control.activeDialog()


def process():
    """The program that a task panel runs."""
    found = panel("ScadgenNewKit") or panel("ScadgenCheck")
    return found and found.findChild(QtCore.QProcess)


def is_idle():
    """Whether the engine of the panel is done."""
    return not process() and field(QtGui.QWidget, "inputs").isEnabled()


def the_workbench_is_there():
    assert "ScadgenWorkbench" in Gui.listWorkbenches()
    Gui.activateWorkbench("ScadgenWorkbench")
    yield lambda: bar() is not None
    window = Gui.getMainWindow()
    shown = [a.objectName() for a in bar().actions() if not a.isSeparator()]
    assert shown == [f"Scadgen_{name}" for name in BUTTONS], shown
    assert all(not button(name).icon().isNull() for name in BUTTONS)
    menus = [m for m in window.menuBar().findChildren(QtGui.QMenu) if m.title() == "Scadgen"]
    assert [a.objectName() for a in menus[0].actions() if not a.isSeparator()] == shown
    assert "freecad.scadgen.self_test" in App.__unit_test__
    first = {"NewKit", "OpenKit", "Preferences"}
    yield lambda: {name for name in BUTTONS if button(name).isEnabled()} == first


def new_kit_panel():
    yield from press("NewKit")
    yield lambda: panel("ScadgenNewKit")
    yield is_idle
    field(QtGui.QComboBox, "detail").setCurrentIndex(0)


def frames():
    """What the panel's list of frames shows."""
    box = field(QtGui.QComboBox, "frame")
    return [box.itemText(n) for n in range(box.count())]


def choose_frame(name):
    field(QtGui.QComboBox, "frame").setCurrentIndex(frames().index(name))


def options():
    """Names of the options that the panel shows."""
    found = (w.objectName() for kind in (QtGui.QLineEdit, QtGui.QCheckBox) for w in visible(kind))
    return {name[7:] for name in found if name.startswith("option_")}


def set_option(name, text):
    field(QtGui.QLineEdit, f"option_{name}").setText(text)


def program(name, text):
    path = PLACES["folder"] / name
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return str(path)


def bad_engines():
    """Engines that cannot work, and what is said of each."""
    return (
        (
            str(PLACES["folder"] / "nowhere"),
            "no such program; say where it is under Edit > Preferences",
        ),
        (program("other", "echo something else"), "is not scadgen (it said 'something else')"),
        (program("newer", "echo scadgen, version 9.1.0"), "is scadgen 9.1.0, this workbench needs"),
        (program("broken", "echo what is broken >&2; exit 3"), "what is broken"),
        (program("mute", "exit 3"), "left with status 3 and said nothing"),
        (program("idle", "echo scadgen, version 0.1.0"), "no kit can be read there"),
    )


def an_engine_that_cannot_work_is_said_so():
    settings().SetString("Engine", str(PLACES["engine"]))
    yield from new_kit_panel()
    assert len(frames()) > 20
    yield from each_bad_engine()
    yield from new_kit_panel()
    assert frames() == []
    yield from each_bad_engine("frame gave no list")
    settings().SetString("Engine", str(PLACES["engine"]))


def each_bad_engine(idle="no kit can be read there"):
    """OK is pressed with each, and the panel closed; the idle one has a version and no more."""
    for path, words in bad_engines():
        settings().SetString("Engine", path)
        ok()
        yield is_idle
        assert (idle if path.endswith("idle") else words) in panel_text(), panel_text()
        assert "\n" not in panel_text()
    assert App.ActiveDocument is None
    cancel()
    yield is_closed


def each_frame_has_its_options():
    yield from new_kit_panel()
    assert frames()[:2] == ["hexagonal", "square"]
    area = {"rows", "columns", "radius", "outline"}
    for name, wanted in (
        ("rhombic", {"angle", *area}),
        ("ladder", {"bays", "width", "bay_length"}),
        ("4.8.8", area),
    ):
        choose_frame(name)
        yield lambda wanted=wanted: options() == wanted
    assert field(QtGui.QLabel, "frame_text").text() == "squares and octagons"
    choose_frame("From a file")
    ok()
    assert panel_text() == "Choose the file that the frame is in", panel_text()
    for ending, wanted in (("svg", {"no_split", "flatten"}), ("json", {"repair"})):
        field(QtGui.QWidget, "file").setProperty("fileName", f"drawing.{ending}")
        yield lambda wanted=wanted: wanted <= options()
        assert {"scale", "snap"} <= options()
    assert "flatten" not in options()
    cancel()
    yield is_closed


def a_frame_from_a_file_is_made():
    path = PLACES["folder"] / "tee.json"
    drawn = {"vertices": [[0, 0], [-15, 0], [15, 0], [0, 15]], "edges": [[0, 1], [0, 2], [0, 3]]}
    path.write_text(json.dumps(drawn))
    yield from new_kit_panel()
    choose_frame("From a file")
    field(QtGui.QWidget, "file").setProperty("fileName", str(path))
    yield lambda: "scale" in options()
    field(QtGui.QCheckBox, "proved").setChecked(False)
    set_option("scale", "much")
    ok()
    yield is_idle
    assert "much" in panel_text(), panel_text()
    assert App.ActiveDocument is None
    set_option("scale", "10")
    field(QtGui.QComboBox, "place").setCurrentIndex(1)
    ok()
    yield is_closed
    doc = App.ActiveDocument
    assert doc.Kit.Label == "Kit: tee"
    assert "Rows" not in doc.Kit.PropertiesList
    assert doc.Frame.Pieces == doc.Kit.Pieces > 3
    App.closeDocument(doc.Name)


def what_the_engine_refuses_is_said():
    yield from new_kit_panel()
    field(QtGui.QWidget, "clearance").setProperty("rawValue", 3.0)
    ok()
    yield is_idle
    assert panel_text().startswith("scadgen: clearance = 3 mm: must be 0 to 0."), panel_text()
    weave = field(QtGui.QComboBox, "weave")
    weave.setCurrentIndex(1)
    field(QtGui.QWidget, "weave_file").setProperty("fileName", str(PLACES["folder"] / "no.json"))
    ok()
    yield is_idle
    assert panel_text().startswith("scadgen: weave "), panel_text()
    assert App.ActiveDocument is None
    cancel()
    yield is_closed


def number():
    """The number of the panel's program, once it is past its version."""
    found = process()
    return found.processId() if found and "kit" in found.arguments() else 0


def is_gone(run):
    """Whether a program has ended, and has left nothing where things lie for a while."""
    return not Path(f"/proc/{run}").exists() and not left_over()


def left_over():
    return [*Path(tempfile.gettempdir()).glob("scadgen-*")]


def percent():
    """What the progress bar of the open panel says, if it is seen."""
    return next((bar.value() for bar in visible(QtGui.QProgressBar)), 0)


def until(there, shown):
    """Wait, and keep the percentages that are shown meanwhile."""

    def look():
        shown.extend(filter(None, [percent()]))
        return there()

    return look


def an_engine_that_is_killed_leaves_nothing():
    yield from new_kit_panel()
    ok()
    yield number
    os.kill(number(), signal.SIGKILL)
    yield is_idle
    assert "killed or crashed midway" in panel_text(), panel_text()
    assert App.ActiveDocument is None
    cancel()
    yield is_closed


def cancel_leaves_nothing():
    yield from new_kit_panel()
    doc = App.newDocument("Empty")
    ok()
    yield number
    yield lambda: panel_text() == "computing the joints"
    run = number()
    assert not box_button(QtGui.QDialogButtonBox.Ok).isEnabled()
    assert field(QtGui.QProgressBar, "progress").isVisible()
    cancel()
    yield is_idle
    assert "Stopped; nothing was made" in panel_text(), panel_text()
    assert is_gone(run)
    assert (names(doc), doc.UndoCount) == ([], 0)
    cancel()
    yield is_closed
    App.closeDocument(doc.Name)


def an_engine_that_does_not_listen_is_stopped():
    yield from new_kit_panel()
    settings().SetString("Engine", program("deaf", "trap '' TERM; exec sleep 60"))
    ok()
    yield lambda: process() and process().processId()
    run = process().processId()
    cancel()
    yield is_idle
    assert is_gone(run)
    cancel()
    yield is_closed
    settings().SetString("Engine", program("slow", "exec sleep 60"))
    yield from press("NewKit")
    yield lambda: process() and process().processId()
    cancel()
    yield is_closed
    settings().SetString("Engine", str(PLACES["engine"]))


def a_new_kit_is_made_and_undone():
    yield from new_kit_panel()
    set_option("rows", "2")
    field(QtGui.QWidget, "clearance").setProperty("rawValue", 0.25)
    picture("new_kit")
    assert field(QtGui.QCheckBox, "proved").isChecked()
    shown = []
    ok()
    yield until(lambda: is_closed() or not process(), shown)
    yield is_closed
    assert shown == sorted(shown), shown
    assert len({*shown}) > 8, shown
    assert not left_over()
    doc = App.ActiveDocument
    assert doc.Kit.Clearance.Value == 0.25
    assert doc.Joint.Pieces == 5
    assert doc.Half.Shape.isValid()
    made = names()
    picture("joint", fit=True)
    Gui.runCommand("Std_Undo")
    assert names() == [], names()
    Gui.runCommand("Std_Redo")
    assert names() == made
    yield lambda: all(button(name).isEnabled() for name in BUTTONS)


def choose(rows):
    """Choose lines of the open panel's list, and give all that it shows."""
    yield lambda: panel("ScadgenChoose")
    found = field(QtGui.QListWidget, "list")
    assert all(not found.item(n).icon().isNull() for n in range(found.count()))
    found.clearSelection()
    for row in rows:
        found.item(row).setSelected(True)
    return [found.item(n).text() for n in range(found.count())]


def parts_joint_and_frame_are_added_and_undone():
    doc = App.ActiveDocument
    for name in ("Joint", "Part", "Frame"):
        before = names()
        Gui.Selection.clearSelection()
        yield from press(name)
        if name == "Part":
            shown = yield from choose(range(7))
            assert shown[:3] == ["Basic element", "One-sided element", "Two-sided element"], shown
            assert shown[3:] == ["Connector", "Half", "Peg", "Tube"], shown
            ok()
            yield is_closed
        yield Gui.Selection.getSelection
        made = names()
        chosen = Gui.Selection.getSelection()
        assert len(chosen) == (7 if name == "Part" else 1)
        for obj in chosen:
            assert obj.isValid()
            assert "Shape" not in obj.PropertiesList or obj.Shape.isValid()
        Gui.runCommand("Std_Undo")
        assert names() == before, name
        Gui.runCommand("Std_Redo")
        assert names() == made, name
        if name != "Frame":
            Gui.runCommand("Std_Undo")
    doc.Joint.ViewObject.Visibility = False
    assert doc.Frame.Pieces == 61
    assert len([o for o in doc.Objects if o.TypeId == "Part::FeaturePython"]) == 5
    picture("frame", fit=True)


def a_part_has_a_clearance_of_its_own():
    doc = App.ActiveDocument
    volume, other = doc.Half.Volume.Value, doc.Connector.Volume.Value

    def menu():
        found = QtGui.QMenu()
        doc.Half.ViewObject.Proxy.setupContextMenu(doc.Half.ViewObject, found)
        return found, [a.text() for a in found.actions()]

    found, words = menu()
    assert words == ["Give it a clearance of its own"], words
    steps = doc.UndoCount
    found.actions()[0].trigger()
    assert doc.UndoCount == steps + 1
    doc.Half.Clearance = 0.1
    doc.recompute()
    assert doc.Half.Volume.Value > volume
    assert doc.Connector.Volume.Value == other
    found, words = menu()
    assert words == ["Let it follow its kit again"], words
    steps = doc.UndoCount
    found.actions()[0].trigger()
    assert doc.UndoCount == steps + 1
    assert doc.Half.Volume.Value == volume
    yield lambda: True


def assemblies_are_pulled_apart():
    doc = App.ActiveDocument

    def places():
        found = (*doc.Frame_row.PlacementList, *doc.Joint_half_a.PlacementList)
        return [tuple(place.Base) for place in found]

    before = places()
    for assembly, answer in ((doc.Frame, cancel), (doc.Joint, ok)):
        for other in (doc.Frame, doc.Joint):
            other.ViewObject.Visibility = other is assembly
        Gui.Selection.clearSelection()
        Gui.Selection.addSelection(assembly)
        yield from press("Explode")
        yield lambda: panel("ScadgenExplode")
        field(QtGui.QSlider, "slider").setValue(25)
        assert places() != before
        assert assembly.Explode == 2.5
        Gui.Selection.clearSelection()
        picture("explode", fit=True)
        answer()
        yield is_closed
        assert (places() == before) == (answer == cancel)
    Gui.runCommand("Std_Undo")
    assert doc.Joint.Explode == 0
    assert places() == before


def files_are_written():
    doc = App.ActiveDocument
    target = PLACES["folder"] / "export"
    target.mkdir()

    def export(what, kind):
        yield from press("Export")
        yield lambda: panel("ScadgenExport")
        field(QtGui.QRadioButton, what).setChecked(True)
        field(QtGui.QComboBox, "format").setCurrentIndex(kind)
        field(QtGui.QWidget, "folder").setProperty("fileName", str(target))

    Gui.Selection.clearSelection()
    for kind in range(3):
        yield from export("whole", kind)
        if kind == 2:
            field(QtGui.QWidget, "folder").setProperty("fileName", "truss")
            picture("export")
            field(QtGui.QWidget, "folder").setProperty("fileName", str(target))
        ok()
        yield is_closed
    Gui.Selection.addSelection(doc.Half)
    yield from export("selected", 0)
    ok()
    yield is_closed
    found = sorted(p.name for p in target.iterdir())
    assert {"bill.csv", "Half.step", "hexagonal_plate_1.3mf"} <= {*found}, found
    assert {"hexagonal_basic_x13.step", "hexagonal_half_x32.stl"} <= {*found}, found
    Gui.Selection.clearSelection()
    yield from export("selected", 1)
    ok()
    assert panel_text().startswith("nothing is selected"), panel_text()
    cancel()
    yield is_closed


def a_check_that_the_engine_cannot_make_is_said_so():
    for path, words in bad_engines():
        settings().SetString("Engine", path)
        yield from press("Check")
        yield lambda: panel("ScadgenCheck")
        yield lambda: not process()
        assert words in panel_text(), panel_text()
        box_button(QtGui.QDialogButtonBox.Close).click()
        yield is_closed
    settings().SetString("Engine", str(PLACES["engine"]))


def a_stale_shape_is_found():
    half = App.ActiveDocument.Half
    shape, half.Shape = half.Shape.copy(), Part.makeBox(1, 2, 3)
    settings().SetString("Engine", str(PLACES["folder"] / "nowhere"))
    yield from press("Check")
    yield lambda: panel("ScadgenCheck")
    table = field(QtGui.QTableWidget, "table")
    yield table.rowCount
    rows = [[table.item(r, c).text() for c in range(4)] for r in range(table.rowCount())]
    assert len(rows) == 1, rows
    assert rows[0][:3] == ["FAILED", "Half has the shape that its values make", "6 mm3"], rows
    box_button(QtGui.QDialogButtonBox.Close).click()
    yield is_closed
    half.Shape = shape
    settings().SetString("Engine", str(PLACES["engine"]))


def closing_a_check_stops_it():
    yield from press("Check")
    yield number
    run = number()
    box_button(QtGui.QDialogButtonBox.Close).click()
    yield is_closed
    assert is_gone(run)


def a_kit_is_checked():
    doc = App.ActiveDocument
    text = json.loads(doc.Kit.Data)
    text["joints"][0]["weave"]["name"] = "../elsewhere"
    moved = text["parts"]["half"]["points"]["side"]
    moved[0][0] += 1e-6
    doc.Kit.Data = json.dumps(text)
    doc.recompute()
    Gui.Selection.clearSelection()
    yield from press("Check")
    yield lambda: panel("ScadgenCheck")
    shown = []
    yield until(lambda: "checks are good" in panel_text(), shown)
    assert shown == sorted(shown), shown
    assert len({*shown}) > 20, shown
    table = field(QtGui.QTableWidget, "table")
    rows = [[table.item(r, c).text() for c in range(4)] for r in range(table.rowCount())]
    assert len(rows) > 30, panel_text()
    assert rows[0] == ["FAILED", "half is what the engine makes", "another", "the same"], rows[:2]
    others = [row[0] for row in rows[1:] if row[1].endswith("is what the engine makes")]
    assert others == ["ok"] * 6, rows
    chosen = {o.Name for o in Gui.Selection.getSelection()}
    assert chosen == {"Half", *(o.Name for o in doc.Half.InList if o.TypeId == "App::Link")}
    assert "Joint_half_a" in chosen
    assert not (PLACES["folder"].parent / "tmp" / "elsewhere.json").exists()
    picture("check", width=640)
    box_button(QtGui.QDialogButtonBox.Close).click()
    yield is_closed
    Gui.runCommand("Std_Undo")


def modal(kind):
    found = app.activeModalWidget()
    return found if isinstance(found, kind) else None


def kits_are_opened_or_refused():
    doc = App.newDocument("Opened")
    newer = json.loads(PLACES["kit"].read_text())
    newer["version"] = 6
    for name, text, words in (
        ("broken.json", PLACES["kit"].read_text()[:5000], "not a sound kit: truncated or not JSON"),
        ("newer.json", json.dumps(newer), "kit version 6: this reads version 5; make it again"),
        ("kit.json", PLACES["kit"].read_text(), ""),
    ):
        (PLACES["folder"] / name).write_text(text)
        yield from press("OpenKit")
        yield lambda: modal(QtGui.QFileDialog)
        dialog = modal(QtGui.QFileDialog)
        dialog.findChild(QtGui.QLineEdit, "fileNameEdit").setText(str(PLACES["folder"] / name))
        dialog.accept()
        if words:
            yield lambda: modal(QtGui.QMessageBox)
            said = modal(QtGui.QMessageBox).text()
            assert words in said, said
            assert str(PLACES["folder"] / name) in said, said
            modal(QtGui.QMessageBox).accept()
            yield lambda: app.activeModalWidget() is None
            assert (names(doc), doc.UndoCount) == ([], 0)
        else:
            yield lambda: "Joint" in names(doc)
    assert doc.Joint.Pieces == 5
    assert doc.UndoCount == 1
    Gui.runCommand("Std_Undo")
    assert names(doc) == []


def lost_behaviour_is_restored():
    doc = App.openDocument(str(PLACES["lost"]))
    assert doc.Kit.Proxy is None
    volume = doc.Half.Shape.Volume
    doc.Kit.Clearance = 0.1
    doc.recompute()
    assert doc.Half.Shape.Volume == volume
    steps = doc.UndoCount
    yield from press("Restore")
    yield lambda: doc.Kit.Proxy is not None
    assert doc.UndoCount == steps + 1
    assert doc.Half.ViewObject.Proxy is not None
    assert doc.Half.Shape.Volume > volume


def preferences_are_shown():
    yield from press("Preferences")
    yield app.activeModalWidget
    dialog = app.activeModalWidget()
    fields = dialog.findChildren(QtGui.QWidget, "engine")
    assert [f.property("fileName") for f in fields if f.isVisible()] == [str(PLACES["engine"])]
    width = dialog.findChild(QtGui.QDoubleSpinBox, "width")
    assert width.value() == 220
    width.setValue(180)
    picture("preferences")
    dialog.accept()
    yield lambda: app.activeModalWidget() is None
    assert settings().GetFloat("BedWidth") == 180


def it_speaks_german():
    Gui.setLocale("German")
    yield lambda: button("NewKit").text() == "Neuer Bausatz"
    yield from new_kit_panel()
    assert field(QtGui.QCheckBox, "has_side").text() == "Seite"
    assert {"Reihen", "Spalten"} <= {w.text() for w in visible(QtGui.QLabel)}
    cancel()
    yield is_closed


STEPS = (
    the_workbench_is_there,
    an_engine_that_cannot_work_is_said_so,
    each_frame_has_its_options,
    what_the_engine_refuses_is_said,
    an_engine_that_is_killed_leaves_nothing,
    cancel_leaves_nothing,
    an_engine_that_does_not_listen_is_stopped,
    a_frame_from_a_file_is_made,
    a_new_kit_is_made_and_undone,
    parts_joint_and_frame_are_added_and_undone,
    a_part_has_a_clearance_of_its_own,
    assemblies_are_pulled_apart,
    files_are_written,
    a_check_that_the_engine_cannot_make_is_said_so,
    a_stale_shape_is_found,
    closing_a_check_stops_it,
    a_kit_is_checked,
    kits_are_opened_or_refused,
    lost_behaviour_is_restored,
    preferences_are_shown,
    it_speaks_german,
)


def each_in_turn(done):
    for step in STEPS:
        yield from step()
        assert is_closed(), f"{step.__name__} leaves a panel open"
        done.append(step.__name__)


def panel_text():
    return " / ".join(w.text() for w in visible(QtGui.QLabel) if w.objectName() == "message")


class Driver:
    """Goes on with the steps when what they wait for is there; FreeCAD lives meanwhile."""

    def __init__(self, run):
        self.run, self.wait, self.left, self.wrong = run, lambda: True, PATIENCE, ""
        self.loop, self.timer = QtCore.QEventLoop(), QtCore.QTimer()
        self.timer.timeout.connect(self.tick)

    def drive(self):
        self.timer.start(50)
        self.loop.exec_()
        assert not self.wrong, self.wrong

    def tick(self):
        try:
            self.go_on()
        except StopIteration:
            self.loop.quit()
        except Exception:  # noqa: BLE001  said by `drive`
            self.timer.stop()
            self.wrong = traceback.format_exc()
            self.loop.quit()

    def go_on(self):
        self.left -= 0.05
        assert self.left > 0, f"nothing happens: {panel_text()}"
        # While FreeCAD computes, it lets timers go on.
        busy = any(doc.Recomputing for doc in App.listDocuments().values())
        if not busy and not self.run.gi_running and self.wait():
            self.wait, self.left = next(self.run), PATIENCE


def main(**given):
    """All steps in one start; the names of those that hold."""
    PLACES.update({name: Path(path) for name, path in given.items()})
    done = []
    Driver(each_in_turn(done)).drive()
    return done
