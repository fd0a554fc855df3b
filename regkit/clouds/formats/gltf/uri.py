"""The data behind a URI of a glTF file: in the file itself, or beside it.

Source: The Khronos Group, glTF 2.0 Specification, section 2.8 (URIs).
"""

from __future__ import annotations

import binascii
import re
from pathlib import Path
from urllib.parse import unquote, unquote_to_bytes

from regkit.system.errors import DataError
from regkit.system.printable import shortened

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")


def read_uri(uri: str, folder: Path) -> bytes:
    """Returns the data of a URI.

    Args:
        uri: A ``data:`` URI of any media type, or a relative path.
        folder: Folder of the glTF file.

    Raises:
        DataError: If the URI leaves the folder, or there is no such file.
    """
    if uri[:5].lower() == "data:":
        return _embedded(uri[5:])
    shown = shortened(uri)
    if _SCHEME.match(uri):
        raise DataError(f"the buffer '{shown}' is elsewhere; it must be in the file's folder")
    base = folder.resolve()
    # The name itself may hold percent signs.
    for name in dict.fromkeys((unquote(uri), uri)):
        place = (base / name.replace("\\", "/")).resolve()
        if not place.is_relative_to(base):
            raise DataError(f"the buffer '{shown}' is outside the file's folder; it must be within")
        if place.is_file():
            return place.read_bytes()
    raise DataError(f"the buffer '{shown}' is missing; it must be in the file's folder")


def _embedded(text: str) -> bytes:
    kind, comma, data = text.partition(",")
    if not comma:
        raise DataError("a data URI has no comma before its data")
    if not kind.lower().endswith(";base64"):
        return unquote_to_bytes(data)
    plain = re.sub(r"\s", "", unquote(data)).replace("-", "+").replace("_", "/").rstrip("=")
    try:
        return binascii.a2b_base64(plain + "=" * (-len(plain) % 4), strict_mode=True)
    except binascii.Error as error:
        raise DataError(f"a data URI is not base64 ({error})") from None
