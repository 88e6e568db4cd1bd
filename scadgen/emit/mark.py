"""The mark in a file that scadgen made, by which it knows the file again.

A mark has a digest of all else in the file, so a file that somebody changed since is not known.
It stands where the format has room for a remark: a comment, a PNG's text, an STL's header.
"""

from __future__ import annotations

import hashlib
import re
import struct
import zlib
from collections.abc import Callable, Mapping
from types import MappingProxyType

from scadgen.emit.parts_csv import HEADER
from scadgen.errors import InvariantError

__all__ = ["is_ours", "marked"]

_WORDS, _DIGITS = b"made by scadgen ", 16

_EMPTY = _WORDS + _DIGITS * b"0"

_MARK = re.compile(re.escape(_WORDS) + rb"([0-9a-f]{%d})" % _DIGITS)

#: Bytes after a mark that its digest leaves out: a PNG's checksum of the chunk it stands in.
_LEFT_OUT = 4

#: Where the remark begins in the header of a binary STL, and how long that is.
_STL_REMARK, _STL_HEADER = 16, 80


def _svg(data: bytes) -> bytes:
    return data + b"<!-- " + _EMPTY + b" -->\n"


def _obj(data: bytes) -> bytes:
    return data + b"# " + _EMPTY + b"\n"


def _json(data: bytes) -> bytes:
    body = data.rstrip().removesuffix(b"}").rstrip()
    return body + b',\n "comment": "' + _EMPTY + b'"\n}\n'


def _stl(data: bytes) -> bytes:
    remark = data[:_STL_REMARK] + _EMPTY
    return remark.ljust(_STL_HEADER) + data[_STL_HEADER:]


def _3mf(data: bytes) -> bytes:
    """A zip file ends with its remark, and the length of that before it."""
    return data[:-2] + struct.pack("<H", len(_EMPTY)) + _EMPTY


def _glb(data: bytes) -> bytes:
    (length,) = struct.unpack_from("<I", data, 12)
    text, rest = data[20 : 20 + length].rstrip(), data[20 + length :]
    text = text.replace(b'"asset":{', b'"asset":{"generator":"' + _EMPTY + b'",', 1)
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I", len(text)) + data[16:20] + text + rest
    return data[:8] + struct.pack("<I", 12 + len(body)) + body


def _png(data: bytes) -> bytes:
    text = b"Software\0" + _EMPTY
    chunk = struct.pack(">I", len(text)) + b"tEXt" + text + _LEFT_OUT * b"\0"
    return data[:-12] + chunk + data[-12:]


def _gif(data: bytes) -> bytes:
    return data[:-1] + b"\x21\xfe" + bytes([len(_EMPTY)]) + _EMPTY + b"\0" + data[-1:]


_MARKS: Mapping[str, Callable[[bytes], bytes]] = MappingProxyType(
    {
        "3mf": _3mf,
        "gif": _gif,
        "glb": _glb,
        "json": _json,
        "obj": _obj,
        "png": _png,
        "stl": _stl,
        "svg": _svg,
    }
)

#: A table has no room for a remark; it is known by its first line.
_TABLE, _FIRST = "csv", (",".join(HEADER) + "\n").encode()


def marked(data: bytes, kind: str) -> bytes:
    """A file with its mark.

    Parameters
    ----------
    data
        The file as it is written: of a kind that scadgen writes.
    kind
        Its kind: ``stl``, ``svg``, ...
    """
    if kind == _TABLE:
        return data
    data = _MARKS[kind](data)
    at = data.rfind(_EMPTY)
    if at < 0:
        msg = f"a {kind} file has room for its mark"
        raise InvariantError(msg)
    end = at + len(_EMPTY)
    data = data[:at] + _WORDS + _digest(data, at) + data[end:]
    if kind == "png":
        chunk = data[data.rfind(b"tEXt", 0, at) : end]
        data = data[:end] + struct.pack(">I", zlib.crc32(chunk)) + data[end + _LEFT_OUT :]
    return data


def is_ours(data: bytes) -> bool:
    """Whether scadgen made a file, and nobody changed it since."""
    if data.startswith(_FIRST):
        return True
    marks = list(_MARK.finditer(data))
    return bool(marks) and marks[-1][1] == _digest(data, marks[-1].start())


def _digest(data: bytes, at: int) -> bytes:
    rest = data[:at] + data[at + len(_EMPTY) + _LEFT_OUT :]
    return hashlib.sha256(rest).hexdigest()[:_DIGITS].encode()
