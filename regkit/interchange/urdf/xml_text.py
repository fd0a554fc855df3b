"""The text of an XML file, whatever its encoding and what stands around the document."""

from __future__ import annotations

import re
from pathlib import Path

from regkit.interchange.encodings import Decoded

_DECLARATION = re.compile(r"<\?xml\b[^>]*\?>")
_ENCODING = re.compile(rb"<\?xml\b[^>]*encoding\s*=\s*[\"']([A-Za-z0-9._-]+)[\"']")


def xml_text(content: bytes, path: Path) -> str:
    """Returns the text of a file without its declaration, its lines unchanged.

    A declaration is only allowed at the very beginning, but programs write blank lines and comments
    before it. Null bytes at the end are left out.

    Args:
        content: The content of the file.
        path: The file, for notes.
    """
    declared = _ENCODING.search(content[:4096])
    decoded = Decoded.of(content, declared.group(1).decode("ascii") if declared else "utf-8")
    decoded.tell(path)
    return _DECLARATION.sub("", decoded.text, count=1)
