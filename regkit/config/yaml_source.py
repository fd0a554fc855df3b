"""The text of a YAML file, whatever its bytes are."""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from regkit.system.errors import ConfigError, DataError
from regkit.system.guard import foreign

LARGEST = 500_000
"""Maximum size of a file [bytes]; a template has some 20,000."""

_OTHER_ENCODINGS = {
    codecs.BOM_UTF32_LE: "UTF-32",
    codecs.BOM_UTF32_BE: "UTF-32",
    codecs.BOM_UTF16_LE: "UTF-16",
    codecs.BOM_UTF16_BE: "UTF-16",
}
"""Names of encodings by the bytes with which their files begin; the longer ones come first."""

_UNPRINTABLE = re.compile(
    "[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]"
)
"""Characters that YAML does not allow, and the mark of byte order within a text."""


def yaml_source(path: Path) -> str:
    """Returns the text of a YAML file.

    Raises:
        DataError: If it is missing, not a regular file, too large, or not text in UTF-8; the place
            has the line of the first wrong byte.
    """
    try:
        content = _content(path)
    # A name may also hold a NUL or be too long for the system.
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or foreign(error)
        raise DataError(f"cannot be read: {reason}", place=str(path)) from None
    for mark, name in _OTHER_ENCODINGS.items():
        if content.startswith(mark):
            raise DataError(f"the text is {name}; save it as UTF-8", place=f"{path}:1")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        wrong = content[error.start]
        raise DataError(
            f"the byte 0x{wrong:02x} is not text in UTF-8; if this is YAML, save it as UTF-8",
            place=f"{path}:{_line(content[: error.start].decode('utf-8'))}",
        ) from None
    check_printable(text, str(path))
    return text


def check_printable(text: str, place: str | None) -> None:
    """Refuses characters that YAML does not allow, such as NUL and ESC.

    Raises:
        DataError: At the line of the first one, behind ``place``.
    """
    found = _UNPRINTABLE.search(text)
    if found is not None:
        line = place and f"{place}:{_line(text[: found.start()])}"
        raise DataError(
            f"YAML does not allow the character U+{ord(found.group()):04X}; write it as an escape "
            "in double quotes, or remove it",
            place=line,
        )


def _content(path: Path) -> bytes:
    if path.is_dir():
        raise DataError("this is a folder; name a YAML file", place=str(path))
    if not path.exists():
        raise DataError("there is no such file", place=str(path))
    # A pipe would wait for its writer, and a device may never end.
    if not path.is_file():
        raise DataError("this is a device or a pipe; name a YAML file", place=str(path))
    with path.open("rb") as stream:
        content = stream.read(LARGEST + 1)
    if len(content) > LARGEST:
        raise ConfigError(
            f"the file is larger than {LARGEST // 1000} kB, too large for YAML written by people",
            place=str(path),
        )
    return content


def _line(before: str) -> int:
    """Returns the line, from 1, of the character behind a text."""
    return len(re.findall("\r\n|[\n\r\x85\u2028\u2029]", before)) + 1
