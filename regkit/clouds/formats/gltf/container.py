"""The containers of a glTF file: a .gltf file of JSON, or a .glb file with its chunks.

Source: The Khronos Group, glTF 2.0 Specification, section 4 (GLB).
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

from regkit.system.errors import DataError
from regkit.system.notes import note

MAGIC = b"glTF"
_JSON, _BINARY = 0x4E4F534A, 0x004E4942


def read_container(path: Path) -> tuple[dict[str, Any], bytes | None]:
    """Returns the JSON of a glTF 2.0 file, and the binary chunk of a .glb file.

    Files are told apart by their content, since their suffixes are exchanged at times.

    Raises:
        DataError: If the file is not glTF 2.0.
        OSError: If it cannot be read.
    """
    content = path.read_bytes()
    if content.startswith(MAGIC):
        text, binary = _chunks(content, path)
    else:
        text, binary = content, None
    try:
        model = json.loads(text.decode("utf-8-sig").rstrip("\0 \t\r\n"))
    except ValueError as error:
        raise DataError(f"not a glTF 2.0 file: its JSON is damaged ({error})") from None
    _check_version(model)
    return model, binary


def _chunks(content: bytes, path: Path) -> tuple[bytes, bytes | None]:
    """Returns the JSON chunk and the binary chunk, in whichever order they are."""
    if len(content) < 12:
        raise DataError(f"not a glTF 2.0 file: it ends after {len(content)} bytes")
    version, length = struct.unpack_from("<II", content, 4)
    if version != 2:
        raise DataError(f"a .glb file of version {version}; {_CONVERT}")
    if length != len(content):
        note(f"has {len(content)} bytes, and announces {length}", place=path)
    chunks: dict[int, bytes] = {}
    start = 12
    while start + 8 <= len(content):
        size, kind = struct.unpack_from("<II", content, start)
        start += 8
        if start + size > len(content):
            raise DataError(
                f"not a glTF 2.0 file: a chunk of {size} bytes begins at byte {start} of "
                f"{len(content)}; the file is cut off"
            )
        # Chunks of other kinds belong to extensions, and only the first of a kind counts.
        chunks.setdefault(kind, content[start : start + size])
        start += size
    if _JSON not in chunks:
        raise DataError(
            f"not a glTF 2.0 file: it has no chunk of JSON; it announces {length} bytes and has "
            f"{len(content)}"
        )
    return chunks[_JSON], chunks.get(_BINARY)


def _check_version(model: Any) -> None:
    asset = model.get("asset") if isinstance(model, dict) else None
    version = str(asset.get("version")) if isinstance(asset, dict) else None
    if version is None or not version.startswith("2"):
        stated = "no version" if version is None else f"the version {version}"
        raise DataError(f"not a glTF 2.0 file: it has {stated}; {_CONVERT}")


_CONVERT = "export the model as glTF 2.0"
