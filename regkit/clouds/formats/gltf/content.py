"""The JSON of a glTF file, and the arrays that it describes.

Source: The Khronos Group, glTF 2.0 Specification, sections 3.6 (binary data) and 4 (GLB).
"""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from regkit.system.errors import DataError

_KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_JSON, _BINARY = b"JSON", b"BIN\0"


@dataclass(frozen=True)
class GltfContent:
    """A glTF file.

    Attributes:
        path: The file.
        content: Its JSON.
        binary: The binary part of a GLB file.
    """

    path: Path
    content: dict[str, Any]
    binary: bytes

    @classmethod
    def of(cls, path: Path) -> GltfContent:
        """Reads a file."""
        data = path.read_bytes()
        text, binary = (data, b"") if data[:4] != b"glTF" else _chunks(data, str(path))
        content = json.loads(text.decode("utf-8-sig"))
        version = str(content.get("asset", {}).get("version", ""))
        if not version.startswith("2"):
            raise DataError("not a glTF 2.0 file; export the model as glTF 2.0", place=str(path))
        return cls(path, content, binary)

    def array(self, number: int, wanted: str) -> np.ndarray[Any, Any]:
        """Returns the values (N, C) of an accessor of the type ``wanted``."""
        accessor = self.content["accessors"][number]
        if accessor["type"] != wanted or "sparse" in accessor or "bufferView" not in accessor:
            raise DataError(
                f"accessor {number} is sparse, empty, or not of the type {wanted}",
                place=str(self.path),
            )
        view = self.content["bufferViews"][accessor["bufferView"]]
        kind, width = np.dtype(_KINDS[accessor["componentType"]]), 3 if wanted == "VEC3" else 1
        if (kind.kind == "f") != (wanted == "VEC3"):
            raise DataError(f"accessor {number} holds {kind} numbers", place=str(self.path))
        buffer, start = self.buffers[view["buffer"]], int(view.get("byteOffset", 0))
        held = buffer[start : start + int(view["byteLength"])]
        offset, own = int(accessor.get("byteOffset", 0)), kind.itemsize * width
        stride = int(view.get("byteStride", own))
        if min(start, offset, accessor["count"]) < 0 or stride < own:
            raise DataError(f"accessor {number} has an invalid size", place=str(self.path))
        # NumPy refuses an array that is larger than its buffer.
        return np.ndarray((accessor["count"], width), kind, held, offset, (stride, kind.itemsize))

    @cached_property
    def buffers(self) -> list[bytes]:
        """The contents of all buffers."""
        return [self._buffer(buffer) for buffer in self.content.get("buffers", [])]

    def _buffer(self, buffer: dict[str, Any]) -> bytes:
        uri = buffer.get("uri")
        if uri is None:
            data = self.binary
        elif uri.startswith("data:"):
            data = base64.b64decode(uri.partition(",")[2], validate=True)
        else:
            folder = self.path.parent.resolve()
            file = (folder / unquote(uri)).resolve()
            if not file.is_relative_to(folder):
                raise DataError(
                    f"the buffer '{uri[:60]}' is outside the file's folder", place=str(self.path)
                )
            if not file.is_file():
                raise DataError(f"there is no buffer '{uri[:60]}'", place=str(self.path))
            data = file.read_bytes()
        if len(data) < buffer["byteLength"]:
            raise DataError(
                f"a buffer announces {buffer['byteLength']} bytes, but holds {len(data)}",
                place=str(self.path),
            )
        return data


def _chunks(data: bytes, place: str) -> tuple[bytes, bytes]:
    """Returns the JSON and the binary part of a GLB file."""
    if int.from_bytes(data[8:12], "little") != len(data):
        raise DataError(
            f"announces {int.from_bytes(data[8:12], 'little')} bytes, but holds {len(data)}",
            place=place,
        )
    found: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= len(data):
        size, kind = int.from_bytes(data[at : at + 4], "little"), data[at + 4 : at + 8]
        found.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    return found.get(_JSON, b""), found.get(_BINARY, b"")
