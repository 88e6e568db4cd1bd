"""FreeCAD runs this at its start, with or without a window: what its Test workbench can run."""

import FreeCAD

FreeCAD.__unit_test__ += ["freecad.scadgen.self_test"]
