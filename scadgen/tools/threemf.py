"""Names the object in a 3MF that OpenSCAD wrote."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path
from xml.sax.saxutils import quoteattr

from scadgen.emit.mesh import write_atomic

__all__ = ["name_object"]

_MODEL = "3D/3dmodel.model"

_OBJECT = re.compile(rb'(<object\b[^>]*?\bname=)"[^"]*"')


def name_object(path: Path, name: str) -> None:
    """Call the object in a 3MF by the name of its part.

    Parameters
    ----------
    path
        The file, with one object that has some name.
    name
        Its name.
    """
    written = io.BytesIO()
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(written, "w", zipfile.ZIP_DEFLATED) as new:
        for entry in old.namelist():
            data = old.read(entry)
            if entry == _MODEL:
                data = _OBJECT.sub(rb"\1" + quoteattr(name).encode().replace(b"\\", b"\\\\"), data)
            new.writestr(zipfile.ZipInfo(entry), data, zipfile.ZIP_DEFLATED)
    write_atomic(path, written.getvalue())
