"""Runs FreeCAD, and believes it only when everything it says is good.

FreeCAD leaves with status 0 after many errors, so a script runs inside one that catches all
of them, and its result comes back as a file.
"""

import json
import os
import shutil
import subprocess
from pathlib import Path

SCRIPTS = Path(__file__).parent / "freecad"

_RUNNER = """\
import json, os, runpy, sys, traceback
def go():
    try:
        found = runpy.run_path({script!r})["main"](**json.loads({given!r}))
        with open({result!r}, "w") as file:
            json.dump(found, file)
        status = 0
    except BaseException:
        traceback.print_exc()
        status = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)
"""

_AT_ONCE = "go()\n"

# The window is there only when this script has ended.
_SOON = "from PySide import QtCore\nQtCore.QTimer.singleShot(300, go)\n"

_DISPLAY = ("xvfb-run", "-a", "-s", "-screen 0 1280x800x24")

# The start page refuses to run as root.
_SETTINGS = """\
<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp">
<FCParamGroup Name="Preferences"><FCParamGroup Name="General">
<FCText Name="AutoloadModule">PartWorkbench</FCText>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""


def run(script, home, *, timeout=120, window=False, **given):
    """What `main` of a script gives back, and all that FreeCAD said."""
    result, runner = home / "result.json", home / "runner.py"
    result.unlink(missing_ok=True)
    names = {"script": str(SCRIPTS / script), "given": json.dumps(given), "result": str(result)}
    runner.write_text(_RUNNER.format(**names) + (_SOON if window else _AT_ONCE))
    said = call(home, runner, timeout=timeout, window=window)
    return json.loads(result.read_text()), said


def call(home, *arguments, timeout=120, window=False):
    """What FreeCAD says, called with these arguments; it must have nothing to complain of."""
    program = "freecad" if window else "freecadcmd"
    assert shutil.which(program), f"{program}: not found; make setup installs it"
    (home / "user.cfg").write_text(_SETTINGS)
    # A home of its own, and none of our packages.
    left_out = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV")
    environment = {name: v for name, v in os.environ.items() if name not in left_out}
    homes = ("FREECAD_USER_HOME", "HOME", "XDG_RUNTIME_DIR")
    done = subprocess.run(
        [*(_DISPLAY if window else ()), program, *map(str, arguments)],
        env=environment | {name: str(home) for name in homes} | {"LIBGL_ALWAYS_SOFTWARE": "1"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=timeout,
        check=False,
    )
    said = done.stdout.decode("utf-8", "replace")
    assert done.returncode == 0, said
    assert "Traceback" not in said, said
    return said
